"""Everything that is required, as checks: the verdicts are the worst of them."""

import math

import pytest

from fixtures import altered_projects, assessments, projects
from fixtures.project_parts import INCH
from fixtures.spaces import spaced
from report.assessment.checks.check import Check, Sense, by_ratio, verdict_of
from report.assessment.checks.sentence import alike, sentence, texts, words
from report.assessment.design.verdict import Verdict
from report.text.amounts import capacity, demand, entered
from report.text.units import Quantity
from solver.rules.limit import Consequence


def check(**fields):
    usual = {
        "id": "clearance",
        "title": "Clearance",
        "subject": "A1 to RTU-1",
        "found": capacity(20 * INCH, Quantity.SIZE),
        "limit": demand(40.8 * INCH, Quantity.SIZE, "†"),
        "sense": Sense.AT_LEAST,
        "clause": "PV1-2012†",
        "is_satisfied": False,
        "remedy": "Widen the clearance.",
    }
    return Check(**usual | fields)


ALL = pytest.mark.parametrize(
    "make",
    [
        *(pytest.param(make, id=name) for name, make in altered_projects.copies()),
        pytest.param(assessments.unpermitted, id="no permitted route"),
        pytest.param(lambda: assessments.departing().assessment, id="every departure"),
        pytest.param(
            lambda: assessments.package((projects.lifting(),)).assessment, id="lifted off"
        ),
    ],
)


@ALL
def test_the_verdicts_are_the_worst_of_the_checks_and_nothing_else(make):
    done = make()
    assert verdict_of(done.checks) is done.verdict
    for item in done.arrays:
        assert verdict_of(done.checks, item.id) is done.array_verdict(item)
    of_gaps = [each for each in done.checks if each.id == "clearance"]
    for gap, each in zip(done.clearances, of_gaps, strict=True):
        # Without a verdict of its own it is NG for the arrays beside it.
        assert each.verdict is (Verdict.NG if gap.verdict is Verdict.NONE else gap.verdict)


@ALL
def test_a_ratio_above_one_is_what_is_not_satisfied(make):
    for each in make().checks:
        if not math.isnan(each.ratio):
            assert (each.ratio > 1.0 + 1e-6) is not each.is_satisfied, each


@pytest.mark.quick
def test_a_check_is_one_sentence_and_a_cell():
    said = sentence(check(), us_first=True)
    assert spaced(said) == (
        "Clearance, A1 to RTU-1: 20.0 in (508 mm). Required: at least 40.8 in (1037 mm)† "
        "(PV1-2012†). To close: widen the clearance."
    )
    assert spaced(texts(check(), us_first=True, is_both=False)) == ("20.0 in", "≥ 40.8 in†")
    assert words(check()) == "clearance A1 to RTU-1 (D/C 2.04)"


@pytest.mark.quick
def test_nothing_is_to_be_done_of_what_is_satisfied():
    assert check(is_satisfied=True).to_close == ""
    note = check(consequence=Consequence.NOTE, remedy="The procedure is permitted.")
    assert sentence(note, us_first=True).endswith("(PV1-2012†). The procedure is permitted.")


@pytest.mark.quick
def test_checks_that_ask_the_same_are_one_with_the_worst():
    of = [check(subject=f"A{k}", id="slack", found=capacity(0.1 * k)) for k in (3, 1, 2)]
    (one,) = alike([*of])
    assert (one.subject, one.found.value) == ("A1 to A3", 0.1)
    two = check(subject="A4", id="slack", found="not entered", consequence=Consequence.CONDITION)
    assert len(alike([*of, two])) == 2


@pytest.mark.quick
def test_words_that_all_share_are_said_once():
    of = [
        check(
            id="friction_velocity", subject=f"A{k}", found=f"tested to 4; slides at {k}", limit="x"
        )
        for k in (1, 2)
    ]
    (one,) = alike(of)
    assert one.found == "tested to 4; A1: slides at 1; A2: slides at 2"


@pytest.mark.quick
def test_of_amounts_that_nothing_is_compared_with_the_safe_one_stands_for_all():
    unknown = {"limit": "unknown", "sense": Sense.STATED}
    of = [check(subject=f"A{k}", id="slack", found=capacity(k), **unknown) for k in (3, 1, 2)]
    assert alike(of)[0].found == capacity(1, mark=" (A1)")
    of = [check(subject=f"A{k}", id="design", found=demand(k), **unknown) for k in (3, 1, 2)]
    assert alike(of)[0].found == demand(3, mark=" (A3)")


def test_what_asks_the_same_of_many_cells_says_so_once_with_the_first_few():
    said = {"remedy": "Correct the clearance.", "subject": "A1 to N"}
    of = [check(**said, cell=f"Clearances!E{row}") for row in range(8, 69)]
    close = "Correct the clearance (Clearances!E8, Clearances!E9, Clearances!E10 and 58 more)."
    assert of[0].to_close == "Correct the clearance (Clearances!E8)."
    assert alike(of)[0].to_close == close
    other = check(subject="A2 to N", cell="Clearances!E70")
    assert alike([*of, other])[0].to_close == f"{close} Widen the clearance (Clearances!E70)."


@pytest.mark.quick
def test_a_ratio_follows_from_the_amounts():
    most = {"sense": Sense.AT_MOST, "limit": capacity(2.0)}
    assert check(found=entered(4.0), **most).ratio == 2.0
    assert check(found="not entered").ratio == math.inf
    assert math.isnan(check(limit="a value").ratio)
    # What is permitted beyond its limit has none.
    assert math.isnan(check(found=entered(4.0), is_satisfied=True, **most).ratio)
    assert check(found=capacity(0.0), limit=demand(0.0), is_satisfied=True).ratio == 0.0


@pytest.mark.quick
def test_what_is_ng_is_first_then_conditions_then_the_largest_ratio():
    ok = {"is_satisfied": True, "found": capacity(1.0)}
    checks = [
        check(subject="low", limit=demand(0.1), **ok),
        check(subject="high", limit=demand(0.9), **ok),
        check(subject="note", limit=demand(1.0), consequence=Consequence.NOTE, **ok),
        check(subject="open", found="not entered", consequence=Consequence.CONDITION),
        check(subject="NG"),
    ]
    assert [each.subject for each in by_ratio(checks)] == ["NG", "open", "high", "low"]
    assert verdict_of(checks) is Verdict.NG
    assert verdict_of(checks[:4]) is Verdict.CONDITIONS
