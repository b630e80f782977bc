"""The provisions behind the numbers, overrides and departures."""

from __future__ import annotations

from collections.abc import Mapping

from markupsafe import Markup, escape

from report.document.tables import Table, TableRow
from report.entities.columns import TableColumn
from report.entities.marks import UNVERIFIED, dagger
from report.pages.parts import PackageData
from report.typeset.equations import symbol
from solver.rules.provisions import OVERRIDABLE


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
                Markup("{}: {}{}.").format(
                    _sentence_case(OVERRIDABLE[key]), provision.note, dagger(provision)
                )
                for key, provision in rules.values.items()
                if provision.note
            ),
            kind="compact",
        ),
        "unverified": UNVERIFIED,
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
