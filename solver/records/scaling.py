"""Scaling of a motion to a target spectrum: one factor for all its components.

The only target defined here is the design spectrum of ASCE 7. Changes no record.
Read `factor_to_target` first.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from solver.model import Floats, InputError
from solver.records.record import UNITS, Record
from solver.records.spectrum import response_spectrum

Target = Callable[[Floats], Floats]
"""Spectral acceleration [g] at frequencies [Hz], 5 % damping."""

DAMPING = 0.05
PER_DECADE = 100


def design_spectrum(*, s_ds_g: float, s_d1_g: float, t_l_s: float) -> Target:
    """Return the design response spectrum at the ground.

    S_DS (0.4 + 0.6 T / T_0) up to T_0 = 0.2 T_S, S_DS up to T_S = S_D1 / S_DS, S_D1 / T up to T_L,
    S_D1 T_L / T^2 beyond: ASCE/SEI 7-16, 11.4.6; ASCE/SEI 7-22, 11.4.5.2 (two-period spectrum).

    Parameters
    ----------
    s_ds_g, s_d1_g : float
        Design spectral acceleration at short periods and at 1 s [g], > 0.
    t_l_s : float
        Long-period transition period [s], > T_S.

    Returns
    -------
    callable
        Spectral acceleration [g] at frequencies [Hz], array of any shape.

    Raises
    ------
    InputError
        For a number out of range.

    Examples
    --------
    >>> import numpy as np
    >>> target = design_spectrum(s_ds_g=1.2, s_d1_g=0.6, t_l_s=8.0)
    >>> target(1.0 / np.array([0.2, 1.0, 2.0]))
    array([1.2, 0.6, 0.3])
    """
    _check_design(s_ds_g, s_d1_g, t_l_s)
    return partial(_design, s_ds_g=s_ds_g, s_d1_g=s_d1_g, t_l_s=t_l_s)


def _design(freq_hz: Floats, *, s_ds_g: float, s_d1_g: float, t_l_s: float) -> Floats:
    with np.errstate(divide="ignore"):
        period = 1.0 / np.asarray(freq_hz, dtype=np.float64)
    rising = s_ds_g * np.minimum(0.4 + 0.6 * period / (0.2 * (s_d1_g / s_ds_g)), 1.0)
    # At period 0 this branch is infinite, and the other one governs; at frequency 0 it is zero.
    with np.errstate(divide="ignore", invalid="ignore"):
        falling = s_d1_g / period * np.minimum(1.0, t_l_s / period)
    return np.asarray(np.fmin(rising, falling))


def factor_to_target(
    horizontals: Sequence[Record], target: Target, periods_s: tuple[float, float]
) -> float:
    """Return the factor that scales a motion to a target spectrum.

    It holds on average over a range of periods: the factor is the exponential of the mean of
    ln(target / spectrum) over log-spaced periods. The spectrum is the geometric mean of the
    horizontal components' spectra, 5 % damping. This factor minimizes the sum of squared
    differences of the logarithms. It applies to all components of the motion, including the
    vertical.

    Parameters
    ----------
    horizontals : sequence of Record
        One or two components.
    target : callable
        See `Target`; ``RequiredSpectrum.at`` is one.
    periods_s : tuple of float
        Shortest and longest period [s].

    Returns
    -------
    float
        Such as the `scale` of `solver.motion`.

    Raises
    ------
    InputError
        If the range is invalid, or a component is zero throughout.

    Examples
    --------
    >>> from solver import design_spectrum, read_record
    >>> records = [read_record(f"projects/example/records/RM1-{name}.csv") for name in "xy"]
    >>> target = design_spectrum(s_ds_g=1.2, s_d1_g=0.6, t_l_s=8.0)
    >>> round(factor_to_target(records, target, (0.2, 2.0)), 3)
    0.359
    """
    _check_range(periods_s)
    shortest_s, longest_s = periods_s
    count = math.ceil(PER_DECADE * math.log10(longest_s / shortest_s)) + 1
    periods = np.geomspace(shortest_s, longest_s, max(count, 2))
    logs = [_log_spectrum(record, periods) for record in horizontals]
    difference = np.log(target(1.0 / periods)) - np.mean(logs, axis=0)
    return float(np.exp(difference.mean()))


def _log_spectrum(record: Record, periods_s: Floats) -> Floats:
    if not record.a_mps2.any():
        raise InputError(f"{record.name}: is zero throughout; it cannot be scaled to a target")
    spectrum = response_spectrum(record.a_mps2, record.dt_s, periods_s, DAMPING)
    return np.asarray(np.log(spectrum / UNITS["g"]))


def _check_range(periods_s: tuple[float, float]) -> None:
    shortest, longest = periods_s
    if not 0.0 < shortest < longest < math.inf:
        raise InputError(
            f"period range is {shortest:g} s to {longest:g} s; give two periods above 0, the "
            f"second longer"
        )


def _check_design(s_ds_g: float, s_d1_g: float, t_l_s: float) -> None:
    problems = [
        f"{name} is {value:g} {unit}; give a number above 0"
        for name, value, unit in (
            ("S_DS", s_ds_g, "g"),
            ("S_D1", s_d1_g, "g"),
            ("T_L", t_l_s, "s"),
        )
        if not 0.0 < value < math.inf
    ]
    if not problems and t_l_s <= s_d1_g / s_ds_g:
        problems = [f"T_L is {t_l_s:g} s; give more than T_S = {s_d1_g / s_ds_g:g} s"]
    if problems:
        raise InputError(problems)
