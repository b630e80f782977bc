"""Sentences of a study, from its results. Read `headline`."""

from __future__ import annotations

import math

from report.entities.marks import dagger
from report.study.design import I_E, SDC
from report.study.dispersion import notice
from report.study.results import MEAN, SLOPE_DECIMALS, StudyResults
from report.words.units import Quantity, digits_down, digits_up, no_less, pair
from solver.rules.provisions import SEPARATION_KEYS, RuleSet
from solver.studies.uncertainty import Chance

NO_NUMBER = "not determined"


def both(results: StudyResults, value_m: float) -> str:
    """Return a displacement or a clearance in both systems of units, rounded up; `none` for NaN.

    What is found for a clearance holds for a larger one.
    """
    if math.isnan(value_m):
        return "none"
    us_first = results.plan.input.study.units_first == "US"
    return pair(value_m, Quantity.DISPLACEMENT, us_first, no_less)


def provision(rules: RuleSet, key: str, unit: str = "") -> str:
    """Return a number of the rule set with its mark."""
    return f"{rules[key]:.3g}{unit}{dagger(rules.values[key])}"


def analysis_words(results: StudyResults) -> str:
    """Return what the value from analysis is; it must have one."""
    rule = results.plan.design_rule
    peak = "largest" if rule.basis.takes_largest else "mean"
    return f"{provision(rule.rules, 'analysis_factor')} times the {peak} PRD"


def design_words(results: StudyResults) -> str:
    """Return what the design displacement is, or that there is none."""
    rule = results.plan.design_rule
    if not rule.has_value:
        least = provision(rule.rules, "analysis_min_motions")
        return (
            f"There is no design displacement: {rule.rules.name} needs {least} motions or more, "
            f"and there {'is' if rule.n_motions == 1 else 'are'} {rule.n_motions}. The statistics "
            "of the PRD are shown alone and are not for design."
        )
    least, *_, most = sorted(SEPARATION_KEYS.values(), key=lambda key: rule.rules[key])
    importance = (
        ". The prescriptive displacement is larger for a larger I_e"
        if _has_importance(results)
        else ", and times the importance factor"
    )
    return (
        f"The design displacement is that of {design_basis(results)}. A clearance is "
        f"{provision(rule.rules, least)} to {provision(rule.rules, most)} times it, by what it is "
        f"measured to{importance}."
    )


def design_basis(results: StudyResults) -> str:
    """Return by what the design displacement is found; it must have a value."""
    rule = results.plan.design_rule
    share = provision(rule.rules, "analysis_floor")
    floor = (
        f"not less than the floor of {share} times the prescriptive displacement "
        f"{prescriptive(results)}"
        if rule.has_floor
        else f"before its floor of {share} times the prescriptive displacement, which follows from "
        "the S_DS of each site and must be compared with it there"
    )
    return (
        f"{rule.rules.name} by response history without peer review: {analysis_words(results)} of "
        f"the {rule.n_motions} motions, {floor}"
    )


def prescriptive(results: StudyResults) -> str:
    """Return for what the prescriptive displacement is taken."""
    return f"for SDC {SDC}{f' and I_e = {I_E:g}' if _has_importance(results) else ''}"


def _has_importance(results: StudyResults) -> bool:
    """Whether the prescriptive displacement includes the importance factor."""
    return not results.plan.design_rule.rules.importance_in_separation


def headline(results: StudyResults) -> list[str]:
    """Return the main results, one line each."""
    given, manifest = results.plan.input, results.manifest
    count = len(results.plan.motions.motions[0])
    measure = given.study.intensity
    lines = [
        f"{manifest['rows']:,} runs of {manifest['cases']['count']:,} cases under {count} "
        f"motion{'s' if count > 1 else ''}"
        + (f", and {results.capacity_runs:,} for the capacities" if results.arrays else "")
    ]
    if given.study.allowed_m:
        lines += _allowed(results, given.study.allowed_m)
    for one in results.arrays:
        where = _where(results, one.plan.building)
        for state in one.states:
            f = state.fragility.fitted
            text = (
                f"median {measure.letters} {digits_down(f.theta, 3)} {measure.unit}, beta "
                f"{digits_up(f.beta, 2)}"
                if f.is_known
                else NO_NUMBER
            )
            lines.append(f"{one.plan.array.id}{where}, {state.words}: {text}")
        for chance in one.chances:
            lines.append(
                f"{one.plan.array.id}{where}: chance that the clearance of "
                f"{both(results, one.plan.array.clearance_m)} is exceeded at {measure.letters} "
                f"{given.study.site_intensity:g} {measure.unit}: {chance_words(chance)}"
            )
    return [*lines, *filter(None, [notice(results)])]


def chance_words(chance: Chance) -> str:
    """Return a chance, rounded up to two digits, with its confidence interval, rounded outward."""
    low, high = digits_down(100.0 * chance.low, 2), digits_up(100.0 * chance.high, 2)
    return f"{digits_up(100.0 * chance.value, 2)} % ({low} % to {high} %)"


def _where(results: StudyResults, building: int) -> str:
    names = results.plan.motions.buildings
    return f" on {names[building]}" if len(names) > 1 else ""


def _allowed(results: StudyResults, allowed_m: float) -> list[str]:
    given, study = results.plan.input, results.plan.input.study
    middle = len(given.intensities) // 2
    level = f"{study.intensity.letters} {given.intensities[middle]:g} {study.intensity.unit}"
    names = dict.fromkeys((results.leading, MEAN))
    lines = []
    for b in range(len(results.plan.motions.buildings)):
        slopes = [results.largest_slopes(b, name, allowed_m)[:, middle] for name in names]
        for mu, leading, *means in zip(given.mus, *slopes, strict=True):
            beside = "".join(f"; {MEAN}: {_slope(results, mean)}" for mean in means)
            lines.append(
                f"{results.leading} of at most {both(results, allowed_m)} at {level}, friction "
                f"{mu:g}{_where(results, b)}: largest slope {_slope(results, leading)}{beside}"
            )
    return lines


def _slope(results: StudyResults, slope: float) -> str:
    if math.isnan(slope):
        return "none of the study"
    if slope == results.plan.input.slopes_deg[-1]:
        return f"≥ {shown(slope, SLOPE_DECIMALS)} deg"
    return f"{shown(slope, SLOPE_DECIMALS)} deg"


def shown(value: float, decimals: int) -> str:
    """Return an answer with its decimals; one of the study's own values with all of its digits."""
    text = f"{value:.{decimals}f}"
    return text if float(text) == value else f"{value:.12g}"
