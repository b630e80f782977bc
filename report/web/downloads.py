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
from report.web.receiving import receive_json, received, remove
from report.web.session import RefusedError, desk_of
from report.web.worker import PROJECT, TYPES, Package, State, copied, motions_made
from solver.model import InputError


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
    desk, values = desk_of(request), (await receive_json(request)).values
    name = desk.workbook.name
    path = desk.folder / f"written-{secrets.token_hex(8)}.xlsx"
    try:
        await desk.ask(_writing(values, str(path)))
        data = await run_in_threadpool(path.read_bytes)
    finally:
        await run_in_threadpool(path.unlink, missing_ok=True)
    return _attached(Response(data, media_type=TYPES[".xlsx"]), name)


async def _filled(request: Request) -> Response:
    path = desk_of(request).filled
    return _attached(FileResponse(path, media_type=TYPES[".xlsx"]), path.name)


async def _begin(request: Request) -> Response:
    desk, values = desk_of(request), (await receive_json(request)).values
    opened, workbook = desk.opened, desk.workbook
    path = desk.folder / f"package-{secrets.token_hex(8)}" / workbook.name
    try:
        await run_in_threadpool(copied, workbook, path.parent)
        await desk.ask(_writing(values, str(path)) | {"workbook": str(workbook)})
    except (OSError, RefusedError):
        await run_in_threadpool(remove, path.parent)
        if desk.workbook == workbook:
            raise
    if desk.workbook != workbook:
        raise InputError("Another workbook was opened meanwhile; make the package again.")
    return JSONResponse(desk.packages.begin(opened, path, values).about)


async def _motions(request: Request) -> Response:
    """Begin a suite of motions for a workbook without any, which is sent again for it."""
    desk = desk_of(request)
    folder = desk.folder / f"package-{secrets.token_hex(8)}"
    folder.mkdir()
    workbook = await received(request, folder)
    desk.packages.cancel(motions_made)
    return JSONResponse(desk.packages.begin(desk.opened, workbook, {}, motions_made).about)


def _writing(values: Any, to: str) -> dict[str, Any]:
    return {"do": "write", "values": values, "to": to}


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
    plain = "".join(letter for letter in name if letter.isalnum() or letter in " -_.()")
    ascii_name = plain.encode("ascii", "ignore").decode() or "input.xlsx"
    response.headers["Content-Disposition"] = f'attachment; filename="{ascii_name}"'
    return response


def _package(request: Request) -> Package:
    package = desk_of(request).packages.find(request.path_params["id"])
    if package is None:
        raise HTTPException(404, "There is no such package")
    return package
