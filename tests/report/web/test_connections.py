"""Connections of others that send nothing, over loopback."""

import http.client
import socket
import threading
from contextlib import ExitStack, closing

import pytest
import uvicorn
from starlette.applications import Starlette
from starlette.responses import PlainTextResponse
from starlette.routing import Route

from report.web.access import KEY_HEADER, MOST, Access, Keys, Strangers

pytestmark = pytest.mark.quick

WAIT_S = 10.0


@pytest.fixture(scope="module")
def keys():
    return Keys()


@pytest.fixture(scope="module")
def address(keys):
    strangers = Strangers()
    routes = [Route("/", lambda _: PlainTextResponse("page")),
              Route("/api/state", lambda _: PlainTextResponse("state"))]  # fmt: skip
    app = Access(Starlette(routes=routes), keys, [], strangers)
    with socket.create_server(("127.0.0.1", 0), backlog=2048) as listening:
        config = uvicorn.Config(app, http=strangers.protocol(), log_level="critical")
        config.timeout_graceful_shutdown = 1
        server = uvicorn.Server(config)
        thread = threading.Thread(target=server.run, kwargs={"sockets": [listening]})
        thread.start()
        try:
            yield listening.getsockname()
        finally:
            server.should_exit = True
            thread.join(WAIT_S)


def connected(address):
    return closing(socket.create_connection(address, timeout=WAIT_S))


def is_closed(client):
    try:
        return client.recv(100) == b""
    except ConnectionError:
        return True


def asked(page, path, **headers):
    page.request("GET", path, headers=headers)
    answer = page.getresponse()
    return answer.status, answer.read()


@pytest.mark.parametrize("begun", [b"", b"GET / HT", b"POST /api/state HTTP/1.1\r\nX: "])
def test_slow_connections_of_others_never_take_the_page(address, keys, begun):
    key = {KEY_HEADER: keys.key}
    with ExitStack() as stack:
        page = http.client.HTTPConnection(*address, timeout=WAIT_S)
        stack.enter_context(closing(page))
        assert asked(page, "/api/state", **key) == (200, b"state")
        mine = page.sock.getsockname()
        others = [stack.enter_context(connected(address)) for _ in range(2 * MOST)]
        for other in others:
            try:
                other.sendall(begun)
            except ConnectionError:
                continue
        # What has shown the key stays, and what comes new is answered.
        assert asked(page, "/api/state", **key) == (200, b"state")
        assert page.sock.getsockname() == mine
        new = http.client.HTTPConnection(*address, timeout=WAIT_S)
        stack.enter_context(closing(new))
        assert asked(new, "/") == (200, b"page")
        assert is_closed(others[0])
        others[-1].settimeout(0.1)
        with pytest.raises(TimeoutError):
            others[-1].recv(1)
