"""Elements of a page: tables, pictures, equation lines; and the formatting of values.

Templates print these and nothing else. Owns no content: see the other `report.pages` modules.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import groupby

from markupsafe import Markup

from report.assessment.arrays import ArrayAssessment, DesignBasis
from report.assessment.changes import NO_FORMER, Changes
from report.assessment.foresight import limit_value
from report.assessment.overrides import OVERRIDDEN
from report.assessment.project import Assessment
from report.assessment.verdict import Verdict
from report.provenance.files import fingerprint
from report.sheet.schema import Direction, ProjectInput
from report.typeset.equations import data_uri
from report.words.units import Quantity, Show, Unit, measured, pair
from solver.model import DefectError
from solver.rules.provisions import (
    Basis,
    Check,
    PrescriptiveBasis,
    Provision,
)

NO_VALUE = "none"
BAR = "changed"
"""Style of what changed since a former revision: a bar in the margin."""
SHORT_LETTERS = 64
"""Length of numbers that fit beside an equation."""
WHOLE_ROWS = 6  # longer tables may break across pages, with the heading repeated
OK, NG = "OK", "NG"


@dataclass(frozen=True, slots=True, kw_only=True)
class TableColumn:
    """A column: heading, unit below it, width in shares of the table, alignment."""

    head: str
    unit: str = ""
    share: float = 1.0
    align: str = "right"


@dataclass(frozen=True, slots=True)
class Wide:
    """A cell that spans several columns, left-aligned."""

    text: str
    span: int


@dataclass(frozen=True, slots=True, kw_only=True)
class TableRow:
    """A row of formatted strings; `kind` is a style: total, counts or empty."""

    cells: tuple[str | Wide, ...]
    kind: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Table:
    """A table with its caption; equal headings of adjacent columns are merged."""

    caption: str
    columns: tuple[TableColumn, ...]
    rows: tuple[TableRow, ...]
    notes: tuple[str, ...] = ()
    kind: str = ""
    whole_rows: int = WHOLE_ROWS

    @property
    def heads(self) -> tuple[tuple[str, int, str, str], ...]:
        """Headings, with number of columns spanned, alignment and width."""
        groups = [list(group) for _, group in groupby(self.columns, key=lambda c: c.head)]
        whole = sum(column.share for column in self.columns)
        return tuple(
            (
                group[0].head,
                len(group),
                "center" if len(group) > 1 else group[0].align,
                f"{100.0 * sum(column.share for column in group) / whole:.2f}%",
            )
            for group in groups
        )

    @property
    def body(self) -> tuple[tuple[str, tuple[tuple[str, str, int, str], ...]], ...]:
        """Rows as style and cells: text, marks after it, columns spanned, alignment."""
        aligns = [column.align for column in self.columns]
        return tuple((row.kind, tuple(_placed(row.cells, aligns))) for row in self.rows)

    @property
    def hold(self) -> str:
        """Style that keeps a short table on one page and lets a long one break."""
        return "whole" if len(self.rows) <= self.whole_rows else "split"

    @property
    def has_units(self) -> bool:
        """Whether any column has a unit."""
        return any(column.unit for column in self.columns)


def _placed(
    cells: Sequence[str | Wide], aligns: Sequence[str]
) -> Iterator[tuple[str, str, int, str]]:
    at = 0
    for cell in cells:
        if isinstance(cell, Wide):
            yield cell.text, "", cell.span, "left"
            at += cell.span
            continue
        # Marks after a number hang outside the column, so that the digits stay aligned.
        text = cell.rstrip("†‡") if aligns[at] == "right" else cell
        yield text, cell[len(text) :], 1, aligns[at]
        at += 1
    if at != len(aligns):
        raise DefectError(f"a row of {at} columns in a table of {len(aligns)}: {cells[0]}")


@dataclass(frozen=True, slots=True, kw_only=True)
class Picture:
    """A figure: SVG, caption and alternative text."""

    svg: str
    caption: str
    alt: str

    @property
    def src(self) -> str:
        """Its `data:` address."""
        return data_uri(self.svg)


@dataclass(frozen=True, slots=True, kw_only=True)
class Line:
    """A step of the calculation: equation, source, substituted numbers with results."""

    latex: str
    reference: str
    steps: tuple[tuple[str, str], ...] = ()
    note: str = ""

    @property
    def is_long(self) -> bool:
        """Whether its numbers are too long to stand beside the equation."""
        texts = (f"{Markup(left).striptags()} = {right}" for left, right in self.steps)
        return any(len(text) > SHORT_LETTERS for text in texts)


@dataclass(frozen=True, slots=True, kw_only=True)
class Part:
    """A numbered part of the package; `parts` are those below it."""

    id: str
    number: str
    title: str
    parts: tuple[Part, ...] = field(default=())

    @property
    def set(self) -> str:
        """Style of the list of its parts in the table of contents."""
        return "many" if len(self.parts) > 6 else "few"


@dataclass(frozen=True, slots=True)
class UnitFormat:
    """Formats values, the preferred system of units first."""

    us_first: bool

    def both(self, value_si: float, quantity: Quantity = Quantity.DISPLACEMENT) -> str:
        """Return `81.6 in (2072 mm)`; `none` for NaN."""
        return NO_VALUE if math.isnan(value_si) else pair(value_si, quantity, self.us_first)

    def cells(
        self,
        value_si: float,
        quantity: Quantity = Quantity.DISPLACEMENT,
        *,
        mark: str = "",
        show: Show = measured,
    ) -> tuple[str, str]:
        """Return the value in both systems, for two columns; `none` for NaN."""
        if math.isnan(value_si):
            return NO_VALUE, NO_VALUE
        first, second = self.units(quantity)
        return show(value_si, first) + mark, show(value_si, second) + mark

    def units(self, quantity: Quantity = Quantity.DISPLACEMENT) -> tuple[Unit, Unit]:
        """Return the units of a quantity, the preferred one first."""
        return (quantity.us, quantity.si) if self.us_first else (quantity.si, quantity.us)

    def columns(
        self, head: str, quantity: Quantity = Quantity.DISPLACEMENT, share: float = 1.0
    ) -> tuple[TableColumn, TableColumn]:
        """Return the two columns of a quantity."""
        first, second = self.units(quantity)
        return (
            TableColumn(head=head, unit=first.symbol, share=share),
            TableColumn(head=head, unit=second.symbol, share=share),
        )


def nan_is_worst(value: float) -> float:
    """Return a sort key in which NaN is the largest."""
    return math.inf if math.isnan(value) else value


def statistic(basis: Basis) -> str:
    """Return the statistic of the peaks, in words."""
    return basis.value.replace(" x ", " × ")


def verdict(ok: bool, words: tuple[str, str] = (OK, NG)) -> Markup:
    """Return OK, or NG highlighted."""
    good, bad = words
    return Markup('<b class="{}">{}</b>').format(*(("ok", good) if ok else ("ng", bad)))


def stamp(value: Verdict) -> Markup:
    """Return a verdict, highlighted where it is not OK."""
    return Markup('<b class="{}">{}</b>').format(value.name.lower(), value.value)


UNVERIFIED = (
    "Numbers marked † have not been compared with the text of the adopted document and shall be "
    "verified against it"
)


def dagger(provision: Provision) -> str:
    """Return the marks of a number: † unverified, ‡ overridden."""
    return ("" if provision.verified else "†") + (OVERRIDDEN if provision.reason else "")


def joined(marks: str, more: str) -> str:
    """Return marks, each once."""
    return marks if more in marks else marks + more


def check_value(check: Check, value: float, fmt: UnitFormat) -> str:
    """Return a number of a check with the units of its measure."""
    return limit_value(check, value, fmt.us_first)


@dataclass(frozen=True, slots=True, kw_only=True)
class PackageData:
    """Everything that the pages are made from."""

    assessment: Assessment
    numbers: Mapping[str, str]
    changes: Changes = NO_FORMER

    def part(self, name: str) -> str:
        """Return the reference to a part, as in `part 6`."""
        number = self.numbers[name]
        return f"part {number}" if number.isdigit() else f"appendix {number}"

    @property
    def fingerprint(self) -> str:
        """Short hash of workbook, records and version, at the foot of every sheet."""
        return fingerprint(self.assessment.sheet, self.assessment.shaking)

    @property
    def data(self) -> ProjectInput:
        """The input."""
        return self.assessment.project

    @property
    def fmt(self) -> UnitFormat:
        """Format of values."""
        return UnitFormat(us_first=self.data.project.units_first == "US")

    def mark(self, key: str) -> str:
        """Return the marks of a provision."""
        return dagger(self.assessment.rules.values[key])

    def clause(self, key: str) -> str:
        """Return the clause of a provision with its marks."""
        return self.assessment.rules.values[key].clause + self.mark(key)

    @property
    def reviewer(self) -> str:
        """Who reviewed the analysis: name, license and date, as far as they are given."""
        options = self.data.options
        by = (options.peer_reviewer, options.peer_license, options.peer_date or "")
        return ", ".join(str(part) for part in by if part) or "reviewer not given"

    def bar(self, is_changed: bool, kind: str = "") -> str:
        """Return the style of a row, with a bar in the margin where it changed."""
        return f"{kind} {BAR}".lstrip() if is_changed else kind

    @property
    def governing(self) -> ArrayAssessment:
        """The array with the largest design displacement."""
        return self.assessment.governing

    def prescriptive_key(self, array: ArrayAssessment) -> str:
        """Return which provision the prescriptive displacement comes from."""
        return {
            PrescriptiveBasis.FORMULA: "prescriptive_factor_in",
            PrescriptiveBasis.MINIMUM: "prescriptive_minimum_in",
            PrescriptiveBasis.LOW_CATEGORY: "prescriptive_low_sdc_in",
        }[array.prescriptive.governs]

    def design_mark(self, array: ArrayAssessment) -> str:
        """Return the marks of a design displacement."""
        if math.isnan(array.design_m):
            return ""
        if array.governs is DesignBasis.PRESCRIPTIVE:
            return joined(self.mark(self.prescriptive_key(array)), array.design_mark)
        key = "analysis_floor" if array.governs is DesignBasis.FLOOR else "analysis_factor"
        return joined(self.mark(key), array.design_mark)

    def prescriptive_mark(self, array: ArrayAssessment) -> str:
        """Return the marks of the prescriptive displacement."""
        mark = array.mark(lambda item: item.prescriptive.value_m)
        return joined(self.mark(self.prescriptive_key(array)), mark)

    def floor_m(self, array: ArrayAssessment) -> float:
        """Return the floor of an array for print [m]; NaN where peer review removes it."""
        return math.nan if self.data.options.peer_reviewed else array.floor_m

    def floor_mark(self, array: ArrayAssessment) -> str:
        """Return the marks of the floor of an array, if it has one."""
        if self.data.options.peer_reviewed:
            return ""
        return joined(self.mark("analysis_floor"), array.mark(lambda item: item.floor_m))

    def direction_mark(self, array: ArrayAssessment, direction: Direction) -> str:
        """Return the marks of a design displacement in a direction."""
        value = array.directions[direction].value_m
        key = "analysis_floor" if array.floor_m > value else "analysis_factor"
        if math.isnan(value):
            return ""
        return joined(self.mark(key), array.toward_mark(direction))


def shortened(text: str, most: int) -> str:
    """Return a text truncated to a length, for places of fixed size."""
    text = " ".join(text.split())
    return text if len(text) <= most else text[: most - 1].rstrip() + "…"
