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
        peaks = (motion.ax_mps2, motion.ay_mps2, motion.az_mps2)
        rows.append(
            Row(
                cells=(
                    motion.id,
                    motion.source or "—",
                    *(_peak(values, motion.scale) for values in peaks),
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
            Column(head="Source", align="left", share=3.6),
            Column(head="Peak", unit="record, g", share=0.95),
            Column(head="Peak", unit="transv., g", share=0.95),
            Column(head="Peak", unit="vertical, g", share=1.0),
            Column(head="Step", unit="s", share=0.7),
            Column(head="Duration", unit="s", share=0.9),
            Column(head="Scaling", align="left", share=1.3),
            Column(head="Factor", share=0.8),
            Column(head="Polarity", align="center", share=0.9),
        ),
        rows=tuple(rows),
        kind="compact",
    )


def _peak(values: Floats, scale: float) -> str:
    return number(float(np.abs(values).max() * abs(scale) / G_MPS2), 3) if len(values) else "none"


def spectrum_table(part: Spectra) -> Table:
    """Return the target and what the motions have at a few periods, and the one over the other."""
    at = [int(np.argmin(np.abs(part.periods_s - period))) for period in PRINTED_S]
    share, mean = part.sa_g / part.target_g, part.mean_g / part.target_g
    rows = (
        _ordinates("AC156 target [g]", part.target_g[at]),
        _ordinates(f"Mean of {len(part.ids)} motions [g]", part.mean_g[at]),
        _ordinates("Mean / target", mean[at], kind="total", decimals=2),
        _ordinates("Least motion / target", share.min(axis=0)[at], kind="total", decimals=2),
        _ordinates("Largest motion / target", share.max(axis=0)[at], kind="total", decimals=2),
    )
    return Table(
        caption=f"{part.title}: pseudo-acceleration, 5 % damping, achieved against the target",
        columns=(
            Column(head="Period", align="left", share=2.9),
            *(Column(head=f"{period:g} s", unit=f"{1 / period:.3g} Hz") for period in PRINTED_S),
        ),
        rows=rows,
        kind="compact",
    )


def _ordinates(name: str, values: Floats, *, kind: str = "", decimals: int = 3) -> Row:
    return Row(cells=(name, *(number(float(value), decimals) for value in values)), kind=kind)


def achieved_table(found: Sequence[Spectra]) -> Table:
    """Return how the motions lie to the target over the band, a row for each component."""
    return Table(
        caption="Achieved over target, 0.3 to 33 Hz in 1/12 octaves",
        columns=(
            Column(head="Component", align="left", share=1.5),
            Column(head="Motions", share=0.9),
            Column(head="Mean of motions", unit="least", share=0.9),
            Column(head="Mean of motions", unit="largest", share=0.9),
            Column(head="Mean below 1.3 Hz", unit="least", share=0.9),
            Column(head="Mean below 1.3 Hz", unit="largest", share=0.9),
            Column(head="Single motion", unit="least", share=0.7),
            Column(head="Single motion", unit="of, at", align="left", share=1.6),
            Column(head="Single motion", unit="largest", share=0.7),
            Column(head="Single motion", unit="of, at", align="left", share=1.6),
        ),
        rows=tuple(_achieved(part) for part in found),
        kind="compact",
    )


def _achieved(part: Spectra) -> Row:
    periods = part.periods_s[part.in_band]
    each = (part.sa_g / part.target_g)[:, part.in_band]
    mean = (part.mean_g / part.target_g)[part.in_band]
    slow = mean[periods >= 1 / 1.3]
    reach = [fold(values) for values in (mean, slow) for fold in (np.min, np.max)]
    return Row(
        cells=(
            part.title,
            str(len(part.ids)),
            *(number(float(value), 2) for value in reach),
            *(text for at in (each.argmin(), each.argmax()) for text in _single(part, each, at)),
        )
    )


def _single(part: Spectra, each: Floats, at: np.intp) -> tuple[str, str]:
    """Return one ratio, and which motion has it at which period."""
    motion, period = np.unravel_index(at, each.shape)
    return (
        number(float(each[motion, period]), 2),
        f"{part.ids[motion]}, {part.periods_s[part.in_band][period]:.2f} s",
    )


def page(scene: Scene, motions: Sequence[Motion], found: Sequence[Spectra]) -> Mapping[str, object]:
    """Return the part on motions, without its chart."""
    return {
        "table": motion_table(scene, motions),
        "achieved": achieved_table(found),
        "spectra": tuple(spectrum_table(part) for part in found),
    }
