"""The command that generates suites: its files, its table, and its input errors."""

import hashlib
import json
import math
import re
from pathlib import Path

import numba
import numpy as np
import pytest
from openpyxl import Workbook

from fixtures import commands, records
from fixtures.records import PEAK_G
from fixtures.spaces import spaced
from report.results.publish import STAMP
from report.suite.seed_records import read_seeds
from report.suite.suite_files import suite_files
from report.suite.suite_table import suite_table
from report.suite.targets import ac156_targets
from report.text.units import G_MPS2
from solver.errors import InputError
from solver.formats import read_motion_file, read_record
from solver.records.spectrum import response_spectrum
from solver.rules.ac156 import Tail, ac156_horizontal, ac156_vertical
from solver.rules.hazard import EDITIONS

pytestmark = [
    pytest.mark.skipif(
        numba.config.DISABLE_JIT, reason="each motion takes minutes without compiled kernels"
    ),
    pytest.mark.quick,
]


AC156 = ("--sds", 1.2, "--code", "asce7-16")
G = 9.80665


def run(*words, exit_code=0):
    """The output of the command."""
    return commands.output_of("motion", "suite", *words, exit_code=exit_code)


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Return the folder and the output of a suite of two motions."""
    folder = tmp_path_factory.mktemp("made") / "suite"
    return folder, run(folder, *AC156, "--count", 2, "--seed", 5)


@pytest.fixture(scope="module")
def document(made):
    return json.loads((made[0] / "suite.json").read_text())


def components_of(folder, motion):
    return [read_record(folder / f"motion-{motion:02d}-{axis}.csv", units="g") for axis in "xyz"]


@pytest.mark.nightly
def test_every_file_is_written_with_the_hold_of_its_envelope_and_nothing_else(made, tmp_path):
    names = {f"motion-0{k}-{axis}.csv" for k in (1, 2) for axis in "xyz"}
    assert {path.name for path in made[0].iterdir()} == names | {"suite.json", "suite.png", STAMP}
    assert (made[0] / "suite.png").read_bytes().startswith(b"\x89PNG")
    path = made[0] / "motion-01-x.csv"
    assert path.read_text().startswith("# generated; hold of the envelope 20 s\ntime_s,")
    assert read_motion_file(path).hold_s == 20.0
    plain = tmp_path / "plain.csv"
    plain.write_text(path.read_text().partition("\n")[2])
    assert math.isnan(read_motion_file(plain).hold_s)


@pytest.mark.nightly
def test_the_files_agree_with_suite_json(made, document):
    freq_hz = 0.1 * 2.0 ** (np.arange(101) / 12.0)
    assert document["seed"] == 5
    assert document["envelope_s"] == [5.0, 20.0, 5.0]
    for k, motion in enumerate(document["motions"], start=1):
        components = components_of(made[0], k)
        assert motion["id"] == f"motion-0{k}"
        together = np.corrcoef([record.a_mps2 for record in components])
        said = [motion[f"correlation_{pair}"] for pair in ("xy", "xz", "yz")]
        assert said == pytest.approx([together[0, 1], together[0, 2], together[1, 2]], rel=1e-9)
        assert max(map(abs, said)) <= 0.3
        for record, part in zip(components, motion["components"], strict=True):
            path = made[0] / part["file"]
            assert part["sha256"] == hashlib.sha256(path.read_bytes()).hexdigest()
            corners = document["target"]["vertical" if part["component"] == "z" else "horizontal"]
            log_target = np.interp(
                np.log(freq_hz), np.log(corners["freq_hz"]), np.log(corners["sa_g"])
            )
            psa = response_spectrum(record.a_mps2, record.dt_s, 1.0 / freq_hz) / G
            ratio = psa / np.exp(log_target)
            # The file has the end of the band, 33.3 Hz, besides.
            assert part["least_ratio"] <= ratio.min() * (1 + 1e-9)
            assert part["greatest_ratio"] >= ratio.max() * (1 - 1e-9)
            assert part["mean_ratio"] == pytest.approx(ratio.mean(), abs=0.002)
            assert part["least_ratio"] >= 0.90
            assert part["greatest_ratio"] <= 1.30
            assert part["pga_g"] == pytest.approx(np.abs(record.a_mps2).max() / G, rel=1e-12)
            assert part["final_velocity_mps"] == part["final_displacement_m"] == 0.0
            assert part["grew_from"] == "noise"


@pytest.mark.nightly
def test_the_rows_of_the_acceptance_are_stated(made, document):
    rows = document["acceptance"]
    assert len(rows) == 10
    # Two motions are one too few; every other row is satisfied.
    assert [row["title"] for row in rows if not row["satisfied"]] == ["Number of motions"]
    assert "NG: Number of motions: 2, at least 3\n" in made[1]
    assert made[1].count("\nOK: ") == 9
    hold = "OK: Strong-motion duration of generated motions (hold time): 20.0 s, at least 20.0 s"
    assert hold in made[1]
    ours = [row for row in rows if row["is_ours"]]
    assert [row["limit"] for row in ours] == [0.9, 1.0]
    assert made[1].count("not a code requirement, limit set by this program") == 2
    points = np.geomspace(0.1, 1.3, 24)
    corners = document["target"]["horizontal"]
    target = np.exp(np.interp(np.log(points), np.log(corners["freq_hz"]), np.log(corners["sa_g"])))
    for axis in (0, 1):
        spectra = [
            response_spectrum(record.a_mps2, record.dt_s, 1.0 / points) / G / target
            for record in (components_of(made[0], k)[axis] for k in (1, 2))
        ]
        assert ours[0]["found"] <= np.min(spectra) * (1 + 1e-9)
        assert ours[1]["found"] <= np.mean(spectra, axis=0).min() * (1 + 1e-9)


@pytest.mark.nightly
def test_the_target_is_that_of_the_code_and_the_table_states_it_with_the_fit(made, document):
    target = document["target"]
    across = ac156_horizontal(EDITIONS["ASCE 7-16"], s_ds_g=1.2, z_over_h=1.0)
    assert target["horizontal"]["sa_g"] == across.sa_g.tolist()
    assert target["vertical"]["sa_g"] == ac156_vertical(s_ds_g=1.2).sa_g.tolist()
    assert (target["code"], target["s_ds_g"], target["z_over_h"]) == ("ASCE 7-16", 1.2, 1.0)
    assert (target["tail"], target["tail_rule"]) == ("AC156", spaced(Tail.AC156.sentence))
    lines = made[1].splitlines()
    assert "AC156 with ASCE 7-16, S_DS 1.2 g, z/h 1: A_FLX 1.92 g, A_RIG 1.44 g" in made[1]
    assert spaced(f"tail: {Tail.AC156.sentence}") in made[1]
    rows = [line for line in lines if re.search(r" [xyz]  \d", line)]
    assert len(rows) == 6
    assert all("noise" in row for row in rows)
    assert (
        "6 of 6 components have spectra of 0.90 to 1.30 times the target and a mean ratio within"
        " 7% of 1 (1/12 octave, from 0.1 Hz to 33.3 Hz, 5% damping)" in made[1]
    )
    assert any(line.endswith("suite: 6 records, suite.json, suite.png; seed 5") for line in lines)
    assert lines[-1] == f"Next: roofslip motion rows {made[0]} DIR --at roof"


@pytest.mark.nightly
def test_the_same_seed_gives_the_same_bytes_and_no_former_motion_remains(made, tmp_path):
    run(tmp_path, *AC156, "--count", 1, "--seed", 5)
    for axis in "xyz":
        name = f"motion-01-{axis}.csv"
        assert (tmp_path / name).read_bytes() == (made[0] / name).read_bytes()
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    run(tmp_path, *AC156, "--count", 1, "--seed", 5)
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before
    output = run(made[0], *AC156, "--count", 1, exit_code=2)
    assert "motion-02-x.csv and 2 other files of an earlier suite would remain" in output


@pytest.mark.nightly
def test_records_seed_the_motions(made, tmp_path):
    x, y, z = (made[0] / f"motion-01-{axis}.csv" for axis in "xyz")
    other = made[0] / "motion-02-x.csv"
    words = (tmp_path / "a", *AC156, "--tail", "1/T", "--count", 2)
    output = run(*words, "--records", f"{x},{y},{z}", other)
    document = json.loads((tmp_path / "a" / "suite.json").read_text())
    first, second = (
        [part["grew_from"] for part in motion["components"]] for motion in document["motions"]
    )
    assert first == [x.name, y.name, z.name]
    assert second == [other.name, *[f"{other.name}, random phases"] * 2]
    assert document["seed_records"][3] == {
        "file": str(other),
        "sha256": hashlib.sha256(other.read_bytes()).hexdigest(),
    }
    assert document["target"]["tail"] == "1/T"
    assert spaced(Tail.RECIPROCAL.sentence) in output


@pytest.mark.parametrize("again", [(), ("--records",)])
@pytest.mark.nightly
def test_records_are_listed_or_the_option_is_repeated(made, tmp_path, again):
    first, gone = made[0] / "motion-01-x.csv", tmp_path / "gone.csv"
    words = ("--count", 2, "--records", first, *again, gone)
    assert "gone.csv: no such file" in run(tmp_path / "a", *AC156, *words, exit_code=2)


def columns(path, heading):
    t = 0.01 * np.arange(1000)
    sines = [np.sin(k * t) * np.exp(-0.1 * t) for k in (7.0, 9.0, 20.0, 30.0)]
    rows = np.column_stack([t, *sines[: heading.count(",")]])
    body = "\n".join(",".join(f"{value:.6f}" for value in row) for row in rows)
    path.write_text(f"{heading}\n{body}\n")
    return path


def test_a_vertical_among_three_channels_seeds_z_and_every_file_at_fault_is_reported(tmp_path):
    path = columns(tmp_path / "site.V2", "time_s,UP_g,N10E_g,S80E_g")
    (group,) = read_seeds([str(path)], units="g", dt_s=math.nan).groups
    assert ["UP" in record.name for record in group] == [False, False, True]
    assert all(record.name.startswith("site.V2, ") for record in group)
    lone = [columns(tmp_path / f"{name}.csv", "time_s,a_g") for name in ("Z", "X", "Y")]
    (group,) = read_seeds([",".join(map(str, lone))], units="g", dt_s=math.nan).groups
    assert [record.name for record in group] == ["X.csv", "Y.csv", "Z.csv"]
    path = columns(tmp_path / "many.csv", "time_s,a_g,b_g,c_g,d_g")
    with pytest.raises(InputError) as caught:
        read_seeds([str(path), "none.csv", "a.csv,b.csv"], units="g", dt_s=math.nan)
    problems = caught.value.problems
    assert "many.csv: has 4 channels; enter one, two or three" in problems[0]
    assert problems[1].startswith("none.csv: no such file")
    assert problems[2].startswith("a.csv: no such file")


@pytest.mark.nightly
def test_a_sheet_of_a_workbook_is_the_target(tmp_path):
    workbook = Workbook()
    workbook.active.title = "Site"
    for row in [("T [s]", "horizontal [g]"), (0.02, 0.5), (0.1, 1.0), (0.6, 1.0), (5.0, 0.12)]:
        workbook.active.append(row)
    workbook.save(tmp_path / "book.xlsx")
    words = (tmp_path / "suite", "--target", f"{tmp_path / 'book.xlsx'}!Site", "--count", 1)
    output = run(*words, exit_code=2)
    assert "book.xlsx!Site: has no vertical column; add vertical [g], or use --sds" in output
    assert not (tmp_path / "suite").exists()
    output = run(*words, "--sds", 0.9)
    assert "target: book.xlsx!Site, 4 points, periods up to 5 s" in output
    document = json.loads((tmp_path / "suite" / "suite.json").read_text())
    assert document["target"]["horizontal"]["sa_g"] == [0.12, 1.0, 1.0, 0.5]
    assert document["target"]["vertical"]["sa_g"][1] == pytest.approx(0.67 * 0.9)
    assert document["target"]["vertical_source"] == "AC156"


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ((), "no target; use --sds and --code, or --target"),
        (("--sds", 0.0, "--code", "pv1"), "S_DS is 0 g; enter 0.01 to 5 g"),
        (("--sds", "inf", "--code", "pv1"), "'--sds': it is inf g; enter a finite number."),
        (("--sds", 1.0, "--code", "pv1", "--zh", 1.5), "z/h is 1.5; enter a number from 0"),
        (("--sds", 1.0, "--code", "ibc"), "--code is 'ibc'; enter one of"),
        ((*AC156, "--count", 0), "Invalid value for '--count'"),
        ((*AC156, "x.csv"), "unexpected argument 'x.csv'; put --records before the files"),
        ((*AC156, "--records", "none.csv"), "none.csv: no such file"),
    ],
)
def test_missing_or_invalid_options_are_reported(tmp_path, words, expected):
    assert expected in run(tmp_path / "suite", *words, exit_code=2)
    assert not (tmp_path / "suite").exists()


def test_a_folder_that_cannot_be_written_is_reported(tmp_path):
    (tmp_path / "file").write_text("")
    words = (tmp_path / "file", *AC156, "--count", 1)
    assert "is a file, not a folder" in run(*words, exit_code=2)


def test_seed_records_are_hashed_as_they_were_read(tmp_path, monkeypatch):
    path = tmp_path / "seed.csv"
    path.write_text(was := "0.1\n0.2\n-0.1\n")
    read_bytes = Path.read_bytes

    def replaced(file):
        content = read_bytes(file)
        file.write_text("another file")
        return content

    monkeypatch.setattr(Path, "read_bytes", replaced)
    seeds = read_seeds([str(path)], units="g", dt_s=0.01)
    assert seeds.sha256 == {str(path): hashlib.sha256(was.encode()).hexdigest()}


def test_the_files_of_a_suite_say_what_its_samples_are():
    suite = records.suite(1)
    targets = ac156_targets("asce7-16", s_ds_g=1.2, z_over_h=1.0, tail=Tail.AC156)
    files = suite_files(suite, targets, seed=3, records={})
    document = json.loads(files["suite.json"])
    (motion,) = document["motions"]
    for each in motion["components"]:
        assert each["sha256"] == hashlib.sha256(files[each["file"]]).hexdigest()
        assert each["pga_g"] == pytest.approx(PEAK_G, rel=1e-3)
    first = motion["components"][0]
    # The velocity of a sine that starts at rest reaches twice its amplitude, a / (pi f).
    assert first["pgv_mps"] == pytest.approx(PEAK_G * G_MPS2 / (math.pi * 0.5), rel=1e-3)
    assert motion["correlation_xy"] == pytest.approx(0.0, abs=1e-9)
    assert document["envelope_s"] == pytest.approx([1.0, 2.0, 1.0])
    assert any(not row["satisfied"] for row in document["acceptance"])
    assert files["suite.png"].startswith(b"\x89PNG")
    said = "0 of 3 components have spectra of 0.90 to 1.30"
    assert any(line.startswith(said) for line in suite_table(suite, targets))
