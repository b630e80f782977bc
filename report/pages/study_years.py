"""The years of a study that a package attaches: rates and long-term displacements of its arrays."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from report.assessment.design.arrays import ArrayAssessment
from report.document.columns import text, words
from report.document.tables import Table, listed
from report.pages.parts import PackageData
from report.project.read.years_file import Distance, YearsOfArray
from report.text.error_text import general
from report.text.names import named
from report.text.unit_format import UnitFormat
from report.text.units import number

_COMPARED = (
    "For comparison with the design displacement (supporting analysis, not a code value): PRD with "
    "a mean recurrence of 700 years, and distance from the installed location in"
)


def study_years(package: PackageData) -> Iterator[Mapping[str, object]]:
    """Yield the study of years with its file, and the arrays of both; nothing without one."""
    # Ids are the same in any case, as in the workbook.
    by_id = {array.id.casefold(): array for array in package.assessment.arrays}
    for document in package.assessment.source.documents:
        study = document.years
        if study is None:
            continue
        hazard = study.hazard
        shared = [
            (by_id[array_years.array.casefold()], array_years)
            for array_years in study.arrays
            if array_years.array.casefold() in by_id
        ]
        # The study may be of a former revision: its years are shown, and the arrays that differ
        # named.
        unlike = [array.id for array, array_years in shared if _is_unlike(array, array_years)]
        yield {
            "life": general(study.life_years),
            "caption": f"{_COMPARED} {general(study.life_years)} years",
            "note": study.note,
            "title": study.title,
            "date": study.date,
            "path": document.path,
            "sha256": document.sha256[:12],
            "site": hazard["site"],
            "source": hazard["source"],
            "edition": hazard["edition"],
            "vs30": f"{hazard['vs30_mps']:g}",
            "site_vs30": f"{hazard['site_vs30_mps']:g}",
            "arrays": _table(shared, package.fmt) if shared else None,
            "unlike": named(unlike, "Array") if unlike else "",
        }


def _table(shared: Sequence[tuple[ArrayAssessment, YearsOfArray]], fmt: UnitFormat) -> Table:
    """Return the arrays of both: design displacement, PRD of 700 years, and distance in a life."""

    def known(value_m: float | None) -> str:
        return "none" if value_m is None else fmt.both_up(value_m)

    def mean_m(distance: Distance) -> float | None:
        # A file of version 0.3 has a mean without the lives that have no distance.
        return None if distance.without_value else distance.mean_m

    columns = (
        (words("Array", 0.8), lambda row: row[0].id + _building(row[1])),
        (text("Design displacement", share=1.5), lambda row: fmt.both_up(row[0].design_m)),
        (text("PRD of 700 years", share=1.5), lambda row: known(row[1].prd_m["700"])),
        (text("Largest distance, mean", share=1.5),
         lambda row: known(mean_m(row[1].largest["never"]))),
        (text("95%", share=1.5), lambda row: known(row[1].largest["never"].p95_m)),
        (text("μ and slope of the study", share=1.4),
         lambda row: f"{number(row[1].mu, 3)}, {number(row[1].slope_deg, 2)}°"),
    )  # fmt: skip
    return listed(shared, columns, kind="compact")


def _building(array_years: YearsOfArray) -> str:
    return "" if array_years.building == "roof" else f", {array_years.building}"


def _is_unlike(array: ArrayAssessment, array_years: YearsOfArray) -> bool:
    """Whether an array has another friction coefficient or slope in the study."""
    # As printed, with three decimals and two.
    slope_deg = math.degrees(array.array.slope_rad)
    return (
        abs(array.array.mu - array_years.mu) >= 5e-4
        or abs(slope_deg - array_years.slope_deg) >= 5e-3
    )
