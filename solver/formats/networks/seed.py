"""MiniSEED and SAC, which ObsPy reads, an optional package: from the samples of traces to channels.

Handles these formats only. Whole numbers are raw counts: they are divided by the sensitivity of the
instrument that the caller gives, and refused without. Read `read` first.
"""

from __future__ import annotations

import io
import math
import warnings
from collections import Counter
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from solver.bounds import SENSITIVITY
from solver.errors import InputError
from solver.file_checks import read_file
from solver.formats.channels import motion_file, offset_notes
from solver.formats.record_file import MotionFile
from solver.formats.source import MAX_BYTES, Source, Stated, waveform_format
from solver.formats.times import round_step
from solver.model import Floats
from solver.records.record import Record, quoted, unit_size
from solver.spaces import NO_BREAK

# Source: SEED reference manual, version 2.4 (data records); SAC manual, data file format (IDEP: 6
# displacement, 7 velocity, 8 acceleration, whose unit by the manual, nm/s2, is often not kept);
# FDSN StationXML 1.2 (InstrumentSensitivity: output for one unit of the input).
_NAMES = {"MSEED": "miniSEED", "SAC": "SAC"}
_OTHER_SAC = {6: "displacement", 7: "velocity", 50: "volts"}
_SEVEN_DIGITS = 5e-7  # of a number of 24 bits
# Of a vertical sensor: what is farther off is a direction of its own, which is noted.
_PLUMB_DEG = 5.0
_INSTALL = (
    "is read by ObsPy, which is not installed; type the command of ./roofslip motion with a name"
    " that ends with .mseed or .sac (the launcher installs it then), or: pip install"
    " '.[seismic]' in its folder"
)


def recognizes(source: Source) -> bool:
    """Whether the first bytes are those of a record of miniSEED, or the version that of SAC."""
    return bool(waveform_format(source.content))


def read(source: Source) -> MotionFile:
    """Read all traces of a file, each of which must be without gaps."""
    form = waveform_format(source.content)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # its own of deprecated parts of Python
            obspy = import_module("obspy")
    except ImportError as error:
        raise InputError(f"{source.name}: {_NAMES[form]} {_INSTALL}") from error
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # such as of what is rounded, and not used here
            if form == "MSEED":  # so a record whose check of integrity fails is not read
                damage = import_module("obspy.io.mseed").InternalMSEEDWarning
                warnings.simplefilter("error", damage)
            traces = list(obspy.read(io.BytesIO(source.content), format=form))
            start = min(trace.stats.starttime for trace in traces).datetime
    except Exception as error:  # its readers raise whatever they meet in a damaged file
        raise _damaged(source, form) from error
    # What is no whole number of records was cut.
    if form == "MSEED" and len(source.content) % min(t.stats.mseed.record_length for t in traces):
        raise _damaged(source, form)
    # A gap makes two traces of one channel: joined they would be another motion.
    name, pieces = Counter(trace.id for trace in traces).most_common(1)[0]
    if pieces > 1:
        raise InputError(
            f"{source.name}: {name} has {pieces} pieces with gaps or overlaps between them; enter"
            " one piece without gaps"
        )
    channels = [_channel(source, obspy, trace) for trace in traces]
    return motion_file(source, _NAMES[form], channels, start=start)


def _damaged(source: Source, form: str) -> InputError:
    return InputError(f"{source.name}: damaged or truncated {_NAMES[form]}; use the complete file")


def _channel(source: Source, obspy: Any, trace: Any) -> Record:
    sac = trace.stats.get("sac")
    quantity = _OTHER_SAC.get(int(sac.get("idep", 0))) if sac else None
    if quantity or trace.data.dtype.kind not in "if":
        raise InputError(
            f"{source.name}: {trace.id} has {quantity or 'text'}; use a record of acceleration"
        )
    if not np.isfinite(trace.data).all():
        raise InputError(f"{source.name}: {trace.id} has values that are not numbers")
    values: Floats = trace.data.astype(np.float64)
    delta_s = float(trace.stats.delta)
    if sac:  # ObsPy rounds it to microseconds
        delta_s = round_step(float(f"{sac.delta:.7g}"), _SEVEN_DIGITS * float(sac.delta))
    step = Stated(value=delta_s)
    scale, notes = _scale(source, obspy, trace, values)
    a_mps2 = values * scale
    notes = (*notes, *(offset_notes(a_mps2) if a_mps2.any() else ()))
    return Record(name=trace.id, dt_s=source.step(step), a_mps2=a_mps2, notes=notes)


def _scale(source: Source, obspy: Any, trace: Any, values: Floats) -> tuple[float, tuple[str, ...]]:
    """Value [m/s2] of one of the samples: of a count by the response, else of the caller's unit."""
    is_whole = bool((values == np.rint(values)).all())
    if not source.response and not is_whole:
        return source.stated_scale(()), ()
    notes = () if is_whole else ("the samples are not whole numbers and are read as counts",)
    if not source.response or not math.isnan(source.counts_per_mps2):
        return source.counts_scale(f"{source.name}: found {trace.id}"), notes
    inventory = _inventory(source, obspy)
    per_mps2, at_hz = _sensitivity(source, inventory, trace)
    note = f"raw counts / {per_mps2:.6g} per m/s2, the sensitivity at {at_hz:g}{NO_BREAK}Hz"
    sign, orientation = _orientation(inventory, trace)
    notes = (*notes, f"{note}; the response at other frequencies is not removed", *orientation)
    return sign / per_mps2, notes


def _orientation(inventory: Any, trace: Any) -> tuple[float, tuple[str, ...]]:
    """Sign that makes a vertical positive upward, and a note on the direction of other channels."""
    about = inventory.get_channel_metadata(trace.id, trace.stats.starttime)
    azimuth, dip = about["azimuth"], about["dip"]
    if dip is not None and abs(abs(dip) - 90.0) <= _PLUMB_DEG:
        # FDSN StationXML: the dip is down from the horizontal.
        note = f"its dip is {dip:g} deg, positive downward: the sign is reversed"
        return (-1.0, (note,)) if dip > 0.0 else (1.0, ())
    note_text = f"its azimuth is {azimuth} deg, its dip {dip} deg"
    return 1.0, () if azimuth is None and dip is None else (note_text,)


def _inventory(source: Source, obspy: Any) -> Any:
    path = Path(source.response)
    content = read_file(path, MAX_BYTES, path.name)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return obspy.read_inventory(io.BytesIO(content))
    except Exception as error:
        raise InputError(
            f"{path.name}: cannot be read as a response; use StationXML, or counts per m/s2"
        ) from error


def _sensitivity(source: Source, inventory: Any, trace: Any) -> tuple[float, float]:
    """Counts per m/s2 of the instrument of a trace, and the frequency [Hz] where it has them."""
    path = Path(source.response)
    try:
        sensitivity = inventory.get_response(trace.id, trace.stats.starttime).instrument_sensitivity
        value, at_hz, units = (
            float(sensitivity.value),
            float(sensitivity.frequency),
            sensitivity.input_units or "",
        )
        is_digital = "count" in str(sensitivity.output_units).lower()
    except Exception as error:  # it raises a plain Exception where there is no such channel
        raise InputError(
            f"{path.name}: has no sensitivity of {trace.id} at {trace.stats.starttime}; enter the"
            " StationXML of its instrument"
        ) from error
    # That of a velocity sensor is per m/s: no factor makes accelerations of its counts.
    size = unit_size(units)
    if math.isnan(size) or not is_digital or not SENSITIVITY.has(value / size):
        raise InputError(
            f"{path.name}: the sensitivity of {trace.id} is {value:g} {sensitivity.output_units}"
            f" per {quoted(units)}; enter that of an accelerometer, {SENSITIVITY.words}"
        )
    return value / size, at_hz
