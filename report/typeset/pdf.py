"""From finished HTML to tagged PDF/A-3a, by the documented interface of the renderer.

Reads only the HTML, `data:` addresses and the fonts and styles in the template folder. Any warning
in the renderer's log is an internal error.
"""

from __future__ import annotations

import datetime as dt
import logging
import re
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Future
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from report.typeset.drawings import Converted, DeferredPicture, convert
from report.typeset.finish import Attached, finish
from report.typeset.renderer import discard, document, is_tried, load, shipped
from solver.model import DefectError

_HERE = Path(__file__).resolve().parents[1]
# In a wheel the folder is inside the package, in a checkout beside it.
TEMPLATES = next(
    (path for path in (_HERE / "templates", _HERE.parent / "templates") if path.is_dir()),
    _HERE / "templates",
)
VARIANT = "pdf/a-3a"
_NO_DATE = dt.datetime(1980, 1, 1)
_PICTURE = re.compile(r' src="(data:image/svg\+xml;base64,[^"]+)"')


def pictures(html: str) -> list[str]:
    """Return the `data:` addresses of the SVG pictures in an HTML document."""
    return list(dict.fromkeys(_PICTURE.findall(html)))


def draw_ahead(sources: Sequence[str]) -> dict[str, Converted]:
    """Convert pictures for `lay_out`, in any process; none where the renderer is not tried.

    Raises
    ------
    DefectError
        As `lay_out`.
    """
    if not is_tried():
        return {}
    with _clean_log():
        return convert(sources, TEMPLATES / "package.css")


def lay_out(
    html: str,
    drawn: Mapping[str, Future[Converted]] = {},
    attached: Callable[[], Sequence[Attached]] = tuple,
) -> bytes:
    """Return the PDF of an HTML document; `shipped:/NAME` addresses a file of the templates.

    Parameters
    ----------
    html : str
        Well-formed as XML.
    drawn : mapping of str to Future, optional
        What `draw_ahead` returns for pictures, by the address in the document; each is waited for
        when it is painted.
    attached : callable
        Returns the attachments; asked once the pages are painted.

    Raises
    ------
    DefectError
        If the renderer logs a line of warning level or above; with these lines.
    ParseError
        If the markup is not well-formed.
    """
    load()
    from weasyprint.text.fonts import FontConfiguration

    with _clean_log(), warnings.catch_warnings():
        # The renderer leaves the file of its color profile to the garbage collector.
        warnings.simplefilter("ignore", ResourceWarning)
        given = document(html, shipped(TEMPLATES))
        fonts = FontConfiguration()
        shown = (
            {source: DeferredPicture(source, one, fonts) for source, one in drawn.items()}
            if is_tried()
            else {}
        )
        try:
            pages = given.render(font_config=fonts, cache=shown)
            files: list[Attached] = []

            def attachments() -> Iterator[Any]:
                files.extend(sorted(attached(), key=lambda file: file.name))
                yield from (_attachment(file, pages.metadata.created) for file in files)

            pdf: bytes = pages.write_pdf(
                pdf_variant=VARIANT,
                attachments=attachments(),
                finisher=lambda pages, objects: finish(pages, objects, files),
            )
        finally:
            discard(fonts)
    return pdf


def _attachment(file: Attached, date: str | None) -> Any:
    """Return an attachment for the renderer, without the time of day at which it is written."""
    from weasyprint import Attachment

    day = dt.datetime.fromisoformat(date) if date else _NO_DATE
    return Attachment(
        string=file.content,
        name=file.name,
        description=file.description,
        relationship=file.relationship,
        created=day,
        modified=day,
    )


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
