"""The base of all models of a project, and the types that their values have."""

from __future__ import annotations

import re
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field


class Frozen(BaseModel):
    """Base of all models: frozen, complete, finite."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, str_strip_whitespace=True
    )


MAX_TEXT = 2000

Text = Annotated[str, Field(max_length=MAX_TEXT)]
RequiredText = Annotated[str, Field(min_length=1, max_length=MAX_TEXT)]
Id = Annotated[str, Field(min_length=1, max_length=40)]
Positive = Annotated[float, Field(gt=0)]
NotNegative = Annotated[float, Field(ge=0)]

_DECIMAL = re.compile(r"[0-9]*\.[0-9]+")


def decimals(text: str) -> tuple[float, ...]:
    """Return the numbers of a list such as `0.40, 0.45`; empty if the text is not one."""
    # Each needs a decimal point, so that a decimal comma never splits one number into two.
    parts = [part.strip() for part in text.split(",")]
    return tuple(map(float, parts)) if all(map(_DECIMAL.fullmatch, parts)) else ()
