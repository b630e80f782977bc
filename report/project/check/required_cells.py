"""Optional cells that are required where others say so."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from report.project.model.array import WEIGHT_PARTS
from report.project.model.choices import ObjectKind, RecordedAt, Scaling
from report.project.model.finding import Finding
from report.project.model.input_rows import InputRow, Inputs
from report.project.model.place import Place, Where
from report.project.model.placed import SIDES
from report.project.workbook import SECTION

# Whether a condition holds for a row as read; not where a cell could not be read.
Condition = Callable[[InputRow, Inputs], bool]


def _filled(*fields: str) -> Condition:
    return lambda row, _: any(row.get(field) not in (None, "") for field in fields)


def _chosen(field: str, *choices: str) -> Condition:
    return lambda row, _: row.get(field) in choices


def _has_no_outline(row: InputRow, inputs: Inputs) -> bool:
    return "id" in row and all(vertex.get("name") != row["id"] for vertex in inputs["outlines"])


_OR_NONE = "give all four sides of the rectangle, or none"
_OR_OUTLINE = "give all four sides of the rectangle, or an outline on the Outlines worksheet"
_LAW = "give high-velocity friction and friction rate, or neither"
_CODE = "give building code and year, or neither"
_BOTH = "give latitude and longitude, or neither"
_CONFIRMED = "give who confirmed the drawing distances and when, or neither"
_ALL_FIVE = "give all five cells of the confirmation, or none"
_CONFIRMATION = ("by", "date", "rule_set", "edition", "code")

# Optional cells that are required where others say so: when, and what would do.
REQUIRED: Mapping[tuple[str, str], tuple[Condition, str]] = {
    ("site", "building_code"): (_filled("building_code_year"), _CODE),
    ("site", "building_code_year"): (_filled("building_code"), _CODE),
    ("site", "latitude_deg"): (_filled("longitude_deg"), _BOTH),
    ("site", "longitude_deg"): (_filled("latitude_deg"), _BOTH),
    ("project", "drawing_confirmed_by"): (_filled("drawing_confirmed_date"), _CONFIRMED),
    ("project", "drawing_confirmed_date"): (_filled("drawing_confirmed_by"), _CONFIRMED),
    **{("confirmation", field): (_filled(*_CONFIRMATION), _ALL_FIVE) for field in _CONFIRMATION},
    **{("roof", side): (_filled(*SIDES), _OR_NONE) for side in SIDES},
    **{("arrays", side): (_has_no_outline, _OR_OUTLINE) for side in SIDES},
    **{("objects", side): (_filled(*SIDES), _OR_NONE) for side in SIDES},
    ("objects", "height_m"): (
        _chosen("kind", ObjectKind.EDGE_WITH_PARAPET), "give the parapet's height above the roof"),
    ("arrays", "weight_n"): (
        # A part that could not be read is absent: then nothing is said of the weight.
        lambda row, _: row.keys() >= {*WEIGHT_PARTS} and None in map(row.get, WEIGHT_PARTS),
        "give it, or modules, module weight and ballast weight"),
    ("arrays", "mu_fast"): (_filled("mu_rate_s_per_m"), _LAW),
    ("arrays", "mu_rate_s_per_m"): (_filled("mu_fast"), _LAW),
    ("motions", "scale_value"): (
        _chosen("scaling", Scaling.FACTOR, Scaling.PPA), "give the factor, or the PPA in g"),
    ("building", "period_s"): (
        lambda row, inputs: row.get("structure", "") is None
        and any(motion.get("recorded_at") is RecordedAt.GROUND for motion in inputs["motions"]),
        "give it, or a structure type: a motion is recorded at the ground"),
}  # fmt: skip


def missing(inputs: Inputs, where: Where) -> Iterator[Finding]:
    """Yield the cells that are required by others, and blank."""
    for (section, field), (is_required, remedy) in REQUIRED.items():
        for index, row in enumerate(inputs[section]):
            # What could not be read is not blank, and has an error of its own.
            is_blank = field in row and row[field] in (None, "")
            if is_blank and is_required(row, inputs):
                fault = f"{SECTION[section].entry(field).spoken} is missing"
                yield Finding.error(Place(section, index, field), fault, remedy)
