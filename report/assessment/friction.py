"""A project with its friction coefficients changed, for the sensitivity of the design."""

from __future__ import annotations

from report.sheet.schema import Array, ProjectInput

SHIFT = 0.05
"""Fraction by which the friction coefficients are decreased and increased."""


def with_friction(data: ProjectInput, factor: float) -> ProjectInput:
    """Return the input with every friction coefficient of its arrays multiplied by a factor."""
    changed = [array_with_friction(array, factor) for array in data.arrays]
    return data.model_copy(update={"arrays": type(data.arrays)(changed)})


def array_with_friction(array: Array, factor: float) -> Array:
    """Return an array with all of its friction coefficients multiplied by a factor."""
    names = ("mu", "mu_fast", "mu_static")
    given = {name: getattr(array, name) for name in names}
    return array.model_copy(
        update={name: mu * factor for name, mu in given.items() if mu is not None}
    )
