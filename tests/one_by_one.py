"""Runs by the public solver, one by one, that assessments are held against."""

from solver.model import SlideResult
from solver.sliding.checked import slide


def slides(motion, array, **changes) -> list[SlideResult]:
    """Return the runs of an array under a motion: each component along the slope, each polarity.

    `changes` replace what the solver takes from the array and the motion.
    """
    pair = (motion.ax_mps2, motion.ay_mps2)
    return [
        slid(motion, sign * along, across, array, **changes)
        for along, across in (pair, pair[::-1])
        for sign in motion.signs
    ]


def slid(motion, along, across, array, **changes) -> SlideResult:
    """Return the run of two horizontal components with the vertical one; empty ones are none."""
    given = {"slope_rad": array.slope_rad, "mu": array.mu, "az_mps2": motion.az_mps2} | changes
    given["ay_mps2"] = across
    for name in ("ay_mps2", "az_mps2"):
        given[name] = given[name] if given[name].size else None
    return slide(along, motion.dt_s, **given)


def prd_m(motion, array, **changes) -> float:
    """Return the largest PRD [m] of the runs of an array under a motion."""
    return max(run.prd_m for run in slides(motion, array, **changes))
