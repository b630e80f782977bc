"""What makes a cell required or wrong, each as one expression: tested on a draft, and a formula.

`checks` yields an error where an expression holds, and `needs` counts cells by its formula, so that
a tick of the sheet and `roofslip check` agree. Read `REQUIRED`, then `REFERENCES`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Protocol

from report.sheet.schema import ROOF, SECTIONS, SIDES, ObjectKind, RecordedAt, Scaling
from report.sheet.schema.fields import Draft, DraftRow, Finding, Place, entries
from report.sheet.schema.layout import literal

Refer = Callable[[str], str]
"""Returns the reference to a field of the row or block of a formula."""


class Condition(Protocol):
    """A condition on the cells of a row."""

    def holds(self, row: DraftRow, draft: Draft) -> bool:
        """Whether it holds for a row of a draft; not where a cell could not be read."""
        ...

    def formula(self, refer: Refer) -> str:
        """Return the same for cells."""
        ...


@dataclass(frozen=True, slots=True)
class Filled:
    """Whether any of some fields is given."""

    fields: tuple[str, ...]

    def holds(self, row: DraftRow, draft: Draft) -> bool:
        """Return whether any is given."""
        return any(row.get(field) not in (None, "") for field in self.fields)

    def formula(self, refer: Refer) -> str:
        """Return whether any is given."""
        return f'TRIM({"&".join(map(refer, self.fields))})<>""'


@dataclass(frozen=True, slots=True)
class Chosen:
    """Whether a field is one of some choices; of a question, whether the answer is Yes."""

    field: str
    choices: tuple[str, ...] = ("Yes",)

    def holds(self, row: DraftRow, draft: Draft) -> bool:
        """Return whether one of them is chosen."""
        value = row.get(self.field)
        return value is True or value in self.choices

    def formula(self, refer: Refer) -> str:
        """Return whether one of them is chosen."""
        tests = [f'{refer(self.field)}="{choice}"' for choice in self.choices]
        return tests[0] if len(tests) == 1 else f"OR({','.join(tests)})"


class NoOutline:
    """Whether an array has no outline, so that it needs the four sides of a rectangle."""

    def holds(self, row: DraftRow, draft: Draft) -> bool:
        """Return whether no row of the outlines names it."""
        return "id" in row and all(vertex.get("name") != row["id"] for vertex in draft["outlines"])

    def formula(self, refer: Refer) -> str:
        """Return whether no row of the outlines names it."""
        return f"COUNTIF(live_outlines,{literal(refer('id'))})=0"


class NoPeriod:
    """Whether the building needs a period: of ground motions, without a type of structure."""

    def holds(self, row: DraftRow, draft: Draft) -> bool:
        """Return whether a motion is a ground motion, and no structure is chosen."""
        grounds = (m.get("recorded_at") is RecordedAt.GROUND for m in draft["motions"])
        return "structure" in row and row["structure"] is None and any(grounds)

    def formula(self, refer: Refer) -> str:
        """Return whether a motion is a ground motion, and no structure is chosen."""
        return f'AND(live_ground_motions>0,TRIM({refer("structure")})="")'


@dataclass(frozen=True, slots=True)
class SheetCondition:
    """A condition of the sheet alone, of which other modules tell: `Required.wish` is empty."""

    text: str

    def holds(self, row: DraftRow, draft: Draft) -> bool:
        """Return that this module does not tell."""
        return False

    def formula(self, refer: Refer) -> str:
        """Return the condition."""
        name = self.text.partition("{")[2].partition("}")[0]
        return self.text.replace(f"{{{name}}}", refer(name)) if name else self.text


@dataclass(frozen=True, slots=True)
class Required:
    """When an optional cell is required, and what would do where it is missing."""

    when: Condition
    wish: str = ""


_OR_NONE = "give all four sides of the rectangle, or none"
_OR_OUTLINE = "give all four sides of the rectangle, or an outline on the sheet Outlines"
_LAW = "give high-velocity friction and friction rate, or neither"
_PASTED = SheetCondition('ISNUMBER(FIND("!",{record}))')  # a pasted column does not state them
_REVIEWED, _BY_DIRECTION = Chosen("peer_reviewed"), Chosen("directional")

REQUIRED: Mapping[tuple[str, str], Required] = {
    ("site", "s_ds_g"): Required(SheetCondition('live_s_ds=""')),
    **{("roof", side): Required(Filled(SIDES), _OR_NONE) for side in SIDES},
    **{("arrays", side): Required(NoOutline(), _OR_OUTLINE) for side in SIDES},
    **{("objects", side): Required(Filled(SIDES), _OR_NONE) for side in SIDES},
    ("objects", "height_m"): Required(
        Chosen("kind", (ObjectKind.EDGE_WITH_PARAPET,)), "give the parapet's height above the roof"
    ),
    ("arrays", "mu_fast"): Required(Filled(("mu_rate_s_per_m",)), _LAW),
    ("arrays", "mu_rate_s_per_m"): Required(Filled(("mu_fast",)), _LAW),
    ("motions", "units"): Required(_PASTED),
    ("motions", "dt_s"): Required(_PASTED),
    ("motions", "scale_value"): Required(
        Chosen("scaling", (Scaling.FACTOR, Scaling.PPA)), "give the factor, or the PPA in g"
    ),
    ("building", "period_s"): Required(
        NoPeriod(), "give it, or a structure type: a motion is recorded at the ground"
    ),
    # Lacking ones are a condition of the package.
    **{
        ("options", field): Required(_REVIEWED)
        for field in ("peer_reviewer", "peer_license", "peer_date")
    },
    **{
        ("options", f"directional_{field}"): Required(
            _BY_DIRECTION, "give it, or answer No to displacement by direction"
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


def missing(draft: Draft) -> Iterator[Finding]:
    """Yield the cells that are required by others, and blank."""
    for (section, field), required in REQUIRED.items():
        label = _spoken(section, field)
        for index, row in enumerate(draft[section] if required.wish else ()):
            is_blank = field in row and row[field] in (None, "")
            if is_blank and required.when.holds(row, draft):
                yield Finding.error(
                    Place(section, index, field), f"{label} is missing", required.wish
                )


def _spoken(section: str, field: str) -> str:
    model = next(one.model for one in SECTIONS if one.key == section)
    return next(entry.spoken for entry in entries(model) if entry.name == field)
