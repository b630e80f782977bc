"""What a report costs, estimated before it starts from the numbers of its arrays and motions.

Runs nothing. `tests/bench/report_cost.py` holds the estimate against reports.
"""

from __future__ import annotations

from report.assessment.runs import scene_key
from report.motions.prepare import Shaking
from report.sheet.schema import ProjectInput

LONG_S = 60.0
"""A report that costs more says so before it starts."""

# Processor time [s] of one machine; on its slow days a report took up to 1.9 times the sum.
_CONSTANT_S, _ARRAY_S, _MOTION_S = 6.2, 0.06, 0.27
# Per million samples of the motions: spectra and figures, then the runs of arrays that differ.
_SAMPLES_S, _RUNS_S = 30.0, 3.5


def expected_s(project: ProjectInput, shaking: Shaking) -> float:
    """Return the processor time [s] that a report will take."""
    arrays, motions = len(project.arrays), len(shaking.motions)
    different = len({scene_key(array) for array in project.arrays})
    millions = _samples(shaking) / 1e6
    return (
        _CONSTANT_S
        + _ARRAY_S * arrays
        + _MOTION_S * motions
        + millions * (_SAMPLES_S + _RUNS_S * different)
    )


def cost(project: ProjectInput, shaking: Shaking) -> str:
    """Return what a long report costs and why as a sentence, empty for another."""
    seconds = expected_s(project, shaking)
    if seconds <= LONG_S:
        return ""
    return (
        f"about {max(2, round(seconds / 60.0)):,} minutes of processor time for "
        f"{len(project.arrays):,} arrays, {len(shaking.motions):,} motions and "
        f"{_samples(shaking):,} samples"
    )


def _samples(shaking: Shaking) -> int:
    return sum(len(motion.ax_mps2) for motion in shaking.motions)
