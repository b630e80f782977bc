"""Margins and confidence: clearances, directions, smaller events."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from report.assessment.cumulative import Cumulative
from report.assessment.evidence import Evidence
from report.assessment.friction import mu_words
from report.assessment.trials import with_mu
from report.assessment.uncertainty import Margin
from report.document.tables import Table, listed
from report.entities.shown import length, required, text, words
from report.pages.parts import PackageData
from report.words.counts import lowered
from report.words.units import number
from solver.model import DefectError
from solver.rules.provisions import Neighbor


def margins(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return margins in friction, other directions, and sums over smaller events."""
    uncertainty, sums = evidence.uncertainty, evidence.cumulative
    if uncertainty is None:
        raise DefectError("a package without motions has no page on margins")
    return {
        "found": uncertainty,
        "margin": _smallest(uncertainty.margins),
        "margins": _margin_table(package, uncertainty.margins),
        "sums": _sum_table(package, sums) if sums else None,
    }


def _smallest(margins: Sequence[Margin]) -> Mapping[str, object]:
    """Return the smallest margin of a satisfied clearance, and the clearances without one."""
    have = [margin for margin in margins if margin.gap.ok and not math.isnan(margin.minimum_mu)]
    without = {margin.number for margin in margins} - {margin.number for margin in have}
    unknown = {margin.number for margin in margins if not margin.gap.is_permitted}
    smallest = max(have, key=_share, default=None)
    return {
        "smallest": smallest,
        "percent_less": 100.0 * (1.0 - _share(smallest)) if smallest else 0.0,
        "least": _least(smallest) if smallest else "",
        "is_beyond": all(margin.is_beyond for margin in have),
        "short": sorted(without - unknown),
        "unknown": sorted(unknown),
        "alike": any(margin.gap.neighbor is Neighbor.LIKE for margin in margins),
    }


def _share(margin: Margin) -> float:
    mu = margin.array.array.mu
    return margin.minimum_mu / mu if mu > 0.0 else 1.0


def _least(margin: Margin) -> str:
    return mu_words(with_mu(margin.array.array, margin.minimum_mu).friction)


def _margin_table(package: PackageData, margins: Sequence[Margin]) -> Table:
    def least(margin: Margin) -> str:
        if math.isnan(margin.minimum_mu):
            return "none"
        return f"≤ {_least(margin)}" if margin.is_beyond else _least(margin)

    columns = (
        (words("No.", 0.8), lambda margin: str(margin.number)),
        (words("Array", 0.8), lambda margin: margin.array.id),
        (
            text("μ", "given", package.mu_share),
            lambda margin: mu_words(margin.array.array.friction),
        ),
        (text("μ", "least", package.mu_share), least),
        (text("Change", "%", 0.9), lambda margin: number(100.0 * (_share(margin) - 1.0), 1)),
        (
            required("Required there", 0.9),
            lambda margin: "—" if math.isnan(margin.minimum_mu) else margin.required_m,
        ),
        (length("Provided", 0.9), lambda margin: margin.gap.clearance.provided_m),
        (words("Limited by", 1.6), lambda margin: lowered(margin.limited_by)),
    )
    return listed(margins, columns, package.fmt, kind="compact")


def _sum_table(package: PackageData, sums: Sequence[Cumulative]) -> Table:
    """Return mean and largest sum of each array over the design event and smaller ones."""
    factor = package.governing.analysis.factor  # that of every array
    times = f"{number(factor, 2)} × "
    columns = (
        (words("Array"), lambda item: item.array.id),
        (required(f"{times}mean sum"), lambda item: factor * item.mean_m),
        (required(f"{times}largest sum"), lambda item: factor * item.largest_m),
        (required("Design displacement"), lambda item: item.array.design_m),
    )
    return listed(sums, columns, package.fmt, kind="compact")
