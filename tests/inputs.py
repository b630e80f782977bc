"""Parts of a project as data, each spelled once, for the workbooks and assessments of tests."""

from __future__ import annotations

import datetime as dt

from report.project.model import ProjectInput

FT, INCH, LB = 0.3048, 0.0254, 4.4482216152605
SIDES = ("x_from_m", "x_to_m", "y_from_m", "y_to_m")
NO_SIDES = dict.fromkeys(SIDES)

Row = dict[str, object]

HEAD: Row = {
    "name": "Alameda Warehouse", "number": "24-117", "client": "Harbor Logistics LLC",
    "address": "1200 Alameda St, Los Angeles, CA", "prepared_by": "Engineer of record",
    "checked_by": "", "date": dt.date(2026, 3, 5), "revision": "0",
}  # fmt: skip
SITE: Row = {
    "rule_set": "SEAOC PV1-2012", "risk_category": "II", "i_e": 1.0, "s_1_g": 0.7,
    "site_class": "D", "s_ds_g": 1.566, "sdc": "D", "stories": 1,
    "structure_height_m": 36 * FT, "roof_height_m": 36 * FT,
    "roof_evaluation": "J. Doe, SE, 2026-02-20",
}  # fmt: skip

REVIEW = {
    "peer_reviewed": True, "peer_reviewer": "Reviewer of record", "peer_license": "CA S0000",
    "peer_date": dt.date(2026, 3, 1), "peer_letter": "peer-review.pdf",
}  # fmt: skip


def project(**sections: object) -> ProjectInput:
    """Return an input of these sections, with the usual head and site unless they are given."""
    return ProjectInput.model_validate({"project": HEAD, "site": SITE} | sections)


def sides(x_from: float, x_to: float, y_from: float, y_to: float) -> Row:
    """Return the sides of a rectangle, given in feet."""
    values = (x_from, x_to, y_from, y_to)
    return {side: value * FT for side, value in zip(SIDES, values, strict=True)}


def array(name: str, slope: float, *, x: float = 20, y: float = 15, **changes: object) -> Row:
    """Return an array of 80 ft x 60 ft."""
    return {
        "id": name, "slope_value": slope, "slope_unit": "degrees", "mu": 0.45,
        "mu_report": "ASTM G115, Lab 1234, 2025-06-12", "construction": "Tray 10 deg, landscape",
        "weight_n": 42000 * LB, "cg_height_m": 9 * INCH, "support_spacing_m": 40 * INCH,
        **sides(x, x + 80, y, y + 60), "downslope_deg": 270.0,
    } | changes  # fmt: skip


def roof_object(name: str, kind: str, *plan_ft: float, height: float | None = None) -> Row:
    """Return an object or edge, with a height [m] and its rectangle in feet if it has one."""
    plan = sides(*plan_ft) if plan_ft else {}
    return {"id": name, "kind": kind, "height_m": height} | plan


def clearance(near: str, far: str, provided_m: float, direction: str = "any") -> Row:
    """Return a clearance along which no fire pathway runs."""
    ends = {"array": near, "object": far, "direction": direction}
    return ends | {"provided_m": provided_m, "pathway_m": 0.0}


def motion(name: str, record: str = "x", **changes: object) -> Row:
    """Return a motion of a record in g."""
    return {"id": name, "record": f"records/{record}.csv", "units": "g", **changes}


def links(name: str, friction: str, lb_per_in: float, **changes: object) -> Row:
    """Return one array that is to be held against a row of linked blocks."""
    stiffness = {"stiffness_n_per_m": lb_per_in * LB / INCH}
    return {"array": name, "friction": friction, **stiffness} | changes
