"""Result for a project if a condition is not met: each is removed from its input in turn.

`Without peer review: NG, clearance A1 to A2 (D/C 1.20); Δ up to 30.0 in (762 mm).`

Runs nothing: `report.assessment.assess` assesses the inputs from existing runs. Read
`prices`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import replace

from report.assessment.assessment import Assessment
from report.assessment.causes import came_to, governing_words
from report.assessment.checks.check import LOWERING, VELOCITY_ROW
from report.assessment.design.clearances import by_id
from report.assessment.design.friction import at_low_velocity, mus_words, with_low_velocity
from report.assessment.design.rule_set import as_adopted, under_code
from report.assessment.design.verdict import Verdict
from report.project.model import ProjectInput
from report.text.letter_case import capitalized
from report.text.names import ranged
from report.text.units import Quantity, nan_is_worst, no_less, pair

_REVIEW, _RULE_SET = "peer_review", "rule_set"
# Priced in a package where they are satisfied, too: a plan checker asks what rests on them.
_ALWAYS = {_REVIEW, _RULE_SET, VELOCITY_ROW}


def prices(
    done: Assessment,
    reassess: Callable[[Assessment, ProjectInput, Collection[str]], Assessment],
    *,
    of_all: bool = True,
) -> Mapping[str, str]:
    """Return the result for a project without the items required by checks, by their ids.

    Of checks that are open, where a displacement or a verdict is another one then; of a peer
    review and a letter of acceptance, and of friction by velocity, where these are notes, and of
    all also where they are on file. `reassess` is given another input, and the motions that it is
    without.
    """
    sentences = dict[str, str]()
    asked_for = {check.id for check in done.checks if check.is_open}
    unmet = {check.id for check in done.checks if not check.is_satisfied}
    asked_for |= _ALWAYS if of_all else _ALWAYS & unmet
    for ids, changed, motions, how in _others(done):
        if (motions or changed is not done.project) and not asked_for.isdisjoint(ids):
            sentences |= dict.fromkeys(ids, _price(done, reassess(done, changed, motions), how))
    return {id: text for id, text in sentences.items() if text}


def _others(
    done: Assessment,
) -> Iterator[tuple[Sequence[str], ProjectInput, Collection[str], str]]:
    """Yield ids of checks, the input and the motions without what they ask for, and words."""
    data = done.project
    code = under_code(data)
    same = "the same motions and S_DS" if done.has_motions else "the same S_DS"
    # Said, since two changes at once would pass for the price of one.
    if (code.overrides, code.options) != (data.overrides, data.options):
        same += ", without overrides and departures"
    how = f"under {code.site.rule_set} 13.6.12, with {same}"
    yield (_RULE_SET, "edition_name"), code, (), how
    yield LOWERING, as_adopted(data), (), "without overrides and departures"
    if data.is_peer_reviewed:
        options = data.options.model_copy(update={"peer_reviewed": False})
        changed = data.model_copy(update={"options": options})
        yield (_REVIEW,), changed, (), "without peer review"
    slow = [array for array in data.arrays if array.friction.is_by_velocity]
    if slow and done.has_motions:
        mus = mus_words([at_low_velocity(array) for array in slow])
        how = f"with the low-velocity friction coefficient at all velocities ({mus})"
        yield (VELOCITY_ROW,), with_low_velocity(data), (), how
    drifting = {c.subject for c in done.checks if c.id == "drift" and c.is_open}
    if drifting:
        yield ("drift",), data, drifting, f"without {ranged(sorted(drifting))}"


def _price(done: Assessment, changed: Assessment, how: str) -> str:
    """Return the result of an input as a sentence; none if it changes nothing."""
    # What a row of linked blocks does is not run again.
    linked = [replace(row, design=by_id(changed.arrays, row.design.id)) for row in done.linked]
    changed = replace(changed, linked=tuple(linked))

    def came(assessed: Assessment) -> Sequence[object]:
        return [
            (item.permitted_m, assessed.array_verdict(item) is Verdict.NG)
            for item in assessed.arrays
        ]

    # By text: the NaN of an array without a permitted displacement does not equal itself.
    if repr(came(done)) == repr(came(changed)):
        return ""
    us_first = done.project.us_first
    largest_m = max((item.permitted_m for item in changed.arrays), key=nan_is_worst)
    delta = f"; Δ up to {pair(largest_m, Quantity.DISPLACEMENT, us_first, no_less)}"
    text = came_to(changed)
    # Which conditions are left, such as on less friction, is not looked at again.
    if changed.verdict.is_permitted:
        text = ", ".join(filter(None, ("not NG", governing_words(changed))))
    return f"{capitalized(how)}: {text}{'' if math.isnan(largest_m) else delta}."
