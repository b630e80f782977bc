"""The command `roofslip serve`: the page, for the browser of this machine or of a network.

Parses and prints; `report.web` answers. Read `serve`.
"""

from __future__ import annotations

import secrets
import socket
import sys
import tempfile
from pathlib import Path

import click

from report.cli.terminal import INPUT_ERROR

LOOPBACK = "127.0.0.1"
PORT = 8765
_PACKAGES = "starlette, uvicorn and python-multipart"


@click.command()
@click.option("--port", type=click.IntRange(0, 65535), default=PORT, show_default=True,
              help="0: any that is free.")  # fmt: skip
@click.option("--no-browser", is_flag=True, help="Open no browser.")
@click.option("--host", metavar="ADDRESS", help="Listen on this address of the machine, so that "
              "others can reach it. Needs --token-file.")  # fmt: skip
@click.option("--token-file", type=click.Path(path_type=Path, exists=True, dir_okay=False),
              help="File with the token of the address, 20 characters or more.")  # fmt: skip
def serve(port: int, no_browser: bool, host: str | None, token_file: Path | None) -> None:
    """Open the page in the browser: drop a workbook, move the sliders, take the package.

    Prints the address with its token, and serves until Ctrl+C. Only this machine can reach it
    unless --host is given.
    """
    try:
        import uvicorn

        from report.web.access import Gate
        from report.web.app import made
        from report.web.sessions import Sessions
    except ModuleNotFoundError as error:
        click.echo(f"{error.name} is not installed; install {_PACKAGES}.", err=True)
        sys.exit(INPUT_ERROR)
    if host is not None and token_file is None:
        raise click.UsageError("--host needs --token-file: a file with the token of the address")
    token = _token(token_file)
    listening = _listening(host or LOOPBACK, port)
    port = listening.getsockname()[1]
    names = [host] if host else [LOOPBACK, "localhost"]
    with tempfile.TemporaryDirectory(prefix="roofslip-serve-") as folder:
        gate = Gate(
            token=token, hosts=[f"{name}:{port}" for name in names], cookie=f"roofslip-{port}"
        )
        config = uvicorn.Config(
            made(gate, Sessions(Path(folder))), log_level="warning", access_log=False
        )
        click.echo(f"http://{names[0]}:{port}/?token={token}")
        if not no_browser:
            click.launch(f"http://{names[0]}:{port}/?token={token}")
        uvicorn.Server(config).run(sockets=[listening])


def _token(file: Path | None) -> str:
    return secrets.token_urlsafe(24) if file is None else file.read_text(encoding="utf-8").strip()


def _listening(host: str, port: int) -> socket.socket:
    """Return a socket that listens; exit where the port is taken."""
    listening = socket.socket()
    try:
        listening.bind((host, port))
    except OSError as error:
        click.echo(f"{host}:{port} is not free ({error.strerror}); give another --port.", err=True)
        sys.exit(INPUT_ERROR)
    return listening
