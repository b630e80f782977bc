"""LibreOffice as the judge of formulas: a workbook as it stands after a recalculation."""

from __future__ import annotations

import atexit
import os
import re
import shutil
import subprocess
from functools import cache
from pathlib import Path
from tempfile import mkdtemp
from zipfile import ZipFile

import pytest
from openpyxl import Workbook, load_workbook

SECONDS = 240

Cell = float | str | None
Sheets = dict[str, list[list[Cell]]]

_PRINTED = re.compile(
    rb'<definedName [^>]*name="_xlnm\.Print_(?:Area|Titles)"[^>]*>[^<]*</definedName>'
)
"""Which rows repeat on each printed page; finding the pages takes half the time of a workbook."""


def converted(paths: list[Path], folder: Path, kind: str = "xlsx") -> list[Path]:
    """Return files as LibreOffice saves them, in one start; skip the test without it."""
    soffice = shutil.which("soffice")
    if soffice is None:
        pytest.skip("LibreOffice is not installed: sudo apt-get install libreoffice-calc")
    out = folder / "recalculated"
    home = _home()
    profile = f"-env:UserInstallation=file://{home / 'profile'}"
    done = subprocess.run(
        [soffice, profile, "--headless", "--convert-to", kind, "--outdir", out, *paths],
        capture_output=True,
        timeout=SECONDS,
        check=False,
        env=os.environ | {"HOME": str(home)},
    )
    assert out.is_dir(), done.stderr.decode()
    made = [out / f"{path.stem}.{kind}" for path in paths]
    assert all(path.exists() for path in made), list(out.glob("*"))
    return made


def recalculated(paths: list[Path], folder: Path) -> list[Workbook]:
    """Return workbooks with the values that LibreOffice computes."""
    made = converted(_unprinted(paths, folder), folder)
    return [load_workbook(path, data_only=True) for path in made]


def recalculated_sheets(paths: list[Path], folder: Path) -> list[Sheets]:
    """Return the values of every sheet by its title."""
    books = recalculated(paths, folder)
    return [{sheet.title: [[*row] for row in sheet.values] for sheet in book} for book in books]


def _unprinted(paths: list[Path], folder: Path) -> list[Path]:
    """Return copies of workbooks without what only their printing needs."""
    copies = folder / "unprinted"
    copies.mkdir()
    for path in paths:
        with ZipFile(path) as whole, ZipFile(copies / path.name, "w") as copy:
            for name in whole.namelist():
                content = whole.read(name)
                copy.writestr(
                    name, _PRINTED.sub(b"", content) if name == "xl/workbook.xml" else content
                )
    return [copies / path.name for path in paths]


@cache
def _home() -> Path:
    """Return the folder of LibreOffice's profile; of this process: two starts with one wait."""
    folder = mkdtemp()
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return Path(folder)
