# %% [markdown]
# # Two axes, with a hodograph
#
# Both horizontal components and the vertical one act at once. Friction opposes the velocity, so
# cross-slope slip leaves less friction along the slope: the axes cannot be run separately.

# %%
from math import hypot
from pathlib import Path

import roofslip

records = Path(roofslip.__file__).parent / "projects/example/records"
x, y, z = (roofslip.read_record(records / f"RM1-{name}.csv") for name in "xyz")
motion = roofslip.motion(x, y, z, id="RM1")
both = roofslip.slide_history(motion, slope_rad=0.03, mu=0.4)
along = roofslip.slide(x, az_mps2=z, slope_rad=0.03, mu=0.4)
across = roofslip.slide(y, az_mps2=z, slope_rad=0.0, mu=0.4)
print("two axes:    ", both.result)
print("along alone: ", along)
print("across alone:", across)

# %% [markdown]
# `solve` runs the simpler models too and says which one is enough, and why.

# %%
print(roofslip.solve(roofslip.scene(motion, slope_rad=0.03, mu=0.4)))

# %%
frame = both.to_frame()
axes = frame.plot(x="across_m", y="u_m", legend=False, title="Path of the array on the roof")
axes.set(xlabel="cross-slope [m]", ylabel="downslope [m]", aspect="equal")
axes.figure.savefig("hodograph.png")

# %% [markdown]
# The displacement in two axes has a stated error, and it is not that of the axes run apart.

# %%
together_m, apart_m = both.result.prd_m, hypot(along.prd_m, across.prd_m)
print(f"{1e3 * together_m:.1f} mm together, {1e3 * apart_m:.1f} mm from the axes run apart")
assert both.result.error_m < 1e-3 * together_m
assert abs(together_m - apart_m) > 0.05 * together_m
