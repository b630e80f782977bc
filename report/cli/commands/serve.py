"""The command `roofslip serve`."""

from __future__ import annotations

import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import click

from report.cli.exit_codes import INPUT_ERROR
from report.cli.options import Existing

PORT = 8765
MIN_TOKEN = 20  # characters

_NEEDED = {"starlette": "starlette", "uvicorn": "uvicorn", "python_multipart": "python-multipart"}
"""Packages of the extra by their modules."""


@click.command()
@click.option("--port", type=click.IntRange(0, 65535), default=PORT, show_default=True,
              help="0: any that is free.")  # fmt: skip
@click.option("--no-browser", is_flag=True, help="Open no browser.")
@click.option("--host", metavar="ADDRESS", help="Listen on this address of the machine, so that "
              "other machines reach the page. Needs --token-file.")  # fmt: skip
@click.option("--token-file", type=Existing(dir_okay=False),
              help=f"File with the token of the address: {MIN_TOKEN} letters and digits or "
              "more, which stays good. Without it, an address is good once.")  # fmt: skip
@click.option("--once", is_flag=True, help="Load the page with the example as a browser does, "
              "print what it took, and end.")  # fmt: skip
def serve(host: str | None, token_file: Path | None, **options: Any) -> None:
    """Show the page in the browser: drop a workbook, move the sliders, take the package.

    Prints the address with its token, and serves one engineer until Ctrl+C; then what was uploaded
    and made is removed. On a terminal, Enter prints another address, for another tab. Without
    --host, only this machine can reach the page. A reverse proxy must ask for it under the host and
    port of the printed address.
    """
    missing = [name for module, name in _NEEDED.items() if find_spec(module) is None]
    if missing:
        click.echo(f"The page needs {', '.join(missing)}: install roofslip[web].", err=True)
        sys.exit(INPUT_ERROR)
    if host is not None and token_file is None:
        raise click.UsageError("--host needs --token-file: a file with the token of the address")
    from report.cli.page_server import serve_page

    serve_page(host=host, token_file=token_file, **options)
