"""A workbook as data, with every problem found in it. Read `SheetOf`."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Set
from dataclasses import dataclass, fields, replace
from functools import cached_property
from pathlib import Path
from typing import Any, Generic, Self, TypeVar

from pydantic import ValidationError

from report.project.check.faults import faults
from report.project.model import ProjectInput
from report.project.model.finding import Finding
from report.project.model.input_rows import Inputs, Place, Where
from report.project.model.values import Frozen
from report.project.read.archive import OpenBook
from report.project.read.documents import Document
from report.project.read.unseen import Unseen
from report.project.workbook.entries import SheetSection
from solver.errors import InputError, Problem


@dataclass(frozen=True, slots=True, kw_only=True)
class EchoRow:
    """One cell as read, as finished text."""

    sheet: str
    cell: str
    label: str
    typed: str  # for a formula, with its value when the workbook was saved
    unit: str  # as typed
    value: str  # as used; in SI if the unit can be chosen
    unseen: str = ""  # how the workbook keeps the cell from sight, such as `hidden`

    @property
    def address(self) -> str:
        """Its address: `Arrays!D7`."""
        return f"{self.sheet}!{self.cell}"


IGNORED = "not an input, ignored"
"""How the echo shows a cell under a heading that is not known."""


@dataclass(frozen=True, slots=True, kw_only=True)
class WorkbookSource:
    """Data in a package on the workbook that a project was read from."""

    path: Path
    sha256: str  # of the workbook
    addresses: Mapping[Place, str]
    documents: tuple[Document, ...] = ()  # beside it, that the package attaches
    echo: tuple[EchoRow, ...]  # every field, sheet by sheet and row by row
    unseen: tuple[Unseen, ...]
    warnings: tuple[Finding, ...]  # on sheets that are ignored, and values that may be former ones


Whole = TypeVar("Whole", bound=Frozen)


@dataclass(frozen=True, kw_only=True)
class SheetOf(WorkbookSource, Generic[Whole]):
    """A workbook as data, with every problem found in it."""

    book: OpenBook  # for columns pasted into it and files beside it
    whole: type[Whole]  # what it is the input of
    sections: tuple[SheetSection, ...]  # of that
    inputs: Inputs
    problems: tuple[tuple[Place, Problem], ...]
    unfound: frozenset[str]  # sections
    check: Callable[[Inputs, Where], Iterable[Finding]] = faults

    @cached_property
    def project(self) -> Whole:
        """The input; raises `InputError` with every problem and its cell."""
        self.refuse(())
        parts: dict[str, Any] = {}
        for part in self.sections:
            # Each value was validated when its cell was read, and all together by `check`.
            rows = tuple(part.model.model_construct(**row) for row in self.inputs[part.key])
            parts[part.key] = rows if part.is_table else rows[0]
        return self.whole.model_validate(parts)

    @property
    def source(self) -> WorkbookSource:
        """Data in a package on the workbook, without its file and its inputs."""
        return WorkbookSource(
            **{key.name: getattr(self, key.name) for key in fields(WorkbookSource)}
        )

    @cached_property
    def units(self) -> Mapping[str, str]:
        """Unit of each cell as typed, by address; empty for none."""
        return {row.address: row.unit for row in self.echo}

    def with_(self, **parts: Frozen | Iterable[Frozen]) -> Self:
        """Return the same with other inputs, checked as those of a workbook.

        Parameters
        ----------
        **parts : Frozen or iterable of Frozen
            Fields of `project`: a block, or all rows of a table, such as
            `arrays=[row.model_copy(update={"mu": 0.4}) for row in workbook.project.arrays]`.

        Raises
        ------
        InputError
            For a part or a value not permitted in a workbook, and for each problem of this one.
        """
        self.refuse(())
        sections, inputs = {part.key: part for part in self.sections}, dict(self.inputs)
        if unknown := [key for key in parts if key not in sections]:
            raise InputError(
                f"unknown input {', '.join(unknown)}; choose from {', '.join(sections)}"
            )
        for key, replaced in parts.items():
            rows = [replaced] if isinstance(replaced, Frozen) else list(replaced)
            try:
                # `model_copy`, with which rows are mostly changed, validates nothing.
                checked = [sections[key].model.model_validate(dict(row)) for row in rows]
            except ValidationError as error:
                wrong = (
                    f"{key}: {'.'.join(map(str, e['loc']))}: {e['msg']}" for e in error.errors()
                )
                raise InputError(list(wrong)) from error
            names = [entry.name for entry in sections[key].entries]
            inputs[key] = [{name: getattr(row, name) for name in names} for row in checked]
        problems = located_problems(self.check(inputs, self.where), self.addresses, self.unfound)
        changed = replace(self, inputs=inputs, problems=tuple(problems))
        changed.refuse(())
        return changed

    def where(self, place: Place) -> str:
        """Return the address of a place; that of its table or sheet if it has no cell."""
        return where(self.addresses, place)

    def refuse(self, faults: Iterable[Finding]) -> None:
        """Raise InputError with all problems and further faults, in order, each once, if any."""
        problems = [*self.problems, *located_problems(faults, self.addresses, self.unfound)]
        order = {part.key: count for count, part in enumerate(self.sections)}
        names = {part.key: [entry.name for entry in part.entries] for part in self.sections}

        def rank(problem: tuple[Place, Problem]) -> tuple[int, int, int]:
            section, row, field = problem[0]
            columns = names[section]
            return order[section], row, columns.index(field) if field in columns else -1

        if problems:
            raise InputError(
                list(dict.fromkeys(problem for _, problem in sorted(problems, key=rank)))
            )


Sheet = SheetOf[ProjectInput]
"""The input workbook of a project as data."""


def where(addresses: Mapping[Place, str], place: Place) -> str:
    """Return the address of a place; that of its table or sheet if it has no cell."""
    table = addresses.get(Place(place.section), place.section)
    return addresses.get(place, table)


# Tables that name rows of others: without these every name would be unknown.
_SOURCES = {
    "clearances": {"arrays", "objects"},
    "links": {"arrays"},
    "study_arrays": {"mats"},
    "friction_runs": {"mats"},
}


def located_problems(
    faults: Iterable[Finding], addresses: Mapping[Place, str], unfound: Set[str]
) -> Iterator[tuple[Place, Problem]]:
    """Yield faults with their addresses, except those that only follow from a missing table."""
    for fault in faults:
        place = fault.place
        if place.section not in unfound and not _SOURCES.get(place.section, set()) & unfound:
            yield place, fault.problem(where(addresses, place))
