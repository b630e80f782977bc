"""Saved values of formulas that may be former ones, or are taken from elsewhere."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from report.project.check.problem_lines import listed
from report.project.model.finding import Finding, warning
from report.project.model.place import Place
from report.project.read.archive import OpenBook
from report.project.read.unseen import Used
from report.text.typed_letters import cut

_MOST_LISTED = 8


def from_outside(book: OpenBook, whole: Place) -> Iterator[Finding]:
    """Yield a warning if a workbook takes values from elsewhere: by DDE, or of other files."""
    if book.outside:
        names = (cut(link).encode("ascii", "replace").decode() for link in book.outside)
        which = listed(names, _MOST_LISTED)
        text = f"the workbook takes values from elsewhere ({which}), of which the saved ones are"
        yield warning("outside", whole, f"{text} read: type the values instead")


def not_calculated(book: OpenBook, used: Used, whole: Place) -> Iterator[Finding]:
    """Yield a warning if the values of formulas may not follow from the cells they refer to."""
    says = book.calculation
    read = [(place, cell.address) for place, cell in used if cell.formula]
    if says.get("calcCompleted", "1") in ("0", "false"):
        manual = " (calculation is manual)" if says.get("calcMode") == "manual" else ""
        why = f"was saved before its formulas were calculated{manual}"
    # So does a fresh one, which has such values only in formulas that are read.
    elif read and says.get("fullCalcOnLoad", "0") in ("1", "true"):
        why = "asks to be calculated when it is opened"
    else:
        return
    if read or any(scan.formulas for scan in book.scans.values()):
        place, cell = read[0] if read else (whole, "")
        which = listed((address for _, address in read), _MOST_LISTED) or "its computed cells"
        text = f"the workbook {why}, and {which} may show previous values: calculate it (F9; in"
        text += " LibreOffice Ctrl+Shift+F9) and save it"
        yield replace(warning("calculation", place, text), cell=cell)
