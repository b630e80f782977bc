"""The sliding block in high-precision arithmetic: slow, plain, and apart from the kernels.

Written in the paper's own variables (horizontal, Eqs. 12-18 with g + a_v for g), not along the
slope, and by a queue of events, so that a slip in the kernels' algebra would show.
"""

from dataclasses import dataclass

from mpmath import mp, mpf

mp.dps = 40


@dataclass
class Oracle:
    prd: mpf
    residual: mpf
    down: mpf
    up: mpf
    fastest: mpf  # along the slope
    n_stops: int
    t_prd: mpf
    events: list[tuple[mpf, mpf]]  # time, u: a slip, a stop, and so on
    history: list[tuple[mpf, mpf]]  # u and u' at the samples


def _relative_acceleration(sign, a_h, a_v, theta, mu, g):
    """u_x'' - u_p'' while sliding with the sign of the relative velocity, Eq. 18."""
    a = mp.sin(theta) - mu * sign * mp.cos(theta)
    b = mp.cos(theta) + mu * sign * mp.sin(theta)
    c = g + a_v + a_h * mp.tan(theta)
    return a * c / (a * mp.tan(theta) + b) - a_h


def _first_zero(v, a0, a1, h):
    """Earliest root in (0, h] of v + a0 t + (a1 - a0) t^2 / (2 H), given as coefficients."""
    roots, square = [], a0 * a0 - 2 * a1 * v
    if square >= 0:
        # No difference of near numbers: a1 may be 1e-36 of a0, all digits of that difference.
        far = -(a0 + (mp.sqrt(square) if a0 >= 0 else -mp.sqrt(square)))
        roots = [2 * v / far] if far != 0 else [mpf(0)]
        if a1 != 0:
            roots.append(far / a1)
    roots = [t for t in roots if mpf("1e-36") < t <= h]
    return min(roots) if roots else None


def slide(ax, dt, *, slope_rad, mu, az=None, scale=1.0, g=9.80665):
    """Return the exact motion of the linearly interpolated record, to 40 digits."""
    theta, mu, g, dt, scale = (mpf(v) for v in (slope_rad, mu, g, dt, scale))
    a_h = [scale * mpf(float(v)) for v in ax]
    a_v = [scale * mpf(float(v)) for v in az] if az is not None else [mpf(0)] * len(a_h)
    # The relative acceleration is affine in (a_h, g + a_v): three evaluations give its weights.
    weights = {}
    for sign in (1, -1):
        base = _relative_acceleration(sign, mpf(0), mpf(0), theta, mu, g)
        weights[sign] = (
            base,
            _relative_acceleration(sign, mpf(1), mpf(0), theta, mu, g) - base,
            _relative_acceleration(sign, mpf(0), mpf(1), theta, mu, g) - base,
        )

    def acceleration(sign, i):
        base, per_h, per_v = weights[sign]
        return base + per_h * a_h[i] + per_v * a_v[i]

    u = v = low = high = fastest = t_prd = mpf(0)
    moving, n_stops, events, history = 0, 0, [], [(u, v)]
    ends = {sign: acceleration(sign, 0) for sign in (1, -1)}
    for i in range(len(a_h) - 1):
        starts, ends = ends, {sign: acceleration(sign, i + 1) for sign in (1, -1)}
        rates = {sign: (ends[sign] - starts[sign]) / dt for sign in (1, -1)}
        t = mpf(0)
        while t < dt:
            if not moving:
                onsets = []
                for sign in (1, -1):
                    push, rate = sign * (starts[sign] + rates[sign] * t), sign * rates[sign]
                    if push > mpf("1e-36"):
                        onsets.append((t, sign))
                    # What reaches the limit at the end of a step slips in the next, or not at all.
                    elif rate > 0 and t - push / rate < dt - mpf("1e-36"):
                        onsets.append((max(t, t - push / rate), sign))
                if not onsets:
                    break
                t, moving = min(onsets)
                events.append((i * dt + t, u))
            a0, rate = starts[moving] + rates[moving] * t, rates[moving]
            stop = _first_zero(v, a0, rate, dt - t)
            h = dt - t if stop is None else stop
            # The speed is a parabola in time: largest at an end or at its vertex.
            ends_at = [h, *([-a0 / rate] if rate != 0 and 0 < -a0 / rate < h else [])]
            fastest = max(fastest, *(abs(v + a0 * x + rate * x**2 / 2) for x in ends_at))
            u += v * h + a0 * h**2 / 2 + rate * h**3 / 6
            v += a0 * h + rate * h**2 / 2
            t = dt if stop is None else t + h
            if stop is not None:
                v, moving = mpf(0), 0
                n_stops += 1
                events.append((i * dt + t, u))
            if abs(u) > max(high, -low):
                t_prd = i * dt + t
            low, high = min(low, u), max(high, u)
        history.append((u, v))
    return Oracle(
        prd=max(high, -low),
        residual=u,
        down=high,
        up=-low,
        fastest=fastest / mp.cos(theta),
        n_stops=n_stops,
        t_prd=t_prd,
        events=events,
        history=history,
    )
