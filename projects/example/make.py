"""Makes the example that `roofslip new --example` copies: seven roof motions, and the workbook.

Run from the repository root: .venv/bin/python projects/example/make.py
"""

from __future__ import annotations

from pathlib import Path

from report.sheet.writing.example import project, suite, write_workbook
from report.sheet.writing.rows import write_motions

__all__ = ["project", "suite"]

if __name__ == "__main__":
    folder = Path(__file__).resolve().parent
    write_motions(folder / "records", "RM", suite())
    write_workbook(folder)
