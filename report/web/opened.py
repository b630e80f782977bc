"""A workbook with its records, read once: what every answer starts from.

Read `opened`, then `with_values`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from report.motions.components import Components
from report.motions.prepare import Shaking, read_records, shaking
from report.motions.stiff_links import stiff_links
from report.sheet.reading.read import Sheet, read
from report.sheet.reading.what_if import retyped
from report.sheet.schema.fields import Finding, Place
from report.typeset.letters import check_letters
from report.web.values import Values, typed


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Opened:
    """A workbook, its records as read, and its motions as run.

    Attributes
    ----------
    sheet : Sheet
    by_motion : tuple of Components
        Of each motion; the same whatever the sliders say.
    shaking : Shaking
    """

    sheet: Sheet
    by_motion: Sequence[Components]
    shaking: Shaking

    @property
    def scales(self) -> dict[str, float]:
        """Factor on the records of each motion."""
        return {motion.id: motion.scale for motion in self.shaking.motions}


_NOTHING_TO_RUN = (
    "no motion is given",
    "fill in at least one row; roofslip report makes a package of the prescriptive displacement",
)


def opened(path: Path) -> Opened:
    """Read a workbook and its records.

    Raises
    ------
    InputError
        With every problem.
    """
    sheet = read(path)
    check_letters(sheet)
    if not sheet.draft["motions"]:
        sheet.refuse([Finding.error(Place("motions"), *_NOTHING_TO_RUN)])
    by_motion = read_records(sheet)
    sheet.book.files.clear()  # for a package, which another process makes
    sheet.book.records.clear()
    return Opened(sheet=sheet, by_motion=by_motion, shaking=shaking(sheet, by_motion))


def with_values(given: Opened, values: Values) -> Opened:
    """Return a workbook as if the values had been typed into it.

    Raises
    ------
    InputError
        Where the workbook could not have them.
    """
    changed = typed(given.sheet, given.scales, values)
    if not changed:
        return given
    sheet = retyped(given.sheet, changed)
    sheet.refuse(())
    if _has_motions_of(given.sheet, sheet):
        sheet.refuse(stiff_links(sheet.project, given.shaking.motions))
        return replace(given, sheet=sheet)
    return Opened(sheet=sheet, by_motion=given.by_motion, shaking=shaking(sheet, given.by_motion))


def _has_motions_of(before: Sheet, after: Sheet) -> bool:
    """Whether two sheets have the same motions: only units, arrays and clearances differ."""
    return all(
        rows == after.draft[key]
        for key, rows in before.draft.items()
        if key not in ("project", "arrays", "clearances", "links")
    )
