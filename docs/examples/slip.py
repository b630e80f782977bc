# %% [markdown]
# # A slip and its plot
#
# One array under one roof motion: when it slips, how far, and where it ends. The run is exact for
# the digitized record, which is linear between its samples.

# %%
from pathlib import Path

import roofslip

records = Path(roofslip.__file__).parent / "projects/example/records"
record = roofslip.read_record(records / "RM1-x.csv")
history = roofslip.slide_history(record, slope_rad=0.03, mu=0.4)
print(history.result)

# %% [markdown]
# Every slip begins and ends at an event, between the samples.

# %%
for event in history.events[:4]:
    print(f"{event.t_s:7.4f} s  {event.kind:4}  {1e3 * event.u_m:6.2f} mm")

# %% [markdown]
# A history is a table of pandas, which plots it.

# %%
frame = history.to_frame()
axes = frame.plot(subplots=True, title=["Displacement, downslope [m]", "Velocity [m/s]"])
axes[-1].set_xlabel("time [s]")
axes[0].figure.set_layout_engine("tight")
axes[0].figure.savefig("slip.png")

# %% [markdown]
# Samples never see more than the peak, which may lie between them.

# %%
assert frame["u_m"].abs().max() <= history.result.prd_m
