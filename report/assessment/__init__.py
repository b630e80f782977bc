"""Runs, clearances and verdicts of a project. Read `assess`."""
