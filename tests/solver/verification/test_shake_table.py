"""Tests of a shake table are read strictly, and judged by the acceptance that is stated.

The slip is made: closed forms multiplied by a known factor. Nothing here was measured.
"""

import math

import numpy as np
import pytest

import tables
from growth import grows_faster
from solver.model import InputError
from solver.sliding.least_model import Model
from solver.verification.checks import G, trapezoid
from solver.verification.shake_table import MOST_TESTS, Data, compare, table_tests

pytestmark = pytest.mark.quick

GOOD = ("P1", "computed", "made", "x.csv", "", "", "0", "0.1", "100", "")


@pytest.fixture
def folder(tmp_path):
    tables.write_record(tmp_path / "x.csv", trapezoid(-4.0, 30, 100))
    return tmp_path


def changed(row, cells):
    """A row of `tests.csv` with other texts in some columns."""
    return [cells.get(at, text) for at, text in enumerate(row)]


def faults(folder):
    with pytest.raises(InputError) as error:
        table_tests(folder)
    return error.value.problems


def test_ratios_are_those_with_which_the_tests_were_made(tmp_path):
    wanted = (0.8, 0.95, 1.0, 1.05, 1.2, 1.4)
    tables.write_folder(tmp_path, wanted)
    table = compare(table_tests(tmp_path))
    # A file has 9 decimals of a millimeter; gravity of table and closed form are equal.
    np.testing.assert_allclose(table.ratios, wanted, rtol=1e-9)
    assert table.median == pytest.approx(1.025, rel=1e-9)
    assert table.share_within == pytest.approx(5.0 / 6.0)
    assert (table.is_accepted, table.is_measured, table.validates) == (True, False, False)
    assert {run.model for run in table.runs} == {Model.ONE_AXIS}


@pytest.mark.parametrize(
    ("ratios", "accepted"),
    [
        ((0.91,) * 5, True),
        ((0.89,) * 5, False),
        ((1.11,) * 5, False),
        ((1.0, 1.0, 1.0, 1.0, 1.34), True),
        ((1.0, 1.0, 1.0, 0.74, 1.34), False),
        ((1.0, 1.0, 1.0, 1.0), False),
    ],
)
def test_the_acceptance_is_the_median_the_share_and_five_tests(tmp_path, ratios, accepted):
    tables.write_folder(tmp_path, ratios, data="measured")
    table = compare(table_tests(tmp_path))
    assert (table.is_accepted, table.validates) == (accepted, accepted)


def test_computed_slip_among_measured_validates_nothing_and_none_has_no_ratio(tmp_path):
    rows = tables.write_folder(tmp_path, (1.0,) * 5, data="measured")
    still = changed(rows[0], {0: "still", 8: "0.5"})
    tables.write_tests(tmp_path, [*rows[:4], changed(rows[4], {1: "computed"}), still])
    table = compare(table_tests(tmp_path))
    assert (table.is_accepted, table.validates) == (True, False)
    assert (len(table.runs), table.ratios.size) == (6, 5)


def test_a_run_without_a_result_is_outside_and_leaves_no_median(tmp_path):
    rows = tables.write_folder(tmp_path, (1.0,) * 9)
    tables.write_record(tmp_path / "z.csv", trapezoid(-2.0 * G, 30, 400))
    tables.write_tests(tmp_path, [changed(rows[0], {5: "z.csv"}), *rows[1:]])
    table = compare(table_tests(tmp_path))
    assert math.isnan(table.median)
    assert table.share_within == pytest.approx(8.0 / 9.0)
    assert not table.is_accepted


def test_three_axes_channels_static_friction_and_units_are_read(tmp_path):
    a = trapezoid(-4.0, 30, 100)
    lines = [f"{i * 0.01:.2f},{x!r},{0.3 * x!r},{0.1 * x!r}" for i, x in enumerate(a.tolist())]
    text = "time [s],AX [m/s2],AY [m/s2],AZ [m/s2]\n" + "\n".join(lines) + "\n"
    (tmp_path / "all.csv").write_text(text)
    headings = (*tables.HEADINGS[:8], "Static friction", "PRD [in]", "Residual [in]")
    row = ("T", "Measured", "lab", "all.csv | AX", "all.csv | 2", "all.csv|AZ", "2", "0.2", "0.25",
           "10", "")  # fmt: skip
    tables.write_tests(tmp_path, [row], headings)
    (test,) = table_tests(tmp_path)
    assert test.data is Data.MEASURED
    assert test.prd_m == pytest.approx(0.254)
    assert math.isnan(test.residual_m)
    assert test.scene.friction.mu_static == 0.25
    assert test.scene.slope_rad == pytest.approx(math.radians(2.0))
    np.testing.assert_allclose(test.scene.ay_mps2, 0.3 * a)
    np.testing.assert_allclose(test.scene.az_mps2, 0.1 * a)
    (run,) = compare([test]).runs
    assert run.model is Model.SPEED_FRICTION
    assert run.prd_m > 0.0


@pytest.mark.parametrize(
    ("at", "text", "said"),
    [
        (1, "guessed", "row 2, column Data: found 'guessed'; give measured or computed"),
        (2, "", "column Source: is empty; give laboratory"),
        (3, "", "column x: is empty; give the file of the table acceleration along the slope"),
        (3, "none.csv", "row 2, column x: none.csv"),
        (3, "../x.csv", "column x: '../x.csv' lies outside of the folder"),
        (3, "x.csv | AX", "found no channel 'AX'"),
        (4, "short.csv", "column y: has 50 samples, x 133; trim them"),
        (5, "slow.csv", "column z: its time step is 0.02 s, that of x 0.01 s"),
        (6, "45", "column Slope [deg]: found '45'; give a number from -30 to 30"),
        (7, "", "column Friction: found nothing; give a number from 0 to 2"),
        (8, "1" * 400, "column PRD [mm]: found '111"),
    ],
)
def test_what_is_wrong_in_a_row_is_told_with_its_place(folder, at, text, said):
    tables.write_record(folder / "short.csv", np.zeros(50) + 0.1)
    slow = "time [s],a [m/s2]\n" + "".join(f"{0.02 * i:.2f},0.1\n" for i in range(133))
    (folder / "slow.csv").write_text(slow)
    tables.write_tests(folder, [changed(GOOD, {at: text})])
    (problem,) = faults(folder)
    assert said in problem
    assert len(problem) < 400


def test_every_row_with_a_problem_is_told_and_names_are_unlike(folder):
    tables.write_tests(folder, [GOOD, changed(GOOD, {7: "rough"}), changed(GOOD, {0: "p1"})])
    in_row_3, twice = faults(folder)
    assert "row 3, column Friction" in in_row_3
    assert "two tests have the name 'p1'" in twice
    tables.write_tests(folder, [(*GOOD, "0.05")], (*tables.HEADINGS, "Static friction"))
    assert "Static friction: found 0.05, below the kinetic 0.1" in faults(folder)[0]


HEAD = ",".join(tables.HEADINGS) + "\n"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "has no heading Test"),
        ("Test,Data,Speed\n", "found the heading 'Speed'; accepted are Test, Data"),
        ("Test,Test,Data,Source,x,Slope [deg],Friction,PRD [mm]\n", "heading Test is there twice"),
        ("Test,Data,Source,x,Slope [deg],Friction,PRD [ft]\n", "has no heading PRD [mm]"),
        ("\xff\xfe\x00T", "not CSV UTF-8, separated by commas; save it so"),
        (HEAD, "has no tests"),
        (HEAD + "a,b\n", "row 2: has 2 cells; the headings are 10"),
        ("Test,\x00\n", "tests.csv"),
        (HEAD + "a\n" * (MOST_TESTS + 1), "more than 1000 tests"),
        ("x" * 1_000_001, "larger than 1 MB"),
    ],
)
def test_a_file_that_is_no_table_of_tests_is_refused(folder, text, said):
    assert "give a folder with tests.csv" in faults(folder)[0]
    (folder / "tests.csv").write_bytes(text.encode("latin-1"))
    assert any(said in problem for problem in faults(folder))


def test_many_headings_are_refused_in_a_time_that_grows_as_their_number(tmp_path):
    def written(count):
        folder = tmp_path / str(count)
        folder.mkdir(exist_ok=True)
        (folder / "tests.csv").write_text("x," * count)
        return folder

    assert "the heading x is there twice" in faults(written(10))[0]
    assert not grows_faster(faults, written, 4_000)
