"""The fragilities of a study as a component library of pelicun (FEMA P-58).

Computes nothing. Read `export_files`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from report.project.model.choices import RecordedAt
from report.study.dispersions import (
    NOT_DETERMINED,
    dispersions,
    exported,
    is_exportable,
    is_refused,
)
from report.study.sentences import MASS, warnings
from report.study.study_input import Intensity
from report.study.study_results import ArrayStudyResult, LimitState, StudyResults
from report.study.study_tables import Row
from report.study.wording import both
from report.text.csv_text import csv_text
from report.text.letter_case import capitalized
from report.text.names import joined
from report.text.units import digits_down, digits_up, spaced

LIBRARY = "fragility.csv"

# Demand type and unit of pelicun, and what the measure is; pelicun has none for S_DS.
DEMANDS: Mapping[Intensity, tuple[str, str, str]] = {
    Intensity.PPA: ("Peak Floor Acceleration", "g", "peak horizontal acceleration"),
    Intensity.PPV: ("Peak Floor Velocity", "mps", "peak horizontal velocity"),
    Intensity.PGA: ("Peak Ground Acceleration", "g", "peak horizontal acceleration"),
    Intensity.SA1: (
        "Spectral Acceleration|1.0",
        "g",
        "horizontal spectral acceleration at 1 s with 5% damping",
    ),
}

# LS1 to LS4, as the library of FEMA P-58 has them for pelicun.
MOST_STATES = 4
# The readers of a library pass over `Comments` and `Description`.
_OF_ARRAY = (
    "ID", "Incomplete", "Demand-Type", "Demand-Unit", "Demand-Offset", "Demand-Directional",
    "Comments",
)  # fmt: skip
_OF_STATE = ("Family", "Theta_0", "Theta_1", "DamageStateWeights", "Description")


def export_files(results: StudyResults) -> Mapping[str, bytes]:
    """Return the library by its name; none where no array has a lognormal, or it is refused."""
    arrays = [result for result in results.arrays if known_states(result)]
    if not arrays or not is_exportable(results) or is_refused(results):
        return {}
    of_states: list[str] = []
    for number in range(1, MOST_STATES + 1):
        of_states += [f"LS{number}-{name}" for name in _OF_STATE]
    rows = [(*_OF_ARRAY, *of_states), *(_component(results, result) for result in arrays)]
    return {LIBRARY: csv_text(rows).encode()}


def known_states(result: ArrayStudyResult) -> tuple[LimitState, ...]:
    """Return the limit states that have a lognormal."""
    return tuple(state for state in result.states if state.fragility.fitted.is_known)


def component_id(results: StudyResults, result: ArrayStudyResult) -> str:
    """Return the ID of an array in a library: letters, digits, points and dashes."""
    building = results.plan.motions.buildings[result.plan.building]
    name = result.plan.array.id
    if len(results.plan.motions.buildings) > 1:
        # An array on two buildings has two fragilities, and an ID is unique in a library.
        name = f"{name}.{building}"
    return "BSA." + re.sub(r"[^A-Za-z0-9.-]+", "-", name).strip("-")


def _component(results: StudyResults, result: ArrayStudyResult) -> Row:
    demand, unit, _ = DEMANDS[results.plan.input.study.intensity]
    comments = spaced(" ".join(_remarks(results, result)))
    # Complete (Incomplete 0), no offset of the floor, and of no direction.
    row = [component_id(results, result), 0, demand, unit, 0, 0, comments]
    # Those that are known, without a gap: pelicun fails where the first state is blank, and counts
    # its damage states without the others that are.
    states = known_states(result)
    for state in states:
        lognormal = exported(results, result, state)
        # A reader takes the digits as they are: a lower median and a larger dispersion err on the
        # safe side.
        theta, beta = digits_down(lognormal.theta, 6), digits_up(lognormal.beta, 6)
        row += ["lognormal", theta, beta, "", f"{capitalized(state.words)}."]
    # Every row has the columns of four states, blank beyond its own.
    blank = [""] * (len(_OF_STATE) * (MOST_STATES - len(states)))
    return [*row, *blank]


def _remarks(results: StudyResults, result: ArrayStudyResult) -> Iterator[str]:
    """Yield what the array, its measure and its dispersions are, and every warning."""
    study, array = results.plan.input.study, result.plan.array
    roof = f"friction coefficient {result.plan.mu:g}, slope {array.slope_deg:g} deg"
    yield f"Mat {array.mat}, {roof}, clearance {both(results, array.clearance_m)}."
    yield (
        "Limit states are on the peak relative displacement of a motion, not on a design "
        "displacement."
    )
    is_roof = study.intensity in (Intensity.PPA, Intensity.PPV) or (
        study.intensity is Intensity.SA1 and study.recorded_at is RecordedAt.ROOF
    )
    where = "roof motion, not of the ground" if is_roof else "ground motion, not of the roof"
    demand, unit, quantity = DEMANDS[study.intensity]
    yield f"{demand} in {unit} is the {quantity} of the {where}."
    for number, state in enumerate(known_states(result), start=1):
        parts = (
            f"{part.name} {digits_up(part.beta, 2) if part.beta else 'not included'} "
            f"({part.source})"
            for part in dispersions(results, result, state)
        )
        yield f"Dispersions of LS{number} ({state.words}): {', '.join(parts)}."
    others = [state.words for state in result.states if not state.fragility.fitted.is_known]
    if others:
        yield f"{capitalized(NOT_DETERMINED)}: {joined(others)}."
    yield f"{MASS}."
    yield from warnings(results)
    yield f"Study {results.manifest['identity'][:16]}."
