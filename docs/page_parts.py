"""Makes what calc-package.html has that is made beforehand: its fonts.

    .venv/bin/python docs/page_parts.py

The same fonts give the same bytes.
"""

from __future__ import annotations

import io
from pathlib import Path

from fontTools import subset
from fontTools.ttLib import TTFont

ROOT = Path(__file__).resolve().parents[1]
PARTS = ROOT / "templates" / "page-file"
FONTS = {"regular": "SourceSans3-Regular.ttf", "semibold": "SourceSans3-Semibold.ttf"}
# Of letters and signs of the package; of a name in other letters the browser has its own.
LETTERS = [*range(0x20, 0x7F), *range(0xA0, 0x100), *map(ord, "ΔΣθμπφ–—‘’“”†‡•…→←↑↓−≈≤≥×")]


def font(name: str) -> bytes:
    """Return a font of the package with its Latin letters alone."""
    whole = TTFont(ROOT / "templates" / "fonts" / name, recalcTimestamp=False)
    options = subset.Options(layout_features=["kern", "lnum", "tnum"], hinting=False)
    cut = subset.Subsetter(options)
    cut.populate(unicodes=LETTERS)
    cut.subset(whole)
    whole.flavor = "woff"
    out = io.BytesIO()
    whole.save(out)
    return out.getvalue()


if __name__ == "__main__":
    for part, name in FONTS.items():
        (PARTS / f"{part}.woff").write_bytes(font(name))
