"""The routes of the page, each from a request to an answer.

Computes nothing (`jobs`) and admits nobody (`access`). Read `made`.
"""

from __future__ import annotations

import mimetypes
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, Response
from starlette.routing import Mount, Route
from starlette.staticfiles import StaticFiles

from report.web import jobs
from report.web.access import Access, Gate
from report.web.problems import problems
from report.web.sessions import EXAMPLE, Session, Sessions
from solver.model import InputError

STATIC = Path(__file__).resolve().parent / "static"

# Windows takes the type of a file from its registry, where scripts may be plain text.
mimetypes.add_type("text/javascript", ".js")
mimetypes.add_type("image/svg+xml", ".svg")


def made(gate: Gate, sessions: Sessions) -> Starlette:
    """Return the application."""
    return Starlette(
        routes=[
            Route("/", _index),
            Route("/api/state", _state),
            Route("/api/example", _example, methods=["POST"]),
            Route("/api/assess", _assess, methods=["POST"]),
            Mount("/static", StaticFiles(directory=STATIC)),
        ],
        middleware=[Middleware(Access, gate=gate, sessions=sessions)],
        exception_handlers={InputError: _refused},
    )


async def _index(_: Request) -> Response:
    return FileResponse(STATIC / "index.html")


async def _state(request: Request) -> Response:
    return await _whole_state(_session(request))


async def _example(request: Request) -> Response:
    session = _session(request)
    session.project = EXAMPLE
    return await _whole_state(session)


async def _assess(request: Request) -> Response:
    session, asked = _session(request), await _json(request)
    values, is_moving = asked.get("values", {}), bool(asked.get("moving"))
    workbook = session.project / "input.xlsx"
    try:
        found = await run_in_threadpool(jobs.assessed, workbook, values, is_moving=is_moving)
    except InputError as error:
        lines = problems(workbook, error.problems)
        return JSONResponse({"error": error.problems[0], "problems": lines}, 422)
    return JSONResponse({"n": asked.get("n", 0), **found})


async def _whole_state(session: Session) -> Response:
    workbook = session.project / "input.xlsx"
    found = dict(await run_in_threadpool(jobs.state, workbook, workbook.name))
    if found["project"]:
        found["project"] = found["project"] | {"is_example": session.is_example}
    return JSONResponse(found)


def _session(request: Request) -> Session:
    session: Session = request.state.session
    return session


async def _json(request: Request) -> Mapping[str, Any]:
    """Return the body of a request.

    Raises
    ------
    InputError
    """
    try:
        asked = await request.json()
    except ValueError as error:
        raise InputError("the request is not JSON; load the page again") from error
    if not isinstance(asked, dict) or not isinstance(asked.get("values", {}), dict):
        raise InputError("the request is not what the page sends; load the page again")
    return asked


async def _refused(_: Request, error: Exception) -> Response:
    lines = error.problems if isinstance(error, InputError) else [str(error)]
    return JSONResponse({"error": lines[0], "problems": []}, 400)
