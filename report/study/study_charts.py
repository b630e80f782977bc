"""Charts of a study, each a function from results to an SVG.

Computes only the layout; legible in black and white. Read `curves` first.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.contour import QuadContourSet

from report.figures.base import (
    ACCENT,
    GRAY,
    INK,
    LINES,
    MARKERS,
    PALE,
    bare,
    boxed,
    decades,
    draw_family,
    labeled,
    legend_below,
    panels,
    style,
    svg_text,
)
from report.project.read.years_file import ALWAYS
from report.study.study_results import LimitState
from report.study.years import LIVES, RECURRENCES, ArrayYears
from report.text.units import Quantity, Unit, digits_down, measured
from solver.model import Floats
from solver.studies.rates import HazardCurve
from solver.studies.uncertainty import Bar


def curves(
    x: Floats,
    family: Sequence[tuple[str, Floats]],
    unit: Unit,
    *,
    along: str,
    low: float = -math.inf,
    limits: Sequence[tuple[str, Floats]] = (),
    members: Sequence[Floats] = (),
) -> str:
    """Return a displacement [m] against an axis, a line for each member of a family.

    Up to `low`, a panel on the left has the same on a logarithmic axis. `limits` are thick lines;
    `members`, the mean PRD of each member [m], are thin ones.
    """
    named = [(f"{label}: none" if np.isnan(v).all() else label, v / unit.si) for label, v in family]
    means = [v / unit.si for v in members if not np.isnan(v).all()]
    with style():
        margins = {"left": 0.085, "right": 0.985, "above": 0.22, "below": 1.0}
        figure, (row,) = panels(1, 1 + (low > x[0]), 3.5, **margins, wspace=0.2)
        for axes in row:
            # A member without any value is named, so that nobody looks for its line.
            draw_family(axes, x, named)
            for count, prd in enumerate(means):
                # An underscore: not in the legend.
                label = "_" if count else "mean PRD"
                axes.plot(x, prd, color=GRAY, linewidth=0.6, label=label, zorder=1.5)
            for label, prd_m in limits:
                axes.plot(x, prd_m / unit.si, color=GRAY, linewidth=2.0, label=label)
            labeled(axes, along)
            axes.set_xlim(min(0.0, x[0]), x[-1])
            axes.set_ylim(0.0, None)
        if low > x[0]:
            # At least 1/1000 of a unit: where nothing slips a logarithmic axis would have no
            # range.
            top = float(np.nanmax([v[x <= low] for _, v in named], initial=1e-3))
            row[0].set_yscale("log", nonpositive="mask")
            row[0].set_ylim(1e-3 * top, 1.3 * top)
            row[0].set_xlim(x[0], min(low, x[-1]))
            decades(row[0].yaxis)
        row[0].set_ylabel(f"Displacement [{unit.symbol}]")
        lines, labels = row[0].get_legend_handles_labels()
        figure.legend(lines, labels, loc="lower center", ncols=5, handlelength=3.4)
        return svg_text(figure)


def contours(
    x: Floats,
    slopes_deg: Floats,
    design_m: Floats,
    mean_m: Floats,
    unit: Unit,
    *,
    along: str,
    allowed_m: float,
) -> str:
    """Return contours of displacements on a sheet of its own, the allowed one thick.

    Those of the mean PRD are thin. Displacements have the shape (slopes, x) [m]; NaN for none.
    """
    with style():
        figure, axes = boxed(6.7, (0.085, 0.08, 0.89, 0.9))
        grid, levels = (x, slopes_deg), _levels(unit)
        (second,) = {Quantity.DISPLACEMENT.us, Quantity.DISPLACEMENT.si} - {unit}
        both: Any = {"suffix": lambda v: f" ({measured(v, second)} {second.symbol})"}
        allowed = allowed_m / unit.si
        # The allowed displacement has a thick line: not a thin one on top of it.
        thinner = [value for value in levels if value != round(allowed, 6)]
        axes.set_xlim(x[0], x[-1])
        axes.set_ylim(slopes_deg[0], slopes_deg[-1])
        thin: Any = {"colors": GRAY, "linewidths": 0.5, "linestyles": ":"}
        _contour(axes, grid, mean_m, levels, unit, height=0.08, **thin)
        _contour(
            axes, grid, design_m, thinner, unit, height=0.47, colors=INK, linewidths=0.8, **both
        )
        thick: Any = {"colors": ACCENT, "linewidths": 2.2}
        _contour(axes, grid, design_m, (allowed,), unit, height=0.9, **thick, **both)
        labeled(axes, along, "Slope [deg]")
        return svg_text(figure)


def _contour(
    axes: Axes,
    grid: tuple[Floats, Floats],
    lengths_m: Floats,
    levels: Sequence[float],
    unit: Unit,
    *,
    height: float,
    suffix: Callable[[float], str] = lambda _: "",
    **look: Any,
) -> None:
    """Draw the contours that a sheet has, with their labels from a share of its height on."""
    lengths = lengths_m / unit.si
    if np.isnan(lengths).all():
        return
    levels_drawn = [v for v in levels if np.nanmin(lengths) < v < np.nanmax(lengths)]
    if levels_drawn:
        drawn = axes.contour(*grid, lengths, levels_drawn, **look)
        labels = axes.clabel(
            drawn,
            fmt=lambda v: f"{v:g} {unit.symbol}{suffix(v * unit.si)}",
            inline_spacing=2,
            manual=list(_places(drawn, grid, height)),
        )
        for label in labels:
            label.set_bbox({"facecolor": "white", "edgecolor": "none", "pad": 0.2})


def _places(
    drawn: QuadContourSet, grid: tuple[Floats, Floats], height: float
) -> Iterator[tuple[float, float]]:
    """Yield where the labels of contours are: three heights in turn, and none beyond the edge."""
    low, span = np.array([v[0] for v in grid]), np.array([np.ptp(v) for v in grid])
    for count, parts in enumerate(drawn.allsegs):
        # Cases without a value may leave none.
        lines = [line for line in parts if len(line)]
        if not lines:
            continue
        longest = max(lines, key=len)
        # Its own points may all be at the edges, where no label is: it gets 300.
        index = np.arange(len(longest))
        fine = np.linspace(0.0, index[-1], 300)
        dense = np.stack([np.interp(fine, index, values) for values in longest.T], axis=-1)
        shares = (dense - low) / span
        inside = shares[((shares > 0.04) & (shares < 0.96)).all(axis=1)]
        if inside.size:
            nearest = np.abs(inside[:, 1] - height - 0.145 * (count % 3)).argmin()
            x, y = low + span * inside[nearest]
            yield float(x), float(y)


def _levels(unit: Unit) -> tuple[float, ...]:
    if unit.symbol == "in":
        return (1.0, 2.0, 4.0, 6.0, 12.0, 18.0, 24.0, 36.0, 48.0, 72.0, 96.0, 144.0, 240.0, 480.0)
    return (25.0, 50.0, 100.0, 200.0, 300.0, 500.0, 750.0, 1000.0, 1500.0, 2000.0, 3000.0, 5000.0)


def fragilities(states: Sequence[LimitState], along: str) -> str:
    """Return fitted fragilities with their data points and the confidence of the medians."""
    with style():
        figure, axes = boxed(2.9, (0.085, 0.345, 0.89, 0.635))
        levels = states[0].fragility.levels
        # From above 0, which has no logarithm.
        fine = np.linspace(levels[-1] / 300.0, levels[-1], 300)
        for count, state in enumerate(states):
            f = state.fragility
            color = INK if count % 2 == 0 else ACCENT
            with np.errstate(invalid="ignore"):
                share = np.where(f.counted > 0, f.exceeded / np.maximum(f.counted, 1), np.nan)
            axes.plot(
                f.levels, share, linestyle="", marker=MARKERS[count], markersize=4.5, color=color,
                markerfacecolor="white", label=f"{state.name}, {state.words}: data",
            )  # fmt: skip
            if f.fitted.is_known:
                axes.plot(
                    fine, f.fitted.at(fine), linestyle=LINES[count], color=color, linewidth=1.2,
                    label=f"{state.name}: lognormal",
                )  # fmt: skip
                # Where medians are close, their bars are apart.
                height = 0.55 - 0.05 * count
                axes.plot(
                    f.theta_range,
                    (height, height),
                    color=color,
                    linewidth=2.6,
                    solid_capstyle="butt",
                )
        axes.set_xlim(0.0, levels[-1])
        axes.set_ylim(0.0, 1.02)
        labeled(axes, along, "Probability of exceedance")
        legend_below(axes, 3, handlelength=2.0, columnspacing=0.8)
        return svg_text(figure)


def goodness(states: Sequence[LimitState], along: str) -> str:
    """Return the ranks of capacities with their lognormal, a panel for each state; each has a p."""
    with style():
        margins = {"left": 0.085, "right": 0.985, "above": 0.216, "below": 0.816}
        figure, grid = panels(1, len(states), 2.4, **margins, wspace=0.08, sharey=True)
        for axes, state in zip(grid[0], states, strict=True):
            _ranked(axes, state)
            labeled(axes, along)
        grid[0, 0].set_ylabel("Share of the motions")
        lines, labels = grid[0, 0].get_legend_handles_labels()
        figure.legend(lines, labels, loc="lower center", ncols=3, handlelength=2.0)
        return svg_text(figure)


def _ranked(axes: Axes, state: LimitState) -> None:
    f = state.fragility
    x = np.sort(f.capacities.intensity)
    # Three standard deviations, or as far as the farthest capacity.
    far = max(3.0, float(np.abs(np.log(x / f.fitted.theta)).max()) / f.fitted.beta + 0.3)
    fine = f.fitted.theta * np.exp(f.fitted.beta * np.linspace(-far, far, 200))
    exceeded = f.fitted.at(fine)
    band = np.clip([exceeded - f.critical, exceeded + f.critical], 0.0, 1.0)
    axes.fill_between(fine, *band, color=PALE, linewidth=0.0, label="band of Lilliefors")
    axes.plot(fine, exceeded, color=ACCENT, linewidth=1.2, label="lognormal")
    ranks = np.arange(x.size + 1) / x.size
    axes.plot(
        np.concatenate([fine[:1], np.repeat(x, 2), fine[-1:]]), np.repeat(ranks, 2), color=INK,
        linewidth=0.9, label="capacities by rank",
    )  # fmt: skip
    axes.set_title(f"{state.name}: p = {digits_down(f.p_value, 2)}")
    axes.set_xlim(fine[0], fine[-1])
    axes.set_ylim(0.0, 1.02)
    axes.locator_params(axis="x", nbins=5)


def tornado(bars: Sequence[Bar], center_m: float, unit: Unit) -> str:
    """Return the tornado chart: mean PRD with each variable at its 5% and 95% quantile."""
    with style():
        height = 0.85 + 0.36 * len(bars)
        figure, axes = boxed(height, (0.2, 0.55 / height, 0.78, 1.0 - 0.65 / height))
        for row, bar in enumerate(bars):
            ends = np.array([bar.prd_low_m, bar.prd_high_m]) / unit.si
            if np.isnan(ends).any():
                axes.text(center_m / unit.si, row, "no value at an end", va="center")
                continue
            low, high = min(*ends, center_m / unit.si), max(*ends, center_m / unit.si)
            axes.barh(
                [row], [high - low], 0.55, left=[low], facecolor="#b8c7d9", edgecolor=INK,
                linewidth=0.8,
            )  # fmt: skip
            ended = list(zip(ends, (bar.at_low, bar.at_high), strict=True))
            for is_right, position in ((False, low), (True, high)):
                labels = [f"{v:.3g}" for end, v in ended if (end > center_m / unit.si) == is_right]
                axes.annotate(
                    ", ".join(labels), (position, row), (3 if is_right else -3, 0),
                    textcoords="offset points", va="center", ha="left" if is_right else "right",
                )  # fmt: skip
        axes.axvline(center_m / unit.si, color=INK, linewidth=1.0)
        axes.set_yticks(range(len(bars)), [bar.name for bar in bars])
        axes.set_ylim(len(bars) - 0.45, -0.55)
        lows = [bar.prd_low_m for bar in bars]
        highs = [bar.prd_high_m for bar in bars]
        top = float(np.nanmax([*lows, *highs, center_m])) / unit.si
        # A number left of the shortest end keeps clear of the names.
        low = min(0.0, float(np.nanmin([*lows, *highs, center_m])) / unit.si - 0.1 * top)
        axes.set_xlim(low, 1.12 * top)
        # No displacement is negative: the room at the left is for a number.
        axes.set_xticks([tick for tick in axes.get_xticks() if 0.0 <= tick <= 1.12 * top])
        axes.set_xlabel(f"Mean PRD [{unit.symbol}]")
        bare(axes)
        return svg_text(figure)


def rates(array_years: ArrayYears, curve: HazardCurve, unit: Unit, along: str) -> str:
    """Return the hazard curve, and the rates at which PRDs are exceeded with their band."""
    with style():
        margins = {"left": 0.085, "right": 0.985, "above": 0.15, "below": 0.55}
        figure, ((left, right),) = panels(1, 2, 3.2, **margins, wspace=0.16, sharey=True)
        low, top = array_years.responses.levels.min(), array_years.responses.levels.max()
        left.plot(curve.intensity, curve.rate, color=INK, linewidth=1.2, marker="o", markersize=3.0)
        left.axvspan(low, top, color=PALE, linewidth=0.0, zorder=0)
        left.set_xlim(0.2 * low, 2.0 * top)
        # The first limit is 0, which a logarithmic axis does not have.
        is_positive = array_years.limits_m > 0.0
        x = array_years.limits_m[is_positive] / unit.si
        right.fill_between(x, *array_years.rates_band[:, is_positive], color=PALE, linewidth=0.0)
        right.plot(x, array_years.rates[is_positive], color=INK, linewidth=1.2)
        right.axvline(
            array_years.plan.array.clearance_m / unit.si, color=ACCENT, linestyle=LINES[1]
        )
        right.set_xlim(10.0**-unit.decimals, x[-1])
        for axes, name in ((left, along), (right, f"PRD [{unit.symbol}]")):
            for years in RECURRENCES:
                axes.axhline(1.0 / years, color=GRAY, linewidth=0.5, linestyle=LINES[3])
            axes.set_xscale("log")
            axes.set_yscale("log")
            decades(axes.xaxis)
            labeled(axes, name)
        for years in RECURRENCES:
            right.annotate(f"{years:g}", (x[-1], 1.0 / years), (-2, 1), va="bottom", ha="right",
                           textcoords="offset points", fontsize=7.0)  # fmt: skip
        left.set_ylim(0.2 / RECURRENCES[-1], 3.0 * max(array_years.rates[0], 1.0 / RECURRENCES[0]))
        decades(left.yaxis)
        left.set_ylabel("Annual rate of exceedance")
        return svg_text(figure)


def lives(array_years: ArrayYears, unit: Unit) -> str:
    """Return the share of lives in which distances are exceeded, by when the array is put back."""
    with style():
        figure, axes = boxed(2.9, (0.085, 0.345, 0.89, 0.635))
        clearance = array_years.plan.array.clearance_m / unit.si
        share = 1.0 - np.arange(LIVES) / LIVES
        # 400 of 100,000 lives, evenly in the logarithm: rare ones are seen, too.
        ranks = np.unique(np.geomspace(1, LIVES, 400).astype(int)) - 1
        for count, (name, distances) in enumerate(array_years.lives.items()):
            # Put back after each event, an array has no last distance.
            for k, which in enumerate(("largest", "last")[: 1 + (name != ALWAYS)]):
                ordered = np.sort(distances[k])[::-1][ranks] / unit.si
                axes.plot(
                    ordered, share[::-1][ranks], color=(INK, ACCENT)[k], linestyle=LINES[count],
                    linewidth=1.2, label=f"{which}, put back {name}",
                )  # fmt: skip
        axes.axvline(clearance, color=GRAY, linewidth=2.0, label="clearance")
        axes.set_xscale("log")
        decades(axes.xaxis)
        axes.set_xlim(10.0**-unit.decimals, 8.0 * clearance)
        top = float(max((distances[0] > 0.0).mean() for distances in array_years.lives.values()))
        axes.set_ylim(0.0, 1.05 * top or 1.0)
        labeled(axes, f"Distance from the installed place [{unit.symbol}]", "Share of lives beyond")
        legend_below(axes, 3, handlelength=2.6)
        return svg_text(figure)
