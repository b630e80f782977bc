"""Hostile inputs by seed: each is read, or refused with an input error; anything else is a defect.

Kinds of case: records, parts of a workbook, cells, arguments. Read `trouble` first.
"""

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

from places import DATA
from report.sheet.read import read
from sheets import make
from solver import InputError, slide
from solver.formats import read_motion_file

SAMPLES = DATA / "motions"
LIMIT_S = 10.0
LONGEST = 2500
"""Characters of a problem."""

PIECES = [
    b"-", b"*", b"9", b"e", b" ", b".", b"\n", b",", b"nan", b"9e99", b"9" * 400, b"#", b"\0",
    b"\xff\xfe", b"\xe2\x80\xae", b"\xe2\x80\xa8", b"1e308", b"-1", b"0", b"\r\n", b"\t", b"'",
]  # fmt: skip
XML = [
    b"<", b">", b'"', b"&", b"&#0;", b"]]>", b"<!DOCTYPE a>", b"XFD1048576", b"A1:XFD1048576",
    b"9" * 300, b"1e308", b"NaN", b"/", b"../", b"#REF!", b"t=\"s\"", b"t=\"e\"", b"-1",
]  # fmt: skip
VALUES = [
    math.nan, math.inf, -math.inf, 0.0, -0.0, 5e-324, 1e-300, 1e300, 1.7e308, -1.0, 1.5707963267,
    10**400, True, None, "0.5", b"1", [1.0], {}, np.datetime64("2026-01-01"), np.float32(0.3), 1j,
    0.5, 0.01, 9.81, 1,
]  # fmt: skip

KINDS = ("record", "part", "argument")


def trouble(kind, seed):
    """Run one case; return "" or what is wrong with how it ended."""
    rng, started = random.Random(f"{kind} {seed}"), time.monotonic()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            ended = {"record": _record, "part": _part, "argument": _argument}[kind](rng)
    except InputError as error:
        longest = max(map(len, error.problems), default=0)
        ended = "" if 0 < longest <= LONGEST else f"a problem of {longest} characters"
    except Exception as error:
        ended = f"{type(error).__name__}: {str(error)[:200]}"
    seconds = time.monotonic() - started
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
    for record in read_motion_file(path, **how).channels:
        a = record.a_mps2
        if len(a) < 2 or not np.isfinite(a).all() or not 0.0 < record.dt_s < math.inf:
            return "a record that is none was read"
    return ""


@cache
def _book():
    with TemporaryDirectory() as folder:
        return make(Path(folder)).read_bytes()


def _part(rng):
    """Change one part of a workbook, or its bytes."""
    path = Path(_folder().name) / "input.xlsx"
    if rng.random() < 0.2:
        path.write_bytes(_mutated(_book(), rng, XML))
    else:
        path.write_bytes(_rezipped(rng))
    read(path)
    return ""


def _rezipped(rng):
    whole = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(_book())) as old, zipfile.ZipFile(whole, "w") as new:
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
