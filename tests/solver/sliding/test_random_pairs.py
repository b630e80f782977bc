"""A seeded part of the campaign of two axes: none hangs or crashes, all keep to their bounds."""

import os

import numpy as np
import pytest

from campaign import campaign, run_pair
from solver.verification import random_pairs
from solver.verification.random_pairs import KINDS, pair

COUNT = 560
"""Pairs of each kind: some 10,000 runs in all."""


@pytest.fixture(scope="module")
def ended():
    return campaign(run_pair, [(kind, index) for kind in KINDS for index in range(COUNT)])


def test_no_run_hangs_or_crashes_or_has_no_answer(ended):
    assert len(ended) == COUNT * len(KINDS)
    assert [one for one in ended if one.trouble] == []


@pytest.mark.parametrize("kind", KINDS)
def test_no_pair_differs_by_more_than_its_bounds(ended, kind):
    found = [one for one in ended if one.arguments[0] == kind]
    assert max(one.outcome.ratio for one in found) <= 1.0
    # The bounds say something, and most blocks slide.
    slid = [one.outcome for one in found if one.outcome.prd_m > 1e-6]
    assert len(slid) > 0.5 * COUNT
    if kind not in random_pairs.UNBOUNDED:
        assert np.median([one.bound_m / one.prd_m for one in slid]) < 1e-3


def test_a_pair_is_the_same_each_time():
    for kind in KINDS:
        one, again = pair(kind, 7), pair(kind, 7)
        np.testing.assert_array_equal(one.two.ax_mps2, again.two.ax_mps2)
        assert one.tolerances == again.tolerances


def test_a_wrong_answer_is_found(monkeypatch):
    true = random_pairs.follow

    def off(scene, tolerance):
        found = true(scene, tolerance)
        # As if an extreme had been missed by a ten thousandth.
        return random_pairs.replace(found, down_m=found.down_m * (1.0 + 1e-4 * tolerance))

    monkeypatch.setattr(random_pairs, "follow", off)
    ratios = [pair("two tolerances", index).run().ratio for index in range(200)]
    assert max(ratios) > 1.0


def sometimes(number):
    """Return a number; 3 takes for ever, 5 raises, 7 ends the process."""
    while number == 3:
        pass
    if number == 7:
        os._exit(1)
    return number if number != 5 else 1 // 0


def test_a_call_that_hangs_crashes_or_dies_is_told_and_the_others_are_kept():
    found = campaign(sometimes, [(number,) for number in range(9)], limit_s=0.5, prepare=dict)
    assert [one.arguments for one in found] == [(number,) for number in range(9)]
    troubles = {one.arguments[0]: one.trouble for one in found if one.trouble}
    assert troubles.keys() == {3, 5, 7}
    assert "ZeroDivisionError" in troubles[5]
    assert [one.outcome for one in found if not one.trouble] == [0, 1, 2, 4, 6, 8]
