"""Required response spectra of AC156, 5% damping, horizontal and vertical.

    S_a         ________            A_FLX: 1.92 g for S_DS = 1.2 g at the roof (ASCE 7-16)
               /        `-._____    A_RIG: 1.44 g
              /
    f [Hz]  0.1 1.3     8.3  33.3   straight lines on log-log axes, flat beyond

Independent of motions. Read `ac156_horizontal`.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from solver.model import Floats
from solver.rules.hazard import Edition
from solver.spaces import NO_BREAK

# Corner points of a target spectrum: increasing frequencies [Hz], and accelerations [g].
Target = tuple[Floats, Floats]


def target_sa_g(target: Target, freq_hz: Floats) -> Floats:
    """Target acceleration [g] at frequencies [Hz]: log-log between corners, constant beyond."""
    corners_hz, corners_g = (np.log(np.asarray(column)) for column in target)
    # `interp` is constant beyond its ends, as the spectrum is below 0.1 Hz and above 33.3 Hz.
    return np.asarray(np.exp(np.interp(np.log(freq_hz), corners_hz, corners_g)), dtype=np.float64)


@dataclass(frozen=True, slots=True, kw_only=True)
class RequiredSpectrum:
    """AC156 required response spectrum: corner points, joined by straight lines on log-log axes.

    Attributes
    ----------
    freq_hz, sa_g : array, shape (4,)
    """

    freq_hz: Floats
    sa_g: Floats

    @property
    def corners(self) -> Target:
        """Frequencies [Hz] and accelerations [g], as `solver.make_suite` takes them."""
        return self.freq_hz, self.sa_g

    def at(self, freq_hz: Floats) -> Floats:
        """Return ordinates [g] at frequencies [Hz], constant outside the corners."""
        return target_sa_g(self.corners, freq_hz)


class Tail(StrEnum):
    """Shape of an AC156 spectrum below 1.3 Hz, the range that causes long slips."""

    AC156 = "AC156"
    RECIPROCAL = "1/T"

    @property
    def sentence(self) -> str:
        """The rule for the reader."""
        return _TAIL_SENTENCES[self]


_FLEXIBLE_FROM_HZ = 1.3

_TAIL_SENTENCES = {
    Tail.AC156: f"the AC156 line below 1.3{NO_BREAK}Hz (beyond 0.77{NO_BREAK}s), to 0.1 A_FLX at "
    f"0.1{NO_BREAK}Hz (10{NO_BREAK}s)",
    Tail.RECIPROCAL: f"1/T beyond 0.77{NO_BREAK}s (below 1.3{NO_BREAK}Hz), to 0.077 A_FLX at "
    f"10{NO_BREAK}s (0.1{NO_BREAK}Hz)",
}

# Log-log from 1.3 Hz, where it is 1: AC156 has 0.1 at 0.1 Hz, and 1/T has 0.1 Hz / 1.3 Hz.
_TAIL_AT_10_S = {Tail.AC156: 0.1, Tail.RECIPROCAL: 0.1 / _FLEXIBLE_FROM_HZ}


def ac156_horizontal(
    edition: Edition, *, s_ds_g: float, z_over_h: float, tail: Tail = Tail.AC156
) -> RequiredSpectrum:
    """Return the horizontal AC156 spectrum, 5% damping.

    A_FLX = S_DS (1 + 2 z/h) <= 1.6 S_DS, A_RIG = 0.4 S_DS (1 + 2 z/h); with ASCE 7-22
    A_FLX = S_DS H_f/R_mu <= 1.6 S_DS, A_RIG = 0.4 S_DS H_f/R_mu, H_f = 1 + 2.5 z/h, R_mu = 1.3
    above grade and 1 at grade.
    PV1-2012 permits 1/T beyond 0.77 s in place of the AC156 line.

    Parameters
    ----------
    edition
        A value of `solver.EDITIONS`, such as ``EDITIONS["ASCE 7-16"]``.
    s_ds_g : float
        Design spectral acceleration at short periods [g].
    z_over_h : float
        Height of the array / height of the roof, from 0 to 1.
    tail : str
        Below 1.3 Hz: ``"AC156"`` or ``"1/T"``.

    Returns
    -------
    RequiredSpectrum
        Four corner points, [Hz] and [g].

    Raises
    ------
    KeyError
        For a tail that is not one of these.

    Examples
    --------
    >>> from solver import EDITIONS
    >>> ac156_horizontal(EDITIONS["ASCE 7-16"], s_ds_g=1.2, z_over_h=1.0).sa_g.round(3)
    array([0.192, 1.92 , 1.92 , 1.44 ])
    """
    # The cap of 1.6 S_DS is on A_FLX alone: at the roof A_RIG keeps the whole ratio.
    ratio = edition.amplification.at(z_over_h)
    # 0.4 S_DS is the ordinate of the design spectrum at zero period.
    return _corners(min(ratio, 1.6) * s_ds_g, 0.4 * ratio * s_ds_g, tail)


def ac156_vertical(*, s_ds_g: float, tail: Tail = Tail.AC156) -> RequiredSpectrum:
    """Return the vertical AC156 spectrum, 5% damping: 0.67 S_DS and 0.27 S_DS.

    Parameters
    ----------
    s_ds_g : float
        Design spectral acceleration at short periods [g].
    tail : str
        Below 1.3 Hz: ``"AC156"`` or ``"1/T"``.

    Returns
    -------
    RequiredSpectrum
        Four corner points, [Hz] and [g].

    Raises
    ------
    KeyError
        For a tail that is not one of these.

    Examples
    --------
    >>> ac156_vertical(s_ds_g=1.2).sa_g.round(3)
    array([0.08 , 0.804, 0.804, 0.324])
    """
    return _corners(0.67 * s_ds_g, 0.27 * s_ds_g, tail)


def _corners(flexible_g: float, rigid_g: float, tail: Tail) -> RequiredSpectrum:
    return RequiredSpectrum(
        freq_hz=np.array([0.1, _FLEXIBLE_FROM_HZ, 8.3, 33.3]),
        sa_g=np.array([_TAIL_AT_10_S[tail] * flexible_g, flexible_g, flexible_g, rigid_g]),
    )
