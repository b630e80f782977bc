"""Errors as lines: equal ones of several cells are one."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from solver.errors import Problem

# Cells and ids named of equal errors and findings.
MOST_LISTED = 3


def grouped(problems: Iterable[Problem]) -> Iterable[Sequence[Problem]]:
    """Return problems in order; equal ones of a sheet together, where the first is."""
    alike: dict[tuple[str, str, int], list[Problem]] = {}
    for number, problem in enumerate(problems):
        sheet, has_cell, _ = problem.where.rpartition("!")
        # Without a cell nothing but its own line tells a problem: none is left out.
        alike.setdefault((sheet, problem.text, 0 if has_cell else number), []).append(problem)
    return alike.values()


def line_of(equal: Sequence[Problem]) -> str:
    """Return equal problems as one line, with their cells."""
    return str(replace(equal[0], where=listed(problem.where for problem in equal)))


def listed(names: Iterable[str], most: int = MOST_LISTED) -> str:
    """Return the first few of the names, with the count of the others."""
    unique = list(dict.fromkeys(names))
    n_more = len(unique) - most
    return ", ".join(unique[:most]) + (f" and {n_more:,} more" if n_more > 0 else "")
