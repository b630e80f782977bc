"""Requests that never come whole, and too many connections of one address, over loopback."""

import asyncio
import socket
import threading
import time
from contextlib import ExitStack, closing

import pytest
import uvicorn

from report.web.connections import TimedProtocol

REST_S = 10.0
HEAD = b"POST / HTTP/1.1\r\nHost: here\r\nContent-Length: %d\r\n\r\n"
WHOLE = HEAD % 0


class Short(TimedProtocol):
    longest_s = 0.3
    slowest_bytes_per_s = 20_000.0
    most = 4


async def answer(scope, receive, send):
    """Answer with the length of the body, in two parts where the path asks for a slow answer."""
    if scope["type"] != "http":
        return
    length, more = 0, True
    while more:
        message = await receive()
        if message["type"] == "http.disconnect":
            return
        length += len(message.get("body", b""))
        more = message.get("more_body", False)
    text = str(length).encode()
    headers = [(b"content-length", str(len(text) + 4).encode())]
    await send({"type": "http.response.start", "status": 200, "headers": headers})
    await send({"type": "http.response.body", "body": b"slow", "more_body": True})
    if scope["path"] == "/slow":
        await asyncio.sleep(1.2 * Short.longest_s)
    await send({"type": "http.response.body", "body": text})


@pytest.fixture(scope="module")
def address():
    with socket.create_server(("127.0.0.1", 0)) as listening:
        config = uvicorn.Config(answer, http=Short, lifespan="off", log_level="critical")
        config.timeout_graceful_shutdown = 1
        server = uvicorn.Server(config)
        thread = threading.Thread(target=server.run, kwargs={"sockets": [listening]})
        thread.start()
        try:
            yield listening.getsockname()
        finally:
            server.should_exit = True
            thread.join(REST_S)


def connected(address):
    return closing(socket.create_connection(address, timeout=REST_S))


def is_closed(client):
    """Whether the server closes a connection without a word."""
    try:
        return client.recv(100) == b""
    except ConnectionError:
        return True


def read_to(client, end):
    """Return what the server sends up to some bytes; empty if it ends before."""
    received = b""
    while not received.endswith(end):
        part = client.recv(1)
        if not part:
            return b""
        received += part
    return received


@pytest.mark.parametrize("begun", [b"", b"GET / HT", HEAD % 9, HEAD % 9 + b"body"])
def test_a_request_that_does_not_come_whole_ends_its_connection(address, begun):
    with connected(address) as client:
        began = time.monotonic()
        client.sendall(begun)
        assert is_closed(client)
        assert time.monotonic() - began > Short.longest_s / 2


@pytest.mark.parametrize("begun", [b"GET / HTTP/1.1\r\nX: ", HEAD % 10_000])
def test_a_byte_now_and_then_keeps_no_connection(address, begun):
    with connected(address) as client:
        began = time.monotonic()
        client.sendall(begun)
        client.settimeout(0.05)
        with pytest.raises(ConnectionError):  # noqa: PT012
            while time.monotonic() - began < REST_S:
                client.sendall(b"x")
                try:
                    if client.recv(1) == b"":
                        raise ConnectionError
                except TimeoutError:
                    continue
        assert time.monotonic() - began < REST_S


def test_a_long_body_that_arrives_steadily_is_taken(address):
    parts, size = 12, 4000
    with connected(address) as client:
        began = time.monotonic()
        client.sendall(HEAD % (parts * size))
        for _ in range(parts):
            client.sendall(bytes(size))
            time.sleep(0.03)
        assert time.monotonic() - began > Short.longest_s
        assert client.recv(100).startswith(b"HTTP/1.1 200")


def test_an_answer_takes_as_long_as_it_takes_and_the_connection_is_used_again(address):
    with connected(address) as client:
        for _ in range(2):
            client.sendall(WHOLE.replace(b"POST /", b"POST /slow"))
            assert read_to(client, b"slow0").startswith(b"HTTP/1.1 200")


def test_a_part_of_a_request_that_follows_another_one_at_once_ends_the_connection(address):
    with connected(address) as client:
        client.sendall(WHOLE + HEAD % 9)
        assert read_to(client, b"slow0")
        assert is_closed(client)


def test_one_address_has_a_limit_of_connections_and_gets_others_back(address):
    with ExitStack() as stack:
        clients = [stack.enter_context(connected(address)) for _ in range(Short.most + 1)]
        assert clients[-1].recv(1000).startswith(b"HTTP/1.1 503")
        assert all(map(is_closed, clients))
    with connected(address) as client:
        client.sendall(WHOLE)
        assert client.recv(100).startswith(b"HTTP/1.1 200")
