"""Which row of a workbook each outline of a drawing is: by its name in the drawing, or by place.

Writes nothing (`report.drawing.fill`). Read `matched`.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from report.drawing.plan_read import DrawnOutline, RoofPlan, free_name
from report.sheet.checking.grouped import listed
from report.sheet.checking.plan_checks import shapes_of, us_first
from report.sheet.schema.choices import LayerKind
from report.sheet.schema.fields import Draft, DraftRow
from report.sheet.schema.scene import DRAWING, DRAWN_MODULES
from report.sheet.schema.shapes import Shape, gap_m, mean, solid
from report.words.formats import aligned
from report.words.units import Quantity, Unit
from solver.model import InputError

_LEAST_SHARE = 0.05
"""Common share of two outlines, of all that either covers, by which they may be the same."""
_RENAMED_SHARE = 0.9  # the same, of an outline that the drawing calls by a name of its own
_PLAIN = 2.0  # a row is told from another by this times its share, or its part of the distance
_SAME_M = 0.05  # sizes that differ by less are the same
MOST_TOLD = 20
"""Most outlines of a kind that cannot be told and are named."""
_STILL_M = 1e-3  # what has moved by less has not
_ARRAY, _OBJECT, _EDGE = "array", "object", "edge"

Pairs = Mapping[tuple[int, str], float]  # how well an outline, by its number, is a row


@dataclass(frozen=True, slots=True, kw_only=True)
class MatchedPlan:
    """A plan with the names of the rows of a workbook.

    Attributes
    ----------
    plan : RoofPlan
        As drawn, but for its names.
    gone, typed : tuple of str
        Rows with a place that is not in the drawing: from a former one, and typed.
    before : mapping of str to Shape
        Where the rows were.
    rows : mapping of str to DraftRow
        As they were.
    unit : Unit
        Of the table of moves.
    """

    plan: RoofPlan
    gone: tuple[str, ...]
    typed: tuple[str, ...]
    before: Mapping[str, Shape]
    rows: Mapping[str, DraftRow]
    unit: Unit

    def lines(self, *, replace: bool) -> Iterator[str]:
        """Yield what moved, is new or is gone as a table, and modules that are not drawn.

        At first, when nothing was in plan, there is no table.

        Parameters
        ----------
        replace : bool
            Whether rows that are gone are taken out.
        """
        now = {place.name: place.shape for place in (*self.plan.arrays, *self.plan.objects)}
        moves = []
        for name in {**self.before, **now} if self.before else ():
            was, shape = self.before.get(name), now.get(name)
            if was and shape and solid(was).hausdorff_distance(solid(shape)) < _STILL_M:
                continue
            stays = "stays as typed" if name in self.typed else "stays without --replace"
            gone = f"not in the drawing; {'taken out' if replace and name in self.gone else stays}"
            from_, to = (_place(each, self.unit) if each else "" for each in (was, shape))
            moves.append((name, from_ or "new", to or gone))
        yield from aligned([("name", "from", "to"), *moves]) if moves else ()
        for place in self.plan.arrays:
            row = self.rows.get(place.name, {})
            if not place.modules and (count := row.get("modules")):
                is_drawn = row.get("place_from") == DRAWN_MODULES
                what = "taken out, as they are not drawn" if is_drawn else "stay as typed"
                yield f"{place.name}: {count} modules {what}"


def matched(plan: RoofPlan, draft: Draft) -> MatchedPlan:
    """Return a plan with the names of the rows of a workbook.

    An outline with the name of a row in the drawing is that row. The others are told by place among
    the rows that are left: by what they have in common, then by the nearest center of the same
    size. What is left is new.

    Raises
    ------
    InputError
        With the candidates, for what cannot be told.
    """
    given = [*draft["arrays"], *draft["objects"]]
    rows = {row["id"]: row for row in given if "id" in row}
    groups = {row["id"]: _group(row.get("kind", "")) for row in draft["objects"] if "id" in row}
    before = shapes_of(draft)
    drawn = (*plan.arrays, *plan.objects)
    by_name = {(groups.get(name, _ARRAY), name.casefold()): name for name in before}
    found = {
        number: by_name[key]
        for number, place in enumerate(drawn)
        if (key := (_group(place.kind), place.name.casefold())) in by_name and not place.unnamed
    }
    unit = Quantity.PLAN.us if us_first(draft) else Quantity.PLAN.si
    unclear: list[str] = []
    for group in (_ARRAY, _OBJECT, _EDGE):
        numbers = [k for k, place in enumerate(drawn) if _group(place.kind) == group]
        names = [name for name in before if groups.get(name, _ARRAY) == group]
        for score in (_common, _near if group == _EDGE else _same_sized):
            pairs = {
                (k, name): value
                for k in numbers
                for name in names
                if k not in found and name not in found.values()
                if (value := score(drawn[k], before[name])) > 0.0
            }
            unclear += _tell(pairs, drawn, found, unit)
        left = [name for name in names if name not in found.values() and _is_drawn(rows[name])]
        new = [k for k in numbers if k not in found and drawn[k].unnamed and drawn[k].handle]
        if left and new and not unclear:
            unclear.append(_either([drawn[k] for k in new], left, unit) + ", or new")
    if unclear:
        raise InputError([f"{text}: write its name inside of it as a text" for text in unclear])
    lost = [name for name in before if name not in found.values()]
    return MatchedPlan(
        plan=_renamed(plan, found, before, rows),
        gone=tuple(name for name in lost if _is_drawn(rows[name])),
        typed=tuple(name for name in lost if not _is_drawn(rows[name])),
        before=before,
        rows=rows,
        unit=unit,
    )


def _group(kind: str) -> str:
    return _ARRAY if kind == LayerKind.ARRAY else _EDGE if kind.startswith("edge") else _OBJECT


def _is_drawn(row: DraftRow) -> bool:
    return str(row.get("place_from", "")).startswith(DRAWING)


def _common(place: DrawnOutline, row: Shape) -> float:
    """Return the share that an outline has in common with a row; 0 if too small to be it."""
    if gap_m(place.shape.bounds, row.bounds) >= 0.0:
        return 0.0
    one, other = solid(place.shape), solid(row)
    share: float = one.intersection(other).area / one.union(other).area
    return share if share >= (_LEAST_SHARE if place.unnamed else _RENAMED_SHARE) else 0.0


def _near(place: DrawnOutline, row: Shape) -> float:
    """Return how near the center of an outline without a name is to that of a row [1/m]."""
    far_m = math.dist(mean(place.shape.bounds.points), mean(row.bounds.points))
    return 1.0 / max(far_m, _STILL_M) if place.unnamed else 0.0


def _same_sized(place: DrawnOutline, row: Shape) -> float:
    """Return the same of an outline of the same size; 0 for another."""
    sizes = ((b.x_to_m - b.x_from_m, b.y_to_m - b.y_from_m)
             for b in (place.shape.bounds, row.bounds))  # fmt: skip
    is_same = all(abs(a - b) < _SAME_M for a, b in zip(*sizes, strict=True))
    return _near(place, row) if is_same else 0.0


def _tell(
    pairs: Pairs, drawn: Sequence[DrawnOutline], found: dict[int, str], unit: Unit
) -> Iterator[str]:
    """Add the rows that are plain, the best first, and yield what is not, as far as it is told."""
    told = 0
    while pairs and told < MOST_TOLD:
        number, name = best = max(pairs, key=pairs.__getitem__)
        rivals = [
            (k, row)
            for (k, row), value in pairs.items()
            if (k == number) != (row == name) and value * _PLAIN > pairs[best]
        ]
        # A side of the roof that cannot be told is new: its name cannot be drawn.
        if not rivals or drawn[number].handle:
            found[number] = name
        if rivals and drawn[number].handle:
            told += 1
            numbers, names = ({*each} for each in zip(best, *rivals, strict=True))
            yield _either([drawn[k] for k in sorted(numbers)], sorted(names), unit)
        pairs = {p: value for p, value in pairs.items() if p[0] != number and p[1] != name}


def _either(places: Sequence[DrawnOutline], names: Sequence[str], unit: Unit) -> str:
    shown = (f"{place.handle or place.kind.value} ({_place(place.shape, unit)})"
             for place in places)  # fmt: skip
    return f"{listed(shown)} may be {listed(names).replace(', ', ' or ')}"


def _renamed(
    plan: RoofPlan,
    found: Mapping[int, str],
    before: Mapping[str, Shape],
    rows: Mapping[str, DraftRow],
) -> RoofPlan:
    drawn = (*plan.arrays, *plan.objects)
    taken = {name.casefold() for name in before}
    taken |= {place.name.casefold() for place in drawn if not place.unnamed}
    counts: Counter[LayerKind] = Counter()
    named = []
    for number, place in enumerate(drawn):
        if number not in found:
            name = free_name(place.kind, counts, taken) if place.unnamed else place.name
            named.append(replace(place, name=name))
            continue
        name = found[number]
        is_written = not place.unnamed and place.name.casefold() == name.casefold()
        other = f"'{place.name}' in the drawing" if not place.unnamed else "by its place"
        place = replace(place, name=name, unnamed="" if is_written else other)
        # A side of the roof has no parapet unless the row says so.
        is_assumed = not place.handle and "kind" in rows[name]
        kind = LayerKind(rows[name]["kind"].value) if is_assumed else place.kind
        named.append(replace(place, kind=kind, note="" if is_assumed else place.note))
    count = len(plan.arrays)
    return replace(plan, arrays=tuple(named[:count]), objects=tuple(named[count:]))


def _place(shape: Shape, unit: Unit) -> str:
    box = shape.bounds
    sides = ((box.x_from_m, box.x_to_m), (box.y_from_m, box.y_to_m))
    x, y = (" to ".join(f"{end / unit.si:.{unit.decimals}f}" for end in side) for side in sides)
    return f"x {x}, y {y} {unit.symbol}"
