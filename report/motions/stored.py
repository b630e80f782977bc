"""Files from elsewhere, stored in a folder of their own: a browser's uploads, zips of records.

Sizes, names and zips are checked here. Read `store`, then `unpack`.
"""

from __future__ import annotations

import re
import stat
import unicodedata
import zipfile
import zlib
from collections.abc import Sequence
from pathlib import Path, PurePosixPath
from typing import IO

from report.sheet.writing.filled import BEFORE
from solver.model import InputError

MB = 1_000_000
MOST_SENT = 100 * MB
MOST_STORED = 200 * MB
MOST_FILES = 500

_MOST_NAME, _DEEPEST = 200, 8
_MOST_BYTES = 255  # of a name, in the file systems of today
# What Windows allows in no name: a project is unpacked on any system.
_FORBIDDEN = re.compile(r'[\x00-\x1f\x7f<>:"|?*]|[. ]$')
_DEVICE = re.compile(r"(con|prn|aux|nul|com[0-9]|lpt[0-9])(\..*)?", re.IGNORECASE)
_CHUNK = 1 << 20
_ENCRYPTED = 0x1

File = tuple[str, IO[bytes]]


def store(files: Sequence[File], folder: Path) -> Path:
    """Store what was sent in an empty folder, and return the workbook among it.

    Each file has its relative path; a zip is the only one. What is refused is an input error, and
    the folder may then hold a part of the files.
    """
    if not files:
        raise InputError("no file was sent; drop the workbook together with its records")
    zips = [item for item in files if item[0].lower().endswith(".zip")]
    if zips and len(files) > 1:
        raise InputError("a zip was sent with other files; drop the zip alone, or the files alone")
    room = _Room(folder)
    if zips:
        with _opened(zips[0][1]) as archive:
            _unpack(archive, room)
    for name, content in files if not zips else ():
        room.take(name, content)
    return _workbook(room.paths)


def unpack(zipped: Path, folder: Path) -> None:
    """Store the files of a zip in an empty folder, which may hold a part where one is refused."""
    if zipped.stat().st_size > MOST_SENT:
        raise InputError(f"more than {MOST_SENT / MB:g} MB; give fewer records")
    with zipped.open("rb") as content, _opened(content) as archive:
        _unpack(archive, _Room(folder))


class _Room:
    """A folder while it is filled: its names without regard to capitals, and its bytes."""

    def __init__(self, folder: Path) -> None:
        self._folder, self._left = folder, MOST_STORED
        self._spelled: dict[str, str] = {}
        self.paths: list[Path] = []

    def take(self, name: str, content: IO[bytes]) -> None:
        """Write one file."""
        path = checked(name)
        # Hidden files, the lock of an open workbook, and what it was before a command changed it.
        hidden = any(part.startswith((".", "~$")) or part == "__MACOSX" for part in path.parts)
        if hidden or name.endswith(BEFORE):
            return
        if len(self.paths) >= MOST_FILES:
            raise InputError(f"more than {MOST_FILES} files; drop the workbook and its records")
        target = self._folder.joinpath(*path.parts)
        self._check_spelling(path, is_written=target in self.paths)
        try:
            target.parent.mkdir(parents=True, exist_ok=True)
            # Never over another file: a zip may have two members of one name.
            with target.open("xb") as out:
                while chunk := content.read(_CHUNK):
                    # Counted as it is read: a zip may state other sizes than it has.
                    self._left -= len(chunk)
                    if self._left < 0:
                        raise InputError(f"more than {MOST_STORED // MB} MB; drop fewer records")
                    out.write(chunk)
        except (FileExistsError, NotADirectoryError, IsADirectoryError) as error:
            raise InputError(f"{name}: a file and a folder of one name; rename one") from error
        self.paths.append(target)

    def _check_spelling(self, path: PurePosixPath, *, is_written: bool) -> None:
        """Refuse a path that other systems would take for another one."""
        for part in (path, *path.parents):
            # macOS takes letters with their accents apart, and Windows does not tell capitals.
            key = unicodedata.normalize("NFC", str(part)).casefold()
            first = self._spelled.setdefault(key, str(part))
            if first != str(part) or (part == path and is_written):
                raise InputError(f"{path}: the same name as {first} but for capitals; rename one")


def checked(name: str) -> PurePosixPath:
    """Return a relative path that stays within its folder on every system; refuse others."""
    parts = name.replace("\\", "/").split("/")
    if wrong := _wrong(name, parts):
        raise InputError(f"'{_FORBIDDEN.sub('?', name)[:60]}' {wrong}")
    return PurePosixPath(*parts)


def _wrong(name: str, parts: Sequence[str]) -> str:
    """Return what is wrong with a path and what would do; empty if nothing is."""
    if len(name) > _MOST_NAME or any(len(part.encode()) > _MOST_BYTES for part in parts):
        return "is too long; shorten its name"
    if len(parts) > _DEEPEST:
        return f"is more than {_DEEPEST - 1} folders deep; move it up"
    if any(part in ("", ".", "..") for part in parts):
        return "is no path within a folder; rename the file"
    if reserved := [part for part in parts if _DEVICE.fullmatch(part)]:
        return f"is not allowed: Windows reserves the name '{reserved[0]}'; rename it"
    if any(_FORBIDDEN.search(part) for part in parts):
        return (
            "has a character that Windows does not allow in a name, such as : or ?, or ends with "
            "a period or a space; rename it"
        )
    return ""


def _opened(content: IO[bytes]) -> zipfile.ZipFile:
    try:
        return zipfile.ZipFile(content)
    except (zipfile.BadZipFile, ValueError, NotImplementedError, OSError) as error:
        raise InputError("the zip is damaged; make it again") from error


def _unpack(archive: zipfile.ZipFile, room: _Room) -> None:
    """Write the files of a zip; refuse a link, and what is encrypted or damaged."""
    members = [info for info in archive.infolist() if not info.is_dir()]
    for info in members:
        # The upper half is the mode of Unix; 0 where a zip was made elsewhere.
        kind = stat.S_IFMT(info.external_attr >> 16)
        if kind not in (0, stat.S_IFREG):
            raise InputError(f"{_short(info)}: a link, not a file; put the file into the zip")
        if info.flag_bits & _ENCRYPTED:
            raise InputError("the zip has a password; make it without one")
    for info in members:
        try:
            with archive.open(info) as content:
                room.take(info.filename, content)
        except (zipfile.BadZipFile, zlib.error, NotImplementedError, EOFError) as error:
            raise InputError(f"{_short(info)}: damaged in the zip; make it again") from error


def _short(info: zipfile.ZipInfo) -> str:
    return _FORBIDDEN.sub("?", info.filename)[:60]


def _workbook(paths: Sequence[Path]) -> Path:
    """Return the workbook: input.xlsx, or the only one that is nearest to the top."""
    workbooks = sorted(
        (p for p in paths if p.suffix.lower() == ".xlsx"), key=lambda p: len(p.parts)
    )
    named = [path for path in workbooks if path.name.lower() == "input.xlsx"]
    top = [
        path for path in named or workbooks if len(path.parts) == len((named or workbooks)[0].parts)
    ]
    if len(top) == 1:
        return top[0]
    if not top:
        if drawings := [path.name for path in paths if path.suffix.lower() == ".dxf"]:
            raise InputError(f"{drawings[0]} came without a workbook; drop both together")
        raise InputError("no workbook (.xlsx) was sent; drop it together with its records")
    names = ", ".join(sorted(path.name for path in top)[:5])
    raise InputError(f"{len(top)} workbooks were sent ({names}); name the one to use input.xlsx")
