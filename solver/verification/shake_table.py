"""Computed slip compared with shake-table tests, by an acceptance that is fixed beforehand.

Runs the model that a package would use. Read `compare`, then `ShakeTable.is_accepted`.

Shake-table tests from a folder: table accelerations, friction, and the slip that was measured.
"""

from __future__ import annotations

import csv
import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path

import numpy as np

from solver.files import read_file
from solver.formats import read_record
from solver.model import Floats, InputError, Scene, Status, coulomb
from solver.records.record import Record, shown
from solver.sliding.checked import scene, solve
from solver.sliding.least_model import Model

NAME = "tests.csv"
"""File of a folder of tests, one row for each test."""

MOST_BYTES, MOST_TESTS, MOST_LETTERS = 1_000_000, 1000, 200
MOST_SLIP_M = 100.0
BAR = "|"
"""Separates a file from its channel, as in the workbook."""

_PRD, _RESIDUAL = "PRD", "Residual"
_SLOPE, _FRICTION, _STATIC = "Slope [deg]", "Friction", "Static friction"
_KEYS = ("Test", "Data", "Source", "x", "y", "z", _SLOPE, _FRICTION, _STATIC)
_LENGTHS = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254}
_HEADINGS = {key: (key, 1.0) for key in _KEYS} | {
    f"{key}{gap}[{unit}]": (key, factor)
    for key in (_PRD, _RESIDUAL)
    for unit, factor in _LENGTHS.items()
    for gap in (" ", "")
}
"""Key and unit of each accepted heading."""

_RANGES = {
    _SLOPE: (-30.0, 30.0),
    _FRICTION: (0.0, 2.0),
    _STATIC: (0.0, 2.0),
    _PRD: (0.0, MOST_SLIP_M),
    _RESIDUAL: (0.0, MOST_SLIP_M),
}
_REQUIRED = ("Test", "Data", "Source", "x", _SLOPE, _FRICTION, _PRD)


class Data(StrEnum):
    """Where the slip of a test comes from."""

    MEASURED = "measured"
    COMPUTED = "computed"


@dataclass(frozen=True, slots=True, kw_only=True)
class TableTest:
    """One run of a shake table."""

    name: str  # as in `NAME`, and so are the next two
    source: str
    data: Data
    scene: Scene  # accelerations of the table, slope and friction
    prd_m: float  # largest horizontal displacement relative to the table [m]
    residual_m: float  # magnitude of the final one [m]; NaN if it is not given


def table_tests(folder: Path) -> tuple[TableTest, ...]:
    """Read the tests of a folder.

    `NAME` has a row of headings and one row for each test, separated by commas: Test; Data
    (`measured`, or `computed` where nothing was measured); Source; x, y and z, the accelerations of
    the table as `file` or `file | channel`, x along the slope and positive downslope, z positive
    up, y and z optional; Slope [deg]; Friction, kinetic; Static friction, optional; PRD [mm] and
    Residual [mm], or with cm, m or in, the second optional. The records have any format of
    `solver.formats` and state their units.

    Raises
    ------
    InputError
        With every problem, as ``tests.csv, row 3, column PRD [mm]: found what; what is accepted``.
    """
    tests: list[TableTest] = []
    problems: list[str] = []
    for row in _rows(folder):
        try:
            tests.append(_test(folder, row))
        except InputError as error:
            problems += error.problems
    names = [test.name.casefold() for test in tests]
    problems += [
        f"{NAME}: two tests have the name {shown(test.name)}; give each its own"
        for at, test in enumerate(tests)
        if test.name.casefold() in names[:at]
    ]
    if problems:
        raise InputError(problems)
    return tuple(tests)


@dataclass(frozen=True, slots=True)
class _Row:
    """A row by its number in the file, its cells by key, and the headings of the keys."""

    number: int
    cells: Mapping[str, str]
    headings: Mapping[str, str]

    def at(self, key: str) -> str:
        return f"{NAME}, row {self.number}, column {self.headings.get(key, key)}"


def _rows(folder: Path) -> list[_Row]:
    """Return the rows of `NAME`: its headings are known, and every row has as many cells."""
    lines = _lines(folder / NAME)
    headings = [" ".join(cell.split()) for cell in lines[0][1]] if lines else []
    problems = list(_heading_problems(headings))
    if problems:
        raise InputError(problems)
    if len(lines) < 2:
        raise InputError(f"{NAME}: has no tests; give one row for each below the headings")
    problems = [
        f"{NAME}, row {number}: has {len(cells)} cells; the headings are {len(headings)}. A text"
        " with a comma needs quotation marks"
        for number, cells in lines[1:]
        if len(cells) != len(headings)
    ]
    if problems:
        raise InputError(problems)
    named = {_HEADINGS[heading][0]: heading for heading in headings}
    return [
        _Row(number, dict(zip(named, map(str.strip, cells), strict=True)), named)
        for number, cells in lines[1:]
    ]


def _lines(path: Path) -> list[tuple[int, list[str]]]:
    """Return the rows of a file that are not blank, with their numbers."""
    if not path.exists():
        raise InputError(f"{path}: no such file; give a folder with {NAME}")
    content = read_file(path, MOST_BYTES, str(path), too_large="give fewer tests")
    try:
        text = content.decode("utf-8-sig")
        rows = [
            (number, cells)
            for number, cells in enumerate(csv.reader(text.splitlines(), strict=True), start=1)
            if any(cell.strip() for cell in cells)
        ]
    except (UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{path}: not CSV UTF-8, separated by commas; save it so") from error
    if len(rows) > MOST_TESTS + 1:
        raise InputError(f"{path}: has more than {MOST_TESTS} tests")
    return rows


def _heading_problems(headings: list[str]) -> Iterator[str]:
    accepted = ", ".join([*_KEYS, f"{_PRD} [mm]", f"{_RESIDUAL} [mm]"])
    keys = [_HEADINGS[heading][0] if heading in _HEADINGS else "" for heading in headings]
    counts = Counter(keys)
    for heading, key in zip(headings, keys, strict=True):
        if not key:
            yield f"{NAME}, row 1: found the heading {shown(heading)}; accepted are {accepted}"
        elif counts[key] > 1:
            yield f"{NAME}, row 1: the heading {heading} is there twice"
    for key in _REQUIRED:
        if key not in keys:
            name = f"{_PRD} [mm]" if key == _PRD else key
            yield f"{NAME}, row 1: has no heading {name}; the headings are {accepted}"


def _test(folder: Path, row: _Row) -> TableTest:
    """Return the test of a row; raise InputError with all its problems."""
    problems: list[str] = []
    name, source = (_word(row, key, problems) for key in ("Test", "Source"))
    data = _data(row, problems)
    slope_deg, mu, static, prd_m, residual_m = (_number(row, key, problems) for key in _RANGES)
    records = dict(_records(folder, row, problems))
    problems += _unlike(row, records)
    if static < mu:
        problems.append(f"{row.at(_STATIC)}: found {static:g}, below the kinetic {mu:g}")
    if problems:
        raise InputError(problems)
    x, y, z = (records.get(key) for key in "xyz")
    assert x is not None  # required
    try:
        case = scene(
            x.a_mps2,
            x.dt_s,
            slope_rad=math.radians(slope_deg),
            mu=replace(coulomb(mu), mu_static=mu if math.isnan(static) else static),
            ay_mps2=y.a_mps2 if y else None,
            az_mps2=z.a_mps2 if z else None,
        )
    except InputError as error:
        raise InputError([f"{NAME}, row {row.number}: {text}" for text in error.problems]) from None
    return TableTest(
        name=name, source=source, data=data, scene=case, prd_m=prd_m, residual_m=residual_m
    )


def _word(row: _Row, key: str, problems: list[str]) -> str:
    text = row.cells[key]
    if not text:
        problems.append(f"{row.at(key)}: is empty; give {_EMPTY[key]}")
    elif not text.isprintable() or len(text) > MOST_LETTERS:
        problems.append(f"{row.at(key)}: give at most {MOST_LETTERS} printable characters")
    return text


_EMPTY = {"Test": "a name", "Source": "laboratory, report and date, or what computed the slip",
          "x": "the file of the table acceleration along the slope"}  # fmt: skip


def _data(row: _Row, problems: list[str]) -> Data:
    text = row.cells["Data"].casefold()
    if text not in list(Data):
        problems.append(
            f"{row.at('Data')}: found {shown(row.cells['Data'])}; give {' or '.join(Data)}"
        )
        return Data.COMPUTED
    return Data(text)


def _number(row: _Row, key: str, problems: list[str]) -> float:
    """Return a number within its range, a length in m; NaN if it is not given or wrong."""
    text = row.cells.get(key, "")
    if not text and key not in _REQUIRED:
        return math.nan
    unit = _HEADINGS[row.headings[key]][1]
    low, high = (limit / unit for limit in _RANGES[key])
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not low <= value <= high:
        typed = shown(text) if text else "nothing"
        problems.append(f"{row.at(key)}: found {typed}; give a number from {low:g} to {high:g}")
        return math.nan
    return unit * value


def _records(folder: Path, row: _Row, problems: list[str]) -> Iterator[tuple[str, Record]]:
    """Yield the components that a row names and that can be read."""
    for key in "xyz":
        name = row.cells.get(key, "")
        if not name and key == "x":
            _word(row, key, problems)
        if not name:
            continue
        file, _, channel = name.partition(BAR)
        path = folder / file.strip()
        try:
            if not path.resolve().is_relative_to(folder.resolve()):
                raise InputError(
                    f"{shown(file.strip())} lies outside of the folder; copy the record into it"
                )
            yield key, read_record(path, channel=channel.strip())
        except InputError as error:
            problems += [f"{row.at(key)}: {text}" for text in error.problems]


def _unlike(row: _Row, records: Mapping[str, Record]) -> Iterator[str]:
    """Yield the components that are not over the same times as x."""
    x = records.get("x")
    for key, record in records.items():
        if x and not math.isclose(record.dt_s, x.dt_s, rel_tol=1e-9):
            yield f"{row.at(key)}: its time step is {record.dt_s:g} s, that of x {x.dt_s:g} s"
        elif x and record.a_mps2.size != x.a_mps2.size:
            yield (
                f"{row.at(key)}: has {record.a_mps2.size} samples, x {x.a_mps2.size}; trim them to"
                " the same times"
            )


MEDIAN = (0.9, 1.1)
"""Accepted range of the median ratio of computed to measured PRD."""

RATIOS, SHARE = (0.75, 1.33), 0.8
"""Range in which at least this share of the ratios lies."""

LEAST_TESTS = 5
"""Ratios below which nothing is accepted: of fewer, no share but all of them is 80 %."""

LEAST_M = 1e-3
"""A test with less measured PRD has no ratio [m]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TableRun:
    """A test and what is computed for it."""

    test: TableTest
    model: Model  # the model that was used
    status: Status
    # magnitudes [m]; NaN without a result
    prd_m: float
    residual_m: float

    @property
    def has_ratio(self) -> bool:
        """Whether enough slip was measured for a ratio."""
        return self.test.prd_m >= LEAST_M

    @property
    def ratio(self) -> float:
        """Computed over measured PRD; NaN without a result or measured slip."""
        return self.prd_m / self.test.prd_m if self.has_ratio else math.nan


@dataclass(frozen=True, slots=True, kw_only=True)
class ShakeTable:
    """The runs of all tests, or of some of them."""

    runs: tuple[TableRun, ...]

    @property
    def ratios(self) -> Floats:
        """Ratios of the tests with measured slip; NaN where the run has no result."""
        return np.array([run.ratio for run in self.runs if run.has_ratio])

    @property
    def median(self) -> float:
        """Median ratio; NaN if there is none, or a run has no result."""
        return float(np.median(self.ratios)) if self.ratios.size else math.nan

    @property
    def share_within(self) -> float:
        """Share of the ratios in `RATIOS`; a run without a result is not within."""
        low, high = RATIOS
        within = (self.ratios >= low) & (self.ratios <= high)
        return float(within.mean()) if within.size else 0.0

    @property
    def is_accepted(self) -> bool:
        """Whether there are enough tests, and median and share are as required."""
        low, high = MEDIAN
        is_enough = self.ratios.size >= LEAST_TESTS
        return is_enough and low <= self.median <= high and self.share_within >= SHARE

    @property
    def is_measured(self) -> bool:
        """Whether every slip was measured."""
        return all(run.test.data is Data.MEASURED for run in self.runs)

    @property
    def validates(self) -> bool:
        """Whether the tests validate the solution: measured, and accepted."""
        return self.is_measured and self.is_accepted

    def of(self, belongs: Callable[[TableTest], bool]) -> ShakeTable:
        """Return the runs of some of the tests."""
        return ShakeTable(runs=tuple(run for run in self.runs if belongs(run.test)))


SHIPPED: tuple[ShakeTable, ...] = ()
"""Tests that come with the program, none as yet: the manual and every package state their status.
"""


def compare(tests: Sequence[TableTest]) -> ShakeTable:
    """Run every test with the simplest adequate model, in the polarity of the table."""
    return ShakeTable(runs=tuple(map(_run, tests)))


def _run(test: TableTest) -> TableRun:
    solution = solve(test.scene)
    result = solution.result
    return TableRun(
        test=test,
        model=solution.model,
        status=result.status,
        prd_m=result.prd_m,
        residual_m=math.hypot(result.residual_m, result.residual_across_m),
    )
