"""The Excel layout of a project: the sections of its worksheets, each a list of inputs.

An input has heading, field, example, unit and note; read, write and check work from these lists.
"""

from __future__ import annotations

from collections.abc import Mapping

from report.project.workbook.entries import SheetSection
from report.project.workbook.motion_sheets import BUILDING, LINKS, MOTIONS, SPECTRUM, TARGET
from report.project.workbook.option_sheets import ACKNOWLEDGED, CONFIRMATION, OPTIONS, OVERRIDES
from report.project.workbook.roof_sheets import ARRAYS, CLEARANCES, LAYERS, OBJECTS, OUTLINES, ROOF
from report.project.workbook.site_sheets import (
    FRICTION_RUNS,
    FRICTION_TESTS,
    PROJECT,
    REVISIONS,
    SITE,
)

SECTIONS = (
    PROJECT, REVISIONS, SITE, ROOF, ARRAYS, FRICTION_TESTS, FRICTION_RUNS, OBJECTS, CLEARANCES,
    MOTIONS, BUILDING, SPECTRUM, LINKS, OPTIONS, CONFIRMATION, TARGET, OVERRIDES, OUTLINES, LAYERS,
    ACKNOWLEDGED,
)  # fmt: skip
"""Parts of the workbook, in its order; the key of each is its field of `ProjectInput`."""

SECTION: Mapping[str, SheetSection] = {section.key: section for section in SECTIONS}
"""The same by key."""
