"""The friction of arrays in words, as it was run."""

from __future__ import annotations

import math
from collections.abc import Sequence

from report.project.model.array import Array
from report.text.counts import ids_by, ranged
from report.text.units import number
from solver.model import Friction


def coefficient(mu: float) -> str:
    """Return a friction coefficient with two decimals, or three where it has them."""
    return number(mu, 2 if math.isclose(mu, round(mu, 2), abs_tol=1e-9) else 3)


def mu_words(law: Friction) -> str:
    """Return friction as it was run, from low to high velocity: `0.40 to 0.50, by velocity`."""
    sliding = coefficient(law.mu_slow)
    if law.is_by_velocity:
        sliding += f" to {coefficient(law.mu_fast)}, by velocity"
    rest = "" if law.mu_static == law.mu_slow else f", {coefficient(law.mu_static)} at rest"
    return f"{sliding}{rest}"


def mus_words(arrays: Sequence[Array]) -> str:
    """Return the friction of arrays, those of one friction together: `A1, A2: 0.50; A3: 0.45`."""
    groups = ids_by(arrays, lambda array: mu_words(array.friction))
    return "; ".join(f"{ranged(ids)}: {words}" for words, ids in groups.items())
