"""What is computed for the page: each job from a folder and values to data for JSON.

Knows no session and no request. Read `state` and `assessed`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any

from report.assessment.project import Assessment, assess, reassess
from report.sheet.schema import Model, ProjectInput
from report.web.answers import answer
from report.web.controls import controls, shown
from report.web.opened import Opened, opened, with_values
from report.web.problems import problems
from report.web.values import Values
from solver.model import InputError, Motion

KEPT = 16
"""Projects that stay open."""


@lru_cache(KEPT)
def _open(workbook: Path) -> Opened:
    return opened(workbook)


def state(workbook: Path, file: str) -> Mapping[str, Any]:
    """Return everything about a project at the values of its workbook.

    Parameters
    ----------
    workbook : Path
    file : str
        Its name as the user knows it.
    """
    try:
        given = _open(workbook)
    except InputError as error:
        return {
            "project": None,
            "problems": problems(workbook, error.problems),
            "warnings": [],
            "sliders": [],
            "choices": [],
            "views": {"arrays": [], "motions": []},
            "answer": None,
        }
    answered = _answered(given, is_moving=False)
    project = given.sheet.project.project
    return {
        "project": {
            "name": project.name,
            "file": file,
            "sha256": given.sheet.sha256,
            "units_first": project.units_first.value,
        },
        "problems": [],
        "warnings": [line["text"] for line in answered["reasons"] if line["level"] == "warning"],
        **controls(given),
        "views": {
            "arrays": [array.id for array in given.sheet.project.arrays],
            "motions": [_motion(motion) for motion in given.shaking.motions],
        },
        "answer": answered | {"n": 0},
    }


def assessed(workbook: Path, values: Values, *, is_moving: bool) -> Mapping[str, Any]:
    """Return the answer at values of the sliders.

    Raises
    ------
    InputError
        Where the workbook could not have them.
    """
    return _answered(with_values(_open(workbook), values), is_moving=is_moving)


@lru_cache(KEPT)
def _at_rest(workbook: Path) -> Assessment:
    """Return the assessment of a workbook as it is."""
    given = _open(workbook)
    return assess(given.sheet, given.shaking)


def _answered(given: Opened, *, is_moving: bool) -> dict[str, Any]:
    if is_moving:
        start = _at_rest(given.sheet.path)
        changed = replace(start, sheet=given.sheet, shaking=given.shaking)
        assessment = reassess(changed, _in_one_axis(given.sheet.project))
    else:
        assessment = assess(given.sheet, given.shaking)
    return answer(assessment, is_provisional=is_moving) | {"shown": shown(given)}


def _in_one_axis(data: ProjectInput) -> ProjectInput:
    arrays = (row.model_copy(update={"model": Model.ONE_AXIS_VERTICAL}) for row in data.arrays)
    return data.model_copy(update={"arrays": tuple(arrays)})


def _motion(motion: Motion) -> Mapping[str, Any]:
    runs = enumerate(heading.name for heading in motion.headings)
    return {"id": motion.id, "runs": [{"value": value, "label": name} for value, name in runs]}
