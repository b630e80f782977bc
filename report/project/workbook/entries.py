"""The Excel side of an input: heading, unit, note, example; blocks and tables of inputs.

The type of a value and its allowed range are those of the field of the model.
"""

from __future__ import annotations

import datetime as dt
import math
from collections.abc import Callable, Sequence
from dataclasses import KW_ONLY, dataclass, replace
from enum import StrEnum
from functools import partial
from typing import Any, get_args

from annotated_types import Ge, Gt, Le, Lt

from report.project.model.choices import YesNo
from report.project.model.input_rows import InputRow
from report.project.model.values import Frozen
from report.text.units import Quantity, Unit


@dataclass(frozen=True, slots=True, kw_only=True)
class Bounds:
    """Range of a number, in SI or in the field's own unit; infinite where open."""

    low: float = -math.inf
    high: float = math.inf
    excludes_low: bool = False
    excludes_high: bool = False

    def has(self, value: float) -> bool:
        """Whether it contains a number."""
        is_above = value > self.low if self.excludes_low else value >= self.low
        return is_above and (value < self.high if self.excludes_high else value <= self.high)

    def words(self, si_per_unit: float = 1.0) -> str:
        """Return the range as text, in a unit: `0 to 1.5`, `greater than 0`; empty if unlimited."""
        low, high = (f"{bound / si_per_unit:.6g}" for bound in (self.low, self.high))
        if math.isinf(self.low) and math.isinf(self.high):
            return ""
        if math.isinf(self.low):
            return f"{'less than' if self.excludes_high else 'at most'} {high}"
        if math.isinf(self.high):
            return f"greater than {low}" if self.excludes_low else f"{low} or more"
        below = f"less than {high}" if self.excludes_high else high
        if self.excludes_low:
            return f"greater than {low}, {below if self.excludes_high else f'at most {high}'}"
        return f"{low} to {below}"


# Equal by identity, as each is made once: caches have sections as keys, and would hash every note
# of theirs.
@dataclass(frozen=True, slots=True, eq=False)
class Entry:
    """An input: a single cell, or a column of a table."""

    heading: str  # of its column, or the label of its cell
    name: str  # of its field in the model
    example: str | float | int | dt.date  # in the US unit of `unit` where that is a quantity
    unit: Quantity | str = ""  # a quantity with a choice of units, or a fixed unit
    _: KW_ONLY
    note: str  # shown when the cell is selected
    need: str = ""  # in words, where it is required unless something else is given
    usual: tuple[float, float] | None = None  # a number beyond is marked; in the unit of `example`
    # Field that states the unit of a number without one of its own, and what its text says of it.
    unit_from: tuple[str, Callable[[str], str]] | None = None
    zero: str = ""  # what 0 of a number is called, in a cell and in print
    is_rare: bool = False  # its column is folded at the right of a table
    former: str = ""  # its heading in earlier workbooks
    is_new: bool = False  # workbooks of 0.3.0 have no cell for it
    below: tuple[str, str] | None = None  # field of another block that its row follows
    sheet: str = ""  # of that block
    # What a blank cell stands for, by the fields read before it, and by which rule; None for the
    # default.
    computed: Callable[[InputRow], Any] | None = None
    rule: str = ""
    key_of: Callable[[str], str] = str  # what a text in a cell stands for
    # Of the field in the model, by which `block` and `table` complete an entry.
    kind: type[Any] = str  # float, int, str, bool, date, or an enum of `choices`
    is_required: bool = False
    default: Any = None  # the meaning of a blank cell; None if the field is required
    bounds: Bounds = Bounds()
    min_length: int = 0  # of a text
    max_length: int = 0

    @property
    def quantity(self) -> Quantity | None:
        """The quantity of the number, if its unit can be chosen."""
        return self.unit if isinstance(self.unit, Quantity) else None

    def unit_in(self, *, is_us: bool) -> Unit | None:
        """Return its unit in a system of units; None if it has no choice of units."""
        if self.quantity is None:
            return None
        return self.quantity.us if is_us else self.quantity.si

    def accepts(self, value: object) -> bool:
        """Whether a value that was read, in SI, is in its range, or a text of its length."""
        if isinstance(value, int | float):
            is_kind = self.kind is not int or isinstance(value, int)
            return is_kind and self.bounds.has(value)
        return self.kind is not str or self.min_length <= len(str(value)) <= self.max_length

    @property
    def or_zero(self) -> str:
        """Text that may be typed for 0, after the accepted numbers."""
        return f", or {self.zero}" if self.zero else ""

    @property
    def is_expected(self) -> bool:
        """Whether a row usually has it: it is required, or required unless something is given."""
        return self.is_required or bool(self.need)

    @property
    def needed(self) -> str:
        """Whether it is required, as text."""
        return self.need or ("required" if self.is_required else "optional")

    @property
    def expected(self) -> Bounds:
        """The range outside which a number is marked, in SI: typical, or else allowed."""
        if self.usual is None:
            return self.bounds
        low, high = self.usual
        si = self.quantity.us.si if self.quantity else 1.0
        return Bounds(low=low * si, high=high * si)

    @property
    def spoken(self) -> str:
        """The heading in the form used within a sentence."""
        # Symbols such as S_DS and CG keep their capitals.
        is_word = self.heading[1:2].islower()
        return self.heading[0].lower() + self.heading[1:] if is_word else self.heading

    @property
    def choices(self) -> tuple[str, ...]:
        """The texts to choose from; empty if the field is not a choice."""
        if self.kind is bool:
            return tuple(YesNo)
        return tuple(self.kind) if issubclass(self.kind, StrEnum) else ()


def of_model(entry: Entry, model: type[Frozen]) -> Entry:
    """Return an entry with the data of its model field."""
    info = model.model_fields[entry.name]
    constraints = list(info.metadata)
    kind: Any = info.annotation
    # The plain type is behind `Annotated[...] | None`, with constraints of its own.
    while args := [arg for arg in get_args(kind) if arg is not type(None)]:
        kind = args[0]
        for field in args[1:]:
            constraints += getattr(field, "metadata", [])
    min_lengths = [limit.min_length for limit in constraints if hasattr(limit, "min_length")]
    max_lengths = [limit.max_length for limit in constraints if hasattr(limit, "max_length")]
    return replace(
        entry,
        kind=kind,
        # A need that something else may satisfy is checked when the row is whole.
        is_required=info.is_required() and not entry.need,
        default=None if info.is_required() else info.default,
        bounds=_bounds(constraints),
        min_length=max(min_lengths, default=0),
        max_length=min(max_lengths, default=0),
    )


def _bounds(constraints: list[Any]) -> Bounds:
    bounds: dict[str, Any] = {}
    for constraint in constraints:
        match constraint:
            case Ge(ge=low) | Gt(gt=low):
                bounds |= {"low": low, "excludes_low": isinstance(constraint, Gt)}
            case Le(le=high) | Lt(lt=high):
                bounds |= {"high": high, "excludes_high": isinstance(constraint, Lt)}
    return Bounds(**bounds)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SheetSection:
    """A part of the workbook: a block of single cells, or a table."""

    key: str  # its field of the whole input, and the prefix of its names in the workbook
    sheet: str
    title: str
    model: type[Frozen]  # of the block, or of one row
    note: str  # one line of instruction
    entries: tuple[Entry, ...]
    is_table: bool
    may_be_absent: bool = False  # as in workbooks of earlier versions
    needs_rows: bool = False

    @property
    def is_needed(self) -> bool:
        """Whether every project fills it: a table with rows, or a block with required cells."""
        is_required = any(entry.is_required for entry in self.entries)
        return self.needs_rows if self.is_table else is_required

    def sheet_of(self, field: str) -> str:
        """Return the sheet of a field."""
        return self.entry(field).sheet or self.sheet

    @property
    def table_name(self) -> str:
        """Name of its Excel table."""
        return f"{self.key}_table"

    def entry(self, field: str) -> Entry:
        """Return one of its fields."""
        return next(entry for entry in self.entries if entry.name == field)

    def cell_name(self, field: str) -> str:
        """Return the defined name of a single cell."""
        return f"{self.key}_{field}"

    def unit_name(self, field: str) -> str:
        """Return the defined name of the cell that holds a single cell's unit."""
        return f"{self.cell_name(field)}_unit"


def section(
    key: str,
    sheet: str,
    title: str,
    model: type[Frozen],
    note: str,
    *entries: Entry,
    **traits: bool,
) -> SheetSection:
    """Return a part of the workbook, its entries with the data of their model fields."""
    return SheetSection(
        key=key,
        sheet=sheet,
        title=title,
        model=model,
        note=note,
        entries=tuple(of_model(entry, model) for entry in entries),
        **traits,
    )


block, table = partial(section, is_table=False), partial(section, is_table=True)


def rows_of(
    section: SheetSection, sections: Sequence[SheetSection]
) -> list[tuple[SheetSection, Entry]]:
    """Return the inputs in the order of a block's rows, with the section that each is of."""
    rows = []
    for entry in section.entries:
        if entry.below:
            continue
        rows.append((section, entry))
        place = (section.key, entry.name)
        for part in sections:
            rows += [(part, below) for below in part.entries if below.below == place]
    return rows
