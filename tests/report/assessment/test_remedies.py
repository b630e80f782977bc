import numpy as np
import pytest

import scenes
import stand_in
from one_by_one import prd_m, slid
from report.assessment.remedies import RemedyKind, remedies
from report.assessment.trials import above, below, search
from solver.friction_tests import MOST_MU
from solver.model import Friction, Status

PEER = {"peer_reviewed": True}
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
