"""Names of acceleration units as printed in files.

Contains their spellings and values. Read `unit_size` first.
"""

from __future__ import annotations

import math
import re

from solver.model import INCH_M
from solver.records.record import UNITS

UNIT_CHOICES = (*UNITS, "gal")
"""Units that a caller may give for a file that does not state its units."""

_G_MPS2 = UNITS["g"]

# COSMOS V1.20 has in/s2 and milli-g too (table 2); g/10 is CSMIP's volume 1.
_SIZES = UNITS | {
    "gal": 0.01,
    "g/10": _G_MPS2 / 10.0,
    "%g": _G_MPS2 / 100.0,
    "mg": _G_MPS2 / 1000.0,
    "ft/s2": 0.3048,
    "in/s2": INCH_M,
}

_LENGTHS = "mm|cm|m|ft|in"
_NOT_ACCELERATION = re.compile(rf"({_LENGTHS})(/s)?|[a-z]+/s2", re.ASCII)


def unit_size(text: str) -> float:
    """Value [m/s2] of a unit in any of its spellings; NaN if it is not a unit of acceleration."""
    return _SIZES.get(_plain(text), math.nan)


def is_other_unit(text: str) -> bool:
    """Whether the text is a unit of length, of velocity, or of an acceleration not known here."""
    return bool(_NOT_ACCELERATION.fullmatch(_plain(text)))


def _plain(text: str) -> str:
    """Normalize: `CM/SEC/SEC`, `cm/s**2`, `cm s^-2`, `cmps2` and `cm/s²` become `cm/s2`."""
    plain = re.sub(r"[\s^*·]", "", text.lower()).replace("²", "2").replace("⁻", "-")
    plain = re.sub(r"sec(onds?)?", "s", plain).replace("s/s", "s2").replace("gals", "gal")
    return re.sub(rf"^({_LENGTHS})(?:[p_/]s-?2|s-2)$", r"\1/s2", plain)
