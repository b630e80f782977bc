"""Problems with a closed form; none uses the solver.

Lengths are along the slope, s [m]; the horizontal displacement is s cos(theta).
"""

from __future__ import annotations

import math


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
    """Return (drive, resist) [m/s2] for a pulse that accelerates the roof upslope.

    Downslope s'' = (g + a_v)(sin - mu cos) + a (cos + mu sin), a the upslope acceleration.
    """
    weight = math.sin(slope_rad) - mu * math.cos(slope_rad)
    push = math.cos(slope_rad) + mu * math.sin(slope_rad)
    return (horizontal_g * push + vertical_g * weight) * g_mps2, -weight * g_mps2


def half_sine_travel(amplitude_g: float, mu: float, freq_hz: float, g_mps2: float) -> float:
    """Return the travel [m] on a flat roof under half a period of A sin(2 pi f t).

    Slip begins at sin(omega t) = mu / A and outlasts the pulse.
    """
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
    """Return the travel [m] per half cycle on a flat roof, steady-state harmonic without sticking.

    (2 A / omega^2) sqrt(1 - (pi eta / 2)^2), eta = mu g / A < 2 / sqrt(4 + pi^2).
    """
    omega = 2 * math.pi * freq_hz
    eta = mu / amplitude_g
    root = math.sqrt(1 - (math.pi * eta / 2) ** 2)
    return 2 * amplitude_g * g_mps2 / omega**2 * root


def free_slide_travel(slope_rad: float, mu: float, time_s: float, g_mps2: float) -> float:
    """Return the travel [m] from rest on an unshaken roof steeper than the friction angle."""
    return 0.5 * g_mps2 * (math.sin(slope_rad) - mu * math.cos(slope_rad)) * time_s**2


def yield_accelerations(slope_rad: float, mu: float, g_mps2: float) -> tuple[float, float]:
    """Return the horizontal accelerations [m/s2] at which slip begins: downslope, upslope.

    -g tan(phi - theta) and g tan(phi + theta) with phi = atan(mu), no vertical shaking; the second
    is infinite where mu sin(theta) >= cos(theta) (self-locking).
    """
    phi = math.atan(mu)
    locked = mu * math.sin(slope_rad) >= math.cos(slope_rad)
    up = math.inf if locked else g_mps2 * math.tan(phi + slope_rad)
    return -g_mps2 * math.tan(phi - slope_rad), up
