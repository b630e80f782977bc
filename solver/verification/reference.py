"""The sliding block in decimal arithmetic of 50 digits: slow, plain, independent of the kernels.

Written in the paper's variables (horizontal, Eqs. 12-18 with g + a_v for g) and not along the
slope, so that an algebra error in the kernels would show. Imports nothing from this project.
"""

from __future__ import annotations

from collections.abc import Sequence
from decimal import Decimal, localcontext
from typing import NamedTuple

DIGITS = 50

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
        theta, friction, g, dt, factor = map(Decimal, (slope_rad, mu, g_mps2, dt_s, scale))
        a_h = [factor * Decimal(a) for a in ax_mps2]
        a_v = [factor * Decimal(a) for a in az_mps2] if az_mps2 is not None else [_ZERO] * len(a_h)
        sine, cosine = _sine_and_cosine(theta)
        block = _Block(dt)
        at = {
            sign: [
                _relative(sign, h, g + v, sine, cosine, friction)
                for h, v in zip(a_h, a_v, strict=True)
            ]
            for sign in (1, -1)
        }
        for i in range(len(a_h) - 1):
            block.follow({sign: (a[i], (a[i + 1] - a[i]) / dt) for sign, a in at.items()})
        return Reference(float(max(block.high, -block.low)), float(block.u))


def _sine_and_cosine(theta: Decimal) -> tuple[Decimal, Decimal]:
    """Return both from their power series."""
    sums, term, n = [_ZERO, _ZERO], Decimal(1), 0
    while abs(term) > _TINY * _TINY:
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
    return min((t for t in roots if _TINY < t <= h), default=None)
