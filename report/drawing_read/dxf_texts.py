"""The texts of a drawing: their lines, attributes of blocks, and names that `report` wrote."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import Any

from ezdxf.lldxf.encoding import decode_dxf_unicode
from ezdxf.tools.text import plain_mtext, plain_text

from report.drawing.plan_dxf import APPLICATION
from report.text.typed_letters import UNPRINTABLE, trimmed

_HEIGHTS = ("HT", "HGT", "HEIGHT", "EL", "ELEV", "ELEVATION")

# `%%034` is a quotation mark.
_LETTER = re.compile(r"%%(0[3-9]\d|1[01]\d|12[0-6])", re.ASCII)
# A code of a text of lines, with what it stacks: one above the other, with or without a line.
_STACKED = re.compile(r"\\(?:S((?:\\.|[^;\\])*);?|.)", re.DOTALL)
# A text that is struck through, up to the next code or bracket.
_STRUCK = re.compile(r"(?<!\\)\\K[^\\{}]*")
_STACKS, _ESCAPED = re.compile(r"(?<!\\)[\^/#]"), re.compile(r"\\([\^/#;])")


@lru_cache(maxsize=1024)  # thousands of entities are on a few layers
def printable(text: object) -> str:
    """Return a text of the drawing without unprintable characters."""
    return trimmed(UNPRINTABLE.sub("", str(text)))


def lines_of_text(entity: Any) -> list[str]:
    """Return the lines of a text or an attribute that are not blank."""
    if entity.dxftype() == "ATTRIB" and entity.has_embedded_mtext_entity:
        entity = entity.virtual_mtext_entity()
    is_mtext = entity.dxftype() == "MTEXT"
    written = decode_dxf_unicode(entity.text if is_mtext else entity.dxf.text)
    written = _LETTER.sub(lambda code: chr(int(code[1])), written)
    # What the library calls fast takes a time that grows as the square of the length.
    texts = (
        plain_mtext(_STACKED.sub(_fraction, _STRUCK.sub("", written)), split=True)
        if is_mtext
        else [plain_text(written)]
    )
    lines = (" ".join(printable(text).split()) for text in texts)
    return [line for line in lines if line]


def _fraction(code: re.Match[str]) -> str:
    """Return a stacked fraction behind a blank, and any other code as it is."""
    if code[1] is None:
        return code[0]
    parts = (_ESCAPED.sub(r"\1", part).strip() for part in _STACKS.split(code[1], maxsplit=1))
    return f" {'/'.join(filter(None, parts))}"


def attributes(insert: Any) -> tuple[str, tuple[str, ...]]:
    """Return the content of the attributes of a block: its name, and heights with their tags."""
    values = {str(a.dxf.tag).casefold(): next(iter(lines_of_text(a)), "") for a in insert.attribs}
    texts = [values.pop(tag.casefold(), "") for tag in _HEIGHTS]
    heights = tuple(f"{tag} {text}" for tag, text in zip(_HEIGHTS, texts, strict=True) if text)
    # The only other one is the name, whatever its tag is.
    only = next(iter(values.values())) if len(values) == 1 else ""
    named = filter(None, map(values.get, ("name", "id", "tag", "mark")))
    return next(named, only), heights


def name_by_report(entity: Any) -> str:
    """Return the name that `report` wrote with a line or a text."""
    if not entity.has_xdata(APPLICATION):
        return ""
    tags = entity.get_xdata(APPLICATION)
    return next((printable(tag.value) for tag in tags if tag.code == 1000), "")
