"""What would satisfy a clearance: searched, then entered and assessed before it is printed."""

import math

import numpy as np
import pytest

import inputs
import scenes
import stand_in
from one_by_one import prd_m, slid
from printed import printed
from report.assessment.assess import changed, entered
from report.assessment.causes import outcome
from report.assessment.remedies import MOST_GAPS, RemedyKind, best_remedy, remedies
from report.assessment.trials import above, below, search, with_mu
from report.assessment.verdict import Verdict
from report.pages.inputs import attachment
from report.pages.summary import best_words, summary
from report.sheet.schema.shapes import gap_m
from solver.friction_tests import MOST_MU
from solver.model import Friction, Status

PEER = inputs.REVIEW
SHORT = scenes.motions()


def of(listed, kind, clearance=1):
    return [remedy for remedy in listed if remedy.kind is kind and remedy.clearance == clearance]


def made(provided_m, *, options=PEER, motions=SHORT, far="A3", **changes):
    gap = stand_in.clearance("A2", far, provided_m)
    return scenes.package(motions, clearances=[gap], options=options, **changes).assessment


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
    narrow = [stand_in.clearance("A1", "RTU-1", stand_in.FOOT)]
    done = stand_in.unpermitted(options={}, clearances=narrow)
    assert done.arrays[0].design_m == done.arrays[0].floor_m > stand_in.FOOT
    assert remedies(done) == remedies(made(9.0)) == ()  # nor where everything is satisfied


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


def test_the_least_friction_satisfies_there_and_beyond_and_not_below(failing):
    done, allowed = failing
    by_id = {item.array.id: item.array for item in done.arrays}
    listed = of(remedies(done), RemedyKind.FRICTION)
    assert listed
    for remedy in listed:
        array = by_id[remedy.array]
        assert analysis_m(array, array.mu) > allowed
        assert remedy.value > array.mu == remedy.given
        assert analysis_m(array, remedy.value) <= allowed
        assert analysis_m(array, remedy.value - remedy.resolution) > allowed
        for mu in np.arange(remedy.value, MOST_MU + 0.01, 0.07):
            assert analysis_m(array, mu) <= allowed
        assert remedy.verified == (remedy.value, MOST_MU)
        assert remedy.n_values >= (MOST_MU - remedy.value) / 0.05


@pytest.mark.parametrize(
    ("provided_m", "changes", "reason"),
    [(0.1, {"options": {}}, "floor alone"),
     (0.2, {"far": "S edge", "site": stand_in.site(rule_set="ASCE 7-16")}, "minimum separation")],
)  # fmt: skip
def test_a_floor_or_a_minimum_separation_that_forbids_leaves_no_friction(
    provided_m, changes, reason
):
    frictions = of(remedies(made(provided_m, **changes)), RemedyKind.FRICTION)
    assert frictions
    assert not any(remedy.exists or remedy.n_values for remedy in frictions)
    assert all(reason in remedy.basis for remedy in frictions)


def test_a_friction_law_is_scaled_as_a_whole():
    arrays = [
        stand_in.array("A2", 2.0, mu=0.3, mu_fast=0.36, mu_rate_s_per_m=20.0),
        stand_in.array("A3", 3.0, mu=0.9, y=90),
    ]
    done, allowed = tight(0.7, arrays=arrays)
    remedy = next(r for r in of(remedies(done), RemedyKind.FRICTION) if r.array == "A2")

    def design(mu):
        law = Friction(mu_slow=mu, mu_fast=1.2 * mu, rate_s_per_m=20.0, mu_static=mu)
        return analysis_m(done.arrays[0].array, law)

    assert design(remedy.value) <= allowed < design(remedy.value - 0.01)
    assert "scaled as a whole" in remedy.basis


def test_an_array_that_slides_at_the_end_needs_friction():
    cut = tuple(stand_in.motion(m.id, m.ax_mps2[:700] / 3, dt_s=m.dt_s, signs=(1,)) for m in SHORT)
    arrays = [stand_in.array("B1", 1.0, mu=0.08)]
    failing = scenes.package(cut, arrays=arrays, objects=[], clearances=[], options=PEER).assessment
    (remedy,) = of(remedies(failing), RemedyKind.FRICTION, clearance=0)
    array = failing.arrays[0].array

    def finishes(mu):
        runs = (slid(m, m.ax_mps2, m.ay_mps2, array, mu=mu) for m in cut)
        return all(run.status is Status.OK for run in runs)

    assert not finishes(0.08)
    assert finishes(remedy.value)
    assert not finishes(remedy.value - 0.01)


@pytest.mark.quick
def test_a_block_that_lifts_off_has_no_friction_that_helps():
    lifted = tuple(stand_in.lifting(f"L{k}", signs=(1,)) for k in range(3))
    listed = remedies(made(0.5, motions=lifted))
    narrow, roomy = (
        of(found, RemedyKind.FRICTION) for found in (listed, remedies(made(9.0, motions=lifted)))
    )
    for frictions, reason in (
        (narrow, "prescriptive displacement alone requires more"),
        (roomy, "up to 1.5"),
    ):
        assert reason in frictions[0].basis
        assert not any(remedy.exists for remedy in frictions)
    (separation,) = of(listed, RemedyKind.SEPARATION)
    assert not separation.exists


FOOT, INCH, ARRAY, GAP = stand_in.FOOT, stand_in.INCH, stand_in.array, stand_in.clearance
ROOF = {"x_from_m": 0.0, "x_to_m": 400 * FOOT, "y_from_m": 0.0, "y_to_m": 400 * FOOT}


def unit(x, name="RTU-1", width=5.0):
    """A fixed object to the east of the array A1, which ends at 100 ft."""
    return stand_in.roof_object(name, "fixed object", x, x + width, 35, 42, height=1.0)


def beside(x=101.0, mu=0.45, *, objects=(), roof=ROOF, options=None, **changes):
    """One array, one object x ft from its axis and the clearance between the two."""
    return scenes.package(
        arrays=[ARRAY("A1", 0.5, mu=mu)],
        objects=[unit(x), *objects],
        clearances=[GAP("A1", "RTU-1", (x - 100.0) * FOOT)],
        roof=roof,
        options=options or {},
        **changes,
    ).assessment


def of_kind(given, kind):
    return [one for one in remedies(given) if one.kind is kind]


@pytest.mark.quick
def test_an_array_is_moved_where_the_plan_has_room_and_everything_is_checked_again():
    given = beside()
    (gap,) = given.clearances
    assert gap.verdict is Verdict.NG
    (found,) = of_kind(given, RemedyKind.SEPARATION)
    assert found.value == gap.required_m
    inches = math.ceil((gap.required_m - gap.provided_m) / INCH * 10 - 1e-6) / 10
    assert found.basis.startswith(f"A1 moved {inches:.1f} in (")
    assert found.basis.endswith(") west")
    assert found.outcome.gap.between == ("A1", "RTU-1")
    assert found.outcome.gap.required_m == gap.required_m <= found.outcome.gap.provided_m
    words = found.outcome.words(us_first=True)
    assert words.startswith(f"{found.outcome.verdict.value}, A1 to RTU-1 ")
    assert " ≤ " in words
    # By hand: the sides as they are to be entered, and the clearance as it is then measured.
    array, step = given.project.arrays[0], inches * INCH + 1e-8
    moved = array.model_copy(
        update={"x_from_m": array.x_from_m - step, "x_to_m": array.x_to_m - step}
    )
    between = gap_m(moved.shape, given.project.objects[0].placed)
    row = given.project.clearances[0].model_copy(update={"provided_m": between})
    done = entered(given, changed(given.project, arrays=(moved,), clearances=(row,)))
    assert outcome(done).words(us_first=True) == words


@pytest.mark.quick
def test_where_north_is_turned_a_move_is_along_an_axis_of_the_plan():
    (found,) = of_kind(beside(roof={"north_deg": 60.0}), RemedyKind.SEPARATION)
    assert found.basis.endswith(") toward −x of the plan")


def test_no_move_makes_something_else_ng_or_leaves_the_roof():
    west = unit(18.0, "RTU-2", width=1.0)  # a foot from the other side of the array
    north = unit(20.0, "RTU-3", width=60.0) | {"y_from_m": 76 * FOOT, "y_to_m": 80 * FOOT}
    south = unit(20.0, "RTU-4", width=60.0) | {"y_from_m": 10 * FOOT, "y_to_m": 14 * FOOT}
    given = beside(objects=[west, north, south])
    (found,) = of_kind(given, RemedyKind.SEPARATION)
    assert not found.exists
    assert found.outcome is None
    assert "no move of one array along an axis of the plan" in found.basis
    given = beside(roof=ROOF | {"x_from_m": 19 * FOOT})
    for found in of_kind(given, RemedyKind.SEPARATION):
        assert "west" not in found.basis


def test_an_object_without_a_place_in_plan_needs_the_separation_alone():
    nowhere = {"x_from_m": None, "x_to_m": None, "y_from_m": None, "y_to_m": None}
    given = scenes.package(
        arrays=[ARRAY("A1", 0.5)],
        objects=[unit(101.0) | nowhere],
        clearances=[GAP("A1", "RTU-1", FOOT)],
    ).assessment
    (found,) = of_kind(given, RemedyKind.SEPARATION)
    assert found.basis.endswith(") more")
    assert found.outcome.gap.provided_m >= found.outcome.gap.required_m == found.value


def test_of_many_clearances_the_worst_have_remedies_and_the_summary_says_so():
    count = MOST_GAPS + 2
    units = [
        stand_in.roof_object(f"U{k}", "fixed object", 100.5 + 0.1 * k, 103, 16 + 4 * k, 18 + 4 * k)
        for k in range(count)
    ]
    gaps = [GAP("A1", f"U{k}", (0.5 + 0.1 * k) * FOOT) for k in range(count)]
    beside = scenes.package(arrays=[ARRAY("A1", 0.5)], objects=units, clearances=gaps)
    found = of_kind(beside.assessment, RemedyKind.SEPARATION)
    assert [one.clearance for one in found] == list(range(1, MOST_GAPS + 1))
    said = f"Of {count} clearances that are NG, the {MOST_GAPS} with the largest D/C."
    assert said in printed(beside, "summary")


def test_friction_is_assessed_as_entered_and_not_beyond_its_tests():
    options = {"options": PEER, "roof": {}, "x": 100.3}
    free = beside(mu=0.3, **options)
    assert not free.clearances[0].ok
    (found,) = of_kind(free, RemedyKind.FRICTION)
    assert found.verified[1] == 1.5
    low = found.value - 0.02
    tests = [{"surface": surface, "number": k, "mu": round(low, 2)}
             for surface in ("wet", "dry") for k in (1, 2, 3)]  # fmt: skip
    (bound,) = of_kind(beside(mu=0.3, friction_runs=tests, **options), RemedyKind.FRICTION)
    assert not bound.exists
    assert f"no coefficient up to {round(low, 2):g}, the most that its tests give" in bound.basis
    arrays = tuple(with_mu(row, found.value) for row in free.project.arrays)
    fresh = stand_in.assess_input(changed(free.project, arrays=arrays), scenes.motions())
    assert found.outcome == outcome(fresh)
    assert found.outcome.verdict is not Verdict.NG


@pytest.mark.quick
def test_peer_review_is_offered_where_it_removes_a_floor_that_governs_and_only_there():
    given = beside(x=102.5)
    (found,) = of_kind(given, RemedyKind.REVIEW)
    (item,) = given.arrays
    assert found.given == item.floor_m == item.design_m
    assert found.value == item.analysis.value_m
    reviewed = beside(x=102.5, options=PEER)
    assert found.outcome.gap.required_m == reviewed.clearances[0].required_m
    assert not of_kind(reviewed, RemedyKind.REVIEW)
    assert not of_kind(beside(x=150.0), RemedyKind.REVIEW)  # nothing is NG


def test_a_later_review_is_offered_anew_and_the_best_remedy_is_not_ng():
    day = inputs.HEAD["date"]
    of_others = {"peer_date": day, "peer_covered": f"{day}: Arrays 000000"}
    given = beside(x=102.5, options=PEER | of_others)
    (found,) = of_kind(given, RemedyKind.REVIEW)
    (item,) = given.arrays
    assert (found.given, found.value) == (item.floor_m, item.analysis.value_m)
    given = beside(x=102.5)
    (best,) = best_remedy(given)
    assert best.outcome.verdict.is_permitted
    assert best in remedies(given)
    assert best_remedy(beside(x=150.0)) == ()


def test_terminal_and_page_name_it_after_the_reasons():
    given = beside()
    lines = list(summary(given))
    at = next(k for k, line in enumerate(lines) if line.startswith("remedy: "))
    assert lines[at] == f"remedy: {best_words(given)}"
    assert lines[at - 1].startswith("NG: ")
    assert "A1 moved " in lines[at]
    assert not any(line.startswith("remedy") for line in summary(beside(x=150.0)))
    assert best_words(given) in printed(scenes.package_data(given), "summary")


@pytest.mark.quick
def test_attachment_has_its_force_where_its_factors_are_given():
    site = inputs.SITE | {"force_factor": 1.0, "force_divisor": 1.5}
    given = beside(site=site)
    weight = given.project.arrays[0].weight_n
    ratio = 0.4 * 1.0 * given.project.site.s_ds * (1 + 2 * given.project.site.z_over_h) / 1.5
    text = attachment(given)
    assert text.startswith("Positive attachment of A1, by others, for F_p = ")
    pounds = math.ceil(ratio * weight / 4.4482216152605)
    assert f"A1 {pounds} lb (" in text
    assert "give a_p and R_p on the sheet Site" in attachment(beside())
    assert attachment(beside(x=150.0)) == ""
