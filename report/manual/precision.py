"""Accuracy against run time: sections of the manual with charts and medians."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import pandas as pd

from report.document.columns import centered, text, words
from report.document.sections import Section, section
from report.document.tables import Column, Table, listed
from report.figures.base import power_of_ten
from report.manual import work_figures as figures
from report.text.error_text import percent, seconds
from report.text.letter_case import capitalized
from report.text.names import joined
from report.text.units import number
from solver.rivals.methods import METHODS
from solver.sliding.two_axes import DEFAULT_TOLERANCE
from solver.verification.checks import RANDOM, ROOF
from solver.verification.evidence import Verification
from solver.verification.workprecision import OURS, RUN, SINGLE, TIME, times_longer


def floor(verification: Verification) -> float:
    """Return the largest relative error of the exact method against 50-digit arithmetic."""
    errors = [row.error for row in verification.checks if row.section.endswith("digits")]
    # A chart in logarithms has no place for 0.
    # Less than the spacing of floating-point numbers at 1, 2.2e-16.
    return max([1e-16, *errors])


_KNOBS = {
    "": "no setting", "substeps": "sub-steps per interval",
    "stiffness_per_m": "link stiffness [1/m]", "velocity_mps": "velocity v₀ [m/s]",
}  # fmt: skip
_METHODS = (
    (words("Method", 1.7), lambda method: method.title),
    (words("Accuracy set by", 1.5), lambda method: _KNOBS[method.knob]),
    (centered("Order", 0.55), lambda method: number(method.order, 0)),
    (centered("Vertical", 0.75), lambda method: "yes" if method.takes_vertical else "no"),
    (words("Limitations", 3.6), lambda method: method.invalid_when),
    (words("Source", 2.6), lambda method: method.source),
)


def methods(verification: Verification) -> Section:
    """Return the description of each method, and its errors against 50 digits."""
    errors = verification.rivals
    kinds = errors.pivot(columns="motions", values="error [%]").assign(method=errors["method"])
    name = (words("Method", 3.6), lambda row: METHODS[row[0]].title)
    of_kinds = (_errors(capitalized(kind), kind, reference="") for kind in (RANDOM, ROOF))
    return section(
        "manual/methods",
        "Methods compared",
        methods=listed(METHODS.values(), _METHODS, kind="compact"),
        errors=listed(
            kinds.groupby("method", sort=False),
            (name, *itertools.chain.from_iterable(of_kinds)),
            kind="compact",
        ),
    )


_WORK = (
    "Two axes and one axis. Points: medians over the analysis cases; thin lines: to the largest "
    "error. Lower points are more accurate; points further left are faster."
)


def work(verification: Verification) -> Section:
    """Return accuracy against run time."""
    runs, floor_share = verification.work, floor(verification)
    plane = verification.models[0].work if verification.models else runs[:0]
    # The tolerance of a package: what the manual says of accuracy is of the numbers that are
    # sealed.
    ours = plane[(plane["method"] == OURS) & (plane["setting"] == DEFAULT_TOLERANCE)]
    return section(
        "manual/work",
        "Accuracy against run time",
        cases=len(runs[RUN].drop_duplicates()),
        caption=f"{_WORK} {_missing(runs)}",
        floor_percent=100.0 * floor_share,
        plane_records=list(plane["record"].unique()),
        plane_cases=list(plane["case"].unique()),
        median_percent=ours["residual error [%]"].median(),
        largest_percent=ours["residual error [%]"].max(),
        in_plane=times_longer(
            plane[plane["method"].str.endswith("(compiled)")], ours, "residual error [%]"
        ),
        medians=_medians(runs),
        charts={"work-percent": figures.overview(runs, plane, 100.0 * floor_share)},
    )


def _missing(runs: pd.DataFrame) -> str:
    lost = runs[runs[[TIME, "PRD error [m]"]].isna().any(axis=1)]
    if lost.empty:
        return f"All {len(runs)} runs gave a result."
    of_each = [f"{name}: {n}" for name, n in lost.groupby("method", sort=False).size().items()]
    return f"{len(lost)} of {len(runs)} runs failed and are not drawn ({joined(of_each)})."


def _medians(runs: pd.DataFrame) -> Table:
    return listed(
        _shown(runs),
        (
            (words("Method", 3.6), lambda row: row[0]),
            (words("Setting", 1.4), lambda row: _setting(*row[1].iloc[0][["method", "setting"]])),
            (text("Time per run", share=1.2), lambda row: seconds(row[1][TIME].median())),
            (text("Single run", share=1.2), lambda row: seconds(row[1][SINGLE].median())),
            *_errors("Error in PRD", "PRD error [%]"),
            *_errors("Error in residual", "residual error [%]"),
            (text("Failed", share=0.7), lambda row: row[1][TIME].isna().sum()),
        ),
        kind="compact",
    )


def _shown(runs: pd.DataFrame) -> Iterator[tuple[str, pd.DataFrame]]:
    """Yield the runs of each setting that is shown, the first with the name of its method."""
    for name, of_method in runs.groupby("method", sort=False):
        groups = [group for _, group in of_method.groupby("setting", sort=False, dropna=False)]
        # Every other setting of a long sweep keeps the table short.
        for count, group in enumerate(groups[::2] if len(groups) > 5 else groups):
            yield "" if count else METHODS[str(name)].title, group


def _setting(method: str, value: float) -> str:
    knob = METHODS[method].knob
    if knob == "substeps":
        return f"P = {value:g}"
    form = {"stiffness_per_m": "k = {} /m", "velocity_mps": "v₀ = {} m/s"}
    return form[knob].format(power_of_ten(value)) if knob in form else "none"


def _errors(head: str, error: str, reference: str = "exact") -> tuple[Column, Column]:
    """Return the columns of the median and of the largest error."""

    def found(runs: pd.DataFrame, statistic: str) -> str:
        # It is what the others are compared with; its own error is against 50 digits.
        is_reference = runs["method"].iloc[0] == reference
        return "reference" if is_reference else percent(runs[error].agg(statistic))

    return (
        (text(head, "median", 1.2), lambda row: found(row[1], "median")),
        (text(head, "largest", 1.2), lambda row: found(row[1], "max")),
    )
