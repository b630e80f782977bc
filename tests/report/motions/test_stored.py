"""Files from a browser: paths, links, bombs and sizes are refused before anything is read."""

import io
import random
import stat
import zipfile
from contextlib import suppress

import pytest

from fixtures.marks import by_day
from report.motions.stored import store, unpack
from solver.errors import InputError

pytestmark = pytest.mark.quick


def sent(*names, content=b"x"):
    return [(name, io.BytesIO(content)) for name in names]


def packed(members, **options):
    """A zip of members, each a name or a ZipInfo with its content."""
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED, **options) as archive:
        for name, content in members:
            archive.writestr(name, content)
    return zipped(data.getvalue())


def zipped(content):
    return [("project.zip", io.BytesIO(content))]


def changed(files, *changes):
    """A zip whose headers are changed: bytes after a mark, behind so many others."""
    data = bytearray(files[0][1].getvalue())
    for mark, behind, new in changes:
        at = data.find(mark) + behind
        data[at : at + len(new)] = new
    return zipped(bytes(data))


# Of the directory at the end of a zip, and before a file.
LISTED, HEADER = b"PK\x01\x02", b"PK\x03\x04"


@pytest.mark.parametrize(
    "name",
    [
        "../input.xlsx", "a/../../b", "/etc/passwd", "\\\\host\\share", "C:\\x.csv", "..\\x.csv",
        "a//b", "./a", "", "a/", "con", "records/NUL.csv", "x.csv.", "x ", "a\x00b", "a\nb", "a:b",
        "a" * 201, "/".join("abcdefghi"), "~/x|y", "ä" * 150, "aux .csv", "CONIN$", "lpt².csv",
    ],
)  # fmt: skip
def test_a_path_that_leaves_its_folder_on_any_system_is_refused(name, tmp_path):
    with pytest.raises(InputError):
        store(sent("input.xlsx", name), tmp_path)
    # In a zip, a name ends with its first NUL, and one that ends in a slash is a folder.
    if name and "\x00" not in name and not name.endswith("/"):
        with pytest.raises(InputError):
            store(packed([("again/input.xlsx", b""), (name, b"")]), tmp_path)
    assert {path.name for path in tmp_path.iterdir()} <= {"input.xlsx", "again"}
    assert not (tmp_path.parent / "input.xlsx").exists()


def test_a_zip_of_windows_may_have_backslashes_in_its_names(tmp_path):
    members = [("set\\", b""), ("set\\input.xlsx", b"1"), ("set\\records\\x.csv", b"2")]
    assert store(packed(members), tmp_path) == tmp_path / "set" / "input.xlsx"
    assert (tmp_path / "set" / "records" / "x.csv").read_bytes() == b"2"


def test_a_link_in_a_zip_is_refused(tmp_path):
    link = zipfile.ZipInfo("records/x.csv")
    link.external_attr = (stat.S_IFLNK | 0o777) << 16
    with pytest.raises(InputError, match="a link instead of a file"):
        store(packed([("input.xlsx", b""), (link, b"/etc/passwd")]), tmp_path)
    assert not list(tmp_path.iterdir())


def test_a_bomb_is_stopped_while_it_is_unpacked(tmp_path, monkeypatch):
    monkeypatch.setattr("report.motions.stored.MOST_STORED", 3_000_000)
    with pytest.raises(InputError, match="more than 3 MB"):
        store(packed([("input.xlsx", bytes(50_000_000))]), tmp_path)
    assert sum(path.stat().st_size for path in tmp_path.rglob("*") if path.is_file()) <= 3_000_000


def test_a_bomb_that_states_a_small_size_is_stopped(tmp_path):
    size = (10).to_bytes(4, "little")
    bomb = packed([("input.xlsx", bytes(1_000_000))])
    with pytest.raises(InputError, match="damaged in the zip"):
        store(changed(bomb, (LISTED, 24, size), (HEADER, 22, size)), tmp_path)
    assert sum(path.stat().st_size for path in tmp_path.iterdir()) <= 10


LOCKED = changed(packed([("input.xlsx", b"abc")]), (LISTED, 8, b"\1"), (HEADER, 6, b"\1"))


@pytest.mark.parametrize(
    ("files", "problem"),
    by_day(
        [
            (sent(), "no file was uploaded"),
            (sent("a.csv"), r"no workbook \(.xlsx\) was uploaded"),
            (sent("a.xlsx", "b.xlsx"), r"2 workbooks were uploaded \(a.xlsx, b.xlsx\)"),
            (sent("a.zip", "b.xlsx"), "a zip was uploaded with other files"),
            (sent("input.xlsx", *(f"{k}.csv" for k in range(500))), "more than 500 files"),
            (zipped(b""), "the zip is damaged"),
            (zipped(HEADER), "the zip is damaged"),
            (zipped(b"not a zip"), "the zip is damaged"),
            (zipped(bytes(100)), "the zip is damaged"),
            (LOCKED, "has a password"),
            # Names that another system takes for one.
            (sent("input.xlsx", "a.csv", "A.csv"), "rename one"),
            (sent("input.xlsx", "records/a.csv", "Records/b.csv"), "rename one"),
            (sent("input.xlsx", "a.csv", "a.csv"), "rename one"),
            (sent("input.xlsx", "a", "a/b.csv"), "rename one"),
            (sent("input.xlsx", "a/b.csv", "a"), "rename one"),
            (sent("input.xlsx", "caf\u00e9.csv", "cafe\u0301.csv"), "rename one"),
        ],
        5,
    ),
)
def test_files_that_are_refused_are_refused_with_the_reason(files, problem, tmp_path):
    with pytest.raises(InputError, match=problem):
        store(files, tmp_path)


@pytest.mark.parametrize(
    ("names", "found"),
    [
        (("a/input.xlsx", "a/out/results.xlsx"), "a/input.xlsx"),
        (("a/work.xlsx", "a/out/results.xlsx"), "a/work.xlsx"),
        (("work.xlsx", "~$work.xlsx", ".hidden/input.xlsx"), "work.xlsx"),
        (("work.xlsx", "work.before.xlsx"), "work.xlsx"),
        (("__MACOSX/input.xlsx", "b/INPUT.XLSX", "other.xlsx"), "b/INPUT.XLSX"),
    ],
)
def test_the_workbook_is_found_among_the_files(names, found, tmp_path):
    assert store(sent(*names), tmp_path) == tmp_path / found


def test_a_drawing_without_a_workbook_is_told_what_reads_it(tmp_path):
    with pytest.raises(InputError, match=r"roof\.dxf came without a workbook; drop both"):
        store(sent("roof.dxf"), tmp_path)


@pytest.mark.parametrize("method", [zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED, zipfile.ZIP_BZIP2])
def test_a_damaged_zip_is_refused_in_words_or_read(tmp_path, method):
    rng, whole = random.Random(1), io.BytesIO()
    with zipfile.ZipFile(whole, "w", method) as archive:
        for name in ("a.csv", "b/c.csv"):
            archive.writestr(name, rng.randbytes(200) * 2)
    for k in range(60):
        data = bytearray(whole.getvalue())
        for _ in range(3):
            data[-rng.randrange(1, 180)] = rng.choice((0, 255, rng.randrange(256)))
        path = tmp_path / "z.zip"
        path.write_bytes(data)
        # Any other error is one of the program.
        with suppress(InputError):
            unpack(path, tmp_path / str(k))
