"""Access control: a one-time token, and the key that it is exchanged for.

The page keeps the key in its own storage and sends it in a header. A cookie would go to every other
port of this machine as well. Read `Access`.
"""

from __future__ import annotations

import asyncio
import hmac
import secrets
from collections.abc import Collection

from starlette.datastructures import MutableHeaders
from starlette.requests import HTTPConnection
from starlette.responses import JSONResponse, PlainTextResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

HEADERS = {
    # Nothing of another origin is loaded, and no other page may frame this one.
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
KEY_HEADER, TOKEN_HEADER = "Roofslip-Key", "Roofslip-Token"
ENTRY = "/api/key"
"""Where the page exchanges the token of its address for the key."""


class Keys:
    """The key and the tokens of a server.

    Parameters
    ----------
    lasting : str
        A reusable token, such as that of a file; empty if none.

    Attributes
    ----------
    key : str
        What every request must show, but for the page itself.
    """

    def __init__(self, lasting: str = "") -> None:
        self.key = secrets.token_urlsafe(32)
        self._lasting = lasting
        self._tokens: set[str] = set()

    def token(self) -> str:
        """Return a new one-time token."""
        token = secrets.token_urlsafe(24)
        self._tokens.add(token)
        return token

    def is_good(self, token: str) -> bool:
        """Whether a token can be exchanged for the key."""
        known = [*self._tokens, self._lasting]
        return bool(token) and any(_is_same(token, each) for each in known)

    def exchange(self, token: str) -> str | None:
        """Return the key for a valid token; a one-time token is then used up."""
        if not self.is_good(token):
            return None
        # Good once: the address that has it may be copied, or stay in a history.
        self._tokens.discard(token)
        return self.key


class Access:
    """Rejects requests without access.

    Parameters
    ----------
    hosts : collection of str
        Values of Host that are answered; empty for any, where the server listens on all addresses.
    """

    def __init__(self, app: ASGIApp, keys: Keys, hosts: Collection[str]) -> None:
        self._app, self._keys, self._hosts = app, keys, hosts

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer one request; where the server ends meanwhile, with that."""
        is_begun = False

        async def with_headers(message: Message) -> None:
            nonlocal is_begun
            is_begun = True
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                for name, value in HEADERS.items():
                    headers.setdefault(name, value)
            await send(message)

        refusal = self._refusal(HTTPConnection(scope)) if scope["type"] == "http" else None
        try:
            await (refusal or self._app)(scope, receive, with_headers)
        except asyncio.CancelledError:
            # Raised on, the server that cancels what it no longer waits for prints it as a defect.
            if scope["type"] == "http" and not is_begun:
                await JSONResponse({"error": "The server ends."}, 503)(scope, receive, with_headers)

    def _refusal(self, request: HTTPConnection) -> Response | None:
        """Return the rejection of a request without access; the page itself contains no secret."""
        path = request.scope["path"]
        # Another site may give its own name the address of this machine.
        if self._hosts and request.headers.get("host", "") not in self._hosts:
            return PlainTextResponse("This server does not answer to that name.", 421)
        # The page and its files hold nothing of a project; the entry takes a token instead.
        if not path.startswith("/api/") or path == ENTRY:
            return None
        if not _is_same(request.headers.get(KEY_HEADER, ""), self._keys.key):
            return JSONResponse({"error": "This page has no key of this server."}, 401)
        return None


def _is_same(token: str, known: str) -> bool:
    """Compare secrets in constant time."""
    return hmac.compare_digest(token.encode(), known.encode())
