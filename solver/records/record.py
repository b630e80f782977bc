"""An acceleration record: created from values, checked, and written as csv.

`record_from_values("pulse", [0.0, 0.4, -0.4, 0.0], units="g", dt_s=0.01)` is one of 30 ms.

Reads no files (`solver.formats`), knows no code rules (`solver.rules.provisions`) and generates no
motions (`solver.synthesis`). Read `Record` first, then `record_from_values`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from solver.bounds import PEAK
from solver.errors import InputError, raise_any
from solver.file_writing import write_whole
from solver.model import INCH_M, STANDARD_GRAVITY_MPS2, Floats

_ALONE = 3.0  # a code for missing data / all other samples, at least: shaking rises over several
_JUMP = 2 / 3  # of a code that cannot be mistaken from the samples next to it
# Nines of any length, -999.25 (the null value of well logs), 12345, and the limits of 16-bit
# integers.
_CODES = re.compile(r"-?(?:999+(?:\.9+)?|999\.25|99\.9+|9\.99+|12345|3276[78])")
_SHORT_CODES = {"99", "-99"}  # where no shaking is as large
# Only larger samples can be a short code: 99 m/s2 is 10.1 g, 99 cm/s2 is 0.1 g.
_NO_SHAKING_G = 9.0

# Acceleration units and their value in m/s2.
UNITS = {"g": STANDARD_GRAVITY_MPS2, "m/s2": 1.0, "cm/s2": 0.01, "mm/s2": 0.001}

# Decimals that `write_record` prints, about 1e-5 g in every unit.
DECIMALS = {"g": 5, "m/s2": 4, "cm/s2": 2, "mm/s2": 1}

# Words of the comment that states the hold of the envelope of a generated record.
HOLD = "generated; hold of the envelope"

# Numbers of this size or more are refused, so that no change of units can overflow.
BEYOND = 1e300


@dataclass(frozen=True, slots=True, kw_only=True)
class Record:
    """One component of a motion, evenly sampled, linear between samples.

    Attributes
    ----------
    name : str
    dt_s : float
        Sampling interval [s], > 0.
    a_mps2 : array, shape (n,)
        Acceleration [m/s2], read-only, n >= 2.
    notes : tuple of str
        Notes on how it was read, such as resampling of uneven times.
    """

    name: str
    dt_s: float
    a_mps2: Floats
    notes: tuple[str, ...] = ()

    def __repr__(self) -> str:
        return f"Record({self.name!r}, {len(self.a_mps2)} samples at {self.dt_s:g} s)"


def record_from_values(
    name: str, values: Sequence[object] | Floats, *, units: str, dt_s: float
) -> Record:
    """Create a record from values in memory, such as a pasted column.

    Parameters
    ----------
    name : str
    values : sequence of numbers or array, shape (n,)
        Accelerations, n >= 2.
    units : {"g", "m/s2", "cm/s2", "mm/s2"}
        Of the values.
    dt_s : float
        Sampling interval [s], > 0.

    Returns
    -------
    Record

    Raises
    ------
    InputError
        With every value that is not a finite number, counted from 1.

    Examples
    --------
    >>> record_from_values("pulse", [0.0, 0.4, -0.4, 0.0], units="g", dt_s=0.1)
    Record('pulse', 4 samples at 0.1 s)
    """
    _check_arguments(name, units, dt_s)
    if isinstance(values, str | bytes) or not isinstance(values, Sequence | np.ndarray):
        raise InputError(f"{name} is {quoted(values)}; enter one row of real numbers")
    if isinstance(values, np.ndarray):
        # Masked samples have values under their mask, and tolist makes whole numbers of dates.
        if values.dtype.kind not in "fiu" or np.ma.is_masked(values) or values.ndim != 1:
            raise InputError(
                f"{name}: an array of {values.ndim} dimensions and type {values.dtype}, or with"
                " masked values; enter one row of real numbers"
            )
        # Python numbers, so that a message shows 0.5 and not np.float64(0.5).
        values = values.tolist()
    if len(values) < 2:
        raise InputError(f"{name}: a column of {len(values)}; enter at least 2 values")
    problems = [
        f"{name}: value {i} is {quoted(value)}; enter a number"
        for i, value in enumerate(values, start=1)
        if not is_finite_number(value)
    ]
    raise_any(problems)
    a = np.asarray(values, dtype=np.float64) * UNITS[units]
    check_gaps(name, a)
    return Record(name=name, dt_s=float(dt_s), a_mps2=own(a))


def write_record(
    path: str | Path,
    record: Record,
    units: str = "g",
    *,
    within: float = math.inf,
    hold_s: float = math.nan,
) -> None:
    """Write a record as csv of time [s] and acceleration, with a heading line.

    The acceleration is printed to `DECIMALS`, about 1e-5 g. A record already rounded to these, such
    as those of `solver.make_suite` in g, is read back bit for bit.

    Parameters
    ----------
    path : str or Path
        Replaced if it exists.
    record : Record
    units : {"g", "m/s2", "cm/s2", "mm/s2"}
        Of the accelerations written.
    within : float
        Fraction of the record's peak; more decimals are printed where the rounding of a sample
        would be more.
    hold_s : float
        Hold of the envelope of a generated record [s], stated in a comment; NaN for none.

    Returns
    -------
    None

    Raises
    ------
    InputError
        If the unit is not known or the file cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> from solver import read_record, record_from_values
    >>> folder = tempfile.TemporaryDirectory()
    >>> pulse = record_from_values("pulse", [0.0, 0.4, -0.4, 0.0], units="g", dt_s=0.1)
    >>> write_record(f"{folder.name}/pulse.csv", pulse)
    >>> read_record(f"{folder.name}/pulse.csv")
    Record('pulse.csv', 4 samples at 0.1 s)
    >>> folder.cleanup()
    """
    text = record_csv(record, units, within=within, hold_s=hold_s)
    write_whole(Path(path), text.encode())


def record_csv(
    record: Record, units: str = "g", *, within: float = math.inf, hold_s: float = math.nan
) -> str:
    """Return the text that `write_record` writes."""
    _check_arguments(record.name, units, record.dt_s)
    values = record.a_mps2 / UNITS[units]
    # The fewest decimals that print every time exactly: three for a step of 0.005 s.
    places = next((k for k in range(1, 9) if fits(record.dt_s, 10.0**-k)), 9)
    decimals = _decimals(values, DECIMALS[units], within)
    # z: a small negative value prints as 0.00000, not -0.00000.
    row = f"{{:.{places}f}},{{:z.{decimals}f}}\n".format
    body = "".join(row(i * record.dt_s, value) for i, value in enumerate(values.tolist()))
    remark = "" if math.isnan(hold_s) else f"# {HOLD} {hold_s:g} s\n"
    return f"{remark}time_s,acceleration_{units}\n{body}"


def _decimals(values: Floats, minimum: int, within: float) -> int:
    """Decimals, `minimum` or more, that keep rounding `within` that fraction of the peak value."""
    peak = np.abs(values).max()
    if math.isinf(within) or peak == 0.0:
        return minimum
    for decimals in range(minimum, 300):
        if np.abs(values - np.round(values, decimals)).max() <= within * peak:
            return decimals
    # With more than about 300 decimals the power of ten underflows.
    return 300


def check_gaps(name: str, a_mps2: Floats) -> None:
    """Refuse a record with a code for missing data: nines far from the samples next to them."""
    size = np.abs(a_mps2)
    index = int(size.argmax())
    # A code repeats: all samples of its size are set aside.
    is_largest = np.abs(size - size[index]) <= 1e-9 * size[index]
    usual = float(size[~is_largest].max(initial=0.0))
    # Strong shaking may be nearly as large, but does not jump to its peak and back.
    is_next = ~is_largest & (np.append(is_largest[1:], False) | np.append(False, is_largest[:-1]))
    jumps = np.abs(a_mps2[is_next] - a_mps2[index])
    is_alone = size[index] > _ALONE * usual
    if not is_alone and jumps.min(initial=math.inf) <= _JUMP * size[index]:
        return
    values = [f"{a_mps2[index] / unit:.7g}" for unit in UNITS.values()]
    codes = [value for value in values if _CODES.fullmatch(value)]
    if not is_alone:  # a peak may be 999, but hardly -999.0 or 9999
        codes = [code for code in codes if code.startswith("-") or code.count("9") > 3]
    if size[index] > _NO_SHAKING_G * UNITS["g"]:
        # -99 cm/s2 may be shaking; -99 g cannot be.
        codes += _SHORT_CODES.intersection(values)
    if codes:
        raise InputError(
            f"{name}: sample {index + 1:,} is {min(codes, key=len)} where no other exceeds"
            f" {usual / UNITS['g']:.3g} g; this is a code for missing data; use a record"
            " without gaps"
        )


def check_peak(name: str, a_mps2: Floats) -> None:
    """Reject a record beyond `PEAK`: its units are not those stated."""
    peak_g = float(np.abs(a_mps2).max()) / UNITS["g"]
    if not PEAK.has(peak_g):
        raise InputError(
            f"{name}: the values reach {peak_g:.3g} g, which is more than {PEAK.most:g} g; are they"
            " in cm/s2? Enter the correct units, or correct the values"
        )


def has_gravity(a_mps2: Floats | float) -> bool:
    """Whether the mean of a component is about 1 g: its instrument also measured gravity."""
    return bool(0.8 < abs(float(np.mean(a_mps2))) / UNITS["g"] < 1.2)


def read_only(values: ArrayLike) -> Floats:
    """Return the values as a read-only contiguous array of doubles."""
    # numba compiles a second version for writable arrays, so kernels get read-only arrays only.
    array = np.ascontiguousarray(values, dtype=np.float64).view()
    array.setflags(write=False)
    return array


def own(values: ArrayLike) -> Floats:
    """Return a read-only copy of the values, so that their bounds remain valid."""
    copied = np.array(values, dtype=np.float64)
    copied.setflags(write=False)
    return copied


NO_RECORD = read_only(np.empty(0))


def is_finite_number(value: object) -> bool:
    """Whether the value is a number (not a boolean) of magnitude below `BEYOND`."""
    # A difference of dates is an integer to numpy.
    wrong = isinstance(value, bool | np.timedelta64)
    if isinstance(value, int | float | np.integer | np.floating) and not wrong:
        return bool(-BEYOND < value < BEYOND)
    return False


def quoted(value: object) -> str:
    """Return the value as a message shows it: quoted, and shortened if long."""
    text = repr(value)
    return text if len(text) <= 32 else f"{text[:28]}...{text[-1]}"


def _check_arguments(name: str, units: str, dt_s: float) -> None:
    problems = []
    if not isinstance(units, str) or units not in UNITS:
        problems.append(f"{name}: unit is {units!r}; enter one of {', '.join(UNITS)}")
    if not (is_finite_number(dt_s) and dt_s > 0.0):
        problems.append(f"{name}: time step dt is {dt_s!r}; enter a number of seconds above 0")
    raise_any(problems)


def fits(values: float | Floats, resolution: float) -> bool:
    """Whether the values are whole multiples of the resolution, to float precision."""
    with np.errstate(over="ignore", invalid="ignore"):
        counts = np.asarray(values) / resolution
        return bool(np.all(np.abs(counts - np.rint(counts)) < 1e-6))


UNIT_CHOICES = (*UNITS, "gal")
"""Units that a caller may give for a file that does not state its units."""

_G_MPS2 = UNITS["g"]

# COSMOS V1.20 has in/s2 and milli-g too (table 2); g/10 is CSMIP's volume 1.
_SIZES = UNITS | {
    "gal": 0.01,
    "g/10": _G_MPS2 / 10.0,
    "%g": _G_MPS2 / 100.0,
    "mg": _G_MPS2 / 1000.0,
    "µg": _G_MPS2 / 1e6,
    "µm/s2": 1e-6,
    "nm/s2": 1e-9,
    "ft/s2": 0.3048,
    "in/s2": INCH_M,
}

_LENGTHS = "nm|µm|mm|cm|m|ft|in"
_NOT_ACCELERATION = re.compile(
    rf"({_LENGTHS})(/s)?|[a-z]+/s[23]|rad|(rad|deg|°)/s|dps|deg|°[cf]?|m?volts?|mv|%|[uµμ]t"
    r"|[hkm]?pa|[pk]s[if]|[km]n|lbf?|kips?|kgf"  # N alone is north
    r"|[cdk]g|n/kg|[kmn]*n-?m|gs|g2/hz|[uµ]nitless|dimensionless|normali[sz]ed|-|[%‰].*"
    # A multiple of a unit: 0.001g, x1000g, g/2, dm/s2.
    r"|x?\d[\d^e.-]*(?:g|gal|[cm]?m/s2)|(?:g|gal|[cm]?m/s2)(?:,?[x×/]\d.*|10{2,})|[dk]m/s2"
)
_SPELLINGS = tuple(
    (re.compile(pattern), short)
    for pattern, short in (
        (r"^cms/", "cm/"), (r"^inch(?:es)?", "in"), (r"^(?:feet|foot)", "ft"),
        (r"^met(?:er|re)s?", "m"), (r"^milli-?", "m"), (r"^(?:micro-?|u|μ)", "µ"),
        (r"^nano-?", "n"), (r"^g(?:n|'s)$", "g"), (r"se[cg](?:onds?)?", "s"), (r"s/s", "s2"),
        (r"^gals$", "gal"),
    )
)  # fmt: skip
_RAW = {"count", "counts", "lsb", "digits", "adc"}


def unit_size(text: str) -> float:
    """Value [m/s2] of a unit in any of its spellings; NaN if it is not a unit of acceleration."""
    return _SIZES.get(_plain(text), math.nan)


def is_other_unit(text: str) -> bool:
    """Whether the text is the unit of another quantity, or of an acceleration not known here."""
    return bool(_NOT_ACCELERATION.fullmatch(_plain(text))) and math.isnan(unit_size(text))


def is_raw(text: str) -> bool:
    """Whether the text names the steps of a digitizer, which are no unit."""
    return text.strip().lower() in _RAW


def _plain(text: str) -> str:
    """Normalize: `CM/SEC/SEC`, `cm/s**2`, `cm.s^-2`, `cmps2` and `cm/s²` become `cm/s2`."""
    # "s*s" first, because the next step removes the star and other marks between units.
    plain = (
        re.sub(r"[\s^*·.]", "", text.lower().replace("s*s", "s2"))
        .replace("²", "2")
        .replace("⁻", "-")
    )
    for pattern, short in _SPELLINGS:
        plain = pattern.sub(short, plain)
    return re.sub(rf"^({_LENGTHS})(?:[p_/]s-?2|s-2)$", r"\1/s2", plain)
