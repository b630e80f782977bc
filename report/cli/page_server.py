"""Serves the browser page for one engineer; `report.web` handles requests. Read `serve_page`."""

from __future__ import annotations

import errno
import ipaddress
import json
import os
import re
import signal
import socket
import sys
import threading
import time
from collections.abc import Sequence
from contextlib import ExitStack, suppress
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from urllib.request import ProxyHandler, Request, build_opener

import click
import uvicorn

from report.cli.commands.serve import MIN_TOKEN
from report.cli.console import INPUT_ERROR, INTERNAL_ERROR
from report.cli.input_errors import input_errors
from report.web.access import ENTRY, KEY_HEADER, TOKEN_HEADER, Keys
from report.web.app import made
from solver.file_checks import read_file

LOOPBACK = "127.0.0.1"
# A browser leaves it out of an address.
HTTP_PORT = 80
MAX_TOKEN = 10_000

# What stands in an address without being escaped (RFC 3986, 2.3).
_TOKEN = re.compile(r"[A-Za-z0-9_~.-]+")
_NOT_ENCRYPTED = (
    "warning: the connection is not encrypted; put a reverse proxy with TLS in front of it"
)
# The address is good once (`report.web.access.Keys`): a second tab needs another.
_MORE = "Press Enter for another address, or Ctrl+C to stop."
_STOPPED_S = 3
# In an installation without setup, the first answer compiles the solver.
_VISIT_S = 120.0


def serve_page(
    *, port: int, no_browser: bool, host: str | None, token_file: Path | None, once: bool
) -> None:
    """Print the address, and serve until Ctrl+C; with `once`, until the page has answered."""
    lasting = "" if token_file is None else _token(token_file)
    keys = Keys(lasting)
    with ExitStack() as stack:
        # Listening before the address is printed: a port that is taken is told first, and a
        # browser that is quicker than the server waits rather than fails.
        listening = stack.enter_context(listen(host or LOOPBACK, port))
        with input_errors(Path("serve")):
            # On Windows a file that is open stays: it is no reason for a traceback at the end.
            temporary = TemporaryDirectory(prefix="roofslip-serve-", ignore_cleanup_errors=True)
            folder = Path(stack.enter_context(temporary))
        # Requests under other names are refused: a page elsewhere could have its name lead here.
        name, hosts = names_of(host, listening.getsockname()[1])
        page = f"http://{name}:{listening.getsockname()[1]}/"
        address = f"{page}?token={lasting or keys.token()}"
        click.echo(address)
        if host is not None:
            click.echo(_NOT_ENCRYPTED, err=True)
        if not once and not lasting and sys.stdin is not None and sys.stdin.isatty():
            click.echo(_MORE, err=True)
            # A daemon: it reads until the process ends.
            threading.Thread(target=_print_more, args=(page, keys), daemon=True).start()
        server = _server(folder, keys, hosts)
        visit = _Visit(server, address)
        if once:
            visit.start()
        elif not no_browser:
            click.launch(address)
        # The server sends itself the signal that stopped it: the folder is removed then as well.
        signal.signal(signal.SIGTERM, signal.default_int_handler)
        # A closed terminal, which uvicorn does not catch; nohup ignores it.
        if hasattr(signal, "SIGHUP") and signal.getsignal(signal.SIGHUP) is signal.SIG_DFL:
            signal.signal(signal.SIGHUP, lambda *_: signal.raise_signal(signal.SIGTERM))
        with suppress(KeyboardInterrupt):
            server.run(sockets=[listening])
    if once:
        click.echo(visit.sentence)
        sys.exit(0 if visit.is_answered else INTERNAL_ERROR)


def _print_more(page: str, keys: Keys) -> None:
    """Print a new address for each line typed."""
    # Not `sys.stdin`: a thread that waits in it holds up the end of the program.
    while os.read(sys.stdin.fileno(), 1000):
        click.echo(f"{page}?token={keys.token()}")


def names_of(host: str | None, port: int) -> tuple[str, Sequence[str]]:
    """Return the name in the address, and the accepted values of Host; none if any is accepted."""
    # A browser leaves out the port of HTTP.
    end = "" if port == HTTP_PORT else f":{port}"
    if host is None:
        return LOOPBACK, [f"{name}{end}" for name in (LOOPBACK, "localhost")]
    # A name of a host is no address, and raises ValueError.
    with suppress(ValueError):
        address = ipaddress.ip_address(host)
        # 0.0.0.0 stands for every address of the machine: any name may lead to it.
        if address.is_unspecified:
            return socket.gethostname(), ()
        # In an address the colons of IPv6 are in brackets (RFC 3986, 3.2.2).
        host = f"[{host}]" if address.version == 6 else host
    return host, [f"{host}{end}"]


def _token(file: Path) -> str:
    """Return the token of a file; exit if it is too short or cannot be part of an address."""
    with input_errors(file):
        token = read_file(file, MAX_TOKEN).decode(errors="replace").strip()
    if len(token) < MIN_TOKEN or not _TOKEN.fullmatch(token):
        accepted = f"{MIN_TOKEN} or more letters, digits, '-', '_', '.' and '~', on one line"
        click.echo(f"{file}: no token found; enter {accepted}.", err=True)
        sys.exit(INPUT_ERROR)
    return token


def listen(host: str, port: int) -> socket.socket:
    """Return a listening socket; exit if this is not possible."""
    try:
        family = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0][0]
        listening = socket.create_server((host, port), family=family)
        # Connections inherit it. Otherwise the body of an answer waits 40 ms for the acknowledgment
        # of its head: asyncio does the same only to sockets that state their protocol.
        listening.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return listening
    except OSError as error:
        if error.errno == errno.EADDRINUSE:
            message = (
                f"Port {port} of {host} is in use: stop the program that uses it, or use"
                " another --port."
            )
        else:
            message = f"{host}, port {port}: cannot listen there; use another --port or --host."
        click.echo(message, err=True)
        sys.exit(INPUT_ERROR)


def _server(folder: Path, keys: Keys, hosts: Sequence[str]) -> uvicorn.Server:
    return uvicorn.Server(
        uvicorn.Config(
            made(keys, folder, hosts),
            # It holds a body to its Content-Length.
            http="h11",
            # The page opens no WebSocket.
            ws="none",
            # By default uvicorn believes X-Forwarded-For and -Proto of this machine, where anyone
            # may send.
            proxy_headers=False,
            log_level="warning",
            # The first address has the token.
            access_log=False,
            server_header=False,
            timeout_graceful_shutdown=_STOPPED_S,
        )
    )


class _Visit(threading.Thread):
    """Loads the page as a browser would, then stops the server."""

    def __init__(self, server: uvicorn.Server, address: str) -> None:
        super().__init__(daemon=True)
        self._server, self._address = server, address
        self.is_answered = False
        self.sentence = "the page did not answer"

    def run(self) -> None:
        """Load the page and its first answer."""
        began = time.monotonic()
        # Only this server is asked, and no proxy of the environment.
        browser = build_opener(ProxyHandler({}))
        page, _, token = self._address.partition("/?token=")

        def answer(path: str, method: str, **headers: str) -> Any:
            request = Request(page + path, headers=headers, method=method)
            return json.load(browser.open(request, timeout=_VISIT_S))

        try:
            browser.open(self._address, timeout=_VISIT_S).read()
            key = answer(ENTRY, "POST", **{TOKEN_HEADER: token})["key"]
            state = answer("/api/state", "GET", **{KEY_HEADER: key})
            verdict = state["answer"]["verdict"]["text"]
            self.sentence = f"the example: {verdict}, after {time.monotonic() - began:.1f} s"
            self.is_answered = True
        except (OSError, ValueError):
            pass
        # Also where the page did not answer: the command is to end.
        finally:
            self._server.should_exit = True
