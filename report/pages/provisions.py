"""The provisions behind the numbers, overrides and departures."""

from __future__ import annotations

from collections.abc import Mapping

from markupsafe import Markup, escape

from report.document.tables import listed
from report.entities.marks import UNVERIFIED, dagger
from report.entities.shown import text, words
from report.pages.parts import PackageData
from report.typeset.equations import symbol
from solver.rules.provisions import OVERRIDABLE, Provision

_BY_DIRECTION = (
    "Displacement by direction: a clearance takes the displacement toward it, not less than the "
    "floor. No document of the rule sets states a direction."
)
_NONE = "not given"


def provisions(package: PackageData) -> Mapping[str, object]:
    """Return every number of the rule set with its status, and the overrides."""
    rules, fmt = package.assessment.rules, package.fmt
    named = [(_sentence_case(OVERRIDABLE[key]), value) for key, value in rules.values.items()]
    columns = (
        (words("Provision", 5.2), lambda row: row[0]),
        (text("Value", share=0.9), lambda row: f"{row[1].value:.4g}" + dagger(row[1])),
        (words("Clause", 1.7), lambda row: row[1].clause),
        (words("Status", 1.5), lambda row: _standing(row[1])),
    )
    overridden = (
        (words("Provision", 3.0), lambda row: _sentence_case(OVERRIDABLE[row.provision])),
        (text("Value", share=0.8), lambda row: f"{row.value:.6g}†‡"),
        (words("Reason given in the workbook", 4.0), lambda row: row.reason),
    )
    departure = (
        (words("Departure", 3.0), lambda _: _BY_DIRECTION),
        (words("Reason given in the workbook", 3.0), lambda row: row.directional_reason or _NONE),
        (words("Reviewer", 1.6), lambda row: row.directional_reviewer or _NONE),
        (words("License", 1.2), lambda row: row.directional_license or _NONE),
        (words("Date"), lambda row: row.directional_date or _NONE),
    )
    return {
        "table": listed(named, columns, fmt, kind="compact"),
        "noted": [(name, provision) for name, provision in named if provision.note],
        "unverified": UNVERIFIED,
        "overrides": listed(package.data.overrides, overridden, fmt),
        "departure": listed([package.data.options], departure, fmt),
    }


def _sentence_case(name: str) -> Markup:
    """Return the name of a provision in sentence case with typeset symbols."""
    plain = escape(name[0].upper() + name[1:]).replace(" - ", " − ").replace("^2", "²")
    return plain.replace("S_DS", symbol("S_DS")).replace("W1", symbol("W_1"))


def _standing(provision: Provision) -> str:
    if provision.reason:
        return "overridden, see below"
    return "confirmed" if provision.verified else "to be verified"
