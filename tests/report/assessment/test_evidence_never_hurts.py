"""Without a cell, a run, a document or a record of evidence no verdict is better than with it."""

import random

import pytest

from fixtures import altered_projects, assessments
from fixtures.deletions import Deletable, improved

PROJECTS = (
    *assessments.SHIPPED, "each stated value fails", "complete friction tests", "plainly OK",
    "reviewer's name alone", "no motions", "school at half capacity",
)  # fmt: skip


def milder(project, deletions):
    """Return what is better after each deletion, and how many were not refused."""
    after = [(each, project.without(each)) for each in deletions]
    done = [(each, found) for each, found in after if found is not None]
    lines = [
        f"{each.what}: {line}"
        for each, found in done
        for line in improved(project.done, found, each)
    ]
    return lines, len(done)


@pytest.mark.parametrize(("name", "seed"), [*zip(PROJECTS, range(76, 86), strict=True)])
def test_of_two_deletions_none_makes_a_verdict_better(name, seed, tmp_path):
    project = Deletable.of(altered_projects.workbook(name, tmp_path / "project"))
    assert project.done.verdict is altered_projects.assessed(name).verdict
    chosen = random.Random(seed).sample(project.deletions(), 2)
    assert milder(project, chosen)[0] == []


@pytest.mark.nightly
@pytest.mark.parametrize("name", PROJECTS)
def test_no_deletion_makes_a_verdict_better(name, tmp_path):
    project = Deletable.of(altered_projects.workbook(name, tmp_path / "project"))
    lines, count = milder(project, project.deletions())
    assert count > 25
    assert lines == []


FEWER = {
    "failing value": ("arrays 1 slack_m", "each stated value fails", ["NG", "Condition"]),
    "run": ("friction_runs 5", "complete friction tests", ["OK", "Condition"]),
}


@pytest.mark.parametrize(("what", "name", "verdicts"), FEWER.values(), ids=FEWER)
def test_what_is_not_given_any_more_is_a_condition(what, name, verdicts, tmp_path):
    project = Deletable.of(altered_projects.workbook(name, tmp_path / "project"))
    (deletion,) = (each for each in project.deletions() if each.what == what)
    rows = {"arrays 1 slack_m": "electrical_slack", "friction_runs 5": "friction_velocity"}
    found = [
        next(row.verdict for row in done.checks if (row.id, row.subject) == (rows[what], "A1"))
        for done in (project.done, project.without(deletion))
    ]
    assert found == verdicts


@pytest.mark.parametrize("what", ["clearances 3 pathway_m", "clearances 3"])
def test_a_fire_pathway_that_fails_cannot_be_left_out(what, tmp_path):
    project = Deletable.of(
        altered_projects.workbook("each stated value fails", tmp_path / "project")
    )
    (deletion,) = (each for each in project.deletions() if each.what == what)
    assert milder(project, [deletion]) == ([], 1)
