"""Motions that are added to a workbook: rows and records, all or nothing, nothing doubled."""

import zipfile

import pytest

from fixtures import commands
from fixtures.records import write_record
from fixtures.workbooks import make, problems, type_into
from report.motions.prepare import prepare
from report.project.read.read import read

pytestmark = pytest.mark.quick


@pytest.fixture
def library(tmp_path):
    """Two sets, one in a folder, and a record that belongs to none."""
    for axis in "xyz":
        write_record(tmp_path / "library" / "kobe" / f"KJM-{axis}.csv", count=200)
        write_record(tmp_path / "library" / f"PET-{axis}.csv", count=200)
    write_record(tmp_path / "library" / "lone.csv")
    return tmp_path / "library"


def rows(*words):
    return ("motion", "rows", *words)


def test_a_folder_is_listed_and_where_records_were_recorded_asked(library, tmp_path):
    told = commands.stdout_of(*rows(library))
    assert "KJM     x  kobe/KJM-x.csv" in told
    assert "skipped: lone.csv: neither its heading (none) nor its name states a component" in told
    path = make(tmp_path / "p")
    assert "use --at roof or --at ground" in commands.errors_of(*rows(library, path))
    assert not (tmp_path / "p" / "records" / "kobe").exists()
    told = commands.errors_of(*rows(library, path, "--at", "roof", "--only", "nothing"))
    assert "no set of two horizontal records and a vertical one found" in told


@pytest.mark.nightly
def test_sets_become_rows_and_their_files_are_copied(library, tmp_path):
    path = make(tmp_path / "p")
    before = read(path).project.motions
    told = commands.stdout_of(*rows(library, tmp_path / "p", "--at", "roof"))
    assert "6 records copied." in told
    assert f"{path}: 2 rows added to the Motions worksheet: Motions!" in told
    *standing, first, second = read(path).project.motions
    assert tuple(standing) == before
    assert [m.id for m in (first, second)] == ["PET", "KJM"]
    assert second.record == "records/kobe/KJM-x.csv"
    assert (second.transverse, second.vertical) == (
        "records/kobe/KJM-y.csv",
        "records/kobe/KJM-z.csv",
    )
    assert (first.recorded_at, first.source) == ("roof", "PET, text")
    copied = tmp_path / "p" / "records" / "kobe" / "KJM-z.csv"
    assert copied.read_bytes() == (library / "kobe" / "KJM-z.csv").read_bytes()
    assert not (tmp_path / "p" / "records" / "lone.csv").exists()
    # Everything stands already: each cell is listed, and nothing changes.
    after = path.read_bytes()
    told = commands.errors_of(*rows(library, path, "--at", "ground", "--only", "k*"))
    assert told.count("already; remove the row, or leave the motion out") == 1
    assert path.read_bytes() == after


@pytest.mark.nightly
def test_records_keep_their_units_and_the_level_goes_into_the_rows(library, tmp_path):
    for axis in "xyz":
        (library / f"raw-{axis}.txt").write_text(
            "".join(f"{'-' * (k % 2)}0.{k:03d}\n" for k in range(200))
        )
    path = make(tmp_path / "p")
    words = ("--at", "roof", "--only", "raw", "--units", "m/s2", "--dt", 0.02)
    commands.stdout_of(*rows(library, path, *words))
    new = prepare(read(path)).motions[-1]
    assert (new.id, new.dt_s) == ("raw", 0.02)
    assert abs(new.ax_mps2).max() == pytest.approx(0.199)


@pytest.mark.nightly
def test_records_in_the_project_stay_where_they_are(library, tmp_path):
    path = make(tmp_path / "p")
    library.rename(tmp_path / "p" / "own")
    told = commands.stdout_of(*rows(tmp_path / "p" / "own", path, "--at", "roof"))
    assert "0 records copied." in told
    assert read(path).project.motions[-1].record == "own/kobe/KJM-x.csv"


def test_another_file_is_never_overwritten(library, tmp_path):
    path = make(tmp_path / "p")
    other = write_record(tmp_path / "p" / "records" / "PET-y.csv", count=7)
    before = path.read_bytes(), other.read_bytes()
    told = commands.errors_of(*rows(library, path, "--at", "roof"))
    assert f"{other}: is another file than {library / 'PET-y.csv'}; rename one" in told
    assert (path.read_bytes(), other.read_bytes()) == before
    assert not (tmp_path / "p" / "records" / "PET-x.csv").exists()


def test_a_link_out_of_the_folder_is_not_followed(library, tmp_path):
    path, outside = make(tmp_path / "p"), tmp_path / "outside"
    (tmp_path / "p" / "records").rename(outside)
    (tmp_path / "p" / "records").symlink_to(outside)
    names = {entry.name for entry in outside.iterdir()}
    told = commands.errors_of(*rows(library, path, "--at", "roof"))
    assert f"records: is a link to {outside}, and is not written to" in told
    assert {entry.name for entry in outside.iterdir()} == names


@pytest.mark.parametrize("name", ["../out.csv", "/etc/x.csv", "a/../../b.csv"])
@pytest.mark.nightly
def test_a_zip_is_checked_and_unpacked_elsewhere(library, tmp_path, name):
    path, zipped = make(tmp_path / "p"), tmp_path / "kobe.zip"
    with zipfile.ZipFile(zipped, "w") as archive:
        for axis in "xyz":
            archive.write(library / "kobe" / f"KJM-{axis}.csv", f"kobe/KJM-{axis}.csv")
    commands.stdout_of(*rows(zipped, path, "--at", "roof"))
    assert read(path).project.motions[-1].vertical == "records/kobe/KJM-z.csv"
    with zipfile.ZipFile(zipped, "a") as archive:
        for axis in "xyz":
            archive.write(library / "kobe" / f"KJM-{axis}.csv", f"{axis}.csv")
    assert "kobe    x  x.csv" in commands.stdout_of(*rows(zipped))  # the zip gives the name
    with zipfile.ZipFile(zipped, "a") as archive:
        archive.writestr(name, "0,0")
    assert "is not a path within a folder" in commands.errors_of(*rows(zipped))


def test_a_folder_that_is_not_there_is_asked_about_and_one_elsewhere_is_no_record(
    library, tmp_path
):
    assert f"did you mean '{library}'?" in commands.errors_of(*rows(tmp_path / "librar"))
    path = make(tmp_path / "p")
    assert "is outside the workbook's folder" in "".join(
        problems(type_into(path, {"Motions/M1/Horizontal record": str(library / "PET-x.csv")}))
    )
