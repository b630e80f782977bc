"""The printed amplification gives the printed result, at grade as well."""

import math

import pytest

import scenes
import stand_in
from printed import printed


@pytest.mark.parametrize("rule_set", ["SEAOC PV1-2012", "ASCE 7-16", "ASCE 7-22"])
@pytest.mark.parametrize("height_m", [0.0, 5.0, 10.0])
def test_the_numbers_put_in_give_the_result(rule_set, height_m):
    site = {"rule_set": rule_set, "roof_height_m": height_m, "structure_height_m": 10.0}
    given = stand_in.project().site.model_dump() | site
    page = printed(scenes.package(site=given, spectrum=[]), "method")
    formula, result = page.equation("A_{RIG}=")[0].split(" = ")
    value = eval(formula.replace("×", "*").replace(" g", ""))
    assert math.isclose(value, float(result.removesuffix(" g")), abs_tol=6e-4)
