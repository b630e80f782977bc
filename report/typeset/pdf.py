"""From finished HTML to tagged PDF/A-3a, by the documented interface of the renderer.

Reads only the HTML, `data:` addresses and the fonts and styles in the template folder. Any warning
in the renderer's log is an internal error. WeasyPrint is imported where it is used: after
`load_renderer`, and not by what only asks where the templates are (half a second).
"""

from __future__ import annotations

import datetime as dt
import gc
import logging
import re
import sys
import tempfile
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from report.libraries import load_renderer
from report.typeset.finish import Attached, finish
from solver.errors import DefectError

_HERE = Path(__file__).resolve().parents[1]
# In a wheel the folder is inside the package, in a checkout beside it.
TEMPLATES = next(
    (path for path in (_HERE / "templates", _HERE.parent / "templates") if path.is_dir()),
    _HERE / "templates",
)
VARIANT = "pdf/a-3a"
_NO_DATE = dt.datetime(1980, 1, 1)
# Of addresses of the files of the template folder.
_SCHEME = "shipped:"
# Ratios and units that no line breaks behind their stroke, unlike the path of a file.
_WHOLE = re.compile(r"(\b(?:D/(?=C\b)|N/(?=W\b)|V/(?=N\b)|(?:in|mm)/(?=s\b)))")
_JOINED = "\\1\u2060"  # a word joiner: drawn as nothing, and not in the text of the PDF


def lay_out(
    html: str, attached: Sequence[Attached] = (), tell: Callable[[int], object] = int
) -> bytes:
    """Return the PDF of an HTML document; `shipped:/NAME` addresses a file of the templates.

    `tell` is told the number of its sheets.
    Raises `DefectError` with what the renderer logs as a warning or worse, and `ParseError` where
    the markup is not well-formed as XML.
    """
    load_renderer()
    # The renderer would mend broken markup without a word.
    tree = ElementTree.fromstring(html)
    files = sorted(attached, key=lambda file: file.name)
    with _clean_log(), warnings.catch_warnings(), _no_fonts_left():
        # The renderer leaves the file of its color profile to the garbage collector.
        warnings.simplefilter("ignore", ResourceWarning)
        return _laid_out(tree, files, tell)


def places_of(html: str) -> Mapping[str, float]:
    """Return how far below the upper edge each element with an id is, on an endless sheet [px].

    Without a log: what its pages refer to may be in parts that it does not have.
    """
    load_renderer()
    from weasyprint import CSS

    # The numbers of sheets, which are not known yet, take room as well.
    endless = CSS(
        string="@page { size: 8.5in 1000in !important } @page a4 { size: 8.27in 1000in !important }"
        " .contents p a::after { content: ': 99' !important }"
    )
    with warnings.catch_warnings(), _no_fonts_left():
        warnings.simplefilter("ignore", ResourceWarning)
        # On one sheet: how high each part is, is known before anything is broken over pages.
        (page,) = _parsed(ElementTree.fromstring(html)).render(stylesheets=[endless]).pages
    return {name: box[1] for name, box in page.anchors.items()}


def _laid_out(
    tree: ElementTree.Element, files: Sequence[Attached], tell: Callable[[int], object]
) -> bytes:
    pages = _parsed(tree).render()
    tell(len(pages.pages))
    created = pages.metadata.created
    date = dt.datetime.fromisoformat(created) if created else _NO_DATE
    pdf: bytes = pages.write_pdf(
        pdf_variant=VARIANT,
        attachments=[_attachment(file, date) for file in files],
        finisher=lambda document, objects: finish(document, objects, files),
    )
    return pdf


def _parsed(tree: ElementTree.Element) -> Any:
    """Return a parsed document for the renderer, with the joints that its lines need."""
    from cssselect2 import ElementWrapper
    from weasyprint import HTML

    for element in tree.iter():
        if element.text and element.tag != "style":
            element.text = _WHOLE.sub(_JOINED, element.text)
        if element.tail:
            element.tail = _WHOLE.sub(_JOINED, element.tail)

    class Parsed(HTML):  # type: ignore[misc]
        """A document that is not parsed again: a thirtieth of the time of a report."""

        def __init__(self) -> None:
            self.base_url, self.media_type, self.url_fetcher = f"{_SCHEME}/", "print", _fetcher()
            self.wrapper_element = ElementWrapper.from_html_root(tree, content_language=None)
            self.etree_element = self.wrapper_element.etree_element

    return Parsed()


def _fetcher() -> Any:
    """Return what the renderer loads addresses with: the templates and `data:`, no more."""
    from weasyprint.urls import URLFetcher, URLFetcherResponse

    class Shipped(URLFetcher):  # type: ignore[misc]
        """Serves the templates and `data:`; refuses everything else."""

        def fetch(self, url: str, headers: dict[str, str] | None = None) -> Any:
            if not url.startswith(_SCHEME):
                return super().fetch(url, headers)
            path = (TEMPLATES / url.removeprefix(_SCHEME).lstrip("/")).resolve()
            if not path.is_relative_to(TEMPLATES):
                raise ValueError(f"outside the templates: {url}")
            return URLFetcherResponse(url, path.read_bytes())

    # No file and no network: a text of the workbook that got into an address would fetch nothing.
    return Shipped(allowed_protocols=("data",))


def _attachment(file: Attached, date: dt.datetime) -> Any:
    """Return an attachment for the renderer."""
    # Its own date would be the time of writing: two runs are to give the same bytes.
    from weasyprint import Attachment

    return Attachment(
        string=file.content,
        name=file.name,
        description=file.description,
        relationship=file.relationship,
        created=date,
        modified=date,
    )


@contextmanager
def _no_fonts_left() -> Iterator[None]:
    """Have the files of fonts removed."""
    # The renderer leaves them to the garbage collector: they go with a folder of their own.
    usual = tempfile.tempdir
    is_windows = sys.platform == "win32"
    with tempfile.TemporaryDirectory("", "roofslip-", ignore_cleanup_errors=is_windows) as folder:
        tempfile.tempdir = folder
        try:
            yield
        finally:
            tempfile.tempdir = usual
            if is_windows:
                # It closes them: on Windows no open file is removed.
                gc.collect()


@contextmanager
def _clean_log() -> Iterator[None]:
    lines = _Lines(level=logging.WARNING)
    logger = logging.getLogger("weasyprint")
    logger.addHandler(lines)
    try:
        yield
    finally:
        logger.removeHandler(lines)
    if lines.messages:
        # It logs what it does not draw as meant: nobody would see it in a sealed document.
        raise DefectError(
            "the PDF renderer logged warnings:\n" + "\n".join(dict.fromkeys(lines.messages))
        )


class _Lines(logging.Handler):
    """Collects the logged lines."""

    def __init__(self, level: int) -> None:
        super().__init__(level)
        self.messages: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        """Append one line."""
        self.messages.append(record.getMessage())
