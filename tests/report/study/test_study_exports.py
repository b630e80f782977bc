"""Dispersions of a fragility by name, and its exports, read by the libraries of the field."""

import dataclasses
import json
import math

import numpy as np
import pytest

from fixtures import pages
from fixtures.marks import by_day
from fixtures.study_workbooks import (
    command,
    having,
    library,
    sheet_rows,
    study_input,
    with_fit,
    with_study,
    write,
)
from report.study.capacity_runs import curves_of
from report.study.dispersions import dispersions, exported
from report.study.exports import component_id, export_files, known_states
from report.study.run_study import estimate, planned, run_study
from report.study.sentences import headline
from report.study.study_input import Intensity, StudyArray
from report.study.study_plan import FRICTION, SLOPE
from solver.studies.capacity import capacities
from solver.studies.fragility import UNKNOWN, Lognormal, fit_lognormal
from solver.studies.runs import Runner, Track

ROOF, GROUND = "roof motion, not of the ground.", "ground motion, not of the roof."


# The reader sets an option that its pandas no longer needs.
@pytest.mark.filterwarnings("ignore::pandas.errors.Pandas4Warning")
@pytest.mark.nightly
def test_pelicun_reads_the_library(made, results, tmp_path):
    dlml = pytest.importorskip("dlml")
    path = made[0] / "out/study/fragility.csv"
    found = dlml._tabular.load_tabular(path)
    theirs = dlml.get_fragility(P58)
    assert found.columns.names == theirs.columns.names
    assert [c for c in theirs.columns if c[0] == "LS1" and c not in found.columns] == []
    known = [one for one in results.arrays if known_states(one)]
    assert len(found) == len(known) > 0
    row = found.iloc[0]
    assert row["Demand", "Type"] in dlml.vocabulary.EDP_TYPES
    assert row["Demand", "Unit"] == "g"
    array = min(known, key=lambda one: component_id(results, one))  # the reader sorts
    for k, state in enumerate(known_states(array), start=1):
        name, fitted = f"LS{k}", state.fragility.fitted
        assert row[name, "Family"] == "lognormal"
        assert float(row[name, "Theta_0"]) == pytest.approx(fitted.theta, rel=1e-5)
        assert float(row[name, "Theta_0"]) <= fitted.theta * (1 + 1e-9)
        total = math.hypot(fitted.beta, *state.effects.values())
        assert float(row[name, "Theta_1"]) == pytest.approx(total, rel=1e-5)
        assert float(row[name, "Theta_1"]) >= total * (1 - 1e-9)


@pytest.mark.nightly
def test_states_that_are_not_determined_leave_no_gap_where_pelicun_would_stop(results):
    """It takes the k-th state that has a median as damage state k, and fails without the first."""
    fits = UNKNOWN, Lognormal(theta=1.0, beta=0.1), UNKNOWN
    states = tuple(map(with_fit, results.arrays[0].states, fits))
    one = dataclasses.replace(results.arrays[0], states=states)
    row = library(having(results, one))["BSA.S1"]
    assert (row["LS1-Family"], row["LS1-Theta_0"]) == ("lognormal", "1.00000")
    assert row["LS1-Description"] == "Half the clearance is used."
    assert {row[f"LS{k}-{name}"] for k in (2, 3, 4) for name in ("Theta_0", "Description")} == {""}
    assert "Dispersions of LS1 (half the clearance is used): record" in row["Comments"]
    assert ". Not determined: slip begins and RTU & co is reached. Mass" in row["Comments"]
    assert library(having(results, one)).keys() == {"BSA.S1"}
    none = dataclasses.replace(one, states=states[:1])
    assert export_files(having(results, none)) == {}


P58 = "seismic/building/component/FEMA P-58 2nd Edition"


@pytest.mark.parametrize(
    ("changes", "demand", "said", "which"),
    by_day(
        [({}, ("Peak Floor Acceleration", "g"), "the peak horizontal acceleration of the", ROOF),
         ({"intensity": Intensity.PGA}, ("Peak Ground Acceleration", "g"),
          "the peak horizontal acceleration of the", GROUND),
         ({"intensity": Intensity.PPV}, ("Peak Floor Velocity", "mps"),
          "the peak horizontal velocity of the", ROOF),
         ({"intensity": Intensity.SA1}, ("Spectral Acceleration|1.0", "g"),
          "the horizontal spectral acceleration at 1 s with 5% damping of the", ROOF)],
        1,
    ),
)  # fmt: skip
def test_each_array_says_of_what_measure_and_of_which_motion_it_is(
    results, changes, demand, said, which
):
    for row in library(with_study(results, **changes)).values():
        assert (row["Demand-Type"], row["Demand-Unit"]) == demand
        assert f"{demand[0]} in {demand[1]} is {said} {which}" in row["Comments"]
        assert "on the peak relative displacement of a motion, not on a design" in row["Comments"]
        assert row["Comments"].endswith(f" Study {results.manifest['identity'][:16]}.")


SIGMA = np.log([0.38, 0.40, 0.42]).std(ddof=1)
"""Standard deviation of ln of the tests of mat A."""

TOLERANCE_DEG = 0.3
OFF_RAD = math.radians(TOLERANCE_DEG) / math.sqrt(3.0)
"""Standard deviation of a uniform distribution."""


def study(**changes):
    """A study of PPV with arrays on a slope, on none, and of a mat without tests."""
    arrays = (
        StudyArray(id="S1", mat="A", slope_deg=2.0, clearance_m=0.1),
        StudyArray(id="S2", mat="A", slope_deg=0.0, clearance_m=0.1),
        StudyArray(id="S3", mat="B", slope_deg=2.0, clearance_m=0.1),
    )
    about = {
        "slopes_deg": "2", "intensity": Intensity.PPV, "intensities": "0.5 to 4 by 0.5",
        "slope_tolerance_deg": TOLERANCE_DEG, "study_arrays": arrays,
    }  # fmt: skip
    return study_input(**{**about, **changes})


@pytest.fixture(scope="module")
def dispersed(tmp_path_factory):
    folder = write(tmp_path_factory.mktemp("dispersion"), study(), motions=5)
    return run_study(planned(folder)[0], folder / "out")


def half_log(above, below):
    return 0.5 * abs(math.log(above / below))


def yields(mu, slope_rad):
    """Acceleration / g at which a block without vertical motion begins to slide downslope."""
    return math.tan(math.atan(mu) - slope_rad)


def test_the_dispersions_of_slip_are_those_of_the_yield_acceleration(dispersed):
    """It is proportional to the intensity at which slip begins, of every motion."""
    theta = math.radians(2.0)
    on_slope, flat, untested = (one.states[0].effects for one in dispersed.arrays)
    mu = dispersed.arrays[0].plan.mu
    above, below = (yields(mu * math.exp(s * SIGMA), theta) for s in (1.0, -1.0))
    assert on_slope[FRICTION] == pytest.approx(half_log(above, below), rel=1e-9)
    assert flat[FRICTION] == pytest.approx(SIGMA, rel=1e-9)
    above, below = (yields(mu, theta - s * OFF_RAD) for s in (1.0, -1.0))
    assert on_slope[SLOPE] == pytest.approx(half_log(above, below), rel=1e-9)
    assert untested.keys() == {SLOPE}


def test_a_slope_about_none_disperses_as_its_size(dispersed):
    """Both polarities: a roof that tilts the other way is the same roof."""
    mu = dispersed.arrays[1].plan.mu
    wanted = half_log(yields(mu, 0.0), yields(mu, OFF_RAD))
    assert dispersed.arrays[1].states[0].effects[SLOPE] == pytest.approx(wanted, rel=1e-9)
    notes = [" ".join(table_of(dispersed, one).notes) for one in dispersed.arrays]
    assert ["The slope below is 0" in said for said in notes] == [False, True, False]


def table_of(dispersed, one):
    """The dispersions on the page of an array."""
    page = pages.study(dataclasses.replace(dispersed, arrays=(one,)))
    return page.table("Dispersions of the capacity by name")


def test_the_dispersion_of_friction_of_a_limit_obeys_the_scaling_of_a_level_roof(dispersed):
    """On no slope PRD is proportional where friction and intensity are scaled by one factor.

    So the capacity for d at friction f mu is f times the capacity for d / f at mu.
    """
    one = dispersed.arrays[1]
    limits = [0.1 * math.exp(s * SIGMA) for s in (1.0, -1.0)]
    curves = curves_of(Runner(dispersed.plan.campaign), one.plan, one.plan.mu, 0.0)
    found = capacities(curves, limits, np.arange(0.1, 6.0, 0.1), is_censoring=False)
    below, above = (fit_lognormal(capacity).theta for capacity in found)
    wanted = half_log(above * math.exp(SIGMA), below * math.exp(-SIGMA))
    assert one.states[2].effects[FRICTION] == pytest.approx(wanted, abs=1e-4)


def test_the_dispersion_of_slope_of_a_limit_is_that_of_runs_on_both_slopes(dispersed):
    one, theta = dispersed.arrays[0], []
    for s in (1.0, -1.0):
        slope = 2.0 + s * math.degrees(OFF_RAD)
        curves = curves_of(Runner(dispersed.plan.campaign), one.plan, one.plan.mu, slope)
        at = [_crossing(curve) for curve in curves]
        theta.append(math.exp(np.log(at).mean()))
    assert one.states[2].effects[SLOPE] == pytest.approx(half_log(*theta), abs=2e-4)


def _crossing(curve):
    """Lowest intensity of a fine grid at which the PRD exceeds 0.1 m, interpolated."""
    x = np.linspace(0.3, 4.0, 4000)
    prd = curve.prd_m(x)
    first = int(np.flatnonzero(~(prd <= 0.1))[0])
    return np.interp(0.1, prd[first - 1 : first + 1], x[first - 1 : first + 1])


def test_the_exported_dispersion_is_the_square_root_of_the_sum_of_squares(dispersed):
    one = dispersed.arrays[0]
    state = one.states[2]
    parts = {part.name: part.beta for part in dispersions(dispersed, one, state)}
    assert parts["friction"] == state.effects[FRICTION] > 0.0
    assert parts["slope"] == state.effects[SLOPE] > 0.0
    squares = sum(b * b for b in (state.fragility.fitted.beta, parts["friction"], parts["slope"]))
    assert exported(dispersed, one, state).beta == pytest.approx(math.sqrt(squares), rel=1e-12)
    said = {key: row["Comments"] for key, row in library(dispersed).items()}
    assert "(tolerance, standard deviation 0.17 deg)" in said["BSA.S1"]
    assert "(tests of A, standard deviation of ln μ 0.050)" in said["BSA.S1"]
    assert "friction not included (mat B has no tests)" in said["BSA.S3"]
    assert "Mass has no effect: each array is one rigid block" in said["BSA.S1"]


def test_the_workbook_has_the_dispersions_by_name_and_the_exported_one(dispersed):
    rows = sheet_rows(dispersed, "Fragility")
    states = [(one, state) for one in dispersed.arrays for state in one.states]
    for row, (one, state) in zip(rows, states, strict=True):
        if not state.fragility.fitted.is_known:
            continue
        for part in dispersions(dispersed, one, state):
            wanted = pytest.approx(part.beta) if part.beta else "none"
            assert row[f"Beta, {part.name}"] == wanted
        assert row["Beta exported"] == pytest.approx(exported(dispersed, one, state).beta)
    assert rows[-1]["Beta, friction"] == "none"
    assert rows[0]["Beta, friction"] > 0.0


def test_a_dispersion_that_cannot_be_determined_is_said_and_keeps_its_column(dispersed):
    one = dispersed.arrays[0]
    state = one.states[2]
    effects = {FRICTION: math.nan, SLOPE: 0.01}
    states = (*one.states[:2], dataclasses.replace(state, effects=effects))
    changed = dataclasses.replace(one, states=states)
    parts = {part.name: part for part in dispersions(dispersed, changed, states[2])}
    assert (parts["friction"].beta, parts["friction"].source) == (0.0, "not determined")
    table = table_of(dispersed, changed)
    names = [heading.partition(":")[0] for heading in table.headings]
    assert table.cells[-1][names.index("Friction")] == "not determined"


def test_the_runs_of_the_capacities_are_counted_and_no_more_than_a_dry_run_says(
    tmp_path, monkeypatch
):
    folder = write(tmp_path, study(study_arrays=study().study_arrays[:1]), motions=2)
    said = estimate(planned(folder)[0])
    ran, fill = [], Track.fill

    def counted(self, cases, chosen, rows, column):
        ran.append(len(chosen))
        fill(self, cases, chosen, rows, column)

    monkeypatch.setattr(Track, "fill", counted)
    made = run_study(planned(folder)[0], folder / "out")
    assert made.capacity_runs == sum(ran) - said.runs > 0
    written = json.loads((folder / "out" / "manifest.json").read_text())
    assert written["capacity_runs"] == made.capacity_runs <= said.capacity_runs
    assert said.capacity_runs < 3 * made.capacity_runs
    done = command(folder, "--dry-run")
    assert f"at most {said.capacity_runs:,} more runs for the capacities" in done.output
    assert f", and {made.capacity_runs:,} for the capacities" in headline(made)[0]
    assert f" {made.capacity_runs:,} more runs were made to find the capacities" in pages.study(
        made
    )
