"""Sentences of a study that its pages, its tables and the screen share. Read `headline`."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from report.assessment.checks.check import dagger
from report.study.design_rule import I_E, SDC, DesignRule
from report.study.dispersions import NOT_DETERMINED, is_refused, is_warned
from report.study.manifest import OWN_KEY, TRUST_PARTS
from report.study.study_input import Study, StudyArray
from report.study.study_results import MEAN, SLOPE_DECIMALS, ArrayStudyResult, StudyResults
from report.study.wording import answer, both, chance, on_building
from report.text.counts import numbered
from report.text.units import digits_down, digits_up, with_unit
from solver.rules.provisions import SEPARATION_KEYS
from solver.rules.rulesets import RuleSet

# Each force on such a block is proportional to its mass; a study has no others.
MASS = "Mass has no effect: each array is one rigid block with Coulomb friction"


def provision(rules: RuleSet, key: str, unit: str = "") -> str:
    """Return a number of the rule set with its marks."""
    return f"{rules[key]:.3g}{unit}{dagger(rules.values[key])}"


def steepest_permitted(rules: RuleSet) -> str:
    """Return the largest slope permitted by the rule set; no displacement depends on it."""
    key = min("ibc_max_slope_deg", "analysis_max_slope_deg", key=rules.__getitem__)
    return f"{rules.values[key].clause} permits at most {provision(rules, key, '°')}"


def about_intensity(study: Study) -> str:
    """Return the distribution of the intensity that a probability is for."""
    beta = study.intensity_beta
    return f" (median), with a dispersion of {beta:g}" if beta else ""


def about_array(results: StudyResults, array: StudyArray, friction: str) -> str:
    """Return the mat, friction, slope and clearance of an array."""
    clearance = f"clearance {both(results, array.clearance_m)}"
    reaches = f" to {array.reaches}" if array.reaches else ""
    roof = f"mat {array.mat}, {friction}, slope {array.slope_deg:g}°"
    return f"Array {array.id}: {roof}, {clearance}{reaches}."


def analysis(rule: DesignRule) -> str:
    """Return the definition of the analysis displacement."""
    statistic = "largest" if rule.basis.takes_largest else "mean"
    return f"{provision(rule.rules, 'analysis_factor')} times the {statistic} PRD"


def prescriptive(rules: RuleSet) -> str:
    """Return the parameters assumed for the prescriptive displacement."""
    return f"for SDC {SDC}" + ("" if rules.importance_in_separation else f" and I_e = {I_E:g}")


def design_basis(rule: DesignRule) -> str:
    """Return the basis of the design displacement."""
    share = f"{provision(rule.rules, 'analysis_floor')} times the prescriptive displacement"
    later = "which follows from the S_DS of each site and must be compared with it there"
    floor = (
        f"not less than the floor of {share} {prescriptive(rule.rules)}"
        if rule.has_floor
        else f"before its floor of {share}, {later}"
    )
    how = f"{rule.rules.name} (response history, no peer review): {analysis(rule)}"
    return f"{how} of the {rule.n_motions} motions, {floor}"


def design(rule: DesignRule) -> str:
    """Return the definition of the design displacement, or the reason for having none."""
    rules = rule.rules
    if not rule.has_value:
        needed = provision(rules, "analysis_min_motions")
        are = "is" if rule.n_motions == 1 else "are"
        few = f"{rules.name} needs {needed} motions or more, and there {are} {rule.n_motions}"
        alone = "The statistics of the PRD are shown alone and are not for design."
        return f"There is no design displacement: {few}. {alone}"
    least, *_, most = sorted(SEPARATION_KEYS.values(), key=rules.__getitem__)
    factors = f"{provision(rules, least)} to {provision(rules, most)} times this displacement"
    importance = (
        ", times the importance factor"
        if rules.importance_in_separation
        else ". The prescriptive displacement is larger for a larger I_e"
    )
    separation = f"A required separation is {factors}, depending on the adjacent item{importance}"
    return f"The design displacement is that of {design_basis(rule)}. {separation}."


def spread(results: StudyResults) -> str:
    """Return the scatter of the response spectra of the motions."""
    spectra, motions = results.spread, results.plan.design_rule.n_motions
    median = f"a median standard deviation of ln Sa of {digits_up(spectra.median, 2)}"
    return f"the spectra of the {motions} motions have {median}"


def _no_record_spread(results: StudyResults) -> str:
    """Return the sentence on a missing record-to-record dispersion, with the measured scatter."""
    if results.spread.is_known:
        lacking = "β does not contain the record-to-record dispersion of earthquakes"
        return f"{spread(results)}, as motions matched to one spectrum do, and {lacking}."
    motions = numbered(results.plan.design_rule.n_motions, "motion")
    return (
        f"the record-to-record spread of {motions} cannot be measured, and β does not contain it."
    )


def warnings(results: StudyResults) -> list[str]:
    """Return the warnings on the dispersion and on runs reused without a valid signature."""
    trusted = [
        f"{_taken(results, parts)}."
        for parts in results.manifest["taken_over"]
        if parts["on_the_word_of"] == TRUST_PARTS
    ]
    return [*_in_spite(results), *trusted]


def _in_spite(results: StudyResults) -> list[str]:
    """Return the warning where fragilities are exported without a record-to-record dispersion."""
    warned = f"Warning: {_no_record_spread(results)} Written with --allow-matched."
    return [warned] if is_warned(results) else []


def _taken(results: StudyResults, parts: Mapping[str, Any]) -> str:
    """Return the number of reused runs, their dates, and who vouches for them."""
    first, last = parts["from"], parts["to"]
    dates = f"{f'on {first}' if first == last else f'from {first} to {last}'} (UTC)"
    whose = (
        f"on the word of {TRUST_PARTS}: their parts are not signed with {OWN_KEY} and state that "
        f"they were computed {dates}"
        if parts["on_the_word_of"] == TRUST_PARTS
        else f"from parts that are signed with {OWN_KEY} and were computed {dates}"
    )
    of_all = f"{parts['runs']:,} of the {results.manifest['rows']:,} runs"
    return f"{of_all} were taken over {whose}"


def taken_over(results: StudyResults) -> list[str]:
    """Return one sentence for each group of reused runs."""
    return [_taken(results, parts) for parts in results.manifest["taken_over"]]


def headline(results: StudyResults) -> list[str]:
    """Return the main results, one line each."""
    manifest, motions = results.manifest, results.plan.design_rule.n_motions
    cases = f"{manifest['cases']['count']:,} cases under {numbered(motions, 'motion')}"
    further = f", and {results.capacity_runs:,} for the capacities" if results.arrays else ""
    lines = [f"{manifest['rows']:,} runs of {cases}{further}", *taken_over(results)]
    lines += _steepest(results)
    for array in results.arrays:
        lines += _capacities(results, array)
    if is_refused(results):
        entered = "Enter a record-to-record dispersion with its source on the Study worksheet"
        why = f"fragility.csv is not written: {_no_record_spread(results)}"
        lines.append(f"{why} {entered}, or write it with --allow-matched")
    return lines + [warned.rstrip(".") for warned in _in_spite(results)]


def _steepest(results: StudyResults) -> Iterator[str]:
    """Yield by building and friction the largest slope for the allowed displacement."""
    study_input, rules = results.plan.input, results.plan.design_rule.rules
    study, middle = study_input.study, len(study_input.intensities) // 2
    if not study.allowed_m:
        return
    level = with_unit(f"{study_input.intensities[middle]:g}", study.intensity.unit)
    allowed = f"{results.leading} of at most {both(results, study.allowed_m)}"
    for building in range(len(results.plan.motions.buildings)):
        by_name = (
            results.largest_slopes(building, name, study.allowed_m)[:, middle]
            for name in dict.fromkeys((results.leading, MEAN))
        )
        for mu, *slopes in zip(study_input.mus, *by_name, strict=True):
            where = f"friction {mu:g}{on_building(results, building)}"
            largest = "; mean PRD: ".join(_slope(results, slope) for slope in slopes)
            at = f"{allowed} at {study.intensity.letters} {level}, {where}"
            yield f"{at}: largest slope {largest}; {steepest_permitted(rules)}"


def _slope(results: StudyResults, slope: float) -> str:
    if math.isnan(slope):
        return "none in the study"
    return f"{answer(slope, results.plan.input.slopes_deg[-1], '≥', SLOPE_DECIMALS)}°"


def _capacities(results: StudyResults, result: ArrayStudyResult) -> Iterator[str]:
    """Yield the fragilities of an array, and the probability that its clearance is exceeded."""
    study, array = results.plan.input.study, result.plan.array
    letters, unit = study.intensity.letters, study.intensity.unit
    name = f"{array.id}{on_building(results, result.plan.building)}"
    for state in result.states:
        fitted, lognormal = state.fragility.fitted, NOT_DETERMINED
        if fitted.is_known:
            median = with_unit(digits_down(fitted.theta, 3), unit)
            lognormal = f"median {letters} {median}, beta {digits_up(fitted.beta, 2)}"
        yield f"{name}, {state.words}: {lognormal}"
    for exceedance in result.exceedances:
        exceeded = f"the clearance of {both(results, array.clearance_m)} is exceeded"
        level = f"{letters} {with_unit(f'{study.site_intensity:g}', unit)}{about_intensity(study)}"
        within = chance(exceedance.value, exceedance.low, exceedance.high)
        yield f"{name}: probability that {exceeded} at {level}: {within}"
