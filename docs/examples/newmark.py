# %% [markdown]
# # Newmark and pySLAMMER on the same record
#
# Newmark's block (Géotechnique 15 (1965) 139-160), as SLAMMER and pySLAMMER run it for earth
# slopes, slides one way only, and its resistance is constant: the normal force is that at rest. An
# array on a roof slides both ways, and shaking changes its normal force. How large is the effect of
# each?

# %%
import math
from pathlib import Path

import numpy as np
import pandas as pd

import roofslip

G = 9.80665


def one_way(push_mps2, yield_mps2, dt_s):
    """Return the slip [m] at the samples: trapezoidal sums while the block moves, as pySLAMMER."""
    slip, v, before = [0.0], 0.0, 0.0
    for push in (push_mps2[1:] - yield_mps2).tolist():
        now = push if v > 0.0 or push > 0.0 else 0.0
        faster = v + 0.5 * dt_s * (before + now)
        v, old, before = max(faster, 0.0), v, now if faster > 0.0 else 0.0
        slip.append(slip[-1] + (0.5 * dt_s * (old + v) if v > 0.0 else 0.0))
    return np.array(slip)


# %% [markdown]
# Newmark's closed form for a rectangular pulse of acceleration A over a time t0, and a yield
# acceleration a_c: V^2 / (2 a_c) (1 - a_c / A) with V = A t0.

# %%
A, a_c, t0, dt = 4.0, 1.0, 0.5, 1e-4
pulse = np.where(np.arange(40_000) * dt <= t0, A, 0.0)
closed_m = (A * t0) ** 2 / (2.0 * a_c) * (1.0 - a_c / A)
print(f"closed form {closed_m:.4f} m, by steps {one_way(pulse, a_c, dt)[-1]:.4f} m")
assert abs(one_way(pulse, a_c, dt)[-1] / closed_m - 1.0) < 1e-3

# %% [markdown]
# The same record, slopes and friction, with one assumption more in each column: the exact block;
# the normal force frozen; and then no slip upslope, with the step of the record.

# %%
records = Path(roofslip.__file__).parent / "projects/example/records"
record = roofslip.read_record(records / "RM1-x.csv")
mu, slopes_deg = 0.4, [0.0, 1.0, 2.0, 3.0, 5.0]


def prds_m(slope_deg):
    """Return the PRD by each set of assumptions, the larger of both polarities [m]."""
    theta = math.radians(slope_deg)
    found = {}
    for name, method in (("exact", "exact"), ("normal force frozen", "frozen-normal")):
        about = {"slope_rad": theta, "mu": mu, "method": method}
        found[name] = max(roofslip.slide(record, scale=s, **about).prd_m for s in (1.0, -1.0))
    resistance = G * (mu * math.cos(theta) - math.sin(theta))
    slips = (
        one_way(sign * record.a_mps2 * math.cos(theta), resistance, record.dt_s)[-1]
        for sign in (1.0, -1.0)
    )
    return found | {"one way as well": math.cos(theta) * max(slips)}


table = pd.DataFrame({slope: prds_m(slope) for slope in slopes_deg}).T
print(table.round(3))

# %%
axes = table.plot(marker="o", xlabel="slope [deg]", ylabel="PRD [m]", title="Three assumptions")
axes.figure.savefig("newmark.png")

# %% [markdown]
# On a flat roof without vertical shaking the normal force is constant indeed, but the block that
# cannot come back goes much too far. On a slope the two assumptions err in opposite directions:
# the frozen normal force gives too little, one way too much, and the sum may look right by chance.

# %%
flat, steep = table.iloc[0], table.iloc[-1]
assert math.isclose(flat["normal force frozen"], flat["exact"], rel_tol=1e-9)
assert flat["one way as well"] > 1.5 * flat["exact"]
assert steep["normal force frozen"] < 0.95 * steep["exact"] < steep["one way as well"]
