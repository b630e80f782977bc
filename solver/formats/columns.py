"""The type of the columns of a table by their numbers alone, without their headings.

`1 2 3` counts lines, `0.00 0.01 0.02` are times, and `0.1 -0.2 0.1` is a record.

One look for all readers and messages; knows no heading and no format. Read `rising`.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from solver.model import Floats

# No shaking rises from line to line. Fewer rows than `_FEW` show nothing; in `_MANY` a column need
# not rise evenly, as times of loggers do not.
_FEW, _MANY = 5, 12
_EVEN_WITHIN, _OFTEN, _NEARLY = 0.01, 0.1, 0.9  # of a step, of all steps
SIDE_BY_SIDE = "tables side by side; use only one of them"
_MAGNITUDE_WITHIN = 0.01  # of its peak: digits are printed apart


def rising(table: Floats) -> list[int]:
    """Indexes of the columns that increase from row to row; evenly, if there are few rows."""
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


def magnitudes(table: Floats, columns: Sequence[int], named: Sequence[int]) -> list[int]:
    """Those of some columns that are the length of the vector of the columns before them.

    By their numbers, the root of the sum of squares, or as their headings name them.
    """
    lengths: list[int] = []
    for i in columns:
        values = table[:, i]
        before = [k for k in columns if k != i and k not in lengths]
        # Loggers write the length behind two or three components, or behind all of them.
        vectors = [before[:count] for count in (2, 3, len(before)) if 1 < count <= len(before)]
        roots = (np.linalg.norm(table[:, vector], axis=1) for vector in vectors)
        within = _MAGNITUDE_WITHIN * values.max()
        if (
            values.min() >= 0.0
            and values.any()
            and (i in named or any(np.abs(values - root).max() <= within for root in roots))
        ):
            lengths.append(i)
    return lengths


def counting(table: Floats) -> list[int]:
    """Indexes of the columns that count the rows, as the numbers of cards do."""
    return [column for column in rising(table) if (np.diff(table[:, column]) == 1.0).all()]


def numbered(table: Floats) -> list[int]:
    """Indexes of the columns that number the lines: counting, or whole beside decimals."""
    counts = counting(table)
    is_whole = (table == np.rint(table)).all(axis=0)
    if len(table) < _FEW or is_whole.all():
        return counts
    # Numbers of cards may begin anew, or fall. A column may be zeros, before the shaking, and whole
    # times rise.
    is_number = is_whole & table.any(axis=0)
    is_number[[column for column in rising(table) if column not in counts]] = False
    return [int(column) for column in np.flatnonzero(is_number)]


def pairs(values: Floats, per_line: int) -> Floats | None:
    """Times and values, shape (n, 2), where nearly every second value across lines rises evenly."""
    # Two numbers per line are read as two columns.
    if per_line < 4 or per_line % 2 or values.size % 2 or values.size < 2 * _MANY:
        return None
    table = values.reshape(-1, 2)
    steps = np.diff(table[:, 0])
    usual = np.median(steps)
    is_usual = np.abs(steps - usual) <= _EVEN_WITHIN * usual
    # A gap, or a line that is there twice, is told with the times.
    return table if usual > 0.0 and is_usual.mean() > _NEARLY else None


def remedy(table: Floats) -> str:
    """Return the remedy for a table of two or more columns without headings."""
    heading = f"a heading such as time_s,x_g{',y_g' * (table.shape[1] > 2)}"
    if counts := numbered(table):
        which = ", ".join(str(column + 1) for column in counts)
        deletion = f"column {which} contains line numbers: delete it"
        if len(counts) > 1:
            deletion = f"columns {which} contain line numbers: delete them"
        # The advice must work: the remaining table is evaluated as it will be without those
        # columns.
        remaining = np.delete(table, counts, axis=1)
        then = remedy(remaining) if remaining.shape[1] > 1 else "enter the time step dt"
        return f"{deletion}; then {then}"
    if not (columns := rising(table)):
        return (
            f"enter {heading}, or put one on each line, or enter the values per line to motion"
            f" convert (--values-per-line {table.shape[1]})"
        )
    if same := [i for i in columns[1:] if np.array_equal(table[:, i], table[:, columns[0]])]:
        return f"columns {columns[0] + 1} and {same[0] + 1} are the same: {SIDE_BY_SIDE}"
    which = ", ".join(str(column + 1) for column in columns)
    # Numbers of lines may count by more than 1, and are whole.
    is_whole = bool((table[:, columns] == np.rint(table[:, columns])).all())
    noun, end = ("times or line numbers", "; delete line numbers") if is_whole else ("times", "")
    return (
        f"{noun} rise in column {which}: put each time first on a line with its values, below"
        f" {heading}{end}"
    )
