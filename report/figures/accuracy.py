"""Error against number of steps for the governing run of a package, along the slope alone.

The cost axis counts steps, not seconds, so that two runs draw the same bytes.
"""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.axes import Axes

from report.assessment.sensitivity import MethodRun, Rivals
from report.figures.base import ACCENT, framed, labeled, style, svg_text
from report.figures.methods import LOOKS
from report.figures.scales import ticks
from report.words.letters import lettered, power_of_ten
from solver.rivals.methods import METHODS

FLOOR = 1e-16  # an error of zero is drawn here: the resolution of a double
_STEPS = (1, 2, 4, 8, 16, 32, 64, 128, 256)


def work_precision(rivals: Rivals) -> str:
    """Return the error in PRD against steps per sampling interval, one line per method.

    Methods have the names of the table below the chart, and its order.
    """
    exact = METHODS["exact"]
    with style():
        figure, axes = framed(1.95, 0.62, 2.75, 0.1, 0.5)
        floor = 100.0 * max(rivals.doubled, FLOOR)
        look = LOOKS["exact"] | {"color": ACCENT, "markerfacecolor": ACCENT, "markersize": 11}
        axes.plot([1.0], [floor], **look | {"label": exact.title})
        bold = {"textcoords": "offset points", "color": ACCENT, "weight": "semibold"}
        axes.annotate(f"{exact.title}: rounding error", (1.0, floor), (11, -3), **bold)
        for name in dict.fromkeys(run.method.name for run in rivals.runs):
            _draw(axes, [run for run in rivals.runs if run.method.name == name and not run.failed])
        _axes(axes, max(run.steps for run in rivals.runs))
        figure.legend(loc="center right", bbox_to_anchor=(1.0, 0.56), handlelength=3.2)
        return svg_text(figure)


def _draw(axes: Axes, runs: Sequence[MethodRun]) -> None:
    """Draw one method; its default setting is on the line like any other."""
    if not runs:
        return
    method = runs[0].method
    look = LOOKS[method.name] | {"label": lettered(method.title)}
    if not method.knob:  # the error does not depend on a number of steps
        axes.axhline(100.0 * runs[0].error, color=look["color"], linewidth=1.6, label=look["label"])
        return
    ordered = sorted(runs, key=lambda run: (run.steps, run.error))
    if method.knob != "substeps":  # several stiffnesses have the same steps
        ordered = sorted(
            (run for run in runs if not run.is_default),
            key=lambda run: list(run.parameters.values()),
        )
    errors = [100.0 * max(run.error, FLOOR) for run in ordered]
    axes.plot([run.steps for run in ordered], errors, **look)


def _axes(axes: Axes, maximum: float) -> None:
    axes.set_xscale("log", base=2)
    axes.set_yscale("log")
    axes.set_xlim(0.82, 1.25 * maximum)
    axes.set_ylim(1e-15, 300.0)
    ticks(axes.xaxis, _STEPS)
    powers = range(-14, 3, 4)
    axes.set_yticks([10.0**power for power in powers], map(power_of_ten, powers))
    axes.minorticks_off()
    labeled(axes, "Steps per sampling interval", "Error in PRD [%]")
