"""Outside judges: left out where they are not installed, and a hole with its reason on failure."""

import importlib.util
import math

import pytest

from solver.model import STANDARD_GRAVITY_MPS2
from solver.sliding import one_axis
from solver.verification import peers
from solver.verification.scenes import near_fault_pulse
from solver.verification.triples import own_triples

RECORD = near_fault_pulse()


def peer(prd_m, module="math"):
    return peers.Peer(name="Judge", module=module, note="as is", prd_m=prd_m)


def points(monkeypatch, *judges, one_axis=(), vertical=(), two_axes=(), triples=()):
    monkeypatch.setattr(peers, "ONE_AXIS", (*judges, *one_axis))
    monkeypatch.setattr(peers, "VERTICAL", vertical)
    monkeypatch.setattr(peers, "TWO_AXES", two_axes)
    return list(peers.peer_points([RECORD], triples, quick=True))


def test_a_peer_that_is_not_installed_is_left_out(monkeypatch):
    assert points(monkeypatch, peer(lambda _: 1.0, module="no_such_module")) == []


def test_a_peer_gets_the_scaled_record_and_its_error_is_of_the_exact_prd(monkeypatch):
    peaks = []

    def one_percent_off(scene):
        peaks.append(scene.scale * abs(scene.ax_mps2).max() / STANDARD_GRAVITY_MPS2)
        assert scene.dt_s == RECORD.dt_s
        return 1.01 * one_axis.run(scene).prd_m

    results = points(monkeypatch, peer(one_percent_off))
    assert peaks == pytest.approx([1.0, 1.0])
    assert [point.prd_error_percent for point in results] == pytest.approx([1.0, 1.0])
    assert all(point.seconds > 0.0 and point.version == "unknown" for point in results)
    assert {point.note for point in results} == {"one axis; as is"}


def test_a_peer_that_raises_or_gives_up_is_a_hole_with_its_reason(monkeypatch):
    def broken(_):
        raise RuntimeError("no library")

    results = points(monkeypatch, peer(broken), peer(lambda _: math.nan))
    assert len(results) == 4
    assert all(math.isnan(p.seconds) and math.isnan(p.prd_error_percent) for p in results)
    assert [point.note for point in results[::2]] == [
        "one axis; RuntimeError: no library",
        "one axis; as is; did not converge",
    ]


@pytest.mark.parametrize("judge", peers.ONE_AXIS, ids=lambda judge: f"{judge.name}: {judge.note}")
def test_a_peer_that_is_installed_comes_near_the_exact_prd(monkeypatch, judge):
    if importlib.util.find_spec(judge.module) is None:
        pytest.skip(f"{judge.module} is not installed")
    # One-way sliding leaves out what comes back, which in a pulse is half of it.
    ceiling = 100.0 if judge.name == "pySLAMMER" else 2.0
    assert all(p.prd_error_percent < ceiling for p in points(monkeypatch, judge))


@pytest.mark.parametrize(
    ("kind", "judge"),
    [*(("vertical", judge) for judge in peers.VERTICAL), ("two_axes", peers.TWO_AXES[-1])],
)
def test_with_vertical_and_in_two_axes_they_come_near_too(monkeypatch, kind, judge):
    if importlib.util.find_spec(judge.module) is None:
        pytest.skip(f"{judge.module} is not installed")
    results = points(monkeypatch, triples=own_triples(True), **{kind: (judge,)})
    assert results
    assert all(p.prd_error_percent < 5.0 for p in results)
