"""LibreOffice as the judge of formulas: a workbook as it stands after a recalculation."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest
from openpyxl import Workbook, load_workbook

SECONDS = 180


def recalculated(paths: list[Path], folder: Path) -> list[Workbook]:
    """Return workbooks with the values that LibreOffice computes; skip the test without it."""
    soffice = shutil.which("soffice")
    if soffice is None:
        pytest.skip("LibreOffice is not installed: sudo apt-get install libreoffice-calc")
    out = folder / "recalculated"
    # A profile of its own: two runs with one profile wait for each other.
    profile = f"-env:UserInstallation=file://{folder / 'profile'}"
    command = [soffice, profile, "--headless", "--convert-to", "xlsx", "--outdir", str(out)]
    done = subprocess.run(
        [*command, *map(str, paths)], capture_output=True, timeout=SECONDS, check=False
    )
    made = [out / path.name for path in paths]
    assert all(path.exists() for path in made), done.stderr.decode()
    return [load_workbook(path, data_only=True) for path in made]
