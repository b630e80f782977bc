"""What the refusal of a hazard curve, a target spectrum or a ballast map says would do, does.

Oracle: the numbers that made each file.
"""

import io
import math
import re
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
import pytest
from openpyxl import Workbook

from fixtures.errors import input_problems
from fixtures.marks import by_day
from fixtures.project_parts import FT
from report.drawing_read.ballast import read_map
from report.study.hazard_curve import points_of
from report.suite.target_table import read_target
from solver.formats.source import open_source

CURVE = ((0.01, 0.2), (0.1, 0.05), (0.3, 0.006), (1.0, 1e-4))
SPECTRUM = ((0.03, 0.8), (0.1, 1.6), (0.5, 1.6), (1.0, 0.8), (4.0, 0.2))  # period [s], g
BLOCKS = ((35.0, 155.0, 2), (60.0, 200.0, 3), (210.0, 50.0, 4))  # x, y [ft] and their number


def of_curve(path, *, is_spectral=False):
    lines = open_source(path, units="", dt_s=math.nan).lines
    return points_of(lines, is_spectral=is_spectral)


def of_target(path, sheet=""):
    target = read_target(f"{path}{sheet}")
    return sorted(zip(1.0 / target.freq_hz, target.horizontal_g, strict=True))


def of_map(path, *, unit_m=FT):
    return read_map(path, unit_m)[:, 1:] / (FT, FT, 1.0)


TRUTHS: Mapping[Callable[..., Any], Any] = {of_curve: CURVE, of_target: SPECTRUM, of_map: BLOCKS}


@dataclass(frozen=True)
class Kind:
    """A file that is refused, what its message advises, and the file and options by that."""

    read: Callable[..., Any]
    content: str | bytes
    advice: str  # a pattern
    followed: str | bytes = ""  # the file as advised; the same where options are
    given: Mapping[str, Any] = field(default_factory=dict)
    then: Mapping[str, Any] = field(default_factory=dict)
    name: str = "table.csv"


def table(heading, rows, mark=","):
    return "".join(f"{row}\n" for row in (heading, *(mark.join(map(repr, row)) for row in rows)))


def scaled(rows, *factors):
    return [tuple(a * f for a, f in zip(row, factors, strict=True)) for row in rows]


def with_column(rows, value):
    return [(*row, value) for row in rows]


def saved(names):
    """Curves as the USGS hazard tool saves them."""
    x, rate = (",".join(map(repr, column)) for column in zip(*CURVE, strict=True))
    text = "IMT,{}\nGround Motion (g)," + x + "\nAnnual Frequency of Exceedence," + rate + "\n"
    return "\n".join(text.format(name) for name in names)


def zipped(text):
    with zipfile.ZipFile(out := io.BytesIO(), "w") as file:
        file.writestr("table.csv", text)
    return out.getvalue()


def of_two_sheets():
    book = Workbook()
    for row in (("period [s]", "horizontal [g]"), *SPECTRUM):
        book.active.append(row)
    book.create_sheet("Notes")
    book.save(out := io.BytesIO())
    return out.getvalue()


RATES = table("PGA [g],annual rate", CURVE)
PERIODS = table("period [s],horizontal [g]", SPECTRUM)
MAP = table("x,y,blocks", BLOCKS)
curve, target, ballast = (partial(Kind, read) for read in TRUTHS)

KINDS = {
    "PGA in cm/s2": curve(
        table("PGA [cm/s2],annual rate", scaled(CURVE, 980.665, 1.0)), r"enter PGA \[g\]", RATES
    ),
    "PGA in percent": curve(
        table("PGA [%g],annual rate", scaled(CURVE, 100.0, 1.0)), r"enter PGA \[g\]", RATES
    ),
    "probabilities in 50 years": curve(
        table("PGA [g],probability of exceedance in 50 years",
              [(x, 1.0 - math.exp(-50.0 * rate)) for x, rate in CURVE]),
        r"-ln\(1 - p\) / n of p in n years",
        table("PGA [g],annual rate",
              [(x, -math.log(1.0 - (1.0 - math.exp(-50.0 * rate))) / 50.0) for x, rate in CURVE]),
    ),
    "return periods": curve(
        table("PGA [g],return period [years]", [(x, 1.0 / rate) for x, rate in CURVE]),
        r"\(1 / T of a return period T,",
        table("PGA [g],annual rate", [(x, 1.0 / (1.0 / rate)) for x, rate in CURVE]),
    ),
    "a curve of Sa": curve(
        table("Sa(1 s) [g],annual rate", CURVE), r"enter PGA \[g\]", then={"is_spectral": True}
    ),
    "two curves of PGA": curve(saved(("PGA", "PGA, no basin")), "keep one", saved(("PGA",))),
    "no curve of PGA": curve(
        saved(("0.2 Second Spectral Acceleration",)), "keep one",
        saved(("0.2 Second Spectral Acceleration", "PGA")),
    ),
    "three columns": curve(
        table("PGA [g],annual rate,fractile", with_column(CURVE, 0.5)),
        "enter intensity and annual rate in two columns", RATES,
    ),
    "a line on probabilities": curve(
        "# 2% probability in 50 years is 0.3 g\n" + RATES, "or delete it", RATES
    ),
    "periods in ms": target(
        table("period [ms],horizontal [g]", scaled(SPECTRUM, 1000.0, 1.0)), r"enter period \[s\]",
        PERIODS,
    ),
    "a spectrum in cm/s2": target(
        table("period [s],horizontal [cm/s2]", scaled(SPECTRUM, 1.0, 980.665)),
        r"enter horizontal \[g\]", PERIODS,
    ),
    "frequency and period": target(
        table("frequency [Hz],period [s],horizontal [g]", [(1.0 / t, t, a) for t, a in SPECTRUM]),
        "delete one of them",
        table("frequency [Hz],horizontal [g]", [(1.0 / t, a) for t, a in SPECTRUM]),
    ),
    "two horizontals": target(
        table("period [s],horizontal [g],horizontal [g]", with_column(SPECTRUM, 0.5)),
        "delete one", PERIODS,
    ),
    "a line of another unit": target(
        "values in cm/s2\n" + PERIODS, "delete the line if it is not part of the table",
        PERIODS,
    ),
    "no headings": target(
        table("made by hand", SPECTRUM), r"enter frequency \[Hz\] or period \[s\], horizontal",
        PERIODS,
    ),
    "a period twice": target(PERIODS + "1.0,0.8\n", "enter each frequency once", PERIODS),
    "a blank cell": target(PERIODS.replace("0.5,1.6", "0.5,"), "enter a number greater than 0",
                           PERIODS),
    "a short spectrum": target(
        table("period [s],horizontal [g]", SPECTRUM[:-1]), r"\(periods from 0\.03 to 3\.33 s\)",
        PERIODS,
    ),
    "a curve as a PDF": curve(b"%PDF-1.7\n\0\1", "a PDF; export its numbers as text or CSV", RATES),
    "a spectrum in a zip": target(zipped(PERIODS), "unpack it", PERIODS),
    "a workbook of two sheets": target(
        of_two_sheets(), r"enter table\.xlsx!Sheet, one of 'Sheet'", then={"sheet": "!Sheet"},
        name="table.xlsx",
    ),
    "a sheet that is not there": target(
        of_two_sheets(), "enter one of 'Sheet'", given={"sheet": "!Shet"},
        then={"sheet": "!Sheet"}, name="table.xlsx",
    ),
    "a map of easting and northing": ballast(
        table("E,N,blocks", BLOCKS), "enter x, y and blocks", MAP
    ),
    "a map in feet with --units m": ballast(
        table("x [ft],y [ft],blocks", BLOCKS), "another unit; enter the unit of x and y",
        given={"unit_m": 1.0},
    ),
    "half a block": ballast(MAP + "1.0,1.0,0.5\n", "enter a whole number from 0 to", MAP),
    "a place that is no number": ballast(MAP + "?,1.0,0\n", "enter a number", MAP),
    "a map in an old code page": ballast(
        ("# entwässert\n" + MAP).encode("latin-1"), "save it as one", MAP.encode("utf-16")
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", by_day(KINDS, 8))
def test_what_the_refusal_of_a_table_says_would_do_does(file, name):
    kind = KINDS[name]
    said = "\n".join(
        map(str, input_problems(kind.read, file(kind.content, kind.name), **kind.given))
    )
    assert re.search(kind.advice, said), said
    found = kind.read(file(kind.followed or kind.content, kind.name), **kind.then)
    assert np.array(found) == pytest.approx(np.array(TRUTHS[kind.read]), rel=1e-9)
