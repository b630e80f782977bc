"""Connections of the page: how slowly a request may arrive, and how many one address may have.

uvicorn limits the time between requests alone: one that never comes whole would stay for ever. An
answer takes as long as it takes. Read `TimedProtocol`.
"""

from __future__ import annotations

import asyncio

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

_TOO_MANY = b"This address has too many connections. Close other tabs, then try it again.\n"
_REFUSED = (
    b"HTTP/1.1 503 Service Unavailable\r\nConnection: close\r\nContent-Type: text/plain\r\n"
    b"Content-Length: %d\r\n\r\n%s" % (len(_TOO_MANY), _TOO_MANY)
)


class TimedProtocol(H11Protocol):
    """A connection that ends where a request does not come whole in time.

    Attributes
    ----------
    longest_s : float
        For head and body together [s], from when the connection is ready for them; as many servers
        allow for a head.
    slowest_bytes_per_s : float
        Rate of a body that takes longer [bytes/s]; less than any line that is in use.
    most : int
        Connections of one address. A browser has six, and all of a reverse proxy have its address.
    """

    longest_s = 10.0
    slowest_bytes_per_s = 5000.0
    most = 200

    _timer: asyncio.TimerHandle | None = None
    _began_s = 0.0
    _received = 0

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Begin to wait for a request, or refuse the connection."""
        super().connection_made(transport)
        if self._of_address() > self.most:
            transport.write(_REFUSED)
            transport.close()
        else:
            self._follow()

    def data_received(self, data: bytes) -> None:
        """Count what arrives."""
        self._received += len(data)
        super().data_received(data)

    def handle_events(self) -> None:
        """Handle what arrived; called as well where a request follows the one before at once."""
        super().handle_events()
        self._follow()

    def connection_lost(self, exc: Exception | None) -> None:
        """End the time with the connection."""
        self._stop()
        super().connection_lost(exc)

    def _of_address(self) -> int:
        """Return how many connections this address has."""
        assert self.client is not None
        clients = (getattr(each, "client", None) for each in self.connections)
        return sum(client is not None and client[0] == self.client[0] for client in clients)

    def _follow(self) -> None:
        """Measure the time while a request is awaited or not whole."""
        if self.conn.their_state not in (h11.IDLE, h11.SEND_BODY):
            self._stop()
        elif self._timer is None:
            self._began_s, self._received = self.loop.time(), 0
            self._timer = self.loop.call_later(self.longest_s, self._check)

    def _check(self) -> None:
        """End the connection, or wait for as long as what arrived allows."""
        allowed_s = self.longest_s + self._received / self.slowest_bytes_per_s
        if (left_s := self._began_s + allowed_s - self.loop.time()) <= 0.0:
            self.transport.abort()
        else:
            self._timer = self.loop.call_later(left_s, self._check)

    def _stop(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
