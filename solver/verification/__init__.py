"""Verification: what the software is held against, as plain data. Read `run.verify` first."""
