"""The appendix of symbols, each with one meaning. Read `SYMBOLS`."""

from __future__ import annotations

import re
from collections.abc import Mapping
from itertools import zip_longest

from markupsafe import Markup, escape

from report.assessment.design.tested_friction import STANDARD
from report.document.tables import headed
from report.pages.parts import PackageData
from report.text.units import NO_BREAK
from report.typeset.equations import symbol
from solver.rules.hazard import EDITIONS

SYMBOLS: Mapping[str, str] = {
    "A_FLX": f"AC156 acceleration from 1.3 to 8.3{NO_BREAK}Hz",
    "A_RIG": f"AC156 acceleration from 33.3{NO_BREAK}Hz",
    "a_h": "horizontal roof acceleration along the slope",
    "a_y": "cross-slope horizontal roof acceleration",
    "a_v": "vertical roof acceleration, positive upward",
    "a_down": "acceleration at which downslope sliding begins",
    "a_up": "acceleration at which upslope sliding begins",
    "a_p": "component amplification factor",
    "C_AR": "component resonance ductility factor",
    "C_t": "coefficient of the approximate period",
    "b": "smallest support spacing of the array",
    "c": "height of the array's center of gravity",
    "c_1": "required interconnection strength / (S_DS W_1)",
    "c_2": "minimum interconnection strength / W_1",
    "F": "required strength of the interconnection",
    "F_a": "site coefficient, short period",
    "F_v": f"site coefficient at 1{NO_BREAK}s",
    "F_p": "seismic design force of a component",
    "G": "driving force along the slope",
    "g": "acceleration of gravity",
    "H_f": "force amplification factor for height in the structure",
    "h": "height of the structure above the base",
    "I": "importance factor for a separation: I_p, or I_e at edges",
    "I_e": "importance factor of the building",
    "I_p": "importance factor of a component",
    "k": "required separation / design displacement",
    "k_a": "factor on the mean or on the largest PRD",
    "k_f": "floor / prescriptive displacement",
    "k_p": "prescriptive displacement / square of S_DS − 0.4",
    "m": "mass of the array",
    "N": "normal force between array and roof",
    "n": "number of motions",
    "PRD": "peak displacement of the array relative to the roof",
    "R_p": "component response modification factor",
    "R_po": "component strength factor",
    "R_μ": "structure ductility reduction factor",
    "r": "rate constant of the velocity-dependent friction",
    "S_1": f"mapped spectral acceleration at 1{NO_BREAK}s",
    "S_S": "mapped spectral acceleration, short period",
    "S_MS": "MCE spectral acceleration, short period",
    "S_M1": f"MCE spectral acceleration at 1{NO_BREAK}s",
    "S_DS": "design spectral acceleration, short period",
    "S_D1": f"design spectral acceleration at 1{NO_BREAK}s",
    "S_a": "design spectral acceleration",
    "s": "sliding displacement, positive downslope",
    "s_req": "required separation",
    "T": "period",
    "T_0": "start of the plateau of the design spectrum",
    "T_1": "period of the building, as entered",
    "T_a": "approximate period of the building",
    "T_L": "long-period transition period",
    "T_S": "end of the plateau of the design spectrum",
    "u": "horizontal displacement relative to the roof",
    "V": "shear between array and roof",
    "V_s30": f"shear-wave velocity of the upper 30{NO_BREAK}m at a recording station",
    "v": "sliding velocity",
    "W": "weight of the array with ballast",
    "W_1": "weight on the lighter side of a section",
    "W_p": "weight of a component",
    "x": "exponent of h in the approximate period",
    "z": "height of the supporting roof above the base",
    "Δ": "design displacement",
    "Δ_MPV": "prescriptive displacement of the rule set",
    "Δ_RHA": "displacement from response-history analysis",
    "Δ_floor": "smallest design displacement without peer review",
    "Δ_max": "largest PRD of the motions",
    "Δ_min": "minimum of the prescriptive displacement",
    "Δ_A,B,C": "prescriptive displacement in SDC A, B, C",
    "Δ_d": "design displacement in direction d",
    "θ": "slope of the roof",
    "μ": "friction coefficient between array and roof",
    "μ_fast": "friction coefficient at high velocity",
    "μ_slow": "friction coefficient at low velocity",
    "φ": "friction angle, arctan μ",
}


# Those with a subscript: a letter alone may be a word.
_NAME = re.compile(rf"\b(?:{'|'.join(name for name in SYMBOLS if '_' in name)})\b")


def with_symbols(text: str) -> Markup:
    """Return a text with its symbols typeset, such as `S_DS`; the rest is escaped."""
    plain = str(escape(text))
    return Markup(_NAME.sub(lambda match: str(symbol(match[0])), plain))


def friction_standard(package: PackageData) -> str:
    """Return the standard of the friction tests if it is a document to be cited, else nothing."""
    standard = package.data.friction_tests.standard
    return standard if STANDARD.search(standard) else ""


def page(package: PackageData) -> Mapping[str, object]:
    """Return the list of symbols."""
    known = package.data.site.edition
    # The names of the force factors differ by edition of ASCE 7: a_p and R_p, C_AR and R_po.
    factors = {name for edition in EDITIONS.values() for name in edition.force_factors}
    left_out = factors.difference(known.force_factors)
    if not known.has_site_coefficients:
        left_out |= {"F_a", "F_v"}
    items = [
        (symbol(name), with_symbols(meaning))
        for name, meaning in SYMBOLS.items()
        if name not in left_out
    ]
    half = (len(items) + 1) // 2
    pairs = zip_longest(items[:half], items[half:], fillvalue=("", ""))
    symbol_column, meaning_column = ("Symbol", 0.5), ("Meaning", 3)
    columns = (symbol_column, meaning_column) * 2
    rows = [[*left, *right] for left, right in pairs]
    return {"symbols": headed(*columns, rows=rows, kind="compact")}
