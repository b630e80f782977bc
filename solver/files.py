"""Writes a file whole or not at all, and sweeps up what a killed writer left.

Knows no format. A set of files is written by `report.results.publish`.
"""

from __future__ import annotations

import fcntl
import os
import re
import secrets
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO

from solver.model import InputError

_PART = re.compile(r"\.roofslip-[0-9a-f]{16}\.part")


def write_whole(path: Path, content: bytes, *, replace: bool = True) -> None:
    """Write a file whole: a full disk or a killed process leaves the former file, or none.

    A link is replaced, not followed. What a killed process left hidden in the folder is removed.

    Parameters
    ----------
    replace : bool
        Whether an existing file may be replaced; the new one has its permissions.

    Raises
    ------
    InputError
        If the file cannot be written, or exists and may not be replaced.
    """
    try:
        _sweep(path.parent)
        part, file = _begun(path.parent)
        try:
            with file:
                file.write(content)
                file.flush()
                os.fsync(file.fileno())
                if replace and path.is_file() and not path.is_symlink():
                    part.chmod(path.stat().st_mode & 0o777)
                _place(part, path, replace)
        finally:
            part.unlink(missing_ok=True)
    except FileExistsError as error:
        raise InputError(f"{path}: already exists; give another name, or move the file") from error
    except OSError as error:
        raise InputError(f"{path}: cannot be written ({error.strerror})") from error


def _begun(folder: Path) -> tuple[Path, BinaryIO]:
    """Create a hidden file, locked for as long as it is open: its writer lives."""
    while True:
        part = folder / f".roofslip-{secrets.token_hex(8)}.part"
        file = part.open("xb")
        _lock(file.fileno(), fcntl.LOCK_EX)
        if part.exists():
            return part, file
        file.close()  # another process swept it up before it was locked


def _sweep(folder: Path) -> None:
    """Remove the hidden files whose writers have ended."""
    for name in filter(_PART.fullmatch, os.listdir(folder)):
        with suppress(OSError):
            left = os.open(folder / name, os.O_WRONLY | os.O_NOFOLLOW | os.O_CLOEXEC)
            try:
                if _lock(left, fcntl.LOCK_EX | fcntl.LOCK_NB):
                    (folder / name).unlink()
            finally:
                os.close(left)


def _lock(file: int, how: int) -> bool:
    """Lock a file; False where another process has it, or the file system has no locks."""
    try:
        fcntl.flock(file, how)
    except OSError:
        return False
    return True


def _place(part: Path, path: Path, replace: bool) -> None:
    if replace:
        os.replace(part, path)
        return
    try:
        # Unlike a rename, a hard link is refused where the name exists, even as a dangling link.
        os.link(part, path)
    except FileExistsError:
        raise
    except OSError:  # a file system without hard links
        if os.path.lexists(path):
            raise FileExistsError(path) from None
        os.replace(part, path)
