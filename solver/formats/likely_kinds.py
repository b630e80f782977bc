"""Guesses what an unreadable file is, from its first lines or bytes, and the remedy.

`<?xml version=...` is XML, `PK` a zip or a workbook, `timeSeries Path 1` a program. Knows no format
that is read.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

_CONVERT = (
    "convert it to times and accelerations, for example with ObsPy: write columns time_s,acc_g"
)

COLUMNS = "write its values as columns below a heading such as time_s,x_g,y_g"
_AS_RECORD = "use the record itself, such as the file offered on its download page"
_AS_READ = f"use the file of values that it reads, or {COLUMNS}"

_TEXTS = (
    (re.compile(r"(?i)\s*<(?:!doctype html|html)"), "a web page", _AS_RECORD),
    (re.compile(r"(?i)\s*<\?xml|\s*<[a-z]+[ >]"), "XML, such as StationXML", _AS_RECORD),
    (re.compile(r"\{\\rtf"), "a text of a word processor", "save it as plain text"),
    # A bracket with a unit in it, such as [g], may be a heading.
    (re.compile(r"""\s*(?:\{|\[\s*+(?:[\[{"'\d-]|$))"""), "JSON", COLUMNS),
    (re.compile(r"TIMESERIES \S+_"), "TSPAIR or SLIST of EarthScope", _CONVERT),
    (re.compile(r"(?i)(?:WID[12]|BEGIN GSE2|BEGIN IMS)\b"), "GSE2", _CONVERT),
    # SAC writes -12345 for each value of its header that is not known.
    (re.compile(r"(?i)(?:\s+-?12345(?:\.0*)?){3}"), "SAC in text form", _CONVERT),
    (re.compile(r"(?i)\s*(?:timeSeries|set|pattern)\s+\S+\s+\S|\s*(?:import\s|function\s[^(]*\()"),
     "a program", _AS_READ),
)  # fmt: skip

LOOKED_AT = 15
_BYTES = (
    (re.compile(rb"MS\x03"), "miniSEED 3", _CONVERT),
    # A record begins with its number and the kind of its control header.
    (re.compile(rb"\d{6}[VAST] "), "SEED", _CONVERT),
    (re.compile(rb"PK\x03\x04"), "a zip or a workbook", "unpack it, or save its worksheet as CSV"),
    (re.compile(rb"\x1f\x8b"), "a gzip", "unpack it"),
    (re.compile(rb"%PDF"), "a PDF", "export its numbers as text or CSV"),
    (re.compile(rb"\x89HDF"), "HDF5, such as ASDF", _CONVERT),
    (re.compile(rb"MATLAB"), "a MATLAB file", COLUMNS),
    (re.compile(rb"\x93NUMPY"), "a NumPy array", COLUMNS),
)


def likely_text(lines: Sequence[str]) -> str:
    """Return what a text that is not a table of numbers probably is, and the remedy, or ""."""
    near = [line for line in lines[:LOOKED_AT] if line.strip()]
    for pattern, name, remedy in _TEXTS:
        if any(map(pattern.match, near)):
            return f"this looks like {name}, which is not supported; {remedy}"
    return ""


def likely_bytes(data: bytes) -> str:
    """Return what a file that is not text probably is, and the remedy; "" if unknown."""
    for pattern, name, remedy in _BYTES:
        if pattern.match(data):
            return f"{name}; {remedy}"
    return ""
