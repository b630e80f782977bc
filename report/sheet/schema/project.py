"""Project data, and the site with the rules that govern there.

Read `report.sheet.schema` first.
"""

from __future__ import annotations

import datetime as dt
from typing import Annotated

from pydantic import Field, model_validator

from report.sheet.fields import Cell, Frozen
from report.sheet.schema.choices import (
    NotNegative,
    Positive,
    RequiredText,
    RiskCategory,
    RuleSetName,
    Sdc,
    SiteClass,
    Text,
    UnitsFirst,
)
from report.words.units import Quantity


class Project(Frozen):
    """Project data."""

    name: Annotated[
        RequiredText, Cell("Project name", "Printed on the cover.", "Alameda Warehouse")
    ]
    number: Annotated[RequiredText, Cell("Project number", "Printed on every page.", "24-117")]
    client: Annotated[Text, Cell("Client", "Printed on the cover.", "Harbor Logistics LLC")] = ""
    address: Annotated[
        Text, Cell("Address", "Address of the building.", "1200 Alameda St, Los Angeles, CA")
    ] = ""
    prepared_by: Annotated[
        RequiredText, Cell("Prepared by", "Name or initials, printed on every page.", "RG")
    ]
    checked_by: Annotated[
        Text,
        Cell(
            "Checked by",
            "Name or initials, printed on every page. Leave blank until checked.",
            "MT",
        ),
    ] = ""
    date: Annotated[dt.date, Cell("Date", "Date of this issue.", dt.date(2026, 3, 5))]
    revision: Annotated[
        RequiredText, Cell("Revision", "Revision of this issue, printed on every page.", "0")
    ]
    units_first: Annotated[
        UnitsFirst, Cell("Primary units", "Both systems are printed; this one comes first.", "US")
    ] = UnitsFirst.US


class Revision(Frozen):
    """One line of the revision block."""

    revision: Annotated[RequiredText, Cell("Revision", "Number or letter.", "0")]
    date: Annotated[dt.date, Cell("Date", "Date of issue.", dt.date(2026, 3, 5))]
    description: Annotated[RequiredText, Cell("Description", "What changed.", "Issued for permit")]
    by: Annotated[Text, Cell("By", "Name or initials.", "RG")] = ""


def s_ds(s_ds_g: float | None, s_s_g: float | None, f_a: float | None) -> float | None:
    """Return S_DS [g]: as given, else 2/3 F_a S_S unrounded (ASCE 7 eq. 11.4-1, 11.4-3)."""
    if s_ds_g is not None:
        return s_ds_g
    if s_s_g is None or f_a is None:
        return None
    return 2.0 / 3.0 * f_a * s_s_g


class Site(Frozen):
    """Where the building stands and which rules govern."""

    rule_set: Annotated[
        RuleSetName,
        Cell("Rule set", "The adopted provisions. Rule sets are never combined.", "SEAOC PV1-2012"),
    ]
    risk_category: Annotated[RiskCategory, Cell("Risk category", "ASCE 7 Table 1.5-1.", "II")]
    i_e: Annotated[
        float,
        Field(ge=1.0, le=2.0),
        Cell(
            "Importance factor I_e",
            "At least 1.0 in risk category I or II, 1.25 in III, 1.5 in IV.",
            1.0,
        ),
    ]
    s_s_g: Annotated[
        Annotated[float, Field(gt=0, le=10)] | None,
        Cell("S_S", "Mapped value at 0.2 s. Give S_S and F_a, or S_DS.", 1.97, "g"),
    ] = None
    s_1_g: Annotated[
        Annotated[float, Field(gt=0, le=10)] | None,
        Cell("S_1", "Mapped value at 1 s. At 0.75 g or more the SDC is E or F.", 0.70, "g"),
    ] = None
    site_class: Annotated[SiteClass | None, Cell("Site class", "ASCE 7 chapter 20.", "D")] = None
    f_a: Annotated[
        Annotated[float, Field(gt=0, le=10)] | None,
        Cell("F_a", "Site coefficient at 0.2 s. Give S_S and F_a, or S_DS.", 1.2),
    ] = None
    f_v: Annotated[
        Annotated[float, Field(gt=0, le=10)] | None, Cell("F_v", "Site coefficient at 1 s.", 1.7)
    ] = None
    s_ds_g: Annotated[
        Annotated[float, Field(gt=0, le=5)] | None,
        Cell("S_DS", "Design value, short period. Blank: 2/3 F_a S_S, unrounded.", 1.566, "g"),
    ] = None
    sdc: Annotated[Sdc, Cell("Seismic design category", "ASCE 7 section 11.6.", "D")]
    stories: Annotated[int, Field(ge=1, le=200), Cell("Number of stories", "Above grade.", 1)]
    structure_height_m: Annotated[
        Positive,
        Cell(
            "Structure height h",
            "Average roof height above the base, ASCE 7 section 13.3.",
            36.0,
            Quantity.PLAN,
        ),
    ]
    roof_height_m: Annotated[
        NotNegative,
        Cell(
            "Height of the array z",
            "Height above the base of the roof that supports the array.",
            36.0,
            Quantity.PLAN,
        ),
    ]

    @model_validator(mode="after")
    def _enough_for_s_ds(self) -> Site:
        if s_ds(self.s_ds_g, self.s_s_g, self.f_a) is None:
            raise ValueError("give S_DS, or S_S and F_a")
        return self

    @property
    def s_ds(self) -> float:
        """S_DS [g], as given, else from S_S and F_a."""
        value = s_ds(self.s_ds_g, self.s_s_g, self.f_a)
        assert value is not None  # checked when made
        return value
