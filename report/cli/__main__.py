"""Runs the command line: `python -m report.cli`."""

from report.cli.main import main

main()
