"""The command `slide`: the solver's numbers, with the simplest adequate model, or a clear error."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from places import DATA, ROOT
from report.cli.main import main
from solver.formats import read_record
from solver.sliding.checked import slide

EXAMPLE = ROOT / "projects" / "example"
RECORD, ACROSS, UP = (str(EXAMPLE / "records" / f"RM1-{c}.csv") for c in "xyz")
THREE = str(DATA / "motions" / "geonet.v2a")
PLACE = ("--slope-deg", 2, "--mu", 0.5)


def run(*words):
    return CliRunner().invoke(main, [str(word) for word in words])


def printed(*words):
    done = run("slide", *words, "--json")
    assert done.exit_code == 0, done.output
    return json.loads(done.output)


def test_slide_gives_what_the_solver_gives():
    done = run("slide", RECORD, "--slope-deg", 2, "--mu", 0.5, "--json")
    assert done.exit_code == 0
    record = read_record(Path(RECORD), units="g")
    expected = slide(record.a_mps2, record.dt_s, slope_rad=math.radians(2), mu=0.5)
    values = json.loads(done.output)
    assert values["prd_m"] == expected.prd_m
    assert values["residual_m"] == expected.residual_m
    assert values["t_uplift_s"] is None
    assert values["dt_s"] == 0.005


def test_slide_scales_to_a_ppa_and_by_a_factor():
    peak = np.abs(read_record(Path(RECORD), units="g").a_mps2).max() / 9.80665
    scaled = run("slide", RECORD, "--slope-deg", 2, "--mu", 0.5, "--ppa-g", 2 * peak, "--json")
    two = run("slide", RECORD, "--slope-deg", 2, "--mu", 0.5, "--factor", 2, "--json")
    assert json.loads(scaled.output)["prd_m"] == pytest.approx(json.loads(two.output)["prd_m"])


def test_slide_takes_a_vertical_record():
    plain = run("slide", RECORD, "--slope-deg", 2, "--mu", 0.5)
    lifted = run("slide", RECORD, "--slope-deg", 2, "--mu", 0.5, "--vertical", UP)
    assert (plain.exit_code, lifted.exit_code) == (0, 0)
    assert "prd_m" in plain.output
    assert plain.output != lifted.output


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--slope-deg", "95", "--mu", "0.5"], "give an angle between"),
        (["--slope-deg", "2", "--mu", "-1"], "give a friction coefficient of 0 or more"),
        (["--slope-deg", "2", "--mu", "0.5", "--dt", "0.01"], "0.01"),
        (["--slope-deg", "2", "--mu", "0.5", "--ppa-g", "1", "--factor", "1"], "not both"),
        (["--slope-deg", "2"], "--mu"),
    ],
)
def test_slide_says_what_is_wrong_and_exits_2(arguments, message):
    done = run("slide", RECORD, *arguments)
    assert done.exit_code == 2
    assert message in done.output


def test_slide_takes_a_second_horizontal_record_and_names_the_model():
    two = printed(RECORD, *PLACE, "--transverse", ACROSS, "--vertical", UP)
    x, y, z = (read_record(Path(name), units="g").a_mps2 for name in (RECORD, ACROSS, UP))
    expected = slide(x, 0.005, slope_rad=math.radians(2), mu=0.5, ay_mps2=y, az_mps2=z)
    assert two["prd_m"] == expected.prd_m
    assert two["across_m"] == expected.across_m > 0.1
    assert two["model"] == "3, two axes with vertical"
    assert two["error_m"] <= 1e-6 * two["prd_m"]
    assert two["next_effect_m"] is None


@pytest.mark.parametrize(
    ("words", "model"),
    [
        ((), "1, one axis"),
        (("--vertical", UP), "2, one axis with vertical"),
        (("--transverse", ACROSS), "3, two axes with vertical"),
        (("--transverse", ACROSS, "--model", "one-axis"), "1, one axis"),
        (("--factor", 0.01), "0, no slip"),
    ],
)
def test_the_model_is_the_simplest_adequate_one_or_the_requested_one(words, model):
    assert printed(RECORD, *PLACE, *words)["model"] == model


def test_a_file_of_several_channels_gives_each_component():
    by_name = printed(
        f"{THREE} | 1", *PLACE, "--transverse", f"{THREE}|2", "--vertical", f"{THREE}|3"
    )
    assert by_name["dt_s"] > 0.0
    done = run("slide", THREE, *PLACE)
    assert done.exit_code == 2
    assert "found several channels" in done.output


def test_the_errors_of_all_records_are_reported_together(tmp_path):
    short = tmp_path / "short.csv"
    short.write_text("time_s,acceleration_g\n0,0\n0.005,0.1\n0.01,0\n")
    done = run("slide", RECORD, *PLACE, "--transverse", short, "--vertical", tmp_path / "none.csv")
    assert done.exit_code == 2
    assert "short.csv: has 3 samples at 0.005 s, but RM1-x.csv has 6001" in done.output
    assert "none.csv: no such file" in done.output


def test_no_slip_requested_for_a_block_that_slips_is_rejected():
    done = run("slide", RECORD, *PLACE, "--model", "no-slip")
    assert done.exit_code == 2
    assert "friction demand" in done.output
