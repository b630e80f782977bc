"""`roofslip motion` and `slide`, as a user or a script calls them."""

import io
import math
import re
import zipfile
from functools import partial

import numpy as np
import pytest

from fixtures import commands
from fixtures.paths import DATA, ROOT
from solver.formats import read_record
from solver.records.measures import measures
from solver.sliding.checked import slide

pytestmark = pytest.mark.quick


RECORD = ROOT / "projects" / "example" / "records" / "RM1-x.csv"
G = 9.80665
COLUMN = "0\n0.125\n-0.25\n0\n"
READING = ("--dt", 0.02, "--units", "g")


printed, as_json, refused = (
    partial(command, "motion")
    for command in (commands.stdout_of, commands.as_json, commands.errors_of)
)


@pytest.fixture
def column(tmp_path):
    """A file of one column [g], without times."""
    path = tmp_path / "one.txt"
    path.write_text(COLUMN)
    return path


@pytest.fixture
def three(tmp_path):
    """A file of three channels with times."""
    path = tmp_path / "three.csv"
    rows = ["time [s],HN1 [g],HN2 [g],HNZ [g]", "0,0,0,0", "0.02,0.1,-0.2,0.3", "0.04,0,0,0"]
    path.write_text("\n".join(rows))
    return path


def test_info_gives_every_measure_in_si_of_all_channels_or_the_one_that_is_named(three):
    summary = as_json("info", RECORD)
    (channel,) = summary["channels"]
    record = read_record(RECORD)
    expected = measures(record)
    assert summary["file"] == str(RECORD)
    assert channel == {
        "name": record.name,
        "dt_s": 0.005,
        "npts": 6001,
        "duration_s": pytest.approx(30.0, rel=1e-12),
        "pga_g": pytest.approx(np.abs(record.a_mps2).max() / G, rel=1e-12),
        "pgv_mps": expected.pgv_mps,
        "pgd_m": expected.pgd_m,
        "arias_mps": expected.arias_mps,
        "d5_95_s": expected.d5_95_s,
        "final_velocity_mps": expected.final_velocity_mps,
        "final_displacement_m": expected.final_displacement_m,
    }
    summary = as_json("info", three)
    assert list(summary) == ["file", "format", "notes", "channels"]
    assert [channel["name"] for channel in summary["channels"]] == ["HN1", "HN2", "HNZ"]
    assert [channel["pga_g"] for channel in summary["channels"]] == pytest.approx([0.1, 0.2, 0.3])
    for name in ("hnz", "3"):
        (only,) = as_json("info", three, "--channel", name)["channels"]
        assert only["name"] == "HNZ"
    lines = printed("info", three).splitlines()
    assert lines[0] == f"{three}: {summary['format']}"
    assert [line.split()[:2] for line in lines[2:5]] == [["1", "HN1"], ["2", "HN2"], ["3", "HNZ"]]


def test_values_across_the_lines_and_a_zip_in_a_zip_are_read(tmp_path):
    path, out = tmp_path / "across.txt", tmp_path / "out.csv"
    path.write_text("0 0.125 -0.25\n0.1 0.2 0.3\n0.5\n")
    assert "(--values-per-line 3)" in refused("info", path, *READING)
    printed("convert", path, out, *READING, "--values-per-line", 3, "--factor", -1)
    record = read_record(out)
    assert record.dt_s == 0.02
    assert record.a_mps2 / G == pytest.approx([0.0, -0.125, 0.25, -0.1, -0.2, -0.3, -0.5])
    inner, outer = io.BytesIO(), tmp_path / "site.zip"
    with zipfile.ZipFile(inner, "w") as archive:
        for axis in "xy":
            archive.write(RECORD, f"M-{axis}.csv")
    with zipfile.ZipFile(outer, "w") as archive:
        archive.writestr("part.zip", inner.getvalue())
    assert "--without-vertical uses the two" in refused("rows", outer)
    told = printed("rows", outer, "--without-vertical")
    assert "part/M-x.csv  horizontal x" in told
    assert (
        "note: M: no vertical record. The analysis procedure requires motions with two horizontal"
    ) in told


def test_info_prints_a_table_for_people_and_never_over_a_record(column):
    lines = printed("info", column, *READING).splitlines()
    heading = re.split(r"  +", lines[1].strip())
    row = dict(zip(heading, re.split(r"  +", lines[2].strip())[1:], strict=True))
    assert (row["dt [s]"], row["samples"], row["PGA [g]"]) == ("0.02", "4", "0.25")
    # Trapezia of 0.125 and -0.25 g; the velocity ends at -0.0025 g s.
    assert row["final v [cm/s]"] == f"{-0.0025 * G * 100:.4g}"
    assert printed("info", RECORD).splitlines()[2].split()[-2:] == ["0", "0"]


def test_convert_writes_time_and_g(column, tmp_path):
    out = tmp_path / "out.csv"
    assert str(out) in printed("convert", column, out, *READING)
    assert out.read_text().split() == [
        "time_s,acceleration_g", "0.00,0.00000", "0.02,0.12500", "0.04,-0.25000", "0.06,0.00000",
    ]  # fmt: skip


@pytest.mark.parametrize("scale", [1e-7, 1.0])
def test_convert_loses_nothing_of_a_small_record(tmp_path, scale):
    values = np.random.default_rng(5).uniform(-1.0, 1.0, 100) * scale
    source, out = tmp_path / "in.txt", tmp_path / "out.csv"
    source.write_text("\n".join(f"{value:.17g}" for value in values))
    printed("convert", source, out, "--dt", 0.01, "--units", "cm/s2")
    back = read_record(out).a_mps2
    assert np.abs(back - values * 0.01).max() <= 1.001e-9 * np.abs(values * 0.01).max()


def test_convert_never_overwrites_and_notes_are_told(three, tmp_path, column):
    out = tmp_path / "out.csv"
    assert "1 HN1; 2 HN2; 3 HNZ" in refused("convert", three, out)
    assert not out.exists()
    printed("convert", three, out, "--channel", "HN2")
    assert np.abs(read_record(out).a_mps2).max() == pytest.approx(0.2 * G)
    out.write_text("mine")
    assert "already exists; use another name" in refused("convert", column, out, *READING)
    assert out.read_text() == "mine"
    out.unlink()
    path = tmp_path / "uneven.csv"
    path.write_text("time [s],HN1 [g]\n0,0\n0.01,0.1\n0.03,0.3\n0.04,0\n")
    (note,) = as_json("info", path)["notes"]
    assert f"note: {note}" in printed("info", path).splitlines()
    assert f"note: {note}" in printed("convert", path, tmp_path / "out.csv").splitlines()


def test_what_cannot_be_read_or_written_is_reported(column, three, tmp_path, files_up_to):
    def told(file, *words, to=tmp_path):
        return refused("convert", file, to / "a.csv", *words)

    assert "no such file" in told(tmp_path / "none.at2")
    assert "enter the time step dt" in told(column, "--units", "g")
    assert "1 HN1; 2 HN2; 3 HNZ" in told(three, "--channel", "HNE")
    no_folder = told(column, *READING, to=tmp_path / "none")
    assert "cannot be written (No such file or directory)" in no_folder
    with files_up_to(10):
        assert "a.csv: cannot be written (File too large)" in told(column, *READING)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["one.txt", "three.csv"]


ACROSS, UP = (RECORD.with_name(f"RM1-{axis}.csv") for axis in "yz")
THREE = DATA / "motions" / "geonet.v2a"
PLACE = ("--slope-deg", 2, "--mu", 0.5)


found, slide_refused = (
    partial(command, "slide") for command in (commands.as_json, commands.errors_of)
)


def test_slide_gives_what_the_solver_gives_for_files_or_channels():
    record = read_record(RECORD, units="g")
    expected = slide(record.a_mps2, record.dt_s, slope_rad=math.radians(2), mu=0.5)
    values = found(RECORD, *PLACE)
    assert values["prd_m"] == expected.prd_m
    assert values["residual_m"] == expected.residual_m
    assert values["t_uplift_s"] is None
    assert values["dt_s"] == 0.005
    assert f"prd_m  {expected.prd_m:.6g}" in commands.stdout_of("slide", RECORD, *PLACE)
    peak = np.abs(read_record(RECORD, units="g").a_mps2).max() / 9.80665
    scaled, doubled = (
        found(RECORD, *PLACE, *words) for words in (("--ppa-g", 2 * peak), ("--factor", 2))
    )
    assert scaled["prd_m"] == pytest.approx(doubled["prd_m"])
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
    assert "found several channels" in slide_refused(THREE, *PLACE)


@pytest.mark.parametrize(
    ("words", "model"),
    [
        ((), "1, one axis"),
        (("--vertical", UP), "2, one axis with vertical"),
        (("--transverse", ACROSS), "3, two axes with vertical"),
        (("--factor", 0.01), "0, no slip"),
    ],
)
def test_the_model_is_the_simplest_adequate_one(words, model):
    assert found(RECORD, *PLACE, *words)["model"] == model


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--slope-deg", "2", "--mu", "50"], "'--mu': it is 50; enter 0 to 1.5."),
        (["--slope-deg", "nan", "--mu", "0.4"], "'--slope-deg': it is nan deg"),
        (["--slope-deg", "95", "--mu", "0.4"], "it is 95 deg; enter more than -45 deg and less"),
        (["--slope-deg", "2"], "--mu"),
        ([*PLACE, "--dt", "0"], "'--dt': it is 0 s; enter more than 0 s."),
        ([*PLACE, "--dt", "0.01"], "0.01"),
        ([*PLACE, "--factor", "inf"], "it is inf; enter a finite number."),
        ([*PLACE, "--ppa-g", "1", "--factor", "1"], "not both"),
    ],
)
def test_slide_says_what_is_wrong(arguments, message):
    assert message in slide_refused(RECORD, *arguments)


@pytest.mark.parametrize("factor", [1.0, -1.0])
def test_a_vertical_with_gravity_in_it_is_refused(tmp_path, factor):
    still = [f"{0.01 * k:.2f},{factor + 0.1 * math.sin(k):.6f}" for k in range(6001)]
    path = tmp_path / "z.csv"
    path.write_text("time_s,acceleration_g\n" + "\n".join(still) + "\n")
    told = slide_refused(path, *PLACE)
    assert (
        "z.csv: the mean is about 1 g because the record includes gravity; subtract the mean"
        in told
    )


def test_the_errors_of_all_records_are_reported_together(tmp_path):
    short = tmp_path / "short.csv"
    short.write_text("time_s,acceleration_g\n0,0\n0.005,0.1\n0.01,0\n")
    told = slide_refused(RECORD, *PLACE, "--transverse", short, "--vertical", tmp_path / "none.csv")
    assert "short.csv: has 3 samples at 0.005 s, but RM1-x.csv has 6001" in told
    assert "none.csv: no such file" in told
