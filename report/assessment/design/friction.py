"""The friction of arrays: as text, as run, and modified.

With a low-velocity coefficient of 0.20, a law from 0.40 to 0.60 is one from 0.20 to 0.30.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from report.project.model import ProjectInput
from report.project.model.array import Array
from report.text.grouping import ids_by
from report.text.names import ranged
from report.text.units import number
from solver.model import Friction


def coefficient(mu: float) -> str:
    """Return a friction coefficient with two decimals, or three if it has them."""
    return number(mu, 2 if math.isclose(mu, round(mu, 2), abs_tol=1e-9) else 3)


def mu_words(law: Friction) -> str:
    """Return friction as it was run, from low to high velocity."""
    sliding = coefficient(law.mu_slow)
    if law.is_by_velocity:
        sliding += f"–{coefficient(law.mu_fast)} (velocity-dependent)"
    static_text = "" if law.mu_static == law.mu_slow else f", {coefficient(law.mu_static)} at rest"
    return f"{sliding}{static_text}"


def mus_words(arrays: Sequence[Array]) -> str:
    """Return the friction of arrays, grouped by equal friction: `A1, A2: 0.50; A3: 0.45`."""
    groups = ids_by(arrays, lambda array: mu_words(array.friction))
    return "; ".join(f"{ranged(ids)}: {words}" for words, ids in groups.items())


# Fraction by which the friction coefficients are decreased and increased; a verdict that less
# friction changes is a condition.
SHIFT = 0.05


def with_friction(data: ProjectInput, factor: float) -> ProjectInput:
    """Return the input with every friction coefficient of its arrays multiplied by a factor."""
    arrays = tuple(array_with_friction(array, factor) for array in data.arrays)
    return data.model_copy(update={"arrays": arrays})


def array_with_friction(array: Array, factor: float) -> Array:
    """Return an array with all of its friction coefficients multiplied by a factor."""
    names = ("mu", "mu_fast", "mu_static")
    values = {name: getattr(array, name) for name in names}
    return array.model_copy(
        update={name: mu * factor for name, mu in values.items() if mu is not None}
    )


def with_low_velocity(data: ProjectInput) -> ProjectInput:
    """Return the input with the low-velocity coefficient of every array alone; itself if it is."""
    if not any(array.friction.is_by_velocity for array in data.arrays):
        return data
    arrays = [at_low_velocity(a) if a.friction.is_by_velocity else a for a in data.arrays]
    return data.model_copy(update={"arrays": tuple(arrays)})


def at_low_velocity(array: Array) -> Array:
    """Return an array with its low-velocity coefficient alone, at rest and at every velocity."""
    names = ("mu_fast", "mu_rate_s_per_m", "mu_static")
    return array.model_copy(update=dict.fromkeys(names))


def with_mu(array: Array, mu: float) -> Array:
    """Return an array with another low-velocity coefficient, its friction law scaled as a whole."""
    if array.mu > 0.0:
        return array_with_friction(array, mu / array.mu).model_copy(update={"mu": mu})
    # A law that starts from zero has no factor: the coefficient is then one at every velocity.
    return at_low_velocity(array).model_copy(update={"mu": mu})


def with_mus(data: ProjectInput, mus: Mapping[str, float]) -> ProjectInput:
    """Return the input with other low-velocity coefficients of some arrays, by id."""
    arrays = (with_mu(row, mus[row.id]) if row.id in mus else row for row in data.arrays)
    return data.changed(arrays=tuple(arrays))
