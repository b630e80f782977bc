"""The sheet Inputs of results.xlsx: the numbers that Design and Clearances follow by formula.

Read `report.results.xlsx`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum

from report.assessment.overrides import OVERRIDDEN
from report.assessment.project import Assessment
from report.results.sheets import TOP, Pages, typed
from report.sheet.schema.fields import YesNo
from solver.rules.provisions import MEAN_WITHOUT_FACTOR_MOTIONS

InputCells = Mapping[str, str]
"""Cell of each input, by its key."""


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
        "Route, limits, motions and runs are those of the report.",
        ("Input", "Value", "Use"),
        [(item.label, f"{item.value}", item.use) for item in inputs],
    )
    changed = {row.provision for row in assessment.project.overrides}
    cells = {}
    for row, item in enumerate(inputs, start=TOP):
        cell = f"B{row}"
        sheet.write_string(f"A{row}", item.label, pages.text)
        sheet.write_string(f"C{row}", item.use, pages.text)
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
