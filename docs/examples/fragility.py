# %% [markdown]
# # A fragility for pelicun
#
# The probability that an array slides farther than a limit, by the peak acceleration of the roof,
# and the component library that pelicun (FEMA P-58) reads.
#
# The motions of the example match one spectrum, so their dispersion is less than that of records.
# For a loss estimate, use records, or let `roofslip study` combine the dispersions that you enter.

# %%
from pathlib import Path

import numpy as np
import pandas as pd

import roofslip

records = Path(roofslip.__file__).parent / "projects/example/records"

peaks = []
for k in range(1, 8):
    record = roofslip.read_record(records / f"RM{k}-x.csv")
    to_one_g = 9.80665 / abs(record.a_mps2).max()
    peaks.append(roofslip.motion(record, id=f"RM{k}", scale=to_one_g))
ppa_g = np.linspace(0.1, 2.0, 20)
runs = roofslip.study(peaks, slopes_rad=[0.02], mus=[0.4], intensities=ppa_g)
limits_m = {"half the gap": 0.15, "the gap": 0.3}
fragilities = {
    words: runs.fragility(limit_m, slope_rad=0.02, mu=0.4) for words, limit_m in limits_m.items()
}
for words, found in fragilities.items():
    low, high = found.theta_range
    print(
        f"{words}: median {found.fitted.theta:.3f} g (90% interval {low:.3f} to {high:.3f}), "
        f"dispersion {found.fitted.beta:.3f}"
    )

# %%
at_g = np.linspace(0.1, 2.0, 200)
curves = pd.DataFrame(
    {words: found.fitted.at(at_g) for words, found in fragilities.items()},
    index=pd.Index(at_g, name="peak roof acceleration [g]"),
)
axes = curves.plot(ylabel="probability of exceedance")
for line, found in zip(axes.get_lines(), list(fragilities.values()), strict=True):
    axes.plot(ppa_g, found.exceeded / found.counted, "o", color=line.get_color())
axes.figure.savefig("fragility.png")

# %% [markdown]
# One row for each component, its limit states in columns.

# %%
row = {
    "ID": "BSA.example",
    "Incomplete": 0,
    "Demand-Type": "Peak Floor Acceleration",
    "Demand-Unit": "g",
    "Demand-Offset": 0,
    "Demand-Directional": 0,
}
for k, found in enumerate(fragilities.values(), start=1):
    row |= {
        f"LS{k}-Family": "lognormal",
        f"LS{k}-Theta_0": found.fitted.theta,
        f"LS{k}-Theta_1": found.fitted.beta,
        f"LS{k}-DamageStateWeights": "",
    }
pd.DataFrame([row]).to_csv("fragility.csv", index=False)

# %% [markdown]
# The median is where half of the motions exceed the limit, and the farther limit is met later.

# %%
near, far = fragilities.values()
assert near.fitted.theta < far.fitted.theta
for found in (near, far):
    exceed = found.capacities.intensity < found.fitted.theta
    assert 2 <= exceed.sum() <= 5
