"""Faults of rows of linked blocks."""

from __future__ import annotations

from collections.abc import Iterator

from report.project.check.input_columns import column, repeated
from report.project.model.finding import Finding
from report.project.model.input_rows import InputRow, Inputs
from report.project.model.links import coefficients
from report.project.model.place import Place, Where


def link_faults(inputs: Inputs, where: Where) -> Iterator[Finding]:
    """Yield rows of linked blocks that are given twice, or contradict their array."""
    arrays = {name: place for place, name in column(inputs, ("arrays",), "id")}
    named = list(column(inputs, ("links",), "array"))
    for place, name, first in repeated(named):
        fault = f"array is '{name}', already given at {where(first)}"
        yield Finding.error(place, fault, "delete one")
    for place, name in named:
        # A name that is unknown has an error of its own.
        array = inputs["arrays"][arrays[name].row] if name in arrays else {}
        # A block of a row has one coefficient (`solver.sliding.row.BlockRow`).
        if "mu" in array and _by_speed(array):
            text = f"array is '{name}', which has high-velocity or static friction"
            remedy = "leave both blank on the Arrays worksheet, or delete this row"
            yield Finding.error(place, text, remedy)
    for place, text in column(inputs, ("links",), "friction"):
        home = arrays.get(inputs["links"][place.row].get("array", ""))
        yield from _blocks(place, text, inputs, where, home)


def _by_speed(array: InputRow) -> list[str]:
    """Return the fields that give an array more than one friction coefficient."""
    same = (None, array["mu"])
    return [name for name in ("mu_fast", "mu_static") if array.get(name) not in same]


def _blocks(
    place: Place, text: str, inputs: Inputs, where: Where, home: Place | None
) -> Iterator[Finding]:
    mus = coefficients(text)
    if not mus:
        remedy = "give 2 to 20 coefficients from 0 to 1.5 with decimal points, such as 0.40, 0.45"
        yield Finding.error(place, f"block friction is '{text}'", f"{remedy}, 0.50")
        return
    mu = inputs["arrays"][home.row].get("mu") if home else None
    if home is not None and mu is not None and not min(mus) <= mu <= max(mus):
        side, address = "above" if mu < min(mus) else "below", where(home._replace(field="mu"))
        fault = f"block friction is '{text}', all {side} the {mu:g} at {address}"
        yield Finding.error(place, fault, "give a range that includes it, or change it")
