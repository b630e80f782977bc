"""Comparison of models: effect of each fuller model, two axes against general solvers, time."""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterator, Mapping
from typing import Any

import numpy as np
import pandas as pd

from report.document.tables import Column, listed
from report.document.templates import Section, section
from report.entities.shown import plain, text, words
from report.figures import work as figures
from report.figures.base import power_of_ten
from report.text.counts import lettered
from report.text.formats import general, percent, scientific, seconds, ten_digits, two_digits
from solver.verification.evidence import ModelEvidence, StaticEvidence, Verification

CHANGED = 1e-3
"""Least relative change of the PRD for which a case counts as changed."""

_CHANGE = (
    (words("Comparison", 4.0), lambda change: change.name),
    (text("Runs"), lambda change: change.ratios.size),
    (plain("Least"), lambda change: change.at(0.0)),
    (plain("10 %"), lambda change: change.at(10.0)),
    (plain("Median"), lambda change: change.at(50.0)),
    (plain("90 %"), lambda change: change.at(90.0)),
    (plain("Largest"), lambda change: change.at(100.0)),
    (plain("Above 1", 0, "%"), lambda change: 100.0 * change.share_above_one),
    (text("Excluded", share=1.1), lambda change: change.n_small),
    (plain("Largest change", 0, "mm", 1.3), lambda change: 1e3 * change.maximum_m),
)

_WORK = (
    (words("Method", 3.2), lambda row: row[0]),
    (words("Setting", 1.2), lambda row: _setting(row[1]["parameters"])),
    (text("Time per run", share=1.2), lambda row: seconds(row[1]["time per run [s]"])),
    (text("Position error", share=1.2), lambda row: _error(row[1])),
)

_BOUND = (
    (words("Kind of pair", 2.4), lambda group: group.kind.replace("mu", "μ")),
    (text("Pairs"), lambda group: group.n_pairs),
    (text("With slip"), lambda group: group.ratios.size),
    (text("Median"), lambda group: two_digits(float(np.percentile(group.ratios, 50)))),
    (text("99 %"), lambda group: two_digits(float(np.percentile(group.ratios, 99)))),
    (text("Largest"), lambda group: two_digits(float(np.percentile(group.ratios, 100)))),
    (text("Above 1"), lambda group: group.n_over),
    (text("No result"), lambda group: group.n_unanswered),
)

_STOP = (
    (words("Method", 3.4), lambda run: lettered(run["method"])),
    (words("Setting", 1.1), lambda run: _setting(run["parameters"])),
    (text("Position error", "mm", 1.3), lambda run: _position(run["position error [m]"])),
    (
        text("Final velocity", "mm/s", 1.3),
        lambda run: two_digits(1e3 * run["final velocity [m/s]"]),
    ),
)

_PUSHED = (
    (text("Transverse acceleration", "m/s²", 1.5), lambda row: ten_digits(row.Index)),
    (plain("Distance", 2, "mm"), lambda row: 1e3 * row.end_m),
    (text("Error reported by the run", "mm", 1.6), lambda row: scientific(1e3 * row.error_m)),
    (plain("Distance, gradual decrease of μ", 2, "mm", 2.0), lambda row: 1e3 * row.falling_end_m),
)


def models(verification: Verification) -> Section:
    """Return the comparison of the models."""
    return section(
        "manual/models",
        "Models: one axis, two axes and rows of blocks",
        CHANGED=CHANGED,
        least_ratio=power_of_ten(figures.LEAST_RATIO),
        models=[(evidence, _found(evidence)) for evidence in verification.models],
        charts={
            name: svg
            for evidence in verification.models
            for name, svg in (
                ("rungs-changes", figures.changes(evidence.study.changes)),
                ("rungs-work", figures.work(evidence.work)),
                ("rungs-bounds", figures.bounds(evidence.bounds)),
            )
        },
    )


def _found(evidence: ModelEvidence) -> Mapping[str, Any]:
    """Return the tables."""
    study, static = evidence.study, evidence.static
    return {
        "changes": listed(study.changes, _CHANGE, kind="compact"),
        "work": listed(_shown(evidence.work), _WORK, kind="compact"),
        "bounds": listed(evidence.bounds, _BOUND, kind="compact"),
        "stops": listed(evidence.stops.to_dict("records"), _STOP, kind="compact"),
        "pushed": listed(static.pushed.itertuples(), _PUSHED, kind="compact"),
        **(_static(static) if static.n_scenes else {}),
    }


def _static(static: StaticEvidence) -> Mapping[str, Any]:
    ratio = f"Static / kinetic μ = {static.ratio:.4g}"
    difference = (
        (text("Static / kinetic μ", share=1.4), lambda row: general(1.0 + row[0])),
        *_middle_and_top("One axis", "one_axis"),
        *_middle_and_top("Two axes", "two_axes"),
    )
    fading = (
        (text("Factor on second component", share=1.4), lambda row: general(row[0])),
        *_middle_and_top("One coefficient", "one_coefficient"),
        *_middle_and_top(ratio, "static_above"),
    )
    return {
        "powers": _powers(static),
        "difference": listed(static.differences.items(), difference, kind="compact"),
        "fading": listed(static.fading.items(), fading, kind="compact"),
    }


def _middle_and_top(head: str, name: str) -> tuple[Column, Column]:
    """Return the columns of the median and of the largest of the changes of all scenes."""
    return (
        (text(head, "median"), lambda row: percent(100.0 * row[1][name].median())),
        (text(head, "largest"), lambda row: percent(100.0 * row[1][name].max())),
    )


def _powers(static: StaticEvidence) -> list[float]:
    """Return the observed order of the median in one axis and in two, from the last differences.

    The largest change is of a single case, whose terms of second and third order may still cancel.
    """
    (former, more), (last, less) = list(static.differences.items())[-2:]
    orders: list[float] = (np.log(more.median() / less.median()) / math.log(former / last)).tolist()
    return orders


def _shown(runs: pd.DataFrame) -> Iterator[tuple[str, Mapping[Hashable, Any]]]:
    """Yield the runs that are shown, the first of each method with its name."""
    for name, group in runs.groupby("method", sort=False):
        own = group.to_dict("records")
        for count, run in enumerate(own[::2] if len(own) > 3 else own):
            yield "" if count else lettered(str(name)), run


def _setting(words: str) -> str:
    name, _, value = words.partition(" ")
    return f"{name} {power_of_ten(float(value))}" if name == "tol." else words


def _error(run: Mapping[Hashable, Any]) -> str:
    return "failed" if math.isnan(run["time per run [s]"]) else percent(run["residual error [%]"])


def _position(error_m: float) -> str:
    return "stalled" if math.isnan(error_m) else two_digits(1e3 * error_m)
