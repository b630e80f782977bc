"""Inputs: site parameters, arrays, friction tests."""

from __future__ import annotations

import math
from collections.abc import Mapping

from markupsafe import Markup

from report.assessment.design.friction import mu_words
from report.assessment.design.tested_friction import basis_words
from report.document.columns import ColumnHead, length, plain, text, weight, words
from report.document.tables import Table, listed, merged
from report.motions.history import OWN
from report.pages import friction_tests
from report.pages.parts import PackageData, all_or
from report.pages.site import site_table
from report.project.model.array import Array
from report.project.model.site_input import Site
from report.text.grouping import grouped_by, ids_by
from report.text.letter_case import capitalized
from report.text.names import ranged
from report.text.unit_format import UnitFormat
from report.text.units import NO_BREAK, Quantity, number
from report.typeset.equations import symbol
from solver.rules.rulesets import LowProfileLength


def page(package: PackageData) -> Mapping[str, object]:
    """Return the tables of the inputs, and the notes below them."""
    done, data, fmt, marks = package.assessment, package.data, package.fmt, package.marks
    rules, site, n_arrays = done.rules, data.site, len(data.arrays)
    construction = ids_by(data.arrays, lambda array: (array.construction, array.mu_report))
    low_profile_mark = marks.of("low_profile_ratio")
    return {
        "site": site_table(package),
        "s_ds_note": _s_ds_note(site),
        "spectrum": _ground_spectrum(package),
        "arrays": merged(_arrays(package)),
        "construction": "; ".join(
            f"{capitalized(all_or(ids, n_arrays))}: {words}, friction test report "
            f"{report or 'not entered'}"
            for (words, report), ids in construction.items()
        ),
        "friction_laws": [
            f"Array {array.id}. Friction: {mu_words(array.friction)}{_rate(array)}; "
            f"{basis_words(package.data, array)}."
            for array in data.arrays
            if not array.friction.is_constant
        ],
        "low_profile": package.rule_length("low_profile_in"),
        "low_profile_ratio": f"{rules['low_profile_ratio']:g}{low_profile_mark}",
        "low_profile_length": rules.low_profile_length.value,
        "low_profile_lengths": _low_profile_lengths(package),
        "weights": "; ".join(
            _weight(array, fmt) for array in data.arrays if array.parts_n is not None
        ),
        "links": _links(package) if done.linked else None,
        "friction": friction_tests.page(package),
    }


def _s_ds_note(site: Site) -> Markup:
    """Return whether S_DS is computed or entered, and in the latter case the computed value."""
    symbols = Markup(" and ").join(map(symbol, _origin(site)))
    # In full precision: with S_DS = 1.0504 g, a separation of a permit sheet is 2.12 ft; with
    # 1.050 g it would be 2.11 ft.
    s_ds, s_ms = symbol("S_DS"), site.parameters.s_ms
    if site.s_ds_g is None:
        return Markup(
            "{} is computed from {} in full precision and rounded only for printing."
        ).format(s_ds, symbols)
    note = Markup("{} is as entered in the workbook.").format(s_ds)
    # A value of S_DS that is given goes before what F_a and S_S give: the page shows both.
    if symbols and s_ms:
        value = f"{number(2.0 / 3.0 * s_ms, 3)}{NO_BREAK}g"
        unused = Markup(" The value from {} is {}; it is not used.").format(symbols, value)
        return note + unused
    return note


def _origin(site: Site) -> tuple[str, ...]:
    """Return the symbols of the given values from which S_DS follows; none if there are none."""
    if site.s_ms_g is not None:
        return ("S_MS",)
    # From ASCE 7-22 on S_MS is read off for a site class, so that S_S and F_a give nothing.
    if site.edition.has_site_coefficients and site.s_s_g is not None and site.f_a is not None:
        return ("S_S", "F_a")
    return ()


def _ground_spectrum(package: PackageData) -> Mapping[str, str] | None:
    """Return the numbers of the design spectrum, where it is the target of ground motions."""
    site, t_l_s = package.data.site, package.data.target.t_l_s
    parameters, ground = site.parameters, package.assessment.targets.ground
    if not package.has_ground or ground.name == OWN:
        return None
    if parameters.s_d1 is None or parameters.t_s is None or t_l_s is None:
        return None
    return {
        "clause": site.edition.clause("t_l"),
        "t_0": f"{number(0.2 * parameters.t_s, 3)}{NO_BREAK}s",
        "t_s": f"{number(parameters.t_s, 3)}{NO_BREAK}s",
        "t_l": f"{t_l_s:g}{NO_BREAK}s",
    }


def _rate(array: Array) -> str:
    law = array.friction
    return f" (rate {number(law.rate_s_per_m, 1)}{NO_BREAK}s/m)" if law.is_by_velocity else ""


def _low_profile_lengths(package: PackageData) -> str:
    """Return the length that the height of a center of gravity is compared with, by arrays."""
    takes_base = package.assessment.rules.low_profile_length is LowProfileLength.BASE

    def length_m(array: Array) -> float:
        return array.base_dimension_m if takes_base else array.support_spacing_m

    groups = grouped_by(package.data.arrays, length_m)
    texts = []
    for size_m in sorted(groups):
        group = groups[size_m]
        without = [array.id for array in group if takes_base and array.base_m is None]
        text = f"{ranged(array.id for array in group)} {package.fmt.both(size_m)}"
        if without:
            some = f" for {ranged(without)}" if len(without) < len(group) else ""
            text += f" (support spacing; no base dimension entered{some})"
        texts.append(text)
    return ", ".join(texts)


def _weight(array: Array, fmt: UnitFormat) -> str:
    """Return the weight of an array by its parts, and their sum if that is not the weight."""
    module, ballast, total, entered = (
        fmt.both(weight_n or 0.0, Quantity.WEIGHT)
        for weight_n in (array.module_weight_n, array.ballast_n, array.parts_n, array.weight_n)
    )
    text = f"{array.id} {array.modules} × {module} + {ballast}"
    # Compared as printed: a difference that no reader sees is none.
    return text if total == entered else f"{text} = {total} (entered as above)"


def _arrays(package: PackageData) -> Table:
    columns = (
        (words("Array", 0.9), lambda array: array.id),
        (plain("Slope", 2, "deg", 0.7), lambda array: math.degrees(array.slope_rad)),
        (plain("Slope", 1, "%", 0.6), lambda array: 100.0 * math.tan(array.slope_rad)),
        (plain("Downslope", 0, "deg", 0.9), lambda array: array.downslope_deg),
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
