# %% [markdown]
# # Ground to roof
#
# A ground motion is transferred to the roof with an elastic building model: here a uniform shear
# building of four stories. The slip of an array under the ground motion and that under the roof
# motion differ considerably.

# %%
from pathlib import Path

import pandas as pd

import roofslip

records = Path(roofslip.__file__).parent / "projects/example/records"
components = [roofslip.read_record(records / f"RM2-{name}.csv") for name in "xyz"]
ground = roofslip.motion(*components, id="RM2", scale=0.3)
building = roofslip.building_of_periods([0.5], damping=[0.05], stories=4)
roof = roofslip.at_roof(ground, building)
print(building)
print(ground)
print(roof)

# %%
spectra = pd.DataFrame(
    {
        "ground": roofslip.spectrum(ground).to_frame()["x"],
        "roof": roofslip.spectrum(roof).to_frame()["x"],
    }
)
axes = spectra.plot(logx=True, xlabel="period [s]", ylabel="pseudo-acceleration [m/s2]")
axes.axvline(0.5, color="black", linestyle="dashed")
axes.figure.savefig("ground-to-roof.png")

# %%
slid = {
    name: roofslip.slide(motion, slope_rad=0.02, mu=0.3)
    for name, motion in (("ground", ground), ("roof", roof))
}
for name, result in slid.items():
    print(f"{name}: {result}")

# %% [markdown]
# The building amplifies most at its own period; a stiff building changes next to nothing.

# %%
ratio = spectra["roof"] / spectra["ground"]
assert abs(ratio.idxmax() / 0.5 - 1.0) < 0.1
stiff = roofslip.at_roof(ground, roofslip.building_of_periods([0.01], stories=1))
result = roofslip.slide(stiff, slope_rad=0.02, mu=0.3)
print(f"roof of a stiff building: {result}")
assert abs(result.prd_m / slid["ground"].prd_m - 1.0) < 0.05
