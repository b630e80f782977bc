"""Records of sines: as files, and as a suite of motions that takes no time to make."""

import math

import numpy as np

from solver.records.record import record_from_values
from solver.synthesis.suite import SuiteMotion

DT_S, SECONDS, PEAK_G = 0.01, 4.0, 0.25


def wave(name, hz):
    """Whole periods of a sine."""
    times = np.arange(0.0, SECONDS + DT_S / 2, DT_S)
    values = PEAK_G * np.sin(2 * math.pi * hz * times)
    return record_from_values(name, values, units="g", dt_s=DT_S)


def suite(count, *, seeds=("noise",) * 3, hold_s=2.0):
    """Motions of sines in place of `solver.synthesis.make_suite`."""
    return [
        SuiteMotion(
            **{axis: wave(f"motion-{k:02d}-{axis}", hz) for axis, hz in AXES},
            seeds=seeds,
            hold_s=hold_s,
        )
        for k in range(1, count + 1)
    ]


AXES = (("x", 0.5), ("y", 2.5), ("z", 5.0))


def plain(path, dt_s=0.01, count=100):
    """Write a record with times, whose heading names no component."""
    path.parent.mkdir(parents=True, exist_ok=True)
    rows = (f"{k * dt_s:.4f},{0.1 * np.sin(0.3 * k):.5f}" for k in range(count))
    path.write_text("time_s,acceleration_g\n" + "\n".join(rows) + "\n")
    return path
