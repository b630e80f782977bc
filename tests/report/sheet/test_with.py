"""A workbook that was read is given other inputs in Python, checked as those of a workbook."""

import pytest

import roofslip
from report.sheet.reading.read import read
from sheets import make, same, type_into
from solver.model import InputError

pytestmark = pytest.mark.quick


def test_other_inputs_are_those_of_a_workbook_that_has_them(tmp_path):
    sheet = read(make(tmp_path))
    first, *others = sheet.project.arrays
    arrays = [first.model_copy(update={"mu": 0.4, "cg_height_m": 0.254}), *others]
    varied = sheet.with_(arrays=arrays, site=sheet.project.site)
    typed = type_into(
        sheet.path, {"Arrays/A1/Friction coefficient": 0.4, "Arrays/A1/CG height": 10.0}
    )
    assert same(varied.project, read(typed).project)
    assert sheet.project.arrays[0] == first


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"mu": -0.4}, "arrays: mu: Input should be greater than or equal to 0"),
        ({"slope_value": 60.0}, "slope is 60"),
        ({"id": "A2"}, "ID is 'A2', already used"),
        ({"id": "A9"}, "which is not in Arrays"),
    ],
)
def test_what_a_workbook_may_not_have_is_refused(tmp_path, changes, said):
    sheet = read(make(tmp_path))
    first, *others = sheet.project.arrays
    with pytest.raises(InputError, match=said):
        sheet.with_(arrays=[first.model_copy(update=changes), *others])


def test_inputs_that_are_not_there_or_at_fault_are_refused(tmp_path):
    with pytest.raises(InputError, match="no input array; give some of project"):
        read(make(tmp_path)).with_(array=[])
    sheet = read(type_into(make(tmp_path), {"Arrays/A1/Weight": "heavy"}))
    with pytest.raises(InputError, match="weight is 'heavy'"):
        sheet.with_(arrays=[])


def test_the_version_is_that_of_the_distribution():
    assert roofslip.__version__.count(".") >= 2
