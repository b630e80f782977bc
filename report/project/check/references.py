"""Ids that differ from each other, and fields that name a row of another table."""

from __future__ import annotations

from collections.abc import Mapping

# Tables whose ids differ from each other, without regard to capitals.
UNIQUE = (("arrays", "objects"), ("motions",))


# Fields that name a row of other tables; an outline may be that of the roof.
REFERENCES: Mapping[tuple[str, str], tuple[str, ...]] = {
    ("clearances", "array"): ("arrays",),
    ("clearances", "object"): ("objects", "arrays"),
    ("links", "array"): ("arrays",),
    ("outlines", "name"): ("arrays", "objects"),
}
