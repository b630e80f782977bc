"""From workbook to package: read, prepare, assess, support, fill, lay out, publish. Read `make`."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from report.assessment.assessment import Assessment
    from report.assessment.revision_changes import Changes
    from report.motions.prepare import Shaking
    from report.project.read.workbook_data import Sheet
    from report.results.model import Compared

PAGE = "calc-package.html"
OUTPUTS = ("calc-package.pdf", PAGE, "plan.dxf", "results.xlsx", "results.json")

STEPS = (0.03, 0.2, 0.18, 0.58, 0.01)
"""Usual shares of the time of the steps that `make` reports, as for `projects/example`."""


@dataclass(frozen=True, slots=True)
class Step:
    """A step of `make`, with a hint for a terminal."""

    doing: str
    hint: str = ""

    def __str__(self) -> str:
        return f"{self.doing} ({self.hint})" if self.hint else self.doing


class Made(NamedTuple):
    """A package that was written."""

    assessment: Assessment
    folder: Path
    files: Mapping[str, bytes]  # by name
    changes: Changes
    sheets: int  # of the PDF


def make(
    source: Path,
    out: Path | None,
    since: Path | None,
    progress: Callable[[Step], None],
    on_record: Callable[[str], None] | None = None,
    *,
    has_page: bool = True,
) -> Made:
    """Read a workbook, run its motions, and write the package and the tables.

    With `on_record`, the workbook gets what its confirmations cover, and `on_record` a line on
    that. `has_page` says whether it is also written as one file for a browser.
    """
    from report.assessment.assess import assess
    from report.assessment.support.evidence import support
    from report.drawing.items import write_dxf
    from report.drawing.plan import plan_drawing
    from report.package.html import pages
    from report.page_file.page import page
    from report.provenance.files import attachments, fingerprint, sources
    from report.results.changes import with_reissue
    from report.results.publish import publish
    from report.results.results_json import results_json
    from report.results.xlsx import results_xlsx
    from report.typeset.pdf import lay_out
    from solver.kernels.compiler import is_compiled
    from solver.kernels.two_axes import slide_plane

    progress(Step("reading the workbook"))
    former, since_bytes = _former(since)
    sheet, folder = _read(source, out, since)
    shaking = _prepared(sheet)
    if on_record and _record(sheet, shaking, on_record):
        sheet, folder = _read(source, out, since)
        shaking = _prepared(sheet)
    files = sources(sheet, shaking, since_bytes)

    hint = "" if is_compiled(slide_plane) else "the first run compiles the solver"
    progress(Step("running the motions", hint))
    assessment = assess(sheet, shaking)
    if former:
        assessment = with_reissue(assessment, former)
    changes = _changes(former, assessment)
    evidence = support(assessment)

    progress(Step("writing the pages"))
    html = pages(assessment, evidence, changes)
    plan = write_dxf(plan_drawing(assessment))
    tables = results_xlsx(assessment, evidence.spectra)
    results = results_json(assessment, evidence)

    progress(Step("laying out the package"))
    sheets: list[int] = []
    short = fingerprint(sheet, shaking)
    pdf = lay_out(html, attachments(files, results, short), sheets.append)

    progress(Step("writing the result tables"))
    shown = page(html, assessment, short, results) if has_page else b""
    written = zip(OUTPUTS, (pdf, shown, plan, tables, results), strict=True)
    made = {name: content for name, content in written if content}
    publish(made, folder, OUTPUTS)
    return Made(assessment, folder, made, changes, *sheets)


def _former(since: Path | None) -> tuple[Compared | None, bytes]:
    """Return former results and their file, if any: what reads them is loaded only then."""
    if since is None:
        return None, b""
    from report.results.publish import STAMP, warn_if_mixed
    from report.results.results_json import read_former

    if os.path.lexists(since.parent / STAMP):
        warn_if_mixed(since.parent, OUTPUTS)
    return read_former(since)


def _read(source: Path, out: Path | None, since: Path | None) -> tuple[Sheet, Path]:
    """Read a workbook, and check that its package can be written to the folder returned."""
    from report.project.read.read import read
    from report.results.publish import check_apart, check_of_workbook, output_folder
    from report.typeset.letters import check_letters

    sheet = read(source)
    check_letters(sheet)
    folder = output_folder(out, sheet.path.parent, "out", OUTPUTS)
    beside = [sheet.path.parent / document.path for document in sheet.documents]
    if out is None:
        check_of_workbook(folder, "results.json", sheet.path.name)
    check_apart(OUTPUTS, folder, [sheet.path, *([since] if since else []), *beside])
    return sheet, folder


def _prepared(sheet: Sheet) -> Shaking:
    """Read and process the records; warn of motions that came from other sources."""
    from report.motions.prepare import prepare
    from report.project.check.finding_lines import lines
    from report.results.motions import other_sources

    shaking = prepare(sheet)
    for line in lines(other_sources(sheet), sheet.addresses):
        warnings.warn(f"{line.cell}: {line.text}", stacklevel=2)
    return shaking


def _record(sheet: Sheet, shaking: Shaking, tell: Callable[[str], None]) -> bool:
    """Fill in what confirmations cover beside their dates; return whether the workbook changed."""
    from report.project.check.covered import to_record
    from report.project.read.what_if import cells
    from report.project.write.filled import changing
    from solver.model import InputError

    lines = to_record(sheet.project, shaking.hashes).items()
    # Earlier workbooks do not have the cells.
    new = cells(sheet, {place: text for place, text in lines if place in sheet.addresses})
    if not new:
        return False
    where = f"{sheet.path}: {', '.join(position.address for position in new)}"
    try:
        with changing(sheet.path, keeps_copy=False) as change:
            if change.book.sha256 != sheet.sha256 or not os.access(sheet.path, os.W_OK):
                raise InputError("the workbook is read-only, or was saved meanwhile")
            change.note(new)
    except (InputError, OSError) as error:
        tell(f"{where}: what was confirmed is not put on record: {error}")
        return False
    tell(f"{where}: what was confirmed is on record")
    return True


def _changes(former: Compared | None, assessment: Assessment) -> Changes:
    from report.assessment.revision_changes import NO_FORMER

    if former is None:
        return NO_FORMER
    from report.results.changes import changes, check_listed

    changed = changes(former, assessment)
    check_listed(changed)
    return changed
