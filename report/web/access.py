"""Who may ask: the token of the first address, the cookie of a session, Host and Origin.

Every answer gets the headers that keep a page to its own server. Read `Access`.
"""

from __future__ import annotations

import hmac
from collections.abc import Collection
from dataclasses import dataclass, field

from starlette.datastructures import MutableHeaders
from starlette.requests import HTTPConnection
from starlette.responses import JSONResponse, PlainTextResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from report.web.limits import FULL, is_full
from report.web.sessions import Session, Sessions

HEADERS = {
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self'; "
    "img-src 'self' data: blob:; font-src 'self'; connect-src 'self'; form-action 'self'; "
    "base-uri 'none'; frame-ancestors 'none'",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-store",
}
_NO_SESSION = "Open the address that roofslip serve printed, with its token."


@dataclass(frozen=True, slots=True, kw_only=True)
class Gate:
    """What a request must show.

    Attributes
    ----------
    token : str
    hosts : collection of str
        Values of Host that are answered; empty for any, where the server listens on all addresses.
    cookie : str
        Name of the cookie: browsers do not tell ports apart.
    """

    token: str = field(repr=False)
    hosts: Collection[str]
    cookie: str


class Access:
    """Answers requests that may not pass, and gives each of the others its session."""

    def __init__(self, app: ASGIApp, gate: Gate, sessions: Sessions) -> None:
        self._app, self._gate, self._sessions = app, gate, sessions

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer one request."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return

        async def with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                for name, value in HEADERS.items():
                    headers.setdefault(name, value)
            await send(message)

        try:
            found = self._admitted(HTTPConnection(scope))
        except OSError as error:
            if not is_full(error):
                raise
            found = PlainTextResponse(FULL, 507)
        if isinstance(found, Response):
            await found(scope, receive, with_headers)
            return
        scope.setdefault("state", {})["session"] = found
        await self._app(scope, receive, with_headers)

    def _admitted(self, request: HTTPConnection) -> Session | Response:
        """Return the session of a request, or the answer to one that may not pass."""
        path = request.scope["path"]
        if self._gate.hosts and request.headers.get("host", "") not in self._gate.hosts:
            return PlainTextResponse("This server does not answer to that name.", 421)
        if request.scope["method"] not in ("GET", "HEAD") and not _is_of_same_origin(request):
            return JSONResponse({"error": "A request of another site is not answered."}, 403)
        token = request.query_params.get("token", "")
        session = self._sessions.find(request.cookies.get(self._gate.cookie, ""))
        if path == "/" and token:
            return self._let_in(request.scope, token, session)
        if session is not None:
            return session
        if path.startswith("/api/"):
            return JSONResponse({"error": f"This session has ended. {_NO_SESSION}"}, 401)
        return PlainTextResponse(_NO_SESSION, 403)

    def _let_in(self, scope: Scope, token: str, session: Session | None) -> Response:
        """Exchange the token for the cookie of a session, and leave it out of the address."""
        if not hmac.compare_digest(token.encode(), self._gate.token.encode()):
            return PlainTextResponse(f"The token is not that of this server. {_NO_SESSION}", 403)
        response = RedirectResponse("/", 303)
        response.set_cookie(
            self._gate.cookie,
            (session or self._sessions.begin()).id,
            httponly=True,
            samesite="strict",
            secure=scope["scheme"] == "https",
        )
        return response


def _is_of_same_origin(request: HTTPConnection) -> bool:
    """Whether a page of this server sent a request, as its browser tells."""
    site = request.headers.get("sec-fetch-site", "")
    if site:
        return site == "same-origin"
    here = f"{request.scope['scheme']}://{request.headers.get('host', '')}"
    return request.headers.get("origin", "") == here
