"""The provisions behind the numbers, overrides and departures."""

from __future__ import annotations

from collections.abc import Mapping

from markupsafe import Markup, escape

from report.document.tables import listed
from report.entities.marks import UNVERIFIED, dagger
from report.entities.shown import text, words
from report.pages.parts import PackageData
from report.typeset.equations import symbol
from solver.rules.provisions import OVERRIDABLE


def provisions(package: PackageData) -> Mapping[str, object]:
    """Return every number of the rule set in two columns, and the overrides."""
    rules = package.assessment.rules
    named = [(_sentence_case(OVERRIDABLE[key]), value) for key, value in rules.values.items()]
    columns = (
        (words("Provision", 4.6), lambda row: row[0]),
        (text("Value", share=0.75), lambda row: f"{row[1].value:.4g}" + dagger(row[1])),
        (words("Clause", 2.4), lambda row: row[1].clause),
    )
    middle = (len(named) + 1) // 2
    halves = named[:middle], named[middle:]
    return {
        "halves": [listed(half, columns, package.fmt, kind="compact") for half in halves],
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
