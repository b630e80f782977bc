"""A section of the manual: its template has its name."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from report.document.sections import Section


def section(id: str, title: str, charts: Mapping[str, str] = {}, **content: Any) -> Section:
    """Return a section of what its template prints, by name, and its charts as SVG by name."""
    template = f"manual/{id}.html"
    return Section(id=id, title=title, template=template, content=content, charts=charts)
