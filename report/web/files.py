"""Files of a browser, stored in a folder of their own, and what the page gives back.

Sizes, names and zips are checked here. Read `received`, then `package_routes`.
"""

from __future__ import annotations

import re
import secrets
import shutil
import stat
import unicodedata
import zipfile
import zlib
from collections.abc import Sequence
from pathlib import Path, PurePosixPath
from typing import IO

from pydantic import ValidationError
from starlette.concurrency import run_in_threadpool
from starlette.datastructures import FormData, UploadFile
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, Response
from starlette.routing import Route

from report.making import OUTPUTS
from report.sheet.writing.filled import BEFORE
from report.web.session import Asked, OtherProjectError, RefusedError, session_of
from report.web.worker import PROJECT, TYPES, Package, State, copied, motions_made
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


def is_alone(workbook: Path, folder: Path) -> bool:
    """Whether a workbook was sent without any other file."""
    return all(path == workbook or path.is_dir() for path in folder.rglob("*"))


MOST_JSON = 100_000
_MOST_FIELDS = 10


async def receive_json(request: Request) -> Asked:
    """Return a request of the page about what is open; refuse any other."""
    _check_length(request, MOST_JSON)
    # A form of another site cannot send this type.
    if request.headers.get("content-type", "").partition(";")[0] != "application/json":
        raise HTTPException(415, "Send JSON")
    try:
        asked = Asked.model_validate_json(await request.body())
    except ValidationError as error:
        raise InputError("the request is not one of the page; load the page again") from error
    if asked.opened not in (None, session_of(request).opened):
        raise OtherProjectError
    return asked


async def received(request: Request, folder: Path) -> Path:
    """Store the files of a request in a folder, or remove it; return the workbook among them.

    What the form says beside its files is `request.state.fields` then.
    """
    try:
        form = await _form(request)
        try:
            texts = ((name, text) for name, text in form.items() if isinstance(text, str))
            request.state.fields = dict(texts)
            files = [
                (part.filename or "", part.file)
                for part in form.getlist("files")
                if isinstance(part, UploadFile)
            ]
            return await run_in_threadpool(store, files, folder)
        finally:
            await form.close()
    except BaseException:
        await run_in_threadpool(shutil.rmtree, folder, ignore_errors=True)
        raise


async def _form(request: Request) -> FormData:
    """Return the files of a request; errors of the form are those of what was dropped."""
    _check_length(request, MOST_SENT)
    try:
        return await request.form(max_files=MOST_FILES, max_fields=_MOST_FIELDS)
    except HTTPException as error:
        if error.status_code != 400:
            raise
        # The library has one error for all, and tells them apart by their words alone.
        if error.detail.startswith("Too many files"):
            raise InputError(
                f"more than {MOST_FILES} files; drop the workbook and its records"
            ) from error
        raise InputError("the files did not arrive whole; drop them again") from error


def _check_length(request: Request, maximum: int) -> None:
    """Refuse a body that is too long, or does not say how long it is, as that of every browser."""
    length = request.headers.get("content-length", "")
    if not length.isdecimal() or int(length) > maximum:
        raise HTTPException(413, f"More than {maximum / MB:g} MB; drop fewer records")


def package_routes() -> list[Route]:
    """Return the routes of packages and of their files, and of a workbook that was filled in."""
    return [
        Route("/api/plan", _filled),
        Route("/api/package", _begin, methods=["POST"]),
        Route("/api/motions", _motions, methods=["POST"]),
        Route("/api/package/{id}", _about, methods=["GET"]),
        Route("/api/package/{id}", _cancel, methods=["DELETE"]),
        Route("/api/package/{id}/{name}", _file, methods=["GET"]),
    ]


async def workbook(request: Request) -> Response:
    """Return the workbook with the values written into its cells."""
    session, values = session_of(request), (await receive_json(request)).values
    name = session.workbook.name
    path = session.folder / f"written-{secrets.token_hex(8)}.xlsx"
    try:
        await session.ask({"do": "write", "values": values, "to": str(path)})
        data = await run_in_threadpool(path.read_bytes)
    finally:
        await run_in_threadpool(path.unlink, missing_ok=True)
    return _attached(Response(data, media_type=TYPES[".xlsx"]), name)


async def _filled(request: Request) -> Response:
    path = session_of(request).filled
    if path is None:
        raise HTTPException(404, "No plan was filled in from a drawing")
    return _attached(FileResponse(path, media_type=TYPES[".xlsx"]), path.name)


async def _begin(request: Request) -> Response:
    session, values = session_of(request), (await receive_json(request)).values
    opened, workbook = session.opened, session.workbook
    path = session.folder / f"package-{secrets.token_hex(8)}" / workbook.name
    try:
        await run_in_threadpool(copied, workbook, path.parent)
        job = {"do": "write", "workbook": str(workbook), "values": values, "to": str(path)}
        await session.ask(job)
    except (OSError, RefusedError):
        await run_in_threadpool(shutil.rmtree, path.parent, ignore_errors=True)
        # Where another one was opened, the files are gone for that: it is said below.
        if session.workbook == workbook:
            raise
    if session.workbook != workbook:
        raise InputError("Another workbook was opened meanwhile; make the package again.")
    return JSONResponse(session.packages.begin(opened, path, values).about)


async def _motions(request: Request) -> Response:
    """Begin a suite of motions for a workbook without any, which is sent again for it."""
    session = session_of(request)
    folder = session.folder / f"package-{secrets.token_hex(8)}"
    folder.mkdir()
    workbook = await received(request, folder)
    session.packages.cancel(motions_made)
    return JSONResponse(session.packages.begin(session.opened, workbook, {}, motions_made).about)


async def _about(request: Request) -> Response:
    return JSONResponse(_package(request).about)


async def _cancel(request: Request) -> Response:
    package = _package(request)
    package.cancel()
    return JSONResponse(package.about)


async def _file(request: Request) -> Response:
    package, name = _package(request), request.path_params["name"]
    path = package.out / name
    if package.state is not State.DONE or name not in (*OUTPUTS, PROJECT) or not path.is_file():
        raise HTTPException(404, "There is no such file of this package")
    return _attached(FileResponse(path, media_type=TYPES[path.suffix]), path.name)


def _attached(response: Response, name: str) -> Response:
    # A header is ASCII, and a quote would end the name.
    plain = "".join(letter for letter in name if letter.isalnum() or letter in " -_.()")
    ascii_name = plain.encode("ascii", "ignore").decode() or "input.xlsx"
    response.headers["Content-Disposition"] = f'attachment; filename="{ascii_name}"'
    return response


def _package(request: Request) -> Package:
    package = session_of(request).packages.find(request.path_params["id"])
    if package is None:
        raise HTTPException(404, "There is no such package")
    return package
