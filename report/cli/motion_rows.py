"""Lists the motions of a folder or zip, and adds them to the sheet Motions of a workbook."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fnmatch import fnmatchcase
from pathlib import Path
from tempfile import TemporaryDirectory

from report.cli.console import say, say_next
from report.cli.input_errors import input_errors
from report.motions.sets import sets_of, table
from report.motions.stored import unpack
from report.project.write.filled import changing
from report.results.added_motions import row_cells, set_rows
from report.text.counts import numbered
from solver.errors import InputError


def add_motions(
    source: Path,
    project: Path | None,
    *,
    recorded_at: str | None,
    only: Sequence[str],
    without_vertical: bool,
    units: str | None,
    dt_s: float,
) -> None:
    """Print the sets of records of a folder or zip; add them to the workbook, if one is given."""
    with input_errors(source), TemporaryDirectory() as temporary:
        # A default would be wrong in silence: ground motions go through the building.
        if project and not recorded_at:
            raise InputError(
                "--at is missing; use --at roof or --at ground, depending on where they were"
                " recorded"
            )
        folder, name_of_all = source, ""
        if not folder.is_dir():
            # The name of a zip is that of motions, and never of a folder: it may be "..".
            folder, name_of_all = Path(temporary), source.stem
            unpack(source, folder)
        sets, refused = sets_of(
            folder, units or "", dt_s, name_of_all=name_of_all, without_vertical=without_vertical
        )
        patterns = [name.casefold() for name in only or ("*",)]
        for name in list(sets):
            # `fnmatch` alone takes capitals for small letters on Windows, and not on Linux.
            if not any(fnmatchcase(name.casefold(), pattern) for pattern in patterns):
                del sets[name]
        for line in table(sets):
            say(line)
        for name, reason in refused:
            say(f"skipped: {name}: {reason}")
        without = [name for name, records in sets.items() if len(records) == 2]
        if without:
            say(
                f"note: {', '.join(without)}: no vertical record. The analysis procedure"
                " requires motions with two horizontal components and a vertical component,"
                " so it is not permitted with these motions."
            )
        if not sets:
            raise InputError("no set of two horizontal records and a vertical one found")
        if not project:
            return
        cells = {
            "recorded_at": recorded_at,
            "units": units,
            "dt_s": None if math.isnan(dt_s) else dt_s,
        }
        with changing(project) as change:
            added, change.files = set_rows(change.book, folder, sets, cells)
            change.fill(row_cells(change.book, added))
        path = change.book.path
        say(path.parent, f": {numbered(len(change.files), 'record')} copied.")
        rows_added = f"{numbered(len(added), 'row')} added to the Motions worksheet"
        say(path, f": {rows_added}: {change.areas}")
        say_next(path, change.has_formulas)
