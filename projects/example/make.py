"""Makes the example that `roofslip new --example` makes: seven roof motions, and the workbook.

Run from the repository root: .venv/bin/python projects/example/make.py
"""

from __future__ import annotations

from pathlib import Path

from report.sheet.writing.example import project, suite, write_example

__all__ = ["project", "suite"]

if __name__ == "__main__":
    write_example(Path(__file__).resolve().parent)
