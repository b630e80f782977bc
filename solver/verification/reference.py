"""The sliding block in decimal arithmetic of 50 digits: slow, plain, independent of the kernels.

Written in the paper's variables (horizontal, Eqs. 12-18 with g + a_v for g) and not along the
slope, so that an algebra error in the kernels would show. Imports nothing from this project.

    pulse_travel(0.4 * 9.81, 0.1 * 9.81, 0.2, 0.0)     0.235440 m, by Newmark's formula

Read `slide`; below it are problems with a closed form.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from decimal import Decimal, localcontext
from typing import NamedTuple

DIGITS = 50

# Smaller values are treated as rounding error: with 50 digits, that of a value near 1 is 1e-50.
_TINY = Decimal("1e-45")
_ZERO = Decimal(0)

_Line = tuple[Decimal, Decimal]
"""A value and its rate: an acceleration that varies linearly."""


class Reference(NamedTuple):
    """Peak and last horizontal displacement relative to the roof [m]."""

    prd_m: float
    residual_m: float


def slide(
    ax_mps2: Sequence[float],
    dt_s: float,
    *,
    slope_rad: float,
    mu: float,
    az_mps2: Sequence[float] | None = None,
    scale: float = 1.0,
    g_mps2: float,
) -> Reference:
    """Integrate the linearly interpolated record from event to event; assumes N >= 0."""
    with localcontext() as context:
        context.prec = DIGITS
        # Decimal(float) is the exact binary value, so both computations have the same input.
        theta, friction, g, dt, factor = map(Decimal, (slope_rad, mu, g_mps2, dt_s, scale))
        a_h = [factor * Decimal(a) for a in ax_mps2]
        a_v = [factor * Decimal(a) for a in az_mps2] if az_mps2 is not None else [_ZERO] * len(a_h)
        sine, cosine = _sine_and_cosine(theta)
        block = _Block(dt)
        samples = {
            sign: [
                _relative(sign, h, g + v, sine, cosine, friction)
                for h, v in zip(a_h, a_v, strict=True)
            ]
            for sign in (1, -1)
        }
        # For slip of one sign u'' is linear between samples, as a_h and a_v are.
        for i in range(len(a_h) - 1):
            block.follow({sign: (a[i], (a[i + 1] - a[i]) / dt) for sign, a in samples.items()})
        return Reference(float(max(block.high, -block.low)), float(block.u))


def _sine_and_cosine(theta: Decimal) -> tuple[Decimal, Decimal]:
    """Return both from their power series."""
    sums, term, n = [_ZERO, _ZERO], Decimal(1), 0
    while abs(term) > _TINY * _TINY:
        # Even powers belong to the cosine, odd powers to the sine; the signs are + + - -.
        sums[n % 2] += term if n % 4 < 2 else -term
        n += 1
        term *= theta / n
    return sums[1], sums[0]


def _relative(
    sign: int, a_h: Decimal, g: Decimal, sine: Decimal, cosine: Decimal, mu: Decimal
) -> Decimal:
    """Return u_x'' - u_p'' for slip of one sign, Eqs. 13 to 18."""
    tangent = sine / cosine
    a = sine - mu * sign * cosine
    b = cosine + mu * sign * sine
    c = g + a_h * tangent
    return a * c / (a * tangent + b) - a_h


class _Block:
    """Displacement u and velocity v relative to the roof, and the extremes of u."""

    def __init__(self, dt: Decimal):
        self.dt = dt
        self.u = self.v = self.low = self.high = _ZERO
        self.moving = 0

    def follow(self, lines: dict[int, _Line]) -> None:
        """Advance one interval; `lines` holds the acceleration for slip of either sign."""
        t = _ZERO
        while t < self.dt:
            if not self.moving:
                onset = self._onset(lines, t)
                if onset is None:
                    return
                t, self.moving = onset
            a, rate = lines[self.moving]
            t = self._slip(a + rate * t, rate, t)

    def _onset(self, lines: dict[int, _Line], t: Decimal) -> tuple[Decimal, int] | None:
        onsets = []
        for sign, (a, rate) in lines.items():
            net_driving, rise = sign * (a + rate * t), sign * rate
            if net_driving > _TINY:
                onsets.append((t, sign))
            elif rise > 0 and t - net_driving / rise < self.dt:
                onsets.append((max(t, t - net_driving / rise), sign))
        return min(onsets, default=None)

    def _slip(self, a: Decimal, rate: Decimal, t: Decimal) -> Decimal:
        """Slip to the stop or the end of the interval, whichever is first; return that time."""
        stop = _first_zero(self.v, a, rate, self.dt - t)
        h = self.dt - t if stop is None else stop
        self.u += h * (self.v + h * (a / 2 + h * rate / 6))
        self.v += h * (a + h * rate / 2)
        self.low, self.high = min(self.low, self.u), max(self.high, self.u)
        if stop is None:
            return self.dt
        self.v, self.moving = _ZERO, 0
        return t + h


def _first_zero(v: Decimal, a: Decimal, rate: Decimal, h: Decimal) -> Decimal | None:
    """Return the first t in (0, h] where v + a t + rate t^2 / 2 is 0."""
    roots = []
    if rate == 0:
        roots = [-v / a] if a != 0 else []
    elif (square := a * a - 2 * rate * v) >= 0:
        roots = [(-a - square.sqrt()) / rate, (-a + square.sqrt()) / rate]
    # t = 0 is excluded: it is the beginning of the slip.
    return min((t for t in roots if _TINY < t <= h), default=None)


def pulse_travel(drive_mps2: float, resist_mps2: float, plateau_s: float, ramp_s: float) -> float:
    """Return the travel [m] under a trapezoidal pulse, by integration of its polynomials.

    The driving acceleration rises over a ramp to `drive`, stays there for `plateau` and falls over
    a ramp; friction less gravity resists with `resist` < drive throughout. A ramp of 0 gives
    Newmark's rectangular pulse, V^2 / (2 resist) (1 - resist / drive) with V = drive T.

    Valid for long plateaus only: the speed must not reach zero within the falling ramp.
    """
    net_driving = drive_mps2 - resist_mps2
    rate = drive_mps2 / ramp_s if ramp_s else math.inf
    rise = net_driving / rate
    speed = rate * rise**2 / 2 if ramp_s else 0.0
    travel = rate * rise**3 / 6 if ramp_s else 0.0
    travel += speed * plateau_s + net_driving * plateau_s**2 / 2
    speed += net_driving * plateau_s
    if ramp_s:
        travel += speed * ramp_s + net_driving * ramp_s**2 / 2 - rate * ramp_s**3 / 6
        speed += net_driving * ramp_s - rate * ramp_s**2 / 2
    return travel + speed**2 / (2 * resist_mps2)


def slope_pulse(
    slope_rad: float, mu: float, horizontal_g: float, vertical_g: float, g_mps2: float
) -> tuple[float, float]:
    """Return (drive, resist) [m/s2] for a pulse that accelerates the roof upslope."""
    # Downslope s'' = (g + a_v)(sin - mu cos) + a (cos + mu sin), a the upslope acceleration.
    weight = math.sin(slope_rad) - mu * math.cos(slope_rad)
    push = math.cos(slope_rad) + mu * math.sin(slope_rad)
    return (horizontal_g * push + vertical_g * weight) * g_mps2, -weight * g_mps2


def half_sine_travel(amplitude_g: float, mu: float, freq_hz: float, g_mps2: float) -> float:
    """Return the travel [m] on a flat roof under half a period of A sin(2 pi f t)."""
    # Slip begins at sin(omega t) = mu / A and outlasts the pulse.
    omega = 2 * math.pi * freq_hz
    peak, friction = amplitude_g * g_mps2, mu * g_mps2
    start, end = math.asin(mu / amplitude_g) / omega, math.pi / omega
    lasts = end - start
    speed_start = peak / omega * math.cos(omega * start)
    speed = speed_start + peak / omega - friction * lasts
    travel = speed_start * lasts - friction * lasts**2 / 2
    travel += peak / omega**2 * math.sin(omega * start)
    return travel + speed**2 / (2 * friction)


def harmonic_travel(amplitude_g: float, mu: float, freq_hz: float, g_mps2: float) -> float:
    """Return the travel [m] per half cycle on a flat roof in steady state without sticking."""
    # (2 A / omega^2) sqrt(1 - (pi eta / 2)^2), eta = mu g / A < 2 / sqrt(4 + pi^2).
    omega = 2 * math.pi * freq_hz
    eta = mu / amplitude_g
    root = math.sqrt(1 - (math.pi * eta / 2) ** 2)
    return 2 * amplitude_g * g_mps2 / omega**2 * root


def free_slide_travel(slope_rad: float, mu: float, time_s: float, g_mps2: float) -> float:
    """Return the travel [m] from rest on an unshaken roof steeper than the friction angle."""
    return 0.5 * g_mps2 * (math.sin(slope_rad) - mu * math.cos(slope_rad)) * time_s**2


def yield_accelerations(slope_rad: float, mu: float, g_mps2: float) -> tuple[float, float]:
    """Return the horizontal accelerations [m/s2] at which slip begins: downslope, upslope."""
    # -g tan(phi - theta) and g tan(phi + theta) with phi = atan(mu), no vertical shaking; the
    # second is infinite where mu sin(theta) >= cos(theta) (self-locking).
    phi = math.atan(mu)
    locked = mu * math.sin(slope_rad) >= math.cos(slope_rad)
    up = math.inf if locked else g_mps2 * math.tan(phi + slope_rad)
    return -g_mps2 * math.tan(phi - slope_rad), up
