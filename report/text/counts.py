"""Counts and lists in sentences: counts are spelled out up to nine, in digits beyond.

Long names of arrays, objects and motions, in lines.

Greek letters for their names (the solver writes `mu`, a page prints μ); superscripts.

How the reader calls the program: `roofslip`, or the launcher's path such as `./roofslip`.
"""

from __future__ import annotations

import math
import os
import re
import shlex
import sys
import textwrap
import unicodedata
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar

_Item = TypeVar("_Item")
_Key = TypeVar("_Key", bound=Hashable)

_WORDS = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine")


def spelled(count: int) -> str:
    """Return a count in words up to nine, such as `three`, and in digits beyond; `no` for 0."""
    return _WORDS[count] if count < len(_WORDS) else str(count)


def counted(count: int, noun: str) -> str:
    """Return a number of things, such as `one array`, `three arrays` or `12 arrays`."""
    return f"{spelled(count)} {noun}" if count == 1 else f"{spelled(count)} {noun}s"


def numbered(count: int, noun: str) -> str:
    """Return the same in digits, such as `1 problem` or `3 problems`."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def capitalized(text: str) -> str:
    """Return a text with its first letter in upper case, the rest as it is."""
    return text[:1].upper() + text[1:]


def lowered(text: str) -> str:
    """Return a text with its first letter in lower case, as within a sentence."""
    return text[:1].lower() + text[1:]


def joined(names: Sequence[str]) -> str:
    """Return `a, b and c`."""
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last


def grouped_by(items: Iterable[_Item], key: Callable[[_Item], _Key]) -> Mapping[_Key, list[_Item]]:
    """Return items in groups of one key, in the order of their first items."""
    groups: dict[_Key, list[_Item]] = {}
    for item in items:
        groups.setdefault(key(item), []).append(item)
    return groups


def ids_by(items: Iterable[Any], key: Callable[[Any], _Key]) -> Mapping[_Key, list[str]]:
    """Return the same of items with an id, each by that."""
    groups = grouped_by(items, key).items()
    return {value: [item.id for item in alike] for value, alike in groups}


def ranged(names: Iterable[str]) -> str:
    """Return names, each once and sorted, three or more that count on as one: `A1 to A6, A9`."""
    runs: list[list[tuple[str, int, str]]] = []
    for stem, number, name in sorted(set(map(name_order, names))):
        if runs and runs[-1][-1][:2] == (stem, number - 1):
            runs[-1].append((stem, number, name))
        else:
            runs.append([(stem, number, name)])
    own = ([name for *_, name in run] for run in runs)
    return ", ".join(f"{run[0]} to {run[-1]}" if len(run) > 2 else ", ".join(run) for run in own)


def name_order(name: str) -> tuple[str, int, str]:
    """Return what is before the number at the end of a name, the number, and the name."""
    stem = name.rstrip("0123456789")
    # Without a number -2, not -1: A and A0 do not count on.
    return stem, int(name[len(stem) :] or -2), name


def named(names: Sequence[str], noun: str) -> str:
    """Return names with their noun before them: `array A9`, `arrays A1 to A6`."""
    return f"{noun}{'' if len(names) == 1 else 's'} {ranged(names)}"


# Letters of a name on one line of a drawing or a chart.
LONGEST = 24


def name_lines(name: str, longest: int = LONGEST) -> list[str]:
    """Return the lines of a name: one, or as many as a long one needs."""
    return textwrap.wrap(name, longest)


# Control characters, those that separate lines or change the direction of a text, and what XML
# does not allow.
UNPRINTABLE = re.compile(
    r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u2028-\u202e\u2066-\u2069\ud800-\udfff\ufffe\uffff]"
)

# Characters of a cell or a name that a message shows.
SHOWN = 60

_UNSEEN = "".join(filter(str.isspace, map(chr, range(0x3001)))) + (
    "\u00ad\u200b\u200c\u200d\u200e\u200f\u2060\u2061\u2062\u2063\u2064\ufeff"
)

# Cyrillic and Greek letters that look like Latin ones.
_ALIKE = str.maketrans(
    "АВЕЅІЈКМНОРСТУХаеѕіјорсухΑΒΕΖΗΙΚΜΝΟΡΤΥΧο", "ABESIJKMHOPCTYXaesijopcyxABEZHIKMNOPTYXo"
)

_LETTERS = {
    "mu": "μ", "theta": "θ", "phi": "φ", "omega": "ω", "eta": "η", "gamma": "γ", "beta": "β",
    "zeta": "ζ", "sigma": "σ", "pi": "π",
}  # fmt: skip
_NAMES = re.compile(rf"\b({'|'.join(_LETTERS)})\b")

_SIGNS = {"^2": "²", "m/s2": "m/s²", "v0": "v₀", "sqrt(": "√(", ">=": "≥", " - ": " − "}

_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def cut(text: str, maximum: int = SHOWN) -> str:
    """Return a text on one line, shortened."""
    # A cell may hold what would move the cursor or turn the direction of the line.
    text = UNPRINTABLE.sub("?", text).replace("\n", " ")
    return text if len(text) <= maximum else f"{text[: maximum - 1]}…"


def looks(name: str) -> str:
    """Return a name as it looks, whatever its alphabet and capitals are."""
    return name.translate(_ALIKE).casefold()


def foreign_letters(text: str) -> str:
    """Return which letters of a text only look Latin, with their alphabets; empty for none."""
    foreign = dict.fromkeys(letter for letter in text if ord(letter) in _ALIKE)
    said = (
        f"'{letter}' is a {unicodedata.name(letter).split()[0].capitalize()} letter"
        for letter in foreign
    )
    return ", ".join(said)


def power_of_ten(exponent: int) -> str:
    """Return `10⁻¹⁵` for -15."""
    return f"10{str(exponent).translate(_RAISED)}"


def power_above(value: float) -> str:
    """Return a power of ten above a value."""
    # The digits of a rounding error depend on the machine, and golden texts on none.
    return power_of_ten(math.floor(math.log10(value)) + 1)


def below_mm(error_m: float) -> str:
    """Return the power of ten above an error, in mm."""
    return f"{power_above(1e3 * error_m)} mm" if error_m else "rounding error"


def lettered(text: str) -> str:
    """Return a text with Greek letters, root signs, superscript twos and true minus signs."""
    named = _NAMES.sub(lambda match: _LETTERS[match[1]], text)
    for plain, set_well in _SIGNS.items():
        named = named.replace(plain, set_well)
    # A hyphen within a word or an option, such as --json, stays one.
    return re.sub(r"(?<![\w-])-(?=[\w.])", "−", named)


def trimmed(text: str) -> str:
    """Return a text without spaces and characters of no width at its ends."""
    return text.strip(_UNSEEN)


# The name in lower case before a word is a command; the product is Roofslip.
_COMMAND = re.compile(r"(?<![\w./-])roofslip(?= [a-z])")

# No shell of Windows takes it apart.
_PLAIN = re.compile(r"[\w.:\\/+-]+")


def called() -> str:
    """Return the program as the reader typed it, which the launcher passes on."""
    return quoted(os.environ.get("ROOFSLIP_COMMAND") or "roofslip")


def quoted(word: object) -> str:
    """Return a word as the shell takes it; on Windows, as both cmd and PowerShell do."""
    if str(word).startswith("-"):  # a path: it would be taken for options
        word = os.path.join(".", str(word))
    if sys.platform == "win32":
        return str(word) if _PLAIN.fullmatch(str(word)) else f'"{word}"'
    return shlex.quote(str(word))


def command(words: str, path: Path) -> str:
    """Return a command on a path, as it can be pasted into a shell."""
    return f"{called()} {words} {quoted(path)}"


def as_typed(text: str) -> str:
    """Return a text whose commands begin as the reader's own."""
    return _COMMAND.sub(lambda _: called(), text)
