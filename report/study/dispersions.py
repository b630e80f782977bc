"""The dispersions of an exported fragility by name, as FEMA P-58 has them; none is assumed.

Record-to-record 0.30 and friction 0.20 are sqrt(0.30^2 + 0.20^2) = 0.36 in all.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from report.study.study_input import Intensity
from report.study.study_plan import FRICTION, SLOPE
from report.study.study_results import ArrayStudyResult, LimitState, StudyResults
from solver.studies.fragility import Lognormal

NOT_GIVEN, NOT_DETERMINED = "not entered", "not determined"
NAMES = ("record-to-record", "modeling", "quality of data", "friction", "slope")


@dataclass(frozen=True, slots=True, kw_only=True)
class Dispersion:
    """A part of the dispersion of a capacity, independent of the others."""

    name: str  # one of `NAMES`
    source: str  # where it is from, or why it is not included
    beta: float  # standard deviation of the logarithm of the capacity; 0 if not included


def dispersions(
    results: StudyResults, result: ArrayStudyResult, state: LimitState
) -> tuple[Dispersion, ...]:
    """Return the dispersions of a limit state that has a lognormal; mass is none (`MASS`)."""
    study, plan = results.plan.input.study, result.plan
    record = "these motions", state.fragility.fitted.beta
    # One that is entered goes before that of the motions, which may be matched to one spectrum.
    if study.record_beta is not None:
        record = study.record_source, study.record_beta
    mu, slope = plan.spreads[FRICTION], plan.spreads[SLOPE]
    tests = f"tests of {plan.array.mat}, standard deviation of ln μ {mu.deviation:.3f}"
    tolerance = f"tolerance, standard deviation {slope.deviation:.2g} deg"
    parts = (
        record,
        _entered(study.modeling_beta),
        _entered(study.quality_beta),
        _of_effect(state, FRICTION, f"mat {plan.array.mat} has no tests", tests),
        _of_effect(state, SLOPE, "no tolerance is entered", tolerance),
    )
    return tuple(
        Dispersion(name=name, source=source, beta=beta)
        for name, (source, beta) in zip(NAMES, parts, strict=True)
    )


def _entered(beta: float | None) -> tuple[str, float]:
    return (NOT_GIVEN, 0.0) if beta is None else ("entered", beta)


def _of_effect(state: LimitState, variable: str, lacking: str, source: str) -> tuple[str, float]:
    beta = state.effects.get(variable)
    if beta is None:
        return lacking, 0.0
    return (NOT_DETERMINED, 0.0) if math.isnan(beta) else (source, beta)


def exported(results: StudyResults, result: ArrayStudyResult, state: LimitState) -> Lognormal:
    """Return the lognormal of a limit state with all its dispersions; unknown if it has none."""
    fitted = state.fragility.fitted
    if not fitted.is_known:
        return fitted
    # Independent of each other: beta^2 is the sum of the squares.
    total = math.hypot(*(part.beta for part in dispersions(results, result, state)))
    return Lognormal(theta=fitted.theta, beta=total)


def is_exportable(results: StudyResults) -> bool:
    """Whether pelicun has the measure of intensity."""
    return results.plan.input.study.intensity is not Intensity.S_DS


def lacks_record_spread(results: StudyResults) -> bool:
    """Whether neither the motions nor the workbook give a record-to-record dispersion."""
    differ = results.spread.is_known and not results.spread.is_one_spectrum
    return results.plan.input.study.record_beta is None and not differ


def is_refused(results: StudyResults) -> bool:
    """Whether no fragility is exported, although pelicun has the measure of intensity."""
    is_wanted = bool(results.arrays) and is_exportable(results)
    return is_wanted and lacks_record_spread(results) and not results.allow_matched


def is_warned(results: StudyResults) -> bool:
    """Whether fragilities are exported in spite of that."""
    return results.allow_matched and lacks_record_spread(results)
