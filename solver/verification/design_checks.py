"""Checks of design inputs other than the displacement: code rules, spectra, uplift, tipping.

By PV1-2012 with S_DS = 1.0 g the displacement is 60 in x 0.6^2 = 21.6 in, and the separation from
an edge without a parapet, with I_e = 1.25, 40.5 in.

Returns the same rows as `checks`; expected values are from a published permit calculation, or
computed here by hand.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial

import numpy as np

from solver.model import STANDARD_GRAVITY_MPS2
from solver.records.processing import Processing, process
from solver.records.record import Record
from solver.records.spectrum import response_spectrum
from solver.rules.provisions import (
    Neighbor,
    analysis_value,
    interconnection_strength_n,
    prescriptive_displacement,
    required_separation,
)
from solver.rules.rulesets import RULE_SETS
from solver.sliding.checked import scene
from solver.sliding.uplift import Supports, tipping, uplift
from solver.spaces import NO_BREAK, equation
from solver.verification.evidence import Verified

_INCH, _FOOT = 0.0254, 0.3048
_PUBLISHED = "Published permit calculation, S_DS = 1.0 g, I_e = 1.25, SEAOC PV1-2012"
_SHEET = "Permit sheet, S_S = 1.313 g, F_a = 1.2, I_e = 1.0, ASCE 7-16; printed to 0.01 ft"
# Half the last digit of 110.0 lb as the calculation prints it, relative.
_PRINTED = 4.5e-4

_FILTER_HZ, _FILTER_ORDER = 1.0, 4


def design_checks() -> Iterator[Verified]:
    """Run the checks."""
    yield from _prescriptive()
    yield from _published()
    yield from _permit_sheet()
    yield from _statistics()
    yield _uplift()
    yield from _tipping()
    yield from _spectrum()
    yield from _filters()


def _prescriptive() -> Iterator[Verified]:
    source = "60 in (S_DS − 0.4)² ≥ 6 in; 5 I_e (S_DS − 0.4)² ft ≥ 24 in"
    row = partial(Verified, "DV-1", source, "Prescriptive displacement", "in")
    for code, s_ds_g, importance, inches in (
        ("SEAOC PV1-2012", 1.0, 1.25, 60.0 * 0.6**2),
        ("SEAOC PV1-2012", 0.6, 1.0, 6.0),
        ("ASCE 7-16", 1.5, 1.25, 12.0 * 5.0 * 1.25 * 1.1**2),
        ("ASCE 7-22", 1.0, 1.0, 24.0),
    ):
        found_m = _displacement_m(code, s_ds_g, importance)
        name = f"{code}, SDC D, {equation('S_DS', s_ds_g, 'g')}, {equation('I_e', importance)}"
        yield row(name, inches, found_m / _INCH)


def _displacement_m(code: str, s_ds_g: float, importance: float) -> float:
    rules = RULE_SETS[code]
    return prescriptive_displacement(rules, s_ds_g=s_ds_g, sdc="D", importance=importance).value_m


def _published() -> Iterator[Verified]:
    rules, row = RULE_SETS["SEAOC PV1-2012"], partial(Verified, "DV-2", _PUBLISHED)
    delta_m = _displacement_m("SEAOC PV1-2012", 1.0, 1.25)
    for kind, importance, inches in (
        (Neighbor.LIKE, 1.0, 10.8),
        (Neighbor.FIXED, 1.0, 21.6),
        (Neighbor.PARAPET, 1.25, 27.0),
        (Neighbor.EDGE, 1.25, 40.5),
    ):
        found_m = required_separation(rules, kind, design_m=delta_m, importance=importance)
        name = f"Separation from a neighbor: {kind}"
        yield row("Separation", "in", name, inches, found_m / _INCH, _PRINTED)
    for weight_lb, strength_lb in ((2691.7, 358.0), (827.1, 110.0)):
        found_lb = interconnection_strength_n(rules, s_ds_g=1.0, w1_n=weight_lb)
        name = f"Interconnection, {weight_lb:g} lb on the lighter side"
        yield row("Strength", "lb", name, strength_lb, found_lb, _PRINTED)


def _permit_sheet() -> Iterator[Verified]:
    rules, by_hand = RULE_SETS["ASCE 7-16"], "By hand: larger of 0.133 S_DS W1 and 0.1 W1"
    delta_m = _displacement_m("ASCE 7-16", 2.0 / 3.0 * 1.2 * 1.313, 1.0)
    for kind, feet in (
        (Neighbor.LIKE, 1.06),
        (Neighbor.FIXED, 2.12),
        (Neighbor.PARAPET, 2.12),
        (Neighbor.EDGE, 4.23),
    ):
        found_m = required_separation(rules, kind, design_m=delta_m, importance=1.0)
        name, found_ft = f"Separation from a neighbor, ASCE 7-16: {kind}", found_m / _FOOT
        # Half of the last digit printed on the sheet.
        yield Verified("DV-8", _SHEET, "Separation", "ft", name, feet, found_ft, 0.005 / feet)
    for s_ds_g, factor in ((1.5, 0.133 * 1.5), (0.5, 0.1)):
        found_lb = interconnection_strength_n(rules, s_ds_g=s_ds_g, w1_n=1000.0)
        name = f"Interconnection, 1000 lb on the lighter side, {equation('S_DS', s_ds_g, 'g')}"
        yield Verified("DV-8", by_hand, "Strength", "lb", name, 1000.0 * factor, found_lb)


def _statistics() -> Iterator[Verified]:
    for peaks_m, words, expected_m in (
        ((1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0), "7 motions: 1.1 x mean", 1.1 * 4.0),
        ((1.0, 2.0, 3.0), "3 motions: 1.1 x largest", 1.1 * 3.0),
    ):
        found_m = analysis_value(RULE_SETS["ASCE 7-16"], peaks_m).value_m
        name = f"Peaks of 1 m to {len(peaks_m)} m, {words}"
        yield Verified("DV-3", "By hand", "Analysis displacement", "m", name, expected_m, found_m)


def _uplift() -> Verified:
    az = np.array([0.0, -2.0, 0.0]) * STANDARD_GRAVITY_MPS2
    rising = scene(np.zeros(3), 1.0, slope_rad=math.radians(5.0), mu=0.4, az_mps2=az)
    name = f"Vertical acceleration falls to −2{NO_BREAK}g within 1 s, slope 5 deg"
    source = "N = (g + a_v) cos(θ): zero after 0.5 s"
    return Verified("DV-4", source, "Time of uplift", "s", name, 0.5, uplift(rising).t_first_s)


def _tipping() -> Iterator[Verified]:
    row = partial(
        Verified, "DV-5", "min(a_h / g, μ) / (b / (2 h))", "Ratio of shear to tipping shear"
    )
    # Tall and rough enough to tip before it slides; then the same with less friction.
    supports = Supports(height_m=1.0, spacing_m=1.5)
    ax = 0.5 * STANDARD_GRAVITY_MPS2 * np.array([0.0, 1.0, 0.0])
    size = f"{equation('h', 1, 'm')}, {equation('b', 1.5, 'm')}"
    for mu, shear in ((2.0, 0.5), (0.3, 0.3)):
        ratio = tipping(scene(ax, 0.5, slope_rad=0.0, mu=mu), supports).ratio
        name = f"Pulse of 0.5{NO_BREAK}g, flat roof, {equation('μ', mu)}, {size}"
        yield row("1", name, shear / 0.75, ratio)


def _spectrum() -> Iterator[Verified]:
    zeta, dt = 0.05, 0.001
    source = "1 + exp(−ζ π / √(1 − ζ²)); sampled at 0.001 s"
    expected = 1.0 + math.exp(-zeta * math.pi / math.sqrt(1.0 - zeta**2))
    for period_s in (0.1, 1.0):
        # The peak is at half a period; three periods are sufficient.
        spectrum = response_spectrum(np.ones(round(3.0 * period_s / dt)), dt, [period_s])
        name = f"Unit step, {equation('T', period_s, 's')}, {equation('ζ', zeta)}"
        yield Verified("DV-6", source, "S_a / a", "1", name, expected, float(spectrum[0]), 1e-5)


def _filters() -> Iterator[Verified]:
    source = "1 / √(1 + (f / fc)^(2 n)), or with fc / f; middle of a sine of 200 s"
    dt, t = 0.005, np.arange(40001) * 0.005
    for kind, settings, sign in (
        ("High-pass", Processing(highpass_hz=_FILTER_HZ, order=_FILTER_ORDER), -1.0),
        ("Low-pass", Processing(lowpass_hz=_FILTER_HZ, order=_FILTER_ORDER), 1.0),
    ):
        for ratio in (0.5, 1.0, 2.0):
            wave = np.sin(2.0 * math.pi * ratio * _FILTER_HZ * t)
            made = process(Record(name="wave", a_mps2=wave, dt_s=dt), settings).a_mps2
            # In the middle, where the ends of the filter have died away.
            amplitude = float(np.abs(made[made.size // 2 - 4000 : made.size // 2 + 4000]).max())
            expected = 1.0 / math.sqrt(1.0 + ratio ** (sign * 2 * _FILTER_ORDER))
            name = f"{kind} of order {_FILTER_ORDER}, sine at {ratio:g} times the corner"
            yield Verified("DV-7", source, "Amplitude", "1", name, expected, amplitude, 1e-9)
