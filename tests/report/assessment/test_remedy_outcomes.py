"""A remedy is entered, checked and assessed before it is printed, with what comes of it."""

import math

import pytest

import inputs
import scenes
import stand_in
from printed import printed
from report.assessment.assess import changed, entered
from report.assessment.causes import outcome
from report.assessment.remedies import MOST_GAPS, RemedyKind, best_remedy, remedies
from report.assessment.trials import with_mu
from report.assessment.verdict import Verdict
from report.pages.inputs import attachment
from report.pages.summary import best_words, summary
from report.sheet.schema.shapes import gap_m

FOOT, INCH, ARRAY, GAP = stand_in.FOOT, stand_in.INCH, stand_in.array, stand_in.clearance
ROOF = {"x_from_m": 0.0, "x_to_m": 400 * FOOT, "y_from_m": 0.0, "y_to_m": 400 * FOOT}
PEER = {"peer_reviewed": True}


def unit(x, name="RTU-1", width=5.0):
    """A fixed object to the east of the array A1, which ends at 100 ft."""
    return stand_in.roof_object(name, "fixed object", x, x + width, 35, 42, height=1.0)


def made(x=101.0, mu=0.45, *, objects=(), roof=ROOF, options=None, **changes):
    """One array, one object x ft from its axis and the clearance between the two."""
    return scenes.package(
        arrays=[ARRAY("A1", 0.5, mu=mu)],
        objects=[unit(x), *objects],
        clearances=[GAP("A1", "RTU-1", (x - 100.0) * FOOT)],
        roof=roof,
        options=options or {},
        **changes,
    ).assessment


def of(given, kind):
    return [one for one in remedies(given) if one.kind is kind]


@pytest.mark.quick
def test_an_array_is_moved_where_the_plan_has_room_and_everything_is_checked_again():
    given = made()
    (gap,) = given.clearances
    assert gap.verdict is Verdict.NG
    (found,) = of(given, RemedyKind.SEPARATION)
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


def test_no_move_makes_something_else_ng_or_leaves_the_roof():
    west = unit(18.0, "RTU-2", width=1.0)  # a foot from the other side of the array
    north = unit(20.0, "RTU-3", width=60.0) | {"y_from_m": 76 * FOOT, "y_to_m": 80 * FOOT}
    south = unit(20.0, "RTU-4", width=60.0) | {"y_from_m": 10 * FOOT, "y_to_m": 14 * FOOT}
    given = made(objects=[west, north, south])
    (found,) = of(given, RemedyKind.SEPARATION)
    assert not found.exists
    assert found.outcome is None
    assert "no move of one array along an axis of the plan" in found.basis
    given = made(roof=ROOF | {"x_from_m": 19 * FOOT})
    for found in of(given, RemedyKind.SEPARATION):
        assert "west" not in found.basis


def test_an_object_without_a_place_in_plan_needs_the_separation_alone():
    nowhere = {"x_from_m": None, "x_to_m": None, "y_from_m": None, "y_to_m": None}
    given = scenes.package(
        arrays=[ARRAY("A1", 0.5)],
        objects=[unit(101.0) | nowhere],
        clearances=[GAP("A1", "RTU-1", FOOT)],
    ).assessment
    (found,) = of(given, RemedyKind.SEPARATION)
    assert found.basis.endswith(") more")
    assert found.outcome.gap.provided_m >= found.outcome.gap.required_m == found.value


def test_of_many_clearances_the_worst_have_remedies_and_the_summary_says_so():
    count = MOST_GAPS + 2
    units = [
        stand_in.roof_object(f"U{k}", "fixed object", 100.5 + 0.1 * k, 103, 16 + 4 * k, 18 + 4 * k)
        for k in range(count)
    ]
    gaps = [GAP("A1", f"U{k}", (0.5 + 0.1 * k) * FOOT) for k in range(count)]
    made = scenes.package(arrays=[ARRAY("A1", 0.5)], objects=units, clearances=gaps)
    found = of(made.assessment, RemedyKind.SEPARATION)
    assert [one.clearance for one in found] == list(range(1, MOST_GAPS + 1))
    said = f"Of {count} clearances that are NG, the {MOST_GAPS} with the largest D/C."
    assert said in printed(made, "summary")


TESTED = [
    {"surface": surface, "number": k, "mu": 0.5, "mu_static": None, "velocity_mps": None}
    for surface in ("wet", "dry")
    for k in (1, 2, 3)
]


def test_friction_is_assessed_as_entered_and_not_beyond_its_tests():
    options = {"options": PEER, "roof": {}, "x": 100.3}
    free = made(mu=0.3, **options)
    if free.clearances[0].ok:
        pytest.fail("the clearance must be short")
    (found,) = of(free, RemedyKind.FRICTION)
    assert found.exists
    assert found.verified[1] == 1.5
    low = found.value - 0.02
    tests = [row | {"mu": round(low, 2)} for row in TESTED]
    (bound,) = of(made(mu=0.3, friction_runs=tests, **options), RemedyKind.FRICTION)
    assert not bound.exists
    assert f"no coefficient up to {round(low, 2):g}, the most that its tests give" in bound.basis
    given = made(mu=0.3, options=PEER, roof={}, x=100.3)
    (found,) = of(given, RemedyKind.FRICTION)
    arrays = tuple(with_mu(row, found.value) for row in given.project.arrays)
    fresh = stand_in.assess_input(changed(given.project, arrays=arrays), scenes.motions())
    assert found.outcome == outcome(fresh)
    assert found.outcome.verdict is not Verdict.NG


@pytest.mark.quick
def test_peer_review_is_offered_where_it_removes_a_floor_that_governs_and_only_there():
    given = made(x=102.5)
    (found,) = of(given, RemedyKind.REVIEW)
    (item,) = given.arrays
    assert found.given == item.floor_m == item.design_m
    assert found.value == item.analysis.value_m
    reviewed = made(x=102.5, options=PEER)
    assert found.outcome.gap.required_m == reviewed.clearances[0].required_m
    assert not of(reviewed, RemedyKind.REVIEW)
    assert not of(made(x=150.0), RemedyKind.REVIEW)  # nothing is NG


def test_a_later_review_is_offered_anew_and_the_best_remedy_is_not_ng():
    day = inputs.HEAD["date"]
    of_others = {"peer_date": day, "peer_covered": f"{day}: Arrays 000000"}
    given = made(x=102.5, options=PEER | of_others)
    (found,) = of(given, RemedyKind.REVIEW)
    (item,) = given.arrays
    assert (found.given, found.value) == (item.floor_m, item.analysis.value_m)
    given = made(x=102.5)
    (best,) = best_remedy(given)
    assert best.outcome.verdict.is_permitted
    assert best in remedies(given)
    assert best_remedy(made(x=150.0)) == ()


def test_terminal_and_page_name_it_after_the_reasons(monkeypatch):
    monkeypatch.setattr("report.pages.summary.what_is_new", lambda book: [])
    given = made()
    lines = list(summary(given))
    at = next(k for k, line in enumerate(lines) if line.startswith("remedy: "))
    assert lines[at] == f"remedy: {best_words(given)}"
    assert lines[at - 1].startswith("NG: ")
    assert "A1 moved " in lines[at]
    assert not any(line.startswith("remedy") for line in summary(made(x=150.0)))
    assert best_words(given) in printed(scenes.package_data(given), "summary")


@pytest.mark.quick
def test_attachment_has_its_force_where_its_factors_are_given():
    site = inputs.SITE | {"force_factor": 1.0, "force_divisor": 1.5}
    given = made(site=site)
    weight = given.project.arrays[0].weight_n
    ratio = 0.4 * 1.0 * given.project.site.s_ds * (1 + 2 * given.project.site.z_over_h) / 1.5
    text = attachment(given)
    assert text.startswith("Positive attachment of A1, by others, for F_p = ")
    pounds = math.ceil(ratio * weight / 4.4482216152605)
    assert f"A1 {pounds} lb (" in text
    assert "give a_p and R_p on the sheet Site" in attachment(made())
    assert attachment(made(x=150.0)) == ""
