"""What `roofslip plan read` does with layers that nobody said anything of; read `choose`."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import click

from report.cli.terminal import plain

if TYPE_CHECKING:
    from report.drawing.drawn import RoofDrawing
    from report.sheet.schema.choices import LayerKind

_MOST_ROWS, _MOST_LETTERS = 100, 60


def given_kinds(
    _: click.Context, __: click.Parameter, value: Sequence[str]
) -> dict[str, LayerKind]:
    """Return what each `--layer NAME=KIND` says, by the name."""
    from report.sheet.schema.choices import LayerKind

    kinds = {}
    for text in value:
        name, _sign, word = text.rpartition("=")
        if not name or word.lower() not in list(LayerKind):
            choices = ", ".join(LayerKind)
            raise click.BadParameter(f"'{text}' is not NAME=KIND, where KIND is one of {choices}.")
        kinds[name] = LayerKind(word.lower())
    return kinds


def choose(
    drawing: RoofDrawing,
    sheet: Mapping[str, LayerKind],
    given: Mapping[str, LayerKind],
    accept: bool,
) -> dict[str, LayerKind]:
    """Return what is said of layers beyond the sheet Layers: as given, or proposed and accepted.

    Raises
    ------
    InputError
        If a layer that is given is not in the drawing; or, after a table of them, if layers with
        closed lines are not known.
    """
    from report.drawing.plan_read import known_layers
    from report.drawing.proposals import proposed
    from report.sheet.schema.choices import LayerKind
    from report.words.counts import numbered
    from solver.meant import nearest
    from solver.model import InputError, Problem

    names = {layer.casefold(): layer for layer, _ in drawing.counts}
    if lost := [name for name in given if name.casefold() not in names]:
        near = [nearest(name, names.values()) for name in lost]
        raise InputError(
            [Problem(f"no layer '{name}'", meant and f"did you mean '{meant}'?")
             for name, meant in zip(lost, near, strict=True)]
        )  # fmt: skip
    known = known_layers({**sheet, **given})
    outlines = Counter(line.layer for line in drawing.lines if line.layer.casefold() not in known)
    kinds = {layer: proposed(layer) for layer in sorted(outlines)}
    if kinds and not accept:
        for line in _table(drawing, outlines, kinds):
            click.echo(plain(line))
        raise InputError(
            f"nothing is written: nobody says what is drawn on {numbered(len(kinds), 'layer')};"
            " add --accept to take what is proposed, or --layer NAME=KIND for a layer, where KIND"
            f" is one of {', '.join(LayerKind)}"
        )
    return {**given, **{layer: kind for layer, kind in kinds.items() if kind}}


def _table(
    drawing: RoofDrawing, outlines: Mapping[str, int], kinds: Mapping[str, LayerKind | None]
) -> Iterator[str]:
    from report.words.formats import aligned

    rows = [("layer", "closed lines", "drawn", "proposed")]
    for layer, kind in list(kinds.items())[:_MOST_ROWS]:
        counts = sorted((of, count) for (at, of), count in drawing.counts.items() if at == layer)
        drawn = ", ".join(f"{count} {of}" for of, count in counts)
        rows.append((layer[:_MOST_LETTERS], str(outlines[layer]), drawn, kind or "none"))
    yield from aligned(rows, "<><<")
