"""What the page gives away: the workbook with its values, and packages with their progress.

Read `workbook`, then `package_routes`.
"""

from __future__ import annotations

import secrets
from typing import Any

from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, Response
from starlette.routing import Route

from report.making import OUTPUTS
from report.web.desk import RefusedError, desk_of, session_of
from report.web.packages import TYPES, Package, State, copied
from report.web.receiving import receive_json, received
from report.web.uploads import remove
from report.web.worker import PROJECT, motions_made
from report.web.workers import Rank
from solver.model import InputError


def package_routes() -> list[Route]:
    """Return the routes of packages."""
    return [
        Route("/api/package", _begin, methods=["POST"]),
        Route("/api/motions", _motions, methods=["POST"]),
        Route("/api/package/{ticket}", _about, methods=["GET"]),
        Route("/api/package/{ticket}", _cancel, methods=["DELETE"]),
        Route("/api/package/{ticket}/{name}", _file, methods=["GET"]),
    ]


async def workbook(request: Request) -> Response:
    """Return the workbook with the values written into its cells."""
    session, values = session_of(request), (await receive_json(request)).values
    path = session.folder / f"written-{secrets.token_hex(8)}.xlsx"
    try:
        await desk_of(request).ask(session, _writing(values, str(path)), Rank.AT_REST)
        data = await run_in_threadpool(path.read_bytes)
    finally:
        await run_in_threadpool(path.unlink, missing_ok=True)
    return _attached(Response(data, media_type=TYPES[".xlsx"]), session.workbook.name)


async def _begin(request: Request) -> Response:
    session, desk = session_of(request), desk_of(request)
    values = (await receive_json(request)).values
    opened = session.workbook
    path = session.folder / f"package-{secrets.token_hex(8)}" / opened.name
    writing = _writing(values, str(path)) | {"workbook": str(opened)}
    try:
        await run_in_threadpool(copied, opened, path.parent)
        await desk.ask(session, writing, Rank.AT_REST)
    except (OSError, RefusedError):
        await run_in_threadpool(remove, path.parent)
        if session.workbook == opened:
            raise
    if session.workbook != opened:
        raise InputError("Another workbook was opened meanwhile; make the package again.")
    return JSONResponse(desk.packages.about(desk.packages.begin(session, path, values)))


async def _motions(request: Request) -> Response:
    """Begin a suite of motions for a workbook without any, which is sent again for it."""
    session, packages = session_of(request), desk_of(request).packages
    folder = session.folder / f"package-{secrets.token_hex(8)}"
    folder.mkdir()
    workbook = await received(request, folder)
    await packages.cancel_unfinished(session, [motions_made])
    return JSONResponse(packages.about(packages.begin(session, workbook, {}, motions_made)))


def _writing(values: Any, to: str) -> dict[str, Any]:
    return {"do": "write", "values": values, "to": to}


async def _about(request: Request) -> Response:
    return JSONResponse(desk_of(request).packages.about(_package(request)))


async def _cancel(request: Request) -> Response:
    package = _package(request)
    await desk_of(request).packages.cancel(package)
    return JSONResponse(desk_of(request).packages.about(package))


async def _file(request: Request) -> Response:
    package, name = _package(request), request.path_params["name"]
    path = package.out / name
    if package.state is not State.DONE or name not in (*OUTPUTS, PROJECT) or not path.is_file():
        raise HTTPException(404, "There is no such file of this package")
    response = FileResponse(path, media_type=TYPES[path.suffix])
    return response if "view" in request.query_params else _attached(response, name)


def _attached(response: Response, name: str) -> Response:
    plain = "".join(letter for letter in name if letter.isalnum() or letter in " -_.()")
    ascii_name = plain.encode("ascii", "ignore").decode() or "input.xlsx"
    response.headers["Content-Disposition"] = f'attachment; filename="{ascii_name}"'
    return response


def _package(request: Request) -> Package:
    found = desk_of(request).packages.find(session_of(request), request.path_params["ticket"])
    if found is None:
        raise HTTPException(404, "There is no such package in this session")
    return found
