"""From a filled workbook to a calculation package. Read `report.making` first."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from report.assessment.assessment import Assessment
    from report.project.read.workbook_data import Sheet

__all__ = ["assess_project", "read_project"]

# openpyxl asks once, as it is loaded. Through lxml, where that is installed, it would write other
# workbooks. Through defusedxml it reads them in half as much time again; by then
# `report.project.read.scan` has refused what that refuses.
os.environ |= {"OPENPYXL_LXML": "False", "OPENPYXL_DEFUSEDXML": "False"}


def read_project(source: str | Path) -> Sheet:
    """Read the workbook of a project; run nothing.

    Parameters
    ----------
    source : str or Path
        An input workbook, or a folder with `input.xlsx`.

    Returns
    -------
    Sheet
        The workbook as data: `project` contains every input, and `with_` returns a copy with
        changed ones.

    Raises
    ------
    InputError
        If there is no workbook to read; `project` raises the problems within it.

    Examples
    --------
    >>> from report import read_project
    >>> workbook = read_project("projects/example")
    >>> [array.mu for array in workbook.project.arrays]
    [0.5, 0.5, 0.4]
    """
    from report.project.read.read import read

    return read(Path(source))


def assess_project(source: str | Path | Sheet) -> Assessment:
    """Run a project and return its assessment, without a package.

    Parameters
    ----------
    source : str, Path or Sheet
        An input workbook, a folder with `input.xlsx`, or the result of `read_project`.

    Returns
    -------
    Assessment
        Arrays, clearances, requirements and the verdict.

    Raises
    ------
    InputError
        With every problem of the workbook and of its records.

    Examples
    --------
    >>> from report import assess_project
    >>> assessment = assess_project("projects/conditions")
    >>> assessment
    Assessment: NG; 2 arrays, 6 clearances, 15 open checks
    >>> assessment.clearances[1]
    ClearanceCheck: A2 to RTU-1, 549 mm required, 305 mm provided, NG
    """
    from report.assessment.assess import assess
    from report.motions.prepare import prepare

    sheet = read_project(source) if isinstance(source, str | Path) else source
    return assess(sheet, prepare(sheet))
