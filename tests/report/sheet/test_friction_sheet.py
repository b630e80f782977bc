"""The sheet Friction tests: reading, and error messages."""

import datetime as dt

import pytest
from openpyxl import load_workbook

from cells import cell
from inputs import INCH
from report.sheet.schema.choices import UnitsFirst
from report.sheet.schema.project import FrictionTests
from report.sheet.writing.grids import BLOCK_WIDTHS
from sheets import arrays, make, problems, read_workbook, said, type_into

SHEET = "Friction tests"
REPORT = {
    "laboratory": "Example Laboratories", "accreditation": "ISO/IEC 17025, no. 1234.01",
    "standard": "ASTM G115-10", "report": "FT-118", "date": dt.date(2025, 6, 12),
    "membrane": "TPO, 60 mil", "support": "EPDM pad",
}  # fmt: skip


def run(surface, number, mu, **changes):
    return {"surface": surface, "number": number, "mu": mu} | changes


def runs(dry=(0.60, 0.61, 0.62), wet=(0.46, 0.45, 0.47)):
    return [
        *(run("dry", k, mu, velocity_mps=1.0 * INCH) for k, mu in enumerate(dry, start=1)),
        *(run("wet", k, mu, mu_static=mu + 0.04) for k, mu in enumerate(wet, start=1)),
    ]


@pytest.fixture
def path(tmp_path):
    return make(tmp_path, friction_tests=REPORT, friction_runs=runs())


@pytest.mark.parametrize("units", UnitsFirst)
def test_report_and_runs_are_read_in_the_units_of_the_sheet(tmp_path, units):
    path = make(tmp_path, units, friction_tests=REPORT, friction_runs=runs())
    opened = load_workbook(path)
    for heading in ("Surface", "Run", "Kinetic coefficient", "Static coefficient", "Report"):
        assert cell(opened, f"{SHEET}/heading/{heading}").value == heading
    velocity = cell(opened, f"{SHEET}/1/Velocity").value
    assert velocity == pytest.approx(1.0 if units is UnitsFirst.US else 25.4)
    workbook = read_workbook(path).input
    assert workbook.friction_tests == FrictionTests(**REPORT)
    first, *_, last = [row.run("FT-118") for row in workbook.friction_runs]
    assert (first.report, first.surface, first.mu) == ("FT-118", "dry", 0.60)
    assert first.velocity_mps == pytest.approx(INCH)
    assert first.mu_static != first.mu_static
    assert last.velocity_mps != last.velocity_mps
    assert last.mu_static == pytest.approx(0.51)


@pytest.mark.quick
def test_a_table_below_a_block_leaves_its_columns_as_they_are(path):
    opened = load_workbook(path)
    letter = cell(opened, f"{SHEET}/Laboratory/Note").column_letter
    note = opened[SHEET].column_dimensions[letter]
    assert note.width == BLOCK_WIDTHS[6]
    assert not note.hidden


MU = "Arrays/{}/Friction coefficient"


def test_coefficients_above_the_tested_means_are_reported(tmp_path):
    path = make(tmp_path, arrays=arrays(mu=0.50), friction_tests=REPORT, friction_runs=runs())
    assert problems(path) == said(
        f"{MU.format('A1')} is 0.5; the tests give 0.46 (wet, mean of 3 from"
        f" <{SHEET}/4/Kinetic coefficient>); give 0.46 or less"
    )
    assert read_workbook(type_into(path, {MU.format("A1"): 0.46})).input
    # They are not compared while a run cannot be read.
    (line,) = problems(type_into(path, {f"{SHEET}/1/Kinetic coefficient": "x"}))
    assert line.startswith(*said(f"{SHEET}/1/Kinetic coefficient is 'x'"))
    path = make(tmp_path, arrays=arrays(mu_static=0.52), friction_runs=runs())
    assert problems(path) == said(
        "Arrays/A1/Static friction is 0.52; the tests give 0.5 (wet); give 0.5 or less"
    )


def test_one_run_is_compared_and_rounding_is_allowed(tmp_path):
    path = make(tmp_path, arrays=arrays(mu=0.4651), friction_runs=runs())
    assert len(problems(path)) == 1
    assert read_workbook(type_into(path, {MU.format("A1"): 0.4649})).input
    path = make(tmp_path, friction_runs=runs(dry=(), wet=(0.44,)))
    assert tuple(line.split(";")[0] for line in problems(path)) == said(
        *(f"{MU.format(array)} is 0.45" for array in ("A1", "A2"))
    )


def test_a_run_number_counts_at_each_velocity_anew(tmp_path):
    """As the table of a laboratory has them: runs 1 to 3 at 1 in/s, and 1 to 3 at 10 in/s."""
    table = [run("dry", k, 0.6, velocity_mps=v * INCH) for v in (1.0, 10.0) for k in (1, 2, 3)]
    path = make(tmp_path, friction_tests=REPORT, friction_runs=table)
    assert len(read_workbook(path).input.friction_runs) == 6
    assert problems(type_into(path, {f"{SHEET}/4/Velocity": 1.0})) == said(
        f"{SHEET}/4/Run is 1, dry, already given at <{SHEET}/1/Run>; give another number"
    )


@pytest.mark.nightly
def test_an_array_that_names_a_report_is_compared_with_that_report(tmp_path):
    other = [run("wet", k, 0.30, report="FT-9") for k in (1, 2, 3)]
    tests = {"friction_tests": REPORT, "friction_runs": [*runs(), *other]}
    lines = problems(make(tmp_path / "none", **tests))
    assert ["the tests give 0.3 (wet" in line for line in lines] == [True, True]
    named = [array | {"mu_report": "Report FT-118"} for array in arrays()]
    assert read_workbook(make(tmp_path / "named", arrays=named, **tests)).input


@pytest.mark.nightly
def test_a_law_is_compared_at_the_tested_velocities(tmp_path):
    first, second = arrays(mu=0.40, mu_fast=0.60, mu_rate_s_per_m=30.0)
    both = [first, second | {"mu": 0.3}]

    def tested(velocity_mps):
        runs = [run("dry", k, 0.41, velocity_mps=velocity_mps) for k in (1, 2, 3)]
        return make(tmp_path / str(velocity_mps), arrays=both, friction_runs=runs)

    assert read_workbook(tested(1e-4)).input
    for velocity_mps in (1.0, None):
        assert problems(tested(velocity_mps)) == said(
            f"<{MU.format('A1')}>: friction coefficient averages 0.6 at the tested velocities; the"
            f" tests give 0.41 (dry, mean of 3 from <{SHEET}/1/Kinetic coefficient>); reduce it"
        )
