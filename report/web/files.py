"""Browser uploads, stored in a folder of their own, and downloads from the page.

Read `received`, then `package_routes`.
"""

from __future__ import annotations

import secrets
import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic import ValidationError
from starlette.concurrency import run_in_threadpool
from starlette.datastructures import FormData, UploadFile
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, Response
from starlette.routing import Route

from report.motions.stored import MB, MOST_FILES, MOST_SENT, store
from report.results.publish import OUTPUTS
from report.web.session import Asked, RefusedError, session_of
from report.web.worker import PROJECT, TYPES, Package, State, copied, motions_made
from solver.errors import InputError


def is_alone(workbook: Path, folder: Path) -> bool:
    """Whether a workbook was uploaded without any other file."""
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
    session_of(request).workbook(asked.opened)  # which says so where it is closed
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
    """Reject a body that is too long, or does not state its length, as every browser does."""
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
    asked = await receive_json(request)
    current = session_of(request).workbook(asked.opened)
    job = {"do": "write", "workbook": str(current), "values": asked.values}
    return await _written(request, job, current.name)


async def blank(request: Request) -> Response:
    """Return a workbook without inputs, in a system of units."""
    units = "SI" if request.query_params.get("units") == "SI" else "US"
    return await _written(request, {"do": "blank", "units": units}, "input.xlsx")


async def _written(request: Request, job: Mapping[str, Any], name: str) -> Response:
    """Return a workbook that a job writes."""
    session = session_of(request)
    path = session.folder / f"written-{secrets.token_hex(8)}.xlsx"
    try:
        await session.ask({**job, "to": str(path)})
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
    session, asked = session_of(request), await receive_json(request)
    opened, values = asked.opened or session.opened, asked.values
    workbook = session.workbook(opened)
    path = session.folder / f"package-{secrets.token_hex(8)}" / workbook.name
    try:
        await run_in_threadpool(copied, workbook, path.parent)
        job = {"do": "write", "workbook": str(workbook), "values": values, "to": str(path)}
        await session.ask(job)
    except (OSError, RefusedError):
        await run_in_threadpool(shutil.rmtree, path.parent, ignore_errors=True)
        session.workbook(opened)  # where it was closed meanwhile the files are gone for that
        raise
    return JSONResponse(session.packages.begin(opened, path, values).about)


async def _motions(request: Request) -> Response:
    """Begin a suite of motions for a workbook without any, which is sent again for it."""
    session = session_of(request)
    folder = session.folder / f"package-{secrets.token_hex(8)}"
    folder.mkdir()
    workbook = await received(request, folder)
    session.packages.cancel(task=motions_made)
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
