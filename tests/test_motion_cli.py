"""The commands on records, as a person or a script calls them."""

import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from report.cli import main
from solver.motion import read_record

ROOT = Path(__file__).resolve().parents[1]
RECORD = ROOT / "projects" / "example" / "records" / "RM1-x.csv"
G = 9.80665


def run(*arguments):
    return CliRunner().invoke(main, ["motion", *(str(item) for item in arguments)])


@pytest.fixture
def column(tmp_path):
    """A file of one column [g], without times."""
    path = tmp_path / "one.txt"
    path.write_text("0\n0.125\n-0.25\n0\n")
    return path


def test_info_gives_sampling_length_and_peak():
    done = run("info", RECORD, "--json")
    assert done.exit_code == 0
    found = json.loads(done.output)
    record = read_record(RECORD, units="g")
    assert found["file"] == str(RECORD)
    (channel,) = found["channels"]
    assert channel["dt_s"] == 0.005
    assert channel["npts"] == 6001
    assert channel["duration_s"] == pytest.approx(30.0, rel=1e-12)
    assert channel["pga_g"] == pytest.approx(np.abs(record.a_mps2).max() / G, rel=1e-12)


def test_info_takes_the_step_and_the_units_of_a_bare_column(column):
    done = run("info", column, "--dt", 0.02, "--units", "m/s2", "--json")
    (channel,) = json.loads(done.output)["channels"]
    assert channel["dt_s"] == 0.02
    assert channel["pga_g"] == pytest.approx(0.25 / G, rel=1e-12)


def test_convert_writes_time_and_g(column, tmp_path):
    out = tmp_path / "out.csv"
    done = run("convert", column, out, "--dt", 0.02)
    assert done.exit_code == 0
    assert str(out) in done.output
    assert out.read_text().splitlines() == [
        "time_s,acceleration_g",
        "0.00,0.00000",
        "0.02,0.12500",
        "0.04,-0.25000",
        "0.06,0.00000",
    ]


@pytest.mark.parametrize("scale", [1e-7, 1e-3, 1.0])
def test_convert_loses_nothing_of_a_small_record(tmp_path, scale):
    values = np.random.default_rng(5).uniform(-1.0, 1.0, 100) * scale
    source, out = tmp_path / "in.txt", tmp_path / "out.csv"
    source.write_text("\n".join(f"{value:.17g}" for value in values))
    assert run("convert", source, out, "--dt", 0.01, "--units", "cm/s2").exit_code == 0
    back = read_record(out, units="g").a_mps2
    assert np.abs(back - values * 0.01).max() <= 1.001e-9 * np.abs(values * 0.01).max()


def test_convert_never_writes_over_a_file(column, tmp_path):
    out = tmp_path / "out.csv"
    out.write_text("mine")
    done = run("convert", column, out, "--dt", 0.02)
    assert done.exit_code == 2
    assert "is there already; give another name" in done.output
    assert out.read_text() == "mine"


def test_convert_into_a_folder_that_is_not_there_exits_2(column, tmp_path):
    done = run("convert", column, tmp_path / "none" / "out.csv", "--dt", 0.02)
    assert done.exit_code == 2
    assert "cannot be written (No such file or directory)" in done.output


@pytest.mark.parametrize("command", ["info", "convert"])
def test_what_cannot_be_read_is_said_and_exits_2(command, column, tmp_path):
    out = [tmp_path / "out.csv"] if command == "convert" else []
    missing = run(command, tmp_path / "none.at2", *out)
    assert missing.exit_code == 2
    assert "no such file" in missing.output
    stepless = run(command, column, *out)
    assert stepless.exit_code == 2
    assert "give the time step dt" in stepless.output
