"""Where the example is that comes with the program: its workbook, and its records beside it."""

from __future__ import annotations

from pathlib import Path

_REPORT = Path(__file__).resolve().parents[2]
_HOMES = (_REPORT / "web" / "example", _REPORT.parent / "projects" / "example")
EXAMPLE = next(path for path in _HOMES if path.is_dir())
"""Within the package where it is installed, or of the checkout."""
