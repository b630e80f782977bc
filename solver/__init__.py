"""The sliding block: exact response of ballasted arrays, and the code rules for their design.

The public names are those of `solver.public`. All quantities are SI. Imports nothing that lays out
pages or draws figures.
"""

import warnings
from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from solver.public import *  # noqa: F403

FORMER = {"Rung": "Model"}
"""Public names of 0.2, which this version still knows."""


def __getattr__(name: str) -> Any:
    """Return a public name. All are loaded with the first: with the kernels that takes 0.4 s."""
    if name in FORMER:
        text = f"solver.{name} is solver.{FORMER[name]} now, and the next version has that alone"
        warnings.warn(text, DeprecationWarning, stacklevel=2)
    # Not `from solver import public`, which would ask here whether there is such a name.
    return getattr(import_module("solver.public"), FORMER.get(name, name))


def __dir__() -> list[str]:
    """Return the public names, which `help` shows."""
    return list(import_module("solver.public").__all__)
