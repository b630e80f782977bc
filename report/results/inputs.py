"""The sheet Inputs of results.xlsx: the numbers that Design and Clearances follow by formula.

Read `report.results.xlsx`.
"""

from __future__ import annotations

from collections.abc import Mapping

from report.assessment.overrides import OVERRIDDEN
from report.assessment.project import Assessment
from report.results.sheets import Pages, typed, write_headings
from report.sheet.fields import YesNo
from report.sheet.schema import Statistic
from solver.rules.provisions import MEAN_WITHOUT_FACTOR_MOTIONS

InputCells = Mapping[str, str]
"""Cell of each input, by its key."""

_FIRST_ROW = 4


def write_inputs(pages: Pages, assessment: Assessment) -> InputCells:
    """Write what may be changed for the whole project; return the cells."""
    sheet = pages.sheet(
        "Inputs",
        "Inputs of the project",
        "Change a yellow cell here, or on the sheets Design and Clearances: the verdicts follow. "
        "Route, limits, motions and runs are those of the report.",
    )
    write_headings(pages, sheet, 3, ("Input", "Value", "Use"))
    sheet.set_column(0, 0, 34)
    sheet.set_column(1, 1, 16)
    sheet.set_column(2, 2, 70)
    changed = {row.provision for row in assessment.project.overrides}
    cells = {}
    for row, (key, label, value, use) in enumerate(_inputs(assessment), start=_FIRST_ROW):
        sheet.write_string(row, 0, label)
        if isinstance(value, str):
            sheet.write_string(row, 1, value, pages.typed_text)
        else:
            mark = OVERRIDDEN if _PROVISIONS.get(key) in changed else ""
            shown = pages.marked(pages.typed[_decimals(key)], mark)
            sheet.write_number(row, 1, typed(value), shown)
        sheet.write_string(row, 2, use)
        cells[key] = f"Inputs!$B${row + 1}"
        if key in _CHOICES:
            sheet.data_validation(
                row, 1, row, 1, {"validate": "list", "source": list(_CHOICES[key])}
            )
    return cells


_PROVISIONS: Mapping[str, str] = {
    "factor": "analysis_factor",
    "floor": "analysis_floor",
    "mean_motions": "analysis_mean_motions",
    "largest_motions": "analysis_min_motions",
    "interconnection_sds": "interconnection_sds",
    "interconnection_min": "interconnection_min",
}
"""The provision of each input that is one."""

_CHOICES: Mapping[str, tuple[str, ...]] = {
    "statistic": tuple(Statistic),
    "peer_reviewed": tuple(YesNo),
}


def _decimals(key: str) -> int:
    if key.endswith("motions"):
        return 0
    return 4 if key == "s_ds_g" else 3


def _inputs(assessment: Assessment) -> tuple[tuple[str, str, float | str, str], ...]:
    site, options, rules = assessment.project.site, assessment.project.options, assessment.rules
    in_separation = rules.importance_in_separation
    reviewed = YesNo.YES if options.peer_reviewed else YesNo.NO
    return (
        ("s_ds_g", "S_DS [g]", site.s_ds, "Prescriptive displacement, interconnection strength"),
        (
            "i_e",
            "Importance factor I_e",
            site.i_e,
            "Separations to edges" if in_separation else "Prescriptive displacement",
        ),
        (
            "statistic",
            "Design value statistic",
            options.statistic.value,
            "Rule set: 1.1 x mean or 1.1 x largest, by the number of motions",
        ),
        ("peer_reviewed", "Peer review", reviewed.value, "Yes removes the floor"),
        ("factor", "Analysis factor", rules["analysis_factor"], "On the mean or the largest peak"),
        ("floor", "Floor / prescriptive", rules["analysis_floor"], "Without peer review"),
        (
            "mean_motions",
            "Motions for a mean",
            rules["analysis_mean_motions"],
            "Minimum number of motions for 1.1 x mean",
        ),
        (
            "largest_motions",
            "Motions for the largest",
            rules["analysis_min_motions"],
            "Minimum number of motions for 1.1 x largest",
        ),
        (
            "plain_mean_motions",
            "Motions for a mean without factor",
            float(MEAN_WITHOUT_FACTOR_MOTIONS),
            "Minimum number of motions for the mean",
        ),
        (
            "interconnection_sds",
            "Interconnection / (S_DS W1)",
            rules["interconnection_sds"],
            "Strength required between the parts of an array",
        ),
        (
            "interconnection_min",
            "Interconnection / W1, minimum",
            rules["interconnection_min"],
            "Strength required between the parts of an array",
        ),
    )
