"""The hazard curve of the site of a study: typed, of two columns, or of the USGS hazard tool.

    PGA [g], annual rate
    0.1,     2.0E-2
    0.5,     1.1E-3

`solver.studies.rates` computes the rates. Read `hazard_curves`.
"""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from report.project.model.finding import Finding
from report.project.model.input_rows import Place
from report.project.read.documents import path_beside
from report.project.read.typed_text import separator
from report.study.read_study import StudySheet
from report.study.study_input import Intensity
from report.text.counts import numbered
from solver.bounds import ANNUAL_RATE, INTENSITY
from solver.errors import InputError, raise_any
from solver.formats.remarks import is_of_another, is_other_damping
from solver.formats.source import open_source
from solver.model import Floats
from solver.studies.rates import HazardCurve

MAX_BYTES = 1_000_000

# By which a file of several curves names PGA and Sa(1 s).
_NAMES: Mapping[bool, re.Pattern[str]] = {
    False: re.compile(r"\bPGA\b|peak ground", re.IGNORECASE),
    True: re.compile(r"\bSA1P0\b|\b1(\.0{1,4})?[ -]?s(ec|econd)?\b", re.IGNORECASE),
}

# What the headings of the two columns may say: another word is of another quantity or unit.
_OF_ANY = "im iml imls imt intensity measure level levels ground motion acceleration g"
_OF_INTENSITY = {
    False: f"{_OF_ANY} pga peak horizontal",
    True: (
        f"{_OF_ANY} sa psa sa1 sa1.0 sa1p0 t=1s t=1.0s spectral response 1 1.0 1.00 s sec second 1s"
        " 5% damped"
    ),
}
_OF_RATE = (
    "annual mean rate rates frequency of exceedance exceedence exceeding lambda λ per yr"
    " year 1/yr 1/year 1/a yr^-1 year^-1 yr-1 afoe aef mafe maf"
)
_WORD = re.compile(r"[^\s_\[\](),;:]+")
# In a line of text above them.
_OF_OTHERS = re.compile(
    r"\bPG[VD]\b|\bprobabilit|\breturn period|\bpoe\b|\d[ -]?(?:yrs?|years?)\b|\bvertical\b|\bPFA\b"
    r"|\bP?SA[ _(@=T]*(?!1(?:\.0+)?(?![\d.]))\.?\d"
    # After a latitude, S is south.
    r"|(?<![\d.])(?!1(?:\.0+)?[ -]?s)(?:\d++(?:\.\d++)?+|\.\d++)[ -]?(?-i:s)(?:ec|econds?)?\b",
    re.IGNORECASE,
)
_SPECTRAL = re.compile(r"\bspectral\b|\bP?SA\b", re.IGNORECASE)
_MEASURE = {False: "PGA [g]", True: "Sa(1 s) [g]"}
_RATE = "annual rate [1/year] (1 / T of a return period T, -ln(1 - p) / n of p in n years)"

_TWO = (
    "enter intensity and annual rate in two columns with a comma between them, or the CSV of the"
    " USGS hazard tool"
)


def hazard_curves(sheet: StudySheet) -> tuple[HazardCurve, ...]:
    """Return the curve for the intensity of the motions; empty if none is given.

    Raises `InputError` at the cell of the file, or at the row of the table.
    """
    study_input, hazard = sheet.project, sheet.project.hazard
    if not (hazard.file or study_input.hazard_points):
        return ()
    place = Place("hazard_points")
    points = [(point.intensity, point.annual_rate) for point in study_input.hazard_points]
    try:
        if hazard.file:
            place = Place("hazard", 0, "file")
            path = path_beside(sheet.path.parent, hazard.file, MAX_BYTES, "hazard-pga.csv")
            # As the records: Excel may save a CSV as UTF-16.
            lines = open_source(path, units="", dt_s=math.nan).lines
            points = points_of(lines, is_spectral=study_input.study.intensity is Intensity.SA1)
        x, rate = _checked(points)
    except InputError as error:
        sheet.refuse([Finding.error(place, p.found, p.remedy) for p in error.parts])
        raise
    beta = study_input.study.record_beta or 0.0
    return (HazardCurve(intensity=hazard.factor * x, rate=rate, beta=beta),)


def points_of(lines: Sequence[str], *, is_spectral: bool) -> list[tuple[float, float]]:
    """Return the points of the lines of a file, intensity and annual rate.

    Raises `InputError` if it has neither, or no single curve of the measure.
    """
    mark = separator(lines)
    # Semicolons go with decimal commas, before an exponent too: 1,2E-5.
    point = "." if mark == ";" else ","
    read = [
        [cell.strip().replace(",", point) for cell in row]
        for row in csv.reader(lines, delimiter=mark)
    ]
    # A spreadsheet pads the shorter rows with blanks.
    rows = [row[: max(k for k, cell in enumerate(row) if cell) + 1] for row in read if any(row)]
    curves = list(_saved_curves(rows))
    if curves:
        names = [", ".join(name) for name, _, _ in curves]
        fits = [k for k, name in enumerate(names) if _NAMES[is_spectral].search(name)]
        # A file of the tool has a curve for each measure and, where it was asked for, for each
        # source: which one is meant is not guessed.
        if len(fits) != 1:
            measure = _MEASURE[is_spectral]
            raise InputError(f"has {len(fits)} curves of {measure} ({'; '.join(names)}); keep one")
        _, x, y = curves[fits[0]]
        raise_any(_wrong_headings([x[0], y[0]], is_spectral))
        return list(zip(_numbers(x[1:]), _numbers(y[1:]), strict=True))
    columns = [_numbers(row) for row in rows]
    first = next((k for k, values in enumerate(columns) if values), len(rows))
    # What is above the first row of numbers are headings; below it nothing else may be.
    wrong = [k for k, values in enumerate(columns) if k >= first and len(values) != 2]
    if wrong or first == len(rows):
        text = mark.join(rows[wrong[0]] if wrong else lines)[:60].strip()
        raise InputError(f"has '{text}'; {_TWO}")
    problems: list[str] = []
    for row in rows[:first]:
        problems += _wrong_headings(row, is_spectral)
    raise_any(problems)
    pairs = np.array(columns[first:])
    # Rates become much smaller than intensities, so that columns in the other order are noticed.
    is_curve = np.diff(pairs[:, 0]).min(initial=1.0) > 0.0 > np.diff(pairs[:, 1]).max(initial=-1.0)
    if not first and is_curve and pairs[:, 0].min() < pairs[:, 1].min():
        raise InputError(
            f"has no heading, and {pairs[:, 0].min():g} in the first column, less than any number"
            f" in the second; enter the heading {_MEASURE[is_spectral]},annual rate, and the"
            " columns in this order"
        )
    return [(values[0], values[1]) for values in columns[first:]]


def _wrong_headings(row: Sequence[str], is_spectral: bool) -> Iterator[str]:
    """Yield the headings of a row, or its text, that say another quantity or unit."""
    measure = _MEASURE[is_spectral]
    if len(row) != 2 or row[0].startswith("#"):
        text = ", ".join(row)
        named = [name for name, pattern in _NAMES.items() if pattern.search(text)]
        # A curve of probabilities in 50 years that is taken for one of annual rates is 50 times
        # too high.
        is_spectral_alone = not is_spectral and bool(_SPECTRAL.search(text))
        is_other = named == [not is_spectral] or is_spectral_alone
        if is_other or is_of_another(text) or is_other_damping(text) or _OF_OTHERS.search(text):
            yield f"has the heading '{text[:60]}'; enter {measure} and {_RATE}, or delete it"
        return
    for heading, known, accepted in zip(
        row, (_OF_INTENSITY[is_spectral], _OF_RATE), (measure, _RATE), strict=True
    ):
        if not set(known.split()).issuperset(_WORD.findall(heading.casefold())):
            yield f"has the heading '{heading[:60]}'; enter {accepted}"


def _saved_curves(rows: Sequence[list[str]]) -> Iterator[Sequence[list[str]]]:
    """Yield the three lines of each curve of the USGS hazard tool."""
    # It saves for each curve a line with its name, one that begins with a label and has the
    # intensities, and one with the rates (`D3SaveLineData` of nshmp-haz-ws).
    for k in range(1, len(rows) - 1):
        x, y = _numbers(rows[k][1:]), _numbers(rows[k + 1][1:])
        if len(x) > 1 and len(x) == len(y) and not (_numbers(rows[k][:1]) or _numbers(rows[k - 1])):
            yield rows[k - 1 : k + 2]


def _numbers(cells: Sequence[str]) -> list[float]:
    """Return the numbers of cells; empty unless all are."""
    try:
        return [float(cell) for cell in cells]
    except ValueError:
        return []


def _checked(points: Sequence[tuple[float, float]]) -> tuple[Floats, Floats]:
    """Return intensities and rates, without the points of rate 0 at the end."""
    x, rate = np.array(points, dtype=float).reshape(-1, 2).T
    known = int(np.count_nonzero(rate))
    if known < 2:
        raise InputError(
            f"the curve has {numbered(known, 'point')} with a rate above 0; enter two or more"
        )
    fits = np.array([INTENSITY.has(value) for value in x])
    fits[:known] &= [ANNUAL_RATE.has(value) for value in rate[:known]]
    # Interpolated in logarithms, and the rates of displacements follow from its slope: both need
    # one direction.
    fits[1:] &= np.diff(x) > 0.0
    fits[1:known] &= np.diff(rate[:known]) < 0.0
    if not fits.all():
        index = int(np.flatnonzero(~fits)[0])
        raise InputError(
            f"point {index + 1} of the curve is {x[index]:g} at {rate[index]:g} a year; enter"
            f" intensities that increase, {INTENSITY.words}, and rates that decrease,"
            f" {ANNUAL_RATE.words} but for the last ones, which may be 0"
        )
    return x[:known], rate[:known]
