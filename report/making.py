"""From workbook to package: read, prepare, assess, support, fill, lay out, publish.

Orders the steps; each is a function of a room below. A worker (`report.workers`) draws and writes
what it can meanwhile. Read `make`.
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor, Future
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from report.assessment.changes import Changes
    from report.assessment.evidence import Evidence
    from report.assessment.project import Assessment
    from report.entities.results import Compared
    from report.motions.prepare import Shaking
    from report.provenance.files import SourceFile
    from report.sheet.reading.read import Sheet
    from report.typeset.drawings import Converted
    from report.typeset.equations import Equations
    from report.typeset.finish import Attached

OUTPUTS = ("calc-package.pdf", "plan.dxf", "results.xlsx", "results.json")

STEPS = (0.16, 0.35, 0.09, 0.38, 0.02)
"""Usual shares of the time of the steps that `make` reports, as for `projects/example`."""


@dataclass(frozen=True, slots=True)
class Step:
    """A step of `make`: what it takes where that is long, or else a hint for a terminal."""

    doing: str
    cost: str = ""
    hint: str = ""

    def __str__(self) -> str:
        more = self.cost or self.hint
        return f"{self.doing} ({more})" if more else self.doing


def make(
    source: Path,
    out: Path | None,
    since: Path | None,
    progress: Callable[[Step], None],
    worker: Executor,
    on_assessment: Callable[[Assessment], None] = lambda _: None,
    on_record: Callable[[str], None] | None = None,
) -> tuple[Assessment, Path, Mapping[str, bytes], Changes]:
    """Read a workbook, run its motions, and write the package and the tables.

    `on_assessment` is given the assessment before the package is made, which takes longer. With
    `on_record`, the workbook gets what its confirmations cover, and `on_record` a line on that.
    """
    worker.submit(load)  # before the imports below, so that both processes import at once
    from report.assessment.project import assess
    from report.results.publish import publish
    from solver.kernels.compiler import is_compiled

    progress(Step("reading the workbook"))
    request = read(source, out, since)
    prepared = prepare(request)
    if on_record and _record(request.sheet, prepared.shaking, on_record):
        request = read(source, out, since)
        prepared = prepare(request)
    hint = "" if is_compiled() else "the first run compiles the solver"
    progress(Step("running the motions", prepared.cost, hint))
    assessment = assess(request.sheet, prepared.shaking)
    if request.since:
        from report.results.compare import with_reissue

        assessment = with_reissue(assessment, request.former[0])
    on_assessment(assessment)
    supported = support(assessment, request, worker)
    progress(Step("writing the pages"))
    pages = fill(assessment, supported, worker)
    progress(Step("laying out the package"))
    files = lay_out(pages, assessment, supported.evidence, prepared.sources, worker)
    progress(Step("writing the result tables"))
    publish(files, request.folder)
    return assessment, request.folder, files, supported.changes


@dataclass(frozen=True, slots=True, kw_only=True)
class Request:
    """What is asked for.

    Attributes
    ----------
    former : tuple of Compared
        The results that these are compared with, if any.
    since : bytes
        Their file; empty for none.
    """

    sheet: Sheet
    folder: Path
    former: tuple[Compared, ...]
    since: bytes


def read(source: Path, out: Path | None, since: Path | None) -> Request:
    """Read a workbook and former results, and check that the package can be written."""
    from report.results.publish import check_apart, check_of_workbook, output_folder
    from report.sheet.reading.read import read
    from report.typeset.letters import check_letters

    former, content = _former(since)
    sheet = read(source)
    check_letters(sheet)
    folder = output_folder(out, sheet.path.parent, "out", OUTPUTS)
    beside = [sheet.path.parent / document.path for document in sheet.documents]
    if out is None:
        check_of_workbook(folder, "results.json", sheet.path.name)
    check_apart(OUTPUTS, folder, [sheet.path, *([since] if since else []), *beside])
    return Request(sheet=sheet, folder=folder, former=former, since=content)


def _former(since: Path | None) -> tuple[tuple[Compared, ...], bytes]:
    """Return former results and their file, if any: what reads them is loaded only then."""
    if since is None:
        return (), b""
    from report.results.publish import STAMP, warn_if_mixed
    from report.results.since import read_former

    if os.path.lexists(since.parent / STAMP):
        warn_if_mixed(since.parent, OUTPUTS)
    former, content = read_former(since)
    return (former,), content


@dataclass(frozen=True, slots=True, kw_only=True)
class Prepared:
    """The motions at the roof, the files that all is computed from, and what a long run costs."""

    shaking: Shaking
    sources: Sequence[SourceFile]
    cost: str


def prepare(request: Request) -> Prepared:
    """Read and process the records; every file is kept as it was read."""
    from report.assessment.cost import cost
    from report.motions.prepare import prepare
    from report.provenance.files import sources
    from report.results.sources import other_sources
    from report.sheet.checking.findings import lines

    shaking = prepare(request.sheet)
    for line in lines(other_sources(request.sheet), request.sheet.addresses):
        warnings.warn(f"{line.cells}: {line.finding.text}", stacklevel=2)
    return Prepared(
        shaking=shaking,
        sources=sources(request.sheet, shaking, request.since),
        cost=cost(request.sheet.project, shaking),
    )


def _record(sheet: Sheet, shaking: Shaking, tell: Callable[[str], None]) -> bool:
    """Fill in what confirmations cover beside their dates; return whether the workbook changed."""
    from report.sheet.checking.covered import to_record
    from report.sheet.reading.what_if import cells
    from report.sheet.writing.filled import changing
    from solver.model import InputError

    found = to_record(sheet.project, shaking.hashes).items()
    # Earlier workbooks do not have the cells.
    new = cells(sheet, {place: text for place, text in found if place in sheet.addresses})
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


@dataclass(frozen=True, slots=True, kw_only=True)
class Supported:
    """What the package prints beside the assessment, and its equations, which are being typeset."""

    evidence: Evidence
    changes: Changes
    equations: Future[Equations]


def support(assessment: Assessment, request: Request, worker: Executor) -> Supported:
    """Compute what supports an assessment, while the worker typesets the equations."""
    from report.assessment.evidence import support

    changes = _changes(assessment, request)
    equations = worker.submit(_equations, assessment, changes)
    return Supported(evidence=support(assessment), changes=changes, equations=equations)


def _changes(assessment: Assessment, request: Request) -> Changes:
    from report.assessment.changes import NO_FORMER

    if not request.since:
        return NO_FORMER
    from report.results.compare import changes
    from report.results.since import check_listed

    found = changes(request.former[0], assessment)
    check_listed(found)
    return found


@dataclass(frozen=True, slots=True, kw_only=True)
class FilledPages:
    """The pages as HTML, and the addresses of the pictures that they only name."""

    html: str
    undrawn: frozenset[str]


def fill(assessment: Assessment, supported: Supported, worker: Executor) -> FilledPages:
    """Return the pages; the worker fills them in while this process loads the renderer."""
    from report.typeset.renderer import load

    about = (assessment, supported.evidence, supported.changes)
    pages = worker.submit(_pages, *about, supported.equations.result())
    load()
    return pages.result()


def lay_out(
    pages: FilledPages,
    assessment: Assessment,
    evidence: Evidence,
    found: Sequence[SourceFile],
    worker: Executor,
) -> Mapping[str, bytes]:
    """Return the files of the package; the worker draws and writes tables during the layout."""
    from report.typeset.pdf import lay_out, pictures
    from report.typeset.renderer import is_tried

    # First those that the layout waits for: a picture that is only named has no size until drawn.
    sources = sorted(pictures(pages.html), key=lambda source: source not in pages.undrawn)
    drawn = {source: worker.submit(_drawn, source) for source in sources} if is_tried() else {}
    written = worker.submit(_written, assessment, evidence, found)
    pdf = lay_out(pages.html, drawn, lambda: written.result()[1])
    return dict(zip(OUTPUTS, (pdf, *written.result()[0]), strict=True))


# What follows runs in the worker: only there is loaded what draws and writes.


_undrawn: dict[str, Callable[[], str]] = {}
"""How the pictures are drawn that the pages filled in last only name, by their addresses."""


def _equations(*about: Any) -> Equations:
    from report.package.html import equations

    return equations(*about)


def _pages(
    assessment: Assessment, evidence: Evidence, changes: Changes, equations: Equations
) -> FilledPages:
    from report.package.html import pages
    from report.pages.pictures import Later, at_once
    from report.typeset.renderer import is_tried

    global _undrawn
    later = Later()
    draw = later if is_tried() else at_once
    html = pages(assessment, evidence, changes, equations, draw)
    _undrawn = later.undrawn
    return FilledPages(html=html, undrawn=frozenset(_undrawn))


def _drawn(source: str) -> Converted:
    """Return a picture for the pages, drawn now if they only name it."""
    from report.typeset.equations import data_uri
    from report.typeset.pdf import draw_ahead

    drawn = data_uri(_undrawn.pop(source)()) if source in _undrawn else source
    return draw_ahead([drawn])[drawn]


def _written(
    assessment: Assessment, evidence: Evidence, found: Sequence[SourceFile]
) -> tuple[tuple[bytes, bytes, bytes], tuple[Attached, ...]]:
    """Return plan.dxf, results.xlsx and results.json, and what the package has attached."""
    from report.drawing.dxf import write_dxf
    from report.drawing.plan import plan_drawing
    from report.provenance.files import attachments, fingerprint
    from report.results.json import results_json
    from report.results.xlsx import results_xlsx

    plan = write_dxf(plan_drawing(assessment))
    table, results = results_xlsx(assessment, evidence.spectra), results_json(assessment, evidence)
    short = fingerprint(assessment.sheet, assessment.shaking)
    return (plan, table, results), attachments(found, results, short)


def load() -> None:
    """Import what draws and writes, while the other process reads and runs."""
    import report.drawing.dxf
    import report.figures.charts
    import report.results.xlsx  # noqa: F401
    from report.figures.base import load_fonts
    from report.package.html import typeset_ahead
    from report.provenance.software import sbom_sha256
    from report.typeset.pdf import draw_ahead

    load_fonts()
    typeset_ahead()
    draw_ahead([])
    sbom_sha256()  # reads what is said of every installed library
