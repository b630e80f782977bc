"""The files of a package with their hashes, the software, and the references."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from report.pages.parts import PackageData
from report.pages.symbols import friction_standard
from report.provenance.package_sources import (
    SHORT,
    holds_records,
    record_bytes,
    record_paths,
    versions,
)
from report.text.counts import counted
from report.text.units import NO_BREAK, number

# Of each edition of ASCE 7: its year, and the editions of the code and of AC156 that go with it.
_EDITIONS = {
    "ASCE 7-16": ("2017", "2018 or 2021", "2010, with the height factor of ASCE/SEI 7-16"),
    "ASCE 7-22": ("2022", "2024", "AC156-24, 2024"),
}


def page(package: PackageData) -> Mapping[str, object]:
    """Return notes on the records, what is attached, the software, and what is cited."""
    done, site = package.assessment, package.data.site
    records, edition = done.shaking.records, site.edition.name
    published, code_edition, ac156 = _EDITIONS[edition]
    is_by_velocity = not all(array.friction.is_constant for array in package.data.arrays)
    return {
        "notes": list(_notes(package)),
        "documents": [
            f"{document.label}, {document.path}, {number(document.size / 1000.0, 1)}{NO_BREAK}kB, "
            f"{document.sha256[:12]}…"
            for document in done.source.documents
        ],
        "software": ", ".join(f"{name} {version}" for name, version in versions().items()),
        "workbook": done.source.path.name,
        "short_hash": done.source.sha256[:SHORT],
        "record_files": counted(len(record_paths(records)), "record file"),
        "has_files": holds_records(records),
        "files_mb": number(record_bytes(records) / 1e6, 1),
        "has_motions": done.has_motions,
        "fingerprint": package.fingerprint,
        "has_seaoc": not done.rules.name.startswith("ASCE"),
        "edition": edition,
        "edition_number": edition.removeprefix("ASCE "),
        "published": published,
        "code": done.rules.values["ibc_max_slope_deg"].clause,
        "code_name": "California" if site.building_code == "CBC" else "International",
        "code_edition": "" if site.building_code else code_edition,
        "ac156": ac156,
        "friction_standard": friction_standard(package),
        "cites_building_response": package.has_ground,
        "cites_friction_by_velocity": is_by_velocity,
    }


def _notes(package: PackageData) -> Iterator[str]:
    """Yield the notes on each record file, and facts that no sheet of it shows."""
    for file in package.assessment.shaking.records:
        name = f"{file.motion_id} {file.component}"
        for note in file.notes:
            yield f"{name}: {note}"
        for cell in file.unseen:
            yield f"{name}: {cell.words} on the {cell.sheet} worksheet: {cell.kind}"
