"""The numbered parts of a document, in general and for sections from templates.

Read `filled`.
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
    """A numbered section."""

    id: str  # anchor
    title: str  # heading
    template: str  # path below the templates; it heads its subsections with `sub`
    content: Mapping[str, Any]  # what the template prints, by name
    charts: Mapping[str, str]  # SVG by name


def section(
    name: str, title: str, /, *, id: str = "", charts: Mapping[str, str] = {}, **content: Any
) -> Section:
    """Return the section of a template by its path without ending, whose last part is its id."""
    id = id or name.rpartition("/")[2]
    return Section(id=id, title=title, template=f"{name}.html", content=content, charts=charts)


def filled(
    folder: Path, sections: Sequence[Section], context: Mapping[str, Any]
) -> Iterator[tuple[Part, Markup]]:
    """Yield each section with its numbers, and its HTML; every template may print the context."""
    for count, section in enumerate(sections, start=1):
        part = Part(id=section.id, number=str(count), title=section.title)
        below: list[Part] = []

        # As defaults: called later, it would number below the last section of the loop.
        def sub(title: str, part: Part = part, below: list[Part] = below) -> Part:
            last = f"{len(below) + 1}"
            below.append(Part(id=f"{part.id}-{last}", number=f"{part.number}.{last}", title=title))
            return below[-1]

        values = {"template": section.template, "drawings": section.charts, "sub": sub}
        # The template numbers its subsections as it is printed: only then are the parts below
        # known.
        html = rendered(folder, "section.html", {**context, **section.content, **values})
        yield replace(part, parts=tuple(below)), Markup(html)
