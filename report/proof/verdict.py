"""What a package shows, held against what its input gives. Read `compared`.

The same versions on the same kind of system write the same bytes. Elsewhere sheets are compared
word by word and numbers to a tolerance.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import dataclass
from functools import partial
from typing import Any

from defusedxml.ElementTree import fromstring
from pypdf import PdfReader
from pypdf.generic import StreamObject

from report.proof.numbers import listed, number_differences, word_differences
from report.proof.objects import MISSING, differences, information
from report.proof.package import Manifest, Package, guarded, mismatched, reader
from report.proof.updates import Appended
from report.provenance.files import MANIFEST, RESULTS

SAME_VERSION, OTHER_VERSION = 1e-12, 1e-9
"""Relative tolerance of numbers that this version wrote elsewhere, and that another one wrote."""

_XMP = "{http://ns.adobe.com/xap/1.0/}"
_REWRITTEN = (f"{_XMP}ModifyDate", f"{_XMP}MetadataDate")


@dataclass(frozen=True, slots=True, kw_only=True)
class Proof:
    """The outcome of a comparison.

    Attributes
    ----------
    is_same : bool
    how : str
        What agrees, or that it does not.
    differences : tuple of str
        Where the package differs from what its input gives, and by how much.
    versions : tuple of str
        Software of the package that is not the same here.
    signed : tuple of str
        Fields that were signed after the package was written.
    """

    is_same: bool
    how: str
    differences: tuple[str, ...]
    versions: tuple[str, ...]
    signed: tuple[str, ...]


def compared(package: Package, computed: bytes, later: Appended) -> Proof:
    """Compare a package with what `roofslip report` writes from its input.

    Parameters
    ----------
    computed : bytes
        The PDF that it writes.
    later : Appended
        What was appended to the package.
    """
    ours = _Written(computed)
    others = _other_versions(package.manifest, ours.manifest)
    if package.first == computed:
        return _proof("to the last bit", later.others, (), later)
    found = [*later.others, *mismatched(package)]
    is_old = package.manifest.roofslip_version != ours.manifest.roofslip_version
    tolerance = OTHER_VERSION if is_old else SAME_VERSION
    found += listed(_results(package, ours, tolerance))
    found += guarded(lambda: [*_sheets(package, ours, is_twin=not others)])
    how = f"words of every sheet, and numbers to {tolerance:g}"
    if not others:
        how += ", and every drawing"
    return _proof(how, found, others, later)


class _Written:
    """What the input of a package gives here."""

    def __init__(self, computed: bytes) -> None:
        self.pdf = reader(computed)
        self.files = {file.name: file.content for file in self.pdf.attachment_list}
        self.manifest = Manifest.model_validate_json(self.files[MANIFEST])


def _proof(how: str, found: Sequence[str], others: Sequence[str], later: Appended) -> Proof:
    return Proof(
        is_same=not found,
        how="differs" if found else how,
        differences=tuple(dict.fromkeys(found)),
        versions=tuple(others),
        signed=tuple(later.signed),
    )


def failed(problems: Sequence[str], later: Appended) -> Proof:
    """Return the outcome of a package whose input does not run."""
    return _proof("", [*later.others, *(f"its input: {text}" for text in problems)], (), later)


def _other_versions(theirs: Manifest, ours: Manifest) -> tuple[str, ...]:
    """Return the software of a package that is another one here, as `numpy 2.4.5 (here 2.4.6)`."""
    here, there = ours.environment, theirs.environment
    return tuple(
        f"{name} {there.get(name, 'none')} (here {here.get(name, 'none')})"
        for name in dict.fromkeys((*there, *here))
        if there.get(name) != here.get(name)
    )


def _results(package: Package, ours: _Written, tolerance: float) -> list[str]:
    found = number_differences(package.results, ours.files[RESULTS], tolerance)
    return [f"{RESULTS}: {text}" for text in found]


def _sheets(package: Package, ours: _Written, *, is_twin: bool) -> Iterator[str]:
    """Yield where sheets differ: in words; in annotations; and if versions agree, in anything."""
    theirs = package.pdf
    names = {
        package.manifest.hash: ours.manifest.hash,
        package.manifest.sbom_sha256: ours.manifest.sbom_sha256,
        **_software(package.manifest, ours.manifest),
    }
    changed: set[int] = set()
    for at, (one, two) in enumerate(zip(theirs.pages, ours.pdf.pages, strict=False)):
        if is_twin and _content(one) == _content(two):
            continue
        words = word_differences(_replaced(one.extract_text(), names), two.extract_text())
        if words:
            changed.add(at)
            yield from (f"sheet {at + 1}: {text}" for text in listed(words))
    if is_twin:
        own = {package.results, package.files[MANIFEST]}
        places = differences(theirs, ours.pdf, partial(_is_told_apart, own))
        yield from listed([p for p in places if not p.startswith(_told(changed))])
    else:
        yield from _annotations(theirs, ours.pdf)
        yield from _information(theirs, ours.pdf)
    if len(theirs.pages) != len(ours.pdf.pages):
        yield f"it has {len(theirs.pages)} sheets; the input gives {len(ours.pdf.pages)}"


def _told(changed: set[int]) -> tuple[str, ...]:
    return tuple(f"sheet {at + 1} /Contents" for at in changed)


def _content(page: Any) -> bytes:
    content = page.get_contents()
    return b"" if content is None else content.get_data()


def _software(theirs: Manifest, ours: Manifest) -> Mapping[str, str]:
    """Return the versions that the records page prints, theirs to ours."""
    return {
        f"{name} {version}": f"{name} {ours.environment[name]}"
        for name, version in theirs.environment.items()
        if name in ours.environment and version != ours.environment[name]
    }


def _replaced(text: str, names: Mapping[str, str]) -> str:
    """Return a text with its versions and hashes as they are here."""
    words = " ".join(text.split())
    for old, new in names.items():
        words = words.replace(old, new)
    return words


def _is_told_apart(own: Set[bytes], place: str, one: Any, two: Any) -> bool:
    """Whether a difference is told by another comparison, or is the date of a rewriting."""
    if one is MISSING or two is MISSING:
        return False
    if place == "document /Info /ModDate":
        return True
    if place == "document /Metadata":
        return _facts(one) == _facts(two)
    # Results and manifest are compared number by number.
    return isinstance(one, StreamObject) and one.get_data() in own


def _facts(metadata: Any) -> list[tuple[str, str, Any]]:
    """Return what the metadata of a document state, without the date of a rewriting."""
    items = fromstring(metadata.get_data()).iter()
    return [
        (item.tag, (item.text or "").strip(), sorted(item.items()))
        for item in items
        if item.tag not in _REWRITTEN
    ]


def _annotations(theirs: PdfReader, ours: PdfReader) -> Iterator[str]:
    for count, pages in enumerate(zip(theirs.pages, ours.pages, strict=False), start=1):
        one, two = (
            [str(item.get_object().get("/Subtype")) for item in page.get("/Annots", ())]
            for page in pages
        )
        if one != two:
            yield f"sheet {count}: {len(one)} annotations; the input gives {len(two)}"


def _information(theirs: PdfReader, ours: PdfReader) -> Iterator[str]:
    """Yield what the information of two documents says differently, versions and dates apart."""
    one, two = (information(pdf) for pdf in (theirs, ours))
    if one is MISSING or two is MISSING:
        yield "document /Info"
        return
    for key in sorted({*one.keys(), *two.keys()} - {"/ModDate", "/Producer"}):
        if one.get(key) != two.get(key):
            yield f"document /Info {key}"


def as_json(proof: Proof) -> str:
    """Return the outcome as JSON."""
    return json.dumps(
        {
            "is_same": proof.is_same,
            "how": proof.how,
            "differences": proof.differences,
            "versions": proof.versions,
            "signed": proof.signed,
        },
        ensure_ascii=False,
    )
