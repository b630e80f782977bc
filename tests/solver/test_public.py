"""The public names of the solver are there, and cost nothing before one is asked for."""

import subprocess
import sys

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
