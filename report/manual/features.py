"""The status of every feature."""

from __future__ import annotations

from report.document.sections import Section, section
from report.document.tables import listed
from report.entities.shown import text, words
from report.manual.summary import judged
from report.words.counts import ranged
from solver.verification.evidence import Verification
from solver.verification.features import FeatureStatus, statuses

_FEATURE = (
    (words("Feature", 2.9), lambda status: status.feature.name),
    (words("Checks (section 3)", 1.9), lambda status: ranged(status.ids) or "—"),
    (
        text("Passed", share=0.9),
        lambda status: f"{status.n_passed} of {status.n_checks}" if status.n_checks else "—",
    ),
    (words("Status", 1.8), lambda status: _status(status)),
    (words("Limits of the checks", 3.2), lambda status: _limits(status)),
)


def features(verification: Verification) -> Section:
    """Return the table of features."""
    found = statuses(verification.checks, verification.tables)
    return section(
        "manual/features",
        "Status of each feature",
        features=listed(found, _FEATURE, kind="compact"),
    )


def _status(status: FeatureStatus) -> str:
    if status.n_passed < status.n_checks:
        return judged(False)
    if status.is_validated:
        return f"verified, validated by {status.n_tests} tests" if status.is_verified else (
            f"validated by {status.n_tests} tests, not verified"
        )  # fmt: skip
    return "verified, not validated" if status.is_verified else "neither"


def _limits(status: FeatureStatus) -> str:
    found = [status.feature.only] if status.feature.only else []
    found += [f"Did not run: {', '.join(status.missing)}"] if status.missing else []
    return "; ".join(found)
