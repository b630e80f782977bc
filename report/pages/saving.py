"""Possible savings by an analysis if an array uses the prescriptive displacement, as text.

    With an analysis, the design displacement of all arrays could be as low as 40.8 in (1036 mm)
    instead of 81.6 in (2072 mm): without peer review, the floor is 50% of the prescriptive
    displacement (PV1-2012).

`report.assessment.support` computes it. Read `saving_words`.
"""

from __future__ import annotations

from report.assessment.assessment import Assessment
from report.assessment.support.analysis_saving import Saving, saving
from report.pages.marks import Marks
from report.pages.parts import all_or
from report.text.counts import counted, spelled
from report.text.names import named
from report.text.unit_format import UnitFormat
from report.text.units import number


def without_analysis(assessment: Assessment) -> str:
    """Return the displacement used without motions, and possible savings; or nothing."""
    gain = saving(assessment)
    if assessment.has_motions and not gain.ids:
        return ""
    why = "no motions are listed"
    if gain.lacks:
        why = f"the motions do not permit an analysis ({'; '.join(gain.lacks)})"
    fmt = UnitFormat(us_first=assessment.project.us_first)
    saves = saving_words(gain, Marks(assessment, has_daggers=False), fmt)
    prescriptive_text = fmt.both_up(gain.prescriptive_m)
    return f"{why}, so the package uses the prescriptive displacement, {prescriptive_text}. {saves}"


def saving_words(gain: Saving, marks: Marks, fmt: UnitFormat) -> str:
    """Return the possible savings by an analysis, for a project whose motions do not permit one."""
    slope_clause = marks.clause("analysis_max_slope_deg")
    alone = " without peer review" if gain.is_lifted_by_review else ""
    if not gain.ids:
        return (
            f"An analysis is not permitted{alone}, because the roof slope under all arrays exceeds "
            f"its limit ({slope_clause})."
        )
    floor, clause = fmt.both_up(gain.floor_m), marks.clause("analysis_floor")
    percent = number(100.0 * marks.assessment.rules["analysis_floor"], 0)
    share = f"{percent}%{marks.of('analysis_floor')} of the prescriptive displacement ({clause})"
    if gain.floor_m < gain.prescriptive_m:
        sentences = [
            f"With an analysis, the design displacement of "
            f"{all_or(gain.ids, len(marks.assessment.arrays))} could be as low as {floor} instead "
            f"of {fmt.both_up(gain.prescriptive_m)}: without peer review, the floor is {share}"
        ]
    else:
        sentences = [f"Without peer review, an analysis would not reduce it: the floor is {share}"]
    if gain.n_short:
        sentences.append(_at_floor(gain, floor))
    if gain.others:
        sentences.append(
            f"The roof slope exceeds the limit for an analysis{alone} ({slope_clause}) under "
            f"{named(gain.others, 'array')}"
        )
    return ". ".join(sentences) + "."


def _at_floor(gain: Saving, floor: str) -> str:
    """Return the number of failing clearances that would be satisfied at the floor."""
    if gain.n_short == 1:
        still = "" if gain.n_satisfied else "still not "
        return f"At {floor}, the failing clearance would {still}be satisfied"
    if gain.n_satisfied == gain.n_short:
        count = "all"
    else:
        none = "neither" if gain.n_short == 2 else "none"
        count = f"{spelled(gain.n_satisfied) if gain.n_satisfied else none} of the"
    failing = counted(gain.n_short, "failing clearance")
    return f"At {floor}, {count} {failing} would be satisfied"
