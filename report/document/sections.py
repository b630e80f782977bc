"""Sections of a document, numbered: each is a template with its words and what that prints.

Owns no content. Read `filled`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from markupsafe import Markup

from report.document.templates import rendered


@dataclass(frozen=True, slots=True, kw_only=True)
class Part:
    """A numbered part of the package; `parts` are those below it."""

    id: str
    number: str
    title: str
    parts: tuple[Part, ...] = field(default=())


@dataclass(frozen=True, slots=True, kw_only=True)
class Section:
    """A numbered section.

    Attributes
    ----------
    id, title : str
        Anchor and heading.
    template : str
        Path below the templates. It heads its subsections with `sub`.
    content : mapping
        What the template prints, by name.
    charts : mapping of str to str
        SVG by name.
    """

    id: str
    title: str
    template: str
    content: Mapping[str, Any]
    charts: Mapping[str, str]


def section(
    name: str, title: str, /, *, id: str = "", charts: Mapping[str, str] = {}, **content: Any
) -> Section:
    """Return the section of a template by its path without ending, whose last part is its id."""
    id = id or name.rpartition("/")[2]
    return Section(id=id, title=title, template=f"{name}.html", content=content, charts=charts)


def filled(
    folder: Path, sections: Sequence[Section], context: Mapping[str, Any]
) -> Iterator[tuple[Part, Markup]]:
    """Yield each section with its numbers, and its HTML below its heading.

    Parameters
    ----------
    folder : Path
        Of the templates.
    context : mapping
        What every template may print.
    """
    for count, section in enumerate(sections, start=1):
        yield _filled(folder, section, str(count), context)


def _filled(
    folder: Path, section: Section, number: str, context: Mapping[str, Any]
) -> tuple[Part, Markup]:
    part = Part(id=section.id, number=number, title=section.title)
    below: list[Part] = []

    def sub(title: str) -> Part:
        count = len(below) + 1
        below.append(Part(id=f"{part.id}-{count}", number=f"{number}.{count}", title=title))
        return below[-1]

    given = {"template": section.template, "drawings": section.charts, "sub": sub}
    html = rendered(folder, "section.html", {**context, **section.content, **given})
    return replace(part, parts=tuple(below)), Markup(html)
