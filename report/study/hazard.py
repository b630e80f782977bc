"""The hazard curve of a study: typed, or from a file of two columns or of the USGS hazard tool.

Computes no rates (`solver.studies.rates` does). Read `hazard_curves`.
"""

from __future__ import annotations

import codecs
import csv
import re
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from report.sheet.reading.linked_files import path_beside
from report.sheet.reading.typed_text import separator
from report.sheet.schema.fields import Finding, Place
from report.study.read import StudySheet
from report.study.schema import Intensity
from report.text.counts import numbered
from solver.model import Floats, InputError
from solver.studies.rates import HazardCurve

MAX_BYTES = 1_000_000

MOST_RATE = 10.0
"""Most events a year: a greater number is no annual rate, and lives of as many fill the memory."""

_NAMES: Mapping[bool, re.Pattern[str]] = {
    False: re.compile(r"\bPGA\b|peak ground", re.IGNORECASE),
    True: re.compile(r"\bSA1P0\b|\b1(\.0{1,4})?[ -]?s(ec|econd)?\b", re.IGNORECASE),
}
"""By which a file of several curves names PGA and Sa(1 s)."""

_TWO = "give intensity and annual rate in two columns, or the CSV of the USGS hazard tool"


def hazard_curves(sheet: StudySheet) -> tuple[HazardCurve, ...]:
    """Return the curve for the intensity of the motions; empty if none is given.

    Raises
    ------
    InputError
        At the cell of the file, or at the row of the table.
    """
    study_input, hazard = sheet.project, sheet.project.hazard
    if not (hazard.file or study_input.hazard_points):
        return ()
    place, points = (
        Place("hazard_points"),
        [(point.intensity, point.annual_rate) for point in study_input.hazard_points],
    )
    try:
        if hazard.file:
            place = Place("hazard", 0, "file")
            path = path_beside(sheet.path.parent, hazard.file, MAX_BYTES, "hazard-pga.csv")
            data = path.read_bytes()
            is_utf_16 = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
            text = data.decode("utf-16" if is_utf_16 else "utf-8-sig", errors="replace")
            points = points_of(text, is_spectral=study_input.study.intensity is Intensity.SA1)
        x, rate = _checked(points)
    except InputError as error:
        sheet.refuse([Finding.error(place, p.found, p.remedy) for p in error.parts])
        raise
    return (
        HazardCurve(
            intensity=hazard.factor * x, rate=rate, beta=study_input.study.record_beta or 0.0
        ),
    )


def points_of(text: str, *, is_spectral: bool) -> list[tuple[float, float]]:
    """Return the points of a file, intensity and annual rate.

    The USGS hazard tool saves for each curve a line with its name, one that begins with a label and
    has the intensities, and one with the rates (`D3SaveLineData` of nshmp-haz-ws).

    Raises
    ------
    InputError
        If it has neither, or no single curve of the measure.
    """
    lines = text.splitlines()
    mark = separator(lines)
    read = [[cell.strip() for cell in row] for row in csv.reader(lines, delimiter=mark)]
    if mark == ";":
        read = [[cell.replace(",", ".") for cell in row] for row in read]
    # A spreadsheet pads the shorter rows with blanks.
    rows = [row[: max(k for k, cell in enumerate(row) if cell) + 1] for row in read if any(row)]
    if curves := list(_saved_curves(rows)):
        names = [name for name, _ in curves]
        fits = [points for name, points in curves if _NAMES[is_spectral].search(name)]
        if len(fits) != 1:
            wanted = "Sa(1 s)" if is_spectral else "PGA"
            raise InputError(f"has {len(fits)} curves of {wanted} ({'; '.join(names)}); keep one")
        return fits[0]
    columns = [_numbers(row) for row in rows]
    first = next((k for k, values in enumerate(columns) if values), len(rows))
    wrong = [k for k, values in enumerate(columns) if k >= first and len(values) != 2]
    if wrong or first == len(rows):
        shown = mark.join(rows[wrong[0]])[:60] if wrong else text[:60].strip()
        raise InputError(f"has '{shown}'; {_TWO}")
    return [(values[0], values[1]) for values in columns[first:]]


def _saved_curves(rows: Sequence[Sequence[str]]) -> Iterator[tuple[str, list[tuple[float, float]]]]:
    """Yield name and points of each curve of the USGS hazard tool."""
    for k in range(1, len(rows) - 1):
        x, y = _numbers(rows[k][1:]), _numbers(rows[k + 1][1:])
        if len(x) > 1 and len(x) == len(y) and not (_numbers(rows[k][:1]) or _numbers(rows[k - 1])):
            yield ", ".join(rows[k - 1]), list(zip(x, y, strict=True))


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
            f"the curve has {numbered(known, 'point')} with a rate above 0; give two or more"
        )
    fits = (x > 0.0) & np.isfinite(x) & (rate <= MOST_RATE)
    fits[1:] &= np.diff(x) > 0.0
    fits[1:known] &= np.diff(rate[:known]) < 0.0
    fits[:known] &= rate[:known] > 0.0
    if not fits.all():
        at = int(np.flatnonzero(~fits)[0])
        raise InputError(
            f"point {at + 1} of the curve is {x[at]:g} at {rate[at]:g} a year; give intensities"
            f" that increase, and rates of at most {MOST_RATE:g} that decrease, above 0 but for the"
            " last ones"
        )
    return x[:known], rate[:known]
