"""Response spectra of records, and the factor that scales a motion to a target spectrum.

Far above the frequencies of a record the ordinate is its peak: a stiff oscillator moves as the
roof.

Reads no files. Read `response_spectrum`, then `factor_to_target`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solver.errors import InputError, raise_any
from solver.model import Floats, Motion
from solver.records.record import UNITS, Record, read_only

if TYPE_CHECKING:
    import pandas as pd

# Least steps per period of an oscillator; most steps per interval of the record.
PEAK_FINENESS, PEAK_STEPS = 16, 16

# Periods [s] of `spectrum`, where none are given.
PERIODS_S = read_only(np.geomspace(0.02, 10.0, 200))


@dataclass(frozen=True, slots=True, kw_only=True)
class ResponseSpectrum:
    """Response spectra of the components of a motion.

    Attributes
    ----------
    periods_s : array, shape (m,)
        Natural periods [s].
    sa_mps2 : dict of str to array, shape (m,)
        Pseudo-spectral acceleration [m/s2] of each component, by its name.
    damping : float
        Fraction of critical damping.
    """

    periods_s: Floats
    sa_mps2: dict[str, Floats]
    damping: float

    def __repr__(self) -> str:
        peaks = ", ".join(f"{name} up to {a.max():.3g} m/s2" for name, a in self.sa_mps2.items())
        return f"ResponseSpectrum: {self.periods_s.size} periods, {100 * self.damping:g}%; {peaks}"

    def to_frame(self) -> pd.DataFrame:
        """Return the spectra [m/s2] as a table with one column each, indexed by period [s]."""
        import pandas as pd  # optional, and 0.8 s to load

        return pd.DataFrame(self.sa_mps2, index=pd.Index(self.periods_s, name="period_s"))


def spectrum(
    shaking: Record | Motion, periods_s: ArrayLike | None = None, damping: float = 0.05
) -> ResponseSpectrum:
    """Return the response spectra of a record, or of a motion with its scale.

    Pseudo-spectral accelerations, exact for the linearly interpolated record: Nigam and Jennings,
    Bull. Seism. Soc. Am. 59 (1969) 909-922.

    Parameters
    ----------
    shaking : Record or Motion
    periods_s : array_like, shape (m,)
        Natural periods [s], >= 0; 0 gives the peak acceleration. By default 200 from 0.02 to 10 s.
    damping : float
        Fraction of critical damping, in [0, 1).

    Returns
    -------
    ResponseSpectrum
        Of a record by its name, of a motion by `x`, `y` and `z`.

    Raises
    ------
    InputError
        For a period or a damping out of range.

    Examples
    --------
    >>> from solver import motion
    >>> pulse = motion([0.0, 4.0, -4.0, 0.0], dt_s=0.1)
    >>> spectrum(pulse, [0.0, 0.5, 1.0]).to_frame().round(2)
                 x
    period_s
    0.0       4.00
    0.5       3.04
    1.0       1.17
    """
    periods = np.asarray(PERIODS_S if periods_s is None else periods_s, dtype=np.float64)
    return ResponseSpectrum(
        periods_s=periods,
        sa_mps2={
            name: response_spectrum(a, shaking.dt_s, periods, damping)
            for name, a in _components(shaking).items()
        },
        damping=damping,
    )


def _components(shaking: Record | Motion) -> dict[str, Floats]:
    if isinstance(shaking, Record):
        return {shaking.name: shaking.a_mps2}
    return {name: shaking.scaled(a) for name, a in shaking.components.items()}


def response_spectrum(
    a_mps2: ArrayLike, dt_s: float, periods_s: ArrayLike, damping: float = 0.05
) -> Floats:
    """Pseudo-spectral acceleration of a record, omega^2 times the largest |displacement|.

    The oscillators are solved exactly for the linearly interpolated record (Nigam and Jennings,
    Bull. Seism. Soc. Am. 59 (1969) 909-922), from rest to the end of the record. Peaks between the
    steps are found on cubics through the exact states, with `PEAK_FINENESS` steps per period or
    more: within 0.02% for periods of dt and longer (white noise: 0.007%), or within 0.02% of the
    peak acceleration where a record of a few steps leaves the spectrum far below it. Below dt the
    steps are `PEAK_STEPS` per interval: within 0.05% to dt/2, and at samples of the steps alone
    below dt/2.5. Free vibration after the end of the record is not included: pad the record with
    zeros to include it. Arguments and errors are those of `spectrum`.
    """
    from solver.kernels import oscillator  # with the compiler, which targets need not

    a, periods = read_only(a_mps2), np.asarray(periods_s, dtype=np.float64)
    _check_spectrum(a, dt_s, periods, damping)
    with np.errstate(divide="ignore", over="ignore"):
        # A period of 0 is an infinite frequency: the oscillator is rigid.
        omega = 2.0 * math.pi / periods
    rigid = ~np.isfinite(omega)
    # A rigid oscillator follows the record: its ordinate is the peak acceleration.
    spectrum = np.full(omega.shape, np.abs(a).max())
    steps = steps_per_interval(dt_s, np.where(rigid, 0.0, omega))
    for step_count in np.unique(steps[~rigid]).tolist():
        some = ~rigid & (steps == step_count)
        peak, peak_index = np.empty(some.sum()), np.empty(some.sum(), dtype=np.int64)
        # Linear between samples, as the record is: a finer record is the same motion.
        fine = read_only(refined(a, step_count))
        oscillator.peaks(fine, dt_s / step_count, omega[some], float(damping), peak, peak_index)
        spectrum[some] = np.abs(peak)
    return spectrum


def steps_per_interval(dt_s: float, omega: Floats) -> NDArray[np.int64]:
    """Return the points per interval at which the peaks of oscillators [rad/s] are evaluated."""
    # Powers of two, so that oscillators of many periods share one refined record.
    needed = PEAK_FINENESS * float(dt_s) * omega / (2.0 * math.pi)
    return (2.0 ** np.ceil(np.log2(np.clip(needed, 1.0, PEAK_STEPS)))).astype(np.int64)


def refined(a: Floats, steps: int) -> Floats:
    """Return a record with `steps` steps in each interval, by linear interpolation."""
    if steps == 1:
        return a
    places = np.arange((a.size - 1) * steps + 1)
    return np.interp(places, np.arange(a.size) * steps, a)


def _check_spectrum(a: Floats, dt_s: float, periods: Floats, damping: float) -> None:
    problems = []
    if a.ndim != 1 or len(a) < 1 or not np.isfinite(a).all():
        problems.append("acceleration: enter one column of finite numbers")
    if not (math.isfinite(dt_s) and dt_s > 0.0):
        problems.append(f"time step dt is {dt_s!r}; enter a number of seconds above 0")
    if periods.ndim != 1 or not (np.isfinite(periods).all() and (periods >= 0.0).all()):
        problems.append("periods: enter one column of numbers of seconds, 0 or above")
    if not 0.0 <= damping < 1.0:
        problems.append(f"damping is {damping!r}; enter a fraction from 0 to below 1")
    raise_any(problems)


# Spectral acceleration [g] at frequencies [Hz], 5 % damping.
Target = Callable[[Floats], Floats]

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
    # T_0 = 0.2 S_D1 / S_DS.
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
    horizontal components' spectra, 5% damping. This factor minimizes the sum of squared
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
    shortest_s, longest_s = periods_s
    if not 0.0 < shortest_s < longest_s < math.inf:
        raise InputError(
            f"period range is {shortest_s:g} s to {longest_s:g} s; enter two periods above 0, the "
            f"second longer"
        )
    # Equally spaced in logarithms, because the factor is a mean of logarithms.
    count = math.ceil(PER_DECADE * math.log10(longest_s / shortest_s)) + 1
    periods = np.geomspace(shortest_s, longest_s, max(count, 2))
    logs = []
    for record in horizontals:
        # It has no logarithm.
        if not record.a_mps2.any():
            raise InputError(f"{record.name}: is zero throughout; it cannot be scaled to a target")
        spectrum = response_spectrum(record.a_mps2, record.dt_s, periods, DAMPING)
        # The mean of the logarithms of both components is the logarithm of their geometric mean.
        logs.append(np.log(spectrum / UNITS["g"]))
    # Least squares of ln(factor spectrum / target): the factor is the mean of the logarithms.
    difference = np.log(target(1.0 / periods)) - np.mean(logs, axis=0)
    return float(np.exp(difference.mean()))


def _check_design(s_ds_g: float, s_d1_g: float, t_l_s: float) -> None:
    problems = [
        f"{name} is {value:g} {unit}; enter a number above 0"
        for name, value, unit in (("S_DS", s_ds_g, "g"), ("S_D1", s_d1_g, "g"), ("T_L", t_l_s, "s"))
        if not 0.0 < value < math.inf
    ]
    # ASCE 7, 11.4.6: the spectrum falls as 1/T from T_S to T_L, which is therefore the longer one.
    if not problems and t_l_s <= s_d1_g / s_ds_g:
        problems = [f"T_L is {t_l_s:g} s; enter more than T_S = {s_d1_g / s_ds_g:g} s"]
    raise_any(problems)
