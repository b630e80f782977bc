"""Samples far above all others. Oracle: records made by hand."""

import numpy as np
import pytest

from report.motions.components import FACTOR, spikes

pytestmark = pytest.mark.quick


def sine(count=1000):
    return np.sin(0.1 * np.arange(count))


def test_only_few_samples_above_the_factor_are_spikes():
    assert spikes(sine())[0] == ()
    assert spikes(np.random.default_rng(1).normal(size=3000))[0] == ()
    assert spikes(np.zeros(1000)) == ((), 0.0)
    a = sine()
    a[100:111] = 99.99
    assert spikes(a)[0] == ()
    assert spikes(np.array([*np.ones(98), 99.99]))[0] == ()
    assert spikes(np.array([*np.ones(99), 99.99])) == ((99,), 1.0)
    assert spikes(np.array([*np.ones(99), FACTOR]))[0] == ()
    assert spikes(np.array([*np.ones(99), np.nextafter(FACTOR, 9.0)]))[0] == (99,)


@pytest.mark.parametrize("at", [(0,), (999,), (3, 500), tuple(range(100, 110))])
def test_spikes_of_either_sign_are_found(at):
    a = sine()
    a[list(at)] = [99.99 * (-1) ** i for i in at]
    others = np.delete(a, at)
    assert spikes(a) == (at, float(np.abs(others).max()))
