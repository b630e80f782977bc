# %% [markdown]
# # Your own method compared with the others
#
# `roofslip.METHODS` has twelve methods for one axis. A new method needs one function, which
# receives the scene and fills in displacement and velocity at the samples. This one is Moreau's
# time stepping, which projects the velocity of each step onto the range that friction allows
# (Moreau, Unilateral contact and dry friction in finite freedom dynamics, CISM 302 (1988) 1-82).

# %%
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd

import roofslip


def time_stepping(scene, parameters, samples):
    """Return the motion along the slope, with one projection in each sub-step."""
    parts = int(parameters["substeps"])
    at = np.arange((scene.ax.size - 1) * parts + 1) / parts
    ax = np.interp(at, np.arange(scene.ax.size), scene.scale * scene.ax)
    drive = scene.g * scene.sn - ax * scene.cs
    hold = scene.mu * (scene.g * scene.cs + ax * scene.sn)
    dt, v, path, speeds, stops = scene.dt / parts, 0.0, [0.0], [0.0], 0
    for push, most in zip(drive[1:].tolist(), hold[1:].tolist(), strict=True):
        free = v + dt * push
        before, v = v, max(free - dt * most, 0.0) + min(free + dt * most, 0.0)
        stops += before != 0.0 and v * before <= 0.0
        path.append(path[-1] + dt * v)
        speeds.append(v)
    if samples.size:
        samples[:] = path[::parts], speeds[::parts]
    peak = dt * int(np.argmax(np.abs(path)))
    return roofslip.Outcome(True, max(path), min(path), path[-1], v, peak, stops)


mine = replace(
    roofslip.METHODS["paper"],
    name="time-stepping",
    title="Moreau's time stepping",
    parameters={"substeps": 4},
    follow=time_stepping,
)

# %%
records = Path(roofslip.__file__).parent / "projects/example/records"
record = roofslip.read_record(records / "RM1-x.csv")
exact = roofslip.slide(record, slope_rad=0.03, mu=0.4)
rows = {
    method.title: roofslip.slide(record, slope_rad=0.03, mu=0.4, method=method).prd_m
    for method in (*roofslip.METHODS.values(), mine)
    if "scipy" not in method.source  # those need it installed
}
table = pd.DataFrame({"prd_m": rows})
table["error"] = table["prd_m"] / exact.prd_m - 1.0
print(table)

# %% [markdown]
# Its error, the largest difference of any sample from the exact path, falls with the step, but not
# evenly: slip begins and ends anywhere in a step.

# %%
about = {"slope_rad": 0.03, "mu": 0.4}
path = roofslip.slide_history(record, **about)
substeps = [1, 2, 4, 8, 16, 32]
found = [roofslip.slide_history(record, **about, method=mine, substeps=n) for n in substeps]
errors = pd.Series([np.abs(run.u_m - path.u_m).max() for run in found], index=substeps)
axes = errors.plot(loglog=True, marker="o", xlabel="sub-steps", ylabel="error [m]")
axes.figure.savefig("own-method.png")
print(errors)
assert errors[32] < errors[1] / 8
