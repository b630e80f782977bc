"""Measures of a record: peaks, drift, Arias intensity and significant duration, exactly.

An acceleration of 1 m/s2 held for 1 s has an Arias intensity of pi / (2 g) = 0.16 m/s, and ends
with a velocity of 1 m/s.

Changes no record (`solver.records.processing` does) and computes no spectra
(`solver.records.spectrum` does). Read `measures` first.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from solver.model import Floats
from solver.records.record import UNITS, Record

G_MPS2 = UNITS["g"]
# Fractions of the Arias intensity that bound the significant duration.
SIGNIFICANT = (0.05, 0.95)


@dataclass(frozen=True, slots=True, kw_only=True)
class Measures:
    """Measures of a record. Velocity and displacement start at zero, without baseline correction.

    Attributes
    ----------
    pga_mps2, pgv_mps, pgd_m : float
        Largest |acceleration| [m/s2], |velocity| [m/s] and |displacement| [m], including between
        samples.
    arias_mps : float
        Arias intensity, pi / (2 g) times the integral of a^2 [m/s].
    d5_95_s : float
        Time from 5% to 95% of the Arias intensity [s]; 0 for a record of zeros.
    final_velocity_mps, final_displacement_m : float
        Signed values at the last sample [m/s], [m]: the drift of the record.
    """

    pga_mps2: float
    pgv_mps: float
    pgd_m: float
    arias_mps: float
    d5_95_s: float
    final_velocity_mps: float
    final_displacement_m: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Strength:
    """Arias intensity [m/s] and significant duration [s] of a record, as in `Measures`."""

    arias_mps: float
    d5_95_s: float


def strength(record: Record) -> Strength:
    """Measure the Arias intensity and the significant duration of a record."""
    a, dt = record.a_mps2, record.dt_s
    cumulative = _cumulative(a, dt)
    times = [_time_of(a, dt, cumulative, share * float(cumulative[-1])) for share in SIGNIFICANT]
    return Strength(
        arias_mps=float(0.5 * math.pi / G_MPS2 * cumulative[-1]), d5_95_s=times[1] - times[0]
    )


def correlation(record: Record, second: Record) -> float:
    """Correlation coefficient of two records of equal step and length; 0 if either is constant."""
    # At zero lag: neither record is shifted against the other.
    a, b = record.a_mps2 - record.a_mps2.mean(), second.a_mps2 - second.a_mps2.mean()
    product = math.sqrt(float(a @ a) * float(b @ b))
    return float(a @ b) / product if product > 0.0 else 0.0


def measures(record: Record) -> Measures:
    """Measure peaks, drift, Arias intensity and duration of a record.

    As analyzed by the solver, acceleration is linear between samples. Velocity is then quadratic
    and displacement cubic in each interval. Peaks inside an interval are found as roots, and the
    times of 5% and 95% of the Arias intensity in closed form. Arias (1970) in Seismic Design for
    Nuclear Power Plants, MIT Press, 438-483; significant duration: Trifunac and Brady, Bull. Seism.
    Soc. Am. 65 (1975) 581-626.

    Parameters
    ----------
    record : Record

    Returns
    -------
    Measures

    Raises
    ------
    Nothing
        A record was checked when it was made.

    Examples
    --------
    >>> from solver import record_from_values
    >>> pulse = record_from_values("pulse", [0.0, 4.0, -4.0, 0.0], units="m/s2", dt_s=0.1)
    >>> measures(pulse).pga_mps2
    4.0
    """
    a, dt = record.a_mps2, record.dt_s
    v, d = velocity_displacement(record)
    strong = strength(record)
    return Measures(
        pga_mps2=float(np.abs(a).max()),
        pgv_mps=_greatest(v, _velocity_peaks(a, dt, v)),
        pgd_m=_greatest(d, _displacement_peaks(a, dt, v, d)),
        arias_mps=strong.arias_mps,
        d5_95_s=strong.d5_95_s,
        final_velocity_mps=float(v[-1]),
        final_displacement_m=float(d[-1]),
    )


def velocity_displacement(record: Record) -> tuple[Floats, Floats]:
    """Return velocity [m/s] and displacement [m] at the samples, exact, both starting at zero."""
    a, dt = record.a_mps2, record.dt_s
    # v' = a and d' = v, with a linear: v is exact by trapezia, d by dt v0 + dt^2 (2 a0 + a1) / 6.
    v = _summed(0.5 * dt * (a[:-1] + a[1:]))
    return v, _summed(dt * v[:-1] + dt * dt / 6.0 * (2.0 * a[:-1] + a[1:]))


def _summed(steps: Floats) -> Floats:
    return np.concatenate([[0.0], np.cumsum(steps)])


def _greatest(samples: Floats, between: Floats) -> float:
    return float(max(np.abs(samples).max(), np.abs(between).max(initial=0.0)))


def _velocity_peaks(a: Floats, dt: float, v: Floats) -> Floats:
    """Velocities where the acceleration crosses zero inside an interval."""
    crossings = np.flatnonzero(a[:-1] * a[1:] < 0.0)
    before, after = a[crossings], a[crossings + 1]
    # v0 + a0 x / 2 at x = dt a0 / (a0 - a1), where the acceleration is zero.
    return v[crossings] + 0.5 * dt * before * before / (before - after)


def _displacement_peaks(a: Floats, dt: float, v: Floats, d: Floats) -> Floats:
    """Displacements where the velocity is zero inside an interval."""
    # The velocity is v + a x + r x^2 / 2 at a time x in the interval. The root of larger magnitude
    # is computed without cancellation, and the other one from the product of the roots.
    r = np.diff(a) / dt
    start, speed, place = a[:-1], v[:-1], d[:-1]
    with np.errstate(divide="ignore", invalid="ignore"):
        q = -(start + np.copysign(np.sqrt(start * start - 2.0 * r * speed), start))
        peaks = []
        for x in (q / r, 2.0 * speed / q):
            # Where r or q is zero a root is infinite or NaN, which the next line leaves out.
            moved = place + x * (speed + x * (0.5 * start + x * r / 6.0))
            peaks.append(moved[(x > 0.0) & (x < dt)])
    return np.concatenate(peaks)


def _cumulative(a: Floats, dt: float) -> Floats:
    """Integral of a^2 from the start to each sample [m2/s3]."""
    before, after = a[:-1], a[1:]
    # The integral of a linear function squared: dt (a0^2 + a0 a1 + a1^2) / 3.
    return _summed(dt / 3.0 * (before * before + before * after + after * after))


def _time_of(a: Floats, dt: float, cumulative: Floats, target: float) -> float:
    """Time at which the integral of a^2 reaches a given value."""
    # Within an interval the integral is (c^3 - a^3) / (3 r), where c is the acceleration at the
    # time x and c - a = r x. Factoring out c - a gives x without cancellation.
    # A record of zeros reaches every share at its start.
    i = max(int(np.searchsorted(cumulative, target)) - 1, 0)
    start, r = float(a[i]), float(a[i + 1] - a[i]) / dt
    missing = 3.0 * (target - float(cumulative[i]))
    c = float(np.cbrt(start**3 + r * missing))
    below = c * c + c * start + start * start
    return i * dt + (missing / below if below > 0.0 else 0.0)
