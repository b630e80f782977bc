"""Arrays and inputs with other friction than is entered."""

from __future__ import annotations

from report.project.model import ProjectInput
from report.project.model.array import Array

# Fraction by which the friction coefficients are decreased and increased; a verdict that less
# friction changes is a condition.
SHIFT = 0.05


def with_friction(data: ProjectInput, factor: float) -> ProjectInput:
    """Return the input with every friction coefficient of its arrays multiplied by a factor."""
    changed = [array_with_friction(array, factor) for array in data.arrays]
    return data.model_copy(update={"arrays": type(data.arrays)(changed)})


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
    return data.model_copy(update={"arrays": type(data.arrays)(arrays)})


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
