"""Clearances, limits, interconnection strength and the provisions they come from."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from report.assess import ClearanceCheck
from report.pages_parts import Column, Row, Scene, Table, check_value, dagger, ratio, verdict
from report.units import Quantity, number
from solver.provisions import OVERRIDABLE, SEPARATION_KEYS, Check


def clearance_table(scene: Scene, *, brief: bool) -> Table:
    """Return the clearances, required against provided."""
    say = scene.say
    more = (
        ()
        if brief
        else (
            Column(head="Governing array", align="left", share=1.1),
            *say.columns("Its design displ.", share=0.8),
            Column(head="Factor × I", share=0.7),
            Column(head="Clause", align="left", share=1.2),
        )
    )
    return Table(
        caption="Clearances: required and provided separation",
        columns=(
            Column(head="No.", share=0.5),
            Column(head="From", align="left", share=1.0),
            Column(head="To", align="left", share=1.1),
            Column(head="Condition", align="left", share=2.2 if brief else 1.6),
            *more,
            *say.columns("Required", share=0.85),
            *say.columns("Provided", share=0.85),
            Column(head="D/C", share=0.7),
            Column(head="Verdict", align="center", share=0.9),
        ),
        rows=tuple(
            _clearance_row(scene, count, gap, brief)
            for count, gap in enumerate(scene.assessment.clearances, start=1)
        ),
    )


def _clearance_row(scene: Scene, count: int, gap: ClearanceCheck, brief: bool) -> Row:
    say, row = scene.say, gap.clearance
    key = SEPARATION_KEYS[gap.neighbour]
    least = scene.mark("separation_edge_min_in") if gap.is_least_value else ""
    more = (
        ()
        if brief
        else (
            gap.governing_array,
            *say.cells(gap.design_m),
            number(gap.factor, 2) + scene.mark(key),
            scene.clause(key),
        )
    )
    where = "" if row.direction == "any" else f", {row.direction.value}"
    return Row(
        cells=(
            str(count),
            row.array,
            row.object,
            gap.neighbour.value + where,
            *more,
            *say.cells(gap.required_m, mark=least),
            *say.cells(row.provided_m, Quantity.SIZE),
            ratio(gap.demand_capacity),
            verdict(gap.ok),
        )
    )


def all_checks(scene: Scene) -> Sequence[tuple[str, Check]]:
    """Return every limit with what it is on."""
    building = [("Building", check) for check in scene.assessment.building_checks]
    arrays = [
        (f"Array {found.array.id}", check)
        for found in scene.assessment.arrays
        for check in found.checks
    ]
    return [*building, *arrays]


def failed_limits(scene: Scene) -> Sequence[str]:
    """Return the limits that are not kept, in words."""
    return [
        f"{place}: {check.title} is {check_value(check, check.found, scene.say)}, limit "
        f"{check_value(check, check.limit, scene.say)} "
        f"({check.provision.clause}{dagger(check.provision)})."
        for place, check in all_checks(scene)
        if not check.ok
    ]


def check_table(caption: str, scene: Scene, checks: Sequence[tuple[str, Check]]) -> Table:
    """Return limits against what the project has."""
    return Table(
        caption=caption,
        columns=(
            Column(head="On", align="left", share=1.1),
            Column(head="Limit on", align="left", share=2.8),
            Column(head="Found", share=1.7),
            Column(head="", align="center", share=0.3),
            Column(head="Limit", share=1.8),
            Column(head="Clause", align="left", share=1.6),
            Column(head="Verdict", align="center", share=0.8),
        ),
        rows=tuple(
            Row(
                cells=(
                    place,
                    check.title,
                    check_value(check, check.found, scene.say),
                    "≤" if check.at_most else "≥",
                    check_value(check, check.limit, scene.say) + dagger(check.provision),
                    check.provision.clause + dagger(check.provision),
                    verdict(check.ok),
                )
            )
            for place, check in checks
        ),
    )


def clearances(scene: Scene) -> Mapping[str, object]:
    """Return the part on clearances, without its chart."""
    parapets = [gap for gap in scene.assessment.clearances if "parapet" in gap.neighbour.value]
    notes = []
    if parapets:
        notes.append(
            "A parapet qualifies when its top is at least "
            f"{scene.say.both(scene.assessment.rules.length_m('parapet_height_in'))}"
            f"{scene.mark('parapet_height_in')} above the roof and at least "
            f"{scene.say.both(scene.assessment.rules.length_m('parapet_over_cg_in'))}"
            f"{scene.mark('parapet_over_cg_in')} above the array's centre of gravity. An edge "
            "whose parapet does not qualify counts as one without. The strength of the parapet is "
            "not checked here."
        )
    if any(gap.is_least_value for gap in scene.assessment.clearances):
        notes.append(
            "Least separation to an edge without a qualifying parapet governs where the required "
            "value exceeds factor × displacement: "
            f"{scene.say.both(scene.assessment.rules.length_m('separation_edge_min_in'))}"
            f"{scene.mark('separation_edge_min_in')}."
        )
    return {"table": clearance_table(scene, brief=False), "notes": tuple(notes)}


def limits(scene: Scene) -> Mapping[str, object]:
    """Return the part on limits and interconnection strength."""
    return {
        "table": check_table(
            "Limits of the analysis route and of the building", scene, all_checks(scene)
        ),
        "interconnection": _interconnection(scene),
    }


def _interconnection(scene: Scene) -> Table:
    say = scene.say
    return Table(
        caption="Interconnection strength required within each array",
        columns=(
            Column(head="Array", align="left", share=1.2),
            *say.columns("Weight W", Quantity.WEIGHT),
            *say.columns("Lighter part W1 = W/2", Quantity.WEIGHT),
            *say.columns("Strength required", Quantity.WEIGHT),
            Column(head="Clause", align="left", share=1.4),
        ),
        rows=tuple(
            Row(
                cells=(
                    found.array.id,
                    *say.cells(found.array.weight_n, Quantity.WEIGHT),
                    *say.cells(found.array.weight_n / 2.0, Quantity.WEIGHT),
                    *say.cells(
                        found.interconnection_n,
                        Quantity.WEIGHT,
                        mark=scene.mark("interconnection_sds"),
                    ),
                    scene.clause("interconnection_sds"),
                )
            )
            for found in scene.assessment.arrays
        ),
    )


def provisions(scene: Scene) -> Mapping[str, object]:
    """Return every number of the rule set with its standing, and the overrides."""
    rules = scene.assessment.rules
    return {
        "table": Table(
            caption=f"Numbers of {rules.name} used here",
            columns=(
                Column(head="Provision", align="left", share=4.6),
                Column(head="Value", share=0.9),
                Column(head="Clause", align="left", share=1.7),
                Column(head="Standing", align="left", share=1.9),
            ),
            rows=tuple(
                Row(
                    cells=(
                        OVERRIDABLE[key],
                        f"{provision.value:.4g}" + dagger(provision),
                        provision.clause,
                        _standing(provision.reason, provision.verified),
                    )
                )
                for key, provision in rules.values.items()
            ),
            kind="compact",
        ),
        "overrides": Table(
            caption="Overridden for this project",
            columns=(
                Column(head="Provision", align="left", share=3.0),
                Column(head="Value", share=0.8),
                Column(head="Reason given in the workbook", align="left", share=4.0),
            ),
            rows=tuple(
                Row(cells=(OVERRIDABLE[row.provision], f"{row.value:.6g}†‡", row.reason))
                for row in scene.data.overrides
            ),
        ),
    }


def _standing(reason: str, verified: bool) -> str:
    if reason:
        return "overridden, see below"
    return "confirmed" if verified else "to be verified"


def has_clearances(scene: Scene) -> bool:
    """Whether there is anything to draw."""
    return any(not math.isnan(gap.clearance.provided_m) for gap in scene.assessment.clearances)
