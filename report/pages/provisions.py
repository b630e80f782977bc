"""The provisions behind the numbers, and the overrides for the project."""

from __future__ import annotations

from collections.abc import Mapping

from markupsafe import Markup, escape

from report.assessment.checks.check import dagger
from report.assessment.design.rule_set import as_adopted
from report.document.columns import text, words
from report.document.tables import headed, listed
from report.pages.marks import UNVERIFIED
from report.pages.parts import PackageData
from report.typeset.equations import symbol
from solver.rules.rulesets import ALLOWED


def page(package: PackageData) -> Mapping[str, object]:
    """Return every number of the rule set in two columns, and the overrides."""
    done, data = package.assessment, package.data
    rules = done.rules
    named = [
        (_sentence_case(ALLOWED[key].meaning), value)
        for key, value in rules.values.items()
        # Without an analysis only its floor is said, as what it could save.
        if done.has_motions or key == "analysis_floor" or "analysis" not in key
    ]
    # The heading names the rule set: its name before each clause would need a second line.
    before_clauses = rules.name.removeprefix("SEAOC ") + " "
    columns = (
        (words("Provision", 6.0), lambda row: row[0]),
        (text("Value", share=0.75), lambda row: f"{row[1].value:.4g}" + dagger(row[1])),
        (words("Section", 1.9), lambda row: row[1].clause.removeprefix(before_clauses)),
    )
    # Two columns of the page; the left one has the odd row.
    middle = (len(named) + 1) // 2
    halves = named[:middle], named[middle:]
    overrides = [
        # Both marks: no adopted document has the value of an override.
        (_sentence_case(ALLOWED[row.provision].meaning), f"{row.value:.6g}†‡", row.reason)
        for row in data.overrides
    ]
    return {
        "rules": rules.name,
        "halves": [listed(half, columns, package.fmt, kind="compact") for half in halves],
        "notes": [
            (name, provision.note + dagger(provision))
            for name, provision in named
            if provision.note
        ],
        "mu_rises_with_slope": rules.mu_rises_with_slope,
        "confirmed": data.confirmed,
        "confirmed_documents": ", ".join(data.confirmation.of),
        "unverified": UNVERIFIED,
        "is_changed": as_adopted(data) is not data,
        "overrides": headed(*_OVERRIDES, rows=overrides) if overrides else None,
    }


_OVERRIDES = ("Provision", 3), ("Value", 0.8, "right"), ("Reason given in the workbook", 4)


def _sentence_case(name: str) -> Markup:
    """Return the name of a provision in sentence case with typeset symbols."""
    # Names of provisions are those of the sheet Overrides, which can be typed: hyphen, ^2, S_DS.
    plain = escape(name[0].upper() + name[1:]).replace(" - ", " − ").replace("^2", "²")
    return plain.replace("S_DS", symbol("S_DS")).replace("W1", symbol("W_1"))
