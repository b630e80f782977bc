"""The cover: project, verdict with the governing numbers, codes and attachments. Read `cover`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from markupsafe import Markup

from report.assessment.arrays import ArrayAssessment
from report.assessment.clearances import ClearanceCheck
from report.assessment.friction import mu_words
from report.document.tables import Table, TableRow, stamp
from report.entities.columns import TableColumn
from report.pages.front import verdict_sentence
from report.pages.parts import PackageData, nan_is_worst
from report.pages.references import codes
from report.provenance.files import SHORT, holds_records, record_bytes, record_paths
from report.words.counts import counted
from report.words.units import number


def cover(package: PackageData) -> Mapping[str, object]:
    """Return the cover."""
    project = package.data.project
    return {
        "name": project.name,
        "block": (
            ("Project number", project.number),
            ("Client", project.client or "—"),
            ("Address", project.address or "—"),
            ("Prepared by", project.prepared_by),
            ("Checked by", project.checked_by or "not yet checked"),
            ("Date", project.date.isoformat()),
            ("Revision", project.revision),
            ("Verdict", _verdict(package)),
            *_governing(package),
            ("Applicable codes", _applicable(package)),
            ("In this file", "; ".join(_attached(package))),
            ("Beside it", "results.xlsx, results.json, plan.dxf"),
            ("Verification", _verification(package)),
        ),
        "revisions": _revisions(package),
    }


def _verdict(package: PackageData) -> Markup:
    return Markup("{} {}").format(stamp(package.assessment.verdict), verdict_sentence(package))


def _governing(package: PackageData) -> Iterator[tuple[str, str]]:
    array = _governing_array(package)
    verdict = package.assessment.array_verdict(array)
    mark = "" if verdict.is_permitted else f"{verdict.value}; "
    design = package.fmt.both(array.design_m) + package.design_mark(array)
    yield (
        "Governing array",
        f"{array.id}: {mark}μ {mu_words(array.array.friction)}; design displacement "
        f"{design}, governed by: {array.source}",
    )
    gap = governing_clearance(package)
    yield (
        "Governing clearance",
        "none given"
        if gap is None
        else f"{gap.clearance.array} to {gap.clearance.object}: D/C {gap.ratio_words}",
    )


def _governing_array(package: PackageData) -> ArrayAssessment:
    """Return the array with the largest design displacement, of those that are NG if any is."""
    arrays, verdict_of = package.assessment.arrays, package.assessment.array_verdict
    return max(
        [array for array in arrays if not verdict_of(array).is_permitted] or arrays,
        key=lambda array: nan_is_worst(array.design_m),
    )


def governing_clearance(package: PackageData) -> ClearanceCheck | None:
    """Return the clearance with the largest required / provided separation, if any."""
    gaps = package.assessment.clearances
    return max(gaps, key=lambda gap: nan_is_worst(gap.demand_capacity), default=None)


def _applicable(package: PackageData) -> str:
    """Return the title of the rule set and the other codes and standards that apply."""
    rules = package.assessment.rules
    others = [code.cited for code in codes(package) if code.cited != rules.name]
    return "; ".join((rules.title, *others))


def _attached(package: PackageData) -> Iterator[str]:
    """Yield what the package holds as attachments."""
    sheet, records = package.assessment.sheet, package.assessment.shaking.records
    yield f"workbook {sheet.path.name} (SHA-256 {sheet.sha256[:SHORT]}…)"
    count = counted(len(record_paths(records)), "record file")
    if holds_records(records):
        yield count
    else:
        yield (
            f"not the {count}, {number(record_bytes(records) / 1e6, 1)} MB in all: "
            f"{package.part('records')} has their SHA-256"
        )
    yield "results.json"


def _verification(package: PackageData) -> str:
    records = package.assessment.shaking.records
    option = "" if holds_records(records) else " --records FOLDER"
    return (
        f"roofslip verify-package FILE{option} computes this package again from the workbook and "
        "the records and compares every sheet. Hash of workbook, records and version, at the foot "
        f"of every sheet: {package.fingerprint}"
    )


def _revisions(package: PackageData) -> Table:
    project = package.data.project
    rows = [
        (row.revision, row.date.isoformat(), row.description, row.by or "—")
        for row in package.data.revisions
    ] or [(project.revision, project.date.isoformat(), "First issue", project.prepared_by)]
    return Table(
        caption="",
        columns=(
            TableColumn(head="Rev.", share=0.6, align="left"),
            TableColumn(head="Date", share=1.2, align="left"),
            TableColumn(head="Description", share=4.0, align="left"),
            TableColumn(head="By", share=1.8, align="left"),
        ),
        rows=tuple(TableRow(cells=cells) for cells in rows),
    )
