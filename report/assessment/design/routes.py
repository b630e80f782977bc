"""The procedures for a design displacement and their limits, from the input alone.

By PV1-2012 a roof of 3.5 deg is too steep for the prescriptive displacement (3 deg), and not for an
analysis (7 deg).

Knows no run and loads no compiled solver. Read `limits_of`, then `report.assessment.design.arrays`.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from report.project.model import ProjectInput
from report.project.model.array import Array
from report.project.model.choices import Statistic
from solver.rules import provisions
from solver.rules.limit import Limit
from solver.rules.provisions import Basis, Prescriptive
from solver.rules.rulesets import RULE_SETS, RuleSet

# In place of a design displacement by a route that is not permitted, or beside it.
NOT_PERMITTED = "not permitted"

# Of the limit on the number of motions: more motions lift it, and no other one.
MOTIONS_KEY = "analysis_min_motions"


class Route(StrEnum):
    """Procedure for the design displacement."""

    ANALYSIS = "analysis"
    PRESCRIPTIVE = "prescriptive"


@dataclass(frozen=True, slots=True, kw_only=True)
class RouteLimits:
    """The limits of an array, from the input alone, and the procedure that they permit."""

    checks: tuple[Limit, ...]  # limits that apply to both routes
    # limits of each route
    analysis_checks: tuple[Limit, ...]
    prescriptive_checks: tuple[Limit, ...]
    route: Route  # by which the design displacement is obtained

    @property
    def may_be_analyzed(self) -> bool:
        """Whether the analysis route is permitted once there are enough motions."""
        return all(check.ok or check.key == MOTIONS_KEY for check in self.analysis_checks)

    @property
    def of_route(self) -> tuple[Limit, ...]:
        """The limits of the procedure used only."""
        is_analysis = self.route is Route.ANALYSIS
        return self.analysis_checks if is_analysis else self.prescriptive_checks

    @property
    def required(self) -> tuple[Limit, ...]:
        """Every limit that must be satisfied for the procedure used."""
        return (*self.checks, *self.of_route)


SEAOC = RULE_SETS["SEAOC PV1-2012"]


def prescriptive_of(data: ProjectInput, rules: RuleSet) -> Prescriptive:
    """Return the prescriptive displacement of a project by a rule set."""
    site = data.site
    return provisions.prescriptive_displacement(
        rules, s_ds_g=site.s_ds, sdc=site.sdc, importance=site.i_e
    )


def limits_of(
    data: ProjectInput, rules: RuleSet, array: Array, *, n_motions: int, has_value: bool
) -> RouteLimits:
    """Return the limits of an array; its motions may or may not permit an analysis."""
    analysis = provisions.analysis_checks(
        rules,
        slope_rad=array.slope_rad,
        n_motions=n_motions,
        sdc=data.site.sdc,
        is_reviewed=data.is_peer_reviewed,
    )
    prescriptive = provisions.prescriptive_checks(
        rules, slope_rad=array.slope_rad, mu=array.minimum_mu
    )
    by_analysis = has_value and all(check.ok for check in analysis)
    by_prescription = all(check.ok for check in prescriptive)
    return RouteLimits(
        checks=provisions.array_checks(
            rules,
            cg_height_m=array.cg_height_m,
            support_spacing_m=array.support_spacing_m,
            base_m=array.base_dimension_m,
            slope_rad=array.slope_rad,
        ),
        analysis_checks=analysis,
        prescriptive_checks=prescriptive,
        # By analysis, unless there is none or that alone is not permitted.
        route=Route.PRESCRIPTIVE
        if not n_motions or (by_prescription and not by_analysis)
        else Route.ANALYSIS,
    )


def statistic_basis(data: ProjectInput) -> Basis | None:
    """Return the statistic that a workbook requests; None for that of the rule set."""
    asked = data.options.statistic
    return None if asked is Statistic.RULE_SET else Basis(asked.value)


def lacking_motions(rules: RuleSet, basis: Basis | None, count: int) -> str:
    """Return the statistic that needs more motions than there are; nothing if there are enough."""
    asked = Basis.LARGEST_FACTORED if basis is None else basis
    minimum = provisions.minimum_motions(rules, asked)
    if count >= minimum:
        return ""
    return f"the statistic '{asked}' requires at least {minimum:.0f} motions; {count} are listed"


def interconnection_n(data: ProjectInput, rules: RuleSet, array: Array) -> float:
    """Return the required strength between the parts of an array [N]."""
    # The lighter side of a section is at most half of the array.
    return provisions.interconnection_strength_n(
        rules, s_ds_g=data.site.s_ds, w1_n=array.weight_n / 2.0
    )
