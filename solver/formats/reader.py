"""Finds the format of a file by its content, and reads it.

Owns the list of formats and their order. Read `read_motion_file` first.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from solver.formats import cosmos, csmip, geonet, knet, peer, smc, text
from solver.formats.motionfile import MotionFile
from solver.formats.source import Source, open_source
from solver.records.record import Record


@dataclass(frozen=True, slots=True, kw_only=True)
class _Format:
    recognises: Callable[[Sequence[str]], bool]
    read: Callable[[Source], MotionFile]


# GeoNet comes before CSMIP, whose first line is alike; text comes last, for it takes every file.
_FORMATS = tuple(
    _Format(recognises=module.recognises, read=module.read)
    for module in (cosmos, geonet, csmip, smc, knet, peer, text)
)


def read_motion_file(path: Path, *, units: str = "", dt_s: float = math.nan) -> MotionFile:
    """Read all channels of a file of records.

    The content tells the format: PEER AT2; COSMOS V1.20; CSMIP volumes 1 and 2; RENADIC; USGS SMC;
    GeoNet V1A and V2A; K-NET and KiK-net; or text of one column (acceleration) or more (time [s],
    accelerations). No sample is filtered and no offset is removed; uneven times are resampled by
    straight lines, which the notes say.

    Parameters
    ----------
    path : Path
    units : {"", "g", "m/s2", "cm/s2", "mm/s2", "gal"}
        Unit of the accelerations, for a file that does not state it. Where the file does, the two
        must agree.
    dt_s : float
        Sampling interval [s], for a file that has none, likewise.

    Raises
    ------
    InputError
        With every problem in the file, each as ``name:LINE: what was found; what would do``.
    """
    source = open_source(path, units=units, dt_s=dt_s)
    form = next(form for form in _FORMATS if form.recognises(source.lines))
    return form.read(source)


def read_record(
    path: Path, *, units: str = "", dt_s: float = math.nan, channel: str = ""
) -> Record:
    """Read one channel of a file: `read_motion_file`, then `MotionFile.channel`."""
    return read_motion_file(path, units=units, dt_s=dt_s).channel(channel)
