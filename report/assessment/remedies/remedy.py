"""Changes that would satisfy each NG check, and the smallest sufficient set.

If one clearance lacks 0.2 m and A2 lacks slack: 0.2 m more, or μ = 0.55, for the first, and slack
for the second, each with the resulting project verdict; both together are the set.

Each change is entered and assessed (`report.assessment.assess`) before it is listed; friction is
searched with the runs of `report.assessment.remedies.friction_search`. Read `remedies`.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property, partial, reduce
from itertools import chain

from report.assessment.assess import entered, refused
from report.assessment.assessment import Assessment
from report.assessment.causes import came_to
from report.assessment.checks.check import PLAN_ROW, STRENGTH_ROW, Check, by_ratio
from report.assessment.design.clearances import ClearanceCheck, by_id
from report.assessment.design.friction import mu_words, with_mu, with_mus
from report.assessment.design.routes import Route
from report.assessment.design.separation import ComparedGap
from report.assessment.design.verdict import Verdict
from report.assessment.remedies.friction_search import (
    Trials,
    above,
    check_alone,
    is_final,
    search,
    trials_of,
)
from report.assessment.remedies.moves import Change, moves
from report.project.model import ProjectInput
from report.project.model.roof import Clearance
from report.text.amounts import Amount, amount_texts, capacity, demand
from report.text.amounts import entered as entered_amount
from report.text.grouping import grouped_by
from report.text.letter_case import capitalized, lowered
from report.text.names import joined, name_order, ranged
from report.text.units import Quantity, no_less, pair
from solver.friction_tests import MOST_MU

# More than rounding error, and nothing that is printed.
_NOISE = 1e-9
_MOST_HUNDREDTHS = round(100.0 * MOST_MU)

# Checks whose remedies are searched, those with the largest ratio first; and changes of a set.
MOST = 12

# What no change of arrays and clearances satisfies.
_OF_THE_BUILDING = ("max_risk_category", "max_stories", "ibc_max_slope_deg")


class RemedyKind(StrEnum):
    """Quantity that would have to change."""

    SEPARATION = "provided separation"
    REVIEW = "design displacement by peer review"
    FRICTION = "friction coefficient"
    HEIGHT = "center of gravity"
    CAPACITY = "roof capacity"
    SLACK = "electrical slack"
    STRENGTH = "interconnection strength"


@dataclass(frozen=True, slots=True, kw_only=True)
class Remedy:
    """A change that satisfies NG checks and makes no other check NG."""

    kind: RemedyKind
    checks: tuple[Check, ...]
    words: str  # the change, without what comes of it
    change: Change
    done: Assessment | None = None  # the project with this change alone

    @property
    def is_enough(self) -> bool:
        """Whether the project is not NG with it alone."""
        return self.done is not None and self.done.verdict.is_permitted

    @property
    def sentence(self) -> str:
        """The change, and the project verdict if it is sufficient."""
        came = f" {_came(self.done)}" if self.done and self.is_enough else ""
        return f"{self.words}.{came}"


@dataclass(frozen=True, slots=True, kw_only=True)
class Remedies:
    """Changes that would satisfy an NG project; empty if it is not NG."""

    own: tuple[Remedy, ...] = ()  # of each check, each by itself
    # the changes that are enough together, none of which may be left out; empty if none are
    together: tuple[Remedy, ...] = ()
    done: Assessment | None = None  # the project with those

    @property
    def sentence(self) -> str:
        """The changes that are sufficient together, and the result; empty if none."""
        if self.done is None:
            return ""
        changes = joined([lowered(remedy.words) for remedy in self.together])
        return f"{capitalized(changes)}. {_came(self.done)}"


def _came(done: Assessment) -> str:
    return f"Project verdict: {came_to(done)}."


def remedies(assessment: Assessment, *, may_run: bool = True) -> Remedies:
    """Return the remedies of each NG check, and the smallest sufficient set.

    Friction requires runs; without them it is not a remedy.
    """
    if assessment.verdict.is_permitted:
        return Remedies()
    state = _State(assessment, may_run)
    own = tuple(state.own())
    return replace(_enough(state, own), own=own)


def _enough(state: _State, remedies: Iterable[Remedy]) -> Remedies:
    """Return a change that is sufficient alone, or else those found in turn."""
    if any(check.id in _OF_THE_BUILDING for check in state.failed):
        return Remedies()
    alone = next((remedy for remedy in remedies if remedy.is_enough), None)
    if alone:
        return Remedies(together=(alone,), done=alone.done)
    # One check after the other, not every combination: 12 checks with three ways each would be
    # half a million assessments. What the end does not need is dropped below.
    state_now, taken = state, list[Remedy]()
    while state_now.failed:
        ways = (list(state_now.ways(check)) for check in state_now.failed)
        trials = next(filter(None, ways), None)
        if trials is None or len(taken) == MOST:
            return Remedies()
        # Of those that satisfy the check, the one with which the least is NG.
        remedy, state_now = min(trials, key=lambda way: len(way[1].failed))
        taken.append(remedy)
    done = state_now.done
    # A later change may do what an earlier one was taken for.
    for tested in tuple(taken):
        fewer = [item for item in taken if item is not tested]
        data = reduce(lambda data, item: item.change(data), fewer, state.done.project)
        without = entered(state.done, data)
        if without is not None and without.verdict.is_permitted:
            taken, done = fewer, without
    return Remedies(together=tuple(taken), done=done)


class _State:
    """A project, as entered or with changes, and the remedies of its NG checks."""

    def __init__(self, done: Assessment, may_run: bool) -> None:
        self.done = done
        self._may_run = may_run
        self.failed = by_ratio(check for check in done.checks if check.verdict is Verdict.NG)

    def own(self) -> Iterator[Remedy]:
        """Yield the remedies of each check, one that satisfies several once."""
        named = set[tuple[RemedyKind, Check]]()
        for check in self.failed[:MOST]:
            kinds = {kind for kind, cured in named if cured is check}
            for remedy, after in self.ways(check, kinds):
                named |= {(remedy.kind, item) for item in remedy.checks}
                yield replace(remedy, done=after.done)

    def ways(
        self, check: Check, known: Iterable[RemedyKind] = ()
    ) -> Iterator[tuple[Remedy, _State]]:
        """Yield a change of each kind that satisfies a check and makes nothing NG that was OK."""
        ok = {_key(item) for item in self.done.checks if item.is_satisfied}
        done_kinds = {*known}
        for remedy in chain.from_iterable(way(self, check) for way in _WAYS.get(check.id, ())):
            if remedy.kind in done_kinds:
                continue
            is_review = remedy.change is _reviewed  # the same of every check
            done = self.reviewed if is_review else entered(self.done, remedy.change(self.data))
            after = done and _State(done, self._may_run)
            must_be_ok = ok | {*map(_key, remedy.checks)}
            if after and must_be_ok.isdisjoint(map(_key, after.failed)):
                done_kinds.add(remedy.kind)
                yield remedy, after

    @property
    def data(self) -> ProjectInput:
        """The input."""
        return self.done.project

    @cached_property
    def trials(self) -> Mapping[str, Trials]:
        """The arrays with other friction; none if none may be run."""
        return trials_of(self.done) if self._may_run else {}

    @cached_property
    def reviewed(self) -> Assessment | None:
        """The project with a review of the analysis."""
        return entered(self.done, _reviewed(self.data))


def _key(check: Check) -> Hashable:
    return check.id, check.title, check.subject, check.places


def _separations(state: _State, check: Check) -> Iterator[Remedy]:
    """Yield changes that widen a clearance, a pair on the plan without one, or a fire pathway."""
    gap = _gap(state.done, check)
    if gap and isinstance(check.found, Amount) and isinstance(check.limit, Amount):
        for words, change in moves(state.done, gap, check.limit.value - check.found.value):
            kind = RemedyKind.SEPARATION
            yield Remedy(kind=kind, checks=(check,), words=words, change=change)


def _gap(done: Assessment, check: Check) -> ComparedGap | None:
    """Return the gap of a check."""
    rows = [place.row for place in check.places if place.section == "clearances"]
    if rows:
        return done.clearances[rows[0]]
    return next((gap for gap in done.missing_gaps if gap.names == check.subject), None)


def _reviewed(data: ProjectInput) -> ProjectInput:
    review = {
        "peer_reviewed": True,
        "peer_date": data.project.date,
        # Nothing on record: the review is of the inputs as changed, whatever an earlier one
        # covered.
        "peer_covered": "",
        **dict.fromkeys(("peer_reviewer", "peer_license", "peer_letter"), "to be entered"),
    }
    return data.changed(options=data.options.model_copy(update=review))


def _review(state: _State, check: Check) -> Iterator[Remedy]:
    """Yield peer review, if it satisfies a check because its arrays then slide less."""
    done = state.reviewed
    if done is None:
        return
    still_ng = {_key(item) for item in done.checks if item.verdict is Verdict.NG}
    cured = tuple(item for item in state.failed if item.arrays and _key(item) not in still_ng)
    show = partial(pair, quantity=Quantity.DISPLACEMENT, us_first=state.data.us_first, show=no_less)
    designs = dict[str, str]()
    names = set(chain.from_iterable(cured_check.arrays for cured_check in cured))
    for name in sorted(names, key=name_order):
        given_m, value_m = (by_id(item.arrays, name).permitted_m for item in (state.done, done))
        if math.isnan(given_m) or value_m < given_m:
            instead = "" if math.isnan(given_m) else f" instead of {show(given_m)}"
            designs[name] = f"{show(value_m)}{instead}"
    if check in cured and not designs.keys().isdisjoint(check.arrays):
        alike = grouped_by(designs, designs.__getitem__)
        parts = [f"{ranged(names)} {words}" for words, names in alike.items()]
        words = f"Obtain a peer review of the analysis: design displacement of {joined(parts)}"
        yield Remedy(kind=RemedyKind.REVIEW, checks=cured, words=words, change=_reviewed)


def _frictions(state: _State, check: Check) -> Iterator[Remedy]:
    """Yield the friction that all arrays of a check need, if any coefficient is enough."""
    gap, mus = _gap(state.done, check), dict[str, float]()
    row = gap.clearance if isinstance(gap, ClearanceCheck) else None
    for item in (by_id(state.done.arrays, name) for name in check.arrays):
        slides = item.displacement
        if row and is_final(item) and check_alone(state.done, item.id, slides, row).ok:
            continue
        if item.id not in state.trials:
            return
        mus[item.id] = _least_mu(state.trials[item.id], row)
    if mus and not any(map(math.isnan, mus.values())):
        yield _friction(state, check, mus)


def _prescriptive_mu(state: _State, check: Check) -> Iterator[Remedy]:
    """Yield the friction coefficient that the prescriptive route requires."""
    array = by_id(state.done.arrays, check.arrays[0]).array
    if isinstance(check.limit, Amount) and array.minimum_mu > 0.0:
        mu = array.mu * check.limit.value / array.minimum_mu
        # Up to a hundredth, as it is printed and entered: rounded down, it would still be short.
        yield _friction(state, check, {array.id: math.ceil(100.0 * mu - 1e-6) / 100.0})


def _friction(state: _State, check: Check, mus: Mapping[str, float]) -> Remedy:
    arrays = {array.id: array for array in state.data.arrays}
    parts = [
        f"{mu_words(with_mu(arrays[name], mu).friction)} for {name}"
        f" (entered: {mu_words(arrays[name].friction)})"
        for name, mu in mus.items()
    ]
    words = f"Provide a friction coefficient of at least {joined(parts)}"
    change = partial(with_mus, mus=mus)
    return Remedy(kind=RemedyKind.FRICTION, checks=(check,), words=words, change=change)


def _least_mu(trials: Trials, row: Clearance | None) -> float:
    """Return the lowest friction coefficient that satisfies the check of an array; NaN if none."""
    end, limit = above(trials.array.array.mu), _most_mu(trials)
    if end > limit or not _may_help(trials, row):
        return math.nan
    satisfied = search(lambda mu: trials.satisfies(row, mu=mu), limit, end)
    return satisfied[-1] / 100 if satisfied else math.nan


def _most_mu(trials: Trials) -> int:
    """Return the largest coefficient that `check` accepts, in hundredths; tests may limit it."""
    data, array = trials.assessment.project, trials.array.array
    mus = range(above(array.mu), _MOST_HUNDREDTHS + 1)

    def is_refused(mu: int) -> bool:
        return bool(refused(data, with_mus(data, {array.id: mu / 100})))

    # Where one is refused a larger one is, too: it is above the tests as well.
    return mus.start - 1 + bisect_left(mus, True, key=is_refused)


def _may_help(trials: Trials, row: Clearance | None) -> bool:
    """Whether an array that does not slide would satisfy the check; needs no run."""
    assessment, array = trials.assessment, trials.array
    if array.lacks_motions:
        return False
    is_prescriptive = array.route is Route.PRESCRIPTIVE
    least_m = array.prescriptive.value_m if is_prescriptive else array.floor_m
    at_rest = replace(array.displacement, design_m=least_m)
    return row is None or check_alone(assessment, array.id, at_rest, row).ok


# The value of an array that a check compares, by the id of the check.
_VALUES = {
    "low_profile_in": (RemedyKind.HEIGHT, "cg_height_m"),
    "tipping": (RemedyKind.HEIGHT, "cg_height_m"),
    "roof_capacity": (RemedyKind.CAPACITY, "roof_capacity_pa"),
    "electrical_slack": (RemedyKind.SLACK, "slack_m"),
    STRENGTH_ROW: (RemedyKind.STRENGTH, "interconnection_n"),
}


def _needed(check: Check, entered: float) -> Amount:
    """Return the value with which a check is satisfied."""
    if check.id == "roof_capacity" and isinstance(check.found, Amount):
        return demand(check.found.value, Quantity.PRESSURE)
    if check.id == "tipping" and isinstance(check.found, Amount):
        # Divided by a ratio and multiplied again it is no more than its limit.
        return capacity(entered / check.found.value * (1.0 - _NOISE), Quantity.SIZE)
    return replace(check.limit, mark="") if isinstance(check.limit, Amount) else demand(math.nan)


def _values(state: _State, check: Check) -> Iterator[Remedy]:
    """Yield the values that satisfy a check of one array and similar checks of others."""
    kind, field = _VALUES[check.id]
    is_least = kind is not RemedyKind.HEIGHT
    checks = tuple(item for item in state.failed if item.id == check.id)
    values, texts = dict[str, float](), dict[str, tuple[str, str]]()
    for item in checks:
        entered = getattr(by_id(state.done.arrays, item.subject).array, field)
        needed = _needed(item, entered)
        values[item.subject] = needed.value
        amounts = entered_amount(entered, needed.quantity), needed
        texts[item.subject] = amount_texts(*amounts, state.data.us_first, is_at_least=is_least)
    alike = grouped_by(texts, texts.__getitem__)
    parts = [
        f"{needed_text} for {ranged(names)} (entered: {entered_text})"
        for (entered_text, needed_text), names in alike.items()
    ]
    words = "Provide {} of at least" if is_least else "Lower the {} to at most"
    if not any(map(math.isnan, values.values())):
        yield Remedy(
            kind=kind,
            checks=checks,
            words=f"{words.format(kind.value)} {joined(parts)}",
            change=partial(_with_values, field=field, values=values),
        )


def _with_values(data: ProjectInput, *, field: str, values: Mapping[str, float]) -> ProjectInput:
    arrays = (
        row.model_copy(update={field: values[row.id]}) if row.id in values else row
        for row in data.arrays
    )
    return data.changed(arrays=tuple(arrays))


# By the id of a check, in the order in which they are tried: those with runs last.
_WAYS: Mapping[str, Sequence[Callable[[_State, Check], Iterator[Remedy]]]] = {
    "clearance": (_separations, _review, _frictions),
    PLAN_ROW: (_separations, _review),
    "fire_pathway": (_separations, _review),
    "analysis_max_slope_deg": (_review,),
    "prescriptive_min_mu": (_prescriptive_mu,),
    "runs": (_frictions,),
    **dict.fromkeys(_VALUES, (_values,)),
}
