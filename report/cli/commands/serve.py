"""The command `roofslip serve`."""

from __future__ import annotations

import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import click

from report.cli.console import INPUT_ERROR
from report.cli.option_types import Existing

PORT = 8765
# Drawn at random from 66 letters, 20 are 121 bits.
MIN_TOKEN = 20  # characters

_NEEDED = {"starlette": "starlette", "uvicorn": "uvicorn", "python_multipart": "python-multipart"}
"""Packages of the extra by their modules."""


@click.command()
@click.option("--port", type=click.IntRange(0, 65535), default=PORT, show_default=True,
              help="Port; 0 selects any free port.")  # fmt: skip
@click.option("--no-browser", is_flag=True, help="Do not open a browser.")
@click.option("--host", metavar="ADDRESS", help="Listen on this address of the machine, so that "
              "other machines can reach the page. Requires --token-file.")  # fmt: skip
@click.option("--token-file", type=Existing(dir_okay=False),
              help=f"File with a reusable token of at least {MIN_TOKEN} letters and digits. "
              "Without it, each address works once.")  # fmt: skip
@click.option("--once", is_flag=True, help="Load the page with the example as a browser would, "
              "print the result and the time, and exit.")  # fmt: skip
def serve(host: str | None, token_file: Path | None, **options: Any) -> None:
    """Open the browser page: load a workbook, move sliders, create the package.

    Prints the address with its token, and serves one engineer until Ctrl+C; uploaded and generated
    files are then removed. On a terminal, Enter prints another address, for another tab. Without
    --host, only this machine can reach the page. A reverse proxy must request it under the host and
    port of the printed address.
    """
    missing = [name for module, name in _NEEDED.items() if find_spec(module) is None]
    if missing:
        click.echo(f"The page requires {', '.join(missing)}: install the extra web.", err=True)
        sys.exit(INPUT_ERROR)
    if host is not None and token_file is None:
        raise click.UsageError(
            "--host requires --token-file: a file with the token for the address"
        )
    from report.cli.page_server import serve_page

    serve_page(host=host, token_file=token_file, **options)
