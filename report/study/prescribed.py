"""The prescriptive displacement beside the value from analysis: where it is enough and permitted.

Only for studies whose intensity is S_DS. Read `compare`, then `prescribed`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from report.document.sections import Section, section
from report.document.tables import Table, listed
from report.entities.shown import centered, text, words
from report.pages.symbols import with_symbols
from report.study.page_parts import MOST_FRICTIONS, axis, by_intensity, friction_name, some
from report.study.results import StudyResults
from report.study.words import on_building
from report.words.units import number, round_down
from solver.model import Floats
from solver.rules.provisions import prescriptive_checks, required_mu


@dataclass(frozen=True, slots=True, kw_only=True)
class Prescribed:
    """Value from analysis / prescriptive displacement, by slope, friction and intensity.

    Attributes
    ----------
    ratio : array, shape (slopes, frictions, intensities)
        NaN for no value.
    permitted : array of bool, shape (slopes, frictions)
        Whether the rule set permits the prescriptive displacement.
    """

    ratio: Floats
    permitted: NDArray[np.bool_]

    @property
    def unsafe(self) -> NDArray[np.bool_]:
        """Where the prescriptive displacement is too small; no value counts as such."""
        return np.asarray(~(self.ratio <= 1.0))

    @property
    def unsafe_not_permitted(self) -> NDArray[np.bool_]:
        """Where it is too small and the rule set does not permit it."""
        return self.unsafe & ~self.permitted[..., None]


def compare(results: StudyResults, building: int) -> tuple[Prescribed, ...]:
    """Return the comparison; empty without a value from analysis or S_DS."""
    given, rule = results.plan.input, results.plan.design_rule
    if not (rule.has_value and rule.has_floor):
        return ()
    permitted = [
        [
            all(
                check.ok
                for check in prescriptive_checks(rule.rules, slope_rad=math.radians(slope), mu=mu)
            )
            for mu in given.mus
        ]
        for slope in given.slopes_deg
    ]
    ratio = results.analysis_m[building] / rule.prescriptive_m
    return (Prescribed(ratio=ratio, permitted=np.array(permitted)),)


def prescribed(results: StudyResults, building: int, found: Prescribed) -> Section:
    """Return the section on the prescriptive displacement."""
    given, rules = results.plan.input, results.plan.design_rule.rules
    names = {m: friction_name(results, given.mus[m]) for m in some(given.mus, MOST_FRICTIONS)}
    slopes, mus = _extent(results, found.unsafe_not_permitted)
    return section(
        "study/prescribed",
        "Beside the prescriptive displacement" + on_building(results, building, ", building "),
        id=f"prescribed-{building}",
        found=found,
        slopes=slopes,
        mus=mus,
        steepest_mu=required_mu(rules, math.radians(rules["prescriptive_max_slope_deg"])),
        names=names,
        margins=_table(results, found),
        charts={f"prescribed-{m}": _chart(results, building, m) for m in names},
    )


def _extent(results: StudyResults, cases: NDArray[np.bool_]) -> tuple[list[float], list[float]]:
    """Return the slopes and the friction coefficients of cases."""
    given = results.plan.input
    return (
        [given.slopes_deg[s] for s in np.flatnonzero(cases.any(axis=(1, 2)))],
        [given.mus[m] for m in np.flatnonzero(cases.any(axis=(0, 2)))],
    )


def _chart(results: StudyResults, building: int, m: int) -> str:
    rule = results.plan.design_rule
    limits = ((rule.rules.name, rule.prescriptive_m),)
    return by_intensity(results, results.analysis_m[building], m, limits=limits)


def _table(results: StudyResults, found: Prescribed) -> Table:
    given, measure = results.plan.input, with_symbols(axis(results))

    def margins(at: tuple[int, int]) -> tuple[str, str, str]:
        return _margins(found.ratio[at], given.intensities)

    columns = (
        (words("Friction", 1.6), lambda at: friction_name(results, given.mus[at[1]])),
        (text("Slope", "deg"), lambda at: f"{given.slopes_deg[at[0]]:g}"),
        (centered("Permitted"), lambda at: "yes" if found.permitted[at] else "no"),
        (text("Enough up to", measure, 1.4), lambda at: margins(at)[0]),
        (text("Least margin", share=1.1), lambda at: margins(at)[1]),
        (text("at", measure, 1.2), lambda at: margins(at)[2]),
    )
    cases = [(s, m) for m in range(len(given.mus)) for s in range(len(given.slopes_deg))]
    return listed(cases, columns, kind="compact")


def _margins(ratio: Floats, levels: Sequence[float]) -> tuple[str, str, str]:
    """Return the intensity up to which the prescriptive value is enough, and the least margin."""
    unsafe = np.flatnonzero(~(ratio <= 1.0))
    if not unsafe.size:
        reach = f"{levels[-1]:.12g}, all"
    else:
        reach = "none" if unsafe[0] == 0 else f"{levels[unsafe[0] - 1]:.12g}"
    worst = int(np.argmax(np.where(np.isnan(ratio), np.inf, ratio)))
    if np.isnan(ratio[worst]):
        return reach, "none", f"{levels[worst]:g}"
    margin = math.inf if ratio[worst] == 0.0 else 1.0 / float(ratio[worst])
    return reach, number(round_down(margin, 2), 2), f"{levels[worst]:g}"
