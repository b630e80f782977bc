"""Who may ask: a token that is good once, the key it is exchanged for, and tickets of downloads.

The page keeps the key in its own storage and sends it in a header. A cookie would go to every other
port of this machine as well. Read `Access`.

Connections that have not shown the key: of too many, the oldest ends.
"""

from __future__ import annotations

import asyncio
import hmac
import secrets
from collections.abc import Collection
from pathlib import Path

from starlette.datastructures import MutableHeaders
from starlette.requests import HTTPConnection
from starlette.responses import JSONResponse, PlainTextResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from uvicorn.protocols.http.h11_impl import H11Protocol

MOST = 200
"""Most connections without the key; a browser has six."""

Peer = tuple[str, int]
"""Host and port of the other end."""


class Strangers:
    """The connections that have not shown the key, the oldest first."""

    def __init__(self) -> None:
        self._open: dict[Peer, asyncio.Transport] = {}

    def add(self, transport: asyncio.Transport) -> None:
        """Take note of a new connection, and end the oldest where there are too many."""
        self._open[_peer(transport)] = transport
        if len(self._open) > MOST:
            self._open.pop(next(iter(self._open))).abort()

    def forget(self, peer: Peer) -> None:
        """Let a connection be: it has shown the key, or has ended."""
        self._open.pop(peer, None)

    def protocol(self) -> type[asyncio.Protocol]:
        """Return the protocol of HTTP that tells of its connections."""
        strangers = self

        class Protocol(H11Protocol):
            def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
                super().connection_made(transport)
                strangers.add(transport)

            def connection_lost(self, exc: Exception | None) -> None:
                strangers.forget(_peer(self.transport))
                super().connection_lost(exc)

        return Protocol


def _peer(transport: asyncio.Transport) -> Peer:
    host, port = transport.get_extra_info("peername")[:2]
    return host, port


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
KEY_HEADER, TOKEN_HEADER = "Roofslip-Key", "Roofslip-Token"
ENTRY = "/api/key"
"""Where the page exchanges the token of its address for the key."""


class Keys:
    """What opens a server: its key, its tokens and the tickets of its downloads.

    Parameters
    ----------
    lasting : str
        A token that stays good, as that of a file; empty for none.

    Attributes
    ----------
    key : str
        What every request must show, but for the page itself.
    """

    def __init__(self, lasting: str = "") -> None:
        self.key = secrets.token_urlsafe(32)
        self._lasting = lasting
        self._tokens: set[str] = set()
        self._tickets: dict[str, Path] = {}

    def token(self) -> str:
        """Return a new token, which is good once."""
        token = secrets.token_urlsafe(24)
        self._tokens.add(token)
        return token

    def is_good(self, token: str) -> bool:
        """Whether a token can be exchanged for the key."""
        known = [*self._tokens, self._lasting]
        return bool(token) and any(_is_same(token, each) for each in known)

    def exchange(self, token: str) -> str | None:
        """Return the key for a token that is good; unless it lasts, it is used then."""
        if not self.is_good(token):
            return None
        self._tokens.discard(token)
        return self.key

    def ticket(self, file: Path) -> str:
        """Return a ticket of a file, which is good once."""
        ticket = secrets.token_urlsafe(24)
        self._tickets[ticket] = file
        return ticket

    def redeem(self, ticket: str) -> Path | None:
        """Return the file of a ticket that is good, which is used then."""
        return self._tickets.pop(ticket, None)


class Access:
    """Answers requests that may not pass.

    Parameters
    ----------
    hosts : collection of str
        Values of Host that are answered; empty for any, where the server listens on all addresses.
    strangers : Strangers
        The connections that have not shown the key.
    """

    def __init__(
        self, app: ASGIApp, keys: Keys, hosts: Collection[str], strangers: Strangers
    ) -> None:
        self._app, self._keys, self._hosts, self._strangers = app, keys, hosts, strangers

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer one request."""

        async def with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                for name, value in HEADERS.items():
                    headers.setdefault(name, value)
            await send(message)

        refusal = self._refusal(HTTPConnection(scope)) if scope["type"] == "http" else None
        await (refusal or self._app)(scope, receive, with_headers)

    def _refusal(self, request: HTTPConnection) -> Response | None:
        """Return the answer to a request that may not pass; the page itself has no secret."""
        path = request.scope["path"]
        if self._hosts and request.headers.get("host", "") not in self._hosts:
            return PlainTextResponse("This server does not answer to that name.", 421)
        if not path.startswith("/api/") or path == ENTRY:
            return None
        if not _is_same(request.headers.get(KEY_HEADER, ""), self._keys.key):
            return JSONResponse({"error": "This page has no key of this server."}, 401)
        if request.client:
            self._strangers.forget(request.client)
        return None


def _is_same(token: str, known: str) -> bool:
    """Compare secrets in a time that tells nothing of them."""
    return hmac.compare_digest(token.encode(), known.encode())
