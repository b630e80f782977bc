"""Project data, the site with the rules that govern there, and the friction tests.

Read `report.sheet.schema` first.
"""

from __future__ import annotations

import datetime as dt
import math
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar

from pydantic import Field, model_validator

from report.sheet.schema.choices import (
    BuildingCode,
    EditionName,
    Id,
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
from report.sheet.schema.fields import Cell, DraftRow, Frozen
from report.text.units import Quantity
from solver.friction_tests import MOST_MU, FrictionRun, Surface
from solver.rules.hazard import (
    EDITIONS,
    LEAST_I_E,
    MOST_BY_TABLES,
    Edition,
    HazardBasis,
    SeismicParameters,
    design_categories,
    seismic_parameters,
)
from solver.rules.rulesets import RULE_SETS
from solver.rules.site_coefficients import F_A, site_coefficient

Acceleration = Annotated[float, Field(gt=0, le=10)]


class Project(Frozen):
    """Project data."""

    name: Annotated[RequiredText, Cell("Project name", "Alameda Warehouse, Rooftop Solar")]
    """Printed on the cover."""
    number: Annotated[RequiredText, Cell("Project number", "24-117")]
    """Printed on every page."""
    client: Annotated[Text, Cell("Client", "Harbor Logistics LLC")] = ""
    """Printed on the cover."""
    address: Annotated[Text, Cell("Address", "1200 Alameda St, Los Angeles, CA")] = ""
    """Address of the building."""
    prepared_by: Annotated[RequiredText, Cell("Prepared by", "RG")]
    """Name or initials, printed on every page."""
    checked_by: Annotated[Text, Cell("Checked by", "MT")] = ""
    """Name or initials, printed on every page. Leave blank until checked."""
    firm: Annotated[Text, Cell("Firm", "Example Structural Engineers")] = ""
    """Of the engineer of record. Printed on the cover."""
    firm_contact: Annotated[
        Text, Cell("Firm's address and phone", "500 Main St, Los Angeles, CA; 213 555 0100")
    ] = ""
    """Printed with the firm."""
    license: Annotated[Text, Cell("Engineer's license", "CA S0000")] = ""
    """State and number of the engineer of record, printed in the box of the seal."""
    date: Annotated[dt.date, Cell("Date", dt.date(2026, 3, 5))]
    """Date of this issue."""
    revision: Annotated[RequiredText, Cell("Revision", "0")]
    """Revision of this issue, printed on every page."""
    units_first: Annotated[UnitsFirst, Cell("Primary units", "US")] = UnitsFirst.US
    """Both systems are printed; this one comes first."""
    plan_number: Annotated[Text, Cell("Drawing number", "S-101")] = ""
    """Of the plan in the permit set from which the distances are. Printed on the cover."""
    plan_date: Annotated[dt.date | None, Cell("Drawing date", dt.date(2026, 2, 27))] = None
    """Of that plan."""
    drawing_confirmed_by: Annotated[Text, Cell("Drawing distances confirmed by", "RG")] = ""
    """Name, if every clearance whose distance is from the drawing is confirmed; with the date."""
    drawing_confirmed_date: Annotated[
        dt.date | None, Cell("Drawing distances confirmed on", dt.date(2026, 3, 5))
    ] = None
    """When they were confirmed; with the name."""
    drawing_covered: Annotated[
        Text, Cell("Drawing distances covered", "2026-03-05: Clearances 3f2a91")
    ] = ""
    """Filled in by roofslip report: the date with a short hash of these distances. Leave blank."""


class Revision(Frozen):
    """One line of the revision block."""

    revision: Annotated[RequiredText, Cell("Revision", "0")]
    """Number or letter."""
    date: Annotated[dt.date, Cell("Date", dt.date(2026, 3, 5))]
    """Date of issue."""
    description: Annotated[RequiredText, Cell("Description", "Issued for permit")]
    """What changed."""
    by: Annotated[Text, Cell("By", "RG")] = ""
    """Name or initials."""


class Site(Frozen):
    """Where the building stands and which rules govern."""

    rule_set: Annotated[RuleSetName, Cell("Rule set", "SEAOC PV1-2012")]
    """The adopted provisions. Rule sets are never combined."""
    edition_name: Annotated[EditionName | None, Cell("Edition of ASCE 7", "ASCE 7-16")] = None
    """For the seismic parameters. Blank: that of the rule set, ASCE 7-16 with PV1-2012."""
    risk_category: Annotated[RiskCategory, Cell("Risk category", "II")]
    """ASCE 7 Table 1.5-1."""
    site_class: Annotated[SiteClass | None, Cell("Site class", "D")] = None
    """ASCE 7 chapter 20."""
    s_s_g: Annotated[Acceleration | None, Cell("S_S", 1.97, "g", usual=(0.1, 3.5))] = None
    """Mapped value at 0.2 s. Give S_S and F_a, or S_MS, or S_DS."""
    s_1_g: Annotated[Acceleration | None, Cell("S_1", 0.70, "g", usual=(0.03, 1.5))] = None
    """Mapped value at 1 s. At 0.75 g or more the SDC is E or F."""
    f_a: Annotated[float | None, Field(gt=0, le=10), Cell("F_a", 1.2, usual=(0.8, 2.4))] = None
    """Site coefficient at 0.2 s; ASCE 7-22 has none. Blank, without S_MS and S_DS: of its table."""
    f_v: Annotated[float | None, Field(gt=0, le=10), Cell("F_v", 1.7, usual=(0.8, 4.2))] = None
    """Site coefficient at 1 s; ASCE 7-22 has none."""
    s_ms_g: Annotated[Acceleration | None, Cell("S_MS", 2.349, "g", usual=(0.1, 4.0))] = None
    """Read from a hazard tool. Blank: F_a S_S, unrounded."""
    s_m1_g: Annotated[Acceleration | None, Cell("S_M1", 0.98, "g", usual=(0.03, 3.0))] = None
    """Read from a hazard tool. Blank: F_v S_1, unrounded."""
    s_ds_g: Annotated[
        float | None, Field(gt=0, le=5), Cell("S_DS", 1.566, "g", usual=(0.1, 2.5))
    ] = None
    """Design value, short period. Blank: 2/3 S_MS, unrounded."""
    s_d1_g: Annotated[Acceleration | None, Cell("S_D1", 0.653, "g", usual=(0.03, 2.0))] = None
    """Design value, 1 s. Blank: 2/3 S_M1, unrounded."""
    i_e: Annotated[
        float,
        Field(ge=1.0, le=2.0),
        Cell("Importance factor I_e", 1.0, usual=(1.0, 1.5), need="computed if blank"),
    ]
    """At least 1.0 in risk category I or II, 1.25 in III, 1.5 in IV, which a blank cell stands
    for."""
    sdc: Annotated[Sdc, Cell("Seismic design category", "D", need="required, or S_1 and S_D1")]
    """ASCE 7 section 11.6. Blank: the least by S_DS, S_D1 and S_1, if it follows from those given
    or computed."""
    hazard: Annotated[HazardBasis, Cell("Hazard basis", "mapped values")] = HazardBasis.MAPPED
    """Site class D with S_1 of 0.2 g or more needs a site-specific analysis or the exception of
    ASCE 7-16 11.4.8. Values below those of its tables need one."""
    hazard_source: Annotated[Text, Cell("Source of hazard", "ASCE 7 Hazard Tool")] = ""
    """Tool, or author of the site-specific analysis."""
    hazard_date: Annotated[dt.date | None, Cell("Date of hazard", dt.date(2026, 2, 20))] = None
    """When the values were read, or of the report."""
    hazard_covered: Annotated[Text, Cell("Hazard covered", "2026-02-20: Site 3f2a91")] = ""
    """Filled in by roofslip report: the date with a short hash of these values. Leave blank."""
    hazard_report: Annotated[Text, Cell("Report number of hazard", "GE-2026-41")] = ""
    """Of the report on a site-specific analysis."""
    hazard_printout: Annotated[Text, Cell("Hazard printout", "hazard.pdf")] = ""
    """Of the tool, or the report, as a PDF in the workbook's folder; the package attaches it."""
    stories: Annotated[int, Field(ge=1, le=200), Cell("Number of stories", 1, usual=(1.0, 6.0))]
    """Above grade."""
    structure_height_m: Annotated[
        Positive, Cell("Structure height h", 36.0, Quantity.PLAN, usual=(8.0, 120.0))
    ]
    """Average roof height above the base, ASCE 7, 13.3."""
    roof_height_m: Annotated[
        NotNegative, Cell("Height of the array z", 36.0, Quantity.PLAN, usual=(8.0, 120.0))
    ]
    """Of the roof that supports it, above the base."""
    force_factor: Annotated[float | None, Field(gt=0, le=5), Cell("a_p or C_AR", 1.0)] = None
    """Amplification factor of a component, in ASCE 7-16 and 7-22: for F_p, for comparison."""
    force_divisor: Annotated[float | None, Field(ge=1, le=12), Cell("R_p or R_po", 1.5)] = None
    """Its divisor, in ASCE 7-16 and 7-22."""
    building_code: Annotated[BuildingCode | None, Cell("Building code", "CBC")] = None
    """As adopted there. Printed on the cover."""
    building_code_year: Annotated[
        int | None, Field(ge=2000, le=2100), Cell("Year of building code", 2022)
    ] = None
    """Edition of the building code."""
    jurisdiction: Annotated[Text, Cell("Jurisdiction", "City of Los Angeles")] = ""
    """Building department. Printed on the cover."""
    acceptance_letter: Annotated[Text, Cell("Letter of acceptance", "acceptance.pdf")] = ""
    """The jurisdiction's, of what its building code does not reference: a PDF, to attach."""
    fire_code_section: Annotated[
        Text, Cell("Fire code section", "Section of the 2022 CFC, as adopted")
    ] = ""
    """Code, edition and section that limit the distance between fire lanes. The package prints it
    beside the plan dimension of the arrays, and without it has a condition."""
    fire_lane_m: Annotated[
        Positive, Cell("Fire lane width", 4.0, Quantity.PLAN, usual=(3.0, 10.0))
    ] = 4 * 0.3048
    """Arrays that are closer count as one between fire lanes. Blank: 4 ft, a practice: verify
    against the adopted code."""
    latitude_deg: Annotated[
        float | None, Field(ge=-90, le=90), Cell("Latitude", 34.0362, "deg")
    ] = None
    """Of the site, for which the hazard was read; positive to the north. Printed on the cover."""
    longitude_deg: Annotated[
        float | None, Field(ge=-180, le=180), Cell("Longitude", -118.2334, "deg")
    ] = None
    """Positive to the east, so that it is negative in America."""
    roof_load_pa: Annotated[
        Positive | None,
        Cell("Design load of the roof", 32.0, Quantity.PRESSURE, usual=(10.0, 150.0)),
    ] = None
    """Gravity load for which the existing roof is designed; the weight of each array over its plan
    area is compared with 5 % of it."""
    seismic_weight_n: Annotated[
        Positive | None,
        Cell("Seismic weight", 900_000.0, Quantity.WEIGHT, usual=(20_000.0, 100_000_000.0)),
    ] = None
    """Of the existing building; the weight of all arrays is compared with 10 % of it."""
    roof_evaluation: Annotated[
        Text, Cell("Evaluation of the building", "J. Doe, SE, 2026-02-20")
    ] = ""
    """Of the existing building with the weight added: by whom, and date or number of the report.
    For a new building: so designed, by whom."""

    computed_last: ClassVar[Mapping[str, str]] = {
        "i_e": "ASCE 7 Table 1.5-2†",
        "f_a": f"{F_A.clause}†",
        "sdc": "ASCE 7 section 11.6†",
    }

    @classmethod
    def computed(cls, name: str, row: Mapping[str, Any]) -> Any:
        """Return the least I_e, F_a of the table, or the SDC, if all it depends on is given."""
        match name:
            case "i_e":
                return LEAST_I_E.get(row.get("risk_category", ""))
            case "f_a":
                return _tabulated_f_a(row)
            case "sdc":
                least = max(categories(row))
                return Sdc(least) if least and not category_lacks(row) else None
        return None

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
        return _parameters(self.edition, dict(self))

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
    def code_text(self) -> str:
        """The building code with its year, such as `2022 CBC`; empty if not given."""
        return f"{self.building_code_year} {self.building_code}" if self.building_code else ""

    @property
    def adopted(self) -> tuple[str, str, str]:
        """Rule set, edition and building code."""
        return self.rule_set, self.edition.name, self.code_text

    @property
    def sdc_lacks(self) -> tuple[str, ...]:
        """What the SDC depends on and is not given."""
        return category_lacks(dict(self))

    @property
    def sdc_mark(self) -> str:
        """What follows a printed SDC without S_1 or S_D1, where it depends on it."""
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


def site_class_or_default(site_class: SiteClass | None) -> SiteClass:
    """Return a site class, D by default where none is given."""
    return SiteClass.D_DEFAULT if site_class is None else site_class


_PARAMETERS = ("s_s_g", "f_a", "s_ms_g", "s_ds_g", "s_1_g", "f_v", "s_m1_g", "s_d1_g")


def edition_of_row(row: DraftRow) -> Edition | None:
    """Return the edition of a draft of the site; None if it cannot be determined."""
    if "rule_set" not in row or "edition_name" not in row:
        return None
    return edition_of(row["rule_set"], row["edition_name"])


def site_parameters(row: DraftRow) -> SeismicParameters | None:
    """Return the parameters of a draft of the site; None if a cell could not be read."""
    edition = edition_of_row(row)
    if edition is None or any(name not in row for name in _PARAMETERS):
        return None
    return _parameters(edition, row)


def _parameters(edition: Edition, row: DraftRow) -> SeismicParameters:
    values = {name.removesuffix("_g"): row[name] for name in _PARAMETERS}
    return seismic_parameters(edition, **values)


def categories(row: DraftRow) -> tuple[str, str, str]:
    """Return the SDC of a draft by S_DS, by S_D1 and by S_1; empty where it cannot be known."""
    parameters, risk_category = site_parameters(row), row.get("risk_category")
    if parameters is None or parameters.s_ds is None or risk_category is None:
        return "", "", ""
    return design_categories(
        s_ds_g=parameters.s_ds,
        s_d1_g=parameters.s_d1,
        s_1_g=row["s_1_g"],
        is_essential=risk_category is RiskCategory.IV,
    )


def category_lacks(row: DraftRow) -> tuple[str, ...]:
    """Return the symbols without which the SDC of a draft with S_DS does not follow."""
    by_s_ds, by_s_d1, by_s_1 = categories(row)
    # The tables end at D, and S_1 from 0.75 g on leads beyond them: there S_D1 changes nothing.
    needs_s_d1 = by_s_ds != MOST_BY_TABLES and not by_s_d1 and not by_s_1
    lacks = {"S_1": row["s_1_g"] is None, "S_D1": needs_s_d1}
    return tuple(symbol for symbol, is_lacking in lacks.items() if is_lacking)


def _tabulated_f_a(row: DraftRow) -> float | None:
    """Return F_a of its table where S_MS follows from it; None where that is site-specific."""
    edition, wanted = edition_of_row(row), ("s_s_g", "site_class", "hazard", "s_ms_g", "s_ds_g")
    if edition is None or edition.name != F_A.edition or not row.keys() >= {*wanted}:
        return None
    s_s_g, site_class, hazard, *coefficients = (row[name] for name in wanted)
    has_table = site_class in F_A.rows and hazard is not HazardBasis.SITE_SPECIFIC
    if s_s_g is None or not has_table or coefficients != [None, None]:
        return None
    value = site_coefficient(F_A, site_class, s_s_g)
    return None if math.isnan(value) else value


Mu = Annotated[float, Field(ge=0.0, le=MOST_MU)]


class FrictionTests(Frozen):
    """What the report on the friction tests states."""

    laboratory: Annotated[Text, Cell("Laboratory", "Example Laboratories")] = ""
    """Laboratory that performed the tests."""
    accreditation: Annotated[Text, Cell("Accreditation", "ISO/IEC 17025, no. 1234.01")] = ""
    """Accreditation of the laboratory."""
    standard: Annotated[Text, Cell("Standard", "ASTM G115-10")] = ""
    """Test standard."""
    report: Annotated[Text, Cell("Report number", "FT-2025-118")] = ""
    """Number of the report."""
    date: Annotated[dt.date | None, Cell("Report date", dt.date(2025, 6, 12))] = None
    """Date of the report."""
    tests_covered: Annotated[
        Text, Cell("Test report covered", "2025-06-12: Friction tests 3f2a91")
    ] = ""
    """Filled in by roofslip report: the date with a short hash of the runs. Leave blank."""
    membrane: Annotated[Text, Cell("Membrane", "TPO, 60 mil")] = ""
    """Roof surface as tested: product and thickness."""
    support: Annotated[Text, Cell("Support material", "EPDM pad")] = ""
    """Surface of the array's supports as tested."""
    contact_pressure_pa: Annotated[
        Positive | None, Cell("Contact pressure of the tests", 150.0, Quantity.PRESSURE)
    ] = None
    """Weight on a tested support over its contact area; printed beside that of the arrays."""
    report_file: Annotated[Text, Cell("Test report file", "friction-report.pdf")] = ""
    """The report as a PDF in the workbook's folder; the package attaches it. All such files: at
    most 20 MB."""


class FrictionTestRow(Frozen):
    """One run of a friction test."""

    surface: Annotated[Surface, Cell("Surface", "wet")]
    """Condition of the roof surface."""
    number: Annotated[int, Field(ge=1, le=1000), Cell("Run", 1)]
    """Number of the run."""
    mu: Annotated[Mu, Cell("Kinetic coefficient", 0.46, usual=(0.3, 0.8))]
    """Mean friction coefficient while sliding."""
    velocity_mps: Annotated[NotNegative | None, Cell("Velocity", 1.0, Quantity.VELOCITY)] = None
    """Sliding velocity. Blank: not reported."""
    mu_static: Annotated[Mu | None, Cell("Static coefficient", 0.52, usual=(0.3, 1.0))] = None
    """At breakaway. Blank: not reported."""
    report: Annotated[Id | None, Cell("Report", "FT-2025-118", is_rare=True)] = None
    """Only with runs of several reports. Blank: the report above."""

    def run(self, report: str) -> FrictionRun:
        """Return the run, of a given report unless the row names another."""
        return FrictionRun(
            report=self.report or report,
            surface=self.surface,
            velocity_mps=math.nan if self.velocity_mps is None else self.velocity_mps,
            mu=self.mu,
            mu_static=math.nan if self.mu_static is None else self.mu_static,
        )
