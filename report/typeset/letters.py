"""The characters of the fonts of a package: which can be drawn, and the width of a text.

Of `A1 屋` the last letter is in no font of a package; `A1 μ` has all of its letters.

Knows no page. Read `undrawable` first.
"""

from __future__ import annotations

import re
import subprocess
import sys
from functools import cache
from typing import TYPE_CHECKING

from report.libraries import has_font_on_windows
from report.project.read.workbook_data import Sheet
from report.typeset.pdf import TEMPLATES
from solver.errors import InputError, Problem

if TYPE_CHECKING:
    from matplotlib.ft2font import FT2Font

_LISTED = 5
# Label of the fields that figures are lettered with.
_ID = "ID"
# Every font of a package has them.
_SURE = re.compile(r"[\n\t\x20-\x7e\xa0-\xff]*")


def undrawable(text: str, *, is_in_figures: bool = False) -> str:
    """Return the characters of a text that are in no font of a package or of this machine."""
    if _SURE.fullmatch(text):
        return ""
    letters = dict.fromkeys(_SURE.sub("", text))
    # The figures use the fonts of a package alone.
    missing = [letter for letter in letters if ord(letter) not in _shipped()]
    return "".join(c for c in missing if is_in_figures or not _is_on_machine(c))


@cache
def _shipped() -> frozenset[int]:
    """Return the characters that are in every font of a package."""
    from fontTools.ttLib import TTFont  # 0.1 s, and most workbooks have plain letters alone

    paths = sorted((TEMPLATES / "fonts").glob("*.ttf"))
    # Each of them: a heading is set in another file than its text.
    return frozenset.intersection(*(frozenset(TTFont(path).getBestCmap()) for path in paths))


@cache
def _is_on_machine(letter: str) -> bool:
    """Whether fontconfig, which the renderer asks as well, knows a font with a letter."""
    if sys.platform == "win32":
        return has_font_on_windows(letter)
    try:
        fonts = subprocess.run(
            ["fc-list", f":charset={ord(letter):x}", "family"],
            capture_output=True,
            timeout=10.0,
            check=False,
        )
    # Without an answer the letter is refused: better than an empty box on a sealed page.
    except (OSError, subprocess.TimeoutExpired):
        return False
    return bool(fonts.stdout.strip())


def check_letters(sheet: Sheet) -> None:
    """Reject characters of a workbook that would be empty boxes in the package.

    Raises `InputError` with the cell of every text with such characters, and for the name of the
    workbook.
    """
    problems = []
    if missing := undrawable(sheet.path.name):
        fault = f"the file name: no font of this machine has {named(missing)}"
        problems.append(Problem(fault, "rename the workbook"))
    # By the echo: it has every text that is printed, with its cell.
    for row in sheet.echo:
        is_in_figures = row.label == _ID
        if missing := undrawable(row.typed, is_in_figures=is_in_figures):
            where, remedy = (
                ("the font of the figures does not have", "write it in other letters")
                if is_in_figures
                else ("no font of this machine has", "install one that does, or use other letters")
            )
            problems.append(Problem(f"{where} {named(missing)}", remedy, f"{row.sheet}!{row.cell}"))
    if problems:
        raise InputError(problems)


def named(letters: str) -> str:
    """Return the first few characters with their code points."""
    return ", ".join(f"{letter} (U+{ord(letter):04X})" for letter in letters[:_LISTED])


_PX = 144  # to an em


@cache
def width_em(text: str, *, is_bold: bool = False) -> float:
    """Return the width of a text in the font of a package, in its type size."""
    # Letter by letter, without kerning: a report of 300 arrays measures thousands of texts, and
    # laying each of them out took a fifth of its time.
    weight = "Semibold" if is_bold else "Regular"
    return sum(_advance_em(weight, letter) for letter in text)


@cache
def _advance_em(weight: str, letter: str) -> float:
    """Return how far a letter moves the next one, in the type size."""
    advance: float = _font(weight).load_char(ord(letter)).linearHoriAdvance
    return advance / 65536.0 / _PX


@cache
def _font(weight: str) -> FT2Font:
    from matplotlib.ft2font import FT2Font  # with matplotlib, which what only checks needs not

    font = FT2Font(TEMPLATES / "fonts" / f"SourceSans3-{weight}.ttf")
    font.set_size(_PX, 72.0)
    return font
