"""Untrusted files, stored in a folder of their own: browser uploads, zips of records.

Sizes, names and zips are checked here. Read `store`, then `unpack`.
"""

from __future__ import annotations

import io
import stat
import unicodedata
from collections.abc import Sequence
from pathlib import Path, PurePosixPath
from typing import IO

from report.project.read.archive import zip_of
from report.project.write.filled import BEFORE
from solver.errors import InputError
from solver.file_checks import printable, read_file, within

MB = 1_000_000
MOST_SENT = 100 * MB
MOST_STORED = 200 * MB
MOST_FILES = 500

_CHUNK = 1 << 20
# Bit 0 of the flags of an entry (PKWARE APPNOTE.TXT, 4.4.4).
_ENCRYPTED = 0x1

File = tuple[str, IO[bytes]]


def store(files: Sequence[File], folder: Path) -> Path:
    """Store uploaded files in an empty folder, and return the workbook among them.

    Each file has its relative path; a zip is the only one. Rejected files raise an input error; the
    folder may then contain some of the files.
    """
    if not files:
        raise InputError("no file was uploaded; drop the workbook together with its records")
    zips = [item for item in files if item[0].lower().endswith(".zip")]
    if zips and len(files) > 1:
        raise InputError(
            "a zip was uploaded with other files; drop only the zip, or only the files"
        )
    room = _Room(folder)
    if zips:
        _unpack(zips[0][1], room)
    for name, content in files if not zips else ():
        room.take(name, content)
    return _workbook(room.paths)


def unpack(zipped: Path, folder: Path) -> None:
    """Store the files of a zip, and of the zips in it, in an empty folder.

    All together they may be as many and as large as those of one zip; zips in these stay as they
    are. The folder may hold a part where one is refused.
    """
    room = _Room(folder)
    _unpack(io.BytesIO(read_file(zipped, MOST_SENT, too_large="use fewer records")), room)
    # Some networks send a zip of the zips of each station.
    for inner in [path for path in room.paths if path.suffix.lower() == ".zip"]:
        below = inner.relative_to(folder).with_suffix("").as_posix()
        _unpack(io.BytesIO(inner.read_bytes()), room, f"{below}/")


class _Room:
    """A folder while it is filled: its names without regard to capitals, and its bytes."""

    def __init__(self, folder: Path) -> None:
        self._folder, self._left = folder, MOST_STORED
        self._spelled: dict[str, str] = {}
        self.paths: list[Path] = []

    def take(self, name: str, content: IO[bytes]) -> None:
        """Write one file."""
        # No name leads out of the folder, as `../` or a drive of Windows would.
        target = within(self._folder, name)
        path = PurePosixPath(target.relative_to(self._folder).as_posix())
        # Hidden files, the lock of an open workbook, and what it was before a command changed it.
        hidden = any(part.startswith((".", "~$")) or part == "__MACOSX" for part in path.parts)
        if hidden or name.endswith(BEFORE):
            return
        if len(self.paths) >= MOST_FILES:
            raise InputError(f"more than {MOST_FILES} files; drop the workbook and its records")
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
            raise InputError(
                f"{name}: a file and a folder have the same name; rename one"
            ) from error
        self.paths.append(target)

    def _check_spelling(self, path: PurePosixPath, *, is_written: bool) -> None:
        """Reject a path that other systems would confuse with another one."""
        for part in (path, *path.parents):
            # macOS takes letters with their accents apart, and Windows does not tell capitals.
            key = unicodedata.normalize("NFC", str(part)).casefold()
            first = self._spelled.setdefault(key, str(part))
            if first != str(part) or (part == path and is_written):
                raise InputError(
                    f"{path}: the same name as {first} except for capitals; rename one"
                )


def _unpack(content: IO[bytes], room: _Room, below: str = "") -> None:
    """Write the files of a zip; reject links and encrypted or damaged files."""
    archive = zip_of(content, "the zip is damaged or not a zip; create it again")
    # Some programs of Windows write backslashes.
    named = [(info.filename.replace("\\", "/"), info) for info in archive.infolist()]
    members = [(path, info) for path, info in named if not path.endswith("/")]
    # All are checked before the first is written.
    for path, info in members:
        # The upper half is the mode of Unix; 0 where a zip was made elsewhere.
        kind, name = stat.S_IFMT(info.external_attr >> 16), printable(path)
        # A link in a zip may point to any file of this computer, which a package would attach.
        if kind not in (0, stat.S_IFREG):
            raise InputError(f"{name}: a link instead of a file; put the file itself into the zip")
        if info.flag_bits & _ENCRYPTED:
            raise InputError("the zip has a password; create it without one")
    for path, info in members:
        try:
            with archive.open(info) as member:
                room.take(below + path, member)
        except Exception as error:  # zlib, lzma and bz2 raise errors of their own
            # What the system refuses has a number, as on a full disk.
            if isinstance(error, InputError) or getattr(error, "errno", None):
                raise
            raise InputError(f"{printable(path)}: damaged in the zip; create it again") from error


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
        raise InputError("no workbook (.xlsx) was uploaded; drop it together with its records")
    names = ", ".join(sorted(path.name for path in top)[:5])
    raise InputError(
        f"{len(top)} workbooks were uploaded ({names}); rename the one to use to input.xlsx"
    )
