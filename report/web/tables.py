"""An entity as rows of a table of the page: short texts, with both systems of units as titles.

Headings, quantities and digits are those of its fields, as in the package. Read `cells`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from report.assessment.verdict import Verdict
from report.entities.columns import UnitFormat
from report.entities.shown import Entity, shown_by

Cell = Mapping[str, str]
ShowVerdict = Callable[[Verdict], Cell | None]


def stamp(verdict: Verdict, text: str = "") -> Cell:
    """Return a verdict and its look; that on the project as a text."""
    return {"text": text or verdict, "look": verdict.name.lower()}


def heads(model: type[Entity], names: str, **others: str) -> list[str]:
    """Return the headings of fields, or others by field."""
    return [others.get(name, shown_by(model, name).head) for name in names.split()]


def cells(row: Entity, names: str, fmt: UnitFormat, **others: Cell | None) -> list[Cell | None]:
    """Return the cells of fields, or others by field; none for a verdict that is not known yet."""
    return [others[n] if n in others else _cell(row, n, fmt) for n in names.split()]


def _cell(row: Entity, name: str, fmt: UnitFormat) -> Cell:
    text, both = row.short(name, fmt), row.both(name, fmt)
    return {"text": text} if both == text else {"text": text, "title": both}
