"""Folders of made shake-table tests: trapezoidal pulses whose slip is known in closed form."""

import csv

import numpy as np

from solver.verification import reference
from solver.verification.checks import G, trapezoid

HEADINGS = ("Test", "Data", "Source", "x", "y", "z", "Slope [deg]", "Friction", "PRD [mm]",
            "Residual [mm]")  # fmt: skip
MADE = "Closed form of a trapezoidal pulse, multiplied by a known factor; nothing was measured"
DT_S, PLATEAU = 0.01, 30
PULSES = ((0.4, 0.1), (0.5, 0.2), (0.6, 0.3), (0.8, 0.4), (1.0, 0.5), (1.0, 0.3))
"""Peak [g] and friction coefficient."""


def slip_m(peak_g, mu):
    """Return the closed form, for a flat roof and gravity of 9.80665 m/s2."""
    g = 9.80665
    return reference.pulse_travel(peak_g * G, mu * g, PLATEAU * DT_S, DT_S)


def write_record(path, a_mps2):
    """Write a record with time and acceleration, units in the headings."""
    rows = (f"{i * DT_S:.2f},{a!r}" for i, a in enumerate(np.asarray(a_mps2).tolist()))
    path.write_text("time [s],a [m/s2]\n" + "\n".join(rows) + "\n")


def write_tests(folder, rows, headings=HEADINGS):
    """Write `tests.csv`."""
    with (folder / "tests.csv").open("w", newline="") as file:
        csv.writer(file).writerows([headings, *rows])


def write_folder(folder, ratios, data="computed"):
    """Write one test for each wanted ratio of computed to stated slip; return its rows."""
    rows = []
    for at, ratio in enumerate(ratios):
        peak_g, mu = PULSES[at % len(PULSES)]
        name = f"pulse-{at + 1}.csv"
        write_record(folder / name, trapezoid(-peak_g * G, PLATEAU, 400))
        stated_mm = f"{1e3 * slip_m(peak_g, mu) / ratio:.9f}"
        rows.append((f"P{at + 1}", data, MADE, name, "", "", "0", f"{mu:g}", stated_mm, stated_mm))
    write_tests(folder, rows)
    return rows
