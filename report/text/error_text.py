"""Errors, shares and times of a verification for print.

    scientific(3.2e-15)    3.2 × 10⁻¹⁵

An em dash is NaN.
"""

from __future__ import annotations

import math

from report.text.units import NO_BREAK, number

_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def power_of_ten(exponent: int) -> str:
    """Return `10⁻¹⁵` for -15."""
    return f"10{str(exponent).translate(_RAISED)}"


def power_above(value: float) -> str:
    """Return a power of ten above a value."""
    # The digits of a rounding error depend on the machine, and golden texts on none.
    return power_of_ten(math.floor(math.log10(value)) + 1)


def below_mm(error_m: float) -> str:
    """Return the power of ten above an error, in mm."""
    return f"{power_above(1e3 * error_m)}{NO_BREAK}mm" if error_m else "rounding error"


def scientific(value: float) -> str:
    """Return `3.2 × 10⁻¹⁵`; plain 0."""
    if value != value:
        return "—"
    if value == 0.0 or math.isinf(value):
        return "0" if value == 0.0 else "∞"
    digits, exponent = f"{value:.1e}".split("e")
    return f"{digits} × {power_of_ten(int(exponent))}".replace("-", "−")


def percent(value: float) -> str:
    """Return a percentage with three digits, or as a power of ten if small."""
    if value != value:
        return "—"
    if value == 0.0:
        return "0%"
    if abs(value) < 1e-3:
        return f"{scientific(value)}%"
    decimals = max(0, 2 - math.floor(math.log10(abs(value))))
    return f"{number(value, min(decimals, 4))}%"


def seconds(value: float) -> str:
    """Return a duration with a suitable unit."""
    if value != value:
        return "—"
    for size, unit in ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs")):
        if value >= size:
            return f"{value / size:.3g}{NO_BREAK}{unit}"
    return f"{value / 1e-9:.3g}{NO_BREAK}ns"


def ten_digits(value: float) -> str:
    """Return a value with ten digits; `none` for NaN."""
    if value != value:
        return "none"
    if 0.0 < abs(value) < 1e-4:
        return scientific(value)
    return f"{value:.10g}".replace("-", "−")


def general(value: float) -> str:
    """Return a number with no more than six digits, as it would be typed."""
    return f"{value:g}"
