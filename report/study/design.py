"""The design displacement of the rule set for the cases of the curves, from their statistics.

The rules are those of a calculation package, in `solver.rules.provisions`. Read `design_rule`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from report.study.schema import Intensity, StudyInput
from solver.model import Floats
from solver.rules.provisions import (
    RULE_SETS,
    Basis,
    RuleSet,
    analysis_floor_m,
    basis_for,
    factored,
    prescriptive_displacement,
)
from solver.studies.curves import Statistics

SDC, I_E = "D", 1.0
"""Category and importance factor of the prescriptive displacement, which a study does not know."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignRule:
    """How the design displacement follows from the PRDs of the motions.

    Attributes
    ----------
    prescriptive_m, floor_m : array, shape (intensities,)
        Prescriptive displacement, and the minimum of the value from analysis without peer review
        [m]; empty unless the intensity is S_DS, from which they follow.
    """

    rules: RuleSet
    n_motions: int
    basis: Basis
    prescriptive_m: Floats
    floor_m: Floats

    @property
    def has_value(self) -> bool:
        """Whether there are enough motions."""
        return self.basis is not Basis.TOO_FEW

    @property
    def has_floor(self) -> bool:
        """Whether the floor is known."""
        return bool(self.floor_m.size)

    @property
    def name(self) -> str:
        """What `design_m` is."""
        return "design displacement" + ("" if self.has_floor else " before the floor")

    def analysis_m(self, curves: Statistics) -> Floats:
        """Return the value from analysis, of the shape of the curves [m]; NaN for none."""
        return factored(self.rules, self.basis, curves.mean_m, curves.largest_m)

    def design_m(self, curves: Statistics) -> Floats:
        """Return the same, not less than the floor where that is known."""
        value = self.analysis_m(curves)
        return np.maximum(value, self.floor_m) if self.has_floor else value

    @property
    def about(self) -> dict[str, Any]:
        """The same for the manifest."""
        return {
            "name": self.name,
            "rule_set": self.rules.name,
            "statistic": self.basis.value,
            "factor": self.rules["analysis_factor"],
            "floor_share_of_prescriptive": self.rules["analysis_floor"],
            "sdc": SDC,
            "importance_factor": I_E,
            "floor_m": self.floor_m.tolist() if self.has_floor else None,
        }


def design_rule(given: StudyInput, n_motions: int) -> DesignRule:
    """Return the rule for a study of a number of motions."""
    rules = RULE_SETS[given.study.rule_set.value]
    levels = given.intensities if given.study.intensity is Intensity.S_DS else ()
    found = [
        prescriptive_displacement(rules, s_ds_g=level, sdc=SDC, importance=I_E) for level in levels
    ]
    return DesignRule(
        rules=rules,
        n_motions=n_motions,
        basis=basis_for(rules, n_motions),
        prescriptive_m=np.array([one.value_m for one in found]),
        floor_m=np.array([analysis_floor_m(rules, one) for one in found]),
    )
