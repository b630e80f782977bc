# %% [markdown]
# # A suite for AC156
#
# If you have no roof motions, generate them from noise, or from recorded motions as seeds. Their
# spectra match the required response spectrum at the roof. The same seed gives the same motions.

# %%
import numpy as np

import roofslip

horizontal = roofslip.ac156_horizontal(roofslip.EDITIONS["ASCE 7-16"], s_ds_g=1.2, z_over_h=1.0)
vertical = roofslip.ac156_vertical(s_ds_g=1.2)
suite = roofslip.make_suite(horizontal.corners, vertical.corners, count=2, seed=1)
for made in suite:
    x, y, z = (roofslip.measures(record) for record in made.components)
    print(f"{made.x.name}: PGA {x.pga_mps2:.2f} m/s2, D5-95 {x.d5_95_s:.1f} s")

# %%
frequencies_hz = np.geomspace(0.1, 33.3, 150)
spectra = roofslip.spectrum(roofslip.motion(*suite[0].components), 1.0 / frequencies_hz).to_frame()
spectra = (spectra / 9.80665).set_index(frequencies_hz)
spectra["required, horizontal"] = horizontal.at(frequencies_hz)
spectra["required, vertical"] = vertical.at(frequencies_hz)
axes = spectra.plot(logx=True, logy=True, xlabel="frequency [Hz]", ylabel="acceleration [g]")
axes.figure.savefig("suite.png")

# %% [markdown]
# No component falls below its target, and none exceeds it by more than 30 %.

# %%
ratios = spectra[["x", "y"]].div(spectra["required, horizontal"], axis=0)
print(ratios.describe().loc[["min", "mean", "max"]].round(3))
assert ratios.min(axis=None) >= 1.0
assert ratios.max(axis=None) <= 1.3

# %% [markdown]
# The motions are ready to run, or to be written for a workbook by `roofslip.write_record`.

# %%
for k, made in enumerate(suite, start=1):
    motion = roofslip.motion(*made.components, id=f"motion {k}")
    print(motion.id, roofslip.slide(motion, slope_rad=0.03, mu=0.5))
