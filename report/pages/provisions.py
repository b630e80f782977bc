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


def provisions(package: PackageData) -> Mapping[str, object]:
    """Return every number of the rule set with its status, and the overrides."""
    rules = package.assessment.rules
    named = [(_sentence_case(OVERRIDABLE[key]), value) for key, value in rules.values.items()]
    columns = (
        (words("Provision", 5.2), lambda row: row[0]),
        (text("Value", share=0.9), lambda row: f"{row[1].value:.4g}" + dagger(row[1])),
        (words("Clause", 1.7), lambda row: row[1].clause),
        (words("Status", 1.5), lambda row: _standing(row[1])),
    )
    return {
        "table": listed(named, columns, package.fmt, kind="compact"),
        "noted": [(name, provision) for name, provision in named if provision.note],
        "unverified": UNVERIFIED,
        "overrides": [
            (_sentence_case(OVERRIDABLE[row.provision]), f"{row.value:.6g}†‡", row.reason)
            for row in package.data.overrides
        ],
    }


def _sentence_case(name: str) -> Markup:
    """Return the name of a provision in sentence case with typeset symbols."""
    plain = escape(name[0].upper() + name[1:]).replace(" - ", " − ").replace("^2", "²")
    return plain.replace("S_DS", symbol("S_DS")).replace("W1", symbol("W_1"))


def _standing(provision: Provision) -> str:
    if provision.reason:
        return "overridden, see below"
    return "confirmed" if provision.verified else "to be verified"
