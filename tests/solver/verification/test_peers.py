"""Outside judges: left out where they are not installed, and a hole with its reason on failure."""

import importlib.util
import math

import pytest

from solver.model import STANDARD_GRAVITY_MPS2
from solver.sliding import one_axis
from solver.verification import peers
from solver.verification.study import CASES, near_fault_pulse, own_triples

pytestmark = pytest.mark.quick

RECORD = near_fault_pulse()


def peer(prd_m, module="math"):
    return peers.Peer(name="Judge", module=module, note="as is", prd_m=prd_m)


def points(*judges, model=peers.ONE_AXIS, triples=()):
    return list(
        peers.peer_points(
            {model: judges}, [(RECORD, case) for case in CASES[:2]], triples, quick=True
        )
    )


def test_a_peer_that_is_not_installed_is_left_out():
    assert points(peer(lambda _: 1.0, module="no_such_module")) == []


def test_a_peer_gets_the_scaled_record_and_its_error_is_of_the_exact_prd():
    peaks = []

    def one_percent_off(scene):
        peaks.append(scene.scale * abs(scene.ax_mps2).max() / STANDARD_GRAVITY_MPS2)
        assert scene.dt_s == RECORD.dt_s
        return 1.01 * one_axis.run(scene).prd_m

    results = points(peer(one_percent_off))
    assert peaks == pytest.approx([1.0, 1.0])
    assert [point.prd_error_percent for point in results] == pytest.approx([1.0, 1.0])
    assert all(point.seconds > 0.0 and point.version == "unknown" for point in results)
    assert {(point.model, point.note) for point in results} == {("one axis", "as is")}


def test_a_peer_that_raises_or_gives_up_is_a_hole_with_its_reason():
    def broken(_):
        raise RuntimeError("no library")

    results = points(peer(broken), peer(lambda _: math.nan))
    assert len(results) == 4
    assert all(math.isnan(p.seconds) and math.isnan(p.prd_error_percent) for p in results)
    assert [point.note for point in results[::2]] == [
        "RuntimeError: no library",
        "as is; did not converge",
    ]


@pytest.mark.parametrize(
    ("model", "judge"),
    [
        *((peers.ONE_AXIS, judge) for judge in peers.JUDGES[peers.ONE_AXIS]),
        *((peers.VERTICAL, judge) for judge in peers.JUDGES[peers.VERTICAL]),
        (peers.TWO_AXES, peers.JUDGES[peers.TWO_AXES][-1]),
    ],
    ids=lambda given: getattr(given, "note", given),
)
def test_a_peer_that_is_installed_comes_near_the_exact_prd(model, judge):
    if importlib.util.find_spec(judge.module) is None:
        pytest.skip(f"{judge.module} is not installed")
    alone = model == peers.ONE_AXIS
    found = points(judge, model=model, triples=() if alone else own_triples(True))
    # One-way sliding leaves out what comes back, which in a pulse is half of it.
    ceiling = 100.0 if judge.module == "pyslammer" else 2.0 if alone else 5.0
    assert found
    assert all(point.prd_error_percent < ceiling for point in found)
