"""What makes a cell required or wrong, each as one expression: tested on a draft, and a formula.

`checks` yields an error where an expression holds, and `needs` counts cells by its formula, so that
a tick of the sheet and `roofslip check` agree. Read `REQUIRED`, then `REFERENCES`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from report.sheet.schema import SECTION
from report.sheet.schema.choices import ObjectKind, RecordedAt, Scaling
from report.sheet.schema.fields import Draft, DraftRow, Finding, Place, Where, YesNo
from report.sheet.schema.layout import literal
from report.sheet.schema.scene import ROOF, SIDES, WEIGHT_PARTS

Refer = Callable[[str], str]
"""Returns the reference to a field of the row or block of a formula."""


@dataclass(frozen=True, slots=True)
class Condition:
    """A condition on the cells of a row: whether it holds for a row of a draft, and for cells."""

    holds: Callable[[DraftRow, Draft], bool]  # not where a cell could not be read
    formula: Callable[[Refer], str]


def _filled(*fields: str) -> Condition:
    return Condition(
        lambda row, _: any(row.get(field) not in (None, "") for field in fields),
        lambda refer: f'TRIM({"&".join(map(refer, fields))})<>""',
    )


def _chosen(field: str, *choices: str) -> Condition:
    def formula(refer: Refer) -> str:
        tests = [f'TRIM({refer(field)})="{choice}"' for choice in choices]
        return tests[0] if len(tests) == 1 else f"OR({','.join(tests)})"

    return Condition(lambda row, _: row.get(field) in choices, formula)


def _yes(field: str) -> Condition:
    return Condition(
        lambda row, _: row.get(field) is True, lambda refer: f'TRIM({refer(field)})="{YesNo.YES}"'
    )


def _on_the_sheet(formula: Callable[[Refer], str]) -> Condition:
    """Return a condition of the sheet alone, of which other modules tell."""
    return Condition(lambda row, draft: False, formula)


# An array needs the four sides of a rectangle.
_NO_OUTLINE = Condition(
    lambda row, draft: (
        "id" in row and all(vertex.get("name") != row["id"] for vertex in draft["outlines"])
    ),
    lambda refer: f"COUNTIF(live_outlines,{literal(refer('id'))})=0",
)
# The weight of an array is computed from its parts.
_LACKS_PARTS = Condition(
    lambda row, _: (
        all(part in row for part in WEIGHT_PARTS) and any(row[p] is None for p in WEIGHT_PARTS)
    ),
    lambda refer: f"""OR({",".join(f'TRIM({refer(part)})=""' for part in WEIGHT_PARTS)})""",
)
# A building of ground motions needs a period.
_NO_STRUCTURE = Condition(
    lambda row, draft: (
        "structure" in row
        and row["structure"] is None
        and any(motion.get("recorded_at") is RecordedAt.GROUND for motion in draft["motions"])
    ),
    lambda refer: f'AND(live_ground_motions>0,TRIM({refer("structure")})="")',
)


@dataclass(frozen=True, slots=True)
class Required:
    """When an optional cell is required, and what would do where it is missing.

    Without a wish, other modules tell that it is missing.
    """

    when: Condition
    wish: str = ""


_OR_NONE = "give all four sides of the rectangle, or none"
_OR_OUTLINE = "give all four sides of the rectangle, or an outline on the sheet Outlines"
_LAW = "give high-velocity friction and friction rate, or neither"
_CODE = "give building code and year, or neither"
_CONFIRMED = "give who confirmed the drawing distances and when, or neither"
# A pasted column does not state them.
_PASTED = _on_the_sheet(lambda refer: f'ISNUMBER(FIND("!",{refer("record")}))')

REQUIRED: Mapping[tuple[str, str], Required] = {
    ("site", "s_ds_g"): Required(_on_the_sheet(lambda _: 'live_s_ds=""')),
    ("site", "s_d1_g"): Required(_on_the_sheet(lambda _: 'AND(live_to_design,live_s_d1="")')),
    ("target", "t_l_s"): Required(_on_the_sheet(lambda _: "live_to_design")),
    ("site", "building_code"): Required(_filled("building_code_year"), _CODE),
    ("site", "building_code_year"): Required(_filled("building_code"), _CODE),
    ("project", "drawing_confirmed_by"): Required(_filled("drawing_confirmed_date"), _CONFIRMED),
    ("project", "drawing_confirmed_date"): Required(_filled("drawing_confirmed_by"), _CONFIRMED),
    **{("roof", side): Required(_filled(*SIDES), _OR_NONE) for side in SIDES},
    **{("arrays", side): Required(_NO_OUTLINE, _OR_OUTLINE) for side in SIDES},
    **{("objects", side): Required(_filled(*SIDES), _OR_NONE) for side in SIDES},
    ("objects", "height_m"): Required(
        _chosen("kind", ObjectKind.EDGE_WITH_PARAPET), "give the parapet's height above the roof"
    ),
    ("arrays", "weight_n"): Required(
        _LACKS_PARTS, "give it, or modules, module weight and ballast weight"
    ),
    ("arrays", "mu_fast"): Required(_filled("mu_rate_s_per_m"), _LAW),
    ("arrays", "mu_rate_s_per_m"): Required(_filled("mu_fast"), _LAW),
    ("motions", "units"): Required(_PASTED),
    ("motions", "dt_s"): Required(_PASTED),
    ("motions", "scale_value"): Required(
        _chosen("scaling", Scaling.FACTOR, Scaling.PPA), "give the factor, or the PPA in g"
    ),
    ("building", "period_s"): Required(
        _NO_STRUCTURE, "give it, or a structure type: a motion is recorded at the ground"
    ),
    # Lacking ones are a condition of the package.
    **{
        ("options", f"peer_{field}"): Required(_yes("peer_reviewed"))
        for field in ("reviewer", "license", "date", "letter")
    },
    **{
        ("options", f"directional_{field}"): Required(
            _yes("directional"), "give it, or answer No to displacement by direction"
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
        for index, row in enumerate(draft[section] if required.wish else ()):
            is_blank = field in row and row[field] in (None, "")
            if is_blank and required.when.holds(row, draft):
                found = f"{SECTION[section].entry(field).spoken} is missing"
                yield Finding.error(Place(section, index, field), found, required.wish)
