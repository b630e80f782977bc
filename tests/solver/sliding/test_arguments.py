"""Arguments: what is no real number is refused, records and motions are taken as they are."""

import math
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import solver
from fixtures.errors import input_problems
from fixtures.paths import DATA
from solver import METHODS, InputError, Model, Motion, Outcome, Record, Settings, Status
from solver.records.record import record_from_values

pytestmark = pytest.mark.quick

RECORD = [0.0, 3.0, -3.0, 0.0]

NOT_A_ROW = [
    None,
    np.array(["2026-01-01", "2026-01-02"], dtype="datetime64[ns]"),
    np.ma.array([1.0, 2.0], mask=[False, True]),
    np.array([True, False]),
    np.array([1.0, 2.0j]),
    ["1.0", "2.0"],
    [1.0, None],
    [10**400, 0],
    "accelerations",
    [[1.0, 2.0], [3.0]],
    np.ones((2, 2)),
    5.0,
]
NOT_A_NUMBER = [np.datetime64("2026-01-01"), "0.5", True, 10**400, None, [0.5], np.ma.masked, 1j]


def named(value):
    return f"{type(value).__name__} {value!r:.30}"


CALLS = {
    "slide": lambda a, dt, mu: solver.slide(a, dt, slope_rad=0.0, mu=mu),
    "scene": lambda a, dt, mu: solver.scene(a, dt, slope_rad=0.0, mu=mu),
    "slide_history": lambda a, dt, mu: solver.slide_history(a, dt, slope_rad=0.0, mu=mu),
    "sweep": lambda a, dt, mu: solver.sweep(a, dt, slopes_rad=[0.0], mus=mu, scales=[1.0]),
    "record": lambda a, dt, mu: record_from_values("column", a, units="g", dt_s=dt),
}


def short(call, *arguments, longest=200, **options):
    """Expect an input error, told in short lines."""
    assert all(len(problem) < longest for problem in input_problems(call, *arguments, **options))


@pytest.mark.parametrize("name", CALLS)
@pytest.mark.parametrize("given", NOT_A_ROW, ids=named)
def test_what_is_no_row_of_real_numbers_is_refused(name, given):
    short(CALLS[name], given, 0.01, 0.5)


@pytest.mark.parametrize("name", list(CALLS)[:-1])
@pytest.mark.parametrize("given", NOT_A_NUMBER, ids=named)
def test_what_is_no_number_is_refused(name, given):
    short(CALLS[name], RECORD, given, 0.5)
    if given is not np.ma.masked:  # in a list, numpy warns and makes it NaN
        short(CALLS[name], RECORD, 0.01, [given] if name == "sweep" else given)


@pytest.mark.parametrize("given", [["exact"], np.array(["exact", "paper"]), {}, None, 7], ids=named)
@pytest.mark.parametrize("across", [None, RECORD])
def test_what_is_no_name_of_a_method_is_refused(given, across):
    for run in (solver.slide, solver.slide_history):
        with pytest.raises(InputError, match=r"method is .*; use one of exact, ") as caught:
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
        solver.slide(RECORD, slope_rad=0.0, **given)
    dt_s, mu, scale = (given.pop(name) for name in ("dt_s", "mu", "scale"))
    with pytest.raises(InputError) as of_all:
        solver.sweep(
            RECORD, dt_s, slopes_rad=[0.0, 0.1], mus=[mu, 0.2], scales=[0.1, scale], **given
        )
    assert of_all.value.problems == of_one.value.problems


@pytest.mark.parametrize("given", [value for value in NOT_A_NUMBER if value is not None], ids=named)
def test_the_step_and_the_units_of_a_file_are_checked(given):
    path = DATA / "motions" / "one.txt"
    with pytest.raises(InputError, match="time step dt is"):
        solver.read_record(path, units="g", dt_s=given)
    with pytest.raises(InputError, match="unit is"):
        solver.read_record(path, units=given, dt_s=0.01)


def test_other_types_are_taken_and_long_names_refused():
    run = CALLS["slide"]
    expected = run(RECORD, 0.01, 0.2)
    assert expected.prd_m > 0.0
    singles = run(np.array(RECORD, dtype=np.float32), np.float32(0.01), 0.2)
    assert singles.prd_m == pytest.approx(expected.prd_m, rel=1e-6)
    assert run(np.array([0, 3, -3, 0]), 0.01, Fraction(1, 5)) == expected
    assert run(np.ma.array(RECORD), 0.01, 0.2) == expected
    for path in (Path("x" * 300), Path("a" * 5000), Path("nul\0byte")):
        short(solver.read_record, path, longest=400, units="g", dt_s=0.01)


DT_S = 0.01
SCENE = {"slope_rad": 0.03, "mu": 0.3}


@pytest.fixture
def components(noise):
    return tuple(
        Record(name=name, dt_s=DT_S, a_mps2=factor * np.roll(noise, shift))
        for name, factor, shift in (("x", 1.0, 0), ("y", 0.8, 300), ("z", 0.3, 700))
    )


def of_arrays(components):
    x, y, z = (record.a_mps2 for record in components)
    return {"ax_mps2": x, "ay_mps2": y, "az_mps2": z, "dt_s": DT_S}


def test_records_and_motions_are_taken_with_their_step_and_scale(components):
    x, y, z = components
    for run in (solver.slide, solver.scene):
        by_array = run(x.a_mps2, DT_S, **SCENE)
        assert repr(run(x, **SCENE)) == repr(by_array)
    together = solver.slide(x, ay_mps2=y, az_mps2=z, **SCENE)
    assert together == solver.slide(**of_arrays(components), **SCENE)
    assert together.prd_m > 0.0
    motion = solver.motion(*components, scale=1.5)
    assert solver.slide(motion, scale=0.8, **SCENE) == solver.slide(
        **of_arrays(components), scale=0.8 * 1.5, **SCENE
    )
    history = solver.slide_history(motion, **SCENE)
    assert history.result == solver.slide(motion, **SCENE)


def test_what_a_record_or_a_motion_contradicts_is_refused(components):
    x, y, _ = components
    coarse = replace(y, dt_s=0.02)
    whole = solver.motion(x)
    with pytest.raises(InputError, match="dt_s is entered with a record"):
        solver.slide(x, DT_S, **SCENE)
    with pytest.raises(InputError, match=r"steps of 0\.01 s and 0\.02 s"):
        solver.slide(x, ay_mps2=coarse, **SCENE)
    with pytest.raises(InputError, match="further components"):
        solver.slide(whole, ay_mps2=y, **SCENE)
    with pytest.raises(InputError, match="one component"):
        solver.slide(x, ay_mps2=whole, **SCENE)
    with pytest.raises(InputError, match="dt_s is None"):
        solver.slide(x.a_mps2, **SCENE)


def test_a_motion_has_its_names_polarities_and_checked_lengths(components):
    motion = solver.motion(components[0])
    assert (motion.id, motion.signs, motion.scale) == ("x", (1, -1), 1.0)
    assert not motion.has_transverse
    assert [each.name for each in motion.orientations] == ["record +", "record −"]
    first = solver.motion(*components, id="A", source="made", scale=2.0)
    again = solver.motion(first, scale=1.5)
    assert isinstance(again, Motion)
    assert (again.id, again.source, again.scale) == ("A", "made", 3.0)
    assert solver.motion(first, id="B").id == "B"
    one_way = solver.motion(components[0], signs=(1,))
    assert solver.motion(one_way, scale=0.5).signs == (1,)
    assert solver.motion(one_way, signs=(1, -1)).signs == (1, -1)
    x, y, _ = components
    with pytest.raises(InputError, match="use the shape of ax_mps2"):
        solver.motion(x, replace(y, a_mps2=y.a_mps2[:-1]))
    for signs in ((), (2,)):
        with pytest.raises(InputError, match="signs is"):
            solver.motion(x, signs=signs)


def test_results_without_a_slip_lifted_and_in_two_axes_have_their_words(components):
    """The examples of the public functions have the others."""
    x, y, z = components
    both = solver.slide(x, ay_mps2=y, az_mps2=z, **SCENE)
    assert f"{1e3 * both.residual_across_m:+.1f} mm cross-slope at the end" in repr(both)
    assert repr(solver.slide(x, slope_rad=0.0, mu=9.0)) == "SlideResult: no slip"
    lifted = solver.slide([0.0] * 4, 0.1, az_mps2=[0.0, 0.0, 0.0, -20.0], **SCENE)
    assert repr(lifted) == f"SlideResult: {Status.UPLIFT.sentence}"
    scene = solver.scene(x, az_mps2=z, **SCENE)
    solution = solver.solve(scene, Settings(forced=Model.ONE_AXIS))
    about, result, beyond = repr(solution).splitlines()
    assert about == f"Solution: {solution.model.title}; {solution.reason}"
    assert result == repr(solution.result)
    assert f"coefficient {solution.friction_demand:.3f}; " in beyond
    assert f"more than {1e3 * solution.next_effect_m:.2g} mm" in beyond


def test_an_own_method_is_run_beside_the_eight_without_an_error(components):
    def follow(scene, parameters, samples):
        u_m = scene.mu * scene.dt * parameters["factor"]
        return Outcome(True, u_m, 0.0, u_m, 0.0, 1.0, 3)

    mine = replace(METHODS["paper"], name="mine", parameters={"factor": 2.0}, follow=follow)
    result = solver.slide(components[0], slope_rad=0.0, mu=0.3, method=mine)
    assert (result.prd_m, result.n_stops) == (0.3 * DT_S * 2.0, 3)
    assert math.isnan(result.error_m)
    half = solver.slide(components[0], slope_rad=0.0, mu=0.3, method=mine, factor=1.0)
    assert half.prd_m == 0.5 * result.prd_m
    with pytest.raises(InputError, match="factor is 'x'; use a finite number"):
        solver.slide(components[0], slope_rad=0.0, mu=0.3, method=mine, factor="x")
    mine = replace(METHODS["frozen-normal"], name="exact")
    history = solver.slide_history(components[0], **SCENE, method=mine)
    assert math.isnan(history.result.error_m)
    assert history.events == ()


def test_the_exact_method_is_taken_as_an_object_in_two_axes():
    scene = {"slope_rad": 0.01, "mu": 0.2, "ay_mps2": [0.5 * a for a in PULSE]}
    by_name = solver.slide(PULSE, 0.1, **scene, method="exact")
    assert solver.slide(PULSE, 0.1, **scene, method=METHODS["exact"]) == by_name
    mine = replace(METHODS["frozen-normal"], name="exact")
    with pytest.raises(InputError, match="two axes and velocity-dependent friction need 'exact'"):
        solver.slide(PULSE, 0.1, **scene, method=mine)


PULSE_G = [0.0, 0.4, -0.4, 0.0, 0.0, 0.0]
PULSE = [9.80665 * a for a in PULSE_G]


@pytest.mark.parametrize(("units", "size"), [("g", 9.80665), ("cm/s2", 0.01), ("m/s2", 1.0)])
def test_arrays_are_taken_in_their_units(units, size):
    given = [a / size for a in PULSE]
    how = {"slope_rad": 0.01, "mu": 0.2, "az_mps2": [0.1 * a for a in given], "ay_mps2": given}
    plain = how | {"az_mps2": [0.1 * a for a in PULSE], "ay_mps2": PULSE}
    found = solver.slide(given, 0.1, units=units, **how)
    assert found.prd_m == pytest.approx(solver.slide(PULSE, 0.1, **plain).prd_m, rel=1e-12)
    moved = solver.slide_history(given, 0.1, units=units, **how)
    assert moved.result.prd_m == found.prd_m
    assert solver.scene(given, 0.1, units=units, **how).ax_mps2 == pytest.approx(PULSE)
    assert solver.motion(given, dt_s=0.1, units=units).ax_mps2 == pytest.approx(PULSE)
    axes = {"slopes_rad": [0.01], "mus": [0.2], "scales": [1.0]}
    swept = solver.sweep(given, 0.1, units=units, **axes)
    assert swept.prd_m == pytest.approx(solver.sweep(PULSE, 0.1, **axes).prd_m, rel=1e-12)


def test_units_are_known_and_too_weak_shaking_is_asked_about():
    record = solver.record_from_values("r", PULSE_G, units="g", dt_s=0.1)
    said = "units are entered with a record or a motion, which is in m/s2; omit them"
    with pytest.raises(solver.InputError, match=said):
        solver.slide(record, slope_rad=0.0, mu=0.2, units="g")
    with pytest.raises(solver.InputError, match=r"units is 'ft/s2'; use one of g, m/s2, cm/s2"):
        solver.slide(PULSE, 0.1, slope_rad=0.0, mu=0.2, units="ft/s2")
    weak = [0.2 * a for a in PULSE_G]  # 0.08 where 3.9 m/s2 slips
    with pytest.warns(UserWarning, match=r"reach 0.08 m/s2, and 3.92 m/s2 slips: use units='g'"):
        solver.slide(weak, 0.1, slope_rad=0.0, mu=0.4)
    # Said to be so, or of a record, it is not; nor is shaking that may slip something.
    solver.slide(weak, 0.1, slope_rad=0.0, mu=0.4, units="m/s2")
    solver.slide(weak, 0.1, slope_rad=0.0, mu=0.1)
    solver.slide(solver.record_from_values("r", weak, units="m/s2", dt_s=0.1), slope_rad=0, mu=0.4)


def series(name, index):
    return pd.Series(PULSE_G, index=index, name=name)


TIMES_S = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5]


@pytest.mark.parametrize(
    ("name", "index", "how"),
    [
        ("acceleration_g", TIMES_S, {}),
        ("a [g]", pd.to_timedelta(TIMES_S, "s"), {}),
        ("a_g", pd.date_range("2026-01-01", periods=6, freq="100ms"), {}),
        ("x", TIMES_S, {"units": "g"}),
        ("a_g", range(6), {"dt_s": 0.1}),
    ],
)
def test_the_index_of_a_series_is_its_time_and_its_name_may_have_the_unit(name, index, how):
    expected = solver.slide(PULSE_G, 0.1, slope_rad=0.0, mu=0.2, units="g")
    given = series(name, index)
    assert solver.slide(given, slope_rad=0.0, mu=0.2, **how) == expected
    assert solver.motion(given, **how).dt_s == 0.1


@pytest.mark.parametrize(
    ("name", "index", "how", "problem"),
    [
        ("x", TIMES_S, {}, "ax_mps2 is a Series without a unit; use units, or a name such as"),
        ("a_g", [*TIMES_S[:5], 0.6], {}, "ax_mps2 has an uneven index; use times at one step"),
        ("a_g", TIMES_S, {"dt_s": 0.1}, "dt_s is entered with a record or a motion, which has"),
        ("a_g", range(6), {}, "dt_s is None; use a number of seconds above 0"),
        ("a_g", TIMES_S, {"ay_mps2": PULSE_G}, "some components are Series, in other units than"),
    ],
)
def test_a_series_without_unit_or_even_times_is_refused(name, index, how, problem):
    (told,) = input_problems(solver.slide, series(name, index), slope_rad=0.0, mu=0.2, **how)
    assert told.startswith(problem)
