"""Tells what a command writes, renames or removes outside of the folders that it may write to."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

WRITES = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND
# Events of Python with the places of paths among their arguments, and of the folder that they
# are relative to.
CHANGES = {
    "os.remove": ((0, 1),), "os.rmdir": ((0, 1),), "os.mkdir": ((0, 2),), "os.symlink": ((1, 2),),
    "os.link": ((1, 3),), "os.rename": ((0, 2), (1, 3)), "os.truncate": ((0, None),),
    "os.chmod": ((0, 2),), "os.chown": ((0, 3),), "os.utime": ((0, 3),), "os.mkfifo": ((0, 2),),
}  # fmt: skip

_watched: list[list[Path]] = []


def _note(event: str, arguments: tuple[object, ...]) -> None:
    if not _watched:
        return
    if event == "open":
        path, _, flags = arguments
        if isinstance(flags, int) and flags & WRITES and not isinstance(path, int):
            _watched[-1].append(_place(path, None))
    for path, folder in CHANGES.get(event, ()):
        if not isinstance(arguments[path], int):
            _watched[-1].append(_place(arguments[path], folder and arguments[folder]))


def _place(path: object, folder: object) -> Path:
    """Return where a change leads; the last part itself may be a link, which is not followed."""
    whole = Path(os.fsdecode(path))  # type: ignore[arg-type]
    if isinstance(folder, int) and folder >= 0:
        whole = Path(os.readlink(f"/proc/self/fd/{folder}")) / whole
    whole = Path.cwd() / whole
    if whole.name in ("", ".."):
        return whole.resolve()
    return whole.parent.resolve() / whole.name


sys.addaudithook(_note)


@contextmanager
def changes_within(*folders: Path) -> Iterator[None]:
    """Fail where something is changed in another place than below some folders."""
    changed: list[Path] = []
    _watched.append(changed)
    try:
        yield
    finally:
        _watched.pop()
    allowed = [folder.resolve() for folder in folders]
    outside = {
        path
        for path in changed
        if not any(path.is_relative_to(folder) for folder in allowed)
        # Of Python and its libraries: compiled modules and kernels; the terminal.
        and "__pycache__" not in path.parts
        and path != Path(os.devnull)
    }
    assert not outside
