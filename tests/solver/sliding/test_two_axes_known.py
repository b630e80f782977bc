"""Short scenes in two axes whose motion is known: cheap enough to run with the compiler off.

`tests/data/known_motions.json` has the motions as `plane_oracle` gave them; a nightly test follows
them again.
"""

import json
import math
from functools import cache

import numpy as np
import pytest

import plane_oracle
from blocks import block
from places import DATA
from solver.model import EventKind, Friction
from solver.sliding.two_axes import follow, follow_history

pytestmark = pytest.mark.quick

SCENES = {row["name"]: row for row in json.loads((DATA / "known_motions.json").read_text("utf-8"))}

ORACLE = 2e-12
"""Error that the oracle itself makes / the largest distance."""

TOLERANCES = (1e-2, 1e-6, 1e-10)


def scene(name):
    row = SCENES[name]
    return block(
        *(row[axis] for axis in ("ax_mps2", "ay_mps2", "az_mps2")),
        dt=row["dt_s"],
        slope=math.radians(row["slope_deg"]),
        friction=Friction(**row["friction"]),
        scale=row["scale"],
    )


@cache
def followed(name, tolerance):
    return follow(scene(name), tolerance)


def places(outcome):
    sides = outcome.down_m, -outcome.up_m, outcome.left_m, -outcome.right_m
    return np.array([outcome.prd_m, *sides, *outcome.end_m])


@pytest.mark.parametrize("name", SCENES)
def test_the_motion_is_the_known_one_within_its_error_at_no_more_steps(name):
    known, is_bounded = SCENES[name]["known"], scene(name).friction.is_monotone
    prd_m = known["prd_m"]
    wanted = np.array([prd_m, *known["sides_m"], *known["end_m"]])
    for tolerance, most_steps in zip(TOLERANCES, SCENES[name]["most_steps"], strict=True):
        outcome = followed(name, tolerance)
        error = np.abs(places(outcome) - wanted).max()
        assert error <= outcome.error_m + ORACLE * prd_m
        assert error <= (tolerance + ORACLE) * prd_m
        if is_bounded:
            assert outcome.error_m <= tolerance * max(prd_m, 1e-6)
        assert outcome.peak_mps == pytest.approx(known["peak_mps"], rel=tolerance + ORACLE)
        assert outcome.n_stops == known["n_stops"] or tolerance == TOLERANCES[0]
        # What a tolerance costs; the last digit of an exponential may cost a step more.
        assert outcome.n_steps <= 1.05 * most_steps


@pytest.mark.parametrize("name", SCENES)
def test_the_history_and_its_events_are_the_known_ones(name):
    known, outcome = SCENES[name]["known"], followed(name, TOLERANCES[-1])
    samples, events = follow_history(scene(name), outcome)
    allowed = outcome.error_m + ORACLE * known["prd_m"]
    assert np.abs(samples[:2] - known["samples"][:2]).max() <= allowed
    assert np.abs(samples[2:] - known["samples"][2:]).max() <= 1e-9 * known["peak_mps"]
    assert outcome.t_prd_s == pytest.approx(known["t_prd_s"], abs=1e-7)
    found = np.array([(e.t_s, e.u_m, e.across_m) for e in events]).reshape(-1, 3)
    wanted = np.array(known["events"]).reshape(-1, 3)
    assert found.shape == wanted.shape
    assert found[:, 0] == pytest.approx(wanted[:, 0], abs=1e-7)
    assert np.abs(found[:, 1:] - wanted[:, 1:]).max(initial=0.0) <= allowed
    kinds = [event.kind for event in events]
    assert kinds == [EventKind.SLIP, EventKind.STOP] * outcome.n_stops + [EventKind.SLIP] * (
        len(events) % 2
    )
    assert outcome.n_events == len(events)


@pytest.mark.nightly
@pytest.mark.parametrize("name", SCENES)
def test_the_known_motions_are_those_of_the_oracle(name):
    found, known = plane_oracle.follow(scene(name)), SCENES[name]["known"]
    assert found.prd == pytest.approx(known["prd_m"], rel=ORACLE)
    assert found.fastest == pytest.approx(known["peak_mps"], rel=ORACLE)
    assert found.n_stops == known["n_stops"]
    assert np.array(found.events) == pytest.approx(np.array(known["events"]), abs=1e-9)
    assert found.history == pytest.approx(np.array(known["samples"]), abs=1e-9)
