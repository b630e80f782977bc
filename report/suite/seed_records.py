"""Records as seeds of a generated suite. Read `read_seeds`."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from report.motions.sets import VERTICAL
from solver.errors import InputError
from solver.formats import MotionFile, read_motion_file
from solver.records.record import Record


@dataclass(frozen=True, slots=True, kw_only=True)
class Seeds:
    """Records used as seeds of a suite."""

    # One group for each motion; a vertical record among three is last.
    groups: tuple[tuple[Record, ...], ...]
    sha256: Mapping[str, str]  # of each file
    notes: tuple[str, ...]  # remarks on how the files were read


def read_seeds(names: Sequence[str], *, units: str = "", dt_s: float = math.nan) -> Seeds:
    """Read the seed records: one motion for each name; a name may be files joined by commas.

    Raises `InputError` with the problems of every file.
    """
    groups: list[tuple[Record, ...]] = []
    files_by_path: dict[str, MotionFile] = {}
    problems: list[str] = []
    # A file may be named for several motions: it is read once.
    read = cache(read_motion_file)
    for name in names:
        # A file may have a comma in its name.
        paths = [Path(name)] if Path(name).exists() else [Path(part) for part in name.split(",")]
        try:
            files = {str(path): read(path, units=units, dt_s=dt_s) for path in paths}
            groups.append(_group(name, list(files.values())))
            files_by_path |= files
        except InputError as error:
            problems += error.problems
    if problems:
        raise InputError(problems)
    sha256: dict[str, str] = {}
    notes: list[str] = []
    for path, file in files_by_path.items():
        sha256[path] = hashlib.sha256(file.content).hexdigest()
        notes += [f"{path}: {note}" for note in file.notes]
    return Seeds(groups=tuple(groups), sha256=sha256, notes=tuple(notes))


def _group(name: str, files: Sequence[MotionFile]) -> tuple[Record, ...]:
    """Return the channels of all files with the file names; a vertical among three is last."""
    group: list[Record] = []
    verticals: list[int] = []
    for file in files:
        for record in file.channels:
            is_named_by_file = record.name == file.name
            if VERTICAL.search(Path(file.name).stem if is_named_by_file else record.name):
                verticals.append(len(group))
            name_of_both = f"{file.name}, {record.name}"
            group.append(record if is_named_by_file else replace(record, name=name_of_both))
    if len(group) > 3:
        raise InputError(
            f"{name}: has {len(group)} channels; enter one, two or three for each motion "
            "(to extract a channel: roofslip motion convert --help)"
        )
    # The generator takes x, y and z in this order.
    if len(group) == 3 and len(verticals) == 1:
        group.append(group.pop(verticals[0]))
    return tuple(group)
