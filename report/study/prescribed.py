"""The prescriptive displacement beside the curves: where it is safe, by how much, and where not.

Only for studies whose intensity is S_DS. Read `compare`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from report.study.results import StudyResults
from report.study.schema import Intensity
from solver.model import Floats
from solver.rules.provisions import RULE_SETS, prescriptive_displacement
from solver.rules.rulesets import RuleSet

SDC = "D"
"""Category for which the formula holds; in A to C a fixed value applies."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Prescribed:
    """Computed displacement / prescriptive displacement, by slope, friction and intensity.

    Attributes
    ----------
    rules : RuleSet
    value_m : array, shape (intensities,)
        Prescriptive displacement [m].
    ratio : array, shape (slopes, frictions, intensities)
        Factor of the rule set times the mean PRD, over the prescriptive value; NaN for none.
    """

    rules: RuleSet
    value_m: Floats
    ratio: Floats


def compare(results: StudyResults, building: int) -> tuple[Prescribed, ...]:
    """Return the comparison; empty if the intensity is not S_DS."""
    given = results.plan.input
    if given.study.intensity is not Intensity.S_DS:
        return ()
    rules = RULE_SETS[given.study.rule_set.value]
    value = np.array(
        [
            prescriptive_displacement(rules, s_ds_g=level, sdc=SDC, importance=1.0).value_m
            for level in given.intensities
        ]
    )
    computed = rules.values["analysis_factor"].value * results.curves.mean_m[building]
    return (Prescribed(rules=rules, value_m=value, ratio=computed / value),)
