"""The lines of a file with the units and step given by the caller, checked against each other.

A file in gal that the caller says is in g is refused; one without a unit is in that of the caller.

Sets the limits on files from unknown sources; reads no format. Read `open_source` first.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from solver.bounds import SENSITIVITY
from solver.errors import InputError, Problem, raise_any
from solver.file_checks import check_length, read_file
from solver.formats.likely_kinds import LOOKED_AT, likely_bytes, likely_text
from solver.records.record import UNIT_CHOICES, is_finite_number, is_raw, quoted, unit_size
from solver.suggestions import meant

# Sequence number, then the quality of the data (SEED manual, fixed section of the header).
_MINISEED = re.compile(rb"\d{6}[DRQM][ \x00]")
# NVHDR is word 76 of 4 bytes; 70 floats and 40 whole numbers precede 192 letters.
_SAC_HEADING, _SAC_VERSION_AT, _SAC_VERSIONS = 632, 304, {6, 7}


def waveform_format(data: bytes) -> str:
    """Return ObsPy's name for the format of a binary record that it reads; "" for another file."""
    if _MINISEED.match(data):
        return "MSEED"
    heading = data[_SAC_VERSION_AT : _SAC_VERSION_AT + 4]
    # SAC is written in the byte order of the machine that wrote it.
    versions = [int.from_bytes(heading, order) for order in ("little", "big")]
    is_sac = len(data) > _SAC_HEADING and not _SAC_VERSIONS.isdisjoint(versions)
    return "SAC" if is_sac else ""


MAX_BYTES = 64_000_000
MAX_LINE = 1000
# As many as are read within 10 s if the last one is at fault.
MAX_LINES = 1_000_000
MAX_NAME = 255

# Text has no control characters except tab, line ends and form feed.
_CONTROL = re.compile(rb"[\x00-\x08\x0b\x0e-\x1f]")

# Old systems end a text file with Ctrl-Z, or fill its last block with it or with NUL.
_END_OF_TEXT = b"\x1a \r\n"

# A file copied as text twice ends each line with two carriage returns.
_LINE_END = re.compile(r"\r{0,2}\n|\r")


@dataclass(frozen=True, slots=True, kw_only=True)
class Stated:
    """A number as printed in a file: its value, its possible rounding error and its line.

    NaN is one that is not stated.
    """

    value: float = math.nan
    rounding: float = 0.0
    index: int = 0

    def is_step(self, step_s: float) -> bool:
        """Whether this step is another one, within the rounding of its digits."""
        # A step of one digit is rounded, but not to half of it.
        rounding = min(self.rounding, 0.1 * self.value)
        return abs(self.value - step_s) <= rounding + 1e-4 * step_s


@dataclass(frozen=True, slots=True, kw_only=True)
class Source:
    """Lines of a file, and the units and step given by the caller."""

    name: str
    lines: list[str]  # without line ends
    units: str  # one of `UNIT_CHOICES`, or empty if the caller gives none
    dt_s: float  # sampling interval [s], or NaN if the caller gives none
    values_per_line: int = 0  # as the caller says of values across the lines
    response: str = ""  # of raw counts: a file of StationXML, or the counts per m/s2
    is_ended: bool = True  # with a line end, which a file that was cut rarely has
    content: bytes = b""

    def at(self, index: int) -> str:
        """File name and number of the line at an index, at the beginning of messages."""
        return f"{self.name}:{index + 1}"

    def line(self, index: int) -> str:
        """Return the line at an index; empty beyond the end of the file."""
        return self.lines[index] if index < len(self.lines) else ""

    def scale(self, stated: str, index: int) -> float:
        """Value [m/s2] of the unit stated in the file; the caller's, if any, must be equal."""
        size = unit_size(stated)
        if is_raw(stated):
            return self.counts_scale(f"{self.at(index)}: found unit {quoted(stated)}")
        if math.isnan(size):
            known = ", ".join(UNIT_CHOICES)
            raise InputError(
                f"{self.at(index)}: found unit {quoted(stated)}; use an acceleration in {known}"
            )
        if self.response:
            raise InputError(
                f"{self.at(index)}: the file is in {stated}, but a response is entered, which"
                " applies to raw counts; omit the response"
            )
        # gal and cm/s2 are one unit by two names.
        if self.units and not math.isclose(unit_size(self.units), size):
            problem = f"{self.at(index)}: the file is in {stated} but units are {self.units}"
            raise InputError(Problem(problem, "enter the file's units, or none", about="units"))
        return size

    @property
    def counts_per_mps2(self) -> float:
        """Raw counts for 1 m/s2, if given by the caller; otherwise NaN."""
        try:
            return float(self.response)
        except ValueError:
            return math.nan

    def counts_scale(self, problem: str) -> float:
        """Value [m/s2] of a raw count, if the caller gives counts per m/s2."""
        if math.isnan(self.counts_per_mps2):
            raise InputError(
                f"{problem}: raw counts require the response of the instrument;"
                " enter it (motion convert --response), as StationXML for miniSEED and SAC, or as"
                " counts per m/s2"
            )
        if not SENSITIVITY.has(self.counts_per_mps2):
            raise InputError(
                f"{problem}: the response is {self.response} counts per m/s2; enter"
                f" {SENSITIVITY.words}"
            )
        return 1.0 / self.counts_per_mps2

    def stated_scale(self, stated: Sequence[tuple[str, int]]) -> float:
        """Value [m/s2] of the unit of lines of text, each with its index, else the caller's."""
        if len({unit_size(unit) for unit, _ in stated}) > 1:
            units = " and ".join(dict.fromkeys(unit for unit, _ in stated))
            raise InputError(f"{self.at(stated[-1][1])}: found units {units}; correct one of them")
        if stated:
            return self.scale(*stated[0])
        if self.response and not self.units:
            return self.counts_scale(f"{self.name}: found no unit")
        if not self.units:
            remedy = f"enter units, one of {', '.join(UNIT_CHOICES)}, or a heading such as acc_g"
            problem = f"{self.name}: found no unit of acceleration"
            raise InputError(Problem(problem, remedy, about="units"))
        return unit_size(self.units)

    def agreed(self, steps: Sequence[Stated]) -> Stated:
        """Return the step [s] that lines of text state: of several that of the caller, if any."""
        given = [step for step in steps if abs(step.value - self.dt_s) <= 1e-4 * self.dt_s]
        first, *others = given or steps
        for step in others:
            # A step of one digit is rounded, but not to half of it.
            rounding = min(first.rounding + step.rounding, 0.1 * first.value)
            if abs(step.value - first.value) > rounding + 1e-4 * first.value:
                problem = (
                    f"{self.at(step.index)}: found a step of {step.value:g} s and one of"
                    f" {first.value:g} s"
                )
                remedy = "enter the time step dt, or correct one of them"
                raise InputError(Problem(problem, remedy, about="dt_s"))
        return first

    def step(self, stated: Stated) -> float:
        """Sampling interval [s] stated in the file; the caller's, if any, must agree."""
        value = stated.value
        if math.isnan(value):
            if math.isnan(self.dt_s):
                problem = f"{self.at(stated.index)}: found no time step"
                raise InputError(Problem(problem, "enter the time step dt", about="dt_s"))
            return self.dt_s
        if not (is_finite_number(value) and value > 0.0):
            raise InputError(
                f"{self.at(stated.index)}: found time step {value:g} s; enter a number above 0"
            )
        if math.isnan(self.dt_s):
            return value
        # A caller may give 1/128 s as 0.007813 s, which is then taken.
        if not stated.is_step(self.dt_s):
            problem = (
                f"{self.at(stated.index)}: the time step of the file is {value:.6g} s but"
                f" {self.dt_s:.6g} s was entered"
            )
            remedy = "enter the time step of the file, or none"
            raise InputError(Problem(problem, remedy, about="dt_s"))
        return self.dt_s


def open_source(
    path: Path, *, units: str, dt_s: float, values_per_line: int = 0, response: str = ""
) -> Source:
    """Read the lines of a file.

    Raises `InputError` if the arguments are invalid, or the file is missing, too large or not text.
    """
    name, problems = _name(path), []
    if not isinstance(units, str) or (units and units not in UNIT_CHOICES):
        problems.append(f"{name}: unit is {quoted(units)}; enter one of {', '.join(UNIT_CHOICES)}")
    unknown = isinstance(dt_s, float) and math.isnan(dt_s)
    # NaN stands for a step that is not given, and only a float can be NaN.
    if not unknown and not (is_finite_number(dt_s) and dt_s > 0.0):
        problems.append(
            f"{name}: time step dt is {quoted(dt_s)}; enter a number of seconds above 0"
        )
    # Not isinstance: True is an int and would mean one value per line.
    if type(values_per_line) is not int or values_per_line < 0:
        problems.append(f"{name}: values per line is {quoted(values_per_line)}; enter 1, 2, ...")
    if units and response:
        problems.append(f"{name}: units and a response are entered; use only one of them")
    raise_any(problems)
    data = _bytes(path)
    return Source(
        name=name,
        # `_lines` refuses bytes that are no text.
        lines=[] if waveform_format(data) else _lines(name, data),
        units=units,
        dt_s=float(dt_s),
        values_per_line=values_per_line,
        response=str(response),
        is_ended=data.rstrip(b"\x00\x1a ").endswith((b"\n", b"\r")),
        content=data,
    )


def _name(path: Path) -> str:
    """Name of a file in messages, shortened if it is longer than any file system allows."""
    name = path.name
    return name if len(name) <= MAX_NAME else f"{name[:MAX_NAME]}..."


def _bytes(path: Path) -> bytes:
    name = _name(path)
    try:
        if not path.exists():
            # Windows reports a path that is too long as not found.
            check_length(path)
            raise InputError(f"{name}: no such file; {meant(path) or 'use the path of a record'}")
    except OSError as error:
        raise InputError(f"{name}: cannot be read ({error.strerror})") from error
    return read_file(path, MAX_BYTES, name, too_large="use part of it")


def _lines(name: str, data: bytes) -> list[str]:
    # The typographic minus sign of web pages and word processors.
    text = _decode(name, data).replace("\u2212", "-")
    if "\r" in text:
        text = _LINE_END.sub("\n", text)
    # Counted before the text is split: a list of many millions of lines could exhaust the memory.
    count = text.count("\n") + 1
    if count > MAX_LINES:
        raise InputError(f"{name}: found {count:,} lines; enter at most {MAX_LINES:,}")
    lines = text.split("\n")
    if max(map(len, lines)) > MAX_LINE:
        if likely := likely_text([line[:MAX_LINE] for line in lines[:LOOKED_AT]]):
            raise InputError(f"{name}: {likely}")
        raise_any(
            f"{name}:{number}: found a line of {len(line)} characters; enter at most {MAX_LINE}"
            for number, line in enumerate(lines, start=1)
            if len(line) > MAX_LINE
        )
    return lines


def _decode(name: str, data: bytes) -> str:
    """Text of the file; if not UTF-8, as some old headings, it is read as Latin-1."""
    try:
        # As Excel saves "Unicode text".
        if data.startswith((b"\xff\xfe", b"\xfe\xff")):
            return data.decode("utf-16")
        plain = data.rstrip(b"\x00" + _END_OF_TEXT)
        if not _CONTROL.search(plain) and (plain or not data.startswith(b"\x00")):
            # With or without the byte order mark that Windows programs write.
            return plain.decode("utf-8-sig")
    except UnicodeDecodeError:
        data = data.rstrip(_END_OF_TEXT)
        if not _CONTROL.search(data):
            # Latin-1 has a character for every byte, so this never fails; at worst, accented
            # letters in headings are wrong.
            return data.decode("latin-1")
    raise InputError(f"{name}: not a text file; {likely_bytes(data) or 'use text or CSV'}")
