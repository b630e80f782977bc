"""Outside judges: left out where they are not installed, and a hole with its reason on failure."""

import importlib.util
import math

import pytest

from solver.verification import peers
from solver.verification.scenes import near_fault_pulse
from solver.verification.workprecision import run

RECORD = near_fault_pulse()


def peer(prd_m, module="math"):
    return peers.Peer(name="Judge", module=module, package="none", note="as is", prd_m=prd_m)


def points(monkeypatch, *judges):
    monkeypatch.setattr(peers, "PEERS", judges)
    return list(peers.peer_points([RECORD], quick=True))


def test_a_peer_that_is_not_installed_is_left_out(monkeypatch):
    assert points(monkeypatch, peer(lambda *_: 1.0, module="no_such_module")) == []


def test_a_peer_gets_the_scaled_record_and_its_error_is_of_the_exact_prd(monkeypatch):
    def one_percent_off(a, dt_s, case):
        assert abs(a).max() == pytest.approx(case.ppa_g * 9.80665)
        assert dt_s == RECORD.dt_s
        return 1.01 * run(RECORD, case, "exact", {}).prd_m

    found = points(monkeypatch, peer(one_percent_off))
    assert [point.prd_error_percent for point in found] == pytest.approx([1.0, 1.0])
    assert all(point.seconds > 0.0 and point.version == "unknown" for point in found)


def test_a_peer_that_raises_or_gives_up_is_a_hole_with_its_reason(monkeypatch):
    def broken(*_):
        raise RuntimeError("no library")

    found = points(monkeypatch, peer(broken), peer(lambda *_: math.nan))
    assert len(found) == 4
    assert all(math.isnan(p.seconds) and math.isnan(p.prd_error_percent) for p in found)
    assert [point.note for point in found[::2]] == [
        "RuntimeError: no library",
        "It did not converge. as is",
    ]


@pytest.mark.parametrize("name", [judge.name for judge in peers.PEERS])
def test_a_peer_that_is_installed_comes_near_the_exact_prd(monkeypatch, name):
    judge = next(judge for judge in peers.PEERS if judge.name == name)
    if importlib.util.find_spec(judge.module) is None:
        pytest.skip(f"{judge.package} is not installed")
    # One-way sliding leaves out what comes back, which in a pulse is half of it.
    ceiling = 100.0 if name == "pySLAMMER" else 2.0
    assert all(p.prd_error_percent < ceiling for p in points(monkeypatch, judge))
