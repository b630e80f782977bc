"""Motions added to a project: their records next to the workbook, and rows of Motions.

Read `row_cells`, then `other_sources`, which compares with suite.json.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING

from pydantic_core import from_json

from report.motions.record_reading import BAR
from report.project.check.finding_lines import lines
from report.project.check.motion_faults import GENERATED, LABELS
from report.project.model.finding import Finding, limit
from report.project.model.input_rows import Place
from report.project.read.archive import OpenBook
from report.project.read.cells import Found
from report.project.read.changed_cells import Value
from report.project.read.positions import CellPosition
from report.project.read.read import read
from report.project.read.workbook_data import Sheet
from report.project.write.filled import BEFORE, WorkbookChange, changing
from report.results.publish import STAMP, content, stamp
from solver.errors import InputError, Problem
from solver.file_checks import check_plain

if TYPE_CHECKING:
    from report.motions.sets import Sets

Row = Mapping[str, Value]
"""A motion by the fields of `report.project.model.MotionInput`; those not given stay blank."""


def row_cells(book: OpenBook, rows: Sequence[Row]) -> Mapping[CellPosition, Value]:
    """Return the cells of a workbook for further motions; existing rows are kept.

    The source of a row with the same generated records is updated.

    Raises `InputError` with each cell that has one of their IDs already, or if they have no room.
    """
    change = WorkbookChange(book)
    ids: list[Found] = []
    for row in rows:
        numbers = change.rows("motions", "id", str(row["id"]))
        # An ID that is taken by another motion: two with one name would be two rows of one ID,
        # which `check` refuses.
        if any(not _is_former(change, number, row) for number in numbers):
            ids += [change.cell("motions", number, "id") for number in numbers]
        elif numbers:
            change.put("motions", numbers[0], {"source": row["source"]})
        else:
            change.put("motions", change.added_row("motions"), row)
    if ids:
        remedy = "remove the row, or leave the motion out"
        raise InputError([Problem(f"has '{c.shown}' already", remedy, c.address) for c in ids])
    return change.cells


def _is_former(change: WorkbookChange, number: int, row: Row) -> bool:
    """Whether a row of a table lists the same motion of a suite generated before."""
    sources = change.cell("motions", number, "source").shown, str(row["source"])
    # Only of a generated motion: a row that an engineer gave a source is not written to.
    records = all(change.cell("motions", number, name).shown == row[name] for name in LABELS)
    return records and all(source.startswith(GENERATED) for source in sources)


def name_beside(book: OpenBook, path: Path) -> str:
    """Return the name of a file or folder in a workbook; it must be in the workbook's folder.

    Raises `InputError` if it is outside, also by a link, or has a mark in its name that separates
    something else.
    """
    home = book.path.parent.resolve()
    if not path.resolve().is_relative_to(home):
        raise InputError(f"{path}: is outside the workbook's folder; enter one within {home}")
    name = path.resolve().relative_to(home).as_posix()
    # A cell has the sheet of a workbook after "!", and a channel after the bar.
    if any(mark in name for mark in ("!", BAR)):
        raise InputError(f"{path}: has '!' or '{BAR}' in its name; rename it")
    return name


def suite_rows(book: OpenBook, folder: Path, count: int, source: str) -> list[Row]:
    """Return the rows of the motions of a suite that is to be written to a folder.

    Raises `InputError` if the folder is outside that of the workbook, or a motion of the suite is
    in it already.
    """
    prefix = name_beside(book, folder)
    rows: list[Row] = []
    for motion in (f"motion-{k:02d}" for k in range(1, count + 1)):
        cells = (motion, *(f"{prefix}/{motion}-{axis}.csv" for axis in "xyz"), source)
        rows.append(dict(zip(("id", *LABELS, "source"), cells, strict=True)))
    row_cells(book, rows)
    return rows


def add_suite(
    workbook: Path, folder: Path, rows: Sequence[Row], files: Mapping[str, bytes]
) -> WorkbookChange:
    """Write the files of a suite to a folder and its rows into a workbook: all of it or nothing.

    Raises `InputError` as `suite_rows`, of the workbook as it is now, or if something cannot be
    written.
    """
    with changing(workbook) as change:
        prefix = name_beside(change.book, folder)
        change.fill(row_cells(change.book, rows))
        # The stamp tells later that the files are of one suite, and complete.
        stamped = {**files, STAMP: stamp(files)}
        change.files |= {f"{prefix}/{name}": data for name, data in stamped.items()}
    return change


def set_rows(
    book: OpenBook, folder: Path, sets: Sets, about: Row
) -> tuple[list[Row], dict[str, bytes]]:
    """Return the rows of sets, and the files to copy into `records` beside the workbook.

    Files in its folder are not copied; `about` is the same for all motions.

    Raises `InputError` for each file in whose place another one is.
    """
    home = book.path.parent
    names: dict[str, str] = {}
    files: dict[str, bytes] = {}
    taken: list[str] = []
    candidates = chain.from_iterable(sets.values())
    for file in dict.fromkeys(candidate.file for candidate in candidates):
        source, target = folder / file, home / "records" / file
        if source.resolve().is_relative_to(home.resolve()):
            names[file] = name_beside(book, source)
            continue
        check_plain(target, home)
        names[file], content = name_beside(book, target), source.read_bytes()
        if not target.exists():
            files[names[file]] = content
        elif target.read_bytes() != content:
            taken.append(f"{target}: is another file than {source}; rename one")
    if taken:
        raise InputError(taken)
    rows: list[Row] = []
    for name, group in sets.items():
        # With ` | channel` behind the file, where it has several.
        cells = [names[channel.file] + channel.name.removeprefix(channel.file) for channel in group]
        # Two where there is no vertical record, which is the last of the labels.
        records = dict(zip(LABELS, cells, strict=False))
        rows.append({"id": name, **records, "source": f"{name}, {group[0].format}", **about})
    return rows, files


_STATED = re.compile(r"\b(seed|S_DS|z/h)\W+(\d+(?:\.\d+)?)")


def other_sources(sheet: Sheet) -> Iterator[Finding]:
    """Yield a warning for each motion whose source differs from the suite next to its records.

    A package does not have suite.json inside, and so not the warning.
    """
    for index, row in enumerate(sheet.inputs["motions"]):
        source = row.get("source") or ""
        stated = _source(sheet.path.parent / str(row.get("record") or "").replace("\\", "/"))
        if stated and _differs(source, stated):
            text = f"source is '{source}', but suite.json next to the records states '{stated}'"
            renew = "update it with motion suite --into, or correct it"
            yield limit(f"{text}; {renew}", Place("motions", index, "source"))


def said_near(folder: Path) -> Iterator[str]:
    """Yield the sources of `other_sources` as text, for workbooks in a folder and above it."""
    resolved = folder.resolve()
    # A suite is made in records/ or in a folder of it: the workbook is at most two above.
    workbooks: list[Path] = []
    for parent in (resolved, *resolved.parents[:2]):
        workbooks += parent.glob("*.xlsx")
    for path in sorted(workbooks):
        # The suite is written: a workbook beside it that cannot be read is told by the next
        # `check`.
        with suppress(InputError):
            sheet = read(path)
            sources = () if path.name.endswith(BEFORE) else other_sources(sheet)
            for line in lines(sources, sheet.addresses):
                yield f"{path}: {line.cell}: {line.text}"


def _source(record: Path) -> str:
    """Return what the suite beside a record is the source of it by; empty if it is of none."""
    try:
        suite = from_json(content(record.with_name("suite.json")))
        components = chain.from_iterable(motion["components"] for motion in suite["motions"])
        names = {component["file"] for component in components}
        return str(suite["source"]) if record.name in names else ""
    # A suite.json of another program, or cut off, states no source.
    except (ValueError, KeyError, TypeError):
        return ""


def _differs(source: str, stated: str) -> bool:
    """Whether a source is an earlier one, or states another number."""
    typed, made = dict(_STATED.findall(source)), dict(_STATED.findall(stated))
    # Rounded numbers in a source that was typed are the same: 0.5% is less than any two suites
    # differ by.
    return (source.startswith(GENERATED) and source != stated) or any(
        not math.isclose(float(typed[name]), float(made[name]), rel_tol=0.005)
        for name in typed.keys() & made
    )
