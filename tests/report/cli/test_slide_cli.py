"""The command `slide`: the solver's numbers, with the simplest adequate model, or a clear error."""

import math
from functools import partial

import numpy as np
import pytest

import commands
from places import DATA, ROOT
from solver.formats import read_record
from solver.model import InputError
from solver.sliding.checked import slide

pytestmark = pytest.mark.quick

RECORD, ACROSS, UP = (ROOT / "projects" / "example" / "records" / f"RM1-{c}.csv" for c in "xyz")
THREE = DATA / "motions" / "geonet.v2a"
PLACE = ("--slope-deg", 2, "--mu", 0.5)


found, refused = (partial(command, "slide") for command in (commands.as_json, commands.refused))


def test_slide_gives_what_the_solver_gives_at_its_scale():
    record = read_record(RECORD, units="g")
    expected = slide(record.a_mps2, record.dt_s, slope_rad=math.radians(2), mu=0.5)
    values = found(RECORD, *PLACE)
    assert values["prd_m"] == expected.prd_m
    assert values["residual_m"] == expected.residual_m
    assert values["t_uplift_s"] is None
    assert values["dt_s"] == 0.005
    assert f"prd_m  {expected.prd_m:.6g}" in commands.printed("slide", RECORD, *PLACE)
    peak = np.abs(read_record(RECORD, units="g").a_mps2).max() / 9.80665
    scaled, doubled = (
        found(RECORD, *PLACE, *words) for words in (("--ppa-g", 2 * peak), ("--factor", 2))
    )
    assert scaled["prd_m"] == pytest.approx(doubled["prd_m"])


def test_slide_takes_components_from_files_or_channels():
    two = found(RECORD, *PLACE, "--transverse", ACROSS, "--vertical", UP)
    x, y, z = (read_record(name, units="g").a_mps2 for name in (RECORD, ACROSS, UP))
    expected = slide(x, 0.005, slope_rad=math.radians(2), mu=0.5, ay_mps2=y, az_mps2=z)
    assert two["prd_m"] == expected.prd_m
    assert two["across_m"] == expected.across_m > 0.1
    assert two["model"] == "3, two axes with vertical"
    assert two["error_m"] <= 1e-6 * two["prd_m"]
    assert two["next_effect_m"] is None
    channels = (f"{THREE} | 1", *PLACE, "--transverse", f"{THREE}|2", "--vertical", f"{THREE}|3")
    assert found(*channels)["dt_s"] > 0.0
    assert "found several channels" in refused(THREE, *PLACE)


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
    assert found(RECORD, *PLACE, *words)["model"] == model


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--slope-deg", "2", "--mu", "50"], "'--mu': it is 50; give 0 to 1.5."),
        (["--slope-deg", "45", "--mu", "0.4"], "it is 45 deg; give"),
        (["--slope-deg", "2"], "--mu"),
        ([*PLACE, "--dt", "0.01"], "0.01"),
        ([*PLACE, "--ppa-g", "1", "--factor", "1"], "not both"),
        ([*PLACE, "--model", "no-slip"], "required friction coefficient"),
    ],
)
def test_slide_says_what_is_wrong(arguments, message):
    assert message in refused(RECORD, *arguments)


@pytest.mark.parametrize("factor", [1.0, -1.0])
def test_a_vertical_with_gravity_in_it_is_refused(tmp_path, factor):
    still = [f"{0.01 * k:.2f},{factor + 0.1 * math.sin(k):.6f}" for k in range(6001)]
    path = tmp_path / "z.csv"
    path.write_text("time_s,acceleration_g\n" + "\n".join(still) + "\n")
    told = refused(path, *PLACE)
    assert "z.csv: has a mean of about 1 g: gravity is in it; subtract the mean" in told
    x = np.sin(np.arange(200))
    with pytest.raises(InputError, match=r"az_mps2 has a mean of .* gravity is in it"):
        slide(x, 0.01, slope_rad=0.0, mu=0.1, az_mps2=factor * 9.81 + 0.1 * x)


def test_the_errors_of_all_records_are_reported_together(tmp_path):
    short = tmp_path / "short.csv"
    short.write_text("time_s,acceleration_g\n0,0\n0.005,0.1\n0.01,0\n")
    told = refused(RECORD, *PLACE, "--transverse", short, "--vertical", tmp_path / "none.csv")
    assert "short.csv: has 3 samples at 0.005 s, but RM1-x.csv has 6001" in told
    assert "none.csv: no such file" in told
