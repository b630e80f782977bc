"""The two types of error: input errors, all reported at once, and internal errors.

`InputError("dt_s is -0.1; use a number of seconds above 0")` contains one problem; its remedy is
`use a number of seconds above 0`.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import islice

from solver.spaces import spaced

# Number of problems of one file or column that a message lists, and that it counts of the others.
_MAX_LISTED, _MAX_COUNTED = 10, 10_000


@dataclass(frozen=True, slots=True)
class Problem:
    """An error that the user can fix."""

    found: str
    remedy: str = ""  # what would do; empty where `found` says it
    where: str = ""  # cell or sheet; empty where `found` begins with the location
    about: str = ""  # argument to change, such as units; empty where it is the file

    @classmethod
    def of(cls, line: str) -> Problem:
        """Return the problem of a text `found; remedy`."""
        # Split at the first semicolon: the remedy may contain more.
        fault, _, remedy = line.partition("; ")
        return cls(fault, remedy)

    def at(self, where: str, field: str = "") -> Problem:
        """Return the problem of a field at an address."""
        return Problem(f"{field} {self.found}".lstrip(), self.remedy, where)

    @property
    def text(self) -> str:
        """What was found, and the remedy."""
        return f"{self.found}; {self.remedy}" if self.remedy else self.found

    def __str__(self) -> str:
        # For a terminal, a log or a program: none is set in lines.
        return spaced(f"{self.where}: {self.text}" if self.where else self.text)


class InputError(ValueError):
    """Errors that the user can fix: each with its location, what was found and what is accepted.

    Attributes
    ----------
    parts : tuple
        The problems, each with its place.
    problems : tuple of str
        One line for each problem.
    """

    def __init__(self, problems: str | Problem | Sequence[str | Problem]):
        listed = [problems] if isinstance(problems, (str, Problem)) else problems
        self.parts = tuple(Problem.of(part) if isinstance(part, str) else part for part in listed)
        self.problems = tuple(map(str, self.parts))
        super().__init__("\n".join(self.problems))


class DefectError(RuntimeError):
    """An internal error, which only the developers can fix: a state assumed impossible."""


def raise_any(problems: Iterable[str]) -> None:
    """Raise the first problems and the number of the others, if there are any."""
    remaining = iter(problems)
    listed = list(islice(remaining, _MAX_LISTED))
    if listed:
        # The others are counted but not stored, and only to a limit: a file may have millions.
        unlisted = sum(1 for _ in islice(remaining, _MAX_COUNTED + 1))
        words = f"{unlisted} more" if unlisted <= _MAX_COUNTED else f"more than {_MAX_COUNTED} more"
        raise InputError([*listed, f"... and {words}"] if unlisted else listed)
