"""The fragilities of a study as a component library of pelicun (FEMA P-58).

Computes nothing. Read `export_files`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import partial

from report.document.templates import said
from report.project.model.choices import RecordedAt
from report.study.dispersions import dispersions, exported, is_exportable, is_refused
from report.study.study_input import Intensity
from report.study.study_results import ArrayStudyResult, LimitState, StudyResults
from report.study.study_tables import Row
from report.study.wording import MASS, context
from report.text.csv_text import csv_text
from report.text.letter_case import capitalized
from report.text.units import digits_down, digits_up
from report.typeset.pdf import TEMPLATES

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
    comments = _comments(results, result)
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


def _comments(results: StudyResults, result: ArrayStudyResult) -> str:
    """Return what the array, its measure and its dispersions are, and every warning."""
    study = results.plan.input.study
    is_roof = study.intensity in (Intensity.PPA, Intensity.PPV) or (
        study.intensity is Intensity.SA1 and study.recorded_at is RecordedAt.ROOF
    )
    words = {
        "one": result,
        "demand": DEMANDS[study.intensity],
        "is_roof": is_roof,
        "dispersions": partial(dispersions, results, result),
        "known_states": known_states(result),
        "others": [state.words for state in result.states if not state.fragility.fitted.is_known],
        "MASS": MASS,
    }
    return said(TEMPLATES, "study/exports.html", "comments", context(results) | words)
