"""The parts of an input field: label, unit, range, choices.

Template, reader and echo use this module and never inspect pydantic models themselves.
"""

from __future__ import annotations

import ast
import datetime as dt
import inspect
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import KW_ONLY, asdict, dataclass
from enum import StrEnum
from functools import cache
from itertools import pairwise
from typing import Annotated, Any, ClassVar, NamedTuple, get_args, get_origin

from annotated_types import Ge, Gt, Le, Lt
from pydantic import BaseModel, ConfigDict, TypeAdapter
from pydantic.fields import FieldInfo

from report.text.units import Quantity, Unit
from solver.model import Problem


class Place(NamedTuple):
    """A cell by meaning: section, row of its table, field; without the last two, a whole table."""

    section: str
    row: int = 0
    field: str = ""


class Level(StrEnum):
    """Weight of a finding: an error stops the work."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """Something in a workbook that is refused, or permitted and perhaps not meant."""

    level: Level
    place: Place  # the cell to look at
    others: tuple[Place, ...] = ()  # further ones of its section
    text: str  # what was found; of a warning also what would do
    remedy: str = ""  # what would do, of an error
    id: str = ""  # by which the sheet Acknowledged answers a warning; a limit has none
    reason: str = ""  # from the sheet Acknowledged
    cell: str = ""  # address of a cell that is no input; empty for that of the place

    @classmethod
    def error(cls, place: Place, found: str, remedy: str = "") -> Finding:
        """Return an input error: what was found, and what would be accepted."""
        return cls(level=Level.ERROR, place=place, text=found, remedy=remedy)

    def problem(self, where: str) -> Problem:
        """Return the error with its address."""
        return Problem(self.text, self.remedy, where)


DraftRow = Mapping[str, Any]
"""Fields of a row of a draft; a field that could not be read is absent."""

Draft = Mapping[str, Sequence[DraftRow]]
"""Rows by section, as far as they could be read."""

Where = Callable[[Place], str]
"""Returns the address of a place."""


class YesNo(StrEnum):
    """Yes or no, as shown in a cell."""

    YES = "Yes"
    NO = "No"


@dataclass(frozen=True, slots=True)
class Cell:
    """How a field is presented to the user."""

    label: str
    example: str | float | int | dt.date  # in the US unit of `unit` where that is a quantity
    unit: Quantity | str = ""  # a quantity with a choice of units, or a fixed unit
    _: KW_ONLY
    help: str = ""  # shown when the cell is selected; empty for the docstring of the field
    need: str = ""  # in words, where it is required unless something else is given
    usual: tuple[float, float] | None = None  # a number beyond is marked; in the unit of `example`
    # Field that states the unit of a number without one of its own, and what its text says of it.
    unit_from: tuple[str, Callable[[str], str]] | None = None
    zero: str = ""  # what 0 of a number is called, in a cell and in print
    is_rare: bool = False  # its column is folded at the right of a table
    below: tuple[str, str] | None = None  # field of another block that its row follows


class Frozen(BaseModel):
    """Base of all models: frozen, complete, finite; the docstring of a field is its help."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, str_strip_whitespace=True
    )

    computed_last: ClassVar[Mapping[str, str]] = {}
    """Fields of a block that all others give where they are blank, in order, and by which rule."""

    @classmethod
    def computed(cls, name: str, row: Mapping[str, Any]) -> Any:
        """Return what a blank cell is by the fields read before it; None for its default."""
        return None


@dataclass(frozen=True, slots=True)
class OnSheet:
    """Where the workbook has a field of the whole input: see `SheetSection`."""

    sheet: str
    title: str
    may_be_absent: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class SheetSection:
    """A part of the workbook: a block of single cells, or a table."""

    key: str  # its field of `whole`, and the prefix of its names in the workbook
    sheet: str
    title: str
    model: type[Frozen]  # of the block, or of one row
    is_table: bool
    may_be_absent: bool  # as in workbooks of earlier versions
    whole: type[Frozen]

    @property
    def instruction(self) -> str:
        """One line of instruction: the docstring of its field of `whole`."""
        return docstrings(self.whole)[self.key]

    @property
    def is_needed(self) -> bool:
        """Whether every project fills it: a table with rows, or a block with required cells."""
        if self.is_table:
            return self.whole.model_fields[self.key].is_required()
        return any(entry.is_required for entry in entries(self.model))

    @property
    def rows(self) -> Sequence[tuple[SheetSection, Entry]]:
        """The fields in the order of a block's rows, with the section that each is of."""
        blocks = [section for section in sections_of(self.whole) if not section.is_table]
        fields = [(block, entry) for block in blocks for entry in entries(block.model)]
        return [
            row
            for section, entry in fields
            if section is self and not entry.cell.below
            for row in (
                (section, entry),
                *(other for other in fields if other[1].cell.below == (self.key, entry.name)),
            )
        ]

    def sheet_of(self, field: str) -> str:
        """Return the sheet of a field."""
        key, _ = self.entry(field).cell.below or (self.key, "")
        return next(part.sheet for part in sections_of(self.whole) if part.key == key)

    @property
    def table_name(self) -> str:
        """Name of its Excel table."""
        return f"{self.key}_table"

    def entry(self, field: str) -> Entry:
        """Return one of its fields."""
        return next(entry for entry in entries(self.model) if entry.name == field)

    def cell_name(self, field: str) -> str:
        """Return the defined name of a single cell."""
        return f"{self.key}_{field}"

    def unit_name(self, field: str) -> str:
        """Return the defined name of the cell that holds a single cell's unit."""
        return f"{self.cell_name(field)}_unit"


@cache
def sections_of(whole: type[Frozen]) -> tuple[SheetSection, ...]:
    """Return the parts of the workbook of a whole input, in its order; rows are a table."""
    return tuple(
        _section(whole, key, field, part)
        for key, field in whole.model_fields.items()
        for part in field.metadata
        if isinstance(part, OnSheet)
    )


def _section(whole: type[Frozen], key: str, field: FieldInfo, part: OnSheet) -> SheetSection:
    is_table = get_origin(field.annotation) is tuple
    model: Any = get_args(field.annotation)[0] if is_table else field.annotation
    return SheetSection(key=key, model=model, is_table=is_table, whole=whole, **asdict(part))


@dataclass(frozen=True, slots=True, kw_only=True)
class Bounds:
    """Range of a number, in SI or in the field's own unit; infinite where open."""

    low: float = -math.inf
    high: float = math.inf
    excludes_low: bool = False
    excludes_high: bool = False

    def words(self, si_per_unit: float = 1.0) -> str:
        """Return the range in words, in a unit: `0 to 1.5`, `more than 0`; empty for any."""
        low, high = (f"{bound / si_per_unit:.6g}" for bound in (self.low, self.high))
        if math.isinf(self.low) and math.isinf(self.high):
            return ""
        if math.isinf(self.low):
            return f"{'less than' if self.excludes_high else 'at most'} {high}"
        if math.isinf(self.high):
            return f"more than {low}" if self.excludes_low else f"{low} or more"
        above = f"more than {low}" if self.excludes_low else low
        return f"{above} to {'less than ' if self.excludes_high else ''}{high}"


@dataclass(frozen=True, slots=True, kw_only=True)
class Entry:
    """One field of a model, as used by template, reader and echo."""

    model: type[Frozen]
    name: str
    cell: Cell
    kind: type[Any]  # float, int, str, bool, date, or an enum of `choices`
    is_required: bool
    default: Any  # the meaning of a blank cell; None if the field is required
    bounds: Bounds
    max_length: int  # of a text

    @property
    def quantity(self) -> Quantity | None:
        """The quantity of the number, if its unit can be chosen."""
        return self.cell.unit if isinstance(self.cell.unit, Quantity) else None

    def unit(self, *, is_us: bool) -> Unit | None:
        """Return its unit in a system of units; None if it has no choice of units."""
        if self.quantity is None:
            return None
        return self.quantity.us if is_us else self.quantity.si

    @property
    def help(self) -> str:
        """The message shown when the cell is selected."""
        return self.cell.help or docstrings(self.model)[self.name]

    @property
    def or_zero(self) -> str:
        """What may be typed for 0, after the numbers that are accepted."""
        return f", or {self.cell.zero}" if self.cell.zero else ""

    @property
    def need(self) -> str:
        """Whether it is required, in words."""
        return self.cell.need or ("required" if self.is_required else "optional")

    @property
    def is_expected(self) -> bool:
        """Whether a row usually has it: it is required, or required unless something is given."""
        return self.is_required or bool(self.cell.need)

    @property
    def expected(self) -> Bounds:
        """The range beyond which a number is marked, in SI: the usual one, or else the allowed."""
        if self.cell.usual is None:
            return self.bounds
        low, high = self.cell.usual
        si = self.quantity.us.si if self.quantity else 1.0
        return Bounds(low=low * si, high=high * si)

    @property
    def spoken(self) -> str:
        """The label in the form used within a sentence."""
        label = self.cell.label
        # Symbols such as S_DS and CG keep their capitals.
        return label[0].lower() + label[1:] if label[1:2].islower() else label

    @property
    def choices(self) -> tuple[str, ...]:
        """The texts to choose from; empty if the field is not a choice."""
        if self.kind is bool:
            return tuple(YesNo)
        return tuple(self.kind) if issubclass(self.kind, StrEnum) else ()


@cache
def entries(model: type[Frozen]) -> tuple[Entry, ...]:
    """Return the fields of a model in order, omitting those without a `Cell`."""
    return tuple(
        _entry(model, name, info, cell)
        for name, info in model.model_fields.items()
        for cell in info.metadata
        if isinstance(cell, Cell)
    )


@cache
def docstrings(model: type[BaseModel]) -> Mapping[str, str]:
    """Return the docstrings of the fields that a model and those it extends have."""
    # As `use_attribute_docstrings` of pydantic, which takes its time whenever a model is imported.
    (definition,) = ast.parse(inspect.getsource(model)).body
    assert isinstance(definition, ast.ClassDef)
    texts: dict[str, str] = {}
    for base in model.__bases__:
        texts |= docstrings(base) if getattr(base, "model_fields", None) else {}
    for field, text in pairwise(definition.body):
        match field, text:
            case ast.AnnAssign(target=ast.Name(id=name)), ast.Expr(value=ast.Constant(value=said)):
                texts[name] = " ".join(str(said).split())
    return texts


def _entry(model: type[Frozen], name: str, info: FieldInfo, cell: Cell) -> Entry:
    constraints = list(info.metadata)
    kind: Any = info.annotation
    # The plain type is behind `Annotated[...] | None`, with constraints of its own.
    while args := [arg for arg in get_args(kind) if arg is not type(None)]:
        kind = args[0]
        for field in args[1:]:
            constraints += getattr(field, "metadata", [])
    lengths = [
        limit for constraint in constraints if (limit := getattr(constraint, "max_length", None))
    ]
    return Entry(
        model=model,
        name=name,
        cell=cell,
        kind=kind,
        # A need that something else may satisfy is checked when the row is whole.
        is_required=info.is_required() and not cell.need,
        default=None if info.is_required() else info.default,
        bounds=_bounds(constraints),
        max_length=min(lengths, default=0),
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


@cache
def adapter(model: type[Frozen], name: str) -> TypeAdapter[Any]:
    """Return the validator of a single field."""
    info = model.model_fields[name]
    annotated: Any = Annotated[info.annotation, *info.metadata]
    return TypeAdapter(annotated)
