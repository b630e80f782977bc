"""What makes a cell required that is optional by itself, and what names must be.

`checks` yields an error where it is not so. Read `REQUIRED`, then `REFERENCES`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple

from report.sheet.schema import SECTION
from report.sheet.schema.choices import ObjectKind, RecordedAt, Scaling
from report.sheet.schema.fields import Draft, DraftRow, Finding, Place, Where
from report.sheet.schema.scene import ROOF, SIDES, WEIGHT_PARTS

Condition = Callable[[DraftRow, Draft], bool]
"""Whether a condition holds for a row of a draft; not where a cell could not be read."""


def _filled(*fields: str) -> Condition:
    return lambda row, _: any(row.get(field) not in (None, "") for field in fields)


def _chosen(field: str, *choices: str) -> Condition:
    return lambda row, _: row.get(field) in choices


def _is_directional(row: DraftRow, draft: Draft) -> bool:
    return row.get("directional") is True


def _has_no_outline(row: DraftRow, draft: Draft) -> bool:
    """Whether an array needs the four sides of a rectangle."""
    return "id" in row and all(vertex.get("name") != row["id"] for vertex in draft["outlines"])


def _lacks_parts(row: DraftRow, draft: Draft) -> bool:
    """Whether the weight of an array is not computed from its parts."""
    return all(part in row for part in WEIGHT_PARTS) and any(row[p] is None for p in WEIGHT_PARTS)


def _has_no_structure(row: DraftRow, draft: Draft) -> bool:
    """Whether a building of ground motions needs a period."""
    return (
        "structure" in row
        and row["structure"] is None
        and any(motion.get("recorded_at") is RecordedAt.GROUND for motion in draft["motions"])
    )


class Required(NamedTuple):
    """When an optional cell is required, and what would do where it is missing."""

    when: Condition
    wish: str


_OR_NONE = "give all four sides of the rectangle, or none"
_OR_OUTLINE = "give all four sides of the rectangle, or an outline on the sheet Outlines"
_LAW = "give high-velocity friction and friction rate, or neither"
_CODE = "give building code and year, or neither"
_CONFIRMED = "give who confirmed the drawing distances and when, or neither"
_CONFIRMATION = ("by", "date", "rule_set", "edition", "code")

REQUIRED: Mapping[tuple[str, str], Required] = {
    ("site", "building_code"): Required(_filled("building_code_year"), _CODE),
    ("site", "building_code_year"): Required(_filled("building_code"), _CODE),
    ("project", "drawing_confirmed_by"): Required(_filled("drawing_confirmed_date"), _CONFIRMED),
    ("project", "drawing_confirmed_date"): Required(_filled("drawing_confirmed_by"), _CONFIRMED),
    **{
        ("confirmation", field): Required(
            _filled(*_CONFIRMATION), "give all five cells of the confirmation, or none"
        )
        for field in _CONFIRMATION
    },
    **{("roof", side): Required(_filled(*SIDES), _OR_NONE) for side in SIDES},
    **{("arrays", side): Required(_has_no_outline, _OR_OUTLINE) for side in SIDES},
    **{("objects", side): Required(_filled(*SIDES), _OR_NONE) for side in SIDES},
    ("objects", "height_m"): Required(
        _chosen("kind", ObjectKind.EDGE_WITH_PARAPET), "give the parapet's height above the roof"
    ),
    ("arrays", "weight_n"): Required(
        _lacks_parts, "give it, or modules, module weight and ballast weight"
    ),
    ("arrays", "mu_fast"): Required(_filled("mu_rate_s_per_m"), _LAW),
    ("arrays", "mu_rate_s_per_m"): Required(_filled("mu_fast"), _LAW),
    ("motions", "scale_value"): Required(
        _chosen("scaling", Scaling.FACTOR, Scaling.PPA), "give the factor, or the PPA in g"
    ),
    ("building", "period_s"): Required(
        _has_no_structure, "give it, or a structure type: a motion is recorded at the ground"
    ),
    **{
        ("options", f"directional_{field}"): Required(
            _is_directional, "give it, or answer No to displacement by direction"
        )
        for field in ("reason", "reviewer", "license", "date")
    },
}
"""Optional cells that are required where others say so."""

UNIQUE = (("arrays", "objects"), ("motions",))
"""Tables whose ids differ from each other, without regard to capitals."""

REFERENCES: Mapping[tuple[str, str], tuple[str, ...]] = {
    ("clearances", "array"): ("arrays",),
    ("clearances", "object"): ("objects", "arrays"),
    ("links", "array"): ("arrays",),
    ("outlines", "name"): ("arrays", "objects"),
}
"""Fields that name a row of other tables; an outline may be that of the roof."""

OTHER_NAMES: Mapping[tuple[str, str], str] = {("outlines", "name"): ROOF}

MAX_SLOPE_DEG = 45.0
"""Slope of an array from which it is refused."""

ORDERED = (("x_from_m", "x_to_m"), ("y_from_m", "y_to_m"))
"""Fields of which the second is larger, where a table has them."""


def missing(draft: Draft, where: Where) -> Iterator[Finding]:
    """Yield the cells that are required by others, and blank."""
    for (section, field), required in REQUIRED.items():
        for index, row in enumerate(draft[section]):
            is_blank = field in row and row[field] in (None, "")
            if is_blank and required.when(row, draft):
                found = f"{SECTION[section].entry(field).spoken} is missing"
                yield Finding.error(Place(section, index, field), found, required.wish)
