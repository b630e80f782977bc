"""The section of a study on the prescriptive displacement: where it is sufficient and permitted.

A value from analysis of 0.44 m beside 0.55 m prescribed: the ratio is 0.80, and 0.55 m is enough.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from report.document.columns import centered, text, words
from report.document.sections import Section, section
from report.document.tables import Table, listed
from report.pages.symbols import with_symbols
from report.study.page_parts import MOST_FRICTIONS, axis, by_intensity, friction_name, some
from report.study.sentences import analysis, prescriptive, provision
from report.study.study_results import StudyResults
from report.study.wording import on_building
from report.text.units import number, round_down
from solver.model import Floats
from solver.rules.provisions import prescriptive_checks, required_mu


@dataclass(frozen=True, slots=True, kw_only=True)
class Prescribed:
    """Value from analysis / prescriptive displacement, by slope, friction and intensity."""

    ratio: Floats  # shape (slopes, frictions, intensities); NaN for no value
    permitted: NDArray[np.bool_]  # by the rule set, shape (slopes, frictions)

    @property
    def unsafe(self) -> NDArray[np.bool_]:
        """Where the prescriptive displacement is too small; no value counts as such."""
        # Not > 1: NaN, a run without a value, is to count as too small.
        return np.asarray(~(self.ratio <= 1.0))

    @property
    def unsafe_not_permitted(self) -> NDArray[np.bool_]:
        """Where it is too small and the rule set does not permit it."""
        return self.unsafe & ~self.permitted[..., None]


def compare(results: StudyResults, building: int) -> tuple[Prescribed, ...]:
    """Return the comparison; empty without a value from analysis or S_DS."""
    study_input, rule = results.plan.input, results.plan.design_rule
    if not (rule.has_value and rule.has_floor):
        return ()
    permitted = [
        [
            all(
                check.ok
                for check in prescriptive_checks(rule.rules, slope_rad=math.radians(slope), mu=mu)
            )
            for mu in study_input.mus
        ]
        for slope in study_input.slopes_deg
    ]
    ratio = results.analysis_m[building] / rule.prescriptive_m
    return (Prescribed(ratio=ratio, permitted=np.array(permitted)),)


def prescribed(results: StudyResults, building: int, prescribed: Prescribed) -> Section:
    """Return the section on the prescriptive displacement."""
    study_input, rule = results.plan.input, results.plan.design_rule
    rules, unsafe = rule.rules, int(prescribed.unsafe.sum())
    outside = int(prescribed.unsafe_not_permitted.sum())
    steepest_mu = required_mu(rules, math.radians(rules["prescriptive_max_slope_deg"]))
    permitted_mu = f"{provision(rules, 'prescriptive_min_mu')} or more"
    if steepest_mu > rules["prescriptive_min_mu"]:
        permitted_mu += f", {number(steepest_mu, 3)} at that slope"
    captions, charts = [], dict[str, str]()
    for m in some(study_input.mus, MOST_FRICTIONS):
        friction = friction_name(results, study_input.mus[m])
        thick = f"the prescriptive displacement of {rules.name} {prescriptive(rules)} (thick)"
        caption = f"Analysis displacement, {friction}, by slope, and {thick}."
        captions.append((f"prescribed-{m}", caption))
        charts[f"prescribed-{m}"] = by_intensity(
            results, results.analysis_m[building], m, limits=((rules.name, rule.prescriptive_m),)
        )
    return section(
        "study/prescribed",
        "Comparison with the prescriptive displacement"
        + on_building(results, building, ", building "),
        id=f"prescribed-{building}",
        prescriptive=with_symbols(prescriptive(rules)),
        analysis=analysis(rule),
        cases=prescribed.ratio.size,
        safe=prescribed.ratio.size - unsafe,
        unsafe=unsafe,
        rules=rules.name,
        permitted_slope=provision(rules, "prescriptive_max_slope_deg", "°"),
        permitted_mu=permitted_mu,
        inside=_share(unsafe - outside, unsafe),
        outside=_share(outside, unsafe) + _extent(results, prescribed.unsafe_not_permitted),
        captions=captions,
        margins=_prescribed_table(results, prescribed),
        margins_caption=f"Where the prescriptive displacement of {rules.name} is sufficient",
        charts=charts,
    )


def _share(part: int, total: int) -> str:
    if not part:
        return "none"
    return f"all {total:,}" if part == total else f"{part:,}"


def _extent(results: StudyResults, cases: NDArray[np.bool_]) -> str:
    """Return between which slopes and friction coefficients cases are; empty for none."""
    study_input = results.plan.input
    slopes = [f"{study_input.slopes_deg[s]:g}°" for s in np.flatnonzero(cases.any(axis=(1, 2)))]
    mus = [f"{study_input.mus[m]:g}" for m in np.flatnonzero(cases.any(axis=(0, 2)))]
    # The ends of each, which may be one.
    extents = [
        " to ".join(dict.fromkeys((values[0], values[-1]))) for values in (slopes, mus) if values
    ]
    return ": slopes of {}, μ of {}".format(*extents) if extents else ""


def _prescribed_table(results: StudyResults, prescribed: Prescribed) -> Table:
    study_input, measure = results.plan.input, with_symbols(axis(results))

    def margins(case: tuple[int, int]) -> tuple[str, str, str]:
        return _margins(prescribed.ratio[case], study_input.intensities)

    columns = (
        (words("Friction", 1.6), lambda case: friction_name(results, study_input.mus[case[1]])),
        (text("Slope", "deg"), lambda case: f"{study_input.slopes_deg[case[0]]:g}"),
        (centered("Permitted"), lambda case: "yes" if prescribed.permitted[case] else "no"),
        (text("Enough up to", measure, 1.4), lambda case: margins(case)[0]),
        (text("Least margin", share=1.1), lambda case: margins(case)[1]),
        (text("at", measure, 1.2), lambda case: margins(case)[2]),
    )
    cases = []
    for m in range(len(study_input.mus)):
        cases += [(s, m) for s in range(len(study_input.slopes_deg))]
    return listed(cases, columns, kind="compact")


def _margins(ratio: Floats, levels: Sequence[float]) -> tuple[str, str, str]:
    """Return the intensity up to which the prescriptive value is enough, and the least margin."""
    # Not `ratio > 1`: NaN, no value, is not safe either.
    unsafe = np.flatnonzero(~(ratio <= 1.0))
    if not unsafe.size:
        reach = f"{levels[-1]:.12g}, all"
    else:
        reach = "none" if unsafe[0] == 0 else f"{levels[unsafe[0] - 1]:.12g}"
    # No value is the worst: it may be of any size.
    worst = int(np.argmax(np.where(np.isnan(ratio), np.inf, ratio)))
    if np.isnan(ratio[worst]):
        return reach, "none", f"{levels[worst]:g}"
    margin = math.inf if ratio[worst] == 0.0 else 1.0 / float(ratio[worst])
    return reach, number(round_down(margin, 2), 2), f"{levels[worst]:g}"
