"""What a block of the workbook states of several parts."""

from __future__ import annotations

from typing import NamedTuple

from report.assessment.design.words import NOT_GIVEN
from report.project.model.place import Place


class StatedParts(NamedTuple):
    """What a block states of several parts, and the cells of those that it lacks."""

    found: str
    missing: tuple[Place, ...]


def stated(section: str, **parts: tuple[str, object]) -> StatedParts:
    """Return what a block states of its parts, each a name and a value by its field."""
    values = [str(value) for _, value in parts.values() if value]
    missing = {field: name for field, (name, value) in parts.items() if not value}
    lacks = [f"{', '.join(missing.values())} missing"] if missing else []
    found = "; ".join([*values, *lacks]) if values else NOT_GIVEN
    return StatedParts(found, tuple(Place(section, 0, field) for field in missing))
