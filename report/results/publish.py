"""Writes finished files to a folder: all of them or none."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Mapping
from pathlib import Path

from solver.model import InputError


def publish(files: Mapping[str, bytes], folder: Path) -> None:
    """Write files to a folder, all of them or none; existing files stay until all are ready.

    A name may include a subfolder.

    Raises
    ------
    InputError
        If the folder or a file in it cannot be written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        staging = Path(tempfile.mkdtemp(prefix=".roofslip-", dir=folder))
    except OSError as error:
        raise InputError(
            f"{folder}: cannot be written ({error.strerror}); choose another folder with --out"
        ) from error
    try:
        _stage(files, folder, staging)
        _replace_all(files, folder, staging)
    finally:
        shutil.rmtree(staging, ignore_errors=True)


def _stage(files: Mapping[str, bytes], folder: Path, staging: Path) -> None:
    """Write the new files, and backup copies of the old ones."""
    try:
        for name, content in files.items():
            (staging / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (staging / name).write_bytes(content)
            if (folder / name).is_file():
                shutil.copy2(folder / name, staging / f"{name}.old")
    except OSError as error:
        raise InputError(
            f"{folder}: cannot be written ({error.strerror}); free disk space, or choose another "
            "folder with --out"
        ) from error


def _replace_all(files: Mapping[str, bytes], folder: Path, staging: Path) -> None:
    done: list[str] = []
    for name in files:
        try:
            os.replace(staging / name, folder / name)
        except OSError as error:
            for earlier in done:
                _put_back(earlier, folder, staging)
            raise InputError(
                f"{folder / name}: cannot be replaced ({error.strerror}); close it in other "
                "programs, or choose another folder with --out. No file was changed"
            ) from error
        done.append(name)


def _put_back(name: str, folder: Path, staging: Path) -> None:
    old = staging / f"{name}.old"
    if old.exists():
        os.replace(old, folder / name)
    else:
        (folder / name).unlink()
