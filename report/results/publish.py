"""Writes finished files to a folder as one set: all of them or none, also if the process is killed.

The new files are first written to a hidden folder beside the old ones. A journal in it says that
they are complete; from then on the set is finished by this run or by the next one. `STAMP` is
replaced last. Nothing else in the folder is touched. Read `publish` first.
"""

from __future__ import annotations

import fcntl
import hashlib
import json
import os
import shutil
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

from solver.files import write_whole
from solver.model import InputError

STAMP = "roofslip.sha256"
"""File with the SHA-256 of every file of a set, as `sha256sum -c` reads it.

Files that do not agree with it are of two sets: a run was killed, or is about to finish.
"""

_HIDDEN = ".roofslip-"
_LOCK = f"{_HIDDEN}lock"
WAIT_S = 60.0
"""How long a run waits for another that writes to the same folder [s]."""

_POLL_S = 0.05

# Of a hidden folder: the new files, copies of the old ones, and one of two journals.
_NEW, _OLD = "new", "old"
_FORWARD, _BACK = "forward.json", "back.json"


def publish(files: Mapping[str, bytes], folder: Path) -> None:
    """Write files to a folder as `write_all` does, and `STAMP`."""
    write_all({**files, STAMP: stamp(files)}, folder)


def write_all(files: Mapping[str, bytes], folder: Path) -> None:
    """Write files to a folder, all of them or none; a file that is replaced keeps its permissions.

    A name may include a subfolder. Two runs that write to one folder do so one after the other.

    Raises
    ------
    InputError
        If the folder or a file in it cannot be written; then no file has changed.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with locked(folder):
            finish(folder)
            staging = Path(tempfile.mkdtemp(prefix=_HIDDEN, dir=folder))
            try:
                _stage(files, folder, staging)
                _forward(folder, staging)
            finally:
                finish(folder)  # also what Ctrl+C cut off
    except OSError as error:
        raise InputError(
            f"{folder}: cannot be written ({error.strerror}); free disk space, or choose another"
            " folder with --out"
        ) from error


def stamp(files: Mapping[str, bytes]) -> bytes:
    """Return the content of `STAMP` for a set of files."""
    lines = (f"{hashlib.sha256(content).hexdigest()}  {name}\n" for name, content in files.items())
    return "".join(lines).encode()


def check_apart(names: Sequence[str], folder: Path, inputs: Sequence[Path]) -> None:
    """Refuse a folder in which an output would replace an input of the same run.

    Raises
    ------
    InputError
        If one of the names, in the folder, is an input by any path, link or hard link.
    """
    for path in inputs:
        for name in names:
            target = folder / name
            if target.exists() and path.exists() and os.path.samefile(target, path):
                raise InputError(
                    f"{path}: is an input of this run, and would be replaced by its {name}; choose"
                    " another folder with --out"
                )


def check_writable(folder: Path) -> None:
    """Refuse what is no folder to write into, before the runs rather than after them.

    Raises
    ------
    InputError
    """
    existing = next(
        path for path in (folder.absolute(), *folder.absolute().parents) if path.exists()
    )
    if not existing.is_dir():
        raise InputError(f"{existing}: is a file, not a folder; choose another folder")
    if not os.access(existing, os.W_OK | os.X_OK):
        raise InputError(f"{existing}: no permission to write; choose another folder")


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Hold the lock of a folder, which ends with its process.

    Raises
    ------
    InputError
        If another process holds it for `WAIT_S`.
    """
    path, started = folder / _LOCK, time.monotonic()
    while (lock := _try_lock(path)) < 0:
        if time.monotonic() - started > WAIT_S:
            raise InputError(
                f"{folder}: another run has been writing there for {WAIT_S:g} s; wait until it"
                " ends, or choose another folder with --out"
            )
        time.sleep(_POLL_S)
    try:
        yield
    finally:
        path.unlink(missing_ok=True)
        os.close(lock)


def _try_lock(path: Path) -> int:
    """Return the descriptor of the locked file; -1 if another process has it."""
    lock = os.open(path, os.O_CREAT | os.O_RDWR | os.O_NOFOLLOW | os.O_CLOEXEC, 0o666)
    return lock_or_close(lock, path)


def lock_or_close(lock: int, path: Path) -> int:
    """Lock a descriptor of a path and return it; -1 if it is another's, or gone."""
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        # The process that had it may have removed the path since it was opened here.
        if os.path.samestat(os.fstat(lock), path.stat()):
            return lock
    except (BlockingIOError, FileNotFoundError):
        pass
    except OSError:
        os.close(lock)
        raise
    os.close(lock)
    return -1


def _stage(files: Mapping[str, bytes], folder: Path, staging: Path) -> None:
    """Write the new files, copies of the old ones, and then the journal."""
    for name, content in files.items():
        for part in (_NEW, _OLD):
            (staging / part / name).parent.mkdir(parents=True, exist_ok=True)
        with (staging / _NEW / name).open("xb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        if (folder / name).is_file():
            shutil.copy2(folder / name, staging / _OLD / name)
            shutil.copymode(folder / name, staging / _NEW / name)
    had = {name: (staging / _OLD / name).exists() for name in files}
    write_whole(staging / _FORWARD, json.dumps(had).encode())


def finish(folder: Path) -> None:
    """Finish what was cut off: complete its set or put the former one back, and sweep up."""
    for staging in sorted(folder.glob(f"{_HIDDEN}*")):
        if staging.is_symlink() or not staging.is_dir() or not _is_own(staging):
            continue
        if (staging / _FORWARD).exists():
            _forward(folder, staging)
        elif (staging / _BACK).exists():
            _put_back(folder, staging)
        # The journal first: without it what is left has no meaning.
        for journal in (_FORWARD, _BACK):
            (staging / journal).unlink(missing_ok=True)
        shutil.rmtree(staging, ignore_errors=True)


def _is_own(staging: Path) -> bool:
    """Whether a hidden folder holds nothing but what `_stage` writes."""
    own = {_NEW, _OLD, _FORWARD, _BACK}
    return all(path.name in own or path.name.startswith(_HIDDEN) for path in staging.iterdir())


def _forward(folder: Path, staging: Path) -> None:
    """Replace all files by the new ones; if one cannot be replaced, put all others back."""
    for name in json.loads((staging / _FORWARD).read_bytes()):
        if not (staging / _NEW / name).exists():
            continue
        try:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            os.replace(staging / _NEW / name, folder / name)
        except OSError as error:
            os.replace(staging / _FORWARD, staging / _BACK)
            _put_back(folder, staging)
            raise InputError(
                f"{folder / name}: cannot be replaced ({error.strerror}); close it in other "
                "programs, or choose another folder with --out. No file was changed"
            ) from error


def _put_back(folder: Path, staging: Path) -> None:
    for name, had in json.loads((staging / _BACK).read_bytes()).items():
        if (staging / _NEW / name).exists():
            continue  # not replaced
        if (staging / _OLD / name).exists():
            os.replace(staging / _OLD / name, folder / name)
        elif not had:
            (folder / name).unlink(missing_ok=True)
