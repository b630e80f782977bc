"""All formats: the real records of the manifest, detection, and what strangers may send."""

import csv
import math
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from test_formats import HELD

from nightly import by_day
from places import RECORDS, ROOT, SAMPLES
from solver.formats import read_motion_file, read_record
from solver.model import InputError

G = 9.80665
BARE = {"units": "gal", "dt_s": 0.005}

TEXTS = ("columns.csv", "one.txt", "remark.csv", "uneven.txt")
FORMATS = dict.fromkeys(TEXTS, "text") | {name: held.format for name, held in HELD.items()}


def manifest():
    """Rows of the folder of real records, none where the folder is not present."""
    path = RECORDS / "MANIFEST.csv"
    if not path.is_file():
        return [pytest.param(None, marks=pytest.mark.skip(reason="folder of records absent"))]
    rows = list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))
    return [pytest.param(row, id=f"{row['file']}-{row['component'][:16]}") for row in rows]


def channel_of(row):
    plain = row["format"] == "plain column"
    how = {"units": "g", "dt_s": float(row["dt_s"])} if plain else {}
    motion_file = read_motion_file(RECORDS / row["file"], **how)
    return motion_file.channel(row["component"] if len(motion_file.channels) > 1 else "")


@pytest.mark.parametrize("row", manifest())
def test_real_records_have_the_step_count_and_peak_of_the_manifest(row):
    record = channel_of(row)
    a, count = record.a_mps2, int(row["npts"])
    assert record.dt_s == float(row["dt_s"])
    if "offset of first 1 s removed" in row["note"]:
        a = a - a[: round(1.0 / record.dt_s)].mean()
    decimals = len(row["pga_g"].partition(".")[2])
    assert np.abs(a).max() / G == pytest.approx(float(row["pga_g"]), abs=0.501 * 10.0**-decimals)
    # The manifest leaves out the last line of channels 1 and 2 of RENADIC's files, five pairs or
    # three; each file promises the pairs that it holds, 10000 and 24923.
    left_out = {9995: 5, 24920: 3}.get(count, 0) if row["format"].startswith("RENADIC") else 0
    assert len(a) == count + left_out


@pytest.mark.parametrize("name", sorted(FORMATS))
@pytest.mark.quick
def test_the_content_tells_the_format_whatever_the_name(file, name):
    path = file((SAMPLES / name).read_bytes(), "motion.dat")
    motion_file = read_motion_file(path, **(BARE if name == "one.txt" else {}))
    assert (motion_file.name, motion_file.format) == ("motion.dat", FORMATS[name])
    assert all(0 < len(note) < 200 for note in motion_file.notes)
    for record in motion_file.channels:
        assert not record.a_mps2.flags.writeable
        assert record.a_mps2.dtype == np.float64
        assert record.a_mps2.ndim == 1


@pytest.mark.quick
def test_every_sample_is_listed_and_a_record_is_one_of_its_channels():
    assert {path.name for path in SAMPLES.iterdir()} == {*FORMATS, "README.md"}
    record = read_record(SAMPLES / "renadic.v1", channel="chan 2: v (sta chn: 2)")
    (_, expected, _) = read_motion_file(SAMPLES / "renadic.v1").channels
    assert record.name == expected.name
    assert np.array_equal(record.a_mps2, expected.a_mps2)


def read_or_refuse(path):
    """Read a file that may be at fault: a record of finite numbers, or an error for the user."""
    for how in ({}, BARE):
        try:
            channels, problems = read_motion_file(path, **how).channels, ()
        except InputError as error:
            channels, problems = (), error.problems
        assert channels or problems
        assert all(path.name in problem or "more" in problem for problem in problems)
        for record in channels:
            assert 0.0 < record.dt_s < math.inf
            assert len(record.a_mps2) >= 2
            assert np.isfinite(record.a_mps2).all()


hostile = settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])


@hostile
@pytest.mark.parametrize("name", by_day(sorted(FORMATS), 10))
@given(data=st.data())
def test_lines_lost_doubled_or_swapped_are_read_or_refused(file, name, data):
    lines = (SAMPLES / name).read_bytes().split(b"\n")
    index = st.integers(0, len(lines) - 1)
    first, second = data.draw(index), data.draw(index)
    way = data.draw(st.sampled_from(["lose", "double", "swap"]))
    if way == "swap":
        lines[first], lines[second] = lines[second], lines[first]
    else:
        lines[first : first + 1] = [] if way == "lose" else [lines[first]] * 2
    read_or_refuse(file(b"\n".join(lines), name))


@pytest.mark.nightly
@pytest.mark.parametrize(
    ("faulty", "count"), [(slice(10, 11), 5), (slice(-1, None), 5), (slice(4, None), 11)]
)
def test_a_record_of_60_mb_with_faults_is_refused_within_400_mb(file, faulty, count):
    rows = ["PEER NGA", "Event", "ACCELERATION TIME SERIES IN UNITS OF G"]
    rows += ["NPTS= 3750000, DT= .0050 SEC"]
    rows += [
        "  0.1234567E-01 -0.1234567E-01  0.9876543E-01 -0.5555555E-01  0.1111111E-01"
    ] * 750_000
    rows[faulty] = [row.replace("E-01", "abc") for row in rows[faulty]]
    path = file("\n".join(rows) + "\n", "x.at2")
    read = (
        "import sys, pathlib, solver\n"
        "try: solver.read_record(pathlib.Path(sys.argv[1]))\n"
        f"except solver.InputError as error: assert len(error.problems) == {count}, error\n"
        "else: sys.exit('read')\n"
        # Of this program alone: ru_maxrss has that of its parent as well.
        "status = pathlib.Path('/proc/self/status').read_text().split()\n"
        "print(int(status[status.index('VmHWM:') + 1]) / 1024)"
    )
    command = [sys.executable, "-c", read, str(path)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert float(done.stdout) <= 400.0
