"""The model used for each array, the reason it is adequate, and what it neglects.

Selects nothing: `solver.sliding.model_selection` does. Read `report.pages.parts` first.

Comparison of arrays with a row of linked blocks: results, and where one block may not do.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.friction import mus_words
from report.assessment.design.tested_friction import tested
from report.document.columns import (
    ColumnHead,
    centered,
    length,
    plain,
    required,
    text,
    weight,
    words,
)  # fmt: skip
from report.document.tables import Column, Table, Wide, by_place, listed, merged
from report.pages.parts import PackageData, statistic, verdict
from report.runs import OrientedRun
from report.text.counts import spelled
from report.text.error_text import below_mm
from report.text.grouping import grouped_by
from report.text.names import named
from report.text.unit_format import NO_VALUE
from report.text.units import NO_BREAK, Quantity, nan_is_worst, number, ratio, ratio_up
from solver.model import INCH_M, Motion
from solver.sliding.model_selection import DEFAULT, Model, Solution


def _link_runs_table(package: PackageData) -> Table:
    columns: Sequence[Column] = (
        (words("Array", 0.9), lambda item: item.design.id),
        (text("Blocks", share=0.9), lambda item: len(item.row.mus)),
        (text("μ", share=1.5), lambda item: _range(item.row.mus)),
        (ColumnHead(head="Link stiffness", quantity=Quantity.STIFFNESS),
         lambda item: item.links.stiffness_n_per_m),
        (plain("Damping", 3, unit="of critical", share=1.2), lambda item: item.links.damping_ratio),
        (required("PRD, rigid", 0.8), lambda item: item.rigid_prd_m),
        (required("PRD, row", 0.8), lambda item: item.farthest.prd_m),
        # A row without a final value has no farthest block.
        (text("Block", share=0.8),
         lambda item: math.nan if math.isnan(item.farthest.prd_m) else item.farthest.block),
        (weight("Link force", 0.9), lambda item: item.link_force_n),
    )  # fmt: skip
    return listed(package.assessment.linked, columns, package.fmt, kind="compact")


def _range(mus: Sequence[float]) -> str:
    return " to ".join(number(mu, 3) for mu in sorted({min(mus), max(mus)}))


def _adequacy_table(package: PackageData) -> Table:
    columns: Sequence[Column] = (
        (words("Array", 0.9), lambda item: item.design.id),
        (required("Rigid, one axis"), lambda item: item.rigid.value_m),
        (required("Row, one axis"), lambda item: item.linked.value_m),
        (ColumnHead(head="Ratio r", text=ratio_up, share=0.9), lambda item: item.ratio),
        (required("Design, used"), lambda item: item.design.permitted_m),
        (required("Design, with links"), lambda item: item.estimated_m),
        (centered("Verdict"), lambda item: verdict(item.is_rigid_enough)),
    )
    return listed(package.assessment.linked, columns, package.fmt, kind="compact")


_NEGLECTED = {
    Model.ONE_AXIS_VERTICAL: "Vertical shaking",
    Model.TWO_AXES: "Cross-slope shaking",
    Model.SPEED_FRICTION: "Velocity-dependent friction",
}
_NOT_KNOWN = Wide("not known", 4), ""


def page(package: PackageData) -> Mapping[str, object]:
    """Return the assumptions, the models used, neglected effects, and independent checks."""
    done, data = package.assessment, package.data
    motions = [run.motion for run in done.governing.motions]
    millimeters, inches = number(1000.0 * DEFAULT.matters_m, 0), DEFAULT.matters_m / INCH_M
    varied = [array for array in data.arrays if not array.friction.is_constant]
    return {
        "varied": mus_words(varied),
        "is_tested": bool(tested(data)),
        "has_ground": package.has_ground,
        "n_motions": len(motions),
        "n_transverse": sum(motion.has_transverse for motion in motions),
        "n_vertical": sum(motion.has_vertical for motion in motions),
        "models": "; ".join(f"{model.value}: {model.title}" for model in Model),
        "tolerance": f"{millimeters}{NO_BREAK}mm ({number(inches, 2)}{NO_BREAK}in) or "
        f"{number(100.0 * DEFAULT.matters_share, 1)}%",
        "orientations": _orientations(motions),
        "models_used": merged(_table(package)),
        "neglected": merged(_neglected_table(package)),
        "stability": merged(_stability_table(package)),
        "unchecked": _unchecked(done.shaking.motions),
        "sensitive": [
            named([item.id for item in group], "Array")
            for group in done.alike
            if _is_sensitive(group[0])
        ],
        "links": _links(package) if done.linked else None,
    }


def _orientations(motions: Sequence[Motion]) -> str:
    """Return the orientations in which the motions are run."""
    in_two = [motion for motion in motions if motion.has_transverse]
    if not in_two:
        return (
            "No motion has a second horizontal component: each record is applied along the slope, "
            "in the polarities that the workbook requests. Cross-slope shaking also uses part of "
            "the friction; with both components, most displacements are larger (verification "
            "manual)."
        )
    polarities = "with the polarities that the workbook requests"
    if all(len(motion.signs) == 2 for motion in motions):
        polarities = "with both polarities"
    some = (
        ""
        if in_two == motions
        else f", in the {len(in_two)} of {len(motions)} motions that have two"
    )
    counts = sorted({len(motion.orientations) for motion in in_two})
    return (
        "Each horizontal component in turn is applied along the slope and the other cross-slope, "
        f"{polarities}{some}: {' or '.join(map(spelled, counts))} runs per motion. The "
        "largest PRD governs."
    )


def _unchecked(motions: Sequence[Motion]) -> str:
    """Return the checks not possible without vertical components; nothing if all have one."""
    count = sum(motion.has_vertical for motion in motions)
    if count == len(motions):
        return ""
    have, others = "No motion has", ""
    if count:
        have = f"{count} of {len(motions)} motions {'has' if count == 1 else 'have'}"
        others = " for the others"
    return (
        f"{have} a vertical component; uplift is not checked{others}, and tipping is checked with "
        "horizontal shaking only."
    )


def _is_sensitive(array: ArrayAssessment) -> bool:
    """Whether friction that decreases lets a negligible perturbation decide if an array stops."""
    is_by_speed = array.worst.governing.solution.model is Model.SPEED_FRICTION
    return is_by_speed and not array.array.friction.is_monotone


def _links(package: PackageData) -> Mapping[str, object]:
    """Return the rows of linked blocks."""
    linked, fmt = package.assessment.linked, package.fmt
    return {
        "names": named([item.design.id for item in linked], "array"),
        "estimates": [
            (
                item.design.id,
                ratio_up(item.ratio),
                fmt.both_up(item.design.analysis.value_m),
                fmt.both_up(item.design.floor_m),
                "no limit" if math.isinf(item.estimated_m) else fmt.both_up(item.estimated_m),
            )
            for item in linked
        ],
        "runs": _link_runs_table(package),
        "adequacy": _adequacy_table(package),
        "statistics": ", ".join(sorted({statistic(item.design.analysis.basis) for item in linked})),
        "troubles": package.sentences("links"),
    }


def _limited(demand: float) -> str:
    return number(demand, 2) if math.isfinite(demand) else "no limit"


def _stability_table(package: PackageData) -> Table:
    has_vertical = any(motion.has_vertical for motion in package.assessment.shaking.motions)
    # Without a vertical component N cannot fall: that no uplift is found then says nothing.
    none = "none" if has_vertical else "not checked"
    columns = (
        (words("Array", 0.8), lambda item: item.id),
        (plain("Min. N/W"), lambda item: item.uplift.n_min_g),
        (text("Uplift time", "s", 1.1),
         lambda item: number(item.uplift.duration_s, 3) if item.uplift.lifts else none),
        (text("Demand", "V/N"), lambda item: _limited(item.tipping.demand)),
        (plain("Transmitted", unit="V/N", share=1.1), lambda item: item.tipping.transmitted),
        (plain("Capacity", unit="b/(2c)", share=1.1), lambda item: item.tipping.capacity),
        (text("D/C at rest", share=1.2), lambda item: ratio(item.tipping.at_rest_ratio)),
        (text("D/C sliding", share=1.2), lambda item: ratio(item.tipping.sliding_ratio)),
        (centered("Verdict"), lambda item: verdict(item.tipping.is_ok and not item.uplift.lifts)),
    )  # fmt: skip
    return listed(package.assessment.arrays, columns, package.fmt, kind="compact")


@dataclass(frozen=True, slots=True)
class _Group:
    """The runs of an array with one model."""

    array: ArrayAssessment
    runs: Sequence[OrientedRun]

    @property
    def model(self) -> str:
        """The name of the model, and how many runs have no vertical component to model."""
        model, names = self.runs[0].solution.model, {run.model for run in self.runs}
        lacking = sum(run.model != model.title for run in self.runs)
        name = self.runs[0].model if len(names) == 1 else f"{model.title} ({lacking} runs without)"
        return f"{int(model)}, {name}"

    @property
    def demand(self) -> float:
        """The largest friction demand; inf: no limit."""
        return max(run.solution.friction_demand for run in self.runs)

    @property
    def reason(self) -> str:
        """Why the run with the largest PRD, and of these with the largest demand, has it."""

        def worst(run: OrientedRun) -> tuple[float, float]:
            return nan_is_worst(run.prd_m), run.solution.friction_demand

        return max(self.runs, key=worst).solution.reason

    @property
    def error(self) -> str:
        """A bound on the errors of the PRDs."""
        worst = max((run.result.error_m for run in self.runs), key=nan_is_worst)
        if math.isnan(worst):
            return NO_VALUE
        # As a power of ten: the digits of a bound depend on the machine.
        return below_mm(worst) if worst == 0.0 else f"below {below_mm(worst)}"


def _table(package: PackageData) -> Table:
    columns = (
        (words("Array", 0.8), lambda group: group.array.id),
        (words("Model", 2.5), lambda group: group.model),
        (text("Runs", share=1.1), lambda group: f"{len(group.runs)} of {len(group.array.runs)}"),
        (plain("μ", unit="at rest", share=0.9), lambda group: group.array.array.friction.mu_static),
        (text("Demand", share=1.1), lambda group: _limited(group.demand)),
        (words("Reason", 4.7), lambda group: group.reason),
        (words("Error of PRD", 1.9), lambda group: group.error),
    )
    groups = []
    for array in package.assessment.arrays:
        by_model = grouped_by(array.runs, lambda run: run.solution.model)
        # From the simplest model on, as the ladder of models is listed above the table.
        groups += [_Group(array, by_model[model]) for model in sorted(by_model)]
    return listed(groups, columns, package.fmt, kind="compact")


_Neglected = tuple[str, str, float | Wide | str, float | str, str]
"""Array, what is neglected, the change of PRD and of design displacement [m], and its basis."""


def _neglected_table(package: PackageData) -> Table:
    columns = by_place(
        words("Array", 0.8),
        words("Neglected", 2.7),
        length("PRD, at most", 0.9),
        length("Design displ., at most", 1.15),
        words("Basis", 3.6),
    )
    effects = [row for array in package.assessment.arrays for row in _neglected(array)]
    return listed(effects, columns, package.fmt, kind="compact")


def _neglected(array: ArrayAssessment) -> Iterator[_Neglected]:
    solutions = [run.solution for run in array.runs]
    # The most complete model is its own next one.
    neglected = sorted(
        {solution.next_model for solution in solutions if solution.next_model > solution.model}
    )
    for model in neglected:
        # A run that already has this model has nothing to tell of it.
        without = [
            solution for solution in solutions if solution.next_model is model > solution.model
        ]
        yield _effect(array, model, without)
    if neglected:
        return
    if all(solution.model is Model.NO_SLIP for solution in solutions):
        yield array.id, "none; no slip", "—", "—", "exact"
    elif array.array.friction.is_constant:
        basis = "one coefficient entered"
        yield array.id, _NEGLECTED[Model.SPEED_FRICTION], *_NOT_KNOWN, basis
    else:
        yield array.id, "None", "—", "—", "the most complete model is used"


def _effect(array: ArrayAssessment, model: Model, group: Sequence[Solution]) -> _Neglected:
    effect = max((solution.next_effect_m for solution in group), key=nan_is_worst)
    basis = (
        "both models run; error included" if model is Model.TWO_AXES else "exact: both models run"
    )
    # The more complete model may lift off or diverge: its effect is then not known, not zero.
    if not math.isfinite(effect):
        no_result = "no result with the more complete model"
        return array.id, _NEGLECTED[model], *_NOT_KNOWN, no_result
    # Upper bound: all motions take the largest effect, so that mean and largest rise by it alike.
    raised = max(array.analysis.value_m + array.analysis.factor * effect, array.floor_m)
    return array.id, _NEGLECTED[model], effect, raised - array.design_m, basis
