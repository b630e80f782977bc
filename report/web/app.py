"""The routes of the page, each from a request to an answer.

Computes nothing (`workers`) and admits nobody (`access`). Read `made`.
"""

from __future__ import annotations

import json
import mimetypes
import shutil
from collections.abc import AsyncIterator, Awaitable, Callable, Collection, Mapping, Sequence
from contextlib import asynccontextmanager
from functools import partial
from pathlib import Path
from typing import Any

from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.requests import ClientDisconnect, Request
from starlette.responses import FileResponse, JSONResponse, Response
from starlette.routing import Mount, Route
from starlette.staticfiles import StaticFiles

from report.typeset.pdf import TEMPLATES
from report.web.access import ENTRY, TOKEN_HEADER, Access, Keys
from report.web.files import blank, is_alone, package_routes, receive_json, received, workbook
from report.web.session import (
    EXAMPLE,
    EXAMPLE_NAME,
    ClosedError,
    LostError,
    RefusedError,
    Session,
    StaleError,
    session_of,
)
from report.web.worker import FULL, copied, is_full
from solver.errors import InputError

STATIC = Path(__file__).parent / "static"

# Windows takes the type of a file from its registry, where scripts may be plain text.
mimetypes.add_type("text/javascript", ".js")
mimetypes.add_type("image/svg+xml", ".svg")


def made(keys: Keys, folder: Path, hosts: Collection[str]) -> Starlette:
    """Return the application; uploads and outputs are in a folder; hosts as in `Access`."""
    session = Session(folder)

    @asynccontextmanager
    async def lifespan(app: Starlette) -> AsyncIterator[None]:
        app.state.session, app.state.keys = session, keys
        session.start()
        yield
        await session.stop()

    return Starlette(
        routes=[
            Route("/", _index),
            Route("/p/{project}/", _index),  # the page compares it with what is open
            Route(ENTRY, _key, methods=["POST"]),
            Route("/api/token", _token, methods=["POST"]),
            Route("/api/state", _state),
            Route("/api/example", _example, methods=["POST"]),
            Route("/api/upload", partial(_open_new, store=received), methods=["POST"]),
            *(
                Route(path, partial(_open_new, store=partial(_filled, do=do)), methods=["POST"])
                for path, do in (("/api/plan", "read_plan"), ("/api/cells", "fill_in"))
            ),
            Route("/api/clearances", partial(_changed, do="add_clearances"), methods=["POST"]),
            Route("/api/edit", partial(_changed, do="fill_in"), methods=["POST"]),
            *(Route(f"/api/{name}", _job, methods=["POST"]) for name in _JOBS),
            Route("/api/workbook", workbook, methods=["POST"]),
            Route("/api/blank", blank),
            *package_routes(),
            Mount("/static/fonts", StaticFiles(directory=TEMPLATES / "fonts")),
            Mount("/static", StaticFiles(directory=STATIC)),
        ],
        middleware=[Middleware(Access, keys=keys, hosts=hosts)],
        exception_handlers=dict.fromkeys((InputError, HTTPException, OSError, *_TOLD), _failed),
        lifespan=lifespan,
    )


_JOBS = {
    "assess": (),
    "verdict": (),
    "tables": (),
    "slide": ("array", "motion"),
    "contour": ("array",),
}
"""What the page has computed, each with what must be named; a run may be."""


def keys_of(request: Request) -> Keys:
    """Return the keys of the server."""
    keys: Keys = request.app.state.keys
    return keys


async def _index(request: Request) -> Response:
    """Return the page, which says how to get another address where its token is not good."""
    token = request.query_params.get("token")
    is_good = token is None or keys_of(request).is_good(token)
    return FileResponse(STATIC / "index.html", 200 if is_good else 403)


async def _key(request: Request) -> Response:
    key = keys_of(request).exchange(request.headers.get(TOKEN_HEADER, ""))
    if not key:
        return _error("The token in this address is not valid.", 403)
    return JSONResponse({"key": key})


async def _token(request: Request) -> Response:
    """Return a token for another tab."""
    return JSONResponse({"token": keys_of(request).token()})


async def _state(request: Request) -> Response:
    """Return the project of the address where it is open, else what was opened last."""
    session = session_of(request)
    opened = session.named(request.query_params.get("project", ""))
    return JSONResponse(await _whole_state(request, opened, session.workbook(opened)))


async def _example(request: Request) -> Response:
    session_of(request).prepare(EXAMPLE)
    state = await _whole_state(request, EXAMPLE_NAME, EXAMPLE)
    session_of(request).open(EXAMPLE, state["project"]["id"])
    return JSONResponse(state)


async def _changed(request: Request, do: str) -> Response:
    """Open a copy of a project that a job changes: clearances of its plan, or cells as typed."""
    session, asked = session_of(request), await receive_json(request)
    current = session.workbook(asked.opened)

    async def copy(_: Request, folder: Path) -> Path:
        workbook = folder / "project" / current.name
        await run_in_threadpool(copied, current, workbook.parent)
        job = {"do": do, "workbook": str(current), "to": str(workbook)}
        await session.ask({**job, "cells": json.dumps(asked.cells)})
        return workbook

    return await _open_new(request, copy)


async def _filled(request: Request, folder: Path, do: str) -> Path:
    """Store a workbook that a job fills in: its plan from a drawing beside it, or typed cells."""
    session, workbook = session_of(request), await received(request, folder)
    filled = session.folder / f"filled-{folder.name}" / workbook.name
    filled.parent.mkdir()
    fields = {name: request.state.fields.get(name, "") for name in ("layers", "unit", "cells")}
    job = {"do": do, "workbook": str(workbook), "to": str(filled), **fields}
    request.state.lines = (await session.ask(job))["lines"]
    # One is opened, and one stays to be saved when the other has been replaced.
    await run_in_threadpool(shutil.copyfile, filled, workbook)
    session.filled = filled
    return workbook


async def _open_new(
    request: Request, store: Callable[[Request, Path], Awaitable[Path]]
) -> Response:
    """Open a workbook stored in a new folder, unless it has errors."""
    session = session_of(request)
    folder = session.new_folder()
    try:
        workbook = await store(request, folder)
        session.prepare(workbook)
        state = await _whole_state(request, folder.name, workbook)
    # Also where the browser has gone: nothing asks for the folder any more.
    except BaseException:
        await run_in_threadpool(shutil.rmtree, folder, ignore_errors=True)
        raise
    # A workbook with errors is not opened.
    if state["problems"]:
        state["is_alone"] = await run_in_threadpool(is_alone, workbook, folder)
        await run_in_threadpool(shutil.rmtree, folder, ignore_errors=True)
    else:
        session.open(workbook, state["project"]["id"])
    return JSONResponse(state | {"lines": getattr(request.state, "lines", [])})


async def _whole_state(request: Request, opened: str, workbook: Path) -> dict[str, Any]:
    session = session_of(request)
    package = session.packages.last(opened)
    about = {"opened": opened, "package": package.about if package else None}
    state = {**about, **await session.ask({"do": "state", "workbook": str(workbook)})}
    if state["project"]:
        state["project"] |= {"file": workbook.name, "is_example": workbook == EXAMPLE}
    return state


async def _job(request: Request) -> Response:
    """Answer at values, or with a view; the job has what was asked by the same names."""
    kind, asked = request.url.path.rpartition("/")[2], await receive_json(request)
    if missing := [name for name in _JOBS[kind] if getattr(asked, name) is None]:
        raise InputError(f"the request lacks {' and '.join(missing)}; name what is to be shown")
    job = {"do": kind, **asked.model_dump()}
    return JSONResponse(await session_of(request).ask(job, asked))


_TOLD: Mapping[type[Exception], tuple[int, str]] = {
    RefusedError: (422, ""),
    # By its number api.js tells a request that is replaced.
    StaleError: (409, "a newer request of this page came."),
    LostError: (503, "the process that computes has ended. Try it again."),
    ClosedError: (
        412, "this project is no longer open here. Open its workbook and records again."
    ),
    ClientDisconnect: (400, "the request did not arrive whole."),
}  # fmt: skip
"""Errors with their status, and what is said where they say nothing."""


async def _failed(_: Request, error: Exception) -> Response:
    if isinstance(error, HTTPException):
        return _error(f"{error.detail}.", error.status_code)
    if isinstance(error, InputError):
        return _error(str(error).partition("\n")[0], 422)
    if is_full(error):
        return _error(FULL, 507)
    if type(error) not in _TOLD:
        raise error
    status, sentence = _TOLD[type(error)]
    return _error(str(error) or sentence, status, getattr(error, "problems", ()))


def _error(sentence: str, status: int, problems: Sequence[Mapping[str, Any]] = ()) -> Response:
    about = {"error": sentence[:1].upper() + sentence[1:], "problems": list(problems)}
    return JSONResponse(about, status)
