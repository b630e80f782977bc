"""What every entity of the results has in common: a field says once how it is shown.

The value of a field is that of the attribute of the assessment with its name, or on the path that
`at` gives. Owns no entity. Read `Entity`.
"""

from __future__ import annotations

import ast
import inspect
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from itertools import pairwise
from typing import Annotated, Any, ClassVar, Self, TypeVar

from pydantic import (
    AliasPath,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    SerializerFunctionWrapHandler,
    WithJsonSchema,
    model_serializer,
)
from pydantic.json_schema import GenerateJsonSchema, SkipJsonSchema

from report.assessment.project import ChangeKind
from report.project.model import ProjectInput
from report.project.model.fields import Frozen
from report.project.workbook import SECTION, SECTIONS
from report.text.units import (
    NEWTONS_PER_POUND,
    NOISE,
    Quantity,
    Rounding,
    Show,
    Unit,
    measured,
    no_less,
    no_more,
    number,
    pair,
)
from solver.model import INCH_M

NO_VALUE = "none"


@dataclass(frozen=True, slots=True, kw_only=True)
class TableColumn:
    """A column: heading, unit below it, width in shares of the table, alignment, its field."""

    head: str
    unit: str = ""
    share: float = 1.0
    align: str = "right"
    field: str = ""


@dataclass(frozen=True, slots=True)
class UnitFormat:
    """Formats values, the preferred system of units first."""

    us_first: bool
    none: str = NO_VALUE
    # In which a table has a quantity: a narrow one has the first alone.
    systems: int = 2

    def both(
        self, value_si: float, quantity: Quantity = Quantity.DISPLACEMENT, show: Show = measured
    ) -> str:
        """Return `81.6 in (2072 mm)`; `none` for NaN."""
        return self.none if math.isnan(value_si) else pair(value_si, quantity, self.us_first, show)

    def short(
        self, value_si: float, quantity: Quantity = Quantity.DISPLACEMENT, show: Show = measured
    ) -> str:
        """Return a value with its unit in the preferred system; `none` for NaN."""
        unit = self.units(quantity)[0]
        return self.none if math.isnan(value_si) else f"{show(value_si, unit)} {unit.symbol}"

    def first(
        self,
        value_si: float,
        quantity: Quantity = Quantity.DISPLACEMENT,
        *,
        mark: str = "",
        show: Show = measured,
    ) -> str:
        """Return a value in the preferred system, without its unit; `none` for NaN."""
        return self.none if math.isnan(value_si) else show(value_si, self.units(quantity)[0]) + mark

    def units(self, quantity: Quantity = Quantity.DISPLACEMENT) -> tuple[Unit, Unit]:
        """Return the units of a quantity, the preferred one first."""
        return (quantity.us, quantity.si) if self.us_first else (quantity.si, quantity.us)


# What a value in SI is in the units of a sheet; a value in another unit stays as it is.
_FROM_SI: Mapping[str, Callable[[Any], Any]] = {
    "in": lambda value_m: value_m / INCH_M,
    "mm": lambda value_m: value_m * 1e3,
    "lb": lambda value_n: value_n / NEWTONS_PER_POUND,
    "in/s": lambda value_mps: value_mps / INCH_M,
}


# A cell as the package prints it; in Excel ROUNDUP rounds away from zero.
_ROUNDED_UP = (
    '=IF(ISTEXT({{{name}}}),"none",MAX(0,ROUNDUP({{{name}}}{times}-{noise:.0e},{decimals})))'
)


@dataclass(frozen=True, slots=True)
class Column:
    """A column of a sheet; a field may have several."""

    head: str = ""  # with its unit; the unit alone, or nothing, below the heading of the field
    decimals: int | None = None  # of a number; None to show it as it is
    # live, with names of fields of the row and of other cells in braces; empty for none
    formula: str = ""
    # returns what a cell holds of the value of the field, where the unit does not say it
    value: Callable[[Any], Any] | None = None
    is_always: bool = False  # whether the formula is written also where it gives no value
    is_input: bool = False  # whether what has no formula may be changed there
    # of what is shown: formulas take the exact value, from a column at the end of the row
    rounding: Rounding = Rounding.NEAREST

    def heading(self, of_field: str) -> str:
        """Return the heading, from that of the field where it has none of its own."""
        is_unit = not self.head or self.head.startswith("[")
        return f"{of_field} {self.head}".strip() if is_unit else self.head

    def held(self, value: Any) -> Any:
        """Return what a cell holds of the value of the field."""
        # By the unit in the heading, so that heading and number cannot differ.
        convert = self.value or _FROM_SI.get(self.unit)
        held = convert(value) if convert else value
        is_rounded = self.rounding is not Rounding.NEAREST
        return self.rounding.of(held, self.decimals or 0) if is_rounded else held

    @property
    def unit(self) -> str:
        """The unit in the heading."""
        return self.head.partition("[")[2].rstrip("]")

    def shown(self, name: str) -> Column:
        """Return it as a column that is rounded from the exact one of its field."""
        noise = NOISE / 10.0 ** (self.decimals or 0)
        times = "*25.4" if self.unit == "mm" else ""
        formula = _ROUNDED_UP.format(name=name, times=times, noise=noise, decimals=self.decimals)
        return replace(self, formula=formula)

    def exact(self, heading: str) -> Column:
        """Return the exact column of its field."""
        head, _, unit = heading.partition(" [")
        head = f"{head}, unrounded [{unit}" if unit else f"{head}, unrounded"
        return replace(self, head=head, decimals=None, rounding=Rounding.NEAREST)


up_column = partial(Column, rounding=Rounding.UP)
"""A column of a demand, or of what is required: rounded up."""


@dataclass(frozen=True, slots=True)
class Told:
    """A change of a field, which marks its row in the package and may be listed."""

    kind: ChangeKind | None = None  # None if it is not listed
    title: str = ""  # what changed, with what it says of the `row` in braces
    # whether it is listed of a row that the former revision did not have, or that is gone
    of_new: bool = True
    of_gone: bool = False


_Mark = TypeVar("_Mark")

Number = Annotated[
    float,
    BeforeValidator(lambda value: math.nan if value is None else value),
    WithJsonSchema({"type": ["number", "null"]}),
]
"""A number; NaN is none, which is null in JSON."""

_IF_GIVEN = Field(default=None, exclude_if=lambda value: value is None)
OfUnit = Annotated[int | Number, _IF_GIVEN]
"""A number whose key has the unit: of the keys that differ in it, one is given and written."""

RangeOfUnit = Annotated[tuple[Number, Number], _IF_GIVEN]
"""The ends of a range, likewise."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Shown:
    """How a field is shown: a quantity in both systems of units, or else as text."""

    head: str
    unit: str = ""
    quantity: Quantity | None = None
    text: Callable[[Any], str] = str
    align: str = "right"
    share: float = 1.0
    show: Show = measured  # how a quantity is rounded

    def units(self, fmt: UnitFormat) -> tuple[Unit, ...]:
        """Return the unit of its column, or of one for each system of units."""
        of_text = Unit(self.unit, 1.0, 0)
        return fmt.units(self.quantity)[: fmt.systems] if self.quantity else (of_text,)

    def columns(self, fmt: UnitFormat, head: str, share: float) -> tuple[TableColumn, ...]:
        """Return its column, or one for each system of units."""
        return tuple(
            TableColumn(head=head, unit=unit.symbol, align=self.align, share=share)
            for unit in self.units(fmt)
        )

    def cells(
        self, value: Any, none: str, units: Sequence[Unit], mark: str = "", show: Show | None = None
    ) -> list[str]:
        """Return a value for print in each of its units, or `none` for NaN."""
        if isinstance(value, float) and math.isnan(value):
            return [none] * len(units)
        # A text is shown as it is, also in place of a quantity.
        if isinstance(value, str) or not self.quantity:
            text = value if isinstance(value, str) else self.text(value)
            return [text + mark if mark else text] * len(units)
        cells, show = [], show or self.show
        for unit in units:
            cells.append(show(value, unit) + mark)
        return cells


def words(head: str, share: float = 1.0) -> Shown:
    """Return how a field of words is shown."""
    return Shown(head=head, align="left", share=share)


def length(head: str, share: float = 1.0, show: Show = measured) -> Shown:
    """Return how a displacement or a size is shown."""
    return Shown(head=head, quantity=Quantity.DISPLACEMENT, share=share, show=show)


required = partial(length, show=no_less)
"""How a length is shown that is required, or that a requirement follows from: rounded up."""

provided = partial(length, show=no_more)
"""How a length is shown that is provided: rounded down."""


def text(head: str, unit: str = "", share: float = 1.0) -> Shown:
    """Return how a finished text is shown, aligned as numbers are."""
    return Shown(head=head, unit=unit, share=share)


def plain(head: str, decimals: int = 2, unit: str = "", share: float = 1.0) -> Shown:
    """Return how a number is shown that is no quantity in two systems of units."""
    return Shown(head=head, unit=unit, text=partial(number, decimals=decimals), share=share)


def centered(head: str, share: float = 1.0) -> Shown:
    """Return how a verdict is shown."""
    return Shown(head=head, align="center", share=share)


def at(path: str) -> Any:
    """Return where the assessment has the value of a field: names of attributes, with dots."""
    return Field(validation_alias=AliasPath(*path.split(".")))


def printed(default: Any) -> Any:
    """Return a field that is shown, and not written to results.json."""
    return Field(default=default, exclude=True)


def unwritten(shown: Shown) -> Callable[[Callable[[Any], Any]], Any]:
    """Make a method a property that is shown, and not written to results.json."""

    def decorate(method: Callable[[Any], Any]) -> Any:
        # A property has no attributes of its own; its function does.
        method.shown = shown  # type: ignore[attr-defined]
        return property(method)

    return decorate


class Entity(BaseModel):
    """A row of the results: complete and frozen."""

    model_config = ConfigDict(frozen=True, from_attributes=True, validate_by_name=True)

    first: ClassVar[tuple[str, ...]] = ()
    """Fields that are written first: those of a base class would be."""
    across: ClassVar[str] = ""
    """Fields in the order of their columns on a sheet of results.xlsx; others follow."""
    key_columns: ClassVar[int] = 1
    """Columns there that say which row it is: they stay in sight, and stand on every page."""

    # what follows a value, by field: marks of provisions and overrides, the cause of a verdict
    marks: SkipJsonSchema[Mapping[str, str]] = Field(default_factory=dict, exclude=True)
    # rounding that keeps an order visible, by field
    rounds: SkipJsonSchema[Mapping[str, Show]] = Field(default_factory=dict, exclude=True)
    style: SkipJsonSchema[str] = Field(default="", exclude=True)  # of the row

    @classmethod
    def of(cls, item: object, **more: Any) -> Self:
        """Return the entity of an item, with what its attributes do not say."""
        return cls.model_validate(Beside(item, more))

    def styled(self, style: str) -> Self:
        """Return the entity as a row of a style."""
        return self.model_copy(update={"style": style}) if style else self

    @model_serializer(mode="wrap")
    def _in_order(self, write: SerializerFunctionWrapHandler) -> dict[str, Any]:
        # pydantic writes the fields of a base class first.
        written = write(self)
        return {name: written[name] for name in (*self.first, *written)}

    def both(self, name: str, fmt: UnitFormat) -> str:
        """Return a field in a sentence: a quantity in both systems of units."""
        return self._said(name, fmt, fmt.both)

    def short(self, name: str, fmt: UnitFormat) -> str:
        """Return a field where there is little room: a quantity in the preferred system."""
        return self._said(name, fmt, fmt.short)

    def _said(self, name: str, fmt: UnitFormat, said: Callable[..., str]) -> str:
        shown, value = shown_by(type(self), name), getattr(self, name)
        mark = self.marks.get(name, "")
        if not shown.quantity:
            return shown.cells(value, fmt.none, shown.units(fmt), mark)[0]
        text = said(value, shown.quantity, self.rounds.get(name, shown.show))
        # No value, no provision that it rests on: a mark would have nothing to mark.
        return text if math.isnan(value) else text + mark


def _title(said: object) -> str:
    match said:
        case Shown(head=title):
            return title
        case Column():
            return said.head.partition("[")[0].strip()
    return ""


class WrittenSchema(GenerateJsonSchema):
    """The JSON schema of what is written: without fields that are only printed."""

    def model_schema(self, schema: Any) -> dict[str, Any]:
        """Return the schema of a model, each field with its docstring or that of a base class."""
        written: dict[str, Any] = super().model_schema(schema)
        model = schema["cls"]
        if issubclass(model, Frozen):
            return _with_notes(written, model)
        for name in written["properties"]:
            if title := next(filter(None, map(_title, model.model_fields[name].metadata)), ""):
                written["properties"][name]["title"] = title
        # From the model to its bases: the docstring nearest to it holds.
        for base in model.__mro__[: model.__mro__.index(BaseModel)]:
            said = docstrings(base)
            for name in said.keys() & written["properties"].keys():
                written["properties"][name].setdefault("description", said[name])
        return written

    def field_is_present(self, field: Any) -> bool:
        """Return whether a field is written."""
        return not field.get("serialization_exclude")


def _with_notes(written: dict[str, Any], model: type[Frozen]) -> dict[str, Any]:
    """Return the schema of a model of the workbook with the headings and notes of its inputs."""
    if model is ProjectInput:
        for name, of in written["properties"].items():
            of["description"] = SECTION[name].note
    for section in SECTIONS:
        for entry in section.entries if section.model is model else ():
            of = written["properties"][entry.name]
            of["title"] = entry.heading
            of["description"] = entry.note
    return written


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


# Hides an attribute of an item: its field keeps the default.
LEFT_OUT = object()


class Beside:
    """The attributes of an item, and others beside them or in place of them."""

    def __init__(self, item: object, more: Mapping[str, Any]) -> None:
        self._item, self._more = item, more

    def __getattr__(self, name: str) -> Any:
        value = self._more[name] if name in self._more else getattr(self._item, name)
        # An attribute that is missing is what pydantic takes a default for.
        if value is LEFT_OUT:
            raise AttributeError(name)
        return value


@cache
def shown_by(model: type[Entity], name: str) -> Shown:
    """Return how a field of a model is shown."""
    fields = dict(marks_of(model, Shown))
    # What is not a field is a property of `unwritten`.
    shown: Shown = fields[name] if name in fields else getattr(model, name).fget.shown
    return shown


@cache
def marks_of(model: type[Entity], kind: type[_Mark]) -> tuple[tuple[str, _Mark], ...]:
    """Return the fields of a model with what they say of one kind: `Shown`, `Column`, `Told`."""
    # In the order of the sheet; a name keeps its first place.
    names = dict.fromkeys((*model.across.split(), *model.model_fields))
    return tuple(
        (name, item)
        for name in names
        for item in model.model_fields[name].metadata
        if isinstance(item, kind)
    )


@cache
def columns_of(
    model: type[Entity], *, has_formulas: bool = True
) -> tuple[tuple[str, str, Column], ...]:
    """Return the columns of a model on a sheet of results.xlsx: field, heading and the rest."""
    heads = {name: shown.head for name, shown in marks_of(model, Shown)}
    columns: list[tuple[str, str, Column]] = []
    exact: dict[str, tuple[str, str, Column]] = {}
    for name, item in marks_of(model, Column):
        heading = item.heading(heads.get(name, ""))
        if has_formulas and item.rounding is Rounding.UP:
            beside = item.exact(heading)
            exact.setdefault(name, (name, beside.head, beside))
            item = item.shown(name)
        columns.append((name, heading, item))
    return *columns, *exact.values()
