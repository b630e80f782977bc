"""From a filled workbook to a calculation package. Read `report.making` first."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from report.assessment.project import Assessment

__all__ = ["assess_project"]

# openpyxl asks once, as it is loaded. Through lxml, where that is installed, it would write other
# workbooks. Through defusedxml it reads them in half as much time again; by then
# `report.sheet.reading.scan` has refused what that refuses.
os.environ |= {"OPENPYXL_LXML": "False", "OPENPYXL_DEFUSEDXML": "False"}


def assess_project(source: str | Path) -> Assessment:
    """Run a project and return its assessment, without a package.

    Parameters
    ----------
    source : str or Path
        An input workbook, or a folder with `input.xlsx`.

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
    Assessment: NG; 2 arrays, 6 clearances, 12 conditions
    >>> assessment.clearances[1]
    ClearanceCheck: A2 to RTU-1, 549 mm required, 305 mm provided, NG
    """
    from report.assessment.assess import assess
    from report.motions.prepare import prepare
    from report.sheet.reading.read import read

    sheet = read(Path(source))
    return assess(sheet, prepare(sheet))
