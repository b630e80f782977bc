"""The paper's Figs. 5 to 12 for the records of the verification."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from report.figures.base import (
    ACCENT,
    DASHED,
    GRAY,
    INK,
    bare,
    boxed,
    decades,
    draw_family,
    labeled,
    legend_below,
    panels,
    style,
    svg_text,
    ticks,
)
from report.figures.history_charts import envelope
from solver.model import Floats
from solver.verification.evidence import DesignCurves, LinkComparison

# The paper's largest error with 64 sub-steps.
PAPER_P64_PERCENT = 0.48

FIG_10_SLOPE_DEG, FIG_11_MU, FIG_12_PPA_G = 1.0, 0.5, 1.5
# The paper's example on Fig. 12: slope [deg] and limit on PRD [m].
# There the paper reads off a least friction coefficient of 0.55, for PPA 1.5 g.
READ_OFF = (2.0, 0.5)


def convergence(studies: Sequence[tuple[str, pd.DataFrame]]) -> str:
    """Return Fig. 5, a row for each record: largest error and longest time against P."""
    with style():
        figure, grid = _rows(len(studies), 2.25)
        for (left, right), (record, study) in zip(grid, studies, strict=True):
            _errors(left, study)
            right.plot(study.index, 1e3 * study["seconds"], "o-", color=INK, markersize=4)
            right.set_yscale("log")
            decades(right.yaxis, maximum=7)
            for axes, y in (
                (left, "Largest error in residual [%]"),
                (right, "Longest time per run [ms]"),
            ):
                axes.set_xscale("log", base=2)
                ticks(axes.xaxis, study.index.tolist())
                labeled(axes, "Sub-steps P per sampling interval", y)
            left.set_title(record, loc="left", weight="semibold")
        return svg_text(figure)


def _errors(axes: Axes, study: pd.DataFrame) -> None:
    exact, finest = study["exact_percent"], study["finest_percent"]
    axes.plot(study.index, exact, "o-", color=INK, markersize=4, label="against exact")
    axes.plot(
        study.index,
        # The finest against itself is 0, which a logarithmic scale does not have.
        finest.where(finest > 0.0),
        marker="s",
        markerfacecolor="white",
        linestyle=DASHED,
        color=ACCENT,
        markersize=4,
        label=f"against P = {study.index[-1]}, as in the paper",
    )
    axes.plot(
        [64], [PAPER_P64_PERCENT], linestyle="", marker="*", markersize=9, color=GRAY,
        label=f"paper, record of the paper: {PAPER_P64_PERCENT}%",
    )  # fmt: skip
    axes.set_yscale("log")
    low, high = axes.get_ylim()
    # Room for the legend.
    axes.set_ylim(low, 8.0 * high)
    decades(axes.yaxis, maximum=7)
    axes.legend(loc="upper right", handlelength=2.8)


def _rows(count: int, row_in: float, below_in: float = 0.45) -> Any:
    margins = {"left": 0.085, "right": 0.985, "above": 0.22, "below": below_in}
    return panels(count, 2, row_in * count + 0.05, **margins, wspace=0.24, hspace=0.58)


def links(comparisons: Sequence[LinkComparison]) -> str:
    """Return Figs. 6 to 9, a row each: history with the largest difference; PRD and RRD over mu."""
    with style():
        figure, grid = _rows(len(comparisons), 2.0)
        for (left, right), comparison in zip(grid, comparisons, strict=True):
            _history(left, comparison)
            _over_mu(right, comparison)
        return svg_text(figure)


def _history(axes: Axes, comparison: LinkComparison) -> None:
    looks: tuple[tuple[str, Any, str, float], ...] = (
        ("exact", "-", INK, 1.0),
        ("link", DASHED, ACCENT, 1.4),
    )
    for name, line, color, width in looks:
        u_m = comparison.history_m[name]
        t, u = envelope(u_m.index.to_numpy(), 1e3 * u_m.to_numpy())
        axes.plot(t, u, linestyle=line, color=color, linewidth=width, label=name)
    title = f"θ = {comparison.slope_deg:g}°: history at μ = {comparison.history_mu:g}"
    labeled(axes, "Time [s]", "Displacement u [mm]", title)
    axes.legend(loc="best", handlelength=2.8)


def _over_mu(axes: Axes, comparison: LinkComparison) -> None:
    looks: tuple[tuple[str, str, Any, str, str], ...] = (
        ("PRD, exact", "o", "-", INK, INK),
        ("PRD, link", "x", "", ACCENT, ACCENT),
        ("RRD, exact", "s", DASHED, INK, "white"),
        ("RRD, link", "+", "", ACCENT, ACCENT),
    )
    for label, marker, line, color, fill in looks:
        axes.plot(
            1e3 * comparison.runs_m[label],
            marker=marker,
            linestyle=line,
            color=color,
            markerfacecolor=fill,
            markersize=6 if marker in "x+" else 4,
            linewidth=0.9,
            label=label,
        )
    # From 0, where nothing slides, to meters: linear below 1 mm, logarithmic above.
    axes.set_yscale("symlog", linthresh=1.0)
    axes.set_ylim(0.0, None)
    ticks(axes.yaxis, (0.0, 1.0, 10.0, 100.0, 1e3, 1e4, 1e5))
    axes.set_xlim(0.0, None)
    title = f"θ = {comparison.slope_deg:g}°: all μ"
    labeled(axes, "Friction coefficient μ", "Displacement [mm]", title)
    axes.legend(loc="best", handlelength=2.8)


def curves(study: DesignCurves) -> str:
    """Return Figs. 10 and 11: PRD against PPA for several mu, and against slope for several PPA."""
    slope = _nearest(study.slopes_deg, FIG_10_SLOPE_DEG)
    mu = _nearest(study.mus, FIG_11_MU)
    over_ppa = [(f"μ = {m:.2g}", study.prd_m[slope, k]) for k, m in _every(study.mus)]
    over_slope = [
        (f"{ppa:.2g} g", study.prd_m[:, mu, k])
        for k, ppa in _every(study.ppas_g)
        # A line along zero would hide the axis.
        if study.prd_m[:, mu, k].max() > 0.0
    ]
    with style():
        figure, grid = _rows(1, 2.75, below_in=0.88)
        left, right = grid[0]
        _family(left, study.ppas_g, over_ppa)
        _family(right, study.slopes_deg, over_slope)
        labeled(left, "PPA [g]", "PRD [mm]", f"θ = {study.slopes_deg[slope]:g}°")
        labeled(right, "Slope θ [deg]", title=f"μ = {study.mus[mu]:.2g}")
        return svg_text(figure)


def _nearest(values: Floats, value: float) -> int:
    return int(np.abs(values - value).argmin())


def _every(values: Floats) -> list[tuple[int, float]]:
    """Return at most eight of the values with their indices, including the last value."""
    step = math.ceil(values.size / 8)
    # Counted back from the last: of 30 values with a step of 4, indices 1, 5, ... 29.
    return [(k, float(values[k])) for k in range((values.size - 1) % step, values.size, step)]


def _family(axes: Axes, x: Floats, family: Sequence[tuple[str, Floats]]) -> None:
    draw_family(axes, x, ((label, 1e3 * prd_m) for label, prd_m in family), clip_on=False)
    axes.set_ylim(0.0, None)
    axes.set_xlim(x[0], x[-1])
    legend_below(axes, 4)


def contours(study: DesignCurves) -> str:
    """Return Fig. 12: contours of PRD over mu and slope, with the least mu for the limit."""
    ppa = _nearest(study.ppas_g, FIG_12_PPA_G)
    prd_mm = 1e3 * study.prd_m[:, :, ppa]
    slope_deg, wanted_m = READ_OFF
    with style():
        figure, axes = boxed(3.1, (0.085, 0.135, 0.9, 0.82))
        levels = [v for v in _LEVELS_MM if prd_mm.min() < v < prd_mm.max()]
        drawn = axes.contour(
            study.mus,
            study.slopes_deg,
            prd_mm,
            levels,
            colors=INK,
            linewidths=[1.5 if v in (500.0, 1000.0) else 0.8 for v in levels],
            linestyles=["-" if v in (500.0, 1000.0) else DASHED for v in levels],
        )
        axes.clabel(drawn, fmt=lambda value: f"{value:g} mm", inline_spacing=2)
        # NaN where no friction coefficient of the study is enough: then nothing is read off.
        mu_min = study.minimum_mu(slope_deg, float(study.ppas_g[ppa]), wanted_m)
        if not math.isnan(mu_min):
            _read_off(axes, mu_min, slope_deg, wanted_m)
        axes.set_xlim(study.mus[0], study.mus[-1])
        axes.set_ylim(study.slopes_deg[0], study.slopes_deg[-1])
        axes.set_xlabel("Friction coefficient μ")
        axes.set_ylabel("Slope θ [deg]")
        bare(axes)
        return svg_text(figure)


_LEVELS_MM = (50.0, 100.0, 200.0, 300.0, 500.0, 750.0, 1000.0, 1500.0, 2000.0, 3000.0, 5000.0, 1e4)


def _read_off(axes: Axes, mu: float, slope_deg: float, wanted_m: float) -> None:
    axes.plot([axes.get_xlim()[0], mu], [slope_deg, slope_deg], color=ACCENT, linewidth=1.2)
    axes.annotate(
        f"θ = {slope_deg:g}°, PRD at most {1e3 * wanted_m:g} mm: μ ≥ {mu:.3f}",
        (mu, 0.0),
        (mu + 0.012, slope_deg * 0.35),
        color=ACCENT,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.0},
    )
    axes.annotate(
        "",
        (mu, 0.0),
        (mu, slope_deg),
        arrowprops={"arrowstyle": "-|>", "color": ACCENT, "linewidth": 1.2},
    )
