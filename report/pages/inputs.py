"""Inputs: site parameters in the order of a permit sheet, arrays, friction tests.

Seismic parameters of the site that are not given; their table is in its template.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from report.assessment.design.friction import mu_words
from report.document.columns import ColumnHead, length, plain, text, weight, words
from report.document.tables import Table, listed
from report.motions.history import ac156
from report.pages import friction_tests
from report.pages.parts import PackageData
from report.project.model import ProjectInput
from report.project.model.choices import RiskCategory
from report.project.model.site import Site
from report.text.counts import ids_by
from report.text.units import Quantity, number
from solver.building.structure import approximate_period_s
from solver.rules import hazard
from solver.rules.hazard import ComponentForce, component_force
from solver.rules.rulesets import LowProfileLength


def site(package: PackageData) -> Mapping[str, object]:
    """Return what the table of the site needs beside the package."""
    site, building = package.data.site, package.data.building
    factors = sorted({array.i_p for array in package.data.arrays})
    categories = hazard.design_categories(
        s_ds_g=site.s_ds,
        s_d1_g=site.s_d1,
        s_1_g=site.s_1_g,
        is_essential=site.risk_category is RiskCategory.IV,
    )
    return {
        # Smallest and largest, once where they are the same.
        "i_p": tuple(dict.fromkeys((factors[0], factors[-1]))),
        "period_s": approximate_period_s(building.structure or "other", site.structure_height_m),
        "force": site_force(package.data),
        "near_fault_g": hazard.NEAR_FAULT_S_1_G,
        "categories": categories,
    }


def site_force(data: ProjectInput) -> ComponentForce | None:
    """Return F_p / W_p with the largest I_p of the arrays, if a_p and R_p are given.

    The height factor of ASCE 7-22 takes the period where the workbook states period or structure.
    """
    site, building = data.site, data.building
    if site.force_factor is None or site.force_divisor is None:
        return None
    period_s = building.period_s
    # ASCE 7-22 13.3.1.1: H_f takes T_a where the period is not known.
    if period_s is None and building.structure is not None:
        period_s = approximate_period_s(building.structure, site.structure_height_m)
    return component_force(
        site.edition,
        s_ds_g=site.s_ds,
        factor=site.force_factor,
        divisor=site.force_divisor,
        # One force for all: the largest is on the safe side for the others.
        i_p=max(array.i_p for array in data.arrays),
        z_over_h=site.z_over_h,
        period_s=period_s,
    )


def unused_s_ds(site: Site) -> Mapping[str, object]:
    """Return the symbols from which S_DS follows, and its value from them if another is given."""
    origin, s_ms = _origin(site), site.parameters.s_ms
    # A value of S_DS that is given goes before what F_a and S_S give: the page shows both.
    is_unused = site.s_ds_g is not None and s_ms is not None and origin
    return {"origin": origin, "value_g": 2.0 / 3.0 * s_ms if is_unused and s_ms else None}


def _origin(site: Site) -> tuple[str, ...]:
    """Return the symbols of the given values from which S_DS follows; none if there are none."""
    if site.s_ms_g is not None:
        return ("S_MS",)
    # From ASCE 7-22 on S_MS is read off for a site class, so that S_S and F_a give nothing.
    if site.edition.has_site_coefficients and site.s_s_g is not None and site.f_a is not None:
        return ("S_S", "F_a")
    return ()


def inputs(package: PackageData) -> Mapping[str, object]:
    """Return what the part on inputs needs beside the package."""
    data = package.data
    horizontal, vertical = ac156(data)
    return {
        "horizontal_g": horizontal.sa_g,
        "vertical_g": vertical.sa_g,
        "site": site(package),
        "s_ds": unused_s_ds(data.site),
        "arrays": _arrays(package),
        "takes_base": package.assessment.rules.low_profile_length is LowProfileLength.BASE,
        "made": ids_by(data.arrays, lambda array: (array.construction, array.mu_report)),
        "links": _links(package),
        "friction": friction_tests.page(package),
    }


def _arrays(package: PackageData) -> Table:
    columns = (
        (words("Array", 0.9), lambda array: array.id),
        (plain("Slope", 2, "deg", 0.7), lambda array: math.degrees(array.slope_rad)),
        (plain("Slope", 1, "%", 0.6), lambda array: 100.0 * math.tan(array.slope_rad)),
        (plain("Down", 0, "deg", 0.7), lambda array: array.downslope_deg),
        (text("μ", share=package.mu_share), lambda array: mu_words(array.friction)),
        (weight("Weight", 0.95), lambda array: array.weight_n),
        (ColumnHead(head="Weight per area", quantity=Quantity.PRESSURE),
         lambda array: array.weight_pa),
        (length("Center of gravity"), lambda array: array.cg_height_m),
        (length("Support spacing"), lambda array: array.support_spacing_m),
    )  # fmt: skip
    return listed(package.data.arrays, columns, package.fmt, kind="compact")


def _links(package: PackageData) -> Table:
    columns = (
        (words("Array", 0.9), lambda row: row.array),
        (text("Blocks", share=0.8), lambda row: len(row.mus)),
        (
            words("μ of the blocks, from the upslope end", 4.2),
            lambda row: ", ".join(number(mu, 3) for mu in row.mus),
        ),
        (ColumnHead(head="Link stiffness", quantity=Quantity.STIFFNESS, share=1.1),
         lambda row: row.stiffness_n_per_m),
        (plain("Link damping", 3, "of critical", 1.3), lambda row: row.damping_ratio),
    )  # fmt: skip
    return listed(package.data.links, columns, package.fmt)
