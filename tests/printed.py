"""What a reader finds on one page of the calculation package: its words, and its tables by heading.

A page is made the way that `report.package` makes it, from the evidence that it asks for alone,
with its figures not drawn and without layout. Tests read pages here, whatever makes them.
"""

from __future__ import annotations

import datetime as dt
import re
from collections import OrderedDict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import packages
from report.assessment.evidence import (
    accuracy,
    beyond_corners,
    building_variations,
    cases,
    cumulative,
    histories,
)
from report.assessment.project import Assessment
from report.assessment.remedies import remedies
from report.assessment.spectra import spectra
from report.assessment.uncertainty import uncertainty
from report.document.templates import Section
from report.manual.render import manual_html, this_machine
from report.package.html import part
from report.pages.parts import PackageData
from report.pages.registry import PAGES, draw_assessment, draw_plotted, package_data
from report.project.model.choices import PackageEdition
from report.study.files import study_html
from report.study.results import StudyResults
from solver.verification.evidence import Verification

FRONT = ("cover", "contents", "letter")
IDS = tuple(page.id for page in PAGES)


class Page(str):
    """The words of a page: a paragraph, a row of a table or a point of a list on each line."""

    tables: tuple[Table, ...]

    def table(self, title: str) -> Table:
        """Return the table whose caption, or the heading above it, begins so."""
        found = [table for table in self.tables if table.title.startswith(title)]
        assert found, f"no table {title!r} among {[table.title for table in self.tables]}"
        return found[0]

    def line(self, start: str) -> str:
        """Return the one line that begins so."""
        (found,) = [line for line in self.splitlines() if line.removeprefix("- ").startswith(start)]
        return found.removeprefix("- ")

    def equation(self, start: str) -> list[str]:
        """Return the lines below the equation whose LaTeX begins so: numbers, source, notes."""
        lines = self.splitlines()
        (at,) = (k for k, line in enumerate(lines) if line.startswith(f"[{start}"))
        below = lines[at + 1 :]
        return below[: next(k for k, line in enumerate(below) if line.startswith("[") or not line)]

    @property
    def facts(self) -> dict[str, str]:
        """What stands beside each label, in tables without headings."""
        return {
            label: value
            for table in self.tables
            if not table.headings
            for label, value, *_ in table.cells
        }


@dataclass(frozen=True)
class Table:
    """A table of a page; a heading is followed by its unit: `PRD [in]`."""

    title: str
    headings: tuple[str, ...]
    cells: tuple[tuple[str, ...], ...]
    notes: tuple[str, ...]
    kinds: tuple[str, ...]
    bold: tuple[str, ...]

    @property
    def rows(self) -> list[dict[str, str]]:
        """The rows, each cell by its heading."""
        return [dict(zip(self.headings, row, strict=True)) for row in self.cells]

    def row(self, first: str) -> dict[str, str]:
        """Return the one row with such a name in its first column or, failing that, cell in any."""
        found = [row for row in self.cells if first in row[0].split(", ")] or [
            row for row in self.cells if first in row
        ]
        assert len(found) == 1, (first, self.cells)
        return dict(zip(self.headings, found[0], strict=True))

    def column(self, heading: str) -> list[str]:
        """Return the cells below a heading."""
        return [row[heading] for row in self.rows]


def printed(given: Assessment | PackageData, id: str, **evidence: object) -> Page:
    """Return a page of a package by its id, or `cover`, `contents` or `letter`.

    `evidence` replaces what would be computed of the fields of that name.
    """
    return _source(given, evidence).page(id)


def study(results: StudyResults) -> Page:
    """Return the pages of a study."""
    with packages.undrawn():
        return read(study_html(results))


def manual(verification: Verification, *sections: Section) -> Page:
    """Return the cover of the manual and some of its sections."""
    return read(manual_html(verification, sections, this_machine(), dt.date(2026, 3, 5)))


class _Evidence:
    """The fields of `report.assessment.evidence.Evidence`, each computed when it is asked for."""

    def __init__(self, assessment: Assessment, given: Mapping[str, object]) -> None:
        self._assessment = assessment
        self.__dict__.update(given)

    highpass = cached_property(lambda self: beyond_corners(self._assessment))
    remedies = cached_property(lambda self: remedies(self._assessment))
    uncertainty = cached_property(lambda self: uncertainty(self._assessment))
    cumulative = cached_property(lambda self: cumulative(self._assessment))
    building = cached_property(lambda self: building_variations(self._assessment))
    cases = cached_property(lambda self: tuple(cases(self._assessment, self.building)))
    spectra = cached_property(lambda self: spectra(self._assessment))
    histories = cached_property(lambda self: histories(self._assessment))
    accuracy = cached_property(lambda self: accuracy(self._assessment))


class _Pictures(dict):
    """Pictures without drawings, by the id of their part."""

    def __init__(self, package: PackageData, evidence: _Evidence) -> None:
        self._drawn = self._draw(package, evidence)

    @staticmethod
    def _draw(package: PackageData, evidence: _Evidence) -> Iterator[Mapping]:
        yield draw_assessment(package)
        yield draw_plotted(package, evidence)

    def __missing__(self, id: str) -> object:
        with packages.undrawn():
            self.update(next(self._drawn))
        return self[id]


class _Source:
    """A package whose pages are made as they are asked for."""

    def __init__(self, package: PackageData, evidence: Mapping[str, object]) -> None:
        self.package = package
        self._evidence = _Evidence(package.assessment, evidence)
        self._pictures = _Pictures(package, self._evidence)
        self._pages: dict[str, Page] = {}

    def page(self, id: str) -> Page:
        if id not in self._pages:
            self._pages[id] = read(part(self.package, self._evidence, id, self._pictures))
        return self._pages[id]


_sources: OrderedDict[tuple, tuple[object, _Source]] = OrderedDict()


def _source(given: Assessment | PackageData, evidence: Mapping[str, object]) -> _Source:
    """Return the last packages made, by their identity."""
    key = (id(given), *((name, id(value)) for name, value in evidence.items()))
    if key not in _sources:
        package = given
        if isinstance(given, Assessment):
            package = package_data(given, edition=PackageEdition.COMPLETE)
        _sources[key] = ((given, evidence), _Source(package, evidence))
        while len(_sources) > 8:
            _sources.popitem(last=False)
    return _sources[key][1]


def read(html: str) -> Page:
    """Return the words of a page before its layout."""
    page = ElementTree.fromstring(html)
    lines: list[str] = []
    tables: list[Table] = []
    running = [page.get("data-head"), *page.get("data-foot", "").splitlines()]
    body = page.find("body")
    cover = body.find("section[@class='cover']")
    if cover is not None:
        lines.extend(" ".join(line.split()) for line in running if line)
    _read(body, lines, tables, [""])
    made = Page("\n".join(lines) + "\n")
    made.tables = tuple(tables)
    return made


BLOCKS = ("p", "li", "figcaption", "div", "ul", "ol", "section", "figure", "table", "h1", "h2")
MARKS = {"h1": "\n# ", "h2": "\n## ", "li": "- "}


def _read(element: Element, lines: list[str], tables: list[Table], titles: list[str]) -> None:
    """Add the lines and tables of an element; `titles` ends with what was said last above."""
    start = len(lines)
    if element.tag == "table":
        tables.append(_table(element, titles[0], lines))
        return
    if not any(child.tag in BLOCKS for child in element):
        mark = MARKS.get(element.tag, "")
        lines.extend(mark + line for line in _words(element).splitlines() if line)
        if element.tag in ("h1", "h2") or element.get("class") == "caption":
            titles[:] = [_words(element)]
        elif element.get("class") == "note" and tables:
            last = tables[-1]
            tables[-1] = replace(last, notes=(*last.notes, *lines[start:]))
        return
    own = Element("span")
    own.text = element.text
    for child in element:
        if child.tag in BLOCKS:
            _close(own, element, lines)
            own = Element("span")
            _read(child, lines, tables, titles)
            own.text = child.tail
        else:
            own.append(child)
    _close(own, element, lines)


def _close(own: Element, element: Element, lines: list[str]) -> None:
    words = _words(own)
    if words:
        lines.append(MARKS.get(element.tag, "") + words)


def _words(element: Element) -> str:
    """Return the words of an element; a line break in it ends a line."""
    text = re.sub(r"[ \u00a0\t\r\n]+", " ", "".join(_pieces(element)))
    return "\n".join(line.strip() for line in text.split("\x00"))


def _pieces(element: Element) -> Iterator[str]:
    if element.tag == "br":
        yield "\x00"
    if element.tag == "img":
        yield f"[{element.get('alt')}]"
    if "data-no" in element.attrib:
        yield f"{element.get('data-no')} "
    if element.get("class") == "to":
        yield f"({element.get('href')})"
    if element.tag == "sup":
        yield "^"
    if element.get("class") == "frac":
        above, below = ("".join(_pieces(child)) for child in element)
        yield f"({above})/({below})" if " " in above else f"{above}/{below}"
        return
    if element.tag == "small":
        yield "\x00"  # it stands below what is before it
    yield element.text or ""
    for child in element:
        yield from _pieces(child)
        yield child.tail or ""


def _table(table: Element, title: str, lines: list[str]) -> Table:
    def cells(row: Element) -> Iterator[str]:
        for cell in row:
            yield " ".join(_words(cell).split())
            yield from [""] * (int(cell.get("colspan", 1)) - 1)

    def line(row: Element) -> str:
        return " | ".join(" ".join(_words(cell).split()) for cell in row).rstrip(" |")

    head = list(table.findall("thead/tr"))
    body = list(table.findall("tbody/tr"))
    headings: list[str] = []
    if head:
        merged = [
            text
            for cell in head[0]
            for text in [" ".join(_words(cell).split())] * int(cell.get("colspan", 1))
        ]
        units = list(cells(head[1])) if len(head) > 1 else [""] * len(merged)
        for text, unit in zip(merged, units, strict=True):
            name = f"{text} [{unit}]" if unit else text
            again = sum(known.partition("#")[0] == name for known in headings)
            headings.append(f"{name}#{again + 1}" if again else name)
    lines.extend(map(line, (*head, *body)))
    return Table(
        title=title,
        headings=tuple(headings),
        cells=tuple(tuple(cells(row)) for row in body),
        notes=(),
        kinds=tuple(row.get("class", "") for row in body),
        bold=tuple(_words(b) for row in body for b in row.iter("b")),
    )
