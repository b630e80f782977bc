"""Fragilities in the formats of the field: pelicun / FEMA P-58 libraries, OpenQuake NRML 0.5.

Computes nothing. Read `export_files`.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from functools import partial
from xml.etree import ElementTree as ET

import numpy as np

from report.document.templates import said
from report.sheet.schema.choices import RecordedAt
from report.study.results import ArrayStudyResult, LimitState, StudyResults
from report.study.schema import Intensity
from report.study.tables import Row
from report.study.wording import (
    MASS,
    NOT_DETERMINED,
    context,
    dispersions,
    exported,
    is_refused,
    sentence,
)
from report.text.counts import capitalized
from report.text.formats import csv_text
from report.text.units import digits_down, digits_up, round_up
from report.typeset.pdf import TEMPLATES
from solver.model import Floats

# Demand type and unit of pelicun; it has none for S_DS. Its PRD is peak roof drift ratio.
DEMANDS: Mapping[Intensity, tuple[str, str]] = {
    Intensity.PPA: ("Peak Floor Acceleration", "g"),
    Intensity.PPV: ("Peak Floor Velocity", "mps"),
    Intensity.PGA: ("Peak Ground Acceleration", "g"),
    Intensity.SA1: ("Spectral Acceleration|1.0", "g"),
}

# Intensity measure type of OpenQuake, its unit and how many of it are one of ours. OpenQuake reads
# no unit: accelerations are in g and PGV is in cm/s (openquake.hazardlib.imt).
MEASURES: Mapping[Intensity, tuple[str, str, float]] = {
    Intensity.PPA: ("PGA", "g", 1.0),
    Intensity.PGA: ("PGA", "g", 1.0),
    Intensity.SA1: ("SA(1.0)", "g", 1.0),
    Intensity.PPV: ("PGV", "cm/s", 100.0),
}

QUANTITIES: Mapping[Intensity, str] = {
    Intensity.PPA: "peak horizontal acceleration",
    Intensity.PPV: "peak horizontal velocity",
    Intensity.PGA: "peak horizontal acceleration",
    Intensity.SA1: "horizontal spectral acceleration at 1 s with 5 % damping",
}

# Share of the lowest intensity below which OpenQuake takes no damage. OpenQuake interpolates
# linearly from there to the lowest intensity. It has a value for no intensity below the lowest one
# without a limit, and warns of a limit of zero.
NO_DAMAGE_SHARE = 1e-3

EXPORTS = ("fragility.csv", "fragility.json", "placement.csv", "fragility.xml")

NRML = "http://openquake.org/xmlns/nrml/0.5"
MOST_STATES = 4
# Those of a library, and a description of the limit state, which its readers pass over.
_COLUMNS = ("Family", "Theta_0", "Theta_1", "DamageStateWeights", "Description")


def export_files(results: StudyResults) -> Mapping[str, bytes]:
    """Return the files of `EXPORTS`; none where no format has the measure, or all are refused."""
    if is_refused(results):
        return {}
    kind = results.plan.input.study.intensity
    files: dict[str, bytes] = {}
    known = [result for result in results.arrays if known_states(result)]
    if known and kind in DEMANDS:
        files["fragility.csv"] = _library(results, known).encode()
        files["fragility.json"] = _metadata(results, known).encode()
        files["placement.csv"] = _placement(results, known).encode()
    if kind in MEASURES and any(map(has_probabilities, results.arrays)):
        files["fragility.xml"] = _nrml(results)
    return files


def known_states(result: ArrayStudyResult) -> tuple[LimitState, ...]:
    """Return the limit states that have a lognormal; each has the same name in every file."""
    return tuple(state for state in result.states if state.fragility.fitted.is_known)


def has_probabilities(result: ArrayStudyResult) -> bool:
    """Whether the probability of each limit state is known at every level."""
    # A state without a lognormal has the fractions of the motions, if none of its runs is censored.
    return not _lost_states(result)


def _lost_states(result: ArrayStudyResult) -> list[str]:
    return [
        state.name
        for state in result.states
        if state.fragility.censored and not state.fragility.fitted.is_known
    ]


def component_id(results: StudyResults, result: ArrayStudyResult) -> str:
    """Return the ID of an array in a library: letters, digits, points and dashes."""
    building = results.plan.motions.buildings[result.plan.building]
    name = result.plan.array.id
    if len(results.plan.motions.buildings) > 1:
        # An array on two buildings has two fragilities, and an ID is unique in a library.
        name = f"{name}.{building}"
    return "BSA." + re.sub(r"[^A-Za-z0-9.-]+", "-", name).strip("-")


def _library(results: StudyResults, known: list[ArrayStudyResult]) -> str:
    demand, unit = DEMANDS[results.plan.input.study.intensity]
    states = [f"LS{k}-{name}" for k in range(1, MOST_STATES + 1) for name in _COLUMNS]
    rows: list[Row] = [
        ("ID", "Incomplete", "Demand-Type", "Demand-Unit", "Demand-Offset", "Demand-Directional",
         *states)
    ]  # fmt: skip
    for result in known:
        cells = [cell for state in result.states for cell in _cells(results, result, state)]
        # Every row has the columns of four states, blank beyond its own.
        cells += [""] * (len(states) - len(cells))
        rows.append((component_id(results, result), 0, demand, unit, 0, 0, *cells))
    return csv_text(rows)


def _cells(results: StudyResults, result: ArrayStudyResult, state: LimitState) -> list[str]:
    """Return the columns of a limit state; an undetermined one has its description alone."""
    f = exported(results, result, state)
    if not f.is_known:
        return ["", "", "", "", f"{_sentence(state.words)} {_sentence(NOT_DETERMINED)}"]
    # A reader takes the digits as they are: a lower median and a larger dispersion err on the safe
    # side.
    about = f"{_sentence(state.words)}{_warned(results)}"
    return ["lognormal", digits_down(f.theta, 6), digits_up(f.beta, 6), "", about]


def _sentence(words: str) -> str:
    return f"{capitalized(words)}."


def _metadata(results: StudyResults, known: list[ArrayStudyResult]) -> str:
    study = results.plan.input.study
    about = {
        "ShortName": "Ballasted solar arrays",
        "Description": f"{study.title}. Sliding of ballasted rooftop solar arrays."
        f"{_warned(results)}",
        "Version": results.manifest["program"]["roofslip"],
        "ComponentGroups": {
            "BSA - Ballasted solar arrays": [component_id(results, result) for result in known]
        },
    }
    entries = {component_id(results, result): _entry(results, result) for result in known}
    return (
        json.dumps({"_GeneralInformation": about, **entries}, indent=2, ensure_ascii=False) + "\n"
    )


def _entry(results: StudyResults, result: ArrayStudyResult) -> dict[str, object]:
    kind = results.plan.input.study.intensity
    return {
        "Description": f"Ballasted solar array {result.plan.array.id}",
        "Comments": _said(results, "comments", DEMANDS[kind], one=result),
        "SuggestedComponentBlockSize": "1 EA",
        "RoundUpToIntegerQuantity": "True",
        "LimitStates": {
            state.name: {
                "DS1": {
                    "Description": _sentence(state.words),
                    "RepairAction": "Inspect; not part of this study.",
                }
            }
            for state in known_states(result)
        },
    }


def _placement(results: StudyResults, known: list[ArrayStudyResult]) -> str:
    kind = results.plan.input.study.intensity
    about = _said(results, "measured", DEMANDS[kind]) + _warned(results)
    rows: list[Row] = [("", "Units", "Location", "Direction", "Theta_0", "Blocks", "Comment")]
    for result in known:
        comment = f"Array {result.plan.array.id}. {about}"
        rows.append((component_id(results, result), "ea", "roof", 0, 1, "", comment))
    return csv_text(rows)


def _nrml(results: StudyResults) -> bytes:
    """Return the discrete form: probabilities at each intensity."""
    # The continuous form leaves in doubt whether a mean is of the value or of its logarithm.
    ET.register_namespace("", NRML)
    root = ET.Element(f"{{{NRML}}}nrml")
    model = ET.SubElement(
        root,
        f"{{{NRML}}}fragilityModel",
        {"id": "roofslip", "assetCategory": "contents", "lossCategory": "contents"},
    )
    imt, unit, per_unit = MEASURES[results.plan.input.study.intensity]
    ET.SubElement(model, f"{{{NRML}}}description").text = _said(results, "description", (imt, unit))
    states = [state.name for state in results.arrays[0].states]
    ET.SubElement(model, f"{{{NRML}}}limitStates").text = " ".join(states)
    for result in filter(has_probabilities, results.arrays):
        function = ET.SubElement(
            model,
            f"{{{NRML}}}fragilityFunction",
            {"id": component_id(results, result), "format": "discrete"},
        )
        # All states of an array have the same levels.
        levels = per_unit * result.states[0].fragility.levels
        limit = f"{NO_DAMAGE_SHARE * levels[0]:.9g}"
        imls = ET.SubElement(function, f"{{{NRML}}}imls", {"imt": imt, "noDamageLimit": limit})
        imls.text = " ".join(f"{x:.9g}" for x in levels)
        for state, row in zip(result.states, probabilities_of(results, result), strict=True):
            poes = ET.SubElement(function, f"{{{NRML}}}poes", {"ls": state.name})
            # Rounded to the safe side: a probability of exceedance is never understated.
            poes.text = " ".join(f"{round_up(float(p), 6):.6f}" for p in row)
    ET.indent(root)
    return bytes(ET.tostring(root, encoding="utf-8", xml_declaration=True)) + b"\n"


def _warned(results: StudyResults) -> str:
    return f" {text}" if (text := sentence(results, "warnings")) else ""


def _said(results: StudyResults, name: str, of: tuple[str, str], **more: object) -> str:
    """Return a text of the templates on a measure of a format and its unit."""
    study = results.plan.input.study
    is_roof = study.intensity in (Intensity.PPA, Intensity.PPV) or (
        study.intensity is Intensity.SA1 and study.recorded_at is RecordedAt.ROOF
    )
    words = {
        "name": of[0],
        "unit": of[1],
        "quantity": QUANTITIES[study.intensity],
        "is_roof": is_roof,
        "component_id": partial(component_id, results),
        "dispersions": partial(dispersions, results),
        "known_states": known_states,
        "lost_states": _lost_states,
        "warned": _warned(results),
        "MASS": MASS,
    }
    return said(TEMPLATES, "study/exports.html", name, context(results) | words | more)


def probabilities_of(results: StudyResults, result: ArrayStudyResult) -> Floats:
    """Return the probability of each limit state at each level, shape (states, levels)."""
    # That of the lognormal, or the fractions of the motions where there is none; the array must
    # have them (`has_probabilities`).
    rows = [
        lognormal.at(state.fragility.levels)
        if (lognormal := exported(results, result, state)).is_known
        # A motion may be below the limit again at a higher intensity: a fragility never falls.
        else np.maximum.accumulate(state.fragility.exceeded / state.fragility.counted)
        for state in result.states
    ]
    # A state that is exceeded includes those before it: where lognormals of different dispersion
    # cross, the larger one counts, or OpenQuake would subtract a larger one from a smaller one.
    return np.maximum.accumulate(np.array(rows)[::-1])[::-1]
