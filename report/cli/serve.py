"""The command `roofslip serve`: the page in the browser, for one engineer.

Parses, listens and prints; `report.web` answers. Read `serve`.
"""

from __future__ import annotations

import errno
import ipaddress
import os
import re
import signal
import socket
import sys
import threading
import time
from collections.abc import Sequence
from contextlib import ExitStack, suppress
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import click

from report.cli.options import Existing
from report.cli.terminal import INPUT_ERROR, INTERNAL_ERROR, input_errors

if TYPE_CHECKING:
    import uvicorn

    from report.web.access import Keys

LOOPBACK, PORT = "127.0.0.1", 8765
HTTP_PORT = 80
SHORTEST_TOKEN, MOST_TOKEN = 20, 10_000

# What stands in an address without being escaped (RFC 3986, 2.3).
_TOKEN = re.compile(r"[A-Za-z0-9_~.-]+")
_NEEDED = {"starlette": "starlette", "uvicorn": "uvicorn", "python_multipart": "python-multipart"}
_NOT_ENCRYPTED = (
    "warning: the connection is not encrypted; put a reverse proxy with TLS in front of it"
)
_MORE = "Press Enter for another address, Ctrl+C to end."
_STOPPED_S = 3
_VISIT_S = 120.0


@click.command()
@click.option("--port", type=click.IntRange(0, 65535), default=PORT, show_default=True,
              help="0: any that is free.")  # fmt: skip
@click.option("--no-browser", is_flag=True, help="Open no browser.")
@click.option("--host", metavar="ADDRESS", help="Listen on this address of the machine, so that "
              "other machines reach the page. Needs --token-file.")  # fmt: skip
@click.option("--token-file", type=Existing(dir_okay=False),
              help=f"File with the token of the address: {SHORTEST_TOKEN} letters and digits or "
              "more, which stays good. Without it, an address is good once.")  # fmt: skip
@click.option("--once", is_flag=True, help="Load the page with the example as a browser does, "
              "print what it took, and end.")  # fmt: skip
def serve(
    port: int, no_browser: bool, host: str | None, token_file: Path | None, once: bool
) -> None:
    """Show the page in the browser: drop a workbook, move the sliders, take the package.

    Prints the address with its token, and serves one engineer until Ctrl+C; then what was uploaded
    and made is removed. On a terminal, Enter prints another address, for another tab. Without
    --host, only this machine can reach the page. A reverse proxy must ask for it under the host and
    port of the printed address.
    """
    _check_packages()
    from report.web.access import Keys

    if host is not None and token_file is None:
        raise click.UsageError("--host needs --token-file: a file with the token of the address")
    lasting = "" if token_file is None else _token(token_file)
    keys = Keys(lasting)
    with ExitStack() as stack:
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
    """Print an address for each line that is typed."""
    # Not `sys.stdin`: a thread that waits in it holds up the end of the program.
    while os.read(sys.stdin.fileno(), 1000):
        click.echo(f"{page}?token={keys.token()}")


def _check_packages() -> None:
    missing = [name for module, name in _NEEDED.items() if find_spec(module) is None]
    if missing:
        click.echo(f"The page needs {', '.join(missing)}: install roofslip[web].", err=True)
        sys.exit(INPUT_ERROR)


def names_of(host: str | None, port: int) -> tuple[str, Sequence[str]]:
    """Return the name in the address, and the values of Host that are answered; none for any."""
    # A browser leaves out the port of HTTP.
    end = "" if port == HTTP_PORT else f":{port}"
    if host is None:
        return LOOPBACK, [f"{name}{end}" for name in (LOOPBACK, "localhost")]
    with suppress(ValueError):
        address = ipaddress.ip_address(host)
        # 0.0.0.0 stands for every address of the machine: any name may lead to it.
        if address.is_unspecified:
            return socket.gethostname(), ()
        # In an address the colons of IPv6 are in brackets (RFC 3986, 3.2.2).
        host = f"[{host}]" if address.version == 6 else host
    return host, [f"{host}{end}"]


def _token(file: Path) -> str:
    """Return the token of a file; exit where it is too short, or no part of an address."""
    with input_errors(file):
        from solver.files import read_file

        token = read_file(file, MOST_TOKEN).decode(errors="replace").strip()
    if len(token) < SHORTEST_TOKEN or not _TOKEN.fullmatch(token):
        wanted = f"{SHORTEST_TOKEN} or more letters, digits, '-', '_', '.' and '~', on one line"
        click.echo(f"{file}: has no token; give {wanted}.", err=True)
        sys.exit(INPUT_ERROR)
    return token


def listen(host: str, port: int) -> socket.socket:
    """Return a socket that listens; exit where it cannot."""
    try:
        family = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0][0]
        listening = socket.create_server((host, port), family=family)
        # Connections inherit it. Otherwise the body of an answer waits 40 ms for the acknowledgment
        # of its head: asyncio does the same only to sockets that state their protocol.
        listening.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return listening
    except OSError as error:
        if error.errno == errno.EADDRINUSE:
            told = f"Port {port} of {host} is in use: end what uses it, or give another --port."
        else:
            told = f"{host}, port {port}: cannot listen there; give another --port or --host."
        click.echo(told, err=True)
        sys.exit(INPUT_ERROR)


def _server(folder: Path, keys: Keys, hosts: Sequence[str]) -> uvicorn.Server:
    import uvicorn

    from report.web.app import made

    return uvicorn.Server(
        uvicorn.Config(
            made(keys, folder, hosts),
            # It holds a body to its Content-Length.
            http="h11",
            ws="none",
            proxy_headers=False,
            log_level="warning",
            # The first address has the token.
            access_log=False,
            server_header=False,
            timeout_graceful_shutdown=_STOPPED_S,
        )
    )


class _Visit(threading.Thread):
    """Loads the page as a browser does, then ends the server."""

    def __init__(self, server: uvicorn.Server, address: str) -> None:
        super().__init__(daemon=True)
        self._server, self._address = server, address
        self.is_answered = False
        self.sentence = "the page did not answer"

    def run(self) -> None:
        """Load the page and its first answer."""
        import json
        from urllib.request import ProxyHandler, Request, build_opener

        from report.web.access import ENTRY, KEY_HEADER, TOKEN_HEADER

        began = time.monotonic()
        # Only this server is asked, and no proxy of the environment.
        browser = build_opener(ProxyHandler({}))
        page, _, token = self._address.partition("/?token=")

        def asked(path: str, method: str, **headers: str) -> Any:
            request = Request(page + path, headers=headers, method=method)
            return json.load(browser.open(request, timeout=_VISIT_S))

        try:
            browser.open(self._address, timeout=_VISIT_S).read()
            key = asked(ENTRY, "POST", **{TOKEN_HEADER: token})["key"]
            state = asked("/api/state", "GET", **{KEY_HEADER: key})
            verdict = state["answer"]["verdict"]["text"]
            self.sentence = f"the example: {verdict}, after {time.monotonic() - began:.1f} s"
            self.is_answered = True
        except (OSError, ValueError):
            pass
        # Also where the page did not answer: the command is to end.
        finally:
            self._server.should_exit = True
