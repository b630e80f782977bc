"""The command `roofslip schema`."""

from __future__ import annotations

import json

import click


@click.command()
def schema() -> None:
    """Print the JSON schema of results.json."""
    from report.results.results_schema import schema as results_schema

    click.echo(json.dumps(results_schema(), indent=1))
