"""The printed amplification gives the printed result, at grade as well."""

import math

import pytest

import stand_in
from report.pages.demand import demand_lines
from report.pages.registry import package_data


@pytest.mark.parametrize("rule_set", ["SEAOC PV1-2012", "ASCE 7-16", "ASCE 7-22"])
@pytest.mark.parametrize("height_m", [0.0, 5.0, 10.0])
def test_the_numbers_put_in_give_the_result(rule_set, height_m):
    data = stand_in.project()
    site = {"rule_set": rule_set, "roof_height_m": height_m, "structure_height_m": 10.0}
    made = stand_in.project(site=data.site.model_dump() | site, spectrum=[])
    package = package_data(stand_in.assess_input(made, stand_in.motions(3, seconds=4.0)))
    rigid = next(line for line in demand_lines(package) if "A_{RIG}=" in line.latex)
    ((formula, result),) = rigid.steps
    value = eval(formula.replace("×", "*").replace(" g", ""))
    assert math.isclose(value, float(result.removesuffix(" g")), abs_tol=6e-4)
