"""The rows of results.json, made from an assessment and its evidence. Read `results`."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterable, Iterator, Mapping
from itertools import chain

import numpy as np

from report.assessment.assessment import Assessment
from report.assessment.causes import came_to
from report.assessment.checks.sentence import sentence, texts
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.clearances import ClearanceCheck
from report.assessment.design.friction import mu_words
from report.assessment.design.linked_blocks import LinkedArray, LinkedMotion, LinkedRun
from report.assessment.plan.neighbors import PlanNeighbor
from report.assessment.precheck import findings
from report.assessment.remedies.remedy import Remedies
from report.assessment.support.evidence import Evidence
from report.assessment.support.further_runs import Cumulative
from report.assessment.support.uncertainty import Uncertainty
from report.motions.components import RecordFile
from report.motions.history import PreparedMotion
from report.project.check.finding_lines import located
from report.project.model.choices import Direction
from report.project.model.finding import Finding
from report.project.model.input_rows import Place
from report.project.model.motion_input import BuildingInput
from report.project.read.documents import Document
from report.provenance.release import version
from report.results.array_results import (
    ArrayResult,
    LinkedResult,
    LinkedRunResult,
    LowVelocityResult,
    PeakResult,
    RunResult,
    TippingResult,
    UpliftResult,
)
from report.results.check_results import CheckResult, FindingResult, RemedyResult
from report.results.clearance_results import (
    ClearanceResult,
    GivenResult,
    LowVelocity,
    NeighborResult,
)
from report.results.result_base import LengthUnitResult, PrintedResult
from report.results.results_model import SCHEMA_VERSION, Compared, Results
from report.results.source_results import (
    DocumentResult,
    MotionResult,
    RecordResult,
    RoofResult,
    WorkbookResult,
)
from report.results.uncertainty_results import (
    AnglesResult,
    CumulativeResult,
    MarginResult,
    TurnedResult,
    UncertaintyResult,
    VariationResult,
)
from report.runs import MotionRun, OrientedRun
from report.text.amounts import Amount
from report.text.names import joined
from report.text.unit_format import UnitFormat
from solver.building.roof import RoofMotion
from solver.model import Motion
from solver.rules.provisions import AnalysisValue


def results(assessment: Assessment, evidence: Evidence) -> Results:
    """Return an assessment and its evidence as one document."""
    source, shaking, project = assessment.source, assessment.shaking, assessment.project
    slow = assessment.low_velocity
    pairs = zip(shaking.motions, shaking.prepared, strict=True)
    return Results(
        schema_version=SCHEMA_VERSION,
        roofslip_version=version(),
        workbook=WorkbookResult(name=source.path.name, sha256=source.sha256),
        records=tuple(map(_record, shaking.records)),
        documents=tuple(map(_document, source.documents)),
        motions=tuple(_motion(motion, prepared) for motion, prepared in pairs),
        input=project,
        s_ds_g=project.site.s_ds,
        sdc_is_confirmed=not project.site.sdc_lacks,
        rule_set=assessment.rules.name,
        printed=_printed(project.us_first),
        verdict=assessment.verdict,
        warnings=tuple(
            sentence(check, project.us_first) for check in assessment.open if check.id == "runs"
        ),
        findings=tuple(finding_results(findings(source, project, shaking), source.addresses)),
        checks=tuple(check_results(assessment)),
        arrays=tuple(_array(assessment, item) for item in assessment.arrays),
        clearances=tuple(map(_clearance, assessment.clearances)),
        low_velocity=LowVelocity(
            arrays=tuple(map(_low_velocity, slow.arrays)),
            clearances=tuple(map(_clearance, slow.clearances.values())),
        ),
        linked=tuple(map(_linked, assessment.linked)),
        neighbors=tuple(map(_neighbor, assessment.neighbors)),
        remedies=tuple(_remedies(evidence.remedies)),
        certainty=_uncertainty(evidence.uncertainty) if evidence.uncertainty else None,
        cumulative=tuple(map(_cumulative, evidence.cumulative)),
        building_variations=tuple(_variation(*varied) for varied in evidence.building),
    )


def compared(assessment: Assessment) -> Compared:
    """Return the data that a later revision is compared with."""
    return Compared(
        roofslip_version=version(),
        records=tuple(map(_record, assessment.shaking.records)),
        documents=tuple(map(_document, assessment.source.documents)),
        input=assessment.project,
        rule_set=assessment.rules.name,
        verdict=assessment.verdict,
        checks=tuple(check_results(assessment)),
        arrays=tuple(_array(assessment, item) for item in assessment.arrays),
        clearances=tuple(map(_clearance, assessment.clearances)),
    )


def _record(file: RecordFile) -> RecordResult:
    return RecordResult(
        motion=file.motion_id, component=file.component, name=file.name, format=file.format,
        notes=file.notes, sha256=file.sha256, npts=file.npts, dt_s=file.dt_s, peak_g=file.peak_g,
    )  # fmt: skip


def _document(document: Document) -> DocumentResult:
    return DocumentResult(
        label=document.label, path=document.path, size=document.size, sha256=document.sha256
    )


def _motion(motion: Motion, prepared: PreparedMotion) -> MotionResult:
    samples = np.concatenate((motion.ax_mps2, motion.ay_mps2, motion.az_mps2))
    return MotionResult(
        id=motion.id, recorded_at=prepared.recorded_at, processing=prepared.done,
        scaling=prepared.scaling, scale=motion.scale, dt_s=motion.dt_s, npts=len(motion.ax_mps2),
        # Little-endian on every machine.
        sha256=hashlib.sha256(samples.astype("<f8").tobytes()).hexdigest(),
        components=prepared.measures,
        building={name: _roof(roof) for name, roof in prepared.roof.items()},
    )  # fmt: skip


def _printed(us_first: bool) -> PrintedResult:
    units = UnitFormat(us_first=us_first).units()
    return PrintedResult(
        lengths=tuple(
            LengthUnitResult(symbol=unit.symbol, size_m=unit.si, decimals=unit.decimals)
            for unit in units
        ),
        ratio_decimals=2,
        rounded_up=("prd_m", "mean_prd_m", "design_m", "required_m", "demand_capacity"),
        rounded_down=("provided_m",),
    )


def _roof(roof: RoofMotion) -> RoofResult:
    return RoofResult(
        words=roof.building.words, n_modes=roof.n_modes, next_mode_share=roof.next_share,
        left_out_share=roof.left_out_share, ground_peak_mps2=roof.ground_peak_mps2,
        roof_peak_mps2=roof.roof_peak_mps2, pad_s=roof.pad_s,
    )  # fmt: skip


def finding_results(
    findings: Iterable[Finding], addresses: Mapping[Place, str]
) -> Iterator[FindingResult]:
    """Yield warnings and notes on the input, each with its cell."""
    listed = tuple(findings)
    for finding, cell in zip(listed, located(listed, addresses), strict=True):
        yield FindingResult(
            level=finding.level, id=finding.id, cell=cell, text=finding.text, reason=finding.reason,
        )  # fmt: skip


def check_results(assessment: Assessment) -> Iterator[CheckResult]:
    """Yield the checks of a project, in their order."""
    us_first, addresses = assessment.project.us_first, assessment.source.addresses
    for check in assessment.checks:
        found_text, limit_text = texts(check, us_first)
        amounts = [x for x in (check.found, check.limit) if isinstance(x, Amount)]
        yield CheckResult(
            id=check.id, title=check.title, subject=check.subject, arrays=check.arrays,
            found=_value(check.found), limit=_value(check.limit),
            unit=amounts[0].quantity.base if amounts else "", found_text=found_text,
            limit_text=limit_text, note=check.note, clause=check.clause,
            is_satisfied=check.is_satisfied, consequence=check.consequence, verdict=check.verdict,
            ratio=check.ratio, actor=check.actor, remedy=check.to_close, otherwise=check.otherwise,
            cells=tuple(addresses[place] for place in check.places if place in addresses),
        )  # fmt: skip


def _value(amount: Amount | str) -> float:
    return amount.value if isinstance(amount, Amount) else math.nan


def _low_velocity(item: ArrayAssessment) -> LowVelocityResult:
    return LowVelocityResult(
        id=item.id, mu=item.array.mu, computed_m=item.analysis.value_m,
        computed_basis=item.analysis.basis, mean_prd_m=item.analysis.mean_m,
        largest_prd_m=item.analysis.largest_m, prd_variation=item.variation,
        prescriptive_m=item.prescriptive.value_m, prescriptive_governs=item.prescriptive.governs,
        floor_m=item.floor_m, design_m=item.design_m,
        design_is_overridden=bool(item.overridden.design), design_governs=item.governs,
        design_permitted=item.is_permitted,
    )  # fmt: skip


def _array(assessment: Assessment, item: ArrayAssessment) -> ArrayResult:
    tipping, uplift = item.tipping, item.uplift
    runs: list[RunResult] = []
    for motion in item.motions:
        runs += [_run(motion, run) for run in motion.runs]
    return ArrayResult(
        id=item.id, verdict=assessment.array_verdict(item), slope_rad=item.array.slope_rad,
        mu=item.array.mu, friction=item.array.friction,
        friction_as_run=mu_words(item.array.friction), computed_m=item.analysis.value_m,
        computed_basis=item.analysis.basis, mean_prd_m=item.analysis.mean_m,
        largest_prd_m=item.analysis.largest_m, prd_variation=item.variation,
        prescriptive_m=item.prescriptive.value_m, prescriptive_governs=item.prescriptive.governs,
        floor_m=item.floor_m, design_m=item.design_m,
        design_is_overridden=bool(item.overridden.design), design_governs=item.governs,
        design_permitted=item.is_permitted,
        peaks=tuple(map(_peak, item.motions)), peak_speed_mps=item.fastest_mps,
        interconnection_n=item.interconnection_n,
        tipping=TippingResult(
            demand=tipping.demand,
            capacity=tipping.capacity,
            held_ratio=tipping.at_rest_ratio,
            sliding_ratio=tipping.sliding_ratio,
            ok=tipping.is_ok,
        ),
        uplift=UpliftResult(
            n_min_g=uplift.n_min_g,
            t_first_s=uplift.t_first_s,
            duration_s=uplift.duration_s,
            times=uplift.times,
        ),
        analysis_factor=item.analysis.factor, takes_largest=item.analysis.basis.takes_largest,
        route=item.route,
        runs=tuple(runs),
    )  # fmt: skip


def _peak(motion: MotionRun) -> PeakResult:
    return PeakResult(
        motion=motion.motion.id, down_m=motion.peak_m(Direction.DOWN),
        up_m=motion.peak_m(Direction.UP), across_m=motion.peak_m(Direction.ACROSS),
        any_m=motion.peak_m(Direction.ANY),
    )  # fmt: skip


def _run(motion: MotionRun, run: OrientedRun) -> RunResult:
    result, solution = run.result, run.solution
    return RunResult(
        motion=motion.motion.id, along=run.orientation.component, polarity=run.orientation.polarity,
        scale=run.scene.scale, dt_s=run.scene.dt_s, status=result.status, prd_m=result.prd_m,
        residual_m=result.residual_m, down_m=result.down_m, up_m=result.up_m,
        across_m=result.across_m, residual_across_m=result.residual_across_m,
        t_prd_s=result.t_prd_s, n_stops=result.n_stops, n_min_g=result.n_min_g,
        t_uplift_s=result.t_uplift_s, end_speed_mps=result.end_speed_mps,
        peak_speed_mps=result.peak_speed_mps, error_m=result.error_m, rung=solution.model,
        model=solution.model.title, reason=solution.reason, next_rung=solution.next_model,
        next_effect_m=solution.next_effect_m, friction_demand=solution.friction_demand,
    )  # fmt: skip


def _clearance(gap: ClearanceCheck) -> ClearanceResult:
    return ClearanceResult(
        array=gap.clearance.array, object=gap.clearance.object, direction=gap.clearance.direction,
        neighbor=gap.neighbor, governing_array=gap.governing_array, design_m=gap.design_m,
        importance=gap.importance, factor=gap.factor, minimum_m=gap.minimum_m,
        required_m=gap.required_m, required_is_overridden=bool(gap.mark),
        provided_m=gap.provided_m, basis=gap.basis,
        demand_capacity=gap.demand_capacity, verdict=gap.verdict,
    )  # fmt: skip


def _linked(item: LinkedArray) -> LinkedResult:
    runs: list[LinkedRunResult] = []
    for motion in item.motions:
        runs += [_linked_run(item, motion, run) for run in motion.runs]
    return LinkedResult(
        array=item.design.id, mus=item.row.mus, stiffness_n_per_m=item.links.stiffness_n_per_m,
        damping_ratio=item.links.damping_ratio, rigid_one_axis_m=item.rigid.value_m,
        linked_one_axis_m=item.linked.value_m, ratio=item.ratio, design_m=item.design.design_m,
        estimated_m=item.estimated_m, link_force_n=item.link_force_n,
        rigid_is_enough=item.is_rigid_enough,
        runs=tuple(runs),
    )  # fmt: skip


def _linked_run(item: LinkedArray, motion: LinkedMotion, run: LinkedRun) -> LinkedRunResult:
    return LinkedRunResult(
        motion=motion.motion.id, along=run.orientation.component, polarity=run.orientation.polarity,
        status=run.row.status, rigid_status=run.rigid.status, rigid_prd_m=run.rigid.prd_m,
        prd_m=run.row.prd_m, residual_m=run.row.residual_m, stretch_m=run.row.stretch_m,
        link_force_n=run.row.link_force * item.block_n, error_m=run.row.error_m,
        n_stops=run.row.n_stops,
    )  # fmt: skip


def _neighbor(pair: PlanNeighbor) -> NeighborResult:
    return NeighborResult(
        array=pair.array, other=pair.other, kind=pair.kind, gap_m=pair.gap_m, reach_m=pair.reach_m,
        is_missing=pair.is_missing, add_to=pair.to_add,
        given=tuple(
            GivenResult(
                clearance=str(gap.number),
                cell=gap.cell,
                provided_m=gap.clearance.provided_m,
            )
            for gap in pair.given
        ),
        contradictions=tuple(gap.cell for gap in pair.contradictions), cover=pair.cover,
        what=pair.what,
    )  # fmt: skip


def _remedies(advice: Remedies) -> Iterator[RemedyResult]:
    """Yield the remedies of each check, then the changes that are enough together, if several."""
    remedies_of_checks = [((remedy,), remedy.done) for remedy in advice.own]
    # A change that is enough alone is among those of the checks already.
    together = (advice.together[len(advice.together) == 1 :], advice.done)
    for remedies, done in [*remedies_of_checks, together]:
        if remedies and done:
            checks = chain.from_iterable(remedy.checks for remedy in remedies)
            yield RemedyResult(
                quantities=tuple(remedy.kind for remedy in remedies),
                checks=tuple(f"{check.title}, {check.subject}" for check in checks),
                change=joined([remedy.words for remedy in remedies]), verdict=done.verdict,
                governing=came_to(done),
            )  # fmt: skip


def _uncertainty(item: Uncertainty) -> UncertaintyResult:
    return UncertaintyResult(
        margins=tuple(
            MarginResult(
                clearance=str(margin.number),
                array=margin.array.id,
                mu=margin.array.array.mu,
                least_mu=margin.minimum_mu,
                lowest_mu_tried=margin.lowest_tried,
                is_beyond=margin.is_beyond,
                required_m=margin.required_m,
            )
            for margin in item.margins
        ),
        angles=AnglesResult(
            motion=item.motion.motion.id,
            prd_m=item.used_m,
            turned=tuple(
                TurnedResult(
                    angle_deg=run.angle_deg, prd_m=run.result.prd_m, status=run.result.status
                )
                for run in item.turned
            ),
            vertical_reversed_prd_m=item.reversed_m,
        ),
    )


def _cumulative(item: Cumulative) -> CumulativeResult:
    return CumulativeResult(
        array=item.array.id, sums_m=item.sums_m, mean_m=item.mean_m, largest_m=item.largest_m
    )


def _variation(building: BuildingInput, value: AnalysisValue) -> VariationResult:
    return VariationResult(
        period_s=building.period_s or math.nan, damping_percent=building.damping_percent,
        mean_m=value.mean_m, largest_m=value.largest_m, value_m=value.value_m,
    )  # fmt: skip
