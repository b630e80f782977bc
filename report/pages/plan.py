"""The part with the roof plan: the drawing's layout, its tables, what is near, and the parapets."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from report.assessment.design.friction import mus_words
from report.assessment.design.verdict import Verdict
from report.assessment.plan.neighbors import Cover, PlanNeighbor
from report.assessment.support.plan_gaps import plan_gaps
from report.document.columns import ColumnHead, length, provided, words
from report.document.tables import (
    LONG_NAME,
    NARROW_WORD,
    WHOLE_ROWS,
    Table,
    grouped,
    listed,
    merged,
    part_of,
)
from report.drawing.plan_tables import Schedule, alike_arrays
from report.drawing.sheet import unit_format
from report.pages.clearance_tables import (
    NumberedGap,
    neighbor_table,
    numbered_gaps,
    plan_schedule,
)
from report.pages.parts import PackageData
from report.project.model.array import Array
from report.project.model.choices import ObjectKind
from report.project.model.roof import RoofObject
from report.project.model.shapes import Polygon, Shape
from report.text.counts import spelled
from report.text.grouping import grouped_by
from report.text.names import ranged
from report.text.unit_format import UnitFormat
from report.text.units import Quantity, number
from solver.rules.provisions import Neighbor

# Letters of names for which there is room in half the width of a sheet.
SHORT_NAME = 8
# Rows of arrays, and clearances, for which there is room above a plan that begins a sheet.
_SHORT_TABLE = 10
# Names that a sentence lists; those after them are counted.
_MOST_NAMES = 6
# Of pairs whose clearance is not given, or not as in the plan: the others need no table.
_APART = {Cover.SHORT, Cover.SUFFICIENT, Cover.DIFFERS}


def page(package: PackageData) -> Mapping[str, object]:
    """Return the tables and notes next to the plan, and their arrangement."""
    done, data = package.assessment, package.data
    printed, rules = package.printed_plan, done.rules
    # In one unit, as the drawings: the tables and the plan are read side by side.
    fmt = replace(unit_format(done), systems=1, none="none")
    gaps, arrays = numbered_gaps(done), alike_arrays(done, fmt)
    apart = [pair for pair in done.neighbors if pair.cover in _APART]
    is_short = 1 <= len(gaps) <= _SHORT_TABLE and len(arrays) <= _SHORT_TABLE
    has_short_names = all(len(name) <= SHORT_NAME for gap in gaps for name in gap.check.between)
    is_abreast = is_short and has_short_names
    if printed.size.sheet:
        places_first = not apart
    else:
        # Places precede a drawing that begins a sheet, where little else does or where it leaves
        # room before it.
        is_little = len(gaps) + len(arrays) <= 4
        places_first = bool(apart) or (is_short and not is_abreast) or is_little
    if rules["parapet_over_cg_in"]:
        over_cg = (
            f"at least {package.rule_length('parapet_over_cg_in')} above the center of gravity"
        )
        over_cg += " of the array"
    else:
        mark = package.marks.of("parapet_over_cg_in")
        over_cg = f"not below the center of gravity of the array{mark}"
    return {
        "sheet": printed.size.sheet,
        "width_in": number(printed.size.wide, 2),
        "scale": printed.plan.scale.name,
        "project": data.project,
        "unnamed": _some(printed.unnamed),
        "is_abreast": is_abreast,
        "places_first": places_first,
        **_schedules(package, printed.beside, fmt),
        "arrays": [(row, max(map(len, row.ids.split())) > NARROW_WORD) for row in arrays],
        "is_array_table_short": len(arrays) <= WHOLE_ROWS,
        "size_unit": "ft" if fmt.us_first else "m",
        "length_unit": fmt.units()[0].symbol,
        "has_motions": done.has_motions,
        "friction": mus_words(data.arrays),
        "has_importance": rules.importance_in_separation,
        "has_objects": bool(data.objects),
        "has_outline": bool(data.roof.placed),
        **_places(package, fmt),
        **_distances(package, gaps),
        "parapets": merged(_parapets(package), "Arrays"),
        "parapet_height": package.rule_length("parapet_height_in"),
        "parapet_over_cg": over_cg,
        **_neighbors(package, apart),
    }


def _some(names: Sequence[object]) -> str:
    """Return a list of names, cut where it gets long."""
    count = len(names) - _MOST_NAMES
    further = f" and {count} more" if count > 0 else ""
    return ", ".join(str(name) for name in names[:_MOST_NAMES]) + further


_SCHEDULE = "Schedule of clearances"


def _schedules(package: PackageData, beside: Schedule, fmt: UnitFormat) -> Mapping[str, object]:
    """Return the schedule of clearances as it stands around the plan.

    Beside the plan are columns, the first maybe with the arrays above; the rest follows it.
    """
    schedule = plan_schedule(package, fmt)
    starts = [sum(beside.rows[:k]) for k in range(len(beside.rows))]
    parts = [
        part_of(schedule, start, start + count, is_narrow=True)
        for start, count in zip(starts, beside.rows, strict=True)
    ]
    captions = [_SCHEDULE, *[f"{_SCHEDULE}, continued"] * len(parts)]
    return {
        "schedule": schedule,
        "narrow_schedule": part_of(schedule, 0, is_narrow=True),
        "columns": list(zip(captions, parts, strict=False)),
        "has_arrays_beside": beside.has_arrays,
        "schedule_below": part_of(schedule, sum(beside.rows)),
        "caption_below": captions[1 if sum(beside.rows) else 0],
    }


def _places(package: PackageData, fmt: UnitFormat) -> Mapping[str, object]:
    """Return the location of everything in plan, and items placed by an outline or not at all."""
    done, data = package.assessment, package.data
    placed: Sequence[Array | RoofObject] = (*data.arrays, *data.objects)
    across = {gap.clearance.object for gap in done.clearances}
    return {
        "places": [half for half in _place_tables(package, fmt) if half.rows],
        # By id, with the number of vertices: the table of places has only the rectangle around.
        "outlined": ", ".join(
            f"{row.id} ({len(row.placed.points)} vertices)"
            for row in placed
            if isinstance(row.placed, Polygon)
        ),
        "unplaced": ", ".join(
            item.id for item in data.objects if item.placed is None and item.id not in across
        ),
    }


def _distances(package: PackageData, gaps: Sequence[NumberedGap]) -> Mapping[str, object]:
    """Return factors and bases of the distances, each with the numbers of its clearances."""
    done, marks = package.assessment, package.marks
    drawn = {gap.number for gap in plan_gaps(done)}
    factors = grouped_by(gaps, lambda gap: (gap.check.neighbor.value, gap.check.factor))
    bases = grouped_by(gaps, lambda gap: gap.check.basis.value)
    unpermitted = [item.id for item in done.arrays if not item.is_permitted]
    ids = {array.id for array in package.data.arrays}
    return {
        "n_gaps": len(gaps),
        # Of the same product arrays may still differ.
        "has_differing_arrays": any(
            gap.check.clearance.object in ids and gap.check.neighbor is not Neighbor.LIKE
            for gap in gaps
        ),
        "undrawn": _some([gap.number for gap in gaps if gap.number not in drawn]),
        "clauses": ", ".join(dict.fromkeys(marks.clause(gap.key) for gap in gaps)),
        "factors": "; ".join(
            f"{kind} {number(factor, 2)} (No. {_numbers(rows)})"
            for (kind, factor), rows in factors.items()
        ),
        "edge_minimum": package.rule_length("separation_edge_min_in")
        if any(gap.is_minimum_value for gap in done.clearances)
        else "",
        "bases": "; ".join(
            basis + (f" No. {_numbers(bases[basis])}" if len(bases) > 1 else "")
            for basis in sorted(bases)
        ),
        "has_unknown": any(gap.check.verdict is Verdict.NONE for gap in gaps),
        "unpermitted": ranged(unpermitted),
    }


def _numbers(gaps: Sequence[NumberedGap]) -> str:
    return ranged(str(gap.number) for gap in gaps)


def _neighbors(package: PackageData, apart: Sequence[PlanNeighbor]) -> Mapping[str, object]:
    """Return the pairs on the plan whose clearance differs from it, and the text on others."""
    done = package.assessment
    as_drawn = [
        str(row.number) for pair in done.neighbors if pair not in apart for row in pair.given
    ]
    beyond = [pair for pair in done.pairs if not pair.is_listed]
    nearest = min(beyond, key=lambda pair: pair.gap_m, default=None)
    is_all = len(as_drawn) == len(done.clearances) and not apart
    is_one = len(beyond) == 1
    return {
        "neighbors": neighbor_table(package, apart) if apart else None,
        "as_drawn": as_drawn and ("all" if is_all else f"No. {ranged(as_drawn)}"),
        "others": "The other pair on the plan is"
        if is_one
        else f"The other {spelled(len(beyond))} pairs on the plan are",
        "satisfy": "satisfies" if is_one else "satisfy",
        "nearest_are": ": " if is_one else "; the closest are ",
        "nearest": nearest
        and f"{nearest.array} and {nearest.other}, {package.fmt.both(nearest.gap_m)}",
    }


def _parapets(package: PackageData) -> Table:
    """Return the parapet of each clearance to an edge that has one, and whether it qualifies."""
    edges = {
        item.id: item.height_m
        for item in package.data.objects
        if item.kind is ObjectKind.EDGE_WITH_PARAPET and item.height_m is not None
    }
    arrays = {array.id: array.cg_height_m for array in package.data.arrays}
    columns = (
        (words("Parapet"), lambda row: row[0].object),
        (words("Arrays"), lambda row: row[0].array),
        (length("Top above the roof"), lambda row: row[1]),
        (length("Center of gravity"), lambda row: row[2]),
        (provided("Top above c.g."), lambda row: row[1] - row[2]),
        (words("Result", 1.3), lambda row: row[3]),
    )
    rows = [
        (
            gap.clearance,
            edges[gap.clearance.object],
            arrays[gap.clearance.array],
            "qualifies" if gap.neighbor is Neighbor.PARAPET else "does not qualify",
        )
        for gap in package.assessment.clearances
        if gap.clearance.object in edges
    ]
    return listed(rows, columns, package.fmt, kind="compact")


def _place_tables(package: PackageData, fmt: UnitFormat) -> Sequence[Table]:
    """Return where arrays, objects and roof edges are in plan, and how high the latter, halved."""
    data = package.data
    rows = [
        *((array.id, "array", None, array.placed) for array in data.arrays if array.placed),
        *((item.id, item.kind.value, item.height_m, item.placed) for item in data.objects),
    ]
    columns = (
        (words("Item", 1.1), lambda row: row[0]),
        (length("Height"), lambda row: "—" if row[2] is None else row[2]),
        (_in_plan("x from"), lambda row: _sides(row[3])[0]),
        (_in_plan("x to"), lambda row: _sides(row[3])[1]),
        (_in_plan("y from"), lambda row: _sides(row[3])[2]),
        (_in_plan("y to"), lambda row: _sides(row[3])[3]),
    )
    # Long names have no room in half the sheet: then all are in the first.
    is_short = max((len(row[0]) for row in rows), default=0) <= LONG_NAME
    middle = (len(rows) + 1) // 2 if is_short else len(rows)
    halves = rows[:middle], rows[middle:]
    return [grouped(grouped_by(half, lambda row: row[1]), columns, fmt) for half in halves]


def _sides(shape: Shape | None) -> tuple[Any, ...]:
    """Return x from, x to, y from and y to of the rectangle around a shape."""
    if shape is None:
        return ("—",) * 4
    box = shape.bounds
    return box.x_from_m, box.x_to_m, box.y_from_m, box.y_to_m


def _in_plan(head: str) -> ColumnHead:
    return ColumnHead(head=head, quantity=Quantity.PLAN)
