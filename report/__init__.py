"""From a filled workbook to a calculation package. Read `report.making` first."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from report.assessment.project import Assessment

# Where lxml is installed openpyxl would read strangers' workbooks through it instead of defusedxml,
# and write others. It asks once, as it is loaded.
os.environ["OPENPYXL_LXML"] = "False"


def assess_project(source: str | Path) -> Assessment:
    """Run a project and return its assessment, without a package.

    Parameters
    ----------
    source : str or Path
        An input workbook, or a folder with `input.xlsx`.

    Raises
    ------
    InputError
        With every problem of the workbook and of its records.
    """
    from report.assessment.project import assess
    from report.motions.prepare import prepare
    from report.sheet.read import read

    sheet = read(Path(source))
    return assess(sheet, prepare(sheet))
