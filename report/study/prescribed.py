"""The prescriptive displacement beside the value from analysis: where it is enough, where it is not
and where the rule set permits it.

Only for studies whose intensity is S_DS. Read `compare`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from report.study.results import StudyResults
from solver.model import Floats
from solver.rules.provisions import prescriptive_checks


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
