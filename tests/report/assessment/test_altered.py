"""The altered copies of the projects: between them they have every verdict."""

from fixtures import altered_projects
from report.assessment.design.verdict import Verdict


def test_the_copies_are_more_than_thirty_and_have_every_verdict():
    made = dict(altered_projects.copies())
    assert len(altered_projects.COPIES) >= 30
    assert made.keys() > altered_projects.COPIES.keys()
    done = [made[name]() for name in ("plainly OK", "no stated values", "short clearance",
                                      "too steep", "two motions")]  # fmt: skip
    projects = [each.verdict for each in done]
    assert projects == [Verdict.OK, Verdict.CONDITIONS, Verdict.NG, Verdict.NG, Verdict.NG]
    clearances = {gap.verdict for each in done for gap in each.clearances}
    assert clearances == {Verdict.OK, Verdict.NG, Verdict.NONE}
    rows = {row.verdict for each in done for row in each.checks}
    assert rows == {Verdict.OK, Verdict.CONDITION, Verdict.NG, Verdict.NOTE}
