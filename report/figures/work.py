"""Accuracy against run time: medians over the analysis cases in one axis; one case in two."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import asdict

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from report.figures.base import (
    INK,
    LOOKS,
    T,
    boxed,
    labeled,
    logarithmic,
    member_look,
    panels,
    style,
    svg_text,
)
from report.text.counts import lettered
from solver.verification.evidence import PeerPoint
from solver.verification.peers import ONE_AXIS

MEASURES = ("PRD", "residual")


def medians(runs: pd.DataFrame, error: str, floor: float) -> pd.DataFrame:
    """Return the median time and error of each method and setting that gave a result."""
    seconds = "time per run [s]"
    answered = runs.dropna(subset=[seconds, error])
    settings = answered.groupby(["method", "setting"], sort=False, dropna=False)[[seconds, error]]
    # Errors below the floor are set to it: rounding error limits them, and a log scale has no 0.
    return settings.median().assign(**{error: lambda each: each[error].clip(floor)})


def overview(
    runs: pd.DataFrame,
    floor: float,
    peers: Iterable[PeerPoint] = (),
    painted: Callable[[Figure], T] = svg_text,  # type: ignore[assignment]
) -> T:
    """Return the medians of every method: one panel for PRD and one for the residual.

    `floor` is the error of the exact method [%], from its checks; `peers` are other programs on the
    same runs, which know the PRD alone.
    """
    with style():
        margins = {"left": 0.085, "right": 0.99, "above": 0.221, "below": 2.1, "wspace": 0.08}
        figure, grid = panels(1, 2, 4.5, **margins, sharey=True)
        for axes, measure in zip(grid.flat, MEASURES, strict=True):
            points = medians(runs, f"{measure} error [%]", floor)
            for name in points.index.unique("method"):
                own = points.loc[name]
                # The exact method has one setting: one point among lines.
                size = {"markersize": 10} if name == "exact" else {}
                axes.plot(*own.to_numpy().T, **LOOKS[name] | size)
                if name == "exact":
                    axes.annotate(
                        "exact: rounding error",
                        own.iloc[0],
                        (9, 0),
                        textcoords="offset points",
                        va="center",
                    )
            labeled(axes, "Time per run [s]", title=f"Error in {measure}")
            logarithmic(axes, 9, 12)
        # In the panel of the PRD alone, all that the other programs return.
        _peers(grid[0, 0], peers, floor)
        grid[0, 0].set_ylabel("Median error over analysis cases [%]")
        # Of the left panel, which has the other programs as well.
        lines = grid[0, 0].get_legend_handles_labels()
        title = "Compiled, except where interpreted; by steps: a call from Python at each step"
        figure.legend(*lines, title=title, loc="lower center", ncols=3, handlelength=2.6)
        return painted(figure)


def _peers(axes: Axes, peers: Iterable[PeerPoint], floor: float) -> None:
    """Draw the medians of each program, with its model of friction, over its runs in one axis."""
    points = pd.DataFrame([asdict(peer) for peer in peers if peer.model == ONE_AXIS])
    if points.empty:
        return
    answered = points.dropna(subset=["seconds", "prd_error_percent"])
    for marker, (name, own) in zip("1+x2", answered.groupby("peer", sort=False), strict=False):
        medians = own[["seconds", "prd_error_percent"]].median()
        axes.plot(
            medians["seconds"], max(medians["prd_error_percent"], floor), linestyle="",
            marker=marker, markersize=9, color=INK, label=name,
        )  # fmt: skip


def work(runs: pd.DataFrame, least: float = 1e-12) -> str:
    """Return a line for each method, from coarse to fine; failed runs are not drawn.

    Errors below the least [%] are drawn there.
    """
    answered = runs.dropna(subset="time per run [s]")
    with style():
        figure, axes = boxed(2.4, (0.085, 0.17, 0.5, 0.79))
        for count, (name, own) in enumerate(answered.groupby("method", sort=False)):
            error = own["residual error [%]"].clip(least)
            look = member_look(count) | {"label": lettered(str(name))}
            axes.plot(own["time per run [s]"], error, **look)
        logarithmic(axes, 9, 8)
        labeled(axes, "Time per run [s]", "Position error [% of the PRD]")
        axes.legend(loc="center left", bbox_to_anchor=(1.02, 0.5), handlelength=3.2)
        return svg_text(figure)
