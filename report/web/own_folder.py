"""The folder of a server among the temporary ones: locked while it lives, swept by a later one.

Read `own_folder`.
"""

from __future__ import annotations

import fcntl
import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from tempfile import mkdtemp

_PREFIX = "roofslip-serve-"


@contextmanager
def own_folder(within: Path) -> Iterator[Path]:
    """Yield a new folder, which is removed at the end; remove those of servers that were killed.

    Its lock ends with its process, however that ends.

    Raises
    ------
    OSError
        If no folder can be made or locked.
    """
    _sweep(within)
    lock = -1
    while lock < 0:  # a server that starts at the same time may sweep it before it is locked
        folder = Path(mkdtemp(prefix=_PREFIX, dir=within))
        lock = _try_lock(folder)
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)
        os.close(lock)


def _sweep(within: Path) -> None:
    for folder in within.glob(f"{_PREFIX}*"):
        if (lock := _try_lock(folder)) >= 0:
            shutil.rmtree(folder, ignore_errors=True)
            os.close(lock)


def _try_lock(folder: Path) -> int:
    """Return the descriptor of a folder that is locked now; -1 if it is another's, or gone."""
    try:
        lock = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
    except (FileNotFoundError, NotADirectoryError, PermissionError):
        return -1
    with suppress(BlockingIOError, FileNotFoundError):
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        # The process that had it may have removed the path since it was opened here.
        if os.path.samestat(os.fstat(lock), folder.stat()):
            return lock
    os.close(lock)
    return -1
