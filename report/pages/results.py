"""Results by array, and the numbers of the equations that are not in the assessment.

The latter are those of the governing array, unrounded; its equations are in `method.html`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from operator import attrgetter, methodcaller

from markupsafe import Markup

from report.assessment.checks.alike import alike
from report.assessment.checks.check import STRENGTH_ROW, Check
from report.assessment.checks.sentence import texts
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.verdict import severity
from report.assessment.support.evidence import Evidence
from report.document.columns import ColumnHead, required, text, words
from report.document.tables import Column, Table, TableRow, Wide, listed, stamp
from report.drawing.items import drawn_slope_deg
from report.pages.marks import prescriptive_key
from report.pages.parts import PackageData, statistic
from report.project.model.choices import Direction
from report.runs import MotionRun
from report.text.counts import grouped_by, named
from report.text.unit_format import UnitFormat
from report.text.units import Quantity, no_less, number, ratio
from solver.model import Orientation, Status
from solver.rules.provisions import SEPARATION_KEYS

_Alike = Sequence[ArrayAssessment]
# Peaks in the equation of their mean; those after them are dots.
_MOST_PEAKS = 12
_WAYS = (Direction.DOWN, Direction.UP, Direction.ACROSS)
_SHORT = {
    Status.OK: "at rest",
    Status.SLIDING_AT_END: "sliding",
    Status.UPLIFT: "uplift",
    Status.DIVERGED: "no result",
    Status.STEP_LIMIT: "no result",
}


def below(package: PackageData) -> tuple[tuple[str, str], ...]:
    """Return the parts below, in order."""
    groups = ([item.id for item in group] for group in package.assessment.alike)
    return tuple((f"results-{n}", named(ids, "Array")) for n, ids in enumerate(groups, start=1))


def page(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return the results of every group of arrays that share their runs, without the charts."""
    alike = package.assessment.alike
    followed = [history for paths in evidence.histories for history in paths]
    return {
        "groups": [_results(package, group) for group in alike],
        "is_drawn_across": any(history.across_m.size for history in followed),
    }


def histories(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return what the captions of histories and paths say, by group of arrays."""
    return {
        "groups": [
            {
                "names": named([item.id for item in group], "Array"),
                "is_drawn_across": any(path.across_m.size for path in paths),
                "straight": [
                    run.motion.id
                    for run, path in zip(group[0].motions, paths, strict=True)
                    # In one axis a path is a line along the slope: it is drawn, and the caption
                    # says why.
                    if not path.across_m.size and path.result.prd_m > 0.0
                ],
            }
            for group, paths in zip(package.assessment.alike, evidence.histories, strict=True)
        ]
    }


def _results(package: PackageData, group: _Alike) -> Mapping[str, object]:
    array, runs = group[0], group[0].runs
    # Every one that any motion is run in: motions may differ in their components and polarities.
    orientations = sorted(
        {run.orientation for run in runs}, key=lambda way: (way.is_transverse, -way.polarity)
    )
    return {
        "array": array,
        # Arrays share their runs by what a run takes; of what they are built the runs know nothing.
        "constructions": dict.fromkeys(item.array.construction for item in group),
        "slope_percent": 100.0 * math.tan(array.array.slope_rad),
        "table": _peaks(package, group, orientations),
        "is_prd_across": not all(run.has_across for run in runs),
        "troubles": package.sentences("runs", [item.id for item in group]),
    }


def _peaks(package: PackageData, group: _Alike, orientations: Sequence[Orientation]) -> Table:
    """Return the runs of every motion, and below them the statistics and the design value."""
    fmt, changed = package.fmt, package.changes.values
    unit = fmt.units()[0].symbol

    def in_first(head: str, below: str) -> ColumnHead:
        """Return how a length is shown in the preferred system alone."""
        return ColumnHead(head=f"{head}, {unit}", unit=below, text=partial(fmt.first, show=no_less))

    columns: list[Column] = [
        (words("Motion"), attrgetter("motion.id")),
        *(
            (
                text(f"PRD of each run, {unit}", _short(orientation), 0.95),
                partial(_peak, fmt, orientation),
            )
            for orientation in orientations
        ),
        (required("Governing PRD", 1.08), attrgetter("governing.prd_m")),
        *((in_first("Largest of all runs", d.value), methodcaller("peak_m", d)) for d in _WAYS),
        (in_first("Residual", "down"), attrgetter("governing.result.residual_m")),
        (in_first("Residual", "across"), attrgetter("governing.result.residual_across_m")),
        (text("Time", "s", 0.85), lambda run: number(run.governing.result.t_prd_s, 2)),
        (text("N/(m g)", share=1.2), lambda run: number(run.governing.result.n_min_g, 2)),
        (words("Status", 1.05), lambda run: _SHORT[run.governing.result.status]),
    ]
    table = listed(
        group[0].motions,
        columns,
        fmt,
        kind="compact",
        style=lambda run: package.bar(any((item.id, run.motion.id) in changed for item in group)),
    )
    return replace(table, rows=(*table.rows, *_statistics(package, group, len(orientations))))


def _short(orientation: Orientation) -> str:
    return f"{'tr.' if orientation.is_transverse else 'rec.'} {orientation.name[-1]}"


def _peak(fmt: UnitFormat, orientation: Orientation, motion: MotionRun) -> str:
    """Return the PRD of one run in the first unit; blank where the motion has no such run."""
    for run in motion.runs:
        if run.orientation == orientation:
            peak = fmt.first(run.prd_m, show=no_less)
            return Markup("<b>{}</b>").format(peak) if run is motion.governing else peak
    return ""


def _statistics(package: PackageData, group: _Alike, runs: int) -> Iterator[TableRow]:
    array, fmt = group[0], package.fmt
    analysis, head = array.analysis, required("")
    factor = f"{statistic(analysis.basis)}, {package.marks.clause('analysis_factor')}"
    floor_m = array.floor_m or math.nan  # peer review removes it
    # The keys are those of results.json, by which changes are known.
    rows: Sequence[tuple[str, str, float, str, str]] = (
        ("mean_prd_m", "Mean", analysis.mean_m, "", "of the motions"),
        ("largest_prd_m", "Largest", analysis.largest_m, "", "of the motions"),
        ("computed_m", f"Analysis: {factor}", analysis.value_m, array.overridden.analysis, ""),
        ("floor_m", f"Floor: {_floor_words(package)}", floor_m, package.marks.floor(array), ""),
        (
            "design_m",
            "Design",
            array.design_m,
            package.marks.design(array),
            f"governed by: {array.source}",
        ),
    )
    for key, label, value_m, mark, about in rows:
        is_changed = any((item.id, key) in package.changes.values for item in group)
        yield TableRow(
            cells=(
                Wide(label, 1 + runs),
                *head.cells(value_m, fmt.none, head.units(fmt), mark),
                Wide(about, len(_WAYS) + 5),
            ),
            kind=package.bar(is_changed, "total"),
        )


def _floor_words(package: PackageData) -> str:
    if package.data.is_peer_reviewed:
        return "none; the analysis is peer reviewed"
    share = number(100.0 * package.assessment.rules["analysis_floor"], 0)
    return f"{share} % of prescriptive, {package.marks.clause('analysis_floor')}"


def equations_below(package: PackageData) -> tuple[tuple[str, str], ...]:
    """Return the parts below, in order."""
    motion = ("method-motion", "Motion of an array")
    return (
        *([motion] if package.assessment.has_motions else []),
        ("method-design", "Design displacement"),
        ("method-separation", "Separations"),
    )


def equations(package: PackageData) -> Mapping[str, object]:
    """Return what the equations need beside the package."""
    # Several arrays may have it: the text then says that the equations are of one of them.
    largest_m = package.governing.design_m
    return {
        "is_shared": sum(item.design_m == largest_m for item in package.assessment.arrays) > 1,
        **_motion(package),
        **_weights(package),
        **_design(package),
        **_separations(package),
    }


def _motion(package: PackageData) -> Mapping[str, object]:
    """Return the forces with the roof at rest / m g, and the accelerations that begin sliding."""
    array = package.governing.array
    theta, law, drawn_deg = array.slope_rad, array.friction, drawn_slope_deg(array)
    phi = math.atan(law.mu_static)
    # At 0.1 m/s, an example: mu(v) = mu_fast - (mu_fast - mu_slow) exp(-r v).
    decay = math.exp(-0.1 * law.rate_s_per_m) if law.is_by_velocity else 1.0
    return {
        # A slope that could not be seen is drawn steeper, and the caption says so.
        "drawn_deg": None if math.isclose(math.degrees(theta), drawn_deg) else drawn_deg,
        "phi_rad": phi,
        "cos": math.cos(theta),
        "sin": math.sin(theta),
        "holding": law.mu_static * math.cos(theta),
        "rests": math.tan(theta) <= law.mu_static,
        # a_down = -g tan(phi - theta), a_up = g tan(phi + theta): there the shear is mu N.
        "down_g": -math.tan(phi - theta),
        "up_g": math.tan(phi + theta),
        "mu_at_tenth": law.mu_fast - (law.mu_fast - law.mu_slow) * decay,
    }


def _weights(package: PackageData) -> Mapping[str, object]:
    """Return the weight over plan area of the governing array, and the range of the others."""
    own, fmt = package.governing.array, package.fmt
    others = [array.weight_pa for array in package.data.arrays if array.id != own.id]
    ends = [fmt.first(end(others), Quantity.PRESSURE) for end in (min, max) if others]
    unit = fmt.units(Quantity.PRESSURE)[0].symbol
    return {
        "weight_pa": own.weight_pa,
        "other_weights": " to ".join(dict.fromkeys(ends)) + f" {unit}" if others else "",
    }


def _design(package: PackageData) -> Mapping[str, object]:
    array, checks = package.governing, package.assessment.checks
    strengths = [check for check in checks if check.id == STRENGTH_ROW]
    strength = max(strengths, key=_exceeds)
    peaks = [
        package.fmt.first(run.governing.prd_m, show=no_less) for run in array.motions[:_MOST_PEAKS]
    ]
    peaks += ["…"] * (len(array.motions) > _MOST_PEAKS)
    arrays = package.assessment.arrays
    return {
        "statistic": statistic(array.analysis.basis),
        "prescriptive_clause": package.marks.clause(prescriptive_key(array)),
        "prescriptive_mark": package.marks.prescriptive(array),
        "analysis_mark": array.overridden.analysis,
        "floor_mark": package.marks.floor(array),
        "design_mark": package.marks.design(array),
        "troubles": package.sentences("runs", [array.id]),
        "peaks": " + ".join(peaks),
        "unit": package.fmt.units()[0].symbol,
        "by_routes": [
            (check.subject, stamp(check.verdict))
            for check in alike(check for check in checks if check.id == "design")
        ],
        "interconnected": next(item for item in arrays if item.id == strength.subject).array,
        "strength": _compared(strength, package.fmt.us_first),
    }


def _exceeds(check: Check) -> tuple[float, float]:
    """Return what the governing of checks has most of; one that is not given has no ratio."""
    is_known = math.isfinite(check.ratio)
    return severity(check.verdict) if is_known else -1.0, check.ratio if is_known else 0.0


def _compared(check: Check, us_first: bool) -> tuple[str, Markup]:
    """Return the number of a check that an equation ends in, and how it compares: its verdict.

    That number is the demand; of a pathway, which is the narrower the more an array slides, it is
    what is left.
    """
    is_left = check.id == "fire_pathway"
    both, first = texts(check, us_first), texts(check, us_first, is_both=False)
    result, other = first if is_left else (both[1], first[0])
    result, other = (each.removeprefix(f"{check.sense} ") for each in (result, other))
    if not math.isfinite(check.ratio):
        return result, Markup("; provided: {}, {}").format(other, stamp(check.verdict))
    sign = ("≥" if is_left else "≤") if check.is_satisfied else ("<" if is_left else ">")
    parts = sign, other, ratio(check.ratio), stamp(check.verdict)
    return result, Markup(" {} {}, D/C {}, {}").format(*parts)


def _separations(package: PackageData) -> Mapping[str, object]:
    """Return the governing clearance of each condition that occurs, and what else Δ narrows.

    What has no permitted displacement has no equation: `unknown` are the arrays.
    """
    done, us_first = package.assessment, package.fmt.us_first
    clauses = {done.rules.values[key].clause for key in SEPARATION_KEYS.values()}
    of_kind = grouped_by(done.checks, attrgetter("id"))
    finite = [
        (gap, check)
        for gap, check in zip(done.clearances, of_kind.get("clearance", ()), strict=True)
        if math.isfinite(check.ratio)
    ]
    largest = sorted(finite, key=lambda pair: -pair[1].ratio)
    kinds = grouped_by(largest, lambda pair: pair[0].neighbor)
    others = [
        max(known, key=_exceeds)
        for kind in ("electrical_slack", "fire_pathway")
        if (known := [each for each in of_kind.get(kind, ()) if math.isfinite(each.ratio)])
    ]
    return {
        "separation_clauses": sorted(clauses),
        "separations": [
            (some[0][0], SEPARATION_KEYS[kind], _compared(some[0][1], us_first))
            for kind, some in kinds.items()
        ],
        "others": [(check, _compared(check, us_first)) for check in others],
        "unknown": [item.id for item in done.arrays if math.isnan(item.permitted_m)],
    }
