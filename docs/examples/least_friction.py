# %% [markdown]
# # Lowest friction for a PRD
#
# Which friction mat does a roof need to keep the design displacement below the clearances on the
# plan? Here the design displacement is 1.1 times the mean PRD of seven motions.

# %%
from pathlib import Path

import numpy as np

import roofslip

records = Path(roofslip.__file__).parent / "projects/example/records"
motions = [
    roofslip.motion(roofslip.read_record(records / f"RM{k}-x.csv"), id=f"RM{k}")
    for k in range(1, 8)
]
slopes_deg, allowed_m = [0.0, 1.0, 2.0, 3.0], 0.3
runs = roofslip.study(
    motions, slopes_rad=np.radians(slopes_deg), mus=np.linspace(0.2, 1.0, 33), intensities=[0.8]
)
least = runs.minimum_friction(allowed_m / 1.1)[:, 0]
for slope, mu in zip(slopes_deg, least, strict=True):
    print(f"{slope:.0f} deg: friction coefficient {mu:.3f} or more")

# %%
import pandas as pd

design = pd.DataFrame(1.1 * runs.statistics().mean_m[:, :, 0].T, index=runs.mus)
design.columns = [f"{slope:.0f} deg" for slope in slopes_deg]
axes = design.plot(logy=True, xlabel="friction coefficient", ylabel="design displacement [m]")
axes.axhline(allowed_m, color="black", linestyle="dashed")
axes.figure.savefig("least-friction.png")

# %% [markdown]
# Run again at the friction that was read off the curve, which is interpolated: the design value is
# the allowed one to a few percent.

# %%
for slope, mu in zip(slopes_deg, least, strict=True):
    again = roofslip.study(motions, slopes_rad=[np.radians(slope)], mus=[mu], intensities=[0.8])
    found_m = 1.1 * again.statistics().mean_m.item()
    print(f"{slope:.0f} deg: {found_m:.3f} m at {mu:.3f}")
    assert abs(found_m / allowed_m - 1.0) < 0.05
