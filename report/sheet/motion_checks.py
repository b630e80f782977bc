"""Checks of the motions that look at more than one cell; each fault names the cell to change.

Works on a draft, as `checks` does, and reads no record.
"""

from __future__ import annotations

from collections.abc import Iterator

from report.sheet.fields import Draft, Fault, Place, Row, Where
from report.sheet.schema import Scaling

LABELS = {"record": "horizontal", "transverse": "transverse", "vertical": "vertical"}


def motion_faults(draft: Draft, where: Where) -> Iterator[Fault]:
    """Yield everything in the motions of a draft that contradicts itself."""
    for index, row in enumerate(draft["motions"]):
        yield from _same_component(index, row)
        yield from _scale_value(index, row)


def _same_component(index: int, row: Row) -> Iterator[Fault]:
    seen: dict[str, str] = {}
    for field, label in LABELS.items():
        if not row.get(field):
            continue
        first = seen.setdefault(" ".join(row[field].split()), label)
        if first != label:
            text = f"{label} record is '{row[field]}', as the {first} one; give its own"
            yield Fault(Place("motions", index, field), text)


def _scale_value(index: int, row: Row) -> Iterator[Fault]:
    scaling, place = row.get("scaling"), Place("motions", index, "scale_value")
    value = row.get("scale_value")
    if scaling is Scaling.AS_RECORDED and value not in (None, 1.0):
        text = f"factor or PPA is {value:g}, but scaling is 'as recorded'; choose a scaling or"
        yield Fault(place, f"{text} leave it blank")
    elif scaling in (Scaling.FACTOR, Scaling.PPA) and "scale_value" in row and value is None:
        wanted = "the PPA in g" if scaling is Scaling.PPA else "the factor"
        yield Fault(place, f"factor or PPA is missing; give {wanted}")
