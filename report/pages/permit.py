"""The letter edition: a letter with the table by array and the conditions, then the plan.

For a permit set: one to six arrays by the prescriptive displacement, on two sheets.
`report.project.check.faults` rejects projects that do not fit.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import partial

from report.assessment.design.friction import mu_words
from report.assessment.design.verdict import Verdict
from report.assessment.support.plan_gaps import keep_clear_m
from report.document.columns import centered, plain, required, text, words
from report.document.tables import Column, Table, headed, listed, stamp
from report.pages import cover
from report.pages.checks import open_cells, verdict_sentence
from report.pages.marks import prescriptive_key
from report.pages.parts import PackageData, friction_report
from report.pages.symbols import with_symbols
from report.text.units import number
from solver.rules.provisions import SEPARATION_KEYS, Neighbor

_SEPARATIONS = {
    "To a similar array": Neighbor.LIKE,
    "To an object or other array": Neighbor.FIXED,
    "To an edge with parapet": Neighbor.PARAPET,
    "To an edge without parapet": Neighbor.EDGE,
}


def letter(package: PackageData) -> Mapping[str, object]:
    """Return the first sheet: project, verdict, and what each array requires."""
    done, data = package.assessment, package.data
    factors = {key: number(done.rules[key], 2) for key in SEPARATION_KEYS.values()}
    return {
        **cover.page(package),
        "kind": "permit letter",
        "sheet": package.printed_plan.size.sheet,
        "verdict": stamp(done.verdict, done.verdict.value),
        "verdict_sentence": verdict_sentence(done),
        "data": data,
        "s_ds": number(data.site.s_ds, 3),
        "i_e": number(data.site.i_e, 2),
        "prescriptive_clause": done.rules.values[prescriptive_key(done.governing)].clause,
        "clause": package.marks.clause("separation_fixed"),
        "factors": factors,
        "has_importance": done.rules.importance_in_separation,
        "arrays": _arrays(package),
        "report": friction_report(data.friction_tests),
        "fingerprint": package.fingerprint,
        "workbook": done.source.path.name,
        "open_checks": _open_checks(package) if done.open else None,
    }


def _arrays(package: PackageData) -> Table:
    """Return slope, friction, displacement and the four separations of each array."""
    columns: list[Column] = [
        (words("Array", 0.9), lambda item: item.id),
        (plain("Slope", 2, "deg", 0.8), lambda item: math.degrees(item.array.slope_rad)),
        (text("μ"), lambda item: mu_words(item.array.friction)),
        (required("Δ", 0.8), lambda item: item.design_m, package.marks.design),
        *(_separation(package, head, neighbor) for head, neighbor in _SEPARATIONS.items()),
        (centered("Verdict", 1.2), package.assessment.array_verdict),
    ]
    fmt = replace(package.fmt, systems=1)
    return listed(package.assessment.arrays, columns, fmt, kind="compact")


def _separation(package: PackageData, head: str, neighbor: Neighbor) -> Column:
    mark = package.marks.of(SEPARATION_KEYS[neighbor])
    separation_m = partial(keep_clear_m, package.assessment, neighbor=neighbor)
    return required(head, 1.2), separation_m, lambda _: mark


def _open_checks(package: PackageData) -> Table:
    """Return the open checks and who must act; NG items are marked."""
    rows = []
    for check in package.assessment.open:
        mark = stamp(check.verdict) if check.verdict is Verdict.NG else ""
        rows.append((*map(with_symbols, open_cells(check, package.data.us_first)), mark))
    heads = ("Open", 2.2), ("Found", 2.6), ("Required", 3.5), ("Action by", 0.9)
    return headed(*heads, ("", 0.3, "center"), rows=rows, kind="compact")
