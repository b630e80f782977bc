"""Bodies of requests, counted while they arrive: JSON, and files to be stored.

Read `received`.
"""

from __future__ import annotations

from pathlib import Path

from pydantic import ValidationError
from starlette.concurrency import run_in_threadpool
from starlette.datastructures import FormData, UploadFile
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.types import Message

from report.web.desk import Asked, OtherProjectError, desk_of
from report.web.uploads import MB, MOST_FILES, MOST_SENT, remove, store
from solver.model import InputError

MOST_JSON = 100_000
_MOST_FIELDS = 10


async def receive_json(request: Request) -> Asked:
    """Return a request of the page about what is open.

    Raises
    ------
    InputError, HTTPException, OtherProjectError
    """
    capped = _capped(request, MOST_JSON)
    if request.headers.get("content-type", "").partition(";")[0] != "application/json":
        raise HTTPException(415, "Send JSON")
    try:
        asked = Asked.model_validate_json(await capped.body())
    except ValidationError as error:
        raise InputError("the request is not one of the page; load the page again") from error
    if asked.opened not in (None, desk_of(request).opened):
        raise OtherProjectError
    return asked


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
