"""Number formats of cells: digits shown, and unit."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache

# No repetition can be matched in two ways: a code takes time as its length.
_PARTS = re.compile(
    r'"(?P<quoted>[^"]*)(?:"|$)|\\(?P<escaped>.)|(?P<space>[_*].)|\[\$(?P<currency>[^\]-]*+)[^\]]{0,255}\]'
    r"|\[[^\]]{0,255}\]|(?P<end>;)|(?P<general>General)|(?P<digits>[0#?.,%@]|E[+-])|(?P<other>.)",
    re.IGNORECASE | re.DOTALL,
)
_LONGEST = 255  # characters that Excel allows in a format code (specifications and limits)

# Each comma behind the last digit divides what is shown by 1,000.
_SCALE = re.compile(r"[0#?](,+)(?![0#?,])")
_WORDS = re.compile(r"[^\s()\[\]{},;:=]+")
_SINGLE = re.compile(r"([^\d^]+?)\^?([23]?)")

_NAMES = {
    "in": ("inch", "inches", '"', "″", "”"),
    "ft": ("foot", "feet", "'", "′", "’"),
    "yd": ("yard", "yards"),
    "mm": ("millimeter", "millimeters", "millimetre", "millimetres"),
    "cm": ("centimeter", "centimeters", "centimetre", "centimetres"),
    "m": ("meter", "meters", "metre", "metres"),
    "km": ("kilometer", "kilometers", "kilometre", "kilometres"),
    "mi": ("mile", "miles"),
    "lb": ("lbs", "lbf", "pound", "pounds"),
    "kip": ("kips", "k"),
    "N": ("newton", "newtons"),
    "kg": ("kgf", "kilogram", "kilograms"),
    "t": ("ton", "tons", "tonne", "tonnes"),
    "s": ("sec", "secs", "second", "seconds"),
    "ms": ("msec",),
    "min": ("minute", "minutes"),
    "rad": ("radian", "radians"),
    "deg": ("°", "º", "degree", "degrees"),
    "%": ("percent", "pct"),
    "cm/s2": ("gal",),
    **dict.fromkeys(("kN", "MN", "psf", "psi", "ksi", "Pa", "kPa", "MPa", "plf", "Hz", "g"), ()),
}
_UNITS: dict[str, str] = {}
for _unit, _others in _NAMES.items():
    for _name in (_unit, *_others):
        _UNITS[_name if len(_name) == 1 else _name.casefold()] = _unit
_ALSO_A_WORD = frozenset(("min", "k"))  # a minimum, thousands


@dataclass(frozen=True, slots=True)
class _Section:
    """One of the sections of a format code: its digits, and the text that it adds."""

    digits: str
    text: str


def misleading(code: str, unit: str) -> str:
    """Return how a format misrepresents a number, such as `in mm`; empty for its own unit."""
    # The fourth section is that of text.
    return next(filter(None, (_misleading(part, unit) for part in _sections(code)[:3])), "")


def is_percentage(code: str) -> bool:
    """Whether a format shows 0.05 as 5%."""
    return any("%" in section.digits for section in _sections(code))


def shows_nothing(code: str, value: object) -> bool:
    """Whether a format shows no digit of a number, or none of a text."""
    sections = _sections(code)
    if isinstance(value, str):
        return len(sections) > 3 and "@" not in sections[3].digits
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    # Excel takes the first section for all numbers if it is alone, else the second one for those
    # below 0 (ECMA-376-1, 18.8.31).
    by_sign = 0 if value > 0 or len(sections) == 1 else 1
    if value == 0:
        by_sign = 2 if len(sections) > 2 else 0
    return not re.search("[0#?@]", sections[by_sign].digits)


def _misleading(section: _Section, unit: str) -> str:
    # 0.0, shows 45,000 as 45.0: the engineer sees another number than is used.
    if scale := _SCALE.search(section.digits):
        return f"divided by {1000 ** len(scale[1]):,}" if len(scale[1]) < 5 else "divided"
    unit_of_column, named = unit_named(unit) or unit, []
    for word in _WORDS.findall(section.text):
        bare = word.strip(".-–+~&!<>$_") or word
        symbol = unit_named(bare)
        if symbol and bare.casefold() not in _ALSO_A_WORD:
            named.append((bare, symbol))
    if not named or unit_of_column in (name for _, name in named):
        return ""
    return f"in {named[0][0]}"


@lru_cache(maxsize=256)
def unit_named(word: str) -> str:
    """Return the symbol of a unit from any of its names; empty if it is not a unit."""
    plain = word.replace("²", "2").replace("³", "3")
    parts = [_single(part) for part in re.split(r"[/·*-]", plain)]
    return "/".join(parts) if all(parts) else ""


def _single(part: str) -> str:
    match = _SINGLE.fullmatch(part.strip("."))
    if match is None:
        return ""
    # Of one letter the case counts: g is no G.
    name = match[1] if len(match[1]) == 1 else match[1].casefold()
    unit = _UNITS.get(name, "")
    return f"{unit}{match[2]}" if unit else ""


# A workbook has few formats, and many cells of each.
@lru_cache(maxsize=65_536)
def _sections(code: str) -> tuple[_Section, ...]:
    """Return the sections of a format code: of numbers above, below and equal to 0, and of text."""
    sections, digits, text = [], "", ""
    for match in _PARTS.finditer(code[:_LONGEST] or "General"):
        kind = match.lastgroup
        match kind:
            case "end":
                sections.append(_Section(digits, text))
                digits, text = "", ""
            case "digits":
                digits += match[0]
            case "general":
                digits += "0"
            case "space":
                text += " "
            case "quoted" | "escaped" | "currency" | "other":
                text += match[kind]
    return (*sections, _Section(digits, text))
