"""From workbook to package: read, prepare, assess, lay out, publish. Read `make`.

made = make(Path("projects/example"), None, None, print)
print(made.assessment.verdict, made.folder / "calc-package.pdf")
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import NamedTuple

from report.assessment.assess import assess
from report.assessment.assessment import Assessment
from report.assessment.revision_changes import NO_FORMER, Changes
from report.assessment.support.evidence import support
from report.drawing.plan_dxf import write_dxf
from report.drawing.plan_layers import plan_drawing
from report.motions.prepare import Shaking, prepare
from report.package.html import pages
from report.page_file.page import page
from report.project.check.covered import to_record
from report.project.check.finding_lines import lines
from report.project.model.choices import PackageEdition
from report.project.read.read import read
from report.project.read.what_if import cells
from report.project.read.workbook_data import Sheet
from report.project.write.filled import changing
from report.provenance.package_sources import attachments, fingerprint, sources
from report.results.added_motions import other_sources
from report.results.publish import (
    OUTPUTS,
    STAMP,
    check_apart,
    check_of_workbook,
    output_folder,
    publish,
    warn_if_mixed,
)
from report.results.results_json import read_former, results_json
from report.results.revision_comparison import changes, check_listed, with_reissue
from report.results.xlsx import results_xlsx
from report.steps import Step
from report.typeset.letters import check_letters
from report.typeset.pdf import lay_out
from solver.errors import InputError
from solver.kernels.compiler import is_compiled
from solver.kernels.two_axes import slide_plane


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
    progress(Step("reading the workbook"))
    earlier, earlier_bytes = None, b""
    if since:
        if os.path.lexists(since.parent / STAMP):
            warn_if_mixed(since.parent, OUTPUTS)
        earlier, earlier_bytes = read_former(since)
    sheet, folder, motions = _read_inputs(source, out, since)
    if on_record and _record_confirmations(sheet, motions, on_record):
        # The package is that of the workbook as it now is.
        sheet, folder, motions = _read_inputs(source, out, since)
    files = sources(sheet, motions, earlier_bytes)

    hint = "" if is_compiled(slide_plane) else "the first run compiles the solver"
    progress(Step("running the motions", hint))
    assessment = assess(sheet, motions)
    changed = NO_FORMER
    if earlier:
        # Before the changes: a revision that is issued again is a condition of this package, and
        # one of its changes.
        assessment = with_reissue(assessment, earlier)
        changed = changes(earlier, assessment)
        check_listed(changed)
    evidence = support(assessment)

    progress(Step("writing the pages"))
    html = pages(assessment, evidence, changed)
    plan = write_dxf(plan_drawing(assessment))
    tables = results_xlsx(assessment, evidence.spectra)
    results = results_json(assessment, evidence)

    progress(Step("laying out the package"))
    sheet_counts: list[int] = []
    short = fingerprint(sheet.source, motions)
    pdf = lay_out(html, attachments(files, results, short), sheet_counts.append)
    if assessment.project.options.package_edition is PackageEdition.LETTER and sheet_counts[0] > 2:
        fault = f"edition is letter, which has two sheets; this input requires {sheet_counts[0]}"
        raise InputError(f"Options: {fault}: choose plan check, or 11 x 17 or A3 for the roof plan")

    progress(Step("writing the result tables"))
    browser_page = page(html, assessment, short, results) if has_page else b""
    contents = zip(OUTPUTS, (pdf, browser_page, plan, tables, results), strict=True)
    outputs = {name: content for name, content in contents if content}
    # Last, and all at once: a run that fails leaves the files of the one before.
    publish(outputs, folder, OUTPUTS)
    return Made(assessment, folder, outputs, changed, *sheet_counts)


def _read_inputs(source: Path, out: Path | None, since: Path | None) -> tuple[Sheet, Path, Shaking]:
    """Read a workbook and its records, and check that its package can be written to the folder.

    Warns of motions that came from other sources.
    """
    sheet = read(source)
    # Before the runs, as all that can refuse the input is: they take most of the time.
    check_letters(sheet)
    folder = output_folder(out, sheet.path.parent, "out", OUTPUTS)
    if out is None:
        check_of_workbook(folder, "results.json", sheet.path.name)
    inputs = [sheet.path.parent / document.path for document in sheet.documents]
    check_apart(OUTPUTS, folder, [sheet.path, *([since] if since else []), *inputs])
    motions = prepare(sheet)
    for line in lines(other_sources(sheet), sheet.addresses):
        warnings.warn(f"{line.cell}: {line.text}", stacklevel=2)
    return sheet, folder, motions


def _record_confirmations(sheet: Sheet, motions: Shaking, tell: Callable[[str], None]) -> bool:
    """Fill in what confirmations cover beside their dates; return whether the workbook changed."""
    texts = {}
    for place, text in to_record(sheet.project, motions.hashes).items():
        if place in sheet.addresses:  # earlier workbooks do not have the cells
            texts[place] = text
    positions = cells(sheet, texts)
    if not positions:
        return False
    where = f"{sheet.path}: {', '.join(position.address for position in positions)}"
    try:
        with changing(sheet.path, keeps_copy=False) as change:
            # What was read, and not what somebody saved since, is what was confirmed.
            if change.book.sha256 != sheet.sha256 or not os.access(sheet.path, os.W_OK):
                raise InputError("the workbook is read-only, or was saved in the meantime")
            change.note(positions)
    except (InputError, OSError) as error:
        tell(f"{where}: the confirmed inputs were not recorded: {error}")
        return False
    tell(f"{where}: the confirmed inputs were recorded")
    return True
