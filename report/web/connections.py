"""Connections that have not shown the key: of too many, the oldest ends.

Without it, those of others that send nothing would take all that the system allows. Read
`Strangers`.
"""

from __future__ import annotations

import asyncio

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
