"""The commands on records, as a user or a script calls them."""

import json
import re

import numpy as np
import pytest
from click.testing import CliRunner

from places import ROOT
from report.cli.main import main
from solver.formats import UNIT_CHOICES, read_record
from solver.records.measures import measures

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


@pytest.fixture
def three(tmp_path):
    """A file of three channels with times."""
    path = tmp_path / "three.csv"
    rows = ["time [s],HN1 [g],HN2 [g],HNZ [g]", "0,0,0,0", "0.02,0.1,-0.2,0.3", "0.04,0,0,0"]
    path.write_text("\n".join(rows))
    return path


@pytest.mark.parametrize("command", [("slide",), ("motion", "info"), ("motion", "suite")])
def test_the_units_on_the_command_line_are_those_of_the_reader(command):
    assert f"[{'|'.join(UNIT_CHOICES)}]" in CliRunner().invoke(main, [*command, "--help"]).output


def test_info_lists_all_channels_or_the_one_that_is_named(three):
    summary = json.loads(run("info", three, "--json").output)
    assert list(summary) == ["file", "format", "notes", "channels"]
    assert [channel["name"] for channel in summary["channels"]] == ["HN1", "HN2", "HNZ"]
    assert [channel["pga_g"] for channel in summary["channels"]] == pytest.approx([0.1, 0.2, 0.3])
    for name in ("hnz", "3"):
        (only,) = json.loads(run("info", three, "--channel", name, "--json").output)["channels"]
        assert only["name"] == "HNZ"
    lines = run("info", three).output.splitlines()
    assert lines[0] == f"{three}: {summary['format']}"
    assert [line.split()[:2] for line in lines[2:5]] == [["1", "HN1"], ["2", "HN2"], ["3", "HNZ"]]


def test_info_draws_all_channels(three, tmp_path):
    done = run("info", three, "--plot", tmp_path / "a.svg")
    assert done.output.splitlines()[-1] == str(tmp_path / "a.svg")
    assert (tmp_path / "a.svg").stat().st_size > 10_000


def test_a_picture_of_too_many_channels_is_refused(tmp_path):
    path = tmp_path / "many.csv"
    names = ",".join(f"C{k} [g]" for k in range(13))
    path.write_text(f"time [s],{names}\n" + "".join(f"{t},{'0.1,' * 12}0\n" for t in (0, 0.01)))
    done = run("info", path, "--plot", tmp_path / "a.svg")
    assert done.exit_code == 2
    assert "a.svg: a plot shows at most 12 channels; select one with --channel" in done.output
    assert not (tmp_path / "a.svg").exists()


@pytest.mark.parametrize("command", ["info", "convert"])
def test_a_missing_channel_is_reported_with_the_names(command, three, tmp_path):
    out = [tmp_path / "out.csv"] if command == "convert" else []
    done = run(command, three, *out, "--channel", "HNE")
    assert done.exit_code == 2
    assert "1 HN1; 2 HN2; 3 HNZ" in done.output


def test_convert_asks_which_of_several_channels(three, tmp_path):
    done = run("convert", three, tmp_path / "out.csv")
    assert done.exit_code == 2
    assert "1 HN1; 2 HN2; 3 HNZ" in done.output
    assert not (tmp_path / "out.csv").exists()
    assert run("convert", three, tmp_path / "out.csv", "--channel", "HN2").exit_code == 0
    assert np.abs(read_record(tmp_path / "out.csv").a_mps2).max() == pytest.approx(0.2 * G)


def test_notes_of_the_reading_are_shown(tmp_path):
    path = tmp_path / "uneven.csv"
    path.write_text("time [s],HN1 [g]\n0,0\n0.01,0.1\n0.03,0.3\n0.04,0\n")
    (note,) = json.loads(run("info", path, "--json").output)["notes"]
    assert f"note: {note}" in run("info", path).output.splitlines()
    assert f"note: {note}" in run("convert", path, tmp_path / "out.csv").output.splitlines()


def test_info_gives_sampling_length_and_peak():
    done = run("info", RECORD, "--json")
    assert done.exit_code == 0
    summary = json.loads(done.output)
    record = read_record(RECORD)
    assert summary["file"] == str(RECORD)
    (channel,) = summary["channels"]
    assert channel["dt_s"] == 0.005
    assert channel["npts"] == 6001
    assert channel["duration_s"] == pytest.approx(30.0, rel=1e-12)
    assert channel["pga_g"] == pytest.approx(np.abs(record.a_mps2).max() / G, rel=1e-12)


def test_info_gives_every_measure_in_si():
    (channel,) = json.loads(run("info", RECORD, "--json").output)["channels"]
    expected = measures(read_record(RECORD))
    assert {key: channel[key] for key in list(channel)[5:]} == {
        "pgv_mps": expected.pgv_mps,
        "pgd_m": expected.pgd_m,
        "arias_mps": expected.arias_mps,
        "d5_95_s": expected.d5_95_s,
        "final_velocity_mps": expected.final_velocity_mps,
        "final_displacement_m": expected.final_displacement_m,
    }


def test_info_prints_a_table_for_people(column):
    done = run("info", column, "--dt", 0.02, "--units", "g")
    assert done.exit_code == 0
    lines = done.output.splitlines()
    heading = re.split(r"  +", lines[1].strip())
    row = dict(zip(heading, re.split(r"  +", lines[2].strip())[1:], strict=True))
    assert row["dt [s]"] == "0.02"
    assert row["samples"] == "4"
    assert row["PGA [g]"] == "0.25"
    # Trapezia of 0.125 and -0.25 g; the velocity ends at -0.0025 g s.
    assert row["final v [cm/s]"] == f"{-0.0025 * G * 100:.4g}"


def test_a_drift_of_rounding_prints_as_zero():
    lines = run("info", RECORD).output.splitlines()
    assert lines[2].split()[-2:] == ["0", "0"]


@pytest.mark.parametrize(("name", "start"), [("a.svg", b"<svg"), ("a.PNG", b"\x89PNG")])
def test_info_draws_a_picture_the_same_each_time(tmp_path, name, start):
    out = tmp_path / name
    assert run("info", RECORD, "--plot", out).exit_code == 0
    first = out.read_bytes()
    assert first.startswith(start)
    assert run("info", RECORD, "--plot", out).exit_code == 0
    assert out.read_bytes() == first


def test_info_never_draws_over_a_record(column):
    done = run("info", column, "--dt", 0.02, "--units", "g", "--plot", column)
    assert done.exit_code == 2
    assert "use the extension .svg or .png" in done.output
    assert column.read_text() == "0\n0.125\n-0.25\n0\n"


def test_info_says_where_a_picture_cannot_be_written(column, tmp_path):
    out = tmp_path / "none" / "a.svg"
    done = run("info", column, "--dt", 0.02, "--units", "g", "--plot", out)
    assert done.exit_code == 2
    assert "cannot be written (No such file or directory)" in done.output


def test_info_takes_the_step_and_the_units_of_a_bare_column(column):
    done = run("info", column, "--dt", 0.02, "--units", "m/s2", "--json")
    (channel,) = json.loads(done.output)["channels"]
    assert channel["dt_s"] == 0.02
    assert channel["pga_g"] == pytest.approx(0.25 / G, rel=1e-12)


def test_convert_writes_time_and_g(column, tmp_path):
    out = tmp_path / "out.csv"
    done = run("convert", column, out, "--dt", 0.02, "--units", "g")
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
    back = read_record(out).a_mps2
    assert np.abs(back - values * 0.01).max() <= 1.001e-9 * np.abs(values * 0.01).max()


def test_convert_never_overwrites_a_file(column, tmp_path):
    out = tmp_path / "out.csv"
    out.write_text("mine")
    done = run("convert", column, out, "--dt", 0.02, "--units", "g")
    assert done.exit_code == 2
    assert "already exists; give another name" in done.output
    assert out.read_text() == "mine"


def test_convert_does_not_write_through_a_dangling_link(column, tmp_path):
    link = tmp_path / "link.csv"
    link.symlink_to(tmp_path / "elsewhere.csv")
    done = run("convert", column, link, "--units", "g", "--dt", 0.01)
    assert done.exit_code == 2
    assert "already exists" in done.output
    assert not (tmp_path / "elsewhere.csv").exists()


@pytest.mark.parametrize("command", ["convert", "info"])
def test_a_full_disk_leaves_no_half_file(command, column, tmp_path, files_up_to):
    out = ["--plot", tmp_path / "a.svg"] if command == "info" else [tmp_path / "a.csv"]
    with files_up_to(10):
        done = run(command, column, *out, "--units", "g", "--dt", 0.01)
    assert done.exit_code == 2
    assert "File too large" in done.output
    assert sorted(path.name for path in tmp_path.iterdir()) == ["one.txt"]


def test_convert_into_a_folder_that_is_not_there_exits_2(column, tmp_path):
    done = run("convert", column, tmp_path / "none" / "out.csv", "--dt", 0.02, "--units", "g")
    assert done.exit_code == 2
    assert "cannot be written (No such file or directory)" in done.output


@pytest.mark.parametrize("command", ["info", "convert"])
def test_an_unreadable_file_is_reported_and_exits_2(command, column, tmp_path):
    out = [tmp_path / "out.csv"] if command == "convert" else []
    missing = run(command, tmp_path / "none.at2", *out)
    assert missing.exit_code == 2
    assert "no such file" in missing.output
    stepless = run(command, column, *out, "--units", "g")
    assert stepless.exit_code == 2
    assert "give the time step dt" in stepless.output
