"""Compares a package with the one regenerated from its input. Read `compared`.

Drawings are never compared; text and numbers are, if both are from the same version.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from itertools import zip_longest
from typing import Any

from report.proof.differences import differences, first_other_word
from report.proof.opened_package import OpenedPackage, signed_fields
from report.proof.pdf_contents import guarded, refused, words
from report.proof.signatures import Appended, Signature, appended
from report.provenance.known_errors import KnownError
from report.provenance.package_sources import MANIFEST, RESULTS, Manifest
from report.provenance.release import version


class Agreement(StrEnum):
    """Agreement of a package with the regenerated one."""

    SAME = "same"
    PARTLY = "not compared in full"
    DIFFERS = "differs"


@dataclass(frozen=True, slots=True, kw_only=True)
class Proof:
    """The outcome of a comparison."""

    answer: Agreement
    reasons: Sequence[str] = ()  # what differs, or what was not compared
    signed: Sequence[Signature] = ()  # put on after the package was written
    is_to_be_read: bool = False  # whether the package made again shows what was not compared
    known_errors: Sequence[KnownError] = ()  # of earlier versions, which the package may have


_UNCHECKED = (
    "the signature and what came with it were not checked; that needs the extra 'sign', which "
    "./roofslip sign installs"
)


def compared(package: OpenedPackage, made: OpenedPackage) -> Proof:
    """Compare a package with the one regenerated from its input.

    Raises `InputError` if the package is damaged or larger than any package.
    """
    if package.data == made.data:
        return Proof(answer=Agreement.SAME)
    # What is appended leaves the bytes before it as they were; so are signatures put on.
    is_same = package.data.startswith(made.data)
    fields = guarded(lambda: signed_fields(package.pdf))
    later = appended(package.data, made.data if is_same else b"") if fields else Appended()
    if is_same and not fields:
        later = Appended(problems=("appended: bytes that no signature covers",))
    # The first one is enough: a hostile file could have millions.
    first = guarded(lambda: next(_reasons(package, made, later, is_same=is_same), ""))
    if first:
        # A number that an earlier version had wrong differs, too.
        told = tuple(filter(None, (first, _other_version(package.manifest))))
        return Proof(answer=Agreement.DIFFERS, reasons=told, signed=later.signed)
    # Drawings are never compared: another version of a library may move a line by a thousandth.
    reasons = [] if is_same else [_not_compared(package.manifest, made.manifest)]
    reasons += [] if later.is_checked else [_UNCHECKED]
    return Proof(
        answer=Agreement.PARTLY if reasons else Agreement.SAME,
        reasons=tuple(reasons),
        signed=later.signed,
        is_to_be_read=not is_same,
    )


def failed(package: OpenedPackage, problems: Sequence[str]) -> Proof:
    """Return the outcome for a package whose input does not run here."""
    reason = f"its input cannot be run: {'; '.join(problems)}"
    # What another version accepted may be refused here, and is then no sign of tampering.
    other = _other_version(package.manifest)
    if not other:
        return Proof(answer=Agreement.DIFFERS, reasons=(reason,))
    return Proof(answer=Agreement.PARTLY, reasons=(other, reason))


def _not_compared(theirs: Manifest, ours: Manifest) -> str:
    if other := _other_version(theirs):
        return f"{other}; text and drawings not compared: {_READ}"
    versions = [
        f"{name} {theirs.environment.get(name, 'none')} (here {version})"
        for name, version in ours.environment.items()
        if theirs.environment.get(name) != version
    ]
    names = f"; it names {', '.join(versions)}" if versions else ""
    return f"drawings not compared: {_READ}{names}"


_READ = "read the regenerated package"


def _other_version(theirs: Manifest) -> str:
    """Return that another version created a package; nothing if it was this one."""
    name = theirs.roofslip_version
    # Of an unknown commit, or of one that was edited, there are many programs of the same name.
    if name == version() and not name.endswith(("+unknown", ".dirty")):
        return ""
    return f"Roofslip {name} created it: install that version to compare everything"


def _reasons(
    package: OpenedPackage, made: OpenedPackage, later: Appended, *, is_same: bool
) -> Iterator[str]:
    """Yield differences, and content that no package contains."""
    yield from later.problems
    # Before words: a script may replace them when a reader opens the file.
    yield from refused(package.pdf)
    # What is appended may replace a sheet, where nobody has looked at it.
    if is_same and later.is_checked:
        return
    # Versions differ in which keys they write, and in the words of their pages.
    is_shared = bool(_other_version(package.manifest))
    if not is_shared:
        listed = (_listing(package), _listing(made))
        yield from (f"{MANIFEST}: {text}" for text in differences(*listed))
    for text in differences(package.results, made.results, shared=is_shared):
        if not (is_shared and text.startswith("schema_version ")):
            yield f"{RESULTS}: {text}"
    if not is_shared:
        yield from _words(package, made)


def _listing(package: OpenedPackage) -> Any:
    """Return the manifest without versions, and without the hash of the results."""
    listing = {key: value for key, value in package.listing.items() if key != "environment"}
    return listing | {"files": [file for file in listing["files"] if file["kind"] != "results"]}


def _words(package: OpenedPackage, made: OpenedPackage) -> Iterator[str]:
    theirs, ours = package.manifest.environment, made.manifest.environment
    for stated, remade in zip_longest(words(package.pdf), words(made.pdf)):
        if stated is None or remade is None:
            yield f"{(stated or remade)[0]}: {'missing' if stated is None else 'not of this input'}"
            return
        computed = " ".join(remade[1].split())
        # The sheets print the versions: only these words may differ with them.
        for name, release in ours.items():
            computed = computed.replace(f"{name} {release}", f"{name} {theirs.get(name, 'none')}")
        if first := first_other_word(stated[1], computed):
            yield f"{stated[0]}: {first}"
