"""The field notes in the legend of the roof plan.

Read `report.drawing.on_paper` first.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from report.assessment.envelopes import (
    KEEP_CLEAR_UNKNOWN,
    keep_clear_m,
    keep_clear_mark,
    keep_clear_words,
)
from report.assessment.friction import mus_words
from report.assessment.overrides import MEANING
from report.assessment.verdict import Verdict
from report.drawing.sheet import PlanSheet

MOST_NAMES = 6


def notes_of(plan: PlanSheet) -> Iterator[str]:
    """Yield the finished sentences of the legend."""
    yield "Δ: design displacement. It may occur in any direction."
    yield f"μ as run: {mus_words(plan.assessment.project.arrays)}."
    distances: dict[str, list[str]] = {}
    for array in plan.assessment.arrays:
        words = keep_clear_words(keep_clear_m(plan.assessment, array), plan.fmt.us_first)
        words += keep_clear_mark(plan.assessment, array)
        distances.setdefault(words, []).append(array.id)
    if len(distances) > 3:
        yield "Keep clear: no conduit or equipment within the distance stated, on all sides."
    for words, ids in distances.items() if len(distances) <= 3 else ():
        of = ", ".join(ids) if len(distances) > 1 else "all arrays"
        if words == KEEP_CLEAR_UNKNOWN:
            yield f"{words.capitalize()} for {of}."
        else:
            yield f"{words.capitalize()} of {of}, on all sides: no conduit or equipment."
    if _is_marked(plan):
        yield f"{MEANING}; see the summary."
    unknown = [str(gap.of.number) for gap in plan.gaps if gap.of.verdict is Verdict.NONE]
    if unknown:
        yield (
            f"No verdict, because no route to a design displacement is permitted: clearance "
            f"{_some(unknown)}."
        )
    missing = [pair for pair in plan.assessment.neighbors if pair.is_missing]
    if missing:
        names = _some([f"{pair.array} to {pair.other}" for pair in missing])
        yield f"No clearance is given: {names}."
    numbers = {gap.of.number for gap in plan.gaps}
    rows = enumerate(plan.assessment.clearances, start=1)
    unplaced = [str(count) for count, _ in rows if count not in numbers]
    if unplaced:
        yield f"Not drawn, because a rectangle is not given: clearance {_some(unplaced)}."
    if plan.unnamed:
        yield f"Not labeled, for lack of space: {_some(plan.unnamed)}."


def _is_marked(plan: PlanSheet) -> bool:
    """Whether any number on the plan is overridden."""
    assessment = plan.assessment
    return assessment.is_overridden or any(
        keep_clear_mark(assessment, array) for array in assessment.arrays
    )


def _some(names: Sequence[str]) -> str:
    """Return a list of names, cut where it gets long: the legend has a fixed size."""
    more = len(names) - MOST_NAMES
    return ", ".join(names[:MOST_NAMES]) + (f" and {more} more" if more > 0 else "")
