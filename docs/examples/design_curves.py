# %% [markdown]
# # Design curves
#
# The mean PRD of seven motions over friction, slope and intensity. The first horizontal component
# of each motion acts along the slope in both polarities, together with the vertical component; the
# larger PRD is used.

# %%
from pathlib import Path

import numpy as np

import roofslip

records = Path(roofslip.__file__).parent / "projects/example/records"
motions = [
    roofslip.motion(
        roofslip.read_record(records / f"RM{k}-x.csv"),
        az_mps2=roofslip.read_record(records / f"RM{k}-z.csv"),
        id=f"RM{k}",
    )
    for k in range(1, 8)
]
runs = roofslip.study(
    motions,
    slopes_rad=np.radians([0.0, 2.0, 5.0]),
    mus=np.linspace(0.3, 0.9, 13),
    intensities=[0.5, 1.0],
)
print(runs)

# %% [markdown]
# Each run is a row. The mean over the motions gives a curve for each slope.

# %%
print(runs.to_frame().tail(3))

# %%
import pandas as pd

means = runs.statistics().mean_m[:, :, -1]
curves = pd.DataFrame(means.T, index=pd.Index(runs.mus, name="friction coefficient"))
curves.columns = [f"{slope:.0f} deg" for slope in np.degrees(runs.slopes_rad)]
axes = curves.plot(marker="o", ylabel="mean PRD [m]", title="Design curves")
axes.figure.savefig("design-curves.png")

# %% [markdown]
# A steeper roof needs more friction: at each friction coefficient, the mean PRD increases with the
# slope.

# %%
assert (np.diff(curves.dropna(), axis=1) >= 0.0).all()
