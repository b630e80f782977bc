import math

import numpy as np
import pytest

from report.web.views import beside, peaks_kept

pytestmark = pytest.mark.quick


def test_thinning_keeps_the_extremes_of_each_part_and_no_more_than_asked():
    noise = np.random.default_rng(3).normal(size=10_007)
    noise[77] = math.nan
    at = peaks_kept(noise, 1000)
    assert len(at) <= 1000
    size = math.ceil(10_007 / 499)
    for start in range(0, 10_007, size):
        part = noise[start : start + size]
        assert {start + np.nanargmin(part), start + np.nanargmax(part)} <= set(at.tolist())
    assert peaks_kept(noise, 10_007).tolist() == list(range(10_007))
    assert peaks_kept(np.full(5000, math.nan), 3000).max() < 5000


def test_samples_beside_times_lie_within_the_record():
    assert beside(np.array([0.0, 0.26, 0.9999]), 0.1, 10).tolist() == [0, 1, 2, 3, 9]
    assert beside(np.array([]), 0.1, 10).tolist() == []
