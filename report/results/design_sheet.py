"""The Design worksheet of results.xlsx: from the peaks to the design displacement and verdicts.

Live formulas, each written with the value from `report.assessment`; also the Peaks and Inputs
worksheets that Design is computed from. Read `DESIGN`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum

from report.assessment.assessment import Assessment
from report.assessment.causes import unshown_cause
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.routes import Route
from report.assessment.design.rule_set import MEANING, OVERRIDDEN
from report.assessment.design.verdict import Verdict, worst
from report.project.model.choices import Direction, Statistic, YesNo
from report.results.list_sheets import RUNS
from report.results.sheet_columns import (
    Cells,
    SheetColumn,
    SheetLayout,
    SheetRow,
    typed,
    up_column,
    write_live,
)
from report.results.sheet_pages import TOP, Pages
from report.runs import MotionRun
from solver.model import INCH_M
from solver.rules.provisions import MEAN_WITHOUT_FACTOR_MOTIONS, Basis, PrescriptiveBasis

# Cells of the PRDs of an array, one for each motion.
PeakRanges = Mapping[str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Peak:
    array: ArrayAssessment
    motion: MotionRun


PEAKS = SheetLayout(
    "Peaks",
    (
        SheetColumn("array", "Array", lambda row: row.array.id),
        SheetColumn("motion", "Motion", lambda row: row.motion.motion.id),
        up_column("down_m", "Downslope [in]", lambda row: row.motion.peak_m(Direction.DOWN), 1,
            "=MAX({runs.down_m})"),
        up_column("up_m", "Upslope [in]", lambda row: row.motion.peak_m(Direction.UP), 1,
            "=MAX({runs.up_m})"),
        up_column("across_m", "Cross-slope [in]", lambda row: row.motion.peak_m(Direction.ACROSS),
            1, "=MAX({runs.across_m})"),
        up_column("any_m", "Any direction [in]", lambda row: row.motion.peak_m(Direction.ANY), 1,
            "=MAX({runs.prd_m})"),
    ),
    last_printed="any_m",
)  # fmt: skip


def write_peaks(pages: Pages, assessment: Assessment) -> PeakRanges:
    """Write the largest excursion of all runs of each motion, by direction; return the PRDs."""
    rows: list[SheetRow] = []
    ranges: dict[str, str] = {}
    # Below the one row of headings of the Runs worksheet, in the order in which it lists them.
    first_run = 2
    for item in assessment.arrays:
        first = TOP + len(rows)
        for motion in item.motions:
            runs = Cells(RUNS, first_run, first_run + len(motion.runs) - 1)
            first_run += len(motion.runs)
            rows.append(SheetRow(item=_Peak(array=item, motion=motion), refs={"runs": runs}))
        ranges[item.id] = Cells(PEAKS, first, TOP + len(rows) - 1).any_m
    note = "Largest of all runs of each motion, by direction, from the Runs worksheet."
    write_live(pages, PEAKS, rows, "Peaks", note)
    return ranges


# Cell of each input, by its key.
InputCells = Mapping[str, str]


@dataclass(frozen=True, slots=True)
class _Input:
    """A number with its digits, or a choice; values of the rule set are stored under their key."""

    key: str
    label: str
    value: float | StrEnum
    use: str
    decimals: int = 3


def write_inputs(pages: Pages, assessment: Assessment) -> InputCells:
    """Write the inputs that may be changed for the whole project; return the cells."""
    inputs = list(_inputs(assessment))
    sheet = pages.sheet(
        "Inputs",
        "Inputs of the project",
        "Change a yellow cell here or on the Design and Clearances worksheets; verdicts update. "
        "Procedure, limits, motions and runs are not recalculated.",
        ("Input", "Value", "Use"),
        [(item.label, f"{item.value}", item.use) for item in inputs],
    )
    changed = {row.provision for row in assessment.project.overrides}
    cells = {}
    for row, item in enumerate(inputs, start=TOP):
        cell = f"B{row}"
        sheet.write_string(f"A{row}", item.label, pages.text)
        sheet.write_string(f"C{row}", item.use, pages.text)
        # A list, for a formula compares the word: a misspelled one would pass for another choice.
        if isinstance(item.value, StrEnum):
            sheet.write_string(cell, item.value, pages.typed_text)
            choices = [choice.value for choice in type(item.value)]
            sheet.data_validation(cell, {"validate": "list", "source": choices})
        else:
            mark = OVERRIDDEN if item.key in changed else ""
            look = pages.number(item.decimals, mark, is_input=True)
            sheet.write_number(cell, typed(item.value), look)
        cells[item.key] = f"Inputs!$B${row}"
    return cells


def _inputs(assessment: Assessment) -> Iterator[_Input]:
    site, options, rules = assessment.project.site, assessment.project.options, assessment.rules

    def provision(key: str, label: str, use: str, decimals: int = 3) -> _Input:
        return _Input(key, label, rules[key], use, decimals)

    strength = "Strength required between the parts of an array"
    in_separation = rules.importance_in_separation
    of_i_e = "Separations to edges" if in_separation else "Prescriptive displacement"
    reviewed = YesNo.YES if assessment.project.is_peer_reviewed else YesNo.NO
    asked = options.statistic
    use = "Prescriptive displacement, interconnection strength"
    yield _Input("s_ds_g", "S_DS [g]", site.s_ds, use, decimals=4)
    yield _Input("i_e", "Importance factor I_e", site.i_e, of_i_e)
    use = "Per rule set: 1.1 x mean or 1.1 x largest, depending on the number of motions"
    yield _Input("statistic", "Design value statistic", asked, use)
    yield _Input("peer_reviewed", "Peer review", reviewed, "With Yes, the floor does not apply")
    yield provision("analysis_factor", "Analysis factor", "Applied to the mean or the largest PRD")
    yield provision("analysis_floor", "Floor / prescriptive", "Applies without peer review")
    use = "Number of motions required for 1.1 x mean"
    yield provision("analysis_mean_motions", "Minimum motions, mean", use, 0)
    use = "Number of motions required for 1.1 x largest"
    yield provision("analysis_min_motions", "Minimum motions, largest", use, 0)
    yield _Input(
        "plain_mean_motions",
        "Minimum motions, mean without factor",
        float(MEAN_WITHOUT_FACTOR_MOTIONS),
        "Number of motions required for the mean",
        decimals=0,
    )
    yield provision("interconnection_sds", "Interconnection / (S_DS W1)", strength)
    yield provision("interconnection_min", "Interconnection / W1, minimum", strength)


# Ids of the checks that follow here by formula.
_LIVE = ("clearance", "design", "electrical_slack", "interconnection", "links")

_MEAN, _LARGEST, _PLAIN, _FEW = (
    f'"{basis.value}"'
    for basis in (Basis.MEAN_FACTORED, Basis.LARGEST_FACTORED, Basis.MEAN, Basis.TOO_FEW)
)
_HAS_MEAN = "{n_motions}>={inputs[analysis_mean_motions]}"
_OR_LARGEST = f"IF({{n_motions}}>={{inputs[analysis_min_motions]}},{_LARGEST},{_FEW})"
_OR_PLAIN = f"IF({{n_motions}}>={{inputs[plain_mean_motions]}},{_PLAIN},{_FEW})"
_STATISTIC = (
    f'=IF({{inputs[statistic]}}="{Statistic.RULE_SET}",IF({_HAS_MEAN},{_MEAN},{_OR_LARGEST}),'
    f"IF({{inputs[statistic]}}={_MEAN},IF({_HAS_MEAN},{_MEAN},{_FEW}),"
    f"IF({{inputs[statistic]}}={_LARGEST},{_OR_LARGEST},{_OR_PLAIN})))"
)  # fmt: skip
_FACTOR = f"=IF({{statistic}}={_PLAIN},1,{{inputs[analysis_factor]}})"
_FLOOR_SHARE = '=IF({inputs[peer_reviewed]}="Yes",0,{inputs[analysis_floor]})'
_COMPUTED = (
    f'=IF({{statistic}}="{Basis.TOO_FEW.value}","none",{{analysis_factor}}'
    f'*IF({{statistic}}="{Basis.LARGEST_FACTORED.value}",{{largest_prd_m}},{{mean_prd_m}}))'
)  # fmt: skip
# PV1-2012: 60 in (S_DS - 0.4)^2, at least 6 in; ASCE 7-16 13.6.12: 5 ft I_e (S_DS - 0.4)^2, 24 in.
_PRESCRIPTIVE = "=MAX({factor_m}*{importance}*MAX({s_ds_g}-0.4,0)^2,{minimum_m})"
# In Excel MAX takes no text: without the question, no value would become the floor.
_DESIGN = '=IF(ISTEXT({computed_m}),"none",MAX({computed_m},{floor_m}))'
# PV1-2012 section 6: the larger of 0.133 S_DS W1 and 0.1 W1, with W1 half of the weight.
_STRENGTH = (
    "=MAX({inputs[interconnection_sds]}*{s_ds_g},{inputs[interconnection_min]})*{weight_n}/2"
)  # fmt: skip
_RATIO = '=IF(ISTEXT({design_m}),"none",{design_m}/{prescriptive_m})'
# By the number beside it, which no formula changes: 0 until a yellow cell is changed.
_DIFFERENCE = '=IF(ISTEXT({design_m}),"none",{design_m}-{by_roofslip_m})'


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignRow:
    """An array with the rule-set values of its formulas, and its verdicts."""

    item: ArrayAssessment
    verdict: Verdict
    cause: str  # of a verdict that no number of the Summary worksheet shows
    others: Verdict  # the worst of what the formulas do not follow
    s_ds_g: float
    factor_m: float
    importance: float
    analysis_factor: float
    floor_share: float


DESIGN = SheetLayout(
    "Design",
    (
        SheetColumn("id", "Array", lambda row: row.item.id),
        up_column("prescriptive_m", "Prescriptive [in]", lambda row: row.item.prescriptive.value_m,
            1, _PRESCRIPTIVE),
        up_column("mean_prd_m", "Mean PRD [in]", lambda row: row.item.analysis.mean_m, 1,
            "=AVERAGE({peaks})"),
        up_column("largest_prd_m", "Largest PRD [in]", lambda row: row.item.analysis.largest_m, 1,
            "=MAX({peaks})"),
        SheetColumn("statistic", "Statistic", lambda row: row.item.analysis.basis,
            formula=_STATISTIC),
        SheetColumn("analysis_factor", "Analysis factor", lambda row: row.analysis_factor, 2,
            _FACTOR),
        up_column("computed_m", "Analysis [in]", lambda row: row.item.analysis.value_m, 1,
            _COMPUTED, is_always=True),
        SheetColumn("floor_share", "Floor / prescriptive", lambda row: row.floor_share, 2,
            _FLOOR_SHARE),
        up_column("floor_m", "Floor [in]", lambda row: row.item.floor_m, 1,
            "={floor_share}*{prescriptive_m}"),
        up_column("design_m", "Design [in]", lambda row: row.item.design_m, 1, _DESIGN,
            is_always=True),
        up_column("design_m", "Design [mm]", lambda row: row.item.design_m, 0),
        SheetColumn("over_prescriptive", "Design / prescriptive", lambda row: row.item.ratio, 3,
            _RATIO),
        SheetColumn("slack_m", "Electrical slack [in]", lambda row: row.item.array.slack_m,
            is_input=True),
        SheetColumn("weight_n", "Weight [lb]", lambda row: row.item.array.weight_n, is_input=True),
        up_column("interconnection_n", "Interconnection required [lb]",
            lambda row: row.item.interconnection_n, 0, _STRENGTH),
        SheetColumn("given_n", "Interconnection provided [lb]",
            lambda row: row.item.array.interconnection_n, is_input=True),
        SheetColumn("others", "Other requirements", lambda row: row.others),
        SheetColumn("verdict", "Verdict", lambda row: row.verdict),
        SheetColumn("s_ds_g", "S_DS [g]", lambda row: row.s_ds_g, 4, "={inputs[s_ds_g]}"),
        SheetColumn("factor_m", "Factor [in]", lambda row: row.factor_m, is_input=True),
        SheetColumn("importance", "I_e in displacement", lambda row: row.importance, 2,
            "={inputs[i_e]}"),
        SheetColumn("minimum_m", "Minimum [in]", lambda row: row.item.prescriptive.minimum_m,
            is_input=True),
        SheetColumn("n_motions", "Number of motions", lambda row: row.item.analysis.n_motions, 0,
            "=COUNT({peaks})"),
        up_column("by_roofslip_m", "Design, as reported [in]", lambda row: row.item.design_m, 1),
        SheetColumn("difference", "Difference [in]", lambda _: 0.0, 4, _DIFFERENCE),
    ),
    last_printed="verdict",
)  # fmt: skip


# What the sheet follows from, with motions and without.
_FROM = {
    True: "Calculated from the Peaks (any direction) and Inputs worksheets.",
    False: "Calculated from the Inputs worksheet. No motions are entered; the displacement is "
    "prescriptive.",
}


def write_design(
    pages: Pages,
    assessment: Assessment,
    peaks: PeakRanges,
    inputs: InputCells,
    results: Mapping[str, Sequence[str]],
) -> Sequence[DesignRow]:
    """Write the design displacement and the verdict of each array; return its rows.

    From `results`, the cells with OK, NG or none of its clearances and its row of linked blocks.
    """
    rows = []
    for item in assessment.arrays:
        refs = {"inputs": inputs, "peaks": peaks.get(item.id, "")}
        rows.append(_row(assessment, item, refs, results[item.id]))
    write_live(
        pages,
        DESIGN,
        rows,
        "Design displacement",
        f"{assessment.rules.name}. {_FROM[assessment.has_motions]} Other requirements need other "
        "runs or the plan and are not recalculated. Columns to the right of the verdict do not "
        "print." + (f" {MEANING}." if assessment.is_overridden else ""),
    )
    return [row.item for row in rows]


def _verdict(results: Sequence[str]) -> str:
    """Return the formula of the verdict on an array."""
    # A missing value is a text here, and in Excel a text is larger than any number: ask first.
    failed = [
        "ISTEXT({design_m})",
        "AND(ISNUMBER({slack_m}),{slack_m}<{design_m})",
        "AND(ISNUMBER({given_n}),{given_n}<{interconnection_n})",
        any_of(["{others}", *results], Verdict.NG),
        *([any_of(results, Verdict.NONE)] if results else []),
    ]
    open_ = ["ISTEXT({slack_m})", "ISTEXT({given_n})", any_of(["{others}"], Verdict.CONDITION)]
    return (
        f'=IF(OR({",".join(failed)}),"{Verdict.NG}",'
        f'IF(OR({",".join(open_)}),"{Verdict.CONDITION}","{Verdict.OK}"))'
    )


def any_of(cells: Sequence[str], verdict: Verdict) -> str:
    """Return the arguments of a formula that ask whether any cell has a verdict."""
    return ",".join(f'{cell}="{verdict}"' for cell in cells)


def _row(
    assessment: Assessment,
    item: ArrayAssessment,
    refs: Mapping[str, object],
    results: Sequence[str],
) -> SheetRow:
    rules, data = assessment.rules, assessment.project
    # The constant value for SDC A, B and C replaces the formula.
    # PV1-2012, SDC A, B and C: 6 in, whatever S_DS is.
    is_flat = item.prescriptive.governs is PrescriptiveBasis.LOW_CATEGORY
    is_mean = item.analysis.basis is Basis.MEAN
    # Those that live formulas decide would count twice, and keep an old verdict.
    further = (c for c in assessment.checks if item.id in c.arrays and c.id not in _LIVE)
    formulas = {"verdict": _verdict(results)}
    # There the factor is 1, and an input cell would seem to change something.
    if rules.importance_in_separation:
        formulas["importance"] = ""
    # COUNT and AVERAGE of no cells are 0 and an error.
    if not assessment.has_motions:
        formulas |= dict.fromkeys(("n_motions", "mean_prd_m", "largest_prd_m"), "")
        formulas |= {"computed_m": '="none"', "design_m": "={prescriptive_m}"}
    # AVERAGE and MAX pass over the text of a run without a value: the others would seem to be all.
    elif math.isnan(item.analysis.mean_m):
        formulas |= dict.fromkeys(("computed_m", "design_m"), '="none"')
    # As `report.assessment.design.arrays`: runs that slide farther than the prescriptive value
    # count.
    elif item.route is Route.PRESCRIPTIVE:
        formulas["design_m"] = "=MAX({prescriptive_m},{largest_prd_m})"
    design = ("design_m", "over_prescriptive", "by_roofslip_m")
    row = DesignRow(
        item=item,
        verdict=assessment.array_verdict(item),
        cause=unshown_cause(assessment, item),
        others=worst(
            [
                Verdict.OK if item.is_permitted else Verdict.NG,
                *(check.verdict for check in further),
            ]
        ),
        s_ds_g=data.site.s_ds,
        factor_m=0.0 if is_flat else rules["prescriptive_factor_in"] * INCH_M,
        importance=1.0 if rules.importance_in_separation else data.site.i_e,
        # That of the rule set also where there are too few motions.
        analysis_factor=1.0 if is_mean else rules["analysis_factor"],
        floor_share=0.0 if data.is_peer_reviewed else rules["analysis_floor"],
    )
    return SheetRow(
        item=row,
        refs=refs,
        formulas=formulas,
        blanks={"difference"} if math.isnan(item.design_m) else (),
        marks={
            "prescriptive_m": item.overridden.prescriptive,
            "computed_m": item.overridden.analysis,
            "floor_m": item.overridden.floor,
            "interconnection_n": item.overridden.interconnection,
            **dict.fromkeys(design, item.overridden.design),
        },
    )
