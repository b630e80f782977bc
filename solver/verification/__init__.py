"""Verification against independent results, as plain data. Read `run.verify` first."""
