"""What a project comes to where a condition is not met: as if its input had been so."""

from dataclasses import replace

import pytest

from fixtures import altered_projects, assessments, projects
from fixtures.marks import nightly
from fixtures.pages import page_of
from fixtures.spaces import spaced
from report.assessment.assess import Extent, assess
from report.assessment.causes import governing_words
from report.assessment.checks.check import VELOCITY_ROW
from report.assessment.design.friction import at_low_velocity
from report.assessment.design.rule_set import as_adopted, under_code
from report.text.units import Quantity, no_less, pair

BY_DAY = ("campus", "peer review", "overrides", "short clearance", "motions without vertical")
CASES = [name if name in BY_DAY else nightly(name) for name, _ in altered_projects.copies()]


def others(data):
    """By the id of a check, the input that does not meet it."""
    reviewed = data.options.model_copy(update={"peer_reviewed": False})
    slow = [at_low_velocity(row) if row.friction.is_by_velocity else row for row in data.arrays]
    return {
        "rule_set": under_code(data),
        "override": as_adopted(data),
        "peer_review": data.model_copy(update={"options": reviewed}),
        VELOCITY_ROW: data.model_copy(update={"arrays": tuple(slow)}),
    }


def designs(done):
    """What the arrays may slide [m], in words: NaN is itself."""
    return str([item.permitted_m for item in done.arrays])


@pytest.mark.parametrize("name", CASES)
def test_a_price_is_what_the_project_comes_to_with_that_input(name):
    done = altered_projects.assessed(name)
    open_ids = {check.id for check in done.checks if check.is_open}
    for id, other in others(done.project).items():
        after = projects.assessed_anew(done, other)
        text = done.otherwise.get(id, "")
        if not text:
            assert id not in open_ids or designs(after) == designs(done)
            continue
        us_first = done.project.us_first
        assert governing_words(after) in text
        assert f": {'not NG' if after.verdict.is_permitted else 'NG'}" in text
        largest_m = max(item.permitted_m for item in after.arrays)
        shown = pair(largest_m, Quantity.DISPLACEMENT, us_first, no_less)
        assert ("Δ up to" not in text) or text.endswith(f"; Δ up to {shown}.")


def test_a_price_stands_with_its_condition_and_beside_a_review_that_removes_the_floor():
    done = altered_projects.assessed("little evidence")
    priced = {check.id for check in done.checks if check.is_open and check.otherwise}
    assert priced == {"rule_set", VELOCITY_ROW}
    # Of a letter of acceptance on file the first sheet says what comes without it, too.
    assert {"rule_set"} <= assessments.shipped("example").otherwise.keys()
    done = altered_projects.assessed("peer review")
    line = done.otherwise["peer_review"]
    assert line.startswith("Without peer review: not NG, clearance A1 to RTU-1 (D/C ")
    assert spaced(line).endswith("; Δ up to 47.4 in (1204 mm).")
    assert spaced(line) in page_of(assessments.package_data(done), "summary")
    # What is not reviewed has its floor, and what changes nothing no price.
    assert "peer_review" not in altered_projects.assessed("reviewer's name alone").otherwise
    assert "override" not in done.otherwise


def test_a_record_that_drifts_is_priced_by_the_project_without_it():
    base = assessments.shipped("example")
    first, *rest = base.shaking.prepared
    far = {name: replace(m, final_displacement_m=0.2) for name, m in first.measures.items()}
    drifting = replace(base.shaking, prepared=(replace(first, measures=far), *rest))
    done = assess(altered_projects.read_shipped("example"), drifting)
    fewer = replace(base.shaking, motions=base.shaking.motions[1:], prepared=tuple(rest))
    without = assess(altered_projects.read_shipped("example"), fewer, extent=Extent.AS_GIVEN)
    assert designs(without) != designs(done)
    largest_m = max(item.permitted_m for item in without.arrays)
    text = done.otherwise["drift"]
    assert without.verdict.is_permitted
    assert text.startswith(f"Without {first.motion_id}: not NG, ")
    assert text.endswith(f"; Δ up to {pair(largest_m, Quantity.DISPLACEMENT, True, no_less)}.")
    assert [c.otherwise for c in done.checks if c.id == "drift" and c.is_open] == [text]
