"""Computations for the page: each job from a workbook and values to data for JSON.

A process of the page runs `perform`, and this module is imported there alone: the server starts
without the solver. Knows no request. Read `perform`, then `answer_at`.
"""

from __future__ import annotations

import json
import traceback
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from functools import lru_cache
from pathlib import Path
from typing import Any

from report.assessment.assess import Extent
from report.assessment.assessment import Assessment
from report.assessment.design.verdict import Verdict
from report.assessment.plan.missing_rows import missing_rows
from report.assessment.plan.neighbors import NearbyKind
from report.drawing_read.fill import fill_plan, layers_of, plan_as_rows, unread
from report.drawing_read.layer_names import drawn_on, proposed
from report.drawing_read.plan_read import known_layers
from report.project.model.choices import LayerKind, UnitsFirst
from report.project.read.archive import open_book
from report.project.read.changed_cells import changed
from report.project.read.read import read, read_book
from report.project.read.what_if import cells
from report.project.write.filled import WorkbookChange, withdrawn
from report.project.write.template import template
from report.provenance.release import version
from report.text.grouping import grouped_by
from report.text.units import LENGTHS
from report.web import views
from report.web.answers import answer
from report.web.controls import shown
from report.web.fields import problems, tables, typed_cells
from report.web.open_project import OpenProject, open_project, reference_of
from report.web.parts import drawn, parts
from report.web.plan import USUAL_PX, stamp
from report.web.worker import INTERNAL, is_full
from solver.errors import InputError

KEPT_PROJECTS = 3
"""Projects that a process keeps, with their assessments."""

Json = Mapping[str, Any]


def perform(job: Json) -> Json:
    """Do a job named by its key `do`, and return its answer, or the reason for a failure.

    Beside a complete answer is its `reference`, which the jobs of sliders that move get. Workbooks
    that are wrong, and values that no workbook can have, are problems; anything else is an internal
    error and is printed.
    """
    workbook = Path(job["workbook"])
    try:
        reply = {"answer": _JOBS[job["do"]](workbook, job)}
        is_complete = job["do"] in ("state", "assess") and not job.get("moving")
        if is_complete and not reply["answer"].get("problems"):
            opened = _open(workbook).at(job.get("values", {}))
            reply["reference"] = reference_of(opened.assessed(Extent.AS_GIVEN))
        return reply
    except InputError as error:
        return {"problems": problems(workbook, error)}
    except Exception as error:
        if isinstance(error, OSError) and is_full(error):
            return {"errno": error.errno}
        traceback.print_exc()
        return {"problems": [], "refused": INTERNAL}


def state(workbook: Path, job: Json) -> Json:
    """Return everything about a project at the values of its workbook."""
    try:
        opened = _open(workbook)
    except InputError as error:
        rows = problems(workbook, error)
        by_remedy = grouped_by(rows, lambda row: (row["sheet"], row["remedy"] or row["text"]))
        return {
            "project": None,
            "answer": None,
            "problems": rows,
            "html": {
                "problems": parts().problems(
                    [(group[0], group[1:]) for group in by_remedy.values()]
                ),
                "fields": parts().fields(tables(workbook)),
            },
            "lacks": _lacks(workbook),
            "drawing": _drawing(workbook),
        }
    near = [
        pair for pair in opened.assessed(Extent.OPEN).pairs if pair.kind is not NearbyKind.BARE_EDGE
    ]
    return {
        "project": {
            "name": opened.sheet.project.project.name,
            "sha256": opened.sheet.sha256,
            "id": opened.id,
            "software": f"Roofslip {version()}",
        },
        "lacks": [
            *(["motions"] if not opened.shaking.motions else []),
            *(["clearances"] if any(pair.is_missing for pair in near) else []),
        ],
        "problems": [],
        "drawing": _drawing(workbook),
        **opened.controls,
        "views": {
            "arrays": [array.id for array in opened.sheet.project.arrays],
            "motions": [motion.id for motion in opened.shaking.motions],
        },
        "answer": answer_at(workbook, {"values": {}, "moving": False, "room": USUAL_PX}),
    }


def _lacks(workbook: Path) -> list[str]:
    """Return whether a workbook with errors has no array; nothing where it cannot be read."""
    with suppress(InputError):
        sheet = read(workbook)
        return [] if "arrays" in sheet.unfound or sheet.inputs["arrays"] else ["arrays"]
    return []


def answer_at(workbook: Path, job: Json) -> Json:
    """Return the answer at values: from the largest runs while a slider moves, else complete."""
    opened = _open(workbook).at(job["values"])
    if job["moving"]:
        reply = opened.moving(job.get("reference", {}))
    else:
        reply = opened.assessed(Extent.OPEN if job.get("whole", True) else Extent.AS_GIVEN)
    result = answer(reply, is_provisional=job["moving"], room_px=job["room"])
    return {**drawn(result), "shown": shown(opened)}


def prepare(workbook: Path, _: Json) -> Json:
    """Read a workbook and move its sliders once, before anyone does."""
    with suppress(InputError):  # which the state tells
        opened = _open(workbook)
        # One orientation of each motion will do: nobody sees the answer.
        prds = {m.id: {m.orientations[0].name: 1.0} for m in opened.shaking.motions}
        known = {array.id: prds for array in opened.sheet.project.arrays}
        job = {"values": {}, "moving": True, "room": USUAL_PX, "reference": known}
        answer_at(workbook, job)
    return {}


def _drawing(workbook: Path) -> Json | None:
    """Return the first DXF beside a workbook, with what its layers may be; None for none."""
    if (path := next(_drawings(workbook), None)) is None:
        return None
    from report.drawing_read.read_dxf import read_dxf  # with ezdxf, half a second

    drawing: dict[str, Any] = {"name": path.name, "kinds": list(LayerKind), "units": list(LENGTHS)}
    try:
        drawn_file, known = read_dxf(path), known_layers(layers_of(read(workbook).inputs))
    except InputError as error:
        drawing["refused"] = error.problems[0]
    else:
        layers = sorted({line.layer for line in drawn_file.lines})
        unit = drawn_file.unit
        drawing["stated"] = f"{unit}, as the drawing states" if unit else "choose"
        drawing["layers"] = [
            {
                "layer": layer,
                "drawn": drawn_on(drawn_file, layer),
                "kind": known.get(layer.casefold()) or proposed(layer) or LayerKind.NOT_READ,
            }
            for layer in layers
        ]
    return {"name": path.name, "html": parts().drawing(drawing)}


def _drawings(workbook: Path) -> Iterator[Path]:
    return (path for path in sorted(workbook.parent.iterdir()) if path.suffix.lower() == ".dxf")


def read_plan(workbook: Path, job: Json) -> Json:
    """Write a workbook with its plan from the drawing beside it to another path.

    Places that are filled are replaced: what was sent stays as it is where it came from. Without a
    unit the drawing is read in the one that it states, which may be asked about. Answers with the
    lines of `plan read` on what moved, what is lost and what was not read.
    """
    from report.drawing_read.read_dxf import read_dxf  # with ezdxf, half a second

    drawn = read_dxf(next(_drawings(workbook)), LENGTHS.get(job["unit"]))
    unit = job["unit"] or drawn.unit
    if unit not in LENGTHS:
        raise InputError("the drawing does not state its unit; select it")
    change = WorkbookChange(open_book(workbook))
    layers = {layer: LayerKind(kind) for layer, kind in json.loads(job["layers"]).items()}
    inputs = read_book(change.book).inputs
    is_given = job["unit"] != ""
    plan, layers = plan_as_rows(drawn, LENGTHS[unit], inputs, layers, is_unit_given=is_given)
    lines = fill_plan(change, plan, layers, replace=True)
    lines = [*filter(None, (drawn.repairs,)), *unread(plan), *lines, *withdrawn(change)]
    Path(job["to"]).write_bytes(change.book.data)
    return {"lines": lines}


def fill_in(workbook: Path, job: Json) -> Json:
    """Write the workbook with cells as typed on the page to another path."""
    change = WorkbookChange(open_book(workbook))
    change.fill(typed_cells(json.loads(job["cells"])))
    withdrawn(change)
    Path(job["to"]).write_bytes(change.book.data)
    return {"lines": []}


def blank(_: Path, job: Json) -> Json:
    """Write a workbook without inputs to a path."""
    Path(job["to"]).write_bytes(template(UnitsFirst(job["units"])))
    return {}


def write(workbook: Path, job: Json) -> Json:
    """Write the workbook that is assessed at values to another path."""
    opened = _open(workbook).at(job["values"])
    cells_of = cells(opened.sheet, opened.typed)
    data = workbook.read_bytes()
    Path(job["to"]).write_bytes(changed(data, cells_of) if cells_of else data)
    return {}


def add_clearances(workbook: Path, job: Json) -> Json:
    """Write the workbook with the clearances that it lacks to another path."""
    opened = _open(workbook)
    added, _ = missing_rows(opened.sheet, opened.assessed(Extent.AS_GIVEN).arrays)
    change = WorkbookChange(open_book(workbook))
    change.fill(added)
    withdrawn(change)
    Path(job["to"]).write_bytes(change.book.data)
    return {}


def verdict(workbook: Path, job: Json) -> Json:
    """Return the verdict at values, which less friction changes only where it is OK.

    While a search moves it is provisional: NG where the largest runs alone are.
    """
    opened, reference = _open(workbook).at(job["values"]), job.get("reference", {})
    if job.get("moving"):
        result = opened.moving(reference).verdict
        return stamp(result, result.value)
    # The runs that may govern refute values without the others, half of all.
    result = opened.of_governing(reference).verdict
    if result is not Verdict.NG:
        result = opened.assessed(Extent.AS_GIVEN).verdict
    # Less friction turns an OK into one with conditions, and nothing else.
    if result is Verdict.OK:
        result = opened.assessed(Extent.LESS_FRICTION).verdict
    return stamp(result, result.value)


def _view(draw: Callable[[Assessment, Json], Json]) -> Callable[[Path, Json], Json]:
    # No view shows what less friction would change.
    def view(workbook: Path, job: Json) -> Json:
        return draw(_open(workbook).at(job["values"]).assessed(Extent.AS_GIVEN), job)

    return view


_JOBS: Mapping[str, Callable[[Path, Json], Json]] = {
    "state": state,
    "assess": answer_at,
    "prepare": prepare,
    "write": write,
    "add_clearances": add_clearances,
    "read_plan": read_plan,
    "fill_in": fill_in,
    "tables": lambda workbook, _: {"html": {"fields": parts().fields(tables(workbook))}},
    "blank": blank,
    "verdict": verdict,
    "slide": _view(lambda a, job: views.slide(a, job["array"], job["motion"], job["run"])),
    "contour": _view(lambda a, job: views.contour(a, job["array"])),
}


@lru_cache(KEPT_PROJECTS)
def _open(workbook: Path) -> OpenProject:
    return open_project(workbook)
