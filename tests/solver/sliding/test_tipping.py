"""Tipping, against closed forms: pulses of known demand over supports of known slenderness."""

import math

import numpy as np
import pytest

from blocks import block
from solver.model import Friction, InputError
from solver.sliding.uplift import Supports, tipping

pytestmark = pytest.mark.quick

G = 10.0


def scene(ax_g, *, slope=0.0, mu=0.5, ay_g=(), az_g=()):
    records = (G * np.array(a) for a in (ax_g, ay_g, az_g))
    return block(*records, slope=slope, friction=mu, g=G)


STOCKY = Supports(height_m=0.5, spacing_m=2.0)
SLENDER = Supports(height_m=1.0, spacing_m=0.5)


def friction(mu_fast, rate, mu_static):
    return Friction(mu_slow=0.2, mu_fast=mu_fast, rate_s_per_m=rate, mu_static=mu_static)


@pytest.mark.parametrize(
    ("ax_g", "mu", "at_rest", "sliding", "governs"),
    [
        ([0.0, 0.3, -0.1, 0.0], 0.5, 1.2, 0.0, "at rest"),  # held by friction: by its demand
        ([0.0, 1.0, 0.0], friction(0.2, 0.0, 0.3), 1.2, 0.8, "at rest"),
        ([0.0, 1.0, 0.0], friction(0.4, 20.0, 0.2), 0.8, 1.6, "sliding"),
        ([0.0, 1.0, 0.0], friction(0.4, 0.0, 0.2), 0.8, 0.8, "at rest"),  # grows at no speed
    ],
)
def test_the_larger_of_rest_and_sliding_governs(ax_g, mu, at_rest, sliding, governs):
    tips = tipping(scene(ax_g, mu=mu), SLENDER)
    assert tips.capacity == 0.25
    assert tips.demand == pytest.approx(max(ax_g), rel=1e-15)
    assert (tips.at_rest_ratio, tips.sliding_ratio) == (at_rest, sliding)
    assert (tips.governs, tips.is_ok) == (governs, at_rest < 1.0 and sliding < 1.0)


@pytest.mark.parametrize("peak_g", [0.6, 2.0, 50.0])
def test_a_block_that_slides_cannot_be_given_more_than_friction(peak_g):
    tips = tipping(scene([0.0, -peak_g, 0.0]), STOCKY)
    assert tips.demand == pytest.approx(peak_g, rel=1e-15)
    assert tips.at_rest_ratio == tips.sliding_ratio == 0.25
    assert tips.is_ok


def test_tipping_has_the_slenderness_the_slope_and_the_resultant():
    for mu, ok in ((0.2499, True), (0.25, True), (0.2501, False)):
        assert tipping(scene([0.0, 5.0, 0.0], mu=mu), SLENDER).is_ok == ok
    tips = tipping(scene([0.0, -0.4, 0.0], slope=0.1, mu=2.0), STOCKY)
    assert tips.demand == pytest.approx(math.tan(0.1 + math.atan(0.4)), rel=1e-14)
    tips = tipping(scene([0.0, 0.3], ay_g=[0.0, 0.4], az_g=[0.0, -0.5], mu=2.0), STOCKY)
    assert tips.demand == pytest.approx(1.0, rel=1e-14)
    tips = tipping(scene([0.0, 0.0], az_g=[0.0, -1.5]), STOCKY)
    assert tips.demand == math.inf
    assert tips.ratio == 0.25


@pytest.mark.parametrize("slope", [0.0, 0.1, 0.3, -0.2])
def test_on_a_slope_at_rest_it_tips_when_its_weight_leaves_its_supports(slope):
    tips = tipping(scene([0.0, 0.0], slope=slope, mu=2.0), STOCKY)
    assert tips.demand == pytest.approx(abs(math.tan(slope)), rel=1e-14)
    edge = tipping(scene([0.0, 0.0], slope=math.atan(0.25) + 1e-9, mu=2.0), SLENDER)
    assert edge.ratio > 1.0 > edge.ratio - 1e-8


def test_lengths_that_cannot_be_are_named_together():
    with pytest.raises(InputError) as caught:
        tipping(scene([0.0, 0.0]), Supports(height_m=0.0, spacing_m=math.nan))
    assert [line.split()[0] for line in caught.value.problems] == ["height_m", "spacing_m"]
