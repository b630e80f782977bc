"""LibreOffice as the judge of formulas: a workbook as it stands after a recalculation."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest
from openpyxl import Workbook, load_workbook

SECONDS = 240


def converted(paths: list[Path], folder: Path, kind: str = "xlsx") -> list[Path]:
    """Return files as LibreOffice saves them, in one start; skip the test without it."""
    soffice = shutil.which("soffice")
    if soffice is None:
        pytest.skip("LibreOffice is not installed: sudo apt-get install libreoffice-calc")
    out = folder / "recalculated"
    # A profile of its own: two runs with one profile wait for each other.
    profile = f"-env:UserInstallation=file://{folder / 'profile'}"
    done = subprocess.run(
        [soffice, profile, "--headless", "--convert-to", kind, "--outdir", out, *paths],
        capture_output=True,
        timeout=SECONDS,
        check=False,
        env=os.environ | {"HOME": str(folder)},
    )
    made = [out / f"{path.stem}.{kind}" for path in paths]
    assert all(path.exists() for path in made), done.stderr.decode()
    return made


def recalculated(paths: list[Path], folder: Path) -> list[Workbook]:
    """Return workbooks with the values that LibreOffice computes."""
    return [load_workbook(path, data_only=True) for path in converted(paths, folder)]
