"""The measures of records as data and as a table, which `roofslip motion info` prints.

Measures nothing itself (`solver.records.measures`). Read `summary`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict
from typing import Any

from report.text.aligned import aligned
from report.text.units import G_MPS2
from solver.records.measures import Measures, measures
from solver.records.record import Record

# Heading, key of the number, and factor for the printed unit.
_MEASURES = (
    ("dt [s]", "dt_s", 1.0),
    ("samples", "npts", 1.0),
    ("length [s]", "duration_s", 1.0),
    ("PGA [g]", "pga_g", 1.0),
    ("PGV [cm/s]", "pgv_mps", 100.0),
    ("PGD [cm]", "pgd_m", 100.0),
    ("Arias [m/s]", "arias_mps", 1.0),
    ("D5-95 [s]", "d5_95_s", 1.0),
    ("final v [cm/s]", "final_velocity_mps", 100.0),
    ("final d [cm]", "final_displacement_m", 100.0),
)

# A drift below this fraction of the peak is rounding error.
_NO_DRIFT = 1e-9


def summary(record: Record) -> dict[str, Any]:
    """Return the measures of a record, in SI except g, with units in the keys."""
    values = measures(record)
    npts = len(record.a_mps2)
    return {
        "name": record.name,
        "dt_s": record.dt_s,
        "npts": npts,
        "duration_s": (npts - 1) * record.dt_s,
        **facts(values),
    }


def facts(values: Measures) -> dict[str, float]:
    """Return measures, in SI except g, with units in the keys."""
    options = asdict(values)
    return {"pga_g": options.pop("pga_mps2") / G_MPS2, **options}


def table(channels: Sequence[Mapping[str, Any]]) -> Iterator[str]:
    """Return summaries as lines of a table, one channel per line, under a heading."""
    rows = [("", "channel", *(heading for heading, _, _ in _MEASURES))]
    rows += [(str(count), *_row(channel)) for count, channel in enumerate(channels, start=1)]
    return aligned(rows, (">", "<", *(">" for _ in _MEASURES)))


def _row(channel: Mapping[str, Any]) -> tuple[str, ...]:
    plain = without_noise(channel)
    values = ((plain[key] * size, ".0f" if key == "npts" else ".4g") for _, key, size in _MEASURES)
    return (channel["name"], *(f"{value:{form}}" for value, form in values))


def without_noise(measured: Mapping[str, Any]) -> dict[str, Any]:
    """Return measures with 0 for what is rounding error at the end of a record."""
    peaks = {"final_velocity_mps": "pgv_mps", "final_displacement_m": "pgd_m"}
    # Beside its peak: its digits differ by machine, and would look like a drift.
    lost = (end for end, peak in peaks.items() if abs(measured[end]) <= _NO_DRIFT * measured[peak])
    return {**measured, **dict.fromkeys(lost, 0.0)}
