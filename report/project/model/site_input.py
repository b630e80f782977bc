"""Where the building stands and which rules govern: seismic parameters, category, codes."""

from __future__ import annotations

import datetime as dt
import math
from typing import Annotated

from pydantic import Field

from report.project.model.choices import (
    BuildingCode,
    EditionName,
    RiskCategory,
    RuleSetName,
    Sdc,
    SiteClass,
)
from report.project.model.input_rows import InputRow
from report.project.model.values import Frozen, NotNegative, Positive, Text
from solver.errors import DefectError
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


class Site(Frozen):
    """Where the building stands and which rules govern."""

    rule_set: RuleSetName
    edition_name: EditionName | None = None
    risk_category: RiskCategory
    site_class: SiteClass | None = None
    s_s_g: Acceleration | None = None
    s_1_g: Acceleration | None = None
    f_a: Annotated[float | None, Field(gt=0, le=10)] = None
    f_v: Annotated[float | None, Field(gt=0, le=10)] = None
    s_ms_g: Acceleration | None = None
    s_m1_g: Acceleration | None = None
    s_ds_g: Annotated[float | None, Field(gt=0, le=5)] = None
    s_d1_g: Acceleration | None = None
    i_e: Annotated[float, Field(ge=1.0, le=2.0)]
    sdc: Sdc
    hazard: HazardBasis = HazardBasis.MAPPED
    hazard_source: Text = ""
    hazard_date: dt.date | None = None
    hazard_covered: Text = ""
    hazard_report: Text = ""
    hazard_printout: Text = ""
    stories: Annotated[int, Field(ge=1, le=200)]
    structure_height_m: Positive
    roof_height_m: NotNegative
    force_factor: Annotated[float | None, Field(gt=0, le=5)] = None
    force_divisor: Annotated[float | None, Field(ge=1, le=12)] = None
    building_code: BuildingCode | None = None
    building_code_year: Annotated[int | None, Field(ge=2000, le=2100)] = None
    jurisdiction: Text = ""
    acceptance_letter: Text = ""
    fire_code_section: Text = ""
    fire_lane_m: Positive = 4 * 0.3048
    latitude_deg: Annotated[float | None, Field(ge=-90, le=90)] = None
    longitude_deg: Annotated[float | None, Field(ge=-180, le=180)] = None
    roof_load_pa: Positive | None = None
    seismic_weight_n: Positive | None = None
    roof_evaluation: Text = ""

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
        if value is None:  # which `check` refuses
            raise DefectError("S_DS cannot be derived")
        return value

    @property
    def s_d1(self) -> float | None:
        """S_D1 [g], if known."""
        return self.parameters.s_d1

    @property
    def assumed_class(self) -> SiteClass:
        """The site class, D by default if none is entered."""
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
        """Missing inputs that the SDC depends on."""
        return category_lacks(dict(self))

    @property
    def sdc_mark(self) -> str:
        """Remark after a printed SDC without S_1 or S_D1, if it depends on them."""
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
    """Return the edition of the seismic parameters: as entered, or else that of the rule set."""
    return EDITIONS[RULE_SETS[rule_set].edition if name is None else name]


def site_class_or_default(site_class: SiteClass | None) -> SiteClass:
    """Return a site class, D by default if none is entered."""
    return SiteClass.D_DEFAULT if site_class is None else site_class


_PARAMETERS = ("s_s_g", "f_a", "s_ms_g", "s_ds_g", "s_1_g", "f_v", "s_m1_g", "s_d1_g")


def edition_of_row(row: InputRow) -> Edition | None:
    """Return the edition of a row as read; None if it cannot be determined."""
    if "rule_set" not in row or "edition_name" not in row:
        return None
    return edition_of(row["rule_set"], row["edition_name"])


def site_parameters(row: InputRow) -> SeismicParameters | None:
    """Return the parameters of a row as read; None if a cell could not be read."""
    edition = edition_of_row(row)
    if edition is None or any(name not in row for name in _PARAMETERS):
        return None
    return _parameters(edition, row)


def _parameters(edition: Edition, row: InputRow) -> SeismicParameters:
    values = {name.removesuffix("_g"): row[name] for name in _PARAMETERS}
    return seismic_parameters(edition, **values)


def categories(row: InputRow) -> tuple[str, str, str]:
    """Return the SDC of a row by S_DS, by S_D1 and by S_1; empty if it cannot be determined."""
    parameters, risk_category = site_parameters(row), row.get("risk_category")
    if parameters is None or parameters.s_ds is None or risk_category is None:
        return "", "", ""
    return design_categories(
        s_ds_g=parameters.s_ds,
        s_d1_g=parameters.s_d1,
        s_1_g=row["s_1_g"],
        is_essential=risk_category is RiskCategory.IV,
    )


def category_lacks(row: InputRow) -> tuple[str, ...]:
    """Return the missing symbols that prevent the SDC of a row from being determined."""
    by_s_ds, by_s_d1, by_s_1 = categories(row)
    by_s_d1 = by_s_d1 or row["s_d1_g"]  # without S_DS it gives none yet
    # The tables end at D, and S_1 from 0.75 g on leads beyond them: there S_D1 changes nothing.
    needs_s_d1 = by_s_ds != MOST_BY_TABLES and not by_s_d1 and not by_s_1
    lacks = {"S_1": row["s_1_g"] is None, "S_D1": needs_s_d1}
    return tuple(symbol for symbol, is_lacking in lacks.items() if is_lacking)


def least_i_e(row: InputRow) -> float | None:
    """Return the least I_e of the risk category of a row."""
    return LEAST_I_E.get(row.get("risk_category", ""))


def least_category(row: InputRow) -> Sdc | None:
    """Return the SDC of a row, if all required inputs are entered."""
    # Empty text, of what is not known, is below every letter.
    category = max(categories(row))
    return Sdc(category) if category and not category_lacks(row) else None


def tabulated_f_a(row: InputRow) -> float | None:
    """Return F_a of its table if S_MS is based on it; None if that is site-specific."""
    edition, fields = edition_of_row(row), ("s_s_g", "site_class", "hazard", "s_ms_g", "s_ds_g")
    # ASCE 7-22 has no F_a: its S_MS is read off for a site class.
    if edition is None or edition.name != F_A.edition or not row.keys() >= {*fields}:
        return None
    s_s_g, site_class, hazard, *coefficients = (row[name] for name in fields)
    has_table = site_class in F_A.rows and hazard is not HazardBasis.SITE_SPECIFIC
    if s_s_g is None or not has_table or coefficients != [None, None]:
        return None
    value = site_coefficient(F_A, site_class, s_s_g)
    return None if math.isnan(value) else value
