"""The sheet Design of results.xlsx: from the peaks to the design displacement and the verdicts.

Live formulas, each written with the value from `report.assessment.project`. Read `DesignRow`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Annotated, ClassVar

from report.assessment.arrays import ArrayAssessment, Route
from report.assessment.overrides import MEANING
from report.assessment.project import Assessment
from report.assessment.verdict import Verdict, worst
from report.entities.array import ArrayResult, array_result
from report.entities.cells import Column
from report.entities.shown import Number
from report.results.directions import PeakRanges
from report.results.inputs import InputCells
from report.results.sheets import TOP, Cells, Pages, SheetRow, write_live
from report.sheet.schema.choices import Direction
from solver.model import INCH_M
from solver.rules.provisions import Basis, PrescriptiveBasis

_LIVE_ROWS = ("electrical_slack", "interconnection")
"""Ids of the requirements that follow here by formula."""

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
        "id s_ds_g factor_m importance minimum_m prescriptive_m n_motions mean_prd_m largest_prd_m"
        " analysis_factor computed_m floor_share floor_m design_m over_prescriptive by_roofslip_m"
        " difference verdict statistic others slack_m weight_n interconnection_n given_n"
    )

    s_ds_g: Annotated[float, Column("S_DS [g]", 4, "={inputs[s_ds_g]}")]
    factor_m: Annotated[float, Column("Factor [in]", 1, is_input=True)]
    importance: Annotated[float, Column("I_e in displacement", 2, "={inputs[i_e]}")]
    minimum_m: Annotated[float, Column("Minimum [in]", 1, is_input=True)]
    n_motions: Annotated[int, Column("Number of motions", 0, "=COUNT({peaks})")]
    analysis_factor: Annotated[float, Column("Analysis factor", 2, _FACTOR)]
    floor_share: Annotated[float, Column("Floor / prescriptive", 2, _FLOOR_SHARE)]
    over_prescriptive: Annotated[Number, Column("Design / prescriptive", 3, _RATIO)]
    by_roofslip_m: Annotated[Number, Column("Design by Roofslip [in]", 2)]
    difference: Annotated[float, Column("Difference [in]", 4, _DIFFERENCE)] = 0.0
    statistic: Annotated[Basis, Column("Statistic", formula=_STATISTIC)]
    others: Annotated[Verdict, Column("Other requirements")]
    slack_m: Annotated[float | None, Column("Electrical slack [in]", 1, is_input=True)]


_FROM = {
    True: "From the sheets Peaks, any direction, and Inputs.",
    False: "From the sheet Inputs; no motions are given, and the displacement is prescriptive.",
}
"""What the sheet follows from, with motions and without."""


def write_design(
    pages: Pages,
    assessment: Assessment,
    peaks: PeakRanges,
    inputs: InputCells,
    results: Mapping[str, Sequence[str]],
) -> None:
    """Write the design displacement and the verdict of each array as formulas.

    Parameters
    ----------
    results : mapping of str to sequence of str
        For each array, the cells that hold OK, NG or none: its clearances and its row of linked
        blocks.
    """
    rows = []
    for item in assessment.arrays:
        refs = {"inputs": inputs, "peaks": peaks.get((item.id, Direction.ANY), "")}
        rows.append(_row(assessment, item, refs, results[item.id]))
    sheet = write_live(
        pages,
        DesignRow,
        rows,
        "Design displacement",
        f"{assessment.rules.name}. {_FROM[assessment.has_motions]} Other requirements, those that "
        "need other runs or the plan, are those of the report."
        + (f" {MEANING}." if assessment.is_overridden else ""),
    )
    sheet.write_string("B3", "Verdict", pages.head)
    sheet.merge_range("C3:D3", "", pages.head)
    sheet.write_string("E3", "Other", pages.head)
    sheet.write_string("F3", _beside_arrays(assessment).value, pages.text)
    cells = (Cells(DesignRow, TOP + at, is_here=True) for at in range(len(rows)))
    formula = _worst_of(["F3", *(row.verdict for row in cells)])
    sheet.write_formula("C3", formula, pages.head, assessment.verdict.value)


def _beside_arrays(assessment: Assessment) -> Verdict:
    """Return the verdict on what belongs to no array."""
    ids = {item.id for item in assessment.arrays}
    return worst(
        [
            *(Verdict.OK if check.ok else Verdict.NG for check in assessment.building_checks),
            *(row.verdict for row in assessment.rows if row.subject not in ids),
        ]
    )


def _worst_of(cells: Sequence[str]) -> str:
    """Return the formula of the verdict on the project, from cells with those on its parts."""
    met, missed = _quoted(Verdict.OK), _quoted(Verdict.CONDITIONS)
    return (
        f"=IF(OR({_any(cells, Verdict.NG)}),{_quoted(Verdict.NG)},"
        f"IF(OR({_any(cells, Verdict.CONDITION)}),{missed},{met}))"
    )


def _verdict(results: Sequence[str]) -> str:
    """Return the formula of the verdict on an array."""
    failed = [
        "ISTEXT({design_m})",
        "AND(ISNUMBER({slack_m}),{slack_m}<{design_m})",
        "AND(ISNUMBER({given_n}),{given_n}<{interconnection_n})",
        _any(["{others}", *results], Verdict.NG),
        *([_any(results, Verdict.NONE)] if results else []),
    ]
    open_ = ["ISTEXT({slack_m})", "ISTEXT({given_n})", _any(["{others}"], Verdict.CONDITION)]
    return (
        f"=IF(OR({','.join(failed)}),{_quoted(Verdict.NG)},"
        f"IF(OR({','.join(open_)}),{_quoted(Verdict.CONDITION)},{_quoted(Verdict.OK)}))"
    )


def _any(cells: Sequence[str], verdict: Verdict) -> str:
    return ",".join(f"{cell}={_quoted(verdict)}" for cell in cells)


def _quoted(verdict: Verdict) -> str:
    return f'"{verdict}"'


def _row(
    assessment: Assessment,
    item: ArrayAssessment,
    refs: Mapping[str, object],
    results: Sequence[str],
) -> DesignRow:
    rules, data, prescriptive = assessment.rules, assessment.project, item.prescriptive
    # The constant value for SDC A, B and C replaces the formula.
    is_flat = prescriptive.governs is PrescriptiveBasis.LOW_CATEGORY
    is_mean = item.analysis.basis is Basis.MEAN
    others = (row for row in assessment.rows_of(item.id) if row.id not in _LIVE_ROWS)
    formulas = {"verdict": _verdict(results)}
    if rules.importance_in_separation:
        formulas["importance"] = ""
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
            "computed_m": item.mark(lambda array: array.analysis.value_m),
            "floor_m": item.mark(lambda array: array.floor_m),
            "interconnection_n": item.mark(lambda array: array.interconnection_n),
            **dict.fromkeys(design, item.design_mark),
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
                Verdict.OK if assessment.is_sound(item) else Verdict.NG,
                *(row.verdict for row in others),
            ]
        ),
        slack_m=item.array.slack_m,
    )
