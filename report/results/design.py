"""The sheet Design of results.xlsx: from the peaks to the design displacement and the verdicts.

Live formulas, each written with the value from `report.assessment.project`: with the sheets Peaks,
and Inputs that Design follows from. Read `DesignRow`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Annotated, ClassVar

from report.assessment.arrays import ArrayAssessment
from report.assessment.project import Assessment
from report.assessment.routes import Route
from report.assessment.verdict import MEANING, OVERRIDDEN, Verdict, worst
from report.entities.array import ArrayResult, array_result
from report.entities.motion import PeakResult, peak_result
from report.entities.shown import Column, Number, up_column
from report.project.model.fields import YesNo
from report.results.lists import RunRow
from report.results.sheets import TOP, Cells, Pages, SheetRow, typed, write_live
from solver.model import INCH_M
from solver.rules.provisions import MEAN_WITHOUT_FACTOR_MOTIONS, Basis, PrescriptiveBasis

# Cells of the PRDs of an array, one for each motion.
PeakRanges = Mapping[str, str]


class PeakRow(SheetRow, PeakResult):
    """The peaks of an array under a motion."""

    sheet: ClassVar[str] = "Peaks"
    across: ClassVar[str] = "array"
    last_printed: ClassVar[str] = "any_m"

    array: Annotated[str, Column("Array")]


def write_peaks(pages: Pages, assessment: Assessment) -> PeakRanges:
    """Write the largest excursion of all runs of each motion, by direction; return the PRDs."""
    rows: list[PeakRow] = []
    ranges: dict[str, str] = {}
    # Below the one row of headings of the sheet Runs, in the order in which it lists them.
    first_run = 2
    for item in assessment.arrays:
        first = TOP + len(rows)
        for motion in item.motions:
            runs = Cells(RunRow, first_run, first_run + len(motion.runs) - 1)
            first_run += len(motion.runs)
            rows.append(PeakRow.beside(peak_result(motion), array=item.id, refs={"runs": runs}))
        ranges[item.id] = Cells(PeakRow, first, TOP + len(rows) - 1).any_m
    note = "Largest of all runs of each motion, by direction, from the sheet Runs."
    write_live(pages, PeakRow, rows, "Peaks", note)
    return ranges


# Cell of each input, by its key.
InputCells = Mapping[str, str]


@dataclass(frozen=True, slots=True)
class _Input:
    """A number with its digits, or one of several words; of the rule set, under its key there."""

    key: str
    label: str
    value: float | StrEnum
    use: str
    decimals: int = 3


def write_inputs(pages: Pages, assessment: Assessment) -> InputCells:
    """Write what may be changed for the whole project; return the cells."""
    inputs = list(_inputs(assessment))
    sheet = pages.sheet(
        "Inputs",
        "Inputs of the project",
        "Change a yellow cell here, or on the sheets Design and Clearances: the verdicts follow. "
        "Procedure, limits, motions and runs are those of the report.",
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
            shown = pages.number(item.decimals, mark, is_input=True)
            sheet.write_number(cell, typed(item.value), shown)
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
    use = "Rule set: 1.1 x mean or 1.1 x largest, by the number of motions"
    yield _Input("statistic", "Design value statistic", asked, use)
    yield _Input("peer_reviewed", "Peer review", reviewed, "Yes removes the floor")
    yield provision("analysis_factor", "Analysis factor", "On the mean or the largest peak")
    yield provision("analysis_floor", "Floor / prescriptive", "Without peer review")
    use = "Minimum number of motions for 1.1 x mean"
    yield provision("analysis_mean_motions", "Motions for a mean", use, 0)
    use = "Minimum number of motions for 1.1 x largest"
    yield provision("analysis_min_motions", "Motions for the largest", use, 0)
    yield _Input(
        "plain_mean_motions",
        "Motions for a mean without factor",
        float(MEAN_WITHOUT_FACTOR_MOTIONS),
        "Minimum number of motions for the mean",
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
    f'=IF({{inputs[statistic]}}="rule set",IF({_HAS_MEAN},{_MEAN},{_OR_LARGEST}),'
    f"IF({{inputs[statistic]}}={_MEAN},IF({_HAS_MEAN},{_MEAN},{_FEW}),"
    f"IF({{inputs[statistic]}}={_LARGEST},{_OR_LARGEST},{_OR_PLAIN})))"
)
_FACTOR = f"=IF({{statistic}}={_PLAIN},1,{{inputs[analysis_factor]}})"
_FLOOR_SHARE = '=IF({inputs[peer_reviewed]}="Yes",0,{inputs[analysis_floor]})'
_RATIO = '=IF(ISTEXT({design_m}),"none",{design_m}/{prescriptive_m})'
_DIFFERENCE = '=IF(ISTEXT({design_m}),"none",{design_m}-{by_roofslip_m})'


class DesignRow(SheetRow, ArrayResult):
    """The design displacement and the verdict of an array."""

    sheet: ClassVar[str] = "Design"
    across: ClassVar[str] = (
        "id prescriptive_m mean_prd_m largest_prd_m statistic analysis_factor computed_m"
        " floor_share floor_m design_m over_prescriptive slack_m weight_n interconnection_n given_n"
        " others verdict s_ds_g factor_m importance minimum_m n_motions by_roofslip_m difference"
    )
    last_printed: ClassVar[str] = "verdict"

    s_ds_g: Annotated[float, Column("S_DS [g]", 4, "={inputs[s_ds_g]}")]
    factor_m: Annotated[float, Column("Factor [in]", is_input=True)]
    importance: Annotated[float, Column("I_e in displacement", 2, "={inputs[i_e]}")]
    minimum_m: Annotated[float, Column("Minimum [in]", is_input=True)]
    n_motions: Annotated[int, Column("Number of motions", 0, "=COUNT({peaks})")]
    analysis_factor: Annotated[float, Column("Analysis factor", 2, _FACTOR)]
    floor_share: Annotated[float, Column("Floor / prescriptive", 2, _FLOOR_SHARE)]
    over_prescriptive: Annotated[Number, Column("Design / prescriptive", 3, _RATIO)]
    by_roofslip_m: Annotated[Number, up_column("Design by Roofslip [in]", 1)]
    difference: Annotated[float, Column("Difference [in]", 4, _DIFFERENCE)] = 0.0
    statistic: Annotated[Basis, Column("Statistic", formula=_STATISTIC)]
    others: Annotated[Verdict, Column("Other requirements")]
    slack_m: Annotated[float | None, Column("Electrical slack [in]", is_input=True)]


# What the sheet follows from, with motions and without.
_FROM = {
    True: "From the sheets Peaks, any direction, and Inputs.",
    False: "From the sheet Inputs; no motions are given, and the displacement is prescriptive.",
}


def write_design(
    pages: Pages,
    assessment: Assessment,
    peaks: PeakRanges,
    inputs: InputCells,
    results: Mapping[str, Sequence[str]],
) -> Sequence[DesignRow]:
    """Write the design displacement and the verdict of each array as formulas; return the rows.

    From `results`, the cells with OK, NG or none of its clearances and its row of linked blocks.
    """
    rows = []
    for item in assessment.arrays:
        refs = {"inputs": inputs, "peaks": peaks.get(item.id, "")}
        rows.append(_row(assessment, item, refs, results[item.id]))
    write_live(
        pages,
        DesignRow,
        rows,
        "Design displacement",
        f"{assessment.rules.name}. {_FROM[assessment.has_motions]} Other requirements, those that "
        "need other runs or the plan, are those of the report. Columns right of the verdict do "
        "not print." + (f" {MEANING}." if assessment.is_overridden else ""),
    )
    return rows


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
) -> DesignRow:
    rules, data, prescriptive = assessment.rules, assessment.project, item.prescriptive
    # The constant value for SDC A, B and C replaces the formula.
    # PV1-2012, SDC A, B and C: 6 in, whatever S_DS is.
    is_flat = prescriptive.governs is PrescriptiveBasis.LOW_CATEGORY
    is_mean = item.analysis.basis is Basis.MEAN
    # Those that live formulas decide would count twice, and keep an old verdict.
    others = (c for c in assessment.checks if item.id in c.arrays and c.id not in _LIVE)
    formulas = {"verdict": _verdict(results)}
    # There the factor is 1, and an input cell would seem to change something.
    if rules.importance_in_separation:
        formulas["importance"] = ""
    # COUNT and AVERAGE of no cells are 0 and an error.
    if not assessment.has_motions:
        formulas |= dict.fromkeys(("n_motions", "mean_prd_m", "largest_prd_m"), "")
        formulas |= {"computed_m": '="none"', "design_m": "={prescriptive_m}"}
    elif math.isnan(item.analysis.mean_m):
        formulas |= dict.fromkeys(("computed_m", "design_m"), '="none"')
    elif item.route is Route.PRESCRIPTIVE:
        formulas["design_m"] = "=MAX({prescriptive_m},{largest_prd_m})"
    design = ("design_m", "over_prescriptive", "by_roofslip_m")
    return DesignRow.beside(
        array_result(assessment, item),
        refs=refs,
        formulas=formulas,
        blanks={"difference"} if math.isnan(item.design_m) else (),
        marks={
            "prescriptive_m": item.prescriptive_mark(),
            "computed_m": item.overridden.analysis,
            "floor_m": item.overridden.floor,
            "interconnection_n": item.overridden.interconnection,
            **dict.fromkeys(design, item.overridden.design),
        },
        s_ds_g=data.site.s_ds,
        factor_m=0.0 if is_flat else rules["prescriptive_factor_in"] * INCH_M,
        importance=1.0 if rules.importance_in_separation else data.site.i_e,
        minimum_m=prescriptive.minimum_m,
        n_motions=item.analysis.n_motions,
        # That of the rule set also where there are too few motions.
        analysis_factor=1.0 if is_mean else rules["analysis_factor"],
        floor_share=0.0 if data.is_peer_reviewed else rules["analysis_floor"],
        over_prescriptive=item.ratio,
        by_roofslip_m=item.design_m,
        statistic=item.analysis.basis,
        others=worst(
            [
                Verdict.OK if item.is_permitted else Verdict.NG,
                *(check.verdict for check in others),
            ]
        ),
        slack_m=item.array.slack_m,
    )
