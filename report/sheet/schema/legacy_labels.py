"""Labels, keys and choices of earlier workbooks, which can still be read.

Enter every renamed label here and in the changelog; never remove an entry.
"""

from __future__ import annotations

from collections.abc import Mapping

LABELS: Mapping[tuple[str, str], tuple[str, ...]] = {
    ("project", "units_first"): ("Units first",),
    ("site", "stories"): ("Storeys",),
    ("arrays", "mu_fast"): ("Friction at speed",),
    ("clearances", "provided_m"): ("Provided",),
    ("motions", "from_s"): ("Keep from",),
    ("motions", "to_s"): ("Keep to",),
    ("motions", "pad_s"): ("Zeros at the end",),
    ("building", "left_out_percent"): ("Modes may leave out",),
    ("links", "friction"): ("Friction of blocks",),
    ("options", "statistic"): ("Design value from peaks",),
    ("options", "peer_reviewed"): ("Analysis is peer reviewed",),
    ("target", "from_s"): ("Scaling periods from",),
    ("target", "to_s"): ("Scaling periods to",),
}
"""Earlier labels and headings, by section and field."""

ANSWERS = frozenset({"status"})
"""Headings of formulas that every table had, lowercase: what a row lacks, which `check` says."""

FIELDS: Mapping[tuple[str, str], tuple[str, ...]] = {("site", "stories"): ("storeys",)}
"""Earlier names of a field, which defined names of cells end with."""

SHEETS: Mapping[str, str] = {"roof": "Site", "target": "Options"}
"""Earlier sheet of a block."""

ORDERS: Mapping[str, str] = {
    "site": "rule_set risk_category i_e s_s_g s_1_g site_class f_a f_v s_ds_g sdc stories"
    " structure_height_m roof_height_m edition_name s_ms_g s_m1_g s_d1_g",
}
"""Earlier order of the first fields of a block, in which confirmations are hashed."""

ADDED: tuple[frozenset[tuple[str, str]], ...] = tuple(
    frozenset((section, field) for field in fields.split())
    for section, fields in (
        (
            "site",
            "edition_name s_ms_g s_m1_g s_d1_g hazard hazard_source hazard_date force_factor"
            " force_divisor",
        ),
        (
            "options",
            "peer_reviewer peer_license peer_date directional directional_reason"
            " directional_reviewer directional_license directional_date smaller_events",
        ),
        ("site", "hazard_report"),
        ("site", "building_code building_code_year jurisdiction"),
        ("friction_tests", "report_file"),
        ("options", "peer_letter"),
        ("options", "study_years"),
        ("options", "plan_paper"),
        ("project", "drawing_confirmed_by drawing_confirmed_date"),
        ("site", "fire_code_section fire_lane_m"),
        ("project", "drawing_covered"),
        ("site", "hazard_covered"),
        ("friction_tests", "tests_covered"),
        ("options", "peer_covered"),
        ("options", "package_edition letter"),
        ("site", "hazard_printout"),
    )
)
"""Single cells that earlier workbooks do not have, those of one version together; a workbook
without any of a group is of an earlier version."""

PROVISIONS: Mapping[str, str] = {"max_storeys": "max_stories"}
"""Earlier keys of provisions to override, with the present ones."""
