"""Hostile inputs by seed: each is read, or refused with an input error; anything else is a defect.

Kinds of case: records, parts of a workbook, one cell, several cells of a workbook that is then
checked whole, arguments of a run. Read `trouble` first.
"""

import datetime as dt
import io
import math
import random
import time
import warnings
import zipfile
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from places import SAMPLES
from report.cli.check import checked
from report.project.read.cells import LARGEST, Found, read_cell
from report.project.read.parts import changed
from report.project.read.positions import CellPosition
from report.project.read.read import read
from report.project.workbook import SECTIONS
from sheets import make
from solver import InputError, slide
from solver.formats import read_motion_file

LIMIT_S = 10.0
"""Of processor time: other processes may be at work."""
LONGEST = 2500
"""Characters of a problem."""

PIECES = [
    b"-", b"*", b"9", b"e", b" ", b".", b"\n", b",", b"nan", b"9e99", b"9" * 400, b"#", b"\0",
    b"\xff\xfe", b"\xe2\x80\xae", b"\xe2\x80\xa8", b"1e308", b"-1", b"0", b"\r\n", b"\t", b"'",
    b"\r", b";", b"time", b"acc (g)", b"Unit: g\n", b"dt 0.01\n", b"NPTS= 3\n", b"x y z\n",
]  # fmt: skip
XML = [
    b"<", b">", b'"', b"&", b"&#0;", b"]]>", b"<!DOCTYPE a>", b"XFD1048576", b"A1:XFD1048576",
    b"9" * 300, b"1e308", b"NaN", b"/", b"../", b"#REF!", b"t=\"s\"", b"t=\"e\"", b"-1",
    b"<c/>", b'<c r="A1" t="s">', b'<row r="-1"/>', b"</row>", b"<v>e</v>", b"<is><t>a</t></is>",
    b'<f t="shared" ref="A1:XFD1048576" si="0"/>', b'<mergeCell ref="A1:XFE9"/>', b"<sheet/>",
    b'<Relationship Id="" Target="-1"/>', b'<x spans="A1" name="">',
]  # fmt: skip
VALUES = [
    math.nan, math.inf, -math.inf, 0.0, -0.0, 5e-324, 1e-300, 1e300, 1.7e308, -1.0, 1.5707963267,
    10**400, True, None, "0.5", b"1", [1.0], {}, np.datetime64("2026-01-01"), np.float32(0.3), 1j,
    0.5, 0.01, 9.81, 1,
]  # fmt: skip

TEXTS = [
    "", " ", "-", "A1", "A2", "A1, A2", "0.5", "1e308", "1e-320", "-0", "1,234.5", "1.234,5", "١",
    "½", "1;2", "1:2", "yes", "TRUE", "=1/0", "=A1", "#REF!", "nan", "inf", "g", "1 in", "12 mm",
    "ft²", "../../x.csv", "/etc/passwd", "records/x.csv", "records/x.csv | 2", "records", "\0",
    "C:\\x.csv", "a\nb", "\u202eabc", "\u2028", "屋上", "x" * 400, "9" * 400, "é\u0301", "<b>",
    "&amp;", "2026-02-30", "31/12/2026", "X, Y", "0.2, 0.3, 0.4", "rule set", "SEAOC PV1-2012",
    "ASCE 7-16", "S7", "(0,0) (1,1)", "28'-6\"", "4'", "1/2:12", "Nov 20, 2026", "3/5/2026", "0,5",
    "0.45 (wet)", "fixed", "2", "1/0:12", "1/0\"", "\u0410\u0031",
]  # fmt: skip
"""Texts of cells; what no cell of a file can hold is replaced where it is written."""
NUMBERS = [
    0, 1, -1, 2, 0.5, 1e-9, -1e-9, 5e-324, 89.9, 90, 360, 1e6, -1e6, LARGEST, 1e15 + 2, 1e300,
    -1.7e308, 10**30, 10**400, 44927, 2958466, -0.0,
]  # fmt: skip
ODD = [
    True, False, dt.datetime(2026, 3, 5), dt.datetime(1, 1, 1, 12, 30), dt.date(9999, 12, 31),
    dt.time(1, 2), dt.timedelta(days=400), math.nan, math.inf,
]  # fmt: skip
"""What openpyxl returns for cells of other kinds."""


def trouble(kind, seed):
    """Run one case; return "" or what is wrong with how it ended."""
    rng, started = random.Random(f"{kind} {seed}"), time.process_time()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            ended = _CASES[kind](rng)
    except InputError as error:
        longest = max(map(len, error.problems), default=0)
        ended = "" if 0 < longest <= LONGEST else f"a problem of {longest} characters"
    except Exception as error:
        ended = f"{type(error).__name__}: {str(error)[:200]}"
    seconds = time.process_time() - started
    return ended or (f"took {seconds:.1f} s" if seconds > LIMIT_S else "")


def _mutated(content, rng, pieces, most=4):
    content = bytearray(content)
    for _ in range(rng.randint(1, most)):
        at, taken = rng.randint(0, len(content)), rng.choice((0, 0, 1, 3, 12, 80))
        piece = rng.choice(pieces) if rng.random() < 0.8 else rng.randbytes(rng.randint(0, 4))
        content[at : at + taken] = piece
    if rng.random() < 0.2:
        del content[rng.randint(0, len(content)) :]
    return bytes(content)


@cache
def _samples():
    return tuple(sorted(path for path in SAMPLES.iterdir() if path.suffix != ".md"))


@cache
def _folder():
    return TemporaryDirectory()


def _record(rng):
    sample = rng.choice(_samples())
    path = Path(_folder().name) / sample.name
    path.write_bytes(_mutated(sample.read_bytes(), rng, PIECES))
    how = {"units": "gal", "dt_s": 0.005} if rng.random() < 0.5 else {}
    try:
        channels = read_motion_file(path, **how).channels
    except InputError as error:
        if all(path.name in problem or "more" in problem for problem in error.problems):
            raise
        return f"problems do not name the file: {error.problems}"
    for record in channels:
        a = record.a_mps2
        if len(a) < 2 or not np.isfinite(a).all() or not 0.0 < record.dt_s < math.inf:
            return "a record that is none was read"
    return ""


@cache
def _sample_book():
    with TemporaryDirectory() as folder:
        return make(Path(folder)).read_bytes()


def _part(rng):
    """Change one part of a workbook, or its bytes."""
    path = Path(_folder().name) / "input.xlsx"
    if rng.random() < 0.2:
        path.write_bytes(_mutated(_sample_book(), rng, XML))
    else:
        path.write_bytes(_rezipped(rng))
    read(path)
    return ""


def _rezipped(rng):
    whole = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(_sample_book())) as old, zipfile.ZipFile(whole, "w") as new:
        names = old.namelist()
        changed, way = rng.choice(names), rng.random()
        for name in names:
            content = old.read(name)
            if name == changed:
                if way < 0.1:
                    continue
                content = _mutated(content, rng, XML)
            new.writestr(rng.choice(names) if name == changed and way > 0.95 else name, content)
    return whole.getvalue()


def _argument(rng):
    rows = [[0.0, 3.0, -3.0, 0.0], np.array([0.0, 1e200, 0.0]), [rng.choice(VALUES)] * 3, [], 5]
    values = rng.choice(rows[:1] * 5 + rows)
    dt_s, slope, mu, scale = (
        rng.choice(VALUES) if rng.random() < 0.4 else usual for usual in (0.01, 0.03, 0.4, 1.0)
    )
    result = slide(values, dt_s, slope_rad=slope, mu=mu, scale=scale)
    if math.isnan(result.prd_m) and not result.status:
        return "NaN without a status"
    return ""


@cache
def _fields():
    return tuple((section, entry) for section in SECTIONS for entry in section.entries)


def _value(rng):
    """Return a text or a number for a cell."""
    way = rng.random()
    if way < 0.5:
        return rng.choice(TEXTS)
    if way < 0.9:
        return rng.choice(NUMBERS)
    return rng.choice(TEXTS) + rng.choice(TEXTS)


def _cell(rng):
    """Read one hostile value as a random field."""
    section, entry = rng.choice(_fields())
    value = rng.choice(ODD) if rng.random() < 0.3 else _value(rng)
    found = Found(
        sheet=section.sheet,
        cell="B5",
        value=value,
        formula=rng.choice(TEXTS) if rng.random() < 0.2 else "",
        is_error=rng.random() < 0.05,
        number_format=rng.choice(("General", "0 %", '0.0 "in"', "\\", "[$-409]d", "")),
    )
    if found.is_blank:
        return ""  # is not read
    read_value = read_cell(found, entry, "in", rng.choice((1.0, 0.0254, 4448.2)))
    if isinstance(read_value, float) and not abs(read_value) <= LARGEST:
        return "a number beyond any project was read"
    return ""


@cache
def _inputs():
    """A workbook with its records, and the cells of its inputs."""
    folder = Path(_folder().name) / "book"
    path = make(folder)
    cells = [address.rpartition("!") for address in read(path).addresses.values()]
    from openpyxl.utils import coordinate_to_tuple  # `report` is loaded before it

    at = [(sheet, *coordinate_to_tuple(cell)) for sheet, _, cell in cells]
    return path, path.read_bytes(), tuple(CellPosition(*place) for place in at)


def _book_of_cells(rng):
    """Change some cells of a workbook, and check it whole."""
    path, content, cells = _inputs()
    few = rng.sample(cells, rng.randint(1, 3))
    path.write_bytes(changed(content, {cell: _value(rng) for cell in few}))
    checked(path)
    return ""


_CASES = {
    "record": _record,
    "cell": _cell,
    "argument": _argument,
    "part": _part,
    "book": _book_of_cells,
}
