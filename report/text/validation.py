"""Statement on validation, for every document with results."""

from __future__ import annotations

NOT_VALIDATED = (
    "The sliding solution has not been validated against shake-table tests of ballasted arrays."
)

VALIDATION = (
    f"{NOT_VALIDATED} The checks of the verification manual show that the equations are solved "
    "correctly. They do not show how well these equations represent the friction between a "
    "ballasted array and a roof membrane."
)
"""The same, with what remains unknown."""
