"""A package compared with the one made again from its input. Read `compared`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from importlib.metadata import version
from itertools import zip_longest
from typing import Any

from report.proof.contents import differences, first_other_word, refused, words
from report.proof.package import OpenedPackage, guarded, signed_fields
from report.proof.signatures import Appended, Signature, appended
from report.provenance.files import MANIFEST, RESULTS, Manifest


class Agreement(StrEnum):
    """How a package compares with the one made again."""

    SAME = "same"
    PARTLY = "not compared in full"
    DIFFERS = "differs"


@dataclass(frozen=True, slots=True, kw_only=True)
class Proof:
    """The outcome of a comparison.

    Attributes
    ----------
    reasons : sequence of str
        What differs, or what was not compared.
    signed : sequence of Signature
        Put on after the package was written.
    is_to_be_read : bool
        Whether the package made again shows what was not compared.
    """

    answer: Agreement
    reasons: Sequence[str] = ()
    signed: Sequence[Signature] = ()
    is_to_be_read: bool = False


_UNCHECKED = (
    "the signature and what came with it were not checked; that needs the extra 'sign', which "
    "./roofslip sign installs"
)


def compared(package: OpenedPackage, made: OpenedPackage) -> Proof:
    """Compare a package with the one made again from its input.

    Raises
    ------
    InputError
        If the package is damaged or larger than any package.
    """
    if package.data == made.data:
        return Proof(answer=Agreement.SAME)
    is_same = package.data.startswith(made.data)
    fields = guarded(lambda: signed_fields(package.pdf))
    later = appended(package.data, made.data if is_same else b"") if fields else Appended()
    if is_same and not fields:
        later = Appended(problems=("appended: bytes that no signature covers",))
    first = guarded(lambda: next(_reasons(package, made, later, is_same=is_same), ""))
    if first:
        return Proof(answer=Agreement.DIFFERS, reasons=(first,), signed=later.signed)
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
    reason = f"its input does not run: {'; '.join(problems)}"
    if package.manifest.roofslip_version == version("roofslip"):
        return Proof(answer=Agreement.DIFFERS, reasons=(reason,))
    return Proof(answer=Agreement.PARTLY, reasons=(_other_version(package.manifest), reason))


def _not_compared(theirs: Manifest, ours: Manifest) -> str:
    if theirs.roofslip_version != ours.roofslip_version:
        return f"{_other_version(theirs)}; words and drawings not compared: {_READ}"
    others = [
        f"{name} {theirs.environment.get(name, 'none')} (here {here})"
        for name, here in ours.environment.items()
        if theirs.environment.get(name) != here
    ]
    names = f"; it names {', '.join(others)}" if others else ""
    return f"drawings not compared: {_READ}{names}"


_READ = "read the package made again"


def _other_version(theirs: Manifest) -> str:
    return f"Roofslip {theirs.roofslip_version} made it: install that version to compare all of it"


def _reasons(
    package: OpenedPackage, made: OpenedPackage, later: Appended, *, is_same: bool
) -> Iterator[str]:
    """Yield what differs or what no package has."""
    yield from later.problems
    yield from refused(package.pdf)
    if is_same:
        return
    theirs, ours = package.manifest, made.manifest
    is_shared = theirs.roofslip_version != ours.roofslip_version
    if not is_shared:
        listed = (_listing(package), _listing(made))
        yield from (f"{MANIFEST}: {text}" for text in differences(*listed))
    numbers = differences(package.results, made.results, shared=is_shared)
    yield from (f"{RESULTS}: {text}" for text in numbers)
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
        for name, here in ours.items():
            computed = computed.replace(f"{name} {here}", f"{name} {theirs.get(name, 'none')}")
        if first := first_other_word(stated[1], computed):
            yield f"{stated[0]}: {first}"
