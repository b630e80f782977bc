"""What is computed for the page: each job from a workbook and values to data for JSON.

Knows no request. Read `perform`, then `answer_at`; `problems` has input errors as data.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import lru_cache
from pathlib import Path
from typing import Any

from openpyxl.utils import coordinate_to_tuple
from openpyxl.worksheet.worksheet import Worksheet

from report.assessment.assess import anticipate, assess, reference_of
from report.assessment.neighbors import NearbyKind
from report.assessment.plan_clearances import missing_rows
from report.assessment.precheck import shaking_acceptance
from report.assessment.project import Assessment
from report.assessment.verdict import Verdict
from report.drawing_read.fill import changes, layers_of, plan_as_rows, unread
from report.drawing_read.plan_read import known_layers
from report.drawing_read.read_dxf import read_dxf
from report.drawing_read.roof_drawing import drawn_on, proposed
from report.motions.history import targets
from report.sheet.checking.findings import grouped, line_of, listed
from report.sheet.reading.archive import OpenBook, open_book
from report.sheet.reading.locate import find_table
from report.sheet.reading.parts import changed
from report.sheet.reading.positions import CellPosition, found_at
from report.sheet.reading.read import read, read_book
from report.sheet.reading.what_if import cells
from report.sheet.schema.choices import LayerKind
from report.sheet.workbook import SECTIONS
from report.sheet.writing.filled import WorkbookChange, withdrawn
from report.text.counts import cut
from report.text.units import LENGTHS
from report.web import views
from report.web.answers import answer
from report.web.controls import Opened, check, controls, opened, shown, with_values
from report.web.plan import USUAL_PX, stamp
from report.web.values import Values
from solver.model import InputError, Problem
from solver.records.acceptance import Acceptance

_MOST_COLUMNS, _BESIDE = 40, 2  # of a sheet that are read, and of those the ones around a cell


def problems(path: Path, error: InputError) -> list[Mapping[str, Any]]:
    """Return the problems of a workbook, each with the row of its first cell."""
    try:
        book = open_book(path)
    except InputError:
        book = None
    return [_shown(path, book, equal) for equal in grouped(error.parts)]


def _shown(path: Path, book: OpenBook | None, equal: Sequence[Problem]) -> Mapping[str, Any]:
    first = equal[0]
    sheet, _, at = first.where.rpartition("!")
    cell = at if sheet else ""
    return {
        "file": path.name,
        "text": line_of(equal),
        "found": first.found if sheet or not at else f"{at}: {first.found}",
        "remedy": first.remedy,
        "sheet": sheet,
        "cell": cell,
        "cells": listed(each.where.removeprefix(f"{sheet}!") for each in equal) if sheet else "",
        "row": _row(book, sheet, cell) if book and cell else None,
    }


def _row(book: OpenBook, title: str, cell: str) -> Mapping[str, Any] | None:
    """Return the row of a cell as texts with the headings above them; none of headings alone."""
    if title not in book.book.sheetnames:
        return None
    row, column = coordinate_to_tuple(cell)
    header, columns = _headed(book, book.book[title], row, column)
    if row == header:
        return None
    shown = [
        number
        for number in columns
        if header or not found_at(book, CellPosition(title, row, number)).is_blank
    ]
    if column not in shown:
        shown = sorted([*shown, column])
    at = shown.index(column)
    # The first column names the row.
    shown = [one for k, one in enumerate(shown) if k == 0 or abs(k - at) <= _BESIDE]
    return {
        "number": row,
        "heads": [_text(book, title, header, number) if header else "" for number in shown],
        "cells": [_text(book, title, row, number) for number in shown],
        "at": shown.index(column),
    }


def _headed(book: OpenBook, sheet: Worksheet, row: int, column: int) -> tuple[int, Sequence[int]]:
    """Return the row of the headings above a cell or in it, 0 for none, and the columns to show."""
    for section in (s for s in SECTIONS if s.is_table and s.sheet == sheet.title):
        try:
            table = find_table(book, section)
        except InputError:
            continue
        numbers = sorted(c.number for c in table.columns.values())
        if row in {table.heading.row, *table.rows} and numbers:
            return table.heading.row, numbers[:_MOST_COLUMNS]
    last = min(sheet.max_column, _MOST_COLUMNS)
    return 0, range(1, max(last, column if column <= _MOST_COLUMNS else 1) + 1)


def _text(book: OpenBook, title: str, row: int, column: int) -> str:
    return cut(found_at(book, CellPosition(title, row, column)).shown)


KEPT_PROJECTS, KEPT_ANSWERS = 3, 8
"""Projects with their assessments that a process keeps, and assessments at other values."""

_CLEARANCE = "clearance"  # the slider that changes no run
_AS_TYPED = "{}"  # the key of values that change nothing

Json = Mapping[str, Any]


def perform(job: Json) -> Json:
    """Do a job named by its key `do`, and return its answer, or its problems.

    Beside a complete answer is its `reference`, which the jobs of sliders that move get.

    Workbooks that are wrong, and values that no workbook can have, are problems; anything else is
    an internal error and is raised.
    """
    workbook = Path(job["workbook"])
    try:
        reply = {"answer": _JOBS[job["do"]](workbook, job)}
        is_complete = job["do"] in ("state", "assess") and not job.get("moving")
        if is_complete and not reply["answer"].get("problems"):
            key = _key(workbook, job.get("values", {}))
            reply["reference"] = reference_of(_complete(workbook, key))
        return reply
    except InputError as error:
        return {"problems": problems(workbook, error)}


def state(workbook: Path, job: Json) -> Json:
    """Return everything about a project at the values of its workbook."""
    try:
        opened = _open(workbook)
    except InputError as error:
        reply = {"project": None, "problems": problems(workbook, error), "answer": None}
        return {**reply, "lacks": _lacks(workbook), "drawing": _drawing(workbook)}
    near = [pair for pair in _as_typed(workbook).pairs if pair.kind is not NearbyKind.BARE_EDGE]
    answered = answer_at(workbook, {"values": {}, "moving": False, "room": USUAL_PX})
    return {
        "project": {
            "name": opened.sheet.project.project.name,
            "sha256": opened.sheet.sha256,
            "id": opened.id,
        },
        "lacks": ["clearances"] if any(pair.is_missing for pair in near) else [],
        "problems": [],
        "drawing": _drawing(workbook),
        "warnings": [line["text"] for line in answered["reasons"] if line["level"] == "warning"],
        **controls(opened),
        "views": {
            "arrays": [array.id for array in opened.sheet.project.arrays],
            "motions": [motion.id for motion in opened.shaking.motions],
        },
        "answer": answered,
    }


def _lacks(workbook: Path) -> list[str]:
    """Return which sheets a workbook has without a row; none where it cannot be read."""
    try:
        sheet = read(workbook)
    except InputError:
        return []
    steps = ("arrays", "motions")
    return [name for name in steps if name not in sheet.unfound and not sheet.draft[name]]


def answer_at(workbook: Path, job: Json) -> Json:
    """Return the answer at values: of the largest runs while a slider moves, else complete."""
    opened = _given(workbook, _key(workbook, job["values"]))
    if job["moving"]:
        known, has_same_motions = (
            job.get("reference", {}),
            opened.shaking is _open(workbook).shaking,
        )
        accepted = _acceptance(workbook) if has_same_motions else None
        reply = anticipate(opened.sheet, opened.shaking, known, accepted)
    else:
        reply = _at_rest(workbook, job["values"], is_whole=job.get("whole", True))
    shows = answer(reply, is_provisional=job["moving"], room_px=job["room"])
    return {**shows, "shown": shown(opened)}


def prepare(workbook: Path, _: Json) -> Json:
    """Read a workbook and move its sliders once, before anyone does."""
    with suppress(InputError):  # which the state tells
        opened = _open(workbook)
        # One orientation of each motion will do: nobody sees the answer.
        names = {motion.id: [motion.orientations[0].name] for motion in opened.shaking.motions}
        known = {array.id: names for array in opened.sheet.project.arrays}
        job = {"values": {}, "moving": True, "room": USUAL_PX, "reference": known}
        answer_at(workbook, job)
    return {}


def _drawing(workbook: Path) -> Json | None:
    """Return the first DXF beside a workbook, with what its layers may be; None for none."""
    if (path := next(_drawings(workbook), None)) is None:
        return None
    found = {"name": path.name, "kinds": list(LayerKind), "units": list(LENGTHS)}
    try:
        drawn, known = read_dxf(path), known_layers(layers_of(read(workbook).draft))
    except InputError as error:
        return {**found, "refused": error.problems[0]}
    layers = sorted({line.layer for line in drawn.lines})
    return {
        **found,
        "unit": drawn.unit,
        "layers": [
            {
                "layer": layer,
                "drawn": drawn_on(drawn, layer),
                "kind": known.get(layer.casefold()) or proposed(layer) or LayerKind.NOT_READ,
            }
            for layer in layers
        ],
    }


def _drawings(workbook: Path) -> Iterator[Path]:
    return (path for path in sorted(workbook.parent.iterdir()) if path.suffix.lower() == ".dxf")


def read_plan(workbook: Path, job: Json) -> Json:
    """Fill in the plan of a workbook from the drawing beside it; keep a copy at another path.

    Places that are filled are replaced: what was sent stays as it is where it came from. Without a
    unit the drawing is read in the one that it states, which may be asked about. Answers with the
    lines of `plan read` on what moved, what is lost and what was not read.
    """
    drawn = read_dxf(next(_drawings(workbook)), LENGTHS.get(job["unit"]))
    unit = job["unit"] or drawn.unit
    if unit not in LENGTHS:
        raise InputError("nobody says the unit of the drawing; choose it")
    change = WorkbookChange(open_book(workbook))
    layers = {layer: LayerKind(kind) for layer, kind in json.loads(job["layers"]).items()}
    draft = read_book(change.book).draft
    is_given = job["unit"] != ""
    told, layers = plan_as_rows(drawn, LENGTHS[unit], draft, layers, is_unit_given=is_given)
    cells, lines = changes(change.book, told, layers, replace=True)
    change.fill(cells)
    lines = [*filter(None, (drawn.repairs,)), *unread(told.plan), *lines, *withdrawn(change)]
    # One is opened, and one stays to be saved when the other has been replaced.
    for path in (workbook, Path(job["to"])):
        path.write_bytes(change.book.data)
    return {"lines": lines}


def write(workbook: Path, job: Json) -> Json:
    """Write the workbook that is assessed at values to another path."""
    given = _given(workbook, _key(workbook, job["values"]))
    cells_of = cells(given.sheet, given.typed)
    data = workbook.read_bytes()
    Path(job["to"]).write_bytes(changed(data, cells_of) if cells_of else data)
    return {}


def add_clearances(workbook: Path, job: Json) -> Json:
    """Write the workbook with the clearances that it lacks to another path."""
    added, _ = missing_rows(_open(workbook).sheet, _as_typed(workbook).arrays)
    change = WorkbookChange(open_book(workbook))
    change.fill(added)
    withdrawn(change)
    Path(job["to"]).write_bytes(change.book.data)
    return {}


def verdict(workbook: Path, job: Json) -> Json:
    """Return the verdict at values, which less friction changes only where it is OK."""
    found = _at_rest(workbook, job["values"], is_whole=False).verdict
    # Less friction turns an OK into one with conditions, and nothing else.
    if found is Verdict.OK:
        found = _at_rest(workbook, job["values"]).verdict
    return stamp(found, found.value)


def _view(draw: Callable[[Assessment, Json], Json]) -> Callable[[Path, Json], Json]:
    # No view shows what less friction would change.
    return lambda workbook, job: draw(_at_rest(workbook, job["values"], is_whole=False), job)


_JOBS: Mapping[str, Callable[[Path, Json], Json]] = {
    "state": state,
    "assess": answer_at,
    "prepare": prepare,
    "write": write,
    "add_clearances": add_clearances,
    "read_plan": read_plan,
    "verdict": verdict,
    "slide": _view(lambda a, job: views.slide(a, job["array"], job["motion"], job["run"])),
    "contour": _view(lambda a, job: views.contour(a, job["array"])),
    "paths": _view(lambda a, job: views.paths(a, job["array"])),
}


@lru_cache(KEPT_PROJECTS)
def _open(workbook: Path) -> Opened:
    return opened(workbook)


def _at_rest(workbook: Path, values: Values, *, is_whole: bool = True) -> Assessment:
    """Return the complete assessment at values; unless whole, without less friction."""
    key = _key(workbook, values)
    return _whole(workbook, key) if is_whole else _complete(workbook, key)


def _key(workbook: Path, values: Values) -> str:
    """Return checked values as JSON; those as typed are the same as none."""
    opened = _open(workbook)
    check(opened, values)
    known = controls(opened)
    typed_ = {item["id"]: item["typed"] for item in (*known["sliders"], *known["choices"])}
    other = {name: value for name, value in values.items() if value != typed_.get(name)}
    return json.dumps(other, sort_keys=True)


@lru_cache(KEPT_ANSWERS)
def _given(workbook: Path, key: str) -> Opened:
    """Return a project at values, given as JSON."""
    opened, values = _open(workbook), json.loads(key)
    # Values that differ in clearances alone share the motions.
    near = _given(workbook, _wider(values)) if _CLEARANCE in values else opened
    return with_values(opened, values, near)


@lru_cache(KEPT_PROJECTS)
def _acceptance(workbook: Path) -> Acceptance:
    """Return the limits on the motions as typed, which friction and slope do not change."""
    opened = _open(workbook)
    return shaking_acceptance(opened.shaking, targets(opened.sheet.project))


def _complete(workbook: Path, key: str) -> Assessment:
    """Return the assessment at values, given as JSON; other than typed, without less friction."""
    return _as_typed(workbook) if key == _AS_TYPED else _assessment(workbook, key)


@lru_cache(KEPT_PROJECTS)
def _as_typed(workbook: Path) -> Assessment:
    """Return the assessment from which others start: no other values drive it out."""
    opened = _open(workbook)
    return assess(opened.sheet, opened.shaking)


@lru_cache(KEPT_ANSWERS)
def _assessment(workbook: Path, key: str) -> Assessment:
    given, values, former = _given(workbook, key), json.loads(key), None
    if _CLEARANCE in values:
        former = _complete(workbook, _wider(values))
    elif given.shaking is _open(workbook).shaking:  # friction and slope: no motion
        former = _as_typed(workbook)
    return assess(given.sheet, given.shaking, former, is_whole=False)


@lru_cache(KEPT_ANSWERS)
def _whole(workbook: Path, key: str) -> Assessment:
    given, found, values = _given(workbook, key), _complete(workbook, key), json.loads(key)
    # As typed it has been compared already.
    if found.at_reduced_friction is not None:
        return found
    former = _whole(workbook, _wider(values)) if _CLEARANCE in values else found
    return assess(given.sheet, given.shaking, former)


def _wider(values: Values) -> str:
    """Return values as JSON, with the clearances of the workbook."""
    return json.dumps({name: value for name, value in values.items() if name != _CLEARANCE})
