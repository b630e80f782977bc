"""Target spectra of motions at the roof and on the ground."""

import math
import pickle

import numpy as np
import pytest

import stand_in
from report.motions.history import ac156, targets
from report.sheet.schema.choices import RecordedAt
from solver.rules.hazard import EDITIONS
from solver.rules.spectra import Tail, ac156_horizontal, ac156_vertical

pytestmark = pytest.mark.quick

POINTS = [(0.05, 1.0, 0.5), (0.5, 2.0, 0.8), (4.0, 0.2, 0.1)]
PERIODS = np.array([0.04, 0.05, 0.3, 0.5, 1.0, 4.0, 5.0])


ON_GROUND = [{"id": "M1", "record": "records/m1-x.csv", "recorded_at": "ground"}]


def made(**changes):
    return targets(stand_in.project(**{"spectrum": []} | changes))


def own(*, with_vertical=True):
    return [
        {"period_s": t, "horizontal_g": h, "vertical_g": v if with_vertical else None}
        for t, h, v in reversed(POINTS)
    ]


def across_of(tail):
    return ac156_horizontal(EDITIONS["ASCE 7-16"], s_ds_g=1.566, z_over_h=1.0, **tail)


def test_at_the_roof_the_target_is_that_of_the_rule_set():
    goals, across = made(), across_of({})
    upward = ac156_vertical(s_ds_g=1.566)
    inside = PERIODS[PERIODS <= 10.0]
    assert goals.roof.name == "AC156"
    assert np.array_equal(goals.roof.ordinates(inside), across.at(1 / inside))
    assert np.array_equal(goals.vertical.ordinates(inside), upward.at(1 / inside))


def test_the_tail_is_chosen_on_the_sheet():
    data = stand_in.project(target={"tail": "1/T"}, spectrum=[])
    wanted = across_of({"tail": Tail.RECIPROCAL})
    assert np.array_equal(ac156(data)[0].sa_g, wanted.sa_g)
    assert np.array_equal(targets(data).roof.at(np.array([0.2])), wanted.at(np.array([0.2])))


def test_with_roof_motions_the_project_spectrum_applies_at_the_roof():
    goals = made(spectrum=own())
    assert goals.roof.name == goals.vertical.name == "project-specific"
    for t, across, upward in POINTS:
        assert goals.roof.ordinates(np.array([t])) == pytest.approx([across])
        assert goals.vertical.ordinates(np.array([t])) == pytest.approx([upward])
    # Interpolated on log-log axes, and undefined beyond.
    middle = math.sqrt(0.5 * 4.0)
    assert goals.roof.ordinates(np.array([middle])) == pytest.approx([math.sqrt(2.0 * 0.2)])
    assert np.isnan(goals.roof.ordinates(PERIODS)).tolist() == [True, *[False] * 5, True]


def test_without_a_vertical_column_the_vertical_of_ac156_applies():
    goals = made(spectrum=own(with_vertical=False))
    assert (goals.roof.name, goals.vertical.name) == ("project-specific", "AC156")


def test_with_ground_motions_the_project_spectrum_applies_at_the_ground():
    goals = made(spectrum=own(), motions=ON_GROUND)
    assert (goals.roof.name, goals.ground.name) == ("AC156", "project-specific")
    assert goals.horizontal(RecordedAt.GROUND) is goals.ground
    assert goals.horizontal(RecordedAt.ROOF) is goals.roof


def test_on_the_ground_the_target_is_the_design_spectrum_of_asce_7():
    ground = made(motions=ON_GROUND, target={"t_l_s": 8.0}).ground
    s_d1 = 2.0 / 3.0 * 1.7 * 0.70
    wanted = [1.566, s_d1 / 2.0, s_d1 * 8.0 / 10.0**2]
    assert ground.ordinates(np.array([0.3, 2.0, 10.0])) == pytest.approx(wanted)
    assert ground.name == "ASCE 7 design spectrum"


@pytest.mark.parametrize("changes", [{}, {"target": {"t_l_s": 8.0}}, {"spectrum": own()}])
def test_targets_can_be_pickled(changes):
    goals = made(motions=ON_GROUND, **changes)
    handed = pickle.loads(pickle.dumps(goals))
    for name in ("roof", "vertical", "ground"):
        here, there = getattr(goals, name), getattr(handed, name)
        assert np.array_equal(here.ordinates(PERIODS), there.ordinates(PERIODS), equal_nan=True)


def test_without_t_l_there_is_no_target_on_the_ground():
    ground = made(motions=ON_GROUND).ground
    assert ground.name == ""
    assert np.isnan(ground.ordinates(PERIODS)).all()
