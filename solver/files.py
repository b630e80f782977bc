"""Writes a file whole or not at all.

Knows no format. A set of files is written by `report.results.publish`.
"""

from __future__ import annotations

import os
import secrets
from pathlib import Path

from solver.model import InputError


def write_whole(path: Path, content: bytes, *, replace: bool = True) -> None:
    """Write a file whole: a full disk or a killed process leaves the former file, or none.

    A link is replaced, not followed.

    Parameters
    ----------
    replace : bool
        Whether an existing file may be replaced.

    Raises
    ------
    InputError
        If the file cannot be written, or exists and may not be replaced.
    """
    part = path.parent / f".roofslip-{secrets.token_hex(8)}.part"
    try:
        with part.open("xb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        _place(part, path, replace)
    except FileExistsError as error:
        raise InputError(f"{path}: already exists; give another name, or move the file") from error
    except OSError as error:
        raise InputError(f"{path}: cannot be written ({error.strerror})") from error
    finally:
        part.unlink(missing_ok=True)


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
