"""Output of `roofslip motion info` and `convert` for the records of a file."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from report.cli.console import print_json, say
from report.cli.input_errors import input_errors
from report.motions.measured import summary, table
from solver.errors import InputError
from solver.file_writing import write_whole
from solver.formats import MotionFile, read_motion_file
from solver.records.record import record_csv
from solver.spaces import spaced

# Rounding error allowed in a converted record, relative to its peak.
_TOLERANCE = 1e-9


def print_channels(file: Path, *, channel: str, as_json: bool, **reading: Any) -> None:
    """Print the channels of a file, or one of them."""
    with input_errors(file):
        motion_file = _read(file, reading)
        records = [motion_file.channel(channel)] if channel else motion_file.channels
    channels = [summary(record) for record in records]
    if as_json:
        document = {
            "file": str(file),
            "format": motion_file.format,
            "notes": [*map(spaced, motion_file.notes)],
            "channels": channels,
        }
        print_json(document)
        return
    say(file, f": {motion_file.format}")
    for line in table(channels):
        say(line)
    for note in motion_file.notes:
        say(f"note: {note}")


def convert_record(file: Path, out: Path, *, channel: str, factor: float, **reading: Any) -> None:
    """Write a record, times a factor, as CSV."""
    with input_errors(file):
        motion_file = _read(file, reading)
        record = motion_file.channel(channel)
        if os.path.lexists(out):  # a dangling link as well
            raise InputError(f"{out}: already exists; use another name, or move the file")
        scaled = replace(record, a_mps2=factor * record.a_mps2)
        write_whole(out, record_csv(scaled, within=_TOLERANCE).encode())
    for note in motion_file.notes:
        say(f"note: {note}")
    say(out)


def _read(path: Path, reading: Mapping[str, Any]) -> MotionFile:
    """Read a file with the options of the command; None means not given."""
    options = {name: value for name, value in reading.items() if value is not None}
    return read_motion_file(path, **options)
