"""Limits, requirements and interconnection strength, and what of them the summary says."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from markupsafe import Markup

from report.assessment.arrays import ArrayAssessment, Route
from report.assessment.foresight import findings
from report.assessment.verdict import Row
from report.document.tables import Table, TableRow, stamp
from report.entities.columns import TableColumn
from report.entities.marks import dagger
from report.pages.links import link_troubles
from report.pages.model import model_troubles, tipping_troubles
from report.pages.parts import NG, OK, PackageData, check_value, verdict
from report.pages.symbols import with_symbols
from report.sheet.findings import Level, lines
from report.typeset.equations import symbol
from report.words.units import Quantity, compared, ratio, rounded_apart
from solver.records.acceptance_row import Consequence
from solver.rules.provisions import Basis, Check

EXCEPTED = "permitted*"
"""Verdict on a value beyond a limit that the rule set permits to be exceeded."""


def failed_limits(package: PackageData) -> Sequence[str]:
    """Return the limits that are not satisfied, in words."""
    return [
        f"{place}: {check.title} is {check_value(check, check.value, package.fmt)}, limit "
        f"{check_value(check, check.limit, package.fmt)} "
        f"({check.provision.clause}{dagger(check.provision)})."
        for place, check in package.checks
        if not check.ok
    ]


def analysis_faults(package: PackageData, array: ArrayAssessment) -> Sequence[str]:
    """Return why the analysis route of an array is not permitted, in a few words each."""
    few = ["too few motions"] if array.analysis.basis is Basis.TOO_FEW else []
    return [
        *(check.title for check in array.analysis_checks if not check.ok),
        *_motion_faults(package),
        *few,
    ]


def _motion_faults(package: PackageData) -> Sequence[str]:
    missed = package.assessment.acceptance.missed
    return [row.title for row in missed if row.consequence is Consequence.NG]


def troubles(package: PackageData) -> Sequence[str]:
    """Return everything that prevents an OK, except clearances, in words."""
    few = [
        f"Array {array.id}: too few motions ({array.analysis.n_motions}) for the requested "
        f"statistic ({package.data.options.statistic.value}); no design value."
        for array in package.assessment.arrays
        if array.analysis.basis is Basis.TOO_FEW
    ]
    motions = [
        f"Array {array.id}: the value from analysis is not permitted with these motions "
        f"({'; '.join(_motion_faults(package))})."
        for array in package.assessment.arrays
        if array.route is Route.ANALYSIS and _motion_faults(package)
    ]
    return [
        *package.assessment.warnings,
        *few,
        *motions,
        *model_troubles(package),
        *tipping_troubles(package),
        *link_troubles(package),
        *failed_limits(package),
    ]


def conditions(package: PackageData) -> Sequence[str]:
    """Return every requirement that is not satisfied, with what must be done."""
    words = {Consequence.NG: "NG", Consequence.CONDITION: "Condition"}
    return [
        with_symbols(
            f"{words[row.consequence]}: {_subject(package, row)}{row.title}: {row.found}; "
            f"required: {row.limit}. {row.remedy}"
        )
        for row in package.assessment.conditions
    ]


def _subject(package: PackageData, row: Row) -> str:
    if not row.subject:
        return ""
    is_array = any(array.id == row.subject for array in package.data.arrays)
    return f"{'array' if is_array else 'motion'} {row.subject}, "


def requirements(package: PackageData) -> Table:
    """Return the requirements beside the numeric limits, each with its verdict."""
    return Table(
        caption="Requirements beside the numeric limits",
        columns=(
            TableColumn(head="Item", align="left", share=0.9),
            TableColumn(head="Requirement", align="left", share=2.3),
            TableColumn(head="Found", align="left", share=2.6),
            TableColumn(head="Required", align="left", share=1.9),
            TableColumn(head="Basis", align="left", share=1.5),
            TableColumn(head="Verdict", align="center", share=1.8),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    row.subject or "Project",
                    with_symbols(row.title),
                    with_symbols(row.found),
                    with_symbols(row.limit),
                    row.basis,
                    stamp(row.verdict),
                )
            )
            for row in package.assessment.rows
        ),
    )


def check_table(
    caption: str,
    package: PackageData,
    checks: Sequence[tuple[str, Check]],
    words: tuple[str, str] = (OK, NG),
) -> Table:
    """Return limits and values of the project; `words` are for satisfied and not satisfied."""
    return Table(
        caption=caption,
        columns=(
            TableColumn(head="Item", align="left", share=0.9),
            TableColumn(head="Quantity", align="left", share=3.3),
            TableColumn(head="Value", share=1.5),
            TableColumn(head="", align="center", share=0.3),
            TableColumn(head="Limit", share=1.6),
            TableColumn(head="Clause", align="left", share=1.6),
            TableColumn(head="Verdict", align="center", share=1.1),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    place,
                    check.title,
                    check_value(check, check.value, package.fmt),
                    _sign(check),
                    check_value(check, check.limit, package.fmt) + dagger(check.provision),
                    check.provision.clause + dagger(check.provision),
                    verdict(check.ok, (EXCEPTED, NG) if check.passes_by_exception else words),
                )
            )
            for place, check in checks
        ),
        notes=tuple(
            dict.fromkeys(
                _exception(package, check) for _, check in checks if check.passes_by_exception
            )
        ),
    )


def _sign(check: Check) -> str:
    if check.passes_by_exception:
        return ">"
    return "≤" if check.at_most else "≥"


def _exception(package: PackageData, check: Check) -> str:
    """Return why the slope limit of the rule set may be exceeded, and what limits it instead."""
    limit = check_value(check, check.limit, package.fmt) + dagger(check.provision)
    return (
        f"* {check.provision.clause}{dagger(check.provision)} permits roofs over {limit} by "
        f"analysis in SDC A, B, C with peer review. SDC {package.data.site.sdc_text}; reviewed by "
        f"{package.reviewer}. {package.clause('ibc_max_slope_deg')} limits the slope as well, in "
        "a row of its own."
    )


def limits(package: PackageData) -> Mapping[str, object]:
    """Return the part on limits and interconnection strength."""
    return {
        "texts": (),
        "tables": (
            check_table(_limits_caption(package), package, package.checks),
            requirements(package),
            *_warnings(package),
            _interconnection(package),
        ),
    }


def _limits_caption(package: PackageData) -> str:
    """Return of which routes the limits are, with the arrays where the routes differ."""
    taken = {
        route: ", ".join(array.id for array in package.assessment.arrays if array.route is route)
        for route in Route
    }
    routes = [(route, ids) for route, ids in taken.items() if ids]
    if len(routes) == 1:
        return f"Limits of the building and of the {routes[0][0]} route"
    (first, of_first), (second, of_second) = routes
    return (
        f"Limits of the building, of the {first} route ({of_first}) and of the {second} route "
        f"({of_second})"
    )


def _warnings(package: PackageData) -> Iterator[Table]:
    """Yield the warnings on the input with the reasons that the workbook gives; nothing for none.

    A contradiction of the plan is also among the requirements.
    """
    sheet = package.assessment.sheet
    found = [
        finding
        for finding in findings(sheet, package.assessment.shaking)
        if finding.level is Level.WARNING
    ]
    if found:
        yield Table(
            caption="Warnings on the input",
            columns=(
                TableColumn(head="Cell", align="left", share=1.2),
                TableColumn(head="Warning", align="left", share=5.6),
                TableColumn(head="Reason given in the workbook", align="left", share=3.2),
            ),
            rows=tuple(
                TableRow(
                    cells=(
                        line.cells,
                        f"{line.finding.text}.",
                        line.finding.reason or "not acknowledged",
                    )
                )
                for line in lines(found, sheet.addresses)
            ),
        )


def _interconnection(package: PackageData) -> Table:
    fmt = package.fmt
    lighter = Markup("Lighter part {}\u00a0=\u00a0½\u00a0W").format(symbol("W_1"))
    return Table(
        caption="Interconnection strength required within each array",
        columns=(
            TableColumn(head="Array", align="left", share=1.2),
            *fmt.columns("Weight W", Quantity.WEIGHT),
            *fmt.columns(lighter, Quantity.WEIGHT),
            *fmt.columns("Required", Quantity.WEIGHT),
            *fmt.columns("Provided", Quantity.WEIGHT),
            TableColumn(head="D/C", share=0.8),
            TableColumn(head="Clause", align="left", share=1.9),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    array.id,
                    *fmt.cells(array.array.weight_n, Quantity.WEIGHT),
                    *fmt.cells(array.array.weight_n / 2.0, Quantity.WEIGHT),
                    *_strengths(package, array),
                    package.clause("interconnection_sds"),
                )
            )
            for array in package.assessment.arrays
        ),
        notes=(
            "The lighter part on either side of a section is at most half of the array.",
            *_rounded(package),
        ),
    )


def _rounded(package: PackageData) -> Iterator[str]:
    """Yield which strengths print rounded apart, if any do."""
    ids = [
        array.id
        for array in package.assessment.arrays
        if (provided := array.array.interconnection_n) is not None
        and rounded_apart(array.interconnection_n, provided, Quantity.WEIGHT)
    ]
    if ids:
        yield (
            f"{', '.join(ids)}: required and provided are rounded apart: both would print alike, "
            "and less is provided."
        )


def _strengths(package: PackageData, array: ArrayAssessment) -> tuple[str, ...]:
    """Return the strengths required and provided in both systems, and their ratio."""
    fmt, mark = package.fmt, package.mark("interconnection_sds")
    required, provided = array.interconnection_n, array.array.interconnection_n
    if provided is None:
        return (*fmt.cells(required, Quantity.WEIGHT, mark=mark), "not given", "not given", "—")
    shown, had = compared(required, provided)
    return (
        *fmt.cells(required, Quantity.WEIGHT, mark=mark, show=shown),
        *fmt.cells(provided, Quantity.WEIGHT, show=had),
        ratio(required / provided),
    )
