"""Bodies of requests, counted while they arrive: JSON, and files to be stored.

Read `received`.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from starlette.concurrency import run_in_threadpool
from starlette.datastructures import FormData, UploadFile
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.types import Message

from report.web.desk import session_of
from report.web.uploads import MB, MOST_FILES, MOST_SENT, remove, store
from solver.model import InputError

MOST_JSON = 100_000
_MOST_FIELDS = 10
_MOST_VALUES = 40
_MOST_NUMBER = 2**53


async def receive_json(request: Request) -> dict[str, Any]:
    """Return a request of the page about what is open: its values, its number and its page.

    A script that does not name what is open asks about whatever it is.

    Raises
    ------
    InputError, HTTPException, OtherProjectError
    """
    capped = _capped(request, MOST_JSON)
    if request.headers.get("content-type", "").partition(";")[0] != "application/json":
        raise HTTPException(415, "Send JSON")
    try:
        asked = json.loads(await capped.body())
    except (ValueError, RecursionError) as error:
        raise InputError("the request is no JSON; load the page again") from error
    if not _is_request(asked):
        raise InputError("the request is not one of the page; load the page again")
    found: Mapping[str, Any] = asked
    session = session_of(request)
    session.check_opened(found.get("opened", session.opened))
    return {"page": "", "n": 0, "values": {}} | dict(found)


def _is_request(asked: object) -> bool:
    if not isinstance(asked, dict):
        return False
    page, number, values = asked.get("page", ""), asked.get("n", 0), asked.get("values", {})
    room = asked.get("room", 0)
    return (
        isinstance(page, str)
        and len(page) <= 100
        and isinstance(number, int)
        and abs(number) <= _MOST_NUMBER
        and isinstance(room, int)
        and isinstance(values, dict)
        and len(values) <= _MOST_VALUES
        and all(isinstance(value, int | float | str) for value in values.values())
    )


async def received(request: Request, folder: Path) -> Path:
    """Store the files of a request in a folder and return the workbook among them.

    Raises
    ------
    InputError, HTTPException
        The folder is then removed.
    """
    try:
        form = await _form(request)
        try:
            files = [
                (part.filename or "", part.file)
                for part in form.getlist("files")
                if isinstance(part, UploadFile)
            ]
            return await run_in_threadpool(store, files, folder)
        finally:
            await form.close()
    except BaseException:
        await run_in_threadpool(remove, folder)
        raise


async def _form(request: Request) -> FormData:
    """Return the files of a request; errors of the form are those of what was dropped."""
    capped = _capped(request, MOST_SENT)
    try:
        return await capped.form(max_files=MOST_FILES, max_fields=_MOST_FIELDS)
    except HTTPException as error:
        if error.status_code != 400:
            raise
        if error.detail.startswith("Too many files"):
            raise InputError(
                f"more than {MOST_FILES} files; drop the workbook and its records"
            ) from error
        raise InputError("the files did not arrive whole; drop them again") from error


def _capped(request: Request, maximum: int) -> Request:
    """Return a request whose body ends in an error where it is too long."""
    length = request.headers.get("content-length", "0")
    too_long = HTTPException(413, f"More than {maximum / MB:g} MB; drop fewer records")
    if not length.isdecimal() or int(length) > maximum:
        raise too_long
    left = maximum

    async def receive() -> Message:
        nonlocal left
        message = await request.receive()
        left -= len(message.get("body", b""))
        if left < 0:
            raise too_long
        return message

    return Request(request.scope, receive)
