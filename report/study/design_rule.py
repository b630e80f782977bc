"""The design displacement of a study from the PRDs of its motions, by a rule set.

At S_DS = 1.0 g PV1-2012 prescribes 21.6 in, half of which is the floor of the value from analysis.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from report.study.study_input import Intensity, StudyInput
from solver.model import Floats
from solver.rules.provisions import (
    Basis,
    analysis_floor_m,
    basis_for,
    factored,
    prescriptive_displacement,
)
from solver.rules.rulesets import RULE_SETS, RuleSet
from solver.studies.curves import Statistics

# Category and importance factor of the prescriptive displacement, which a study does not know.
SDC, I_E = "D", 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignRule:
    """Rule for the design displacement from the PRDs of the motions.

    Its arrays have the shape (intensities,); empty unless the intensity is S_DS.
    """

    rules: RuleSet
    n_motions: int
    basis: Basis
    prescriptive_m: Floats
    floor_m: Floats  # minimum of the value from analysis without peer review

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
        # `maximum` keeps NaN: the floor is no value where the runs give none.
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


def design_rule(study_input: StudyInput, n_motions: int) -> DesignRule:
    """Return the rule for a study of a number of motions."""
    rules = RULE_SETS[study_input.study.rule_set.value]
    levels = study_input.intensities if study_input.study.intensity is Intensity.S_DS else ()
    requirements = [
        prescriptive_displacement(rules, s_ds_g=level, sdc=SDC, importance=I_E) for level in levels
    ]
    return DesignRule(
        rules=rules,
        n_motions=n_motions,
        basis=basis_for(rules, n_motions),
        prescriptive_m=np.array([requirement.value_m for requirement in requirements]),
        floor_m=np.array([analysis_floor_m(rules, requirement) for requirement in requirements]),
    )
