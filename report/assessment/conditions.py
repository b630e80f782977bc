"""Requirements other than the numeric limits: what is not on file, not stated or close to a limit.

Each row says what its lack leads to; `array_rows` has those of one array. Read `project_rows`.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Sequence
from functools import partial
from operator import attrgetter
from typing import TYPE_CHECKING

import numpy as np

from report.assessment.clearances import ClearanceCheck, slides_m
from report.assessment.existing_roof import existing_roof_rows
from report.assessment.neighbors import PlanNeighbor
from report.assessment.requirement_rows import fire_lane_rows, friction_rows, hazard_rows
from report.assessment.routes import Route
from report.assessment.verdict import (
    MOTIONS_ID,
    NO_DESIGN,
    NOT_GIVEN,
    PLAN_ROW,
    SHIFT,
    STAYS,
    VELOCITY_ROW,
    Requirement,
    Verdict,
    condition,
    override_rows,
    stated,
)
from report.motions.history import PreparedMotion, targets
from report.sheet.checking.motion_checks import FIELDS
from report.sheet.schema import ProjectInput
from report.sheet.schema.fields import Place
from report.sheet.schema.scene import SIDES
from report.text.amounts import capacity, compared_pairs, demand, limit_texts
from report.text.counts import capitalized, grouped_by, ids_by, lowered, numbered, quoted, ranged
from report.text.units import G_MPS2, Quantity, digits_up, no_less, no_more, number, pair
from solver.records.acceptance import FULL_RATIO, POINTS_HZ, Acceptance, spectrum_mps2
from solver.rules.limit import PROGRAM, Consequence, Limit, Measure
from solver.rules.provisions import RULE_SETS, review_lifts_slope

if TYPE_CHECKING:
    from report.assessment.arrays import ArrayAssessment
    from report.motions.prepare import Shaking

# Final displacement of a record [m] above which it drifts: the block would follow it as slip.
DRIFT_M = 0.010
# Final displacement [m] and velocity [m/s] above which it is not accepted: in no code. A fault may
# move the ground by more, and no ground keeps moving.
MOST_DRIFT_M, MOST_END_MPS = 0.5, 0.1
_DRIFT_TITLES = (
    "Final displacement of each component, unless it is stated to be permanent",
    "Final velocity of each component",
)

# Periods from which on the mean of the ground motions / their target is compared, and the ratio
# above which a peer reviewer must accept the motions: in no code.
LONG_PERIOD_S, MOST_LONG_RATIO = 1.0, 2.0
_NOISE = 1e-9  # a width in other units is no more than itself

# Above it, records that are scaled to a target are of another intensity than it.
MOST_FACTOR = 2.0

# Who takes the prescriptive displacement need not meet them.
_OF_ANALYSIS = (MOTIONS_ID, "drift", "ground_motions", "peer_review", VELOCITY_ROW)
_NO_EFFECT = "The design displacement is prescriptive and does not follow from an analysis."


def project_rows(data: ProjectInput, prepared: Sequence[PreparedMotion]) -> tuple[Requirement, ...]:
    """Return the requirements on the project, its motions, friction tests and fire lanes."""
    return (
        _building_code(data),
        *_roof_outline(data),
        *_dates(data),
        *_confirmation(data),
        *_peer_review(data),
        *override_rows(data),
        *hazard_rows(data),
        *_drift(data, prepared),
        *_ground_motions(data, prepared),
        *friction_rows(data),
        *fire_lane_rows(data),
        *existing_roof_rows(data),
    )


def _building_code(data: ProjectInput) -> Requirement:
    site = data.site
    return condition(
        id="building_code",
        title="Building code and jurisdiction",
        **stated(
            "site",
            building_code=("building code", site.code_text),
            jurisdiction=("jurisdiction", site.jurisdiction),
        ),
        limit="code with its year, and jurisdiction",
        basis="plan check",
        remedy="State on the sheet Site the adopted building code and the jurisdiction.",
    )


def _roof_outline(data: ProjectInput) -> Iterator[Requirement]:
    if data.roof.placed is None:
        yield condition(
            id="roof_outline",
            title="Outline of the roof",
            found=NOT_GIVEN,
            limit="given",
            basis="roof plan",
            is_satisfied=False,
            remedy="Enter the outline of the roof on the sheet Building: without it, roof edges "
            "near the arrays were not looked for.",
            places=tuple(Place("roof", 0, side) for side in SIDES),
        )


def _dates(data: ProjectInput) -> Iterator[Requirement]:
    """Yield what is dated later than the package, or was given for other inputs than these."""
    options, tests, issued = data.options, data.friction_tests, data.project.date
    again = "Have it confirmed for these inputs, and enter the new date"
    compare = (
        "Compare these inputs with it, and enter its date if that is new; if they agree, clear"
    )
    dated = (
        ("peer review", options.peer_date if options.peer_reviewed and data.motions else None,
         Place("options", 0, "peer_date"), f"{again}: until then the package does not rest on it."),
        ("friction report", tests.date, Place("friction_tests", 0, "date"),
         f"{compare} Test report covered."),
        ("hazard", data.site.hazard_date, Place("site", 0, "hazard_date"),
         f"{compare} Hazard covered."),
        ("confirmation of the provisions", data.confirmation.date,
         Place("confirmation", 0, "date"), f"{again}: until then the marks † stay."),
        ("confirmation of the drawing", data.project.drawing_confirmed_date,
         Place("project", 0, "drawing_confirmed_date"), f"{again}."),
    )  # fmt: skip
    for what, date, place, remedy in dated:
        row = partial(
            condition, id="dates", basis="plan check", is_satisfied=False, places=(place,)
        )
        # A later date may be a slip of typing: until then it confirms nothing.
        if date and date > issued:
            yield row(
                title=f"Date of the {what}",
                found=str(date),
                limit=f"not later than the package, {issued}",
                remedy="Correct the date, or date the package later.",
            )
        # By the hashes that a report put on record: a date cannot show a later change.
        if date and (sheets := data.outdated.get(place.section)):
            yield row(
                title=capitalized(what),
                found=f"{date}, given before these inputs changed: {sheets}",
                limit="confirmation for these inputs",
                remedy=remedy,
            )


def _confirmation(data: ProjectInput) -> Iterator[Requirement]:
    confirmation, adopted = data.confirmation, data.site.adopted
    if confirmation.date and "confirmation" not in data.outdated:  # else a row on its date says so
        yield condition(
            id="confirmation",
            title="Confirmation of the provisions",
            found=f"{', '.join(confirmation.of)}: {confirmation.by}, {confirmation.date}",
            limit=", ".join(part or f"building code {NOT_GIVEN}" for part in adopted),
            basis="plan check",
            # Also where no report was made between, so that nothing was put on record.
            is_satisfied=confirmation.of == adopted,
            remedy="Have the provisions of these inputs confirmed: until then the marks † stay.",
            places=(Place("confirmation", 0, "date"),),
        )


def _peer_review(data: ProjectInput) -> Iterator[Requirement]:
    options = data.options
    if not (options.peer_reviewed and data.motions):
        return
    # A plan checker asks for the reviewer by name and license, and for the letter itself.
    fields = ("reviewer", "license", "date", "letter")
    lifts_slope = review_lifts_slope(RULE_SETS[data.site.rule_set], data.site.sdc)
    back = "floor and the slope limit of the analysis route apply"
    yield condition(
        id="peer_review",
        title="Peer review of the analysis",
        **stated("options", **{f"peer_{x}": (x, getattr(options, f"peer_{x}")) for x in fields}),
        limit="reviewer, license, date and letter",
        basis=data.site.rule_set,
        remedy="Give reviewer, license, date and letter: until then the "
        f"{back if lifts_slope else 'floor of the analysis route applies'}.",
    )


def _drift(data: ProjectInput, prepared: Sequence[PreparedMotion]) -> Iterator[Requirement]:
    for index, motion in enumerate(prepared):
        if drifts(motion):
            ends = {name: abs(m.final_displacement_m) for name, m in motion.measures.items()}
            largest = max(ends.values())
            drift, most = compared_pairs(
                demand(largest),
                capacity(DRIFT_M),
                Quantity.DRIFT,
                data.us_first,
                is_at_least=False,
            )
            yield condition(
                id="drift",
                title="Final displacement of the record",
                subject=motion.motion_id,
                found=f"{drift}; permanent by {motion.drift_basis}"
                if motion.drift_basis
                else drift,
                limit=f"≤ {most}",
                basis="limit of this program",
                is_satisfied=False,
                remedy=f"A permanent displacement is computed as slip. {STAYS}"
                if motion.drift_basis
                else "Drift of a record is computed as slip: correct its baseline, or state on the "
                "sheet Motions by whom and by what source the displacement is permanent.",
                places=(Place("motions", index, FIELDS[max(ends, key=ends.__getitem__)]),),
            )


def _ground_motions(
    data: ProjectInput, prepared: Sequence[PreparedMotion]
) -> Iterator[Requirement]:
    # Sliding is driven by long periods: an excess there goes straight into the displacement.
    target, periods_s = targets(data).ground, 1.0 / POINTS_HZ
    # NaN at short periods, so that nanargmax looks at the long ones alone.
    goal_mps2 = np.where(periods_s >= LONG_PERIOD_S, G_MPS2 * target.ordinates(periods_s), math.nan)
    ratio, where = 0.0, ""
    for name in ("horizontal", "transverse"):
        records = [item.scaled[name] for item in prepared if item.roof and name in item.scaled]
        if records and np.isfinite(goal_mps2).any():
            spectra = [spectrum_mps2(each.a_mps2.tobytes(), each.dt_s) for each in records]
            ratios = np.mean(spectra, axis=0) / goal_mps2
            at = int(np.nanargmax(ratios))
            ratio, where = max(
                (ratio, where), (float(ratios[at]), f"{name}, at {periods_s[at]:.3g} s")
            )
    row = partial(
        condition,
        id="ground_motions",
        limit=f"≤ {number(MOST_LONG_RATIO, 2)}",
        basis="limit of this program",
    )
    if any(item.roof for item in prepared) and not where:
        values = {"S_D1": data.site.s_d1, "T_L": data.target.t_l_s}
        lacking = [name for name, value in values.items() if value is None]
        yield row(
            title="Mean of the ground motions / target at long periods",
            found=f"{' and '.join(lacking)} {NOT_GIVEN}: no target"
            if lacking and not data.spectrum
            else f"no target from {LONG_PERIOD_S:g} s on",
            is_satisfied=False,
            remedy="Give S_1 and F_v, or S_D1, and T_L; or a spectrum up to 10 s.",
            places=(Place("motions"),),
        )
    if where:
        yield row(
            title=f"Mean of the ground motions / target ({target.name}), {LONG_PERIOD_S:g} to 10 s",
            found=f"{digits_up(ratio, 3)} ({where})",
            is_satisfied=ratio <= MOST_LONG_RATIO,
            remedy="Obtain the peer reviewer's acceptance of the ground motions in writing, or use "
            f"ground motions that match the target at long periods. {STAYS}",
            places=(Place("motions"),),
        )


def noted(rows: Iterable[Requirement], by_runs: Collection[str]) -> Iterator[Requirement]:
    """Yield rows; what concerns the analysis alone is a note where nothing follows from it."""
    # `by_runs` are the arrays whose design displacement follows from their runs.
    for row in rows:
        concerned = row.subject in by_runs if row.id == VELOCITY_ROW else bool(by_runs)
        if row.is_satisfied or concerned or row.id not in _OF_ANALYSIS:
            yield row
        else:
            note = {"consequence": Consequence.NOTE, "verdict": Verdict.NOTE, "remedy": _NO_EFFECT}
            yield row.model_copy(update=note)


def motion_rows(
    acceptance: Acceptance, routes: Iterable[Route], shaking: Shaking, us_first: bool
) -> tuple[Requirement, ...]:
    """Return the limits on the motions that they miss."""
    takes_analysis = Route.ANALYSIS in routes
    # The way out is said once, at the first of the spectral limits.
    spectral = next(filter(_is_spectral, acceptance.missed), None)
    return tuple(
        _motion_row(
            missed,
            takes_analysis,
            _ways(acceptance, shaking) if missed is spectral else _ways_of_drift(missed, shaking),
            us_first,
        )
        for missed in acceptance.missed
    )


def _ways(acceptance: Acceptance, shaking: Shaking) -> str:
    """Return how records reach the target: by a factor, if one does, and by motions of them."""
    ways, more = "", _factor(acceptance)
    if more <= MOST_FACTOR:
        factors = ids_by(shaking.motions, lambda motion: digits_up(motion.scale * more, 4))
        each = "; ".join(f"{ranged(ids)} {factor}" for factor, ids in factors.items())
        ways = (
            f" With {digits_up(more, 3)} times their factors they reach it: set Scaling to factor"
            f" on the sheet Motions, and the factors {each}."
        )
    are_records = not any(motion.is_generated for motion in acceptance.motions)
    if are_records and all(file.is_file for file in shaking.records):
        files = grouped_by(shaking.records, attrgetter("motion_id")).values()
        seeds = " ".join(quoted(",".join(file.name for file in each)) for each in files)
        ways += (
            " Or clear their rows on the sheet Motions and make motions of them that reach it, in"
            f" the folder of the workbook: roofslip motion suite matched --into . --records {seeds}"
        )
    return ways


def _ways_of_drift(missed: Limit, shaking: Shaking) -> str:
    """Return which records end elsewhere or in motion, and what would do; empty for another."""
    if missed.title not in _DRIFT_TITLES:
        return ""
    ids = [
        motion.motion_id
        for motion in shaking.prepared
        if any(not limit.ok for limit in drift_limits([motion]))
    ]
    return f" Correct the baseline of {ranged(ids)} (Baseline or High-pass corner on its row)."


def drift_limits(prepared: Sequence[PreparedMotion]) -> tuple[Limit, ...]:
    """Return the limits on where the components of the motions end, and how fast they are then."""
    free = [motion for motion in prepared if not motion.drift_basis]

    def largest(motions: Sequence[PreparedMotion], end: str) -> tuple[float, str]:
        ends = (
            (round(abs(getattr(measures, end)), 9), f"{motion.motion_id}, {name}")
            for motion in motions
            for name, measures in motion.measures.items()
        )
        return max(ends, default=(0.0, ""))

    ends = (
        (*largest(free, "final_displacement_m"), MOST_DRIFT_M, Measure.LENGTH_M),
        (*largest(prepared, "final_velocity_mps"), MOST_END_MPS, Measure.VELOCITY_MPS),
    )
    return tuple(
        Limit(
            title=title,
            found=found,
            limit=most,
            is_at_least=False,
            measure=measure,
            provision=PROGRAM,
            worst=worst if found > 0.0 else "",
        )
        for title, (found, worst, most, measure) in zip(_DRIFT_TITLES, ends, strict=True)
    )


def _is_spectral(row: Limit) -> bool:
    """Whether a limit is on a spectrum over its target, or on how many of its points are below."""
    return row.is_ratio_to_target or (row.measure is Measure.COUNT and not row.is_at_least)


def _factor(acceptance: Acceptance) -> float:
    """Return a factor of all motions with which they satisfy every limit on their spectra."""
    ratios = [row for row in acceptance.rows if row.is_ratio_to_target]
    is_dipping = any(_is_spectral(row) and row not in ratios for row in acceptance.missed)
    # Points below 1.00 are counted from 1.3 Hz on: a factor with which none is needs no count.
    return max(
        (FULL_RATIO if is_dipping and not row.is_program_limit else row.limit) / row.found
        if row.found > 0.0
        else math.inf
        for row in ratios
    )


def _motion_row(missed: Limit, takes_analysis: bool, way: str, us_first: bool) -> Requirement:
    # The prescriptive displacement rests on no motion: there a miss is a condition only.
    is_ng = missed.consequence is Consequence.NG
    measured, least = limit_texts(missed, us_first)
    return Requirement(
        id=MOTIONS_ID,
        title=missed.title,
        found=measured + (f" ({missed.worst})" if missed.worst else ""),
        limit=f"{missed.sign} {least}",
        basis=missed.provision.clause,
        is_satisfied=False,
        consequence=Consequence.NG if is_ng and takes_analysis else Consequence.CONDITION,
        remedy=_motion_remedy(is_ng, takes_analysis) + way,
        places=(Place("motions"),),
    )


def _motion_remedy(is_ng: bool, takes_analysis: bool) -> str:
    if not is_ng:
        show = "Show that the duration of strong motion is sufficient, or replace the motions."
        return f"{show} {STAYS}"
    if takes_analysis:
        return (
            "Until it is satisfied, the value from analysis is not permitted: replace or complete "
            "the motions."
        )
    return (
        "The prescriptive displacement is compared with the runs under these motions: replace or "
        "complete the motions."
    )


def plan_rows(data: ProjectInput, nearby: Sequence[PlanNeighbor]) -> tuple[Requirement, ...]:
    """Return what the plan shows near an array and no clearance covers, or contradicts."""
    return tuple(
        Requirement(
            id=PLAN_ROW,
            title=title,
            cause=f"{lowered(title)} {NOT_GIVEN}" if neighbor.is_missing else "",
            subject=neighbor.array,
            found=gap,
            limit=limit,
            basis="roof plan",
            is_satisfied=False,
            consequence=Consequence.NG if neighbor.is_short else Consequence.CONDITION,
            remedy=f"{text}.",
        )
        for neighbor in nearby
        for title in (f"Clearance {neighbor.names}",)
        for gap, limit in (_found_and_required(neighbor, data.us_first),)
        for text in neighbor.shortcomings()
    )


def _found_and_required(neighbor: PlanNeighbor, us_first: bool) -> tuple[str, str]:
    if not neighbor.is_short:
        gap = pair(neighbor.gap_m, Quantity.SIZE, us_first, no_more)
        if neighbor.is_missing:
            near = "within twice the design displacement"
            return f"{NOT_GIVEN}; {gap} in plan, {near}", "a clearance, as in the plan"
        # Several rows of a pair may give several distances.
        entered = {row.clearance.provided_m for row in neighbor.contradictions}
        sizes = " and ".join(pair(m, Quantity.SIZE, us_first, no_more) for m in sorted(entered))
        return f"differs from the plan: {sizes} entered, {gap} measured", "as in the plan"
    required_m = neighbor.required_m
    gap, least = compared_pairs(
        capacity(neighbor.gap_m), demand(required_m), Quantity.SIZE, us_first
    )
    required = NO_DESIGN if math.isnan(required_m) else f"≥ {least}{neighbor.mark}"
    return f"{NOT_GIVEN}; {gap} in plan", required


def drifts(prepared: PreparedMotion) -> bool:
    """Whether any component of a motion ends away from where it began."""
    return any(abs(m.final_displacement_m) > DRIFT_M for m in prepared.measures.values())


def asked_pathways(data: ProjectInput, pairs: Sequence[PlanNeighbor] = ()) -> Iterator[Requirement]:
    """Yield for each array whether its clearances say if a fire pathway runs along them.

    The pairs of the plan that lack a clearance do not say so, if they are given.
    """
    for array in data.arrays:
        rows = [(index, row) for index, row in enumerate(data.clearances) if row.array == array.id]
        blank = [index for index, row in rows if row.pathway_m is None]
        missing = sum(pair.is_missing and pair.array == array.id for pair in pairs)
        count = len(blank) + missing
        yield condition(
            id="fire_pathways",
            title="Fire pathways along the clearances",
            subject=array.id,
            found=f"{numbered(count, 'clearance')} without an answer" if count else "answered",
            limit="none or a width, for each clearance",
            basis="fire code, as entered",
            is_satisfied=not count,
            remedy="State for each row of the sheet Clearances the width of the fire pathway along "
            "it, or none.",
            places=tuple(Place("clearances", index, "pathway_m") for index in blank)
            or (Place("clearances"),),
        )


def pathway_rows(
    data: ProjectInput, arrays: Sequence[ArrayAssessment], clearances: Sequence[ClearanceCheck]
) -> Iterator[Requirement]:
    """Yield what is left of each fire pathway after the arrays beside it have slid into it."""
    for index, gap in enumerate(clearances):
        row = gap.clearance
        if not row.pathway_m:
            continue
        slides = slides_m(arrays, gap)
        left_m = row.provided_m - math.fsum(slides)
        units = Quantity.SIZE, data.us_first
        left, least = compared_pairs(capacity(left_m), demand(row.pathway_m), *units)
        slid = (pair(m, *units, no_less) for m in slides)
        terms = " − ".join((pair(row.provided_m, *units, no_more), *slid))
        width = f"{terms} = {left}{gap.design_mark}"
        yield Requirement(
            id="fire_pathway",
            title=f"Fire pathway {row.array} to {row.object} after displacement",
            cause=f"fire pathway {row.array} to {row.object} too narrow",
            subject=row.array,
            found=NO_DESIGN if math.isnan(left_m) else width,
            limit=f"≥ {least}",
            basis="fire code, as entered",
            is_satisfied=left_m >= row.pathway_m * (1.0 - _NOISE),
            consequence=Consequence.NG,
            remedy="Widen the clearance, or reduce the displacement.",
            places=(Place("clearances", index, "pathway_m"),),
        )


def less_friction_rows(
    arrays: Sequence[ArrayAssessment],
    clearances: Sequence[ClearanceCheck],
    less_arrays: Sequence[ArrayAssessment],
    less_clearances: Sequence[ClearanceCheck],
) -> Iterator[Requirement]:
    """Yield the routes and clearances that are permitted as given, and not with less friction."""
    friction = f"{number(100.0 * SHIFT, 0)} % less friction"
    row = partial(condition, id="less_friction", is_satisfied=False, basis="sensitivity")
    for array, less in zip(arrays, less_arrays, strict=True):
        if array.is_permitted and not less.is_permitted:
            # No code asks for this margin, and no cell could show it: only a larger coefficient.
            yield row(
                consequence=Consequence.NOTE,
                title=f"The {array.route} route with {friction}",
                subject=array.id,
                found=f"not permitted with μ = {number(less.array.minimum_mu, 3)}",
                limit="permitted",
                remedy=f"The route is permitted as entered, and not with {friction}.",
            )
    for gap, short in zip(clearances, less_clearances, strict=True):
        if gap.verdict.is_permitted and not short.verdict.is_permitted:
            yield row(
                title=f"Clearance {gap.clearance.array} to {gap.clearance.object} with {friction}",
                subject=gap.clearance.array,
                found="not satisfied",
                limit="satisfied",
                remedy=f"With {friction} this clearance is not satisfied: confirm the friction "
                "coefficient, or provide more clearance.",
            )
