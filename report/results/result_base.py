"""Base of the rows of results.json: frozen, NaN as null, with the units of print."""

from __future__ import annotations

import math
from typing import Annotated

from pydantic import BaseModel, BeforeValidator, ConfigDict, PlainSerializer, WithJsonSchema

from solver.spaces import spaced

# JSON has no NaN: `json.dumps` would write one that no other program reads.
Number = Annotated[
    float,
    BeforeValidator(lambda value: math.nan if value is None else value),
    WithJsonSchema({"type": ["number", "null"]}),
]
"""A number; NaN is none, which is null in JSON."""

Words = Annotated[str, PlainSerializer(spaced)]
"""A text that the program composes, unlike names and notes of the workbook."""


class ResultModel(BaseModel):
    """A row of the results: complete and frozen."""

    model_config = ConfigDict(frozen=True)


class LengthUnitResult(ResultModel):
    """A unit of length as it is printed."""

    symbol: str
    size_m: float
    """Its length."""
    decimals: int
    """Decimals that are printed."""


class PrintedResult(ResultModel):
    """How numbers are printed."""

    lengths: tuple[LengthUnitResult, ...]
    """Units of displacements and separations, the preferred unit first."""
    ratio_decimals: int
    """Decimals of a ratio."""
    rounded_up: tuple[str, ...]
    """Keys of required values and demands, which are rounded up."""
    rounded_down: tuple[str, ...]
    """Keys of provided values, which are rounded down; all other keys to the nearest."""
