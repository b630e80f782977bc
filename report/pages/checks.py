"""Clearances, limits, interconnection strength and the underlying provisions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from markupsafe import Markup, escape

from report.assessment.arrays import ArrayAssessment, Route
from report.assessment.clearances import ClearanceCheck
from report.assessment.foresight import findings
from report.assessment.remedies import Remedy
from report.assessment.verdict import Row, Verdict
from report.pages.links import link_troubles
from report.pages.model import model_troubles, tipping_troubles
from report.pages.parts import (
    NG,
    OK,
    PackageData,
    Table,
    TableColumn,
    TableRow,
    check_value,
    dagger,
    stamp,
    verdict,
)
from report.pages.remedies import table
from report.pages.symbols import with_symbols
from report.sheet.findings import Level, located
from report.sheet.schema import Array, Direction, ObjectKind
from report.typeset.equations import symbol
from report.words.units import Quantity, compared, number, ratio
from solver.records.acceptance_row import Consequence
from solver.rules.provisions import OVERRIDABLE, SEPARATION_KEYS, Basis, Check, Neighbor


def clearance_table(package: PackageData, *, brief: bool) -> Table:
    """Return the clearances: required and provided separation."""
    fmt = package.fmt
    factor = " × I" if package.assessment.rules.importance_in_separation else ""
    directions = (
        [TableColumn(head="Direction", align="left", share=1.05)] if _by_direction(package) else []
    )
    more = (
        ()
        if brief
        else (
            *fmt.columns("Displ.", share=0.72),
            TableColumn(head="Array", align="left", share=0.75),
            *directions,
            TableColumn(head="Factor" + factor, share=0.75),
            TableColumn(head="Clause", align="left", share=2.1),
        )
    )
    return Table(
        caption="Clearances: required and provided separation",
        columns=(
            TableColumn(head="No.", share=0.42),
            TableColumn(head="From", align="left", share=0.9),
            TableColumn(head="To", align="left", share=1.3),
            TableColumn(head="Condition", align="left", share=3.1 if brief else 2.2),
            *more,
            *fmt.columns("Required", share=0.8),
            *fmt.columns("Provided", share=0.8),
            TableColumn(head="D/C", share=0.62),
            TableColumn(head="Verdict", align="center", share=_verdict_share(package)),
        ),
        rows=tuple(
            _clearance_row(package, count, gap, brief)
            for count, gap in enumerate(package.assessment.clearances, start=1)
        ),
        kind="" if brief else "compact",
    )


def _verdict_share(package: PackageData) -> float:
    """Return a width for the longest verdict on a clearance."""
    verdicts = {gap.verdict for gap in package.assessment.clearances}
    return 1.7 if Verdict.CONDITIONS in verdicts else 0.95


def _by_direction(package: PackageData) -> bool:
    """Whether any clearance takes the displacement in one direction."""
    gaps = package.assessment.clearances
    return any(gap.governing_direction is not Direction.ANY for gap in gaps)


def _clearance_row(package: PackageData, count: int, gap: ClearanceCheck, brief: bool) -> TableRow:
    fmt, row = package.fmt, gap.clearance
    key = SEPARATION_KEYS[gap.neighbor]
    least = package.mark("separation_edge_min_in") if gap.is_least_value else ""
    required, provided = compared(gap.required_m, row.provided_m)
    more = (
        ()
        if brief
        else (
            *fmt.cells(gap.design_m),
            gap.governing_array,
            *([gap.governing_direction.value] if _by_direction(package) else []),
            number(gap.factor, 2) + package.mark(key),
            package.clause(key),
        )
    )
    where = "" if row.direction == "any" else f", {row.direction.value}"
    return TableRow(
        cells=(
            str(count),
            row.array,
            row.object,
            gap.neighbor.value + where,
            *more,
            *fmt.cells(gap.required_m, mark=least, show=required),
            *fmt.cells(row.provided_m, Quantity.SIZE, show=provided),
            ratio(gap.demand_capacity),
            stamp(gap.verdict),
        ),
        kind=package.bar(count in package.changes.clearances),
    )


def all_checks(package: PackageData) -> Sequence[tuple[str, Check]]:
    """Return every limit with the item that it applies to."""
    building = [("Building", check) for check in package.assessment.building_checks]
    arrays = [
        (f"Array {array.id}", check)
        for array in package.assessment.arrays
        for check in array.limits
    ]
    return [*building, *arrays]


def failed_limits(package: PackageData) -> Sequence[str]:
    """Return the limits that are not satisfied, in words."""
    return [
        f"{place}: {check.title} is {check_value(check, check.value, package.fmt)}, limit "
        f"{check_value(check, check.limit, package.fmt)} "
        f"({check.provision.clause}{dagger(check.provision)})."
        for place, check in all_checks(package)
        if not check.ok
    ]


def troubles(package: PackageData) -> Sequence[str]:
    """Return everything that prevents an OK, except clearances, in words."""
    few = [
        f"Array {array.id}: too few motions ({array.analysis.n_motions}) for the requested "
        f"statistic ({package.data.options.statistic.value}); no design value."
        for array in package.assessment.arrays
        if array.analysis.basis is Basis.TOO_FEW
    ]
    return [
        *package.assessment.warnings,
        *few,
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
            TableColumn(head="Item", align="left", share=0.8),
            TableColumn(head="Requirement", align="left", share=2.6),
            TableColumn(head="Found", align="left", share=2.5),
            TableColumn(head="Required", align="left", share=2.0),
            TableColumn(head="Basis", align="left", share=1.75),
            TableColumn(head="Verdict", align="center", share=1.35),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    row.subject or "Project",
                    with_symbols(row.title),
                    row.found,
                    row.limit,
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
                    "≤" if check.at_most else "≥",
                    check_value(check, check.limit, package.fmt) + dagger(check.provision),
                    check.provision.clause + dagger(check.provision),
                    verdict(check.ok, words),
                )
            )
            for place, check in checks
        ),
    )


def clearances(package: PackageData, remedies: Sequence[Remedy]) -> Mapping[str, object]:
    """Return the part on clearances, without its chart."""
    notes = [
        "Displ. is the design displacement of the array in the next column "
        f"({package.part('comparison')}). " + _direction_note(package),
        "Between two arrays the larger of the two displacements governs.",
    ]
    parapets = _parapets(package)
    if parapets:
        notes += [*parapets, "The strength of a parapet is not checked."]
    if any(gap.is_least_value for gap in package.assessment.clearances):
        notes.append(
            "The minimum separation to an edge without a qualifying parapet governs where the "
            "required value exceeds factor × displacement: "
            f"{package.fmt.both(package.assessment.rules.length_m('separation_edge_min_in'))}"
            f"{package.mark('separation_edge_min_in')}."
        )
    return {
        "table": clearance_table(package, brief=False),
        "notes": tuple(notes),
        "remedies": table(package, remedies) if remedies else None,
    }


def _parapets(package: PackageData) -> Sequence[str]:
    """Return for each clearance to a parapet whether it qualifies, with the numbers."""
    heights = {
        item.id: item.height_m
        for item in package.data.objects
        if item.kind is ObjectKind.EDGE_WITH_PARAPET and item.height_m is not None
    }
    arrays = {array.id: array for array in package.data.arrays}
    return [
        _parapet(package, gap, heights[gap.clearance.object], arrays[gap.clearance.array])
        for gap in package.assessment.clearances
        if gap.clearance.object in heights
    ]


def _parapet(package: PackageData, gap: ClearanceCheck, top_m: float, array: Array) -> str:
    rules, over_m = package.assessment.rules, top_m - array.cg_height_m
    top, cg, over = (package.fmt.both(v, Quantity.SIZE) for v in (top_m, array.cg_height_m, over_m))
    least, least_over = (
        f"{package.fmt.both(rules.length_m(key), Quantity.SIZE)}{package.mark(key)}"
        for key in ("parapet_height_in", "parapet_over_cg_in")
    )
    qualifies = gap.neighbor is Neighbor.PARAPET
    return (
        f"Parapet {gap.clearance.object} beside {array.id}: top {top} above the roof, at least "
        f"{least}; above the center of gravity {top} − {cg} = {over}, at least {least_over}: "
        + ("it qualifies." if qualifies else "it does not qualify, an edge without a parapet.")
    )


def _direction_note(package: PackageData) -> str:
    """Return which part of the displacement a clearance takes."""
    if package.data.options.directional:
        return (
            "It is taken in the direction shown, not less than the floor: a departure from the "
            f"rule set ({package.part('provisions')})."
        )
    return "It is taken in full in every direction."


def limits(package: PackageData) -> Mapping[str, object]:
    """Return the part on limits and interconnection strength."""
    return {
        "texts": (),
        "tables": (
            check_table(_limits_caption(package), package, all_checks(package)),
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
        cells = located(found, sheet.addresses)
        yield Table(
            caption="Warnings on the input",
            columns=(
                TableColumn(head="Cell", align="left", share=1.2),
                TableColumn(head="Warning", align="left", share=5.6),
                TableColumn(head="Reason given in the workbook", align="left", share=3.2),
            ),
            rows=tuple(
                TableRow(cells=(cell, f"{finding.text}.", finding.reason or "not acknowledged"))
                for finding, cell in zip(found, cells, strict=True)
            ),
        )


def _interconnection(package: PackageData) -> Table:
    fmt = package.fmt
    return Table(
        caption="Interconnection strength required within each array",
        columns=(
            TableColumn(head="Array", align="left", share=1.2),
            *fmt.columns("Weight W", Quantity.WEIGHT),
            *fmt.columns(Markup("Lighter part {} = W/2").format(symbol("W_1")), Quantity.WEIGHT),
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
        notes=("The lighter part on either side of a section is at most half of the array.",),
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


def provisions(package: PackageData) -> Mapping[str, object]:
    """Return every number of the rule set with its status, and the overrides."""
    rules = package.assessment.rules
    return {
        "table": Table(
            caption=f"Numbers of {rules.name} used in this package",
            columns=(
                TableColumn(head="Provision", align="left", share=5.2),
                TableColumn(head="Value", share=0.9),
                TableColumn(head="Clause", align="left", share=1.7),
                TableColumn(head="Status", align="left", share=1.5),
            ),
            rows=tuple(
                TableRow(
                    cells=(
                        _sentence_case(OVERRIDABLE[key]),
                        f"{provision.value:.4g}" + dagger(provision),
                        provision.clause,
                        _standing(provision.reason, provision.verified),
                    )
                )
                for key, provision in rules.values.items()
            ),
            notes=tuple(
                Markup("{}: {}.").format(_sentence_case(OVERRIDABLE[key]), provision.note)
                for key, provision in rules.values.items()
                if provision.note
            ),
            kind="compact",
        ),
        "departure": _departure(package),
        "overrides": Table(
            caption="Overridden for this project",
            columns=(
                TableColumn(head="Provision", align="left", share=3.0),
                TableColumn(head="Value", share=0.8),
                TableColumn(head="Reason given in the workbook", align="left", share=4.0),
            ),
            rows=tuple(
                TableRow(
                    cells=(
                        _sentence_case(OVERRIDABLE[row.provision]),
                        f"{row.value:.6g}†‡",
                        row.reason,
                    )
                )
                for row in package.data.overrides
            ),
        ),
    }


def _departure(package: PackageData) -> Table | None:
    """Return the departure that is no number of the rule set, where the workbook asks for it."""
    options = package.data.options
    if not options.directional:
        return None
    date = "not given" if options.directional_date is None else options.directional_date.isoformat()
    return Table(
        caption="Departure from the rule set",
        columns=(
            TableColumn(head="Departure", align="left", share=3.0),
            TableColumn(head="Reason given in the workbook", align="left", share=3.0),
            TableColumn(head="Reviewer", align="left", share=1.6),
            TableColumn(head="License", align="left", share=1.2),
            TableColumn(head="Date", align="left", share=1.0),
        ),
        rows=(
            TableRow(
                cells=(
                    "Displacement by direction: a clearance takes the displacement toward it, not "
                    "less than the floor. No document of the rule sets states a direction.",
                    options.directional_reason or "not given",
                    options.directional_reviewer or "not given",
                    options.directional_license or "not given",
                    date,
                )
            ),
        ),
    )


def _sentence_case(text: str) -> Markup:
    """Return the name of a provision in sentence case with typeset symbols."""
    plain = escape(text[0].upper() + text[1:]).replace(" - ", " − ").replace("^2", "²")
    return plain.replace("S_DS", symbol("S_DS")).replace("W1", symbol("W_1"))


def _standing(reason: str, verified: bool) -> str:
    if reason:
        return "overridden, see below"
    return "confirmed" if verified else "to be verified"
