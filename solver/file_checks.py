"""Files and paths from user input: read once, within a folder, the same on every system.

    within(folder, "records/quake.at2")     the path below the folder
    within(folder, "../quake.at2")          InputError, and for "con" or "a:b" likewise

Knows no format. `solver.file_writing` writes. Read `read_file` and `within`.
"""

from __future__ import annotations

import os
import re
import stat
import sys
from collections.abc import Sequence
from pathlib import Path

from solver.errors import InputError

LONGEST = 259
"""Letters of the longest path on Windows, where its long paths are not enabled."""

_MOST_NAME, _DEEPEST = 200, 8
_MOST_BYTES = 255  # of a name, in the file systems of today
# What Windows allows in no name: a project is taken along to any system.
_FORBIDDEN = re.compile(r'[\x00-\x1f\x7f<>:"|?*]|[. ]$')
_DEVICE = re.compile(
    r"(con|prn|aux|nul|conin\$|conout\$|(com|lpt)[0-9¹²³])\s*(\..*)?", re.IGNORECASE
)


def read_file(path: Path, limit: int, name: str = "", *, too_large: str = "") -> bytes:
    """Return the content of a file named by the user, opened and read once.

    Messages begin with `name` where a command is about another file, and say what to do with one
    that is too large.

    Raises
    ------
    InputError
        If it is no file, has more bytes than `limit`, or cannot be read.
    """
    begin, content = f"{name}: " if name else "", b""
    try:
        status = path.stat()
        # A pipe would wait for ever, and opening a device may do something to it.
        if stat.S_ISREG(status.st_mode):
            with open(path, "rb", opener=_open_at_once) as file:
                # It may be another one by now.
                status = os.fstat(file.fileno())
                if stat.S_ISREG(status.st_mode) and status.st_size <= limit:
                    # One more tells a file that grows, or that states no size.
                    content = file.read(limit + 1)
    except (OSError, ValueError) as error:  # ValueError: of a null character
        problem = f"cannot be read ({getattr(error, 'strerror', error)})"
        raise InputError(
            f"{begin}{problem}; close it in other programs, or check its rights"
        ) from error
    if not stat.S_ISREG(status.st_mode):
        kind = "a folder" if stat.S_ISDIR(status.st_mode) else "a pipe or a device"
        raise InputError(f"{begin}is {kind}; use a file")
    if max(status.st_size, len(content)) > limit:
        raise InputError(f"{begin}larger than {limit / 1e6:g} MB{too_large and f'; {too_large}'}")
    return content


def _open_at_once(path: str, flags: int) -> int:
    """Open a file without waiting for its writer."""
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))


def within(folder: Path, name: str) -> Path:
    """Return the path below a folder for a name from user input, on every system.

    Raises
    ------
    InputError
        If it leads out of the folder or to a device, or would be another name on Windows.
    """
    # Some Windows programs write zips with backslashes between folders; on Linux a backslash is an
    # ordinary character.
    parts = name.replace("\\", "/").split("/")
    if wrong := _wrong(name, parts):
        raise InputError(f"'{printable(name)}' {wrong}")
    return folder.joinpath(*parts)


def _wrong(name: str, parts: Sequence[str]) -> str:
    """Return the problem with a path and its remedy; empty if there is none."""
    # A file name whose bytes are not UTF-8 contains surrogates in Python; a strict encoder would
    # raise an error.
    longest = max(len(part.encode(errors="surrogatepass")) for part in parts)
    if len(name) > _MOST_NAME or longest > _MOST_BYTES:
        return "is too long; shorten its name"
    if len(parts) > _DEEPEST:
        return f"is more than {_DEEPEST - 1} folders deep; move it up"
    if any(part in ("", ".", "..") for part in parts):
        return "is not a path within a folder; rename the file"
    if reserved := [part for part in parts if _DEVICE.fullmatch(part)]:
        return f"is not allowed: Windows reserves the name '{reserved[0]}'; rename it"
    if any(_FORBIDDEN.search(part) for part in parts):
        return (
            "has a character that Windows does not allow in a name, such as : or ?, or ends with "
            "a period or a space; rename it"
        )
    return ""


def printable(name: str) -> str:
    """Return the beginning of an input name in printable form."""
    return _FORBIDDEN.sub("?", name)[:60]


def check_plain(
    path: Path, within: Path, *, is_folder: bool = False, in_place: bool = False
) -> None:
    """Reject anything unexpected where a file or folder is written, below a given folder.

    Raises
    ------
    InputError
        If there or on the way is a link, pipe or device, or a folder for a file or the reverse; or,
        for a file that is opened in place, if it has another name as well.
    """
    place = within
    for part in path.relative_to(within).parts:
        place /= part
        try:
            # Not `stat`: a link is looked at itself, not what it leads to.
            status = place.lstat()
        except FileNotFoundError:
            return
        wants_folder = is_folder or place != path
        if stat.S_ISLNK(status.st_mode):
            place_kind = f"is a link to {os.readlink(place)}"
        # A file that is opened in its place, not replaced, would change under its other name.
        elif in_place and stat.S_ISREG(status.st_mode) and status.st_nlink > 1:
            place_kind = "is also the file of another name (a hard link)"
        elif (stat.S_ISDIR if wants_folder else stat.S_ISREG)(status.st_mode):
            continue
        elif stat.S_ISDIR(status.st_mode) or stat.S_ISREG(status.st_mode):
            place_kind = "is a file, not a folder" if wants_folder else "is a folder, not a file"
        else:
            place_kind = "is a pipe or a device"
        raise InputError(f"{place}: {place_kind}, and is not written to; move it away")


def check_length(path: Path) -> None:
    """Reject a path that is too long for Windows, which would only report it as missing.

    Raises
    ------
    InputError
        With the folder, and by how much its path is too long.
    """
    if sys.platform == "win32":
        from ctypes import windll

        too_long = len(os.path.abspath(path)) - LONGEST
        # Where it is not known, there are none; it returns a byte.
        are_enabled = getattr(windll.ntdll, "RtlAreLongPathsEnabled", int)
        if too_long > 0 and not are_enabled() & 0xFF:
            raise InputError(
                f"{path.parent}: the path is too long for Windows by {too_long} letters; use a"
                " folder with a shorter one, or have long paths enabled"
            )
