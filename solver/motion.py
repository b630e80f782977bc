"""Acceleration records: reads them from text or pasted values, writes them, takes their spectra.

Owns no code rules (`solver.provisions`) and makes no motions (`solver.synthesis`).
Read `read_record` first, then `response_spectrum`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from solver import kernels
from solver.model import Floats, InputError

UNITS = {"g": 9.80665, "m/s2": 1.0, "cm/s2": 0.01, "mm/s2": 0.001}
"""Acceleration units and their size in m/s2."""

DECIMALS = {"g": 5, "m/s2": 4, "cm/s2": 2, "mm/s2": 1}
"""Decimals that `write_record` prints, about 1e-5 g in every unit."""

MAX_BYTES = 64_000_000
MAX_LINE = 1000
MAX_PROBLEMS = 10

# Apart from tab, line ends and form feed, text has no control characters.
_CONTROL = re.compile(rb"[\x00-\x08\x0b\x0e-\x1f]")
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
_DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+", re.ASCII)
_BLANK_BETWEEN = re.compile(r"[^,\s]\s+[^,\s]")

# Larger numbers count as infinite, so that a change of unit cannot make them so.
_BEYOND = 1e300

_Row = tuple[int, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class Record:
    """One component of a motion, evenly sampled, straight lines between samples.

    Attributes
    ----------
    name : str
    dt_s : float
        Sampling interval [s], > 0.
    a_mps2 : array, shape (n,)
        Acceleration [m/s2], read-only, n >= 2.
    """

    name: str
    dt_s: float
    a_mps2: Floats


def read_record(path: Path, *, units: str, dt_s: float | None = None) -> Record:
    """Read a record from text of one column (acceleration) or two (time [s], acceleration).

    Columns stand apart by comma, semicolon, tab or blanks. One heading line, blank lines and
    comments after `#` are skipped.

    Parameters
    ----------
    path : Path
    units : {"g", "m/s2", "cm/s2", "mm/s2"}
        Unit of the acceleration in the file.
    dt_s : float, optional
        Sampling interval [s]. Needed for one column; with two it must agree with the times.

    Returns
    -------
    Record
        Named after the file.

    Raises
    ------
    InputError
        With every problem in the file, each as ``name:LINE: what was found; what would do``.
    """
    _check_arguments(path.name, units, dt_s)
    lines = _read_lines(path)
    table = _parse(path.name, lines)
    if table.shape[1] == 2:
        dt_s = _time_step(path.name, table[:, 0], lines, dt_s)
    elif dt_s is None:
        raise InputError(f"{path.name}: found one column, without times; give the time step dt")
    return _record(path.name, table[:, -1], units, dt_s)


def record_from_values(
    name: str, values: Sequence[object] | Floats, *, units: str, dt_s: float
) -> Record:
    """Make a record of values that are at hand, such as a pasted column.

    Raises
    ------
    InputError
        With every value that is not a finite number, counted from 1.
    """
    _check_arguments(name, units, dt_s)
    values = values.tolist() if isinstance(values, np.ndarray) else values
    if len(values) < 2:
        raise InputError(f"{name}: a column of {len(values)}; give at least 2 values")
    problems = [
        f"{name}: value {i} is {_shown(value)}; give a number"
        for i, value in enumerate(values, start=1)
        if not _is_finite_number(value)
    ]
    _raise_any(problems)
    return _record(name, np.asarray(values, dtype=np.float64), units, dt_s)


def write_record(path: Path, record: Record, units: str = "g", *, within: float = math.inf) -> None:
    """Write a record as csv of time [s] and acceleration, with a heading line.

    The acceleration is printed to `DECIMALS`, and to as many more as keep every sample `within`
    that part of the record's peak. A record that was rounded to `DECIMALS`, as those of
    `solver.synthesis` are in g, is read back bit for bit.
    """
    _check_arguments(path.name, units, record.dt_s)
    values = record.a_mps2 / UNITS[units]
    places = next((k for k in range(1, 9) if _fits(record.dt_s, 10.0**-k)), 9)
    decimals = _decimals(values, DECIMALS[units], within)
    row = f"{{:.{places}f}},{{:z.{decimals}f}}\n".format
    body = "".join(row(i * record.dt_s, value) for i, value in enumerate(values.tolist()))
    path.write_text(f"time_s,acceleration_{units}\n{body}", encoding="utf-8", newline="\n")


def _decimals(values: Floats, least: int, within: float) -> int:
    """Decimals that print the values to that part of the largest one, from `least` on."""
    peak = np.abs(values).max()
    # Beyond 300 decimals a power of ten is no longer a float.
    kept = (k for k in range(least, 300) if _off(values, k) <= within * peak)
    return least if math.isinf(within) or peak == 0.0 else next(kept, 300)


def _off(values: Floats, decimals: int) -> float:
    return float(np.abs(values - np.round(values, decimals)).max())


def response_spectrum(
    a_mps2: ArrayLike, dt_s: float, periods_s: ArrayLike, damping: float = 0.05
) -> Floats:
    """Pseudo-spectral acceleration of a record, omega^2 times the largest |displacement|.

    The oscillators follow the linearly interpolated record exactly (Nigam and Jennings, Bull.
    Seism. Soc. Am. 59 (1969) 909-922), from rest to the end of the record. Peaks are those at the
    samples: a peak between two of them is missed by up to 1 - cos(pi dt / T). Free vibration after
    the record's end is not looked at: pad a record with zeros to have it.

    Parameters
    ----------
    a_mps2 : array_like, shape (n,)
        Acceleration [m/s2].
    dt_s : float
        Sampling interval [s], > 0.
    periods_s : array_like, shape (m,)
        Natural periods [s], >= 0; 0 gives the peak acceleration of the record.
    damping : float
        Fraction of critical damping, in [0, 1).

    Returns
    -------
    array, shape (m,)
        Pseudo-spectral acceleration [m/s2].

    Raises
    ------
    InputError
    """
    a, periods = _read_only(a_mps2), np.asarray(periods_s, dtype=np.float64)
    _check_spectrum(a, dt_s, periods, damping)
    with np.errstate(divide="ignore", over="ignore"):
        omega = 2.0 * math.pi / periods
    rigid = ~np.isfinite(omega)
    peak, at = np.empty_like(omega), np.empty(omega.shape, dtype=np.int64)
    kernels.oscillator_peaks(a, float(dt_s), np.where(rigid, 0.0, omega), float(damping), peak, at)
    return np.where(rigid, np.abs(a).max(), np.abs(peak))


def _read_only(values: ArrayLike) -> Floats:
    # numba compiles a second version for writable arrays, so kernels see read-only ones only.
    array = np.ascontiguousarray(values, dtype=np.float64).view()
    array.setflags(write=False)
    return array


def _record(name: str, values: Floats, units: str, dt_s: float) -> Record:
    return Record(name=name, dt_s=float(dt_s), a_mps2=_read_only(values * UNITS[units]))


def _is_finite_number(value: object) -> bool:
    if isinstance(value, int | float | np.integer | np.floating) and not isinstance(value, bool):
        return bool(-_BEYOND < value < _BEYOND)
    return False


def _shown(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 32 else f"{text[:28]}...{text[-1]}"


def _raise_any(problems: Sequence[str]) -> None:
    """Raise the first problems with a count of the others, if there are any."""
    if problems:
        more = len(problems) - MAX_PROBLEMS
        tail = [f"... and {more} more"] if more > 0 else []
        raise InputError([*problems[:MAX_PROBLEMS], *tail])


def _check_arguments(name: str, units: str, dt_s: float | None) -> None:
    problems = []
    if units not in UNITS:
        problems.append(f"{name}: unit is {units!r}; give one of {', '.join(UNITS)}")
    if dt_s is not None and not (_is_finite_number(dt_s) and dt_s > 0.0):
        problems.append(f"{name}: time step dt is {dt_s!r}; give a number of seconds above 0")
    _raise_any(problems)


def _check_spectrum(a: Floats, dt_s: float, periods: Floats, damping: float) -> None:
    problems = []
    if a.ndim != 1 or len(a) < 1 or not np.isfinite(a).all():
        problems.append("acceleration: give one column of finite numbers")
    if not (math.isfinite(dt_s) and dt_s > 0.0):
        problems.append(f"time step dt is {dt_s!r}; give a number of seconds above 0")
    if periods.ndim != 1 or not (np.isfinite(periods).all() and (periods >= 0.0).all()):
        problems.append("periods: give one column of numbers of seconds, 0 or above")
    if not 0.0 <= damping < 1.0:
        problems.append(f"damping is {damping!r}; give a fraction from 0 to below 1")
    _raise_any(problems)


def _read_lines(path: Path) -> list[str]:
    name = path.name
    try:
        if not path.exists():
            raise InputError(f"{name}: no such file; give the path of a record")
        if not path.is_file():
            raise InputError(f"{name}: not a file; give the path of a record")
        size = path.stat().st_size
        if size > MAX_BYTES:
            raise InputError(f"{name}: {size / 1e6:.0f} MB; give at most {MAX_BYTES / 1e6:.0f} MB")
        data = path.read_bytes()
    except OSError as error:
        raise InputError(f"{name}: cannot be read ({error.strerror})") from error
    lines = _decode(name, data).replace("\r\n", "\n").replace("\r", "\n").split("\n")
    _raise_any(
        [
            f"{name}:{number}: found a line of {len(line)} characters; give at most {MAX_LINE}"
            for number, line in enumerate(lines, start=1)
            if len(line) > MAX_LINE
        ]
    )
    return lines


def _decode(name: str, data: bytes) -> str:
    """Text of the file; bytes that are not UTF-8, as in an old heading, count as Latin-1."""
    try:
        if data.startswith((b"\xff\xfe", b"\xfe\xff")):
            return data.decode("utf-16")
        if not _CONTROL.search(data):
            return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        if not _CONTROL.search(data):
            return data.decode("latin-1")
    raise InputError(f"{name}: not a text file; give text or csv of one or two columns")


def _parse(name: str, lines: list[str]) -> Floats:
    """Table of one or two columns, at least two rows."""
    start = _first_row(lines)
    first = next(_rows(lines, start), None)
    if first is None:
        raise InputError(f"{name}: found no numbers; give one or two columns of them")
    separator = _separator(first[1])
    table = _parse_fast(lines[start:], separator)
    if table is None:
        table = _parse_slowly(name, _rows(lines, start), separator)
    if len(table) < 2:
        raise InputError(f"{name}: found 1 sample; give at least 2")
    return table


def _content(line: str) -> str:
    return line.partition("#")[0].strip()


def _rows(lines: list[str], start: int) -> Iterator[_Row]:
    """Line number and content of each line from index `start` that is not blank or comment."""
    for number, line in enumerate(lines[start:], start=start + 1):
        if content := _content(line):
            yield number, content


def _first_row(lines: list[str]) -> int:
    """Index of the first line that may hold numbers: after the heading, if there is one."""
    for number, content in _rows(lines, 0):
        return number if _is_heading(content) else number - 1
    return len(lines)


def _is_heading(content: str) -> bool:
    word = re.split(r"[,;\s]", content)[0]
    return content[0] not in "+-.0123456789" and word.lower() not in {"nan", "inf", "infinity"}


def _separator(content: str) -> str | None:
    """Separator of the columns; None for blanks and tabs, a comma of `0,1 0,2` being decimal."""
    if ";" in content:
        return ";"
    return "," if "," in content and not _BLANK_BETWEEN.search(content) else None


def _parse_fast(lines: list[str], separator: str | None) -> Floats | None:
    """Table if every row is one or two finite numbers, else None."""
    try:
        table: Floats = np.loadtxt(lines, delimiter=separator, ndmin=2)
    except ValueError:
        return None
    return table if table.shape[1] <= 2 and (np.abs(table) < _BEYOND).all() else None


def _parse_slowly(name: str, rows: Iterator[_Row], separator: str | None) -> Floats:
    """Go through a table that has a fault, row by row, to say all that is wrong with it."""
    split = [(number, content.split(separator)) for number, content in rows]
    first, width = split[0][0], len(split[0][1])
    if width > 2:
        columns = "one (acceleration) or two (time, acceleration)"
        raise InputError(f"{name}:{first}: found {width} columns; give {columns}")
    problems = [
        f"{name}:{number}: {problem}"
        for number, fields in split
        for problem in _row_problems(fields, width)
    ]
    _raise_any(problems)
    return np.array([[float(field) for field in fields] for _, fields in split])


def _row_problems(fields: list[str], width: int) -> list[str]:
    if len(fields) != width:
        columns = "1 column" if len(fields) == 1 else f"{len(fields)} columns"
        return [f"found {columns}; give {width} as in the first row"]
    return [problem for field in fields if (problem := _field_problem(field.strip()))]


def _field_problem(field: str) -> str:
    if _NUMBER.fullmatch(field) and _is_finite_number(float(field)):
        return ""
    point = " with a decimal point" if _DECIMAL_COMMA.match(field) else ""
    return f"found {_shown(field)}; give a number{point}"


def _fits(values: float | Floats, resolution: float) -> bool:
    """Whether the values are whole multiples of the resolution, to float precision."""
    with np.errstate(over="ignore", invalid="ignore"):
        counts = np.asarray(values) / resolution
        return bool(np.all(np.abs(counts - np.rint(counts)) < 1e-6))


def _time_step(name: str, t: Floats, lines: list[str], given_s: float | None) -> float:
    """Step of even times, which may be rounded as printed; the given one if it agrees."""
    n = len(t) - 1
    step = (t[-1] - t[0]) / n
    resolution = next((10.0**-k for k in range(10) if _fits(t, 10.0**-k)), 0.0)
    # Two printed times are off by half the resolution each. A coarser one would hide a lost
    # sample, and steps of whole multiples need no allowance.
    rounding = resolution if resolution <= 0.5 * step else 0.0
    allowance = max(1.001 * rounding, 0.01 * step)
    off = t - (t[0] + step * np.arange(n + 1))
    if step < 1e-9 or max(np.abs(off).max(), np.abs(np.diff(off)).max()) > allowance:
        _raise_any(_uneven(name, t, lines, allowance))
    blur = rounding / n
    if given_s is None:
        return _round_step(step, blur)
    if abs(step - given_s) > blur + 1e-4 * step:
        step_text = f"{_round_step(step, blur):.6g}"
        raise InputError(
            f"{name}: the times step by {step_text} s but dt is {given_s:.6g} s; give one of them"
        )
    return given_s


def _round_step(step: float, blur: float) -> float:
    """Step [s] freed of the rounding of printed times: a whole rate in Hz if one is that near."""
    whole = 1.0 / max(round(1.0 / step), 1)
    return whole if abs(whole - step) <= blur + 1e-9 * step else float(f"{step:.9g}")


def _uneven(name: str, t: Floats, lines: list[str], allowance: float) -> list[str]:
    """Say where times are uneven, or that their comma may be a decimal one."""
    rows = list(_rows(lines, _first_row(lines)))
    if all(_DECIMAL_COMMA.fullmatch(content) for _, content in rows):
        number, content = rows[0]
        return [f"{name}:{number}: found {content!r}; give a number with a decimal point"]
    steps = np.diff(t)
    usual = float(np.median(steps))
    far = np.abs(steps - usual)
    odd = np.flatnonzero((far > 2.0 * allowance) | (steps <= 0.0))
    if odd.size == 0:
        odd = np.array([int(far.argmax())])
    return [
        f"{name}:{rows[i + 1][0]}: found time {t[i + 1]:.6g} s after {t[i]:.6g} s, "
        f"the usual step being {usual:.6g} s; give even, rising times"
        for i in odd
    ]
