"""Roof motions and their response spectra against the target."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from report.pages.parts import Column, Row, Scene, Table
from report.spectra import PRINTED_S, Spectra
from report.units import G_MPS2, number
from solver.model import Floats, Motion


def motion_table(scene: Scene, motions: Sequence[Motion]) -> Table:
    """Return what each motion is, as run."""
    asked = {row.id.casefold(): row for row in scene.data.motions}
    rows = []
    for motion in motions:
        row = asked.get(motion.id.casefold())
        rows.append(
            Row(
                cells=(
                    motion.id,
                    motion.source or "—",
                    number(_peak_g(motion.ax_mps2, motion.scale), 3),
                    number(_peak_g(motion.az_mps2, motion.scale), 3)
                    if motion.has_vertical
                    else "none",
                    f"{motion.dt_s:g}",
                    number((len(motion.ax_mps2) - 1) * motion.dt_s, 2),
                    "as recorded" if row is None else row.scaling.value,
                    f"{motion.scale:.4g}",
                    "both" if len(motion.signs) == 2 else "+" if motion.signs[0] > 0 else "−",
                )
            )
        )
    return Table(
        caption="Roof motions as run, after scaling",
        columns=(
            Column(head="Motion", align="left", share=1.0),
            Column(head="Source", align="left", share=4.2),
            Column(head="Peak, hor.", unit="g", share=0.9),
            Column(head="Peak, ver.", unit="g", share=0.9),
            Column(head="Step", unit="s", share=0.7),
            Column(head="Duration", unit="s", share=0.9),
            Column(head="Scaling", align="left", share=1.3),
            Column(head="Factor", share=0.8),
            Column(head="Polarity", align="center", share=0.9),
        ),
        rows=tuple(rows),
        kind="compact",
    )


def _peak_g(values: Floats, scale: float) -> float:
    return float(np.abs(values).max() * abs(scale) / G_MPS2) if len(values) else float("nan")


def spectrum_table(part: Spectra) -> Table:
    """Return ordinates of each motion, of their mean and of the target at a few periods."""
    at = [int(np.argmin(np.abs(part.periods_s - period))) for period in PRINTED_S]
    rows = [_ordinates(name, row[at]) for name, row in zip(part.ids, part.sa_g, strict=True)]
    totals = (
        _ordinates("Mean", part.mean_g[at], kind="total"),
        _ordinates("AC156 target", part.target_g[at], kind="total"),
        _ordinates("Mean / target", (part.mean_g / part.target_g)[at], kind="total", decimals=2),
    )
    return Table(
        caption=f"{part.title} spectra, 5 % damping, pseudo-acceleration in g",
        columns=(
            Column(head="Motion", align="left", share=1.6),
            *(Column(head=f"{period:g} s", unit=f"{1 / period:.3g} Hz") for period in PRINTED_S),
        ),
        rows=(*rows, *totals),
        kind="compact",
    )


def _ordinates(name: str, values: Floats, *, kind: str = "", decimals: int = 3) -> Row:
    return Row(cells=(name, *(number(float(value), decimals) for value in values)), kind=kind)


def matching(part: Spectra) -> str:
    """Return how the mean lies to the target, over the whole range and below 1.3 Hz."""
    share = part.mean_g / part.target_g
    slow = part.periods_s >= 1 / 1.3
    return (
        f"{part.title}: mean of {len(part.ids)} spectra / target from "
        f"{number(float(share.min()), 2)} (T = {part.periods_s[share.argmin()]:.2f} s) to "
        f"{number(float(share.max()), 2)} (T = {part.periods_s[share.argmax()]:.2f} s); "
        f"below 1.3 Hz from {number(float(share[slow].min()), 2)} "
        f"to {number(float(share[slow].max()), 2)}."
    )


def page(scene: Scene, motions: Sequence[Motion], found: Sequence[Spectra]) -> Mapping[str, object]:
    """Return the part on motions, without its chart."""
    return {
        "table": motion_table(scene, motions),
        "spectra": tuple(spectrum_table(part) for part in found),
        "matching": tuple(matching(part) for part in found),
        "missing": sum(not motion.has_vertical for motion in motions),
    }
