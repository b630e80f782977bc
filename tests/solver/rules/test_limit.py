"""A limit and the value found: units, whose it is, and what rounding forgives."""

import math

import pytest

from solver.rules.limit import MOTIONS, PROGRAM, Limit, Measure

pytestmark = pytest.mark.quick


def made(found, limit=20.0, **more):
    return Limit(title="", found=found, limit=limit, **{"is_at_least": True} | more)


def test_limits_have_units_and_say_whose_they_are():
    units = {measure.name: measure.unit for measure in Measure}
    assert units == {"ANGLE_DEG": "deg", "LENGTH_M": "m", "TIME_S": "s", "COUNT": "", "PLAIN": ""}
    assert made(1.0, provision=PROGRAM).is_program_limit
    assert not made(1.0, provision=MOTIONS).is_program_limit
    assert not MOTIONS.verified
    assert PROGRAM.verified


@pytest.mark.parametrize("is_at_least", [True, False])
def test_a_value_equal_within_rounding_is_permitted(is_at_least):
    side = -1.0 if is_at_least else 1.0
    assert made(20.0 * (1.0 + side * 5e-10), is_at_least=is_at_least).ok
    assert not made(20.0 * (1.0 + side * 2e-9), is_at_least=is_at_least).ok
    assert not made(math.nan, is_at_least=is_at_least, may_exceed=True).ok
