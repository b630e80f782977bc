"""The example project, with its records and documents."""

from __future__ import annotations

from pathlib import Path

from report.project.model.choices import UnitsFirst
from report.project.read.read import read
from report.project.write.template import template

_REPORT = Path(__file__).resolve().parents[2]
_HOMES = (_REPORT / "web" / "example", _REPORT.parent / "projects" / "example")
# Within the package where it is installed, or of the checkout.
EXAMPLE = next(path for path in _HOMES if path.is_dir())


def example_files(units: UnitsFirst) -> dict[str, bytes]:
    """Return records/ and documents/ as shipped, and input.xlsx in a system of units, by name."""
    paths = (*sorted((EXAMPLE / "records").iterdir()), *sorted((EXAMPLE / "documents").iterdir()))
    files = {f"{path.parent.name}/{path.name}": path.read_bytes() for path in paths}
    project = read(EXAMPLE).project
    issue = project.project.model_copy(update={"units_first": units})
    example = project.model_copy(update={"project": issue})
    return files | {"input.xlsx": template(units, example)}
