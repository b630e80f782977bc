"""The key by which a user's own study parts are known; it is kept in no study. Read `user_key`."""

from __future__ import annotations

import os
import secrets
import sys
import tempfile
from contextlib import suppress
from pathlib import Path

from solver.errors import InputError

# As long as the hash of an HMAC by SHA-256 (RFC 2104, 3).
KEY_BYTES = 32


def user_key() -> bytes:
    """Return the key of this user on this machine; it is made at its first use.

    Raises `InputError` if it cannot be kept or read, with what to do.
    """
    try:
        path = state_folder() / "roofslip" / "study.key"
        if not path.exists():
            _write_key(path)
        key = path.read_bytes()
    # RuntimeError: the user has no home folder.
    except (OSError, RuntimeError) as error:
        where = getattr(error, "filename", None) or "your state folder"
        raise InputError(
            f"{where}: the key that signs the batches of your studies cannot be stored there "
            f"({getattr(error, 'strerror', None) or error}); make the folder writable, or set "
            "XDG_STATE_HOME to a folder of yours that is"
        ) from error
    if len(key) != KEY_BYTES:
        raise InputError(
            f"{path}: damaged, {len(key)} bytes, not the {KEY_BYTES} of a key; delete it: parts "
            "that were signed with it are computed again"
        )
    return key


def state_folder() -> Path:
    """Return where programs keep what is this user's; an absolute XDG_STATE_HOME comes first."""
    folder = os.environ.get("XDG_STATE_HOME", "")
    if Path(folder).is_absolute():
        return Path(folder)
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData/Local")
    if sys.platform == "darwin":
        return Path.home() / "Library/Application Support"
    return Path.home() / ".local/state"


def _write_key(path: Path) -> None:
    """Make a key, readable by its user alone."""
    path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    number, part = tempfile.mkstemp(dir=path.parent)
    try:
        with open(number, "wb") as file:
            file.write(secrets.token_bytes(KEY_BYTES))
            file.flush()
            os.fsync(file.fileno())
        # A link appears whole or not at all; that of a quicker process stays.
        with suppress(FileExistsError):
            os.link(part, path)
    finally:
        os.unlink(part)
