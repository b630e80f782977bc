"""Records and documents that a workbook names: which it may, what is read, what is refused."""

import hashlib
import os

import numpy as np
import pytest

from fixtures import workbooks
from fixtures.marks import by_day
from fixtures.workbooks import (
    cell_address,
    make,
    problems,
    read_workbook,
    row_cells,
    type_into,
    with_addresses,
)
from report.project.read import documents
from report.project.read.read import read


@pytest.fixture(scope="module")
def shaken(tmp_path_factory):
    """The project, its first motion with a transverse record: with the slashes of Windows."""
    path = recorded(make(tmp_path_factory.mktemp("shaken")), y="acc_g\n" + "0.1\n" * 200)
    return read_workbook(type_into(path, {"Motions/M1/Transverse record": "records\\y.csv"}))


def test_motions_are_scaled_signed_and_run_beside_their_transverse_records(shaken):
    m1, m2, m3 = shaken.motions
    assert [m.id for m in shaken.motions] == ["M1", "M2", "M3"]
    assert (m1.scale, m1.signs, m1.has_vertical, m1.source) == (1.0, (1, -1), True, "made")
    assert (m2.scale, m2.signs, m2.has_vertical) == (2.0, (-1,), False)
    assert m3.signs == (1,)
    assert m3.scale * np.abs(m3.ax_mps2).max() == pytest.approx(1.5 * 9.80665, rel=1e-12)
    assert (m1.dt_s, m3.dt_s) == (0.01, 0.02)
    assert np.allclose(m1.ay_mps2, 0.980665)
    names = [[one.name for one in motion.orientations] for motion in (m1, m2)]
    assert names == [["record +", "record −", "transverse +", "transverse −"], ["record −"]]
    for motion in shaken.motions:
        for a in (motion.ax_mps2, motion.ay_mps2, motion.az_mps2):
            assert not a.flags.writeable


def test_records_are_listed_with_their_hashes(shaken):
    assert [(r.motion_id, r.component, r.name) for r in shaken.records] == [
        ("M1", "horizontal", "records/x.csv"),
        ("M1", "transverse", "records\\y.csv"),
        ("M1", "vertical", "records/z.csv"),
        ("M2", "horizontal", "records/x2.csv"),
        ("M3", "horizontal", "records/x3.csv"),
    ]
    z = shaken.records[2]
    data = (shaken.path.parent / "records" / "z.csv").read_bytes()
    assert (z.sha256, z.npts) == (hashlib.sha256(data).hexdigest(), 200)
    assert z.peak_g == pytest.approx(0.25, abs=1e-4)


WITHIN = "use a file in the workbook's folder, such as records/m1-x.csv"
NEARLY = {
    "records/long_nmae.csv": "csv", "records/Long_Name.CSV": "csv", "records/long_name.at": "at2",
    "recs/long_name.at2": "at2", "long_name.csv | EW": "csv",
}  # fmt: skip


@pytest.mark.parametrize("name", by_day(NEARLY, 2))
def test_a_file_name_that_nearly_fits_is_asked_about(tmp_path, name):
    path = type_into(make(tmp_path), {"Motions/M1/Horizontal record": name})
    for kind in ("at2", "csv"):
        (path.parent / "records" / f"long_name.{kind}").write_text("acc_g\n0\n1\n")
    (problem,) = problems(path)
    asked = f"'{name.partition(' |')[0]}' does not exist"
    assert problem.endswith(f"{asked}; did you mean 'records/long_name.{NEARLY[name]}'?")


def test_a_file_whose_name_macos_wrote_in_other_characters_is_read(tmp_path):
    name = "records/S\u00fcd.csv"
    path = type_into(make(tmp_path), {"Motions/M1/Horizontal record": name})
    folder = path.parent / "records"
    (folder / "x.csv").rename(folder / "Su\u0308d.csv")
    assert read_workbook(path).records[0].name == name


REFUSED = [
    ("records/none.csv", f"'records/none.csv' does not exist; {WITHIN}"),
    ("records", f"'records' is not a file; {WITHIN}"),
    ("/etc/hostname", f"'/etc/hostname' is outside the workbook's folder; {WITHIN}"),
    ("../x.csv", f"'../x.csv' is outside the workbook's folder; {WITHIN}"),
    ("..\\x.csv", f"'../x.csv' is outside the workbook's folder; {WITHIN}"),
    ("C:\\x.csv", f"'C:/x.csv' is outside the workbook's folder; {WITHIN}"),
    ("\\\\host\\x", f"'//host/x' is outside the workbook's folder; {WITHIN}"),
    ("link.csv", f"'link.csv' is a link to a file outside the workbook's folder; {WITHIN}"),
    ("loop.csv", f"'loop.csv' cannot be found; {WITHIN}"),
    ("n" * 300, f"'{'n' * 300}' cannot be found; {WITHIN}"),
    ("pipe.csv", f"'pipe.csv' is not a file; {WITHIN}"),
    ("big.csv", "'big.csv' is 65 MB; use at most 64 MB"),
    ("input.xlsx",
     "input.xlsx: not a text file; a zip or a workbook; unpack it, or save its worksheet as CSV"),
]  # fmt: skip


@pytest.mark.parametrize("start", by_day(range(0, len(REFUSED), 3), 2))
def test_a_record_must_be_a_file_within_the_folder(tmp_path, start):
    """Three at a time: the workbook has three motions."""
    cases, folder = REFUSED[start : start + 3], tmp_path / "job"
    rows = [f"Motions/{row}/Horizontal record" for row in range(1, len(cases) + 1)]
    path = type_into(make(folder), dict(zip(rows, [name for name, _ in cases], strict=True)))
    (tmp_path / "outside.csv").write_text("0.1\n0.2\n")
    (folder / "link.csv").symlink_to(tmp_path / "outside.csv")
    (folder / "loop.csv").symlink_to(folder / "loop.csv")
    os.mkfifo(folder / "pipe.csv")
    with (folder / "big.csv").open("wb") as file:
        file.truncate(65_000_000)
    lines = zip(rows, cases, strict=True)
    assert problems(path) == with_addresses(
        *(f"<{row}>: horizontal record: {line}" for row, (_, line) in lines)
    )


def recorded(path, **texts):
    """Write records beside the workbook."""
    for name, text in texts.items():
        (path.parent / "records" / f"{name}.csv").write_text(text)
    return path


def timed(step, count):
    return "time_s,acc_g\n" + "".join(f"{i * step:.2f},0.1\n" for i in range(count))


CHANNELS = "time (s),East (g),North (g),Up (g)\n" + "".join(
    f"{0.01 * i:.2f},{0.003 * i:.3f},{0.006 * i:.3f},{0.009 * i:.3f}\n" for i in range(101)
)
ONE_OF = "use one by name or number: 1 East; 2 North; 3 Up"
AS_IN_FILE = row_cells("Motions/M1", {"Record units": None, "Time step": None})
PART = "acc_g\n" + "0.1\n" * 100 + "0\n" * 100
STILL = {"Motions/M2/Horizontal record": "records/still.csv"}
FIRST, SECOND, THIRD = (f"<Motions/M{k}/Horizontal record>: horizontal record" for k in (1, 2, 3))
VERTICAL = "<Motions/M1/Vertical record>: vertical record"
NO_PEAK = "is all zeros and cannot be scaled to a"

# Records, cells, and the resulting lines.
FAULTS = [
    ({"z": "0.1\nabc\n0.2\n"}, {}, f"{VERTICAL}: z.csv:2: found 'abc'; enter a number"),
    ({"x": timed(0.01, 150), "z": timed(0.02, 100)}, {"Motions/M1/Time step": None},
     f"{VERTICAL} has a time step of 0.02 s, but the horizontal record has 0.01 s; make them"
     " equal"),
    ({"all": CHANNELS},
     AS_IN_FILE | row_cells("Motions/M1", {"Horizontal record": "records/all.csv",
                                    "Vertical record": "records/all.csv | Down"}),
     f"{FIRST}: all.csv: found several channels; {ONE_OF}",
     f"{VERTICAL}: all.csv: found no channel 'Down'; {ONE_OF}"),
    ({"x3": "0\n" * 200}, {}, f"{THIRD} {NO_PEAK} PPA; change the record or scaling"),
    *(({"x": PART},
       row_cells("Motions/M1", {"Scaling": scaling, "Factor or PPA": scale, "Start time": 1}),
       f"{FIRST} {NO_PEAK} {scaling}; change the record or scaling")
      for scaling, scale in (("PPA", 1), ("target spectrum", None))),
    # A verdict of OK followed from any of these.
    ({"still": "0\n" * 200}, STILL, f"{SECOND} is all zeros; use a record of the shaking"),
    *(({"still": samples}, STILL, f"{SECOND} lasts {lasts}; use a record of 1 s or more")
      for samples, lasts in (("0.1\n-0.1\n", "0.01 s as run (2 samples)"),
                             ("0.1\n-0.1\n" * 50, "0.99 s as run (100 samples)"))),
    # Most of the weight was gone, or the block was pushed downslope by 1 g.
    ({"still": "1.1\n0.9\n" * 100}, STILL,
     f"{SECOND} has a mean of 1 g: it includes gravity; use it without, or remove the mean by the"
     " column Baseline"),
]  # fmt: skip


@pytest.mark.parametrize(
    "number", by_day(range(len(FAULTS)), 4), ids=[lines[0][:70] for _, _, *lines in FAULTS]
)
def test_a_record_that_cannot_be_run_is_refused_at_its_cell(tmp_path, number):
    texts, cells, *lines = FAULTS[number]
    assert problems(type_into(recorded(make(tmp_path), **texts), cells)) == with_addresses(*lines)


@pytest.mark.parametrize(
    ("cells", "wanted"),
    by_day([
        # Units that neither file nor sheet states are requested; those that differ are reported.
        ({"Record units": "from file"},
         {"Record units": "enter units, one of", "Record units ": "enter units, one of"}),
        ({"Horizontal record": "records/all.csv | 1", "Vertical record": None,
          "Record units": "cm/s2"},
         {"Record units": "units are cm/s2; enter the units of the file, or 'from file'"}),
        ({"Horizontal record": "records/all.csv | 1", "Vertical record": None, "Time step": 0.02,
          "Record units": "from file"},
         {"Time step": "but 0.02 s was entered; enter the time step of the file, or leave it"
          " blank"}),
        ({"Low-pass corner": 60},
         {"Horizontal record": "horizontal record: x.csv: low-pass corner is 60 Hz; enter"}),
        # Records are checked even if their row has other errors.
        ({"ID": None, "Record units": "furlongs", "Horizontal record": "records/none.csv"},
         {"ID": "", "Horizontal record": "does not exist", "Record units": "furlongs"}),
    ], 2),
)  # fmt: skip
def test_what_does_not_suit_a_record_is_reported_at_its_cell(tmp_path, cells, wanted):
    path = type_into(recorded(make(tmp_path), all=CHANNELS), row_cells("Motions/M1", cells))
    for line, (heading, words) in zip(problems(path), wanted.items(), strict=True):
        assert line.startswith(cell_address(f"<Motions/M1/{heading.strip()}>: "))
        assert words in line


def test_components_are_trimmed_and_one_of_zeros_is_read_if_the_other_shakes(tmp_path):
    path = recorded(make(tmp_path), x="0.1\n-0.2\n" * 100, z="0.1\n-0.2\n" * 98)
    book = read_workbook(path)
    assert len(book.motions[0].ax_mps2) == len(book.motions[0].az_mps2) == 196
    x, z = book.records[:2]
    assert (x.npts, x.npts_trimmed, z.npts_trimmed, z.notes) == (200, 4, 0, ())
    assert x.notes[-1] == "last 4 of 200 samples trimmed to the length of the shortest component"
    # Not up to a common end time.
    book = read_workbook(type_into(path, {"Motions/M1/End time": 1.5}))
    assert len(book.motions[0].ax_mps2) == len(book.motions[0].az_mps2) == 151
    assert [record.npts_trimmed for record in book.records[:2]] == [0, 0]
    path = recorded(make(tmp_path), still="0\n" * 200)
    cells = STILL | {"Motions/M2/Transverse record": "records/x2.csv"}
    motion = read_workbook(type_into(path, cells)).motions[1]
    assert not motion.ax_mps2.any()
    assert motion.ay_mps2.any()


@pytest.mark.parametrize("names", [("East", "north", " UP "), ("1", "2", "3")])
def test_channels_of_one_file_are_components(tmp_path, names):
    channels = dict(zip(("Horizontal", "Transverse", "Vertical"), names, strict=True))
    cells = {f"Motions/M1/{c} record": f"records/all.csv | {n}" for c, n in channels.items()}
    book = read_workbook(type_into(recorded(make(tmp_path), all=CHANNELS), cells | AS_IN_FILE))
    first = book.motions[0]
    for a, slope in ((first.ax_mps2, 0.003), (first.ay_mps2, 0.006), (first.az_mps2, 0.009)):
        assert a == pytest.approx(slope * 9.80665 * np.arange(101))
    assert book.records[1].name == f"records/all.csv | {names[1]}".strip()
    assert book.records[1].format == "text"


LETTER, REPORT = "Options/Letter of review", "Friction tests/Test report file"
PRINTOUT = "Site/Printout of seismic parameters"
PDF = b"%PDF-1.7\nletter"


@pytest.fixture
def workbook(tmp_path):
    return workbooks.make(tmp_path / "project")


def naming(workbook, name, content=None):
    """Return the workbook with the letter of review named, and the file beside it if it has one."""
    if content is not None:
        path = workbook.parent / name.replace("\\", "/")
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(content)
    return type_into(workbook, {LETTER: name})


@pytest.mark.parametrize(
    ("name", "path"),
    by_day(
        [("letter.pdf", "letter.pdf"), ("./review/a.PDF", "review/a.PDF"), ("b\\a.pdf", "b/a.pdf")],
        1,
    ),
)
@pytest.mark.quick
def test_a_document_beside_the_workbook_is_read_with_its_hash(workbook, name, path):
    (found,) = read(naming(workbook, name, PDF)).documents
    assert (found.label, found.path, found.size) == ("Letter of review", path, len(PDF))
    assert found.sha256 == hashlib.sha256(PDF).hexdigest()


@pytest.mark.parametrize(
    ("name", "said"),
    by_day([("up/letter.pdf", "is a link to a file outside the workbook's folder"),
     ("records/x.csv", "is not a PDF; attach it as a PDF"),
     ("leter.pdf", "does not exist; did you mean 'letter.pdf'?")], 1),
)  # fmt: skip
def test_what_may_not_be_attached_is_an_error_of_its_cell(workbook, name, said):
    folder = workbook.parent
    for home in (folder, folder.parent):
        (home / "letter.pdf").write_bytes(PDF)
    (folder / "up").symlink_to(folder.parent)
    (problem,) = problems(naming(workbook, name))
    assert problem.startswith(f"{cell_address(LETTER)}: letter of review: '{name}' {said}")


@pytest.mark.nightly
def test_all_documents_together_have_a_limit(workbook, monkeypatch):
    monkeypatch.setattr(documents, "MAX_DOCUMENTS", 2 * len(PDF) - 1)
    naming(workbook, "letter.pdf", PDF)
    assert len(read(workbook).documents) == 1
    (workbook.parent / "report.pdf").write_bytes(PDF)
    (problem,) = problems(type_into(workbook, {REPORT: "report.pdf"}))
    assert problem.startswith(f"{cell_address(LETTER)}: ")
    assert "'letter.pdf' and the other documents have more than" in problem


@pytest.mark.nightly
def test_one_file_in_three_cells_is_named_three_times(workbook):
    assert read(workbook).documents == ()
    naming(workbook, "both.pdf", PDF)
    documents = read(type_into(workbook, {REPORT: "both.pdf", PRINTOUT: "both.pdf"})).documents
    labels = ["Printout of seismic parameters", "Test report file", "Letter of review"]
    assert [each.label for each in documents] == labels
    assert {each.path for each in documents} == {"both.pdf"}
