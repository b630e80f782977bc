"""The checks of a project as a package prints them: the first sheet's two tables, and all of them.

Contains no check and no text of one: see `report.assessment.checks`. Read `first_sheet`, then
`listed`.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from markupsafe import Markup

from report.assessment.assessment import Assessment
from report.assessment.causes import failed, governing_words, largest
from report.assessment.checks.check import MOTIONS_ID, Check
from report.assessment.checks.sentence import alike, found_and_limit, texts
from report.assessment.design.verdict import Verdict
from report.document.tables import Table, TableRow, Wide, headed, stamp
from report.pages.symbols import with_symbols
from report.text.counts import counted, numbered
from report.text.letter_case import capitalized, lowered
from report.text.units import ratio

# The part with the numbers behind a kind of check; of the others the part on checks.
_PARTS = {
    "plan": ("neighbors", "roof_outline", "drawing_distances", "fire_pathways"),
    "model": ("tipping", "links"),
    "results": ("design", "runs"),
    "motions": ("motions", "drift", "ground_motions"),
    "provisions": ("override", "statistic", "confirmation"),
    "accuracy": ("less_friction",),
    "inputs-friction": ("friction_tests", "friction_velocity"),
    "inputs-site": ("building_code", "code_edition", "hazard_source", "sdc", "site_class",
                    "dates", "site_specific_hazard", "rule_set", "edition_name"),
}  # fmt: skip
_SCHEDULED = ("clearance", "fire_pathway")


def place_of(check: Check, numbers: Mapping[str, str]) -> str:
    """Return the place with the numbers behind a check: a part, or in it a row or table.

    A row of the part on checks may be on its second sheet, and the schedule of clearances beside
    a large plan.
    """
    if check.id in _SCHEDULED:
        return "plan:schedule"
    part = next((part for part, kinds in _PARTS.items() if check.id in kinds), "limits")
    return part if part.partition("-")[0] in numbers and part != "limits" else _row_name(check)


def _row_name(check: Check) -> str:
    return f"limits:{check.id}"


@dataclass(frozen=True, slots=True, kw_only=True)
class FirstSheet:
    """What the two tables of the first sheet have."""

    failed: Sequence[Check]
    """NG items, the largest ratio first."""
    n_following: int
    """NG that only follow from a design displacement that is not there."""
    largest: Sequence[Check]
    """The check with the largest ratio for each type of satisfied capacity."""
    conditions: Sequence[Check]
    n_more: int = 0
    """Conditions that do not fit."""
    has_effects: bool = True
    """Whether there is room for the effect of other inputs, which is in the comparison as well."""
    has_remedies: bool = True
    """Whether there is room for what would satisfy each NG, which the part on checks says too."""


def first_sheet(done: Assessment) -> FirstSheet:
    """Return NG items, the conditions, and the largest ratio of every other type."""
    causes = failed(done)
    conditions = [check for check in done.open if check.verdict is not Verdict.NG]
    return FirstSheet(
        failed=causes,
        n_following=sum(
            check.verdict is Verdict.NG and check.lacks_design and check not in causes
            for check in done.open
        ),
        largest=largest(done),
        # There may be no room for all: those with another result if not met are first.
        conditions=sorted(conditions, key=lambda check: not check.otherwise),
    )


def fitted(sheet: FirstSheet, tops: Mapping[str, float], bottom: float) -> FirstSheet:
    """Return the rows that fit on a sheet: NG items always, then the conditions.

    `tops` are the starts of rows on an endless sheet [px], by `LARGEST`, `OPEN` and their count;
    `bottom` is the end of the sheet. The first condition is never omitted.
    """
    over = tops[END] - bottom
    # What is below the last row of a table goes with it, but not the margin of the table.
    # 6 pt, of each of the two tables (`package.css`).
    over += 2 * _MARGIN_PX if over > 0.0 else 0.0
    largest, conditions, has_effects = len(sheet.largest), len(sheet.conditions), True

    def height(name: str, count: int) -> float:
        return tops[f"{name}{count}"] - tops[f"{name}{count - 1}"]

    while over > 0.0 and largest:
        # Satisfied checks go first: they are in the part on checks, and nothing has to be done for
        # them.
        over -= height(LARGEST, largest)
        largest -= 1
    if over > 0.0:
        over -= tops[f"{EFFECTS}1"] - tops[f"{EFFECTS}0"]
        has_effects = False
    # Where any is left out a line says how many.
    over += _LINE_PX if over > 0.0 else 0.0
    while over > 0.0 and conditions > 1:
        over -= height(OPEN, conditions)
        conditions -= 1
    # A remedy below each NG, and what else that part says, are the last to go.
    return replace(
        sheet,
        largest=sheet.largest[:largest],
        conditions=sheet.conditions[:conditions],
        n_more=len(sheet.conditions) - conditions,
        has_effects=has_effects,
        has_remedies=over <= 0.0,
    )


# Names of the places on the first sheet, and of what is behind its last line.
LARGEST, OPEN, EFFECTS, END = "largest-", "open-", "effects-", "front-end"
_LINE_PX, _MARGIN_PX = 18.0, 8.0


def verdict_sentence(done: Assessment, conditions: str = "below") -> str:
    """Return the basis of the verdict on a project, and where its conditions are listed."""
    n_failed = sum(check.verdict is Verdict.NG for check in done.checks)
    n_open = sum(check.verdict is not Verdict.NG for check in done.open)
    total = len(done.checks)
    if n_failed:
        are = "is" if n_failed == 1 else "are"
        text = f"{n_failed} of {total} checks {are} not satisfied: {governing_words(done)}."
        return text + (f" {capitalized(numbered(n_open, 'open condition'))}." if n_open else "")
    if n_open:
        opened = f"The {counted(n_open, 'open condition')} {conditions}"
        text = f"No check is NG. {opened} must be closed before the package is complete."
    else:
        count = sum(check.is_satisfied for check in done.checks)
        n_notes = total - count
        are = "is" if count == 1 else "are"
        text = f"{f'{count} of' if n_notes else 'All'} {total} checks {are} satisfied"
        if any(check.is_excepted for check in done.checks):
            text += ", or exceeded where the rule set permits it"
        if n_notes:
            others = "other has" if n_notes == 1 else "others have"
            text += f"; the {others} no effect on the design displacement"
        text += "."
    return text if done.clearances else f"{text} No clearance is entered, so none is checked."


def governing_table(sheet: FirstSheet, done: Assessment, numbers: Mapping[str, str]) -> Table:
    """Return NG items, each with its remedy below, then the largest ratios."""
    us_first, rows = done.project.us_first, []
    counts = Counter(check.id for check in done.checks)
    places = [*("" for _ in sheet.failed), *(f"{LARGEST}{k}" for k in range(len(sheet.largest)))]
    for check, place in zip((*sheet.failed, *sheet.largest), places, strict=True):
        subject = check.subject or "project"
        # The row of a satisfied kind stands for all of that kind: its largest ratio.
        if check.is_satisfied and counts[check.id] > 1:
            subject += f" (of {counts[check.id]})"
        pair = texts(check, us_first, is_both=False)
        cells = check.title, subject, *pair, _ratio(check), check.clause
        rows.append(_row(*cells, check.verdict, _sheet(check, numbers, place)))
        under = " ".join(filter(None, (check.to_close, check.otherwise)))
        if under and sheet.has_remedies:
            rows.append(_below(under, len(cells) + 2))
    return replace(_GOVERNING_HEADS, rows=tuple(rows))


def condition_table(sheet: FirstSheet, done: Assessment, numbers: Mapping[str, str]) -> Table:
    """Return the conditions, each with the result for the project if it is not met below."""
    us_first, rows = done.project.us_first, []
    for count, check in enumerate(sheet.conditions):
        title, found_text, *others = open_cells(check, us_first)
        found_text += f" ({check.note})" if check.note else ""
        cells = title, found_text, *others, _sheet(check, numbers, f"{OPEN}{count}")
        rows.append(_row(*cells))
        if check.otherwise:
            rows.append(_below(f"If not met, {lowered(check.otherwise)}", len(cells)))
    return replace(_CONDITION_HEADS, rows=tuple(rows))


def open_cells(check: Check, us_first: bool) -> tuple[str, str, str, str]:
    """Return what an open check is about, what is found, what is required, and who acts."""
    found_text, limit_text = texts(check, us_first, is_both=False)
    title = f"{check.subject}: {lowered(check.title)}" if check.subject else check.title
    required = f"{limit_text} ({check.clause})" if check.clause else limit_text
    return title, found_text, required, check.actor.value


def open_table(done: Assessment) -> Table:
    """Return the open checks and who must act; NG items are marked."""
    rows = []
    for check in done.open:
        mark = stamp(check.verdict) if check.verdict is Verdict.NG else ""
        rows.append((*map(with_symbols, open_cells(check, done.project.us_first)), mark))
    heads = ("Open", 2.2), ("Found", 2.6), ("Required", 3.5), ("Action by", 0.9)
    return headed(*heads, ("", 0.3, "center"), rows=rows, kind="compact")


def all_checks(done: Assessment) -> Table:
    """Return every check but clearances and limits on motions, satisfied or not, in both systems.

    Those two have tables of their own, in the parts with the plan and with the motions.
    """
    us_first = done.project.us_first
    listed_checks = (check for check in done.checks if check.id not in APART)
    rows, named = [], set[str]()
    for check in alike(listed_checks):
        pair = found_and_limit(check, us_first)
        title = with_symbols(check.title)
        if (name := _row_name(check)) not in named:
            title = Markup('<span id="{}">{}</span>').format(name, title)
            named.add(name)
        cells = check.subject or "project", title, *pair, _ratio(check), check.clause
        rows.append(_row(*cells, check.verdict))
        if check.is_open and check.to_close:
            rows.append(_below(f"To close: {check.to_close}", len(cells) + 1))
    return replace(_ALL_HEADS, rows=tuple(rows))


APART = ("clearance", MOTIONS_ID)
"""Kinds with a table of their own."""
_GOVERNING_HEADS = headed(
    ("Check", 2.25), ("Item", 1.2), ("Found", 1.45), ("Required", 1.45), ("Ratio", 0.5, "right"),
    ("Code section", 1.6), ("Verdict", 0.75, "center"), ("Sheet", 0.45, "right"),
    kind="compact",
)  # fmt: skip
_CONDITION_HEADS = headed(
    ("Condition", 2.4), ("Found", 2.6), ("Required (code section)", 3.1),
    ("Action by", 0.95), ("Sheet", 0.45, "right"), kind="compact",
)  # fmt: skip
_ALL_HEADS = headed(
    ("Item", 0.9), ("Check", 2.6), ("Found", 2.5), ("Required", 2.35), ("Ratio", 0.5, "right"),
    ("Code section", 1.65), ("Verdict", 0.85, "center"), kind="compact",
)  # fmt: skip


def _row(*cells: str) -> TableRow:
    return TableRow(cells=tuple(map(_cell, cells)))


def _cell(value: str) -> Markup:
    if isinstance(value, Verdict):
        return stamp(value)
    return value if isinstance(value, Markup) else with_symbols(value)


def _below(text: str, span: int) -> TableRow:
    return TableRow(cells=(Wide(with_symbols(text), span),), kind="under")


def _ratio(check: Check) -> str:
    return ratio(check.ratio) if check.is_capacity and math.isfinite(check.ratio) else "—"


def _sheet(check: Check, numbers: Mapping[str, str], place: str) -> Markup:
    """Return the number of the sheet with the numbers behind a check; the layout fills it in."""
    name = Markup(' id="{}"').format(place) if place else ""
    return Markup('<a class="at"{} href="#{}"></a>').format(name, place_of(check, numbers))
