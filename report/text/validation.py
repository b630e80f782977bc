"""Whether the sliding solution is validated by shake-table tests, in the words of every output."""

from __future__ import annotations

from collections.abc import Sequence

from solver.verification.shake_table import ShakeTable

NOT_VALIDATED = (
    "The sliding solution has not been validated against shake-table tests of ballasted arrays."
)


def validation(tables: Sequence[ShakeTable]) -> str:
    """Return in a sentence whether tests of a shake table validate the sliding solution."""
    for table in tables:
        if table.validates:
            return (
                f"{len(table.runs)} tests of a shake table satisfy the acceptance of the "
                "verification manual. They validate the sliding solution for slopes, friction "
                "coefficients and motions like theirs, as far as the stated source is right."
            )
    return NOT_VALIDATED


def explained(tables: Sequence[ShakeTable]) -> str:
    """Return the same, with what remains unknown where nothing is validated."""
    if any(table.validates for table in tables):
        return validation(tables)
    return (
        f"{NOT_VALIDATED} The checks of the verification manual show that the equations are "
        "solved correctly. They do not show how well friction between a ballasted array and a "
        "roof membrane follows them."
    )
