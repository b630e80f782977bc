"""The public names of the solver are there, and cost nothing before one is asked for."""

import subprocess
import sys

import numpy as np
import pytest

import solver
from solver import public


def test_every_public_name_is_one_of_the_solver():
    for name in public.__all__:
        assert getattr(solver, name) is getattr(public, name), name


def test_a_name_that_is_not_public_is_no_attribute():
    with pytest.raises(AttributeError):
        _ = solver.slope
    with pytest.raises(ImportError):
        from solver import slope  # noqa: F401


def test_kernels_are_loaded_with_the_first_name_and_scipy_is_not():
    program = (
        "import sys, solver.model; assert 'numba' not in sys.modules; "
        "from solver import slide; assert 'numba' in sys.modules; "
        "assert 'scipy.integrate' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", program], check=True, timeout=60)


def test_names_of_the_former_version_are_known_with_a_warning():
    with pytest.warns(DeprecationWarning, match="solver.Model"):
        assert solver.Rung is solver.Model
    solution = solver.solve(solver.scene(np.zeros(3), 0.01, slope_rad=0.0, mu=0.4))
    with pytest.warns(DeprecationWarning, match="Solution.model"):
        assert solution.rung is solution.model
