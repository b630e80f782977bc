"""The two kinds of error: what the user can fix, all of it at once, and a defect.

InputError("dt_s is -0.1; give a number of seconds above 0").parts[0].remedy
"give a number of seconds above 0"
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Problem:
    """An error that the user can fix."""

    found: str
    remedy: str = ""  # what would do; empty where `found` says it
    where: str = ""  # cell or sheet; empty where `found` begins with the location
    about: str = ""  # argument to change, such as units; empty where it is the file

    @classmethod
    def of(cls, line: str) -> Problem:
        """Return a problem that is written `what was found; what would do`."""
        fault, _, remedy = line.partition("; ")
        return cls(fault, remedy)

    def at(self, where: str, field: str = "") -> Problem:
        """Return the problem of a field at an address."""
        return Problem(f"{field} {self.found}".lstrip(), self.remedy, where)

    @property
    def text(self) -> str:
        """What was found and what would do."""
        return f"{self.found}; {self.remedy}" if self.remedy else self.found

    def __str__(self) -> str:
        return f"{self.where}: {self.text}" if self.where else self.text


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
