"""What a file that is not read probably is, by its first lines or bytes, and what to do with it.

Reads no values. Read `likely_text` and `likely_bytes`.

Source: SEED reference manual and FDSN miniSEED 3 (record headings); SAC manual, data file format
(version 6 or 7 in word 77); the first lines of files of CWA, UNAM and others as their archives give
them.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from solver.records.record import shown

_CONVERT = (
    "convert it to times and accelerations, for example with ObsPy: write columns time_s,acc_g"
)
_COLUMNS = "write its values as columns below a heading such as time_s,x_g,y_g"
_AS_RECORD = "give the record itself, such as the file that its download page offers"

_TEXTS = (
    (re.compile(r"(?i)\s*<(?:!doctype html|html)"), "a web page", _AS_RECORD),
    (re.compile(r"(?i)\s*<\?xml|\s*<[a-z]+[ >]"), "XML, such as StationXML", _AS_RECORD),
    (re.compile(r"(?i)\s*[\[{]"), "JSON", _COLUMNS),
    (re.compile(r"(?i)#?\s*(?:Station ?Code|InstrumentKind)\b"), "a file of CWA, Taiwan", _COLUMNS),
    (re.compile(r"(?i)TIMESERIES "), "TSPAIR or SLIST of EarthScope", _CONVERT),
    (re.compile(r"(?i)(?:WID[12]|BEGIN GSE2|BEGIN IMS)\b"), "GSE2", _CONVERT),
    (re.compile(r"(?i)(?:\s+-?12345(?:\.0*)?){3}"), "SAC in letters", _CONVERT),
    (re.compile(r"(?i).*(?:MEXICANA|ASA ?2\.0|UNAM\b)"), "a file of UNAM, Mexico", _COLUMNS),
    (re.compile(r"(?i).*\b(?:BHRC|CSMNC|USC)\b"), "a file of another network", _COLUMNS),
    (re.compile(r"(?i)\s*(?:timeSeries|set|function|import|pattern)\b"), "a program", _AS_RECORD),
)  # fmt: skip
_LOOKED_AT = 15

_BYTES = (
    (re.compile(rb"\d{6}[DRQM][ \x00]|MS\x03"), "miniSEED", _CONVERT),
    (re.compile(rb"\d{6}[VAST] "), "SEED", _CONVERT),
    (re.compile(rb"PK\x03\x04"), "a zip or a workbook", "unpack it, or save its sheet as CSV"),
    (re.compile(rb"\x1f\x8b"), "a gzip", "unpack it"),
    (re.compile(rb"%PDF"), "a PDF", _AS_RECORD),
    (re.compile(rb"\x89HDF"), "HDF5, such as ASDF", _CONVERT),
    (re.compile(rb"MATLAB"), "a file of MATLAB", _COLUMNS),
    (re.compile(rb"\x93NUMPY"), "an array of numpy", _COLUMNS),
)
_SAC_HEADING, _SAC_VERSION_AT, _SAC_VERSIONS = 632, 304, {6, 7}


def likely_text(lines: Sequence[str], index: int) -> str:
    """Return what a text that is no table of numbers probably is, and what to do; at a line."""
    near = [line for line in lines[:_LOOKED_AT] if line.strip()]
    for pattern, name, remedy in _TEXTS:
        if any(map(pattern.match, near)):
            return f"this looks like {name}, which is not read; {remedy}"
    return (
        f"found {shown(lines[index].strip())} where numbers are due, and no heading of a format"
        f" that is read; {_COLUMNS}, with # before every other line of text"
    )


def likely_bytes(data: bytes) -> str:
    """Return what a file that is no text probably is, and what to do; "" if unknown."""
    for pattern, name, remedy in _BYTES:
        if pattern.match(data):
            return f"{name}; {remedy}"
    heading = data[_SAC_VERSION_AT : _SAC_VERSION_AT + 4]
    versions = [int.from_bytes(heading, order) for order in ("little", "big")]
    is_sac = len(data) > _SAC_HEADING and not _SAC_VERSIONS.isdisjoint(versions)
    return f"SAC; {_CONVERT}" if is_sac else ""
