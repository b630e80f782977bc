"""Python arguments that are no real numbers: each is an input error, in every public function."""

from contextlib import contextmanager
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from places import DATA
from solver import InputError, read_record, scene, slide, slide_history, sweep
from solver.records.record import record_from_values

pytestmark = pytest.mark.quick

RECORD = [0.0, 3.0, -3.0, 0.0]

NOT_A_ROW = [
    None,
    np.array(["2026-01-01", "2026-01-02"], dtype="datetime64[ns]"),
    np.array([1, 2], dtype="timedelta64[s]"),
    np.ma.array([1.0, 2.0], mask=[False, True]),
    np.array([True, False]),
    np.array([1.0, 2.0j]),
    ["1.0", "2.0"],
    [True, False],
    [1.0, None],
    [10**400, 0],
    "accelerations",
    b"1234",
    [[1.0, 2.0], [3.0]],
    np.ones((2, 2)),
    5.0,
    {"a": 1.0},
]
NOT_A_NUMBER = [
    np.datetime64("2026-01-01"),
    np.timedelta64(1, "s"),
    "0.5",
    True,
    np.True_,
    10**400,
    None,
    [0.5],
    np.ma.masked,
    1j,
]


def named(value):
    return f"{type(value).__name__} {value!r:.30}"


CALLS = {
    "slide": lambda a, dt, mu: slide(a, dt, slope_rad=0.0, mu=mu),
    "scene": lambda a, dt, mu: scene(a, dt, slope_rad=0.0, mu=mu),
    "slide_history": lambda a, dt, mu: slide_history(a, dt, slope_rad=0.0, mu=mu),
    "sweep": lambda a, dt, mu: sweep(a, dt, slopes_rad=[0.0], mus=mu, scales=[1.0]),
    "record": lambda a, dt, mu: record_from_values("column", a, units="g", dt_s=dt),
}


@contextmanager
def refused(longest=200):
    """Expect an input error, told in short lines."""
    with pytest.raises(InputError) as caught:
        yield caught
    assert all(len(problem) < longest for problem in caught.value.problems)


@pytest.mark.parametrize("name", CALLS)
@pytest.mark.parametrize("given", NOT_A_ROW, ids=named)
def test_what_is_no_row_of_real_numbers_is_refused(name, given):
    with refused():
        CALLS[name](given, 0.01, 0.5)


@pytest.mark.parametrize("name", list(CALLS)[:-1])
@pytest.mark.parametrize("given", NOT_A_NUMBER, ids=named)
def test_what_is_no_number_is_refused(name, given):
    with refused():
        CALLS[name](RECORD, given, 0.5)
    if given is not np.ma.masked:  # in a list, numpy warns and makes it NaN
        with refused():
            CALLS[name](RECORD, 0.01, [given] if name == "sweep" else given)


@pytest.mark.parametrize("given", [["exact"], np.array(["exact", "paper"]), {}, None, 7], ids=named)
@pytest.mark.parametrize("across", [None, RECORD])
def test_what_is_no_name_of_a_method_is_refused(given, across):
    for run in (slide, slide_history):
        with pytest.raises(InputError, match=r"method is .*; give one of exact, ") as caught:
            run(RECORD, 0.01, slope_rad=0.0, mu=0.5, ay_mps2=across, method=given)
        assert len(caught.value.problems) == 1


@pytest.mark.parametrize(
    "changed",
    [{"dt_s": 1e300}, {"dt_s": 1e-300}, {"mu": 1e200}, {"scale": -1e200}, {"g_mps2": 1e130}],
    ids=str,
)
def test_what_overflows_in_one_run_is_refused_in_a_sweep(changed):
    given = {"dt_s": 0.01, "mu": 0.5, "scale": 1.0, "g_mps2": 9.8} | changed
    with pytest.raises(InputError, match="exceed the floating-point range") as of_one:
        slide(RECORD, slope_rad=0.0, **given)
    dt_s, mu, scale = (given.pop(name) for name in ("dt_s", "mu", "scale"))
    with pytest.raises(InputError) as of_all:
        sweep(RECORD, dt_s, slopes_rad=[0.0, 0.1], mus=[mu, 0.2], scales=[0.1, scale], **given)
    assert of_all.value.problems == of_one.value.problems


@pytest.mark.parametrize("given", [value for value in NOT_A_NUMBER if value is not None], ids=named)
def test_the_step_and_the_units_of_a_file_are_checked(given):
    path = DATA / "motions" / "one.txt"
    with pytest.raises(InputError, match="time step dt is"):
        read_record(path, units="g", dt_s=given)
    with pytest.raises(InputError, match="unit is"):
        read_record(path, units=given, dt_s=0.01)


def test_other_types_are_taken_and_long_names_refused():
    run = CALLS["slide"]
    expected = run(RECORD, 0.01, 0.2)
    assert expected.prd_m > 0.0
    singles = run(np.array(RECORD, dtype=np.float32), np.float32(0.01), 0.2)
    assert singles.prd_m == pytest.approx(expected.prd_m, rel=1e-6)
    assert run(np.array([0, 3, -3, 0]), 0.01, Fraction(1, 5)) == expected
    assert run(np.ma.array(RECORD), 0.01, 0.2) == expected
    for path in (Path("x" * 300), Path("a" * 5000), Path("nul\0byte")):
        with refused(longest=400):
            read_record(path, units="g", dt_s=0.01)
