"""What the workbooks of earlier versions call things: they go on being read.

A name that changes is entered here and in the changelog; nothing is ever taken out.
"""

from __future__ import annotations

from collections.abc import Mapping

LABELS: Mapping[tuple[str, str], tuple[str, ...]] = {
    ("site", "stories"): ("Storeys",),
}
"""Earlier labels and headings, by section and field."""

FIELDS: Mapping[tuple[str, str], tuple[str, ...]] = {
    ("site", "stories"): ("storeys",),
}
"""Earlier names of a field, which defined names of cells end with."""

CHOICES: dict[str, str] = {}
"""Earlier choices, in small letters, and what they are called now."""

PROVISIONS: Mapping[str, str] = {"max_storeys": "max_stories"}
"""Earlier keys of provisions to override, and what they are called now."""
