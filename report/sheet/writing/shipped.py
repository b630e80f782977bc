"""The example that comes with the program: its workbook, and its records beside it.

`projects/example/make.py` makes both. Read `example_files`.
"""

from __future__ import annotations

from pathlib import Path

from report.sheet.reading.read import read
from report.sheet.schema.choices import UnitsFirst
from report.sheet.writing.template import template

_REPORT = Path(__file__).resolve().parents[2]
_HOMES = (_REPORT / "web" / "example", _REPORT.parent / "projects" / "example")
EXAMPLE = next(path for path in _HOMES if path.is_dir())
"""Within the package where it is installed, or of the checkout."""


def example_files(units: UnitsFirst) -> dict[str, bytes]:
    """Return records/, as they are shipped, and input.xlsx in a system of units, by their names."""
    records = sorted((EXAMPLE / "records").iterdir())
    files = {f"records/{path.name}": path.read_bytes() for path in records}
    project = read(EXAMPLE).project
    issue = project.project.model_copy(update={"units_first": units})
    example = project.model_copy(update={"project": issue})
    return files | {"input.xlsx": template(units, example)}
