"""Finds the format of a file by its content, and reads it.

`NPTS=  4000, DT=   .0100 SEC` near the top makes a file one of PEER, whatever its name; a file that
no other format takes is text.

Contains the list of formats and their order. Read `read_motion_file` first.
"""

from __future__ import annotations

import math
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Protocol

from solver.formats import text
from solver.formats.record_file import MotionFile
from solver.formats.source import Source, open_source
from solver.records.record import Record


class Format(Protocol):
    """A module that reads files of one format."""

    def recognizes(self, source: Source, /) -> bool:
        """Whether a file is of this format, by its content."""

    def read(self, source: Source, /) -> MotionFile:
        """Read all channels; raises `InputError` with every problem."""


# Imported by name: the core must not import its extras, such as the formats of networks.
FORMATS: tuple[Format, ...] = (*import_module("solver.formats.networks").NETWORKS, text)
"""All formats, asked in this order: text, which accepts every file, last."""


def read_motion_file(
    path: str | Path,
    *,
    units: str = "",
    dt_s: float = math.nan,
    values_per_line: int = 0,
    response: str | Path = "",
) -> MotionFile:
    """Read all channels of a record file.

    The format is identified by content: PEER AT2; COSMOS V1.20; CSMIP volumes 1 and 2, as which
    RENADIC, USC and BHRC write;
    USGS SMC; GeoNet V1A and V2A; K-NET and KiK-net, ASCII and CSV; headings of `KEY: value` lines
    (ESM, ITACA, AFAD, ISESD, CSMNC, CWA, JMA, UNAM); a line of count and step (eqsig, RSPMatch);
    miniSEED and SAC, where ObsPy is installed; or text of one column (acceleration) or more (time
    [s], accelerations). No sample is filtered and no offset is
    removed. Records with uneven times are resampled by linear interpolation, with a note.

    Parameters
    ----------
    path : str or Path
    units : {"", "g", "m/s2", "cm/s2", "mm/s2", "gal"}
        Unit of the accelerations, for a file that does not state it. If the file does, both must
        agree.
    dt_s : float
        Sampling interval [s], likewise.
    values_per_line : int
        For a text without a heading whose values run across the lines, as in files for OpenSees and
        SAP2000: the number of values in each line except the last. 0 for columns.
    response : str or Path
        For raw counts: the StationXML of the instrument, or its counts per m/s2.

    Returns
    -------
    MotionFile

    Raises
    ------
    InputError
        With every problem in the file, as ``name:LINE: what was found; what is accepted``.

    Examples
    --------
    >>> read_motion_file("projects/example/records/RM1-x.csv").channels
    (Record('RM1-x.csv', 6001 samples at 0.005 s),)
    """
    source = open_source(
        Path(path), units=units, dt_s=dt_s, values_per_line=values_per_line, response=str(response)
    )
    # There is always one: `text`, the last, accepts every file.
    reader = next(form for form in FORMATS if form.recognizes(source))
    # A package attaches and hashes these bytes, even if the file has changed since.
    return replace(reader.read(source), content=source.content)


def read_record(
    path: str | Path,
    *,
    units: str = "",
    dt_s: float = math.nan,
    channel: str = "",
    values_per_line: int = 0,
    response: str | Path = "",
) -> Record:
    """Read one channel of a record file.

    Parameters
    ----------
    path, units, dt_s, values_per_line, response
        As in `read_motion_file`.
    channel : str
        Its name or number in the file; may be omitted if there is only one.

    Returns
    -------
    Record

    Raises
    ------
    InputError
        Same as `read_motion_file`, and if there is no such channel.

    Examples
    --------
    >>> read_record("projects/example/records/RM1-x.csv")
    Record('RM1-x.csv', 6001 samples at 0.005 s)
    """
    file = read_motion_file(
        path, units=units, dt_s=dt_s, values_per_line=values_per_line, response=response
    )
    return file.channel(channel)
