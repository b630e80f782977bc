"""The equations with the numbers of the governing array, unrounded until they are printed.

    1.10† × 43.1 in (1095 mm) = 47.4 in (1204 mm)    k_a × mean of the motions

Read `page`; `method.html` has the equations.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from operator import attrgetter

from markupsafe import Markup

from report.assessment.checks.check import STRENGTH_ROW, Check
from report.assessment.checks.sentence import alike, texts
from report.assessment.design.clearances import ClearanceCheck
from report.assessment.design.routes import Route
from report.assessment.design.verdict import severity
from report.document.tables import stamp
from report.drawing.drawn_slope import drawn_slope_deg
from report.pages.marks import prescriptive_key
from report.pages.parts import PackageData, statistic
from report.project.model.array import Array
from report.text.grouping import grouped_by
from report.text.names import named
from report.text.units import NO_BREAK, Quantity, no_less, number, ratio
from report.typeset.equations import fraction
from solver.rules.provisions import SEPARATION_KEYS, Basis, PrescriptiveBasis

# Peaks in the equation of their mean; those after them are dots.
_MOST_PEAKS = 12


def below(package: PackageData) -> tuple[tuple[str, str], ...]:
    """Return the parts below, in order."""
    motion = ("method-motion", "Motion of an array")
    return (
        *([motion] if package.assessment.has_motions else []),
        ("method-design", "Design displacement"),
        ("method-separation", "Separations"),
    )


def page(package: PackageData) -> Mapping[str, object]:
    """Return the numbers of each equation."""
    done, array = package.assessment, package.assessment.governing
    # Several arrays may have it: the text then says that the equations are of one of them.
    n_largest = sum(item.design_m == array.design_m for item in done.arrays)
    if math.isnan(array.design_m):
        has = "which has no design displacement"
    elif n_largest > 1:
        has = "one of the arrays with the largest design displacement"
    else:
        has = "which has the largest design displacement"
    return {
        "array": array.id,
        "has": f", {has}" if len(done.arrays) > 1 else "",
        "has_motions": done.has_motions,
        "motion": _motion(package) if done.has_motions else None,
        **_prescriptive(package),
        "analysis": _analysis(package) if done.has_motions else None,
        "troubles": package.sentences("runs", [array.id]) if done.has_motions else [],
        **_design(package),
        **_separations(package),
        **_strength(package),
    }


def _motion(package: PackageData) -> Mapping[str, object]:
    """Return the forces with the roof at rest / m g, and the accelerations that begin sliding."""
    array, fmt = package.assessment.governing.array, package.fmt
    theta, law, drawn_deg = array.slope_rad, array.friction, drawn_slope_deg(array)
    phi = math.atan(law.mu_static)
    # At 0.1 m/s, an example: mu(v) = mu_fast - (mu_fast - mu_slow) exp(-r v).
    decay = math.exp(-0.1 * law.rate_s_per_m) if law.is_by_velocity else 1.0
    # a_down = -g tan(phi - theta), a_up = g tan(phi + theta): there the shear is mu N.
    down_g, up_g = -math.tan(phi - theta), math.tan(phi + theta)
    drawn = ""
    # A slope that could not be seen is drawn steeper, and the caption says so.
    if not math.isclose(math.degrees(theta), drawn_deg):
        drawn = f"{number(drawn_deg, 0)}° instead of {number(math.degrees(theta), 2)}°"
    return {
        "is_by_velocity": law.is_by_velocity,
        "slow": number(law.mu_slow, 3),
        "fast": number(law.mu_fast, 3),
        "rate": number(law.rate_s_per_m, 1),
        "tenth": fmt.both(0.1, Quantity.VELOCITY),
        "mu_at_tenth": number(law.mu_fast - (law.mu_fast - law.mu_slow) * decay, 3),
        "theta": f"{number(math.degrees(theta), 3)}°",
        "phi": f"{number(math.degrees(phi), 3)}°",
        "mu": number(law.mu_static, 3),
        "cos": number(math.cos(theta), 4),
        "sin": number(math.sin(theta), 4),
        "holding": number(law.mu_static * math.cos(theta), 4),
        "rests": math.tan(theta) <= law.mu_static,
        "down": f"{number(down_g, 3)}{NO_BREAK}g",
        "up": f"{number(up_g, 3)}{NO_BREAK}g"
        if up_g > 0.0
        else "none: the array cannot slide upslope",
        "section": f"Section through array {array.id} with its free body",
        "drawn": drawn,
        "weight": fmt.both(array.weight_pa, Quantity.PRESSURE),
        "other_weights": _other_weights(package, array),
    }


def _other_weights(package: PackageData, array: Array) -> str:
    """Return the range of the weight over plan area of the other arrays; nothing without any."""
    fmt = package.fmt
    weights = [item.weight_pa for item in package.data.arrays if item.id != array.id]
    if not weights:
        return ""
    ends = [fmt.first(weight, Quantity.PRESSURE) for weight in (min(weights), max(weights))]
    return f"{' to '.join(dict.fromkeys(ends))}{NO_BREAK}{fmt.units(Quantity.PRESSURE)[0].symbol}"


def _prescriptive(package: PackageData) -> Mapping[str, object]:
    """Return the prescriptive displacement and what it is computed from."""
    done, fmt, marks = package.assessment, package.fmt, package.marks
    rules, site, array = done.rules, package.data.site, done.governing
    delta, mark = array.prescriptive, marks.of("prescriptive_factor_in")
    routes = alike(check for check in done.checks if check.id == "design")
    i_e = "" if rules.importance_in_separation else r"I_e\,"
    return {
        "sdc": site.sdc_text,
        "prescriptive": fmt.both_up(delta.value_m, marks.prescriptive(array)),
        "is_low_category": delta.governs is PrescriptiveBasis.LOW_CATEGORY,
        "prescriptive_clause": marks.clause(prescriptive_key(array)),
        "factor_clause": marks.clause("prescriptive_factor_in"),
        "has_importance_in_separation": rules.importance_in_separation,
        "prescriptive_equation": rf"\Delta_{{MPV}}=k_p\,{i_e}(S_{{DS}}-0.4)^2\geq\Delta_{{min}}",
        "prescriptive_factor": f"{rules['prescriptive_factor_in']:g}{NO_BREAK}in{mark}",
        "i_e": number(site.i_e, 2),
        # Below 0.4, the square of S_DS - 0.4 would rise again, the weaker the earthquake.
        "s_ds_or_least": number(max(site.s_ds, 0.4), 3),
        "prescriptive_minimum": fmt.both_up(delta.minimum_m, marks.of("prescriptive_minimum_in")),
        "prescriptive_governs": delta.governs,
        "by_routes": Markup(", ").join(
            Markup("{} {}").format(check.subject, stamp(check.verdict)) for check in routes
        ),
    }


def _analysis(package: PackageData) -> Mapping[str, object] | None:
    """Return the value from analysis and what it is computed from; nothing without a value."""
    array, fmt, marks = package.assessment.governing, package.fmt, package.marks
    analysis = array.analysis
    if math.isnan(analysis.value_m):
        return None
    is_largest = analysis.basis is Basis.LARGEST_FACTORED
    peaks = [fmt.first(run.governing.prd_m, show=no_less) for run in array.motions[:_MOST_PEAKS]]
    peaks += ["…"] * (len(array.motions) > _MOST_PEAKS)
    return {
        "mean_of": fraction(" + ".join(peaks), str(len(array.motions))),
        "unit": fmt.units()[0].symbol,
        "mean": fmt.both_up(analysis.mean_m),
        "worst": f"motion {array.worst.motion.id}",
        "largest": fmt.both_up(analysis.largest_m),
        "equation": r"\Delta_{RHA}=k_a\,"
        + (r"\Delta_{max}" if is_largest else r"\overline{\Delta}"),
        "clause": marks.clause("analysis_factor"),
        "factor": number(analysis.factor, 2) + marks.of("analysis_factor"),
        "peak": fmt.both_up(analysis.largest_m if is_largest else analysis.mean_m),
        "value": fmt.both_up(analysis.value_m, array.overridden.analysis),
        "statistic": statistic(analysis.basis),
    }


def _design(package: PackageData) -> Mapping[str, object]:
    """Return the floor, and the larger of two values that is the design displacement."""
    array, fmt, marks = package.assessment.governing, package.fmt, package.marks
    by_analysis = array.route is Route.ANALYSIS
    given_m, analysis = array.prescriptive.value_m, array.analysis
    first_m, second_m = (
        (analysis.value_m, array.floor_m) if by_analysis else (given_m, analysis.largest_m)
    )
    larger = r"\Delta_{RHA},\,\Delta_{floor}" if by_analysis else r"\Delta_{MPV},\,\Delta_{max}"
    return {
        "is_peer_reviewed": package.data.is_peer_reviewed,
        "floor_clause": marks.clause("analysis_floor"),
        "floor_share": number(package.assessment.rules["analysis_floor"], 2)
        + marks.of("analysis_floor"),
        "prescriptive_value": fmt.both_up(given_m),
        "floor": fmt.both_up(array.floor_m, marks.floor(array)),
        "by_analysis": by_analysis,
        "has_design": not math.isnan(array.design_m),
        "design_equation": rf"\Delta=\mathrm{{max}}({larger})",
        "of_both": f"{fmt.both_up(first_m)}, {fmt.both_up(second_m)}",
        "design": fmt.both_up(array.design_m, marks.design(array)),
        "source": array.source,
    }


def _strength(package: PackageData) -> Mapping[str, object]:
    """Return the strength of the interconnection that is nearest its limit."""
    done, rules, marks = package.assessment, package.assessment.rules, package.marks
    strength = max((check for check in done.checks if check.id == STRENGTH_ROW), key=_exceeds)
    array = next(item.array for item in done.arrays if item.id == strength.subject)
    first, second = (
        f"{rules[key]:g}{marks.of(key)}" for key in ("interconnection_sds", "interconnection_min")
    )
    result, comparison = _compared(strength, package.fmt.us_first)
    return {
        "strength_clause": marks.clause("interconnection_sds"),
        "strength_of": f"{array.id}: max({first} × {number(package.data.site.s_ds, 3)}, {second}) "
        # W_1 is of the lighter side of a section, which is half the array at most.
        f"× {package.fmt.both(array.weight_n / 2.0, Quantity.WEIGHT)}",
        "strength": result,
        "strength_compared": comparison,
    }


def _exceeds(check: Check) -> tuple[float, float]:
    """Return the sort key of the governing check; a missing value has no ratio."""
    is_known = math.isfinite(check.ratio)
    return severity(check.verdict) if is_known else -1.0, check.ratio if is_known else 0.0


def _compared(check: Check, us_first: bool) -> tuple[str, Markup]:
    """Return the number of a check that an equation ends in, and how it compares: its verdict.

    That number is the demand; of a pathway, which is the narrower the more an array slides, it is
    what is left.
    """
    is_left = check.id == "fire_pathway"
    both, first = texts(check, us_first), texts(check, us_first, is_both=False)
    result, limit_text = first if is_left else (both[1], first[0])
    result, limit_text = (part.removeprefix(f"{check.sense} ") for part in (result, limit_text))
    if not math.isfinite(check.ratio):
        return result, Markup("; provided: {}, {}").format(limit_text, stamp(check.verdict))
    sign = ("≥" if is_left else "≤") if check.is_satisfied else ("<" if is_left else ">")
    parts = sign, limit_text, ratio(check.ratio), stamp(check.verdict)
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
    in_order = sorted(finite, key=lambda pair: -pair[1].ratio)
    kinds = grouped_by(in_order, lambda pair: pair[0].neighbor)
    lines = []
    for pairs in kinds.values():
        gap, check = pairs[0]
        lines.append((_separation(package, gap), *_compared(check, us_first)))
    for kind in ("electrical_slack", "fire_pathway"):
        known = [check for check in of_kind.get(kind, ()) if math.isfinite(check.ratio)]
        if known:
            check = max(known, key=_exceeds)
            note = f" {check.note} =" if check.note else ""
            lines.append((f"{check.title}, {check.subject}:{note}", *_compared(check, us_first)))
    unknown = [item.id for item in done.arrays if math.isnan(item.permitted_m)]
    importance = r"I\," if done.rules.importance_in_separation else ""
    return {
        "separation_equation": rf"s_{{req}}=k\,{importance}\Delta",
        "separation_clauses": ", ".join(sorted(clauses)),
        "separations": lines,
        "unknown": named(unknown, "Array") if unknown else "",
    }


def _separation(package: PackageData, gap: ClearanceCheck) -> str:
    """Return the factors of a required separation, up to the sign of equality."""
    rules, key = package.assessment.rules, SEPARATION_KEYS[gap.neighbor]
    importance = f" × {number(gap.importance, 2)}" if rules.importance_in_separation else ""
    design = package.fmt.both_up(gap.design_m, gap.design_mark)
    minimum = package.rule_length("separation_edge_min_in") if gap.is_minimum_value else ""
    at_least = f", not less than {minimum}" if minimum else ""
    factor = number(rules[key], 2) + package.marks.of(key)
    return (
        f"{' to '.join(gap.between)}, {gap.neighbor.value}: {factor}{importance} × {design}"
        f"{at_least} ="
    )
