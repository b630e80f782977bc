"""Draws the four figures of `docs/design-curves.md` from the tables. Read `draw`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from projects.curves.equation import Equation
from projects.curves.make import INCH, PERIODS_S, Response, halves, peaks, prescriptive_m
from report.figures.base import (
    ACCENT,
    ACROSS,
    GRAY,
    INK,
    LINES,
    MARKERS,
    PALE,
    draw_family,
    labeled,
    png_bytes,
    style,
)
from solver.model import Floats

WIDE_IN, TALL_IN = 7.5, 6.2
MUS = (0.4, 0.5, 0.6, 0.8)
SLOPES_DEG = (0.0, 2.0, 4.0, 7.0)
SLOPE_DEG, LIMIT_IN = 2.0, 24
LARGEST_S_DS_G = 2.4

PLACES = ("Rock", *(f"Building, {period:g} s" for period in PERIODS_S[1:]))
LOGARITHM = "mean ± standard deviation of ln(computed / formula)"


def draw(
    tables: Mapping[str, pd.DataFrame],
    about: Mapping[str, Any],
    responses: Sequence[Response],
    events: Sequence[str],
    folder: Path,
) -> None:
    """Write the figures as PNG into a folder."""
    made = {
        "prd": _prd(tables["curves"]),
        "least-friction": _least_friction(tables["least-friction"]),
        "over-prescriptive": _over(tables["curves"]),
        "equation": _equation(about, responses, events),
    }
    for name, figure in made.items():
        (folder / f"design-curves-{name}.png").write_bytes(png_bytes(figure))


def _panels(y: str) -> tuple[Figure, Sequence[Axes]]:
    """Return a panel for each place, with S_DS along it."""
    figure = Figure(figsize=(WIDE_IN, TALL_IN), layout="constrained")
    grid = figure.subplots(2, 2, sharex=True, sharey=True)
    for at, (axes, place) in enumerate(zip(grid.flat, PLACES, strict=True)):
        labeled(axes, "S_DS of the ground motion [g]" if at > 1 else "", "" if at % 2 else y, place)
        axes.set_xlim(0.2, LARGEST_S_DS_G)
    return figure, list(grid.flat)


def _named(figure: Figure, axes: Axes, columns: int) -> None:
    handles, names = axes.get_legend_handles_labels()
    figure.legend(handles, names, loc="outside lower center", ncols=columns)


def _prd(table: pd.DataFrame) -> Figure:
    with style():
        figure, panels = _panels("PRD [in]")
        for axes, period in zip(panels, PERIODS_S, strict=True):
            for count, mu in enumerate(MUS):
                rows = table.loc[(period, SLOPE_DEG, mu)]
                color = INK if count % 2 == 0 else ACCENT
                axes.plot(
                    rows.index, rows["p84_m"] / INCH, linestyle=LINES[0], marker=MARKERS[count],
                    markersize=3.5, markerfacecolor="white", linewidth=0.9, color=color,
                    label=f"μ = {mu:g}, 84%",
                )  # fmt: skip
                axes.plot(
                    rows.index, rows["median_m"] / INCH, linestyle=LINES[1], marker=MARKERS[count],
                    markersize=2.5, linewidth=0.7, color=color, label=f"μ = {mu:g}, median",
                )  # fmt: skip
            _draw_prescriptive(axes)
            axes.set_ylim(0.0, 120.0)
        panels[0].set_title(
            f"Rock; roof slope {SLOPE_DEG:g}° throughout", loc="left", weight="semibold"
        )
        _named(figure, panels[0], 5)
        return figure


def _draw_prescriptive(axes: Axes) -> None:
    s_ds = np.linspace(0.4, LARGEST_S_DS_G, 60)
    axes.plot(
        s_ds, prescriptive_m(s_ds) / INCH, color=ACROSS, linewidth=2.0,
        label="60 in × (S_DS − 0.4)²",
    )  # fmt: skip


def _least_friction(table: pd.DataFrame) -> Figure:
    with style():
        figure, panels = _panels(f"Least μ, 84% of PRD within {LIMIT_IN} in")
        for axes, period in zip(panels, PERIODS_S, strict=True):
            rows = table.loc[period][f"least_mu_{LIMIT_IN}_in"].unstack("slope_deg")
            draw_family(
                axes,
                rows.index.to_numpy(),
                [(f"roof slope {slope:g}°", rows[slope].to_numpy()) for slope in SLOPES_DEG],
            )
            axes.set_ylim(0.28, 1.02)
        _named(figure, panels[0], 4)
        return figure


def _over(table: pd.DataFrame) -> Figure:
    with style():
        figure, panels = _panels("Components over 60 in × (S_DS − 0.4)² [%]")
        for axes, period in zip(panels, PERIODS_S, strict=True):
            lines = []
            for mu in MUS:
                rows = table.loc[(period, SLOPE_DEG, mu)]["share_over_prescriptive"]
                lines.append((f"μ = {mu:g}", rows))
            s_ds = lines[0][1].index.to_numpy()
            kept = s_ds > 0.45
            draw_family(axes, s_ds[kept], [(name, 100 * y[kept]) for name, y in lines])
            axes.set_ylim(0.0, 60.0)
        panels[0].set_title(
            f"Rock; roof slope {SLOPE_DEG:g}° throughout", loc="left", weight="semibold"
        )
        _named(figure, panels[0], 4)
        return figure


def _equation(
    about: Mapping[str, Any], responses: Sequence[Response], events: Sequence[str]
) -> Figure:
    fitted = Equation(**about["constants"])
    with style():
        figure = Figure(figsize=(WIDE_IN, 3.6), layout="constrained")
        left, right = figure.subplots(1, 2, width_ratios=(1.1, 1.0))
        labeled(
            left,
            "r: slips downslope at / peak acceleration A",
            "PRD A / V²",
            "μ = 0.50, PRD from 10 mm, events not fitted",
        )
        for slope_deg, color, band in ((0.0, INK, PALE), (4.0, ACCENT, "#c9d8ea")):
            r, low, median, high = _binned(responses, events, slope_deg)
            left.fill_between(r, low, high, color=band, label=f"{slope_deg:g}°, 16 to 84%")
            left.plot(r, median, "o", markersize=3.0, color=color, label=f"{slope_deg:g}°, median")
            ratchets = np.exp(fitted.s * np.sqrt(np.radians(slope_deg) / r))
            by_formula = fitted.c * (1.0 - r) ** fitted.p * ratchets
            left.plot(r, by_formula, color=color, linewidth=1.2, label=f"{slope_deg:g}°, formula")
        left.set_yscale("log")
        left.legend(fontsize=7.5)
        labeled(right, LOGARITHM, "", "Events not fitted")
        names = list(about["tried"]["all"])
        for shift, (place, mark) in enumerate((("rock", "s"), ("roofs", "o"))):
            found = [about["tried"][place][name] for name in names]
            right.errorbar(
                [each["mean"] for each in found], np.arange(len(names)) + 0.24 * shift - 0.12,
                xerr=[each["deviation"] for each in found], fmt=mark, markersize=4.0,
                color=INK if shift else ACCENT, linewidth=0.9, capsize=2.0, label=place,
            )  # fmt: skip
        right.axvline(0.0, color=GRAY, linewidth=0.8)
        right.set_yticks(range(len(names)), [name.replace(" and ", " and\n") for name in names])
        right.set_ylim(-0.6, len(names) - 0.4)
        right.invert_yaxis()
        right.legend(fontsize=7.5, loc="upper right")
        return figure


def _binned(
    responses: Sequence[Response], events: Sequence[str], slope_deg: float
) -> tuple[Floats, Floats, Floats, Floats]:
    """Return r with the 16%, median and 84% of PRD A / V^2 in its bins, for mu = 0.5."""
    edges = np.linspace(0.1, 0.9, 17)
    r, length = [], []
    for response, is_fitted in zip(responses, halves(events), strict=True):
        for period in () if is_fitted else range(len(PERIODS_S)):
            runs = peaks(response, period)
            is_here = np.isclose(runs.slope_rad, np.radians(slope_deg)) & np.isclose(runs.mu, 0.5)
            runs = runs.only(runs.holds & is_here)
            r.append(runs.r)
            length.append(runs.prd_m * runs.ppa_mps2 / runs.ppv_mps**2)
    all_r, all_lengths = np.concatenate(r), np.concatenate(length)
    inside = np.digitize(all_r, edges) - 1
    bins = [all_lengths[inside == at] for at in range(edges.size - 1)]
    low, median, high = (np.array([np.quantile(b, q) for b in bins]) for q in (0.16, 0.5, 0.84))
    return 0.5 * (edges[1:] + edges[:-1]), low, median, high
