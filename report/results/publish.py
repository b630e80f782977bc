"""Writes finished files to a folder as one set, with a stamp that reveals an incomplete set.

Read `publish` first; `solver.file_writing` writes.
"""

from __future__ import annotations

import hashlib
import os
import re
import warnings
from collections.abc import Iterable, Mapping, Sequence
from contextlib import ExitStack, suppress
from pathlib import Path
from tempfile import TemporaryFile

from pydantic_core import from_json

from solver.errors import InputError
from solver.file_checks import check_plain, read_file, within
from solver.file_writing import add_folder, locked, write_all

PAGE = "calc-package.html"
OUTPUTS = ("calc-package.pdf", PAGE, "plan.dxf", "results.xlsx", "results.json")
"""The files of a package; the page may be left out."""

STAMP = "roofslip.sha256"
"""File with the SHA-256 of every file of a set, as `sha256sum -c` reads it, written last.

Files that do not agree with it are of two sets, or were changed since.
"""

# Of `sha256sum`; names longer than any of a package belong to something else.
_LINE = re.compile(r"([0-9a-f]{64})  (.{1,200})")
# A larger file is of no set.
_MOST_BYTES = 100_000_000


def publish(files: Mapping[str, bytes], folder: Path, names: Sequence[str] = ()) -> None:
    """Write files and `STAMP` to a folder with `write_all`; report if it contained a mixture.

    Of `names`, all that a set may have, what this one lacks is removed if it is as the set before
    had it.
    Two runs that write to one folder do so one after the other.

    Raises `InputError` if the folder or a file in it cannot be written; then no file has changed.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        # Before the files are looked at: another run may be in the middle of its set.
        with locked(folder):
            warn_if_mixed(folder, names or files)
            hashes_before = _listed(folder)
            write_all({**files, STAMP: stamp(files)}, folder)
            for name in names:
                # A page of the former package beside a new PDF would be read as part of it; one
                # that a person changed is theirs, and stays.
                if name not in files and _sha256(content(folder / name)) == hashes_before.get(name):
                    (folder / name).unlink()
    except OSError as error:
        raise InputError(
            f"{folder}: cannot be written ({error.strerror}); choose another folder with --out"
        ) from error


def stamp(files: Mapping[str, bytes]) -> bytes:
    """Return the content of `STAMP` for a set of files."""
    return "".join(f"{_sha256(content)}  {name}\n" for name, content in files.items()).encode()


def warn_if_mixed(folder: Path, names: Iterable[str]) -> None:
    """Warn of files in a folder that do not agree with its stamp."""
    listed = _listed(folder)
    # A first run leaves nothing to compare; a link that leads nowhere is there.
    existing = [name for name in names if os.path.lexists(folder / name)]
    mixed = [name for name in existing if _sha256(content(folder / name)) != listed.get(name)]
    if mixed:
        warnings.warn(
            f"{folder}: not as {STAMP} says: {', '.join(mixed)}; a run was interrupted, or"
            " files were"
            " changed since",
            stacklevel=2,
        )


def _listed(folder: Path) -> Mapping[str, str]:
    """Return the hashes of the stamp of a folder, by name."""
    hashes = {}
    for line in content(folder / STAMP).decode(errors="replace").splitlines():
        match = _LINE.fullmatch(line)
        if match:
            hashes[match[2]] = match[1]
    return hashes


def content(path: Path) -> bytes:
    """Return the content of a file; nothing if it is not a file or too large."""
    with suppress(OSError, InputError):
        # A link is no file of a set: `publish` writes none, and reading it would leave the folder.
        if not path.is_symlink():
            return read_file(path, _MOST_BYTES)
    return b""


def _sha256(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def check_apart(names: Sequence[str], folder: Path, inputs: Sequence[Path]) -> None:
    """Reject a folder in which an output would replace an input of the same run.

    Raises `InputError` if one of the names, in the folder, is an input by any path, link or hard
    link.
    """
    for path in inputs:
        for name in names:
            target = folder / name
            # The same file has many names: other capitals, links, hard links.
            if target.exists() and path.exists() and os.path.samefile(target, path):
                raise InputError(
                    f"{path}: is an input of this run and would be replaced by its {name}; choose"
                    " another folder with --out"
                )


def check_of_workbook(folder: Path, results: str, workbook: str) -> None:
    """Reject a folder with the results of another workbook, as named in these results.

    Raises `InputError`.
    """
    try:
        name = from_json(content(folder / results))["workbook"]["name"]
    except (ValueError, KeyError, TypeError):  # no results, or not as this version writes them
        return
    if isinstance(name, str) and name != workbook:
        raise InputError(
            f"{folder}: contains the results of {name}, not of {workbook}; choose another"
            " folder with"
            " --out, or delete this one if the workbook was renamed"
        )


def output_folder(out: Path | None, home: Path, usual: str, names: Iterable[str] = ()) -> Path:
    """Return the folder to write to, the usual one below a home unless one is given.

    It is checked before the runs rather than after them, with what is in the place of the names.

    Raises `InputError` if it cannot be written to.
    """
    folder = out or (within(home, usual) if usual else home)
    if out is None:
        check_plain(folder, home, is_folder=True)
    existing = next(
        path for path in (folder.absolute(), *folder.absolute().parents) if path.exists()
    )
    if not existing.is_dir():
        raise InputError(f"{existing}: is a file, not a folder; choose another folder")
    if not os.access(existing, os.W_OK | os.X_OK):
        raise InputError(f"{existing}: no permission to write; choose another folder")
    for name in names:
        check_plain(folder / name, folder)
    try:
        with ExitStack() as undo:
            add_folder(folder, undo)
            # Permissions do not say it all: a full disk refuses only what is written.
            TemporaryFile(dir=folder).close()
    except OSError as error:
        reason = f"cannot be written ({error.strerror}); choose another folder with --out"
        raise InputError(f"{folder}: {reason}") from error
    return folder
