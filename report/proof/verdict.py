"""What a package shows, held against what its input gives. Read `compared`.

The same versions on the same kind of system write the same bytes. Whatever versions a package
names, all of it is compared; other versions explain other drawings and nothing else.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from report.proof.numbers import listed, number_differences, parsed
from report.proof.package import ReadPackage, guarded, mismatched, reader
from report.proof.shape import parts
from report.proof.sheets import Restated, changes
from report.proof.signatures import Signature
from report.proof.updates import Appended
from report.provenance.files import MANIFEST, RESULTS, Manifest, SourceFile
from report.provenance.software import NEVER_DRAWS, ROOT, distributions

SAME_VERSION, OTHER_VERSION = 1e-12, 1e-9
"""Relative tolerance of numbers that this version wrote elsewhere, and that another one wrote."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Proof:
    """The outcome of a comparison.

    Attributes
    ----------
    is_same : bool
        Nothing differs, and nothing was left out.
    how : str
        What agrees, or that it does not.
    differences : tuple of str
        Where the package differs from what its input gives, and by how much.
    not_compared : tuple of str
        What is drawn otherwise, as other versions may draw it.
    versions : tuple of str
        Software that the package names and that is not the same here.
    signed : tuple of Signature
        Fields that were signed after the package was written.
    """

    is_same: bool
    how: str
    differences: tuple[str, ...]
    not_compared: tuple[str, ...]
    versions: tuple[str, ...]
    signed: tuple[Signature, ...]

    @property
    def is_complete(self) -> bool:
        """Whether all was compared, and every signature checked."""
        return not self.not_compared and all(one.is_checked for one in self.signed)


class Written:
    """What `roofslip report` writes here from the input of a package, parsed."""

    def __init__(self, data: bytes) -> None:
        self.data = data
        self.pdf = reader(data)
        self.parts = parts(self.pdf)
        files = {file.name: file.content for file in self.pdf.attachment_list}
        self.manifest = Manifest.model_validate_json(files[MANIFEST])
        self.results = parsed(files[RESULTS], RESULTS)


def compared(package: ReadPackage, ours: Written, later: Appended, short: str) -> Proof:
    """Compare a package with what `roofslip report` writes from its input.

    Parameters
    ----------
    ours : Written
    later : Appended
        What was appended to the package.
    short : str
        The hash of the same input and the version that the package names
        (`report.provenance.files.fingerprint`).

    Raises
    ------
    InputError
        If the package is damaged or larger than any package.
    """
    others = _other_versions(package.manifest, ours.manifest)
    if package.first == ours.data:
        return _proof("to the last bit", later.others, later)
    is_old = package.manifest.roofslip_version != ours.manifest.roofslip_version
    tolerance = OTHER_VERSION if is_old else SAME_VERSION
    restated = _restated(ours.manifest, package.manifest)
    found = [*later.others, *mismatched(package), *_listing(package, ours, short, others)]
    found += listed(_results(package, ours, tolerance))
    is_redrawn = not others.keys() <= NEVER_DRAWS
    changed, drawn = guarded(
        lambda: changes(package.pdf, ours.pdf, ours.parts, restated, is_redrawn=is_redrawn)
    )
    how = f"words of every sheet, and numbers to {tolerance:g}"
    if not drawn:
        how += ", and every drawing"
    return _proof(how, [*found, *changed], later, drawn, others)


def _proof(
    how: str,
    found: Sequence[str],
    later: Appended,
    drawn: Sequence[str] = (),
    others: Mapping[str, str] | None = None,
) -> Proof:
    return Proof(
        is_same=not found and not drawn,
        how="differs" if found else how,
        differences=tuple(dict.fromkeys(found)),
        not_compared=tuple(drawn),
        versions=tuple((others or {}).values()),
        signed=tuple(later.signed),
    )


def failed(problems: Sequence[str], later: Appended) -> Proof:
    """Return the outcome of a package whose input does not run."""
    return _proof("", [*later.others, *(f"its input: {text}" for text in problems)], later)


def _other_versions(theirs: Manifest, ours: Manifest) -> Mapping[str, str]:
    """Return the software of a package that is another one here, as `numpy 2.4.5 (here 2.4.6)`."""
    here, there = ours.environment, theirs.environment
    return {
        name: f"{name} {there.get(name, 'none')} (here {here.get(name, 'none')})"
        for name in dict.fromkeys((*there, *here))
        if there.get(name) != here.get(name)
    }


def _restated(ours: Manifest, theirs: Manifest) -> Restated:
    """Return what gives our texts the versions and hashes that a package names."""
    new = {
        ours.hash: theirs.hash,
        ours.sbom_sha256: theirs.sbom_sha256,
        # Of several words, as in `CPython 3.11.2`, sheets print the last one.
        **{
            f"{name} {_last(version)}".lower(): _last(theirs.environment.get(name, ""))
            for name, version in ours.environment.items()
        },
    }
    old = re.compile(rf"\b(?:{'|'.join(map(re.escape, new))})\b", re.IGNORECASE)

    def one(found: re.Match[str]) -> str:
        name, blank, _ = found[0].rpartition(" ")
        return f"{name}{blank}{new[found[0].lower()]}"

    return lambda text: old.sub(one, " ".join(text.split()))


def _last(version: str) -> str:
    return version.split()[-1] if version.split() else "none"


def _listing(
    package: ReadPackage, ours: Written, short: str, others: Mapping[str, str]
) -> Iterator[str]:
    """Yield where the manifest is not what the versions that it names write from this input."""
    theirs, held = package.manifest, package.files.get(RESULTS, b"")
    own = SourceFile(path=RESULTS, name=RESULTS, content=held, kind="results").listed
    files = (own if file.kind == own.kind else file for file in ours.manifest.files)
    expected = ours.manifest.model_dump() | {
        "roofslip_version": theirs.environment.get(ROOT),
        "hash": short,
        "files": [file.model_dump() for file in files],
        "environment": theirs.environment,
    }
    if others:
        expected["sbom_sha256"] = theirs.sbom_sha256
    for text in number_differences(package.listing, expected, 0.0):
        yield f"{MANIFEST}: {text}"
    # Python, the system and native libraries are in no bill of materials.
    unlisted = ours.manifest.environment.keys() - distributions().keys()
    has_other_bill = not others.keys() <= unlisted
    if has_other_bill and theirs.sbom_sha256 == ours.manifest.sbom_sha256:
        yield f"{MANIFEST}: sbom_sha256 is that of the versions here, not of those that it names"


def _results(package: ReadPackage, ours: Written, tolerance: float) -> list[str]:
    # The version is told apart, and here it is that of the manifest.
    expected = ours.results | {"roofslip_version": package.manifest.roofslip_version}
    found = number_differences(package.results, expected, tolerance)
    return [f"{RESULTS}: {text}" for text in found]
