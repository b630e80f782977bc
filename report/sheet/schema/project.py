"""Project data, and the site with the rules that govern there.

Read `report.sheet.schema` first.
"""

from __future__ import annotations

import datetime as dt
from typing import Annotated

from pydantic import Field, model_validator

from report.sheet.fields import Cell, Frozen
from report.sheet.schema.choices import (
    EditionName,
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
from solver.rules.hazard import (
    EDITIONS,
    Edition,
    HazardBasis,
    SeismicParameters,
    seismic_parameters,
)
from solver.rules.rulesets import RULE_SETS

Acceleration = Annotated[float, Field(gt=0, le=10)]


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
            usual=(1.0, 1.5),
        ),
    ]
    s_s_g: Annotated[
        Acceleration | None,
        Cell(
            "S_S",
            "Mapped value at 0.2 s. Give S_S and F_a, or S_MS, or S_DS.",
            1.97,
            "g",
            usual=(0.1, 3.5),
        ),
    ] = None
    s_1_g: Annotated[
        Acceleration | None,
        Cell(
            "S_1",
            "Mapped value at 1 s. At 0.75 g or more the SDC is E or F.",
            0.70,
            "g",
            usual=(0.03, 1.5),
        ),
    ] = None
    site_class: Annotated[SiteClass | None, Cell("Site class", "ASCE 7 chapter 20.", "D")] = None
    f_a: Annotated[
        Annotated[float, Field(gt=0, le=10)] | None,
        Cell(
            "F_a",
            "Site coefficient at 0.2 s, ASCE 7-16. ASCE 7-22 has none.",
            1.2,
            usual=(0.8, 2.4),
        ),
    ] = None
    f_v: Annotated[
        Annotated[float, Field(gt=0, le=10)] | None,
        Cell(
            "F_v", "Site coefficient at 1 s, ASCE 7-16. ASCE 7-22 has none.", 1.7, usual=(0.8, 4.2)
        ),
    ] = None
    s_ds_g: Annotated[
        Annotated[float, Field(gt=0, le=5)] | None,
        Cell(
            "S_DS",
            "Design value, short period. Blank: 2/3 S_MS, unrounded.",
            1.566,
            "g",
            usual=(0.1, 2.5),
        ),
    ] = None
    sdc: Annotated[Sdc, Cell("Seismic design category", "ASCE 7 section 11.6.", "D")]
    stories: Annotated[
        int, Field(ge=1, le=200), Cell("Number of stories", "Above grade.", 1, usual=(1.0, 6.0))
    ]
    structure_height_m: Annotated[
        Positive,
        Cell(
            "Structure height h",
            "Average roof height above the base, ASCE 7 section 13.3.",
            36.0,
            Quantity.PLAN,
            usual=(8.0, 120.0),
        ),
    ]
    roof_height_m: Annotated[
        NotNegative,
        Cell(
            "Height of the array z",
            "Height above the base of the roof that supports the array.",
            36.0,
            Quantity.PLAN,
            usual=(8.0, 120.0),
        ),
    ]
    edition_name: Annotated[
        EditionName | None,
        Cell(
            "Edition of ASCE 7",
            "For the seismic parameters. Blank: that of the rule set, ASCE 7-16 with PV1-2012.",
            "ASCE 7-16",
        ),
    ] = None
    s_ms_g: Annotated[
        Acceleration | None,
        Cell(
            "S_MS",
            "Read from a hazard tool. Blank: F_a S_S, unrounded.",
            2.349,
            "g",
            usual=(0.1, 4.0),
        ),
    ] = None
    s_m1_g: Annotated[
        Acceleration | None,
        Cell(
            "S_M1",
            "Read from a hazard tool. Blank: F_v S_1, unrounded.",
            0.98,
            "g",
            usual=(0.03, 3.0),
        ),
    ] = None
    s_d1_g: Annotated[
        Acceleration | None,
        Cell(
            "S_D1", "Design value, 1 s. Blank: 2/3 S_M1, unrounded.", 0.653, "g", usual=(0.03, 2.0)
        ),
    ] = None
    hazard: Annotated[
        HazardBasis,
        Cell(
            "Hazard basis",
            "Site class D with S_1 of 0.2 g or more needs a site-specific analysis or the"
            " exception of ASCE 7-16 11.4.8. Values below those of its tables need one.",
            "mapped values",
        ),
    ] = HazardBasis.MAPPED
    hazard_source: Annotated[
        Text,
        Cell(
            "Source of hazard",
            "Tool, or author of the report on a site-specific analysis.",
            "ASCE 7 Hazard Tool",
        ),
    ] = ""
    hazard_date: Annotated[
        dt.date | None,
        Cell(
            "Date of hazard", "When the values were read, or of the report.", dt.date(2026, 2, 20)
        ),
    ] = None
    hazard_report: Annotated[
        Text,
        Cell("Report number of hazard", "Of the report on a site-specific analysis.", "GE-2026-41"),
    ] = ""
    force_factor: Annotated[
        Annotated[float, Field(gt=0, le=5)] | None,
        Cell(
            "a_p or C_AR",
            "Amplification factor of a component: a_p in ASCE 7-16, C_AR in ASCE 7-22. For F_p,"
            " which the package prints for comparison.",
            1.0,
        ),
    ] = None
    force_divisor: Annotated[
        Annotated[float, Field(ge=1, le=12)] | None,
        Cell("R_p or R_po", "R_p in ASCE 7-16, R_po in ASCE 7-22.", 1.5),
    ] = None

    @model_validator(mode="after")
    def _enough_for_s_ds(self) -> Site:
        if self.parameters.s_ds is None:
            raise ValueError("give S_DS, S_MS, or S_S and F_a")
        return self

    @property
    def edition(self) -> Edition:
        """The edition of the seismic parameters."""
        return edition_of(self.rule_set, self.edition_name)

    @property
    def parameters(self) -> SeismicParameters:
        """S_MS, S_M1, S_DS, S_D1 [g], as given or derived."""
        return seismic_parameters(
            self.edition,
            s_s=self.s_s_g,
            s_1=self.s_1_g,
            f_a=self.f_a,
            f_v=self.f_v,
            s_ms=self.s_ms_g,
            s_m1=self.s_m1_g,
            s_ds=self.s_ds_g,
            s_d1=self.s_d1_g,
        )

    @property
    def s_ds(self) -> float:
        """S_DS [g]."""
        value = self.parameters.s_ds
        assert value is not None  # checked when made
        return value

    @property
    def s_d1(self) -> float | None:
        """S_D1 [g], if known."""
        return self.parameters.s_d1

    @property
    def assumed_class(self) -> SiteClass:
        """The site class, D by default where none is given."""
        return site_class_or_default(self.site_class)

    @property
    def sdc_lacks(self) -> tuple[str, ...]:
        """What the SDC is not compared with, because it is not given."""
        values = (("S_1", self.s_1_g), ("S_D1", self.s_d1))
        return tuple(symbol for symbol, value in values if value is None)

    @property
    def sdc_mark(self) -> str:
        """What follows a printed SDC without S_1 and S_D1, on which it depends too."""
        return " (not confirmed)" if self.sdc_lacks else ""

    @property
    def sdc_text(self) -> str:
        """The SDC for print."""
        return f"{self.sdc}{self.sdc_mark}"

    @property
    def z_over_h(self) -> float:
        """Relative height of the roof that supports the array."""
        return self.roof_height_m / self.structure_height_m


def edition_of(rule_set: RuleSetName, name: EditionName | None) -> Edition:
    """Return the edition of the seismic parameters: as given, or else that of the rule set."""
    return EDITIONS[RULE_SETS[rule_set].edition if name is None else name]


def site_class_or_default(given: SiteClass | None) -> SiteClass:
    """Return a site class, D by default where none is given."""
    return SiteClass.D_DEFAULT if given is None else given
