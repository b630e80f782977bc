"""The oscillator against closed forms: a load that steps up stays, and one at rest."""

import math

import numpy as np
import pytest

from blocks import readonly
from solver.kernels import oscillator

pytestmark = pytest.mark.quick


@pytest.mark.parametrize("zeta", [0.0, 0.05, 0.3])
def test_a_sudden_load_overshoots_by_the_textbook_factor(zeta):
    n, dt, omega, load = 100, 0.01, 2.0 * math.pi, 3.0
    peak, at = np.zeros(1), np.zeros(1, dtype=np.int64)
    record = np.full(n, load)
    oscillator.peaks(readonly(record), dt, np.array([omega]), zeta, peak, at)
    kappa = math.sqrt(1.0 - zeta * zeta)
    # A. K. Chopra, Dynamics of Structures: step force, u_max = u_st (1 + exp(-pi zeta / kappa)).
    assert -peak[0] == pytest.approx(load * (1.0 + math.exp(-math.pi * zeta / kappa)), rel=1e-6)
    assert at[0] * dt == pytest.approx(0.5 / kappa, abs=dt)
