"""The status of every feature, and the errors of released versions."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import metadata
from itertools import groupby

from report.document.tables import Table, TableRow, Wide
from report.entities.columns import TableColumn
from report.manual.blocks import FAIL, Block, ManualSection
from report.manual.known_errors import KNOWN_ERRORS
from report.pages.parts import verdict
from report.words.validation import validation
from solver.verification.evidence import Verification
from solver.verification.features import FeatureStatus, statuses


def features(verification: Verification) -> ManualSection:
    """Return the table of features."""
    return ManualSection(
        id="features",
        title="Status of each feature",
        blocks=(
            Block(
                texts=(
                    "Verified: every check listed ran in this verification and passed; the "
                    "equations are solved as specified. Validated: measured slip of a shake table "
                    "satisfies the acceptance of section 13. Both are computed from this run. "
                    "Automatic tests come with the program; this manual does not repeat them.",
                    validation(verification.tables),
                ),
                tables=(_feature_table(verification),),
            ),
        ),
    )


def verified(verification: Verification) -> str:
    """Return how many of how many features are verified."""
    found = statuses(verification.checks, verification.tables)
    return f"{sum(status.is_verified for status in found)} of {len(found)}"


def _feature_table(verification: Verification) -> Table:
    return Table(
        caption="Features",
        columns=(
            TableColumn(head="Feature", align="left", share=2.9),
            TableColumn(head="Checks (section 3)", align="left", share=1.9),
            TableColumn(head="Passed", share=0.9),
            TableColumn(head="Status", align="left", share=1.8),
            TableColumn(head="Limits of the checks", align="left", share=3.2),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    status.feature.name,
                    ", ".join(spans(status.ids)) or "—",
                    f"{status.n_passed} of {status.n_checks}" if status.n_checks else "—",
                    _status(status),
                    _limits(status),
                )
            )
            for status in statuses(verification.checks, verification.tables)
        ),
        kind="compact",
    )


def spans(ids: tuple[str, ...]) -> list[str]:
    """Return ids with runs of three or more as `CF-1 to CF-9`."""
    numbered = [(letters, int(digits)) for letters, _, digits in (id.partition("-") for id in ids)]
    groups = groupby(enumerate(numbered), key=lambda pair: (pair[1][0], pair[1][1] - pair[0]))
    words: list[str] = []
    for _, members in groups:
        own = [f"{letters}-{number}" for _, (letters, number) in members]
        words += [f"{own[0]} to {own[-1]}"] if len(own) > 2 else own
    return words


def _status(status: FeatureStatus) -> str:
    if status.n_passed < status.n_checks:
        return verdict(False, ("", FAIL))
    if status.is_validated:
        return f"verified, validated by {status.n_tests} tests" if status.is_verified else (
            f"validated by {status.n_tests} tests, not verified"
        )  # fmt: skip
    return "verified, not validated" if status.is_verified else "neither"


def _limits(status: FeatureStatus) -> str:
    words = [status.feature.only] if status.feature.only else []
    words += [f"Did not run: {', '.join(status.missing)}"] if status.missing else []
    return "; ".join(words)


def known_errors() -> ManualSection:
    """Return the errors of released versions, with what to do about them."""
    rows: list[TableRow] = []
    for version in dict.fromkeys(error.version for error in KNOWN_ERRORS):
        own = [error for error in KNOWN_ERRORS if error.version == version]
        rows.append(TableRow(cells=(Wide(f"Version {version} as released: {len(own)} errors", 3),),
                             kind="total"))  # fmt: skip
        rows += [TableRow(cells=(error.what, error.effect, error.action)) for error in own]
    return ManualSection(
        id="known-errors",
        title="Known errors of released versions",
        blocks=(
            Block(
                texts=(
                    "These errors were found after the release of a version and are corrected in "
                    "the program that wrote this manual. The engineer of record decides whether "
                    "an issued package is affected.",
                    *_same_number(),
                ),
                tables=(
                    Table(
                        caption="Errors with corrective action",
                        columns=(
                            TableColumn(head="Error", align="left", share=3.2),
                            TableColumn(head="Effect on a package", align="left", share=2.5),
                            TableColumn(head="Corrective action", align="left", share=2.7),
                        ),
                        rows=tuple(rows),
                        kind="compact",
                    ),
                ),
            ),
        ),
    )


def _same_number() -> Iterator[str]:
    """Yield how packages are told apart while this program has the number of a release."""
    number = metadata.version("roofslip")
    if any(error.version == number for error in KNOWN_ERRORS):
        yield (
            f"This program is a later state with the same number, {number}. Its packages hold the "
            "attachment roofslip.json; those of the release have no attachments."
        )
