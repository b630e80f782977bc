"""Tipping, against closed forms: pulses of known demand over supports of known slenderness."""

import math
from dataclasses import replace

import numpy as np
import pytest

from blocks import block
from solver.model import Friction, InputError
from solver.sliding.tipping import Supports, tipping

G = 10.0


def scene(ax_g, *, slope=0.0, mu=0.5, ay_g=(), az_g=()):
    records = (G * np.array(a) for a in (ax_g, ay_g, az_g))
    return block(*records, slope=slope, friction=mu, g=G)


STOCKY = Supports(height_m=0.5, spacing_m=2.0)
SLENDER = Supports(height_m=1.0, spacing_m=0.5)


def test_a_block_that_friction_holds_tips_by_its_demand():
    tips = tipping(scene([0.0, 0.3, -0.1, 0.0]), SLENDER)
    assert tips.capacity == 0.25
    assert tips.demand == pytest.approx(0.3, rel=1e-15)
    assert tips.at_rest_ratio == pytest.approx(1.2, rel=1e-15)
    assert tips.sliding_ratio == 0.0
    assert (tips.governs, tips.is_ok) == ("at rest", False)


@pytest.mark.parametrize("peak_g", [0.6, 2.0, 50.0])
def test_a_block_that_slides_cannot_be_given_more_than_friction(peak_g):
    tips = tipping(scene([0.0, -peak_g, 0.0]), STOCKY)
    assert tips.demand == pytest.approx(peak_g, rel=1e-15)
    assert tips.at_rest_ratio == tips.sliding_ratio == 0.25
    assert tips.is_ok


def test_a_block_slides_before_it_tips_just_where_friction_is_below_its_slenderness():
    for mu, ok in ((0.2499, True), (0.25, True), (0.2501, False)):
        assert tipping(scene([0.0, 5.0, 0.0], mu=mu), SLENDER).is_ok == ok


def test_static_friction_governs_at_the_moment_it_slips():
    law = Friction(mu_slow=0.2, mu_fast=0.2, rate_s_per_m=0.0, mu_static=0.3)
    tips = tipping(scene([0.0, 1.0, 0.0], mu=law), SLENDER)
    assert (tips.at_rest_ratio, tips.sliding_ratio) == (1.2, 0.8)
    assert (tips.governs, tips.is_ok) == ("at rest", False)


def test_friction_that_grows_with_speed_governs_while_it_slides():
    law = Friction(mu_slow=0.2, mu_fast=0.4, rate_s_per_m=20.0, mu_static=0.2)
    tips = tipping(scene([0.0, 1.0, 0.0], mu=law), SLENDER)
    assert (tips.at_rest_ratio, tips.sliding_ratio) == (0.8, 1.6)
    assert tips.governs == "sliding"
    same = scene([0.0, 1.0, 0.0], mu=replace(law, rate_s_per_m=0.0))
    assert tipping(same, SLENDER).sliding_ratio == 0.8


@pytest.mark.parametrize("slope", [0.0, 0.1, 0.3, -0.2])
def test_on_a_slope_at_rest_it_tips_when_its_weight_leaves_its_supports(slope):
    tips = tipping(scene([0.0, 0.0], slope=slope, mu=2.0), STOCKY)
    assert tips.demand == pytest.approx(abs(math.tan(slope)), rel=1e-14)
    edge = tipping(scene([0.0, 0.0], slope=math.atan(0.25) + 1e-9, mu=2.0), SLENDER)
    assert edge.ratio > 1.0 > edge.ratio - 1e-8


def test_shaking_on_a_slope_is_gravity_turned():
    tips = tipping(scene([0.0, -0.4, 0.0], slope=0.1, mu=2.0), STOCKY)
    assert tips.demand == pytest.approx(math.tan(0.1 + math.atan(0.4)), rel=1e-14)


def test_a_second_component_adds_as_a_resultant_and_the_vertical_takes_weight_off():
    tips = tipping(scene([0.0, 0.3], ay_g=[0.0, 0.4], az_g=[0.0, -0.5], mu=2.0), STOCKY)
    assert tips.demand == pytest.approx(1.0, rel=1e-14)


def test_a_block_that_lifts_off_hands_on_no_more_than_friction():
    tips = tipping(scene([0.0, 0.0], az_g=[0.0, -1.5]), STOCKY)
    assert tips.demand == math.inf
    assert tips.ratio == 0.25


def test_lengths_that_cannot_be_are_named_together():
    with pytest.raises(InputError) as caught:
        tipping(scene([0.0, 0.0]), Supports(height_m=0.0, spacing_m=math.nan))
    assert [line.split()[0] for line in caught.value.problems] == ["height_m", "spacing_m"]
