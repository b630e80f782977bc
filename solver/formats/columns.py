"""What the columns of a table without headings show: which of them rise as times and counts do.

No shaking rises from line to line. Reads no file. Read `rising`, then `remedy`.
"""

from __future__ import annotations

import numpy as np

from solver.model import Floats

# Fewer rows than `_FEW` show nothing; in `_MANY` a column need not rise evenly, as times of loggers
# do not.
_FEW, _MANY = 5, 12
_EVEN_WITHIN, _OFTEN = 0.01, 0.1  # of a step, of all steps

_ACROSS = (
    "put one on each line, or give the values per line to motion convert (--values-per-line {})"
)


def rising(table: Floats) -> list[int]:
    """Indexes of the columns that rise from row to row, evenly where there are few rows."""
    rows = len(table)
    if rows < _FEW:
        return []
    steps = np.diff(table, axis=0)
    usual = (table[-1] - table[0]) / (rows - 1)
    # Rounded times stand twice; zeros up to a last pulse are no times.
    rises = (steps >= 0.0).all(axis=0) & ((steps > 0.0).mean(axis=0) > _OFTEN)
    if rows < _MANY:
        rises &= np.abs(steps - usual).max(axis=0) <= _EVEN_WITHIN * usual
    return [int(column) for column in np.flatnonzero(rises)]


def remedy(table: Floats) -> str:
    """Return what would do for a table of two or more columns without headings."""
    heading = f"a heading such as time_s,x_g{',y_g' * (table.shape[1] > 2)}"
    if not (columns := rising(table)):
        return f"give {heading}, or {_ACROSS.format(table.shape[1])}"
    which = ", ".join(str(column + 1) for column in columns)
    return (
        f"times or line numbers rise in column {which}: put each time first on a line with its"
        f" values, below {heading}; delete line numbers"
    )
