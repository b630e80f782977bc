"""Loads the renderer, gives it its documents, and says which addresses it may load.

Here and in `drawings` it is used beyond its documentation, which a later version need not keep:
only in the versions `TRIED`. Others make the same pages more slowly. Read `is_tried`, then `load`.
"""

from __future__ import annotations

import ctypes.util
import re
import sys
from contextlib import suppress
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

TRIED = {"weasyprint": "70.0", "pydyf": "0.13.0"}
"""Versions whose undocumented parts are as they are used here.

Without them `roofslip report projects/example` takes 1.22 times as long, and 33 MB more of 490:
medians of whole processes in five pairs. What each saves is said where it is.
"""

SCHEME = "shipped:"
"""Of addresses of the files of a folder."""


def is_tried() -> bool:
    """Whether the renderer may be used beyond its documented interface."""
    return all(version(name) == tried for name, tried in TRIED.items())


@cache
def load() -> None:
    """Import the renderer without asking a compiler where its libraries are.

    It tries each library under the names of several systems. For those that the loader does not
    know, Python starts the compiler and the linker: fifty processes, 0.25 s or 4 % of the report of
    the example. On Linux the last name of each is the one that the loader knows.
    """
    asking = ctypes.util.find_library
    if sys.platform == "linux" and is_tried():
        ctypes.util.find_library = lambda name: None
    try:
        import weasyprint  # noqa: F401
    finally:
        ctypes.util.find_library = asking


def document(html: str, fetcher: Any) -> Any:
    """Return a document for the renderer, of markup that is well-formed as XML.

    Raises
    ------
    ParseError
        If it is not; the renderer itself mends broken markup without a word.
    """
    from weasyprint import HTML

    root = ElementTree.fromstring(html)
    where = {"base_url": f"{SCHEME}/", "url_fetcher": fetcher}
    return _lean()(root, **where) if is_tried() else HTML(string=html, **where)


@cache
def _lean() -> Any:
    """Return a class of documents from XML, without notes on their pages.

    It saves 5 % of the time of the report of the example, and 42 MB of 490. The renderer reads any
    HTML, by a parser that takes fifteen times as long. Its own styles give every element five
    pseudo-elements for notes and a marker.
    """
    from cssselect2 import ElementWrapper
    from weasyprint import CSS, HTML
    from weasyprint.html import UA

    ours = re.sub(r"^::(foot)?note-.*$", "", UA, flags=re.MULTILINE)
    sheet = CSS(string=re.sub(r"^::marker", "li::marker", ours, flags=re.MULTILINE))

    class LeanHtml(HTML):  # type: ignore[misc]
        """A document with fewer styles to begin with, whose markup is read already."""

        def __init__(self, root: ElementTree.Element, **where: Any) -> None:
            super().__init__(string="<html></html>", **where)
            self.wrapper_element = ElementWrapper.from_html_root(root, content_language=None)
            self.etree_element = self.wrapper_element.etree_element

        def _ua_stylesheets(self, forms: bool = False) -> list[Any]:
            return [sheet]

    return LeanHtml


def shipped(folder: Path) -> Any:
    """Return what the renderer loads addresses with: files of a folder and `data:`, no more."""
    from weasyprint.urls import URLFetcher, URLFetcherResponse

    class Shipped(URLFetcher):  # type: ignore[misc]
        """Serves the folder and `data:`; refuses everything else."""

        def fetch(self, url: str, headers: dict[str, str] | None = None) -> Any:
            if not url.startswith(SCHEME):
                return super().fetch(url, headers)
            path = (folder / url.removeprefix(SCHEME).lstrip("/")).resolve()
            if not path.is_relative_to(folder):
                raise ValueError(f"outside the templates: {url}")
            return URLFetcherResponse(url, path.read_bytes())

    return Shipped(allowed_protocols=("data",))


def discard(fonts: Any) -> None:
    """Remove the files of fonts now: what still refers to them may outlive every collection."""
    with suppress(AttributeError):  # if a later version leaves none
        fonts.__del__()
