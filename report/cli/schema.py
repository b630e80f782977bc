"""The command `roofslip schema`: what results.json holds."""

from __future__ import annotations

import json

import click


@click.command()
def schema() -> None:
    """Print the JSON schema of results.json."""
    from report.entities import results

    click.echo(json.dumps(results.schema(), indent=1))
