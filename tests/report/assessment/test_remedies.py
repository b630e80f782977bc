"""What would satisfy what is NG: searched, then entered and assessed before it is printed."""

import math
from functools import reduce

import numpy as np
import pytest

from fixtures import altered_projects, assessments, project_parts, projects
from fixtures.marks import nightly
from fixtures.pages import page_of
from fixtures.single_runs import prd_m, slid
from fixtures.spaces import spaced
from report.assessment.assess import entered
from report.assessment.causes import came_to
from report.assessment.design.friction import with_mu
from report.assessment.design.verdict import Verdict
from report.assessment.remedies.friction_search import above, below, search
from report.assessment.remedies.remedy import MOST, Remedies, RemedyKind, remedies
from report.pages.limits import remedy_lines
from report.pages.saving import without_analysis
from report.pages.terminal import summary
from report.project.check.covered import outdated
from report.project.model.shapes import gap_m
from report.web.answers import answer
from solver.friction_tests import MOST_MU
from solver.model import Friction, Status

PEER = project_parts.REVIEW
SHORT = assessments.motions()
FOOT, INCH, ARRAY, GAP = projects.FOOT, projects.INCH, projects.array, projects.clearance


# Those whose remedies are made anew by day.
BY_DAY = (
    "conditions", "two causes", "two causes and a slope", "much that is NG", "short clearance",
    "slides without end", "each stated value fails", "high center of gravity",
)  # fmt: skip
CASES = [name if name in BY_DAY else nightly(name) for name, _ in altered_projects.copies()]


def fresh(done, *changes):
    """The project with changes, assessed without anything of the one before."""
    data = reduce(lambda data, change: change(data), changes, done.project)
    data = outdated(data, done.shaking.hashes)
    return projects.assessed_anew(done, data)


def failed(done):
    return {(c.id, c.subject, c.places) for c in done.checks if c.verdict is Verdict.NG}


@pytest.mark.parametrize("name", CASES)
def test_every_remedy_that_is_printed_gives_the_verdict_that_was_printed(name):
    done = altered_projects.assessed(name)
    found = remedies(done)
    lines = " ".join(remedy_lines(done, found))
    if done.verdict.is_permitted:
        assert (found, lines) == (Remedies(), "")
    for remedy in found.own:
        after = fresh(done, remedy.change)
        assert came_to(after) == came_to(remedy.done)
        assert {(c.id, c.subject, c.places) for c in remedy.checks} <= failed(done) - failed(after)
        words = f"{remedy.words}. Project verdict: {came_to(after)}."
        assert remedy.words in lines
        assert (words in lines) is after.verdict.is_permitted
    if found.together:
        changes = [remedy.change for remedy in found.together]
        after = fresh(done, *changes)
        assert after.verdict.is_permitted
        assert f"Project verdict: {came_to(after)}." in lines
        # None of them may be left out.
        for change in changes if changes[1:] else ():
            others = [each for each in changes if each is not change]
            assert fresh(done, *others).verdict is Verdict.NG
    assert "Project verdict: NG" not in lines


def test_what_fails_has_its_own_remedies_and_nothing_else_has():
    (found,) = remedies(altered_projects.assessed("small roof capacity")).own
    assert spaced(found.words) == (
        "Provide roof capacity of at least 5.5 psf (0.27 kPa) for A2 (entered: 2.0 psf (0.10 kPa))"
    )
    # Nobody changes the use of a building or its stories for an array.
    for name in ("risk category IV", "20 stories", "too steep"):
        done = altered_projects.assessed(name)
        assert remedies(done) == Remedies()
        assert not any(line.startswith("remedy: ") for line in summary(done))
    kinds = {
        remedy.kind for remedy in remedies(altered_projects.assessed("slides without end")).own
    }
    assert kinds == {RemedyKind.FRICTION}


def test_of_several_causes_the_smallest_set_is_printed_as_one_remedy():
    done = altered_projects.assessed("two causes")
    found = remedies(done)
    assert [remedy.kind for remedy in found.together] == [
        RemedyKind.CAPACITY, RemedyKind.SEPARATION
    ]  # fmt: skip
    line = f"remedy: {found.sentence}"
    assert line in summary(done)
    assert "Provide roof capacity of at least 5.5 psf" in spaced(line)
    assert "and move A1 20.8 in (529 mm) west. Project verdict: OK with conditions" in spaced(line)
    assert spaced(found.sentence) in page_of(assessments.package_data(done), "summary")
    # One array is too steep whatever the others do: no set is called enough.
    done = altered_projects.assessed("two causes and a slope")
    found = remedies(done)
    assert (found.together, found.done) == ((), None)
    assert [*remedy_lines(done, found)][-1] == "No combination of these changes is sufficient."


def test_a_displacement_by_peer_review_is_that_of_each_array_by_its_name():
    done = altered_projects.assessed("short between arrays")
    (found,) = (each for each in remedies(done).own if each.kind is RemedyKind.REVIEW)
    after = {item.id: item.design_m for item in fresh(done, found.change).arrays}
    assert after["A1"] != after["A2"]
    for name in ("A1", "A2"):
        assert f"{name} {math.ceil(after[name] / INCH * 10) / 10:.1f} in" in spaced(found.words)
    assert "A3" not in found.words


def test_where_the_motions_do_not_permit_an_analysis_motions_that_do_are_named():
    for name, lack in (
        ("two motions", "number of motions (2, at least 3†)"),
        ("overrides", "the statistic 'mean' requires at least 11 motions; 7 are listed"),
        ("motions without vertical", "one vertical (2, at least 3†)"),
    ):
        done = altered_projects.assessed(name)
        words = without_analysis(done)
        assert words.startswith("the motions do not permit an analysis (")
        assert f"{lack}), so the package uses the prescriptive displacement, 81.6 in" in spaced(
            words
        )
        assert "At 40.8 in (1036 mm), " in spaced(words)
        assert f"note: {words}" in summary(done)
        assert spaced(words[1:]) in page_of(assessments.package_data(done), "limits")
    assert without_analysis(altered_projects.assessed("short clearance")) == ""


def of(found, kind, name=""):
    """The remedies of a kind, and of a check if it is named."""
    return [
        remedy
        for remedy in found.own
        if remedy.kind is kind and (not name or name in [check.subject for check in remedy.checks])
    ]


def made(provided_m, *, options=PEER, motions=SHORT, far="A3", **changes):
    gap = projects.clearance("A2", far, provided_m)
    return assessments.package(motions, clearances=[gap], options=options, **changes).assessment


def tight(share, **changes):
    """An assessment with a share of the required clearance, and the displacement that it allows."""
    (roomy,) = made(9.0, **changes).clearances
    done = made(share * roomy.required_m, **changes)
    (gap,) = done.clearances
    return done, gap.clearance.provided_m / gap.factor


def analysis_m(array, mu, share=1.0):
    """The value from analysis of an array with such friction, by the public solver."""
    return 1.1 * max(prd_m(motion, array, mu=mu, scale=share) for motion in SHORT)


@pytest.fixture(scope="module")
def failing():
    return tight(0.6)


@pytest.mark.quick
def test_nothing_is_tried_for_a_clearance_that_is_satisfied_or_without_a_permitted_route():
    narrow = [projects.clearance("A1", "RTU-1", projects.FOOT)]
    done = projects.unpermitted(options={}, clearances=narrow)
    assert done.arrays[0].design_m == done.arrays[0].floor_m > projects.FOOT
    assert remedies(done) == remedies(made(9.0)) == Remedies()  # nor where everything is satisfied


def test_a_walk_returns_every_value_before_the_first_failure_and_tries_none_twice():
    assert search(lambda k: k >= 23, 150, 11)[-1] == 23
    assert search(lambda k: k <= 44, 5, 99)[-1] == 44
    assert search(lambda k: k >= 0, 20, 7)[-1] == 7
    assert search(lambda k: k < 0, 20, 7) == ()
    assert search(lambda k: True, 20, 20) == (20,)
    tried = []

    def satisfies(k):
        tried.append(k)
        return k != 50 and k >= 30

    held = search(satisfies, 150, 11)
    assert held[-1] == 51
    assert all(k > 50 for k in held)
    assert len(tried) == len(set(tried)) + 1  # the failure of the first pass is met again
    assert (above(0.45), below(0.45)) == (46, 44)
    assert (above(0.425), below(0.425)) == (43, 42)
    assert (above(0.0), below(1.566)) == (1, 156)


def mus(done, found):
    """The friction that remedies give, and the friction now, by array."""
    for remedy in of(found, RemedyKind.FRICTION):
        for old, new in zip(done.project.arrays, remedy.change(done.project).arrays, strict=True):
            if new != old:
                yield old.id, (old.mu, new.mu)


def test_the_least_friction_satisfies_there_and_beyond_and_not_below(failing):
    done, allowed = failing
    by_id = {item.array.id: item.array for item in done.arrays}
    listed = dict(mus(done, remedies(done)))
    assert listed
    for name, (given, least) in listed.items():
        array = by_id[name]
        assert analysis_m(array, given) > allowed
        assert analysis_m(array, least) <= allowed < analysis_m(array, least - 0.01)
        for mu in np.arange(least, MOST_MU + 0.01, 0.07):
            assert analysis_m(array, mu) <= allowed


@pytest.mark.parametrize(
    ("provided_m", "changes"),
    [(0.1, {"options": {}}),  # by the floor
     (0.2, {"far": "S edge", "site": projects.site(rule_set="ASCE 7-16")})],  # by the minimum
)  # fmt: skip
def test_a_floor_or_a_minimum_separation_that_forbids_leaves_no_friction(provided_m, changes):
    done = made(provided_m, **changes)
    assert done.clearances[0].verdict is Verdict.NG
    assert not of(remedies(done), RemedyKind.FRICTION)


def test_a_friction_law_is_scaled_as_a_whole():
    arrays = [
        projects.array("A2", 2.0, mu=0.3, mu_fast=0.36, mu_rate_s_per_m=20.0),
        projects.array("A3", 3.0, mu=0.9, y=90),
    ]
    done, allowed = tight(0.7, arrays=arrays)
    _, least = dict(mus(done, remedies(done)))["A2"]

    def design(mu):
        law = Friction(mu_slow=mu, mu_fast=1.2 * mu, rate_s_per_m=20.0, mu_static=mu)
        return analysis_m(done.arrays[0].array, law)

    assert design(least) <= allowed < design(least - 0.01)


def test_an_array_that_slides_at_the_end_needs_friction():
    cut = tuple(projects.motion(m.id, m.ax_mps2[:700] / 3, dt_s=m.dt_s, signs=(1,)) for m in SHORT)
    arrays = [projects.array("B1", 1.0, mu=0.08)]
    failing = assessments.package(
        cut, arrays=arrays, objects=[], clearances=[], options=PEER
    ).assessment
    _, least = dict(mus(failing, remedies(failing)))["B1"]
    array = failing.arrays[0].array

    def finishes(mu):
        runs = (slid(m, m.ax_mps2, m.ay_mps2, array, mu=mu) for m in cut)
        return all(run.status is Status.OK for run in runs)

    assert not finishes(0.08)
    assert finishes(least)
    assert not finishes(least - 0.01)


@pytest.mark.quick
def test_a_block_that_lifts_off_has_no_remedy():
    lifted = tuple(projects.lifting(f"L{k}", signs=(1,)) for k in range(3))
    for provided_m in (0.5, 9.0):
        done = made(provided_m, motions=lifted)
        assert done.verdict is Verdict.NG
        assert remedies(done) == Remedies()


ROOF = {"x_from_m": 0.0, "x_to_m": 400 * FOOT, "y_from_m": 0.0, "y_to_m": 400 * FOOT}


def unit(x, name="RTU-1", width=5.0):
    """A fixed object to the east of the array A1, which ends at 100 ft."""
    return projects.roof_object(name, "fixed object", x, x + width, 35, 42, height=1.0)


def beside(x=101.0, mu=0.45, *, objects=(), roof=ROOF, options=None, **changes):
    """One array, one object x ft from its axis and the clearance between the two."""
    return assessments.package(
        arrays=[ARRAY("A1", 0.5, mu=mu)],
        objects=[unit(x), *objects],
        clearances=[GAP("A1", "RTU-1", (x - 100.0) * FOOT)],
        roof=roof,
        options=options or {},
        **changes,
    ).assessment


def of_kind(given, kind):
    return of(remedies(given), kind)


@pytest.mark.quick
def test_an_array_is_moved_where_the_plan_has_room_and_everything_is_checked_again():
    given = beside()
    (gap,) = given.clearances
    assert gap.verdict is Verdict.NG
    (found,) = of_kind(given, RemedyKind.SEPARATION)
    inches = math.ceil((gap.required_m - gap.provided_m) / INCH * 10 - 1e-6) / 10
    assert spaced(found.words).startswith(f"Move A1 {inches:.1f} in (")
    assert found.words.endswith(") west")
    (moved,) = found.done.clearances
    assert moved.required_m == gap.required_m <= moved.provided_m
    words = came_to(found.done)
    assert words == f"{found.done.verdict}, clearance A1 to RTU-1 (D/C {moved.ratio_words})"
    # By hand: the sides as they are to be entered, and the clearance as it is then measured.
    array, step = given.project.arrays[0], inches * INCH + 1e-8
    moved = array.model_copy(
        update={"x_from_m": array.x_from_m - step, "x_to_m": array.x_to_m - step}
    )
    between = gap_m(moved.shape, given.project.objects[0].placed)
    row = given.project.clearances[0].model_copy(update={"provided_m": between})
    done = entered(given, given.project.changed(arrays=(moved,), clearances=(row,)))
    assert came_to(done) == words


@pytest.mark.quick
def test_where_north_is_turned_a_move_is_along_an_axis_of_the_plan():
    (found,) = of_kind(beside(roof={"north_deg": 60.0}), RemedyKind.SEPARATION)
    assert found.words.endswith(") toward −x of the plan")


def test_no_move_makes_something_else_ng_or_leaves_the_roof():
    west = unit(18.0, "RTU-2", width=1.0)  # a foot from the other side of the array
    north = unit(20.0, "RTU-3", width=60.0) | {"y_from_m": 76 * FOOT, "y_to_m": 80 * FOOT}
    south = unit(20.0, "RTU-4", width=60.0) | {"y_from_m": 10 * FOOT, "y_to_m": 14 * FOOT}
    given = beside(objects=[west, north, south])
    assert given.verdict is Verdict.NG
    assert not of_kind(given, RemedyKind.SEPARATION)
    given = beside(roof=ROOF | {"x_from_m": 19 * FOOT})
    for found in of_kind(given, RemedyKind.SEPARATION):
        assert "west" not in found.words


def test_an_object_without_a_place_in_plan_needs_the_separation_alone():
    nowhere = {"x_from_m": None, "x_to_m": None, "y_from_m": None, "y_to_m": None}
    given = assessments.package(
        arrays=[ARRAY("A1", 0.5)],
        objects=[unit(101.0) | nowhere],
        clearances=[GAP("A1", "RTU-1", FOOT)],
    ).assessment
    (found,) = of_kind(given, RemedyKind.SEPARATION)
    assert spaced(found.words) == "Provide 28.8 in (732 mm) more from A1 to RTU-1"
    assert found.done.clearances[0].provided_m >= found.done.clearances[0].required_m


def test_of_many_clearances_the_worst_have_remedies_and_the_summary_says_so():
    count = MOST + 2
    units = [
        projects.roof_object(f"U{k}", "fixed object", 100.5 + 0.1 * k, 103, 16 + 4 * k, 18 + 4 * k)
        for k in range(count)
    ]
    gaps = [GAP("A1", f"U{k}", (0.5 + 0.1 * k) * FOOT) for k in range(count)]
    beside = assessments.package(arrays=[ARRAY("A1", 0.5)], objects=units, clearances=gaps)
    found = of_kind(beside.assessment, RemedyKind.SEPARATION)
    assert [one.checks[0].subject for one in found] == [f"A1 to U{k}" for k in range(MOST)]
    said = f"Searched for the {MOST} with the largest ratio of {count} that are NG."
    assert said in page_of(beside, "limits")


def test_friction_is_assessed_as_entered_and_not_beyond_its_tests():
    options = {"options": PEER, "roof": {}, "x": 100.3}
    free = beside(mu=0.3, **options)
    assert not free.clearances[0].ok
    _, least = dict(mus(free, remedies(free)))["A1"]
    low = round(least - 0.02, 2)
    tests = [{"surface": surface, "number": k, "mu": low}
             for surface in ("wet", "dry") for k in (1, 2, 3)]  # fmt: skip
    assert not of_kind(beside(mu=0.3, friction_runs=tests, **options), RemedyKind.FRICTION)
    arrays = tuple(with_mu(row, least) for row in free.project.arrays)
    by_hand = projects.assess_input(free.project.changed(arrays=arrays), assessments.motions())
    (found,) = of_kind(free, RemedyKind.FRICTION)
    assert came_to(found.done) == came_to(by_hand)
    assert found.done.verdict is not Verdict.NG
    # A page that may not run names what needs no run alone.
    kinds = [each.kind for each in remedies(free, may_run=False).together]
    assert RemedyKind.FRICTION not in kinds


@pytest.mark.quick
def test_peer_review_is_offered_where_it_removes_a_floor_that_governs_and_only_there():
    given = beside(x=102.5)
    (found,) = of_kind(given, RemedyKind.REVIEW)
    assert spaced(found.words) == (
        "Obtain a peer review of the analysis: design displacement of A1 3.9 in (98 mm) instead of "
        "40.8 in (1036 mm)"
    )
    reviewed = beside(x=102.5, options=PEER)
    assert found.done.clearances[0].required_m == reviewed.clearances[0].required_m
    assert not of_kind(reviewed, RemedyKind.REVIEW)
    assert not of_kind(beside(x=150.0), RemedyKind.REVIEW)  # nothing is NG
    # A review of other inputs removes nothing: it is offered anew.
    day = project_parts.HEAD["date"]
    of_others = {"peer_date": day, "peer_covered": f"{day}: Arrays 000000"}
    (anew,) = of_kind(beside(x=102.5, options=PEER | of_others), RemedyKind.REVIEW)
    assert anew.words == found.words


def test_terminal_page_and_package_have_one_sentence_of_it():
    given = beside()
    words = remedies(given).sentence
    assert spaced(words).startswith(
        "Move A1 28.8 in (732 mm) west. Project verdict: OK with conditions, "
    )
    lines = list(summary(given))
    at = lines.index(f"remedy: {words}")
    assert lines[at - 1].startswith("NG: ")
    reasons = answer(given, is_provisional=False)["reasons"]
    assert ("remedy", words) in [(reason["level"], reason["text"]) for reason in reasons]
    package = assessments.package_data(given)
    assert spaced(words) in page_of(package, "summary")
    assert spaced(f"Clearance, A1 to RTU-1: {words}") in page_of(package, "limits")
    assert not any(line.startswith("remedy") for line in summary(beside(x=150.0)))
