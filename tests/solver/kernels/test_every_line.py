"""Every line of a kernel is run by its own tests, with numba's compiler off."""

from pathlib import Path

import pytest

from uncompiled import assert_every_line_runs

RUN_BY = {
    "fixed_steps": "test_fixed_steps.py",
    "fragility": "test_fragility_kernel.py",
    "one_axis": "test_one_axis_kernel.py",
    "oscillator": "test_one_axis_kernel.py",
    "rivals": "test_rivals_kernel.py",
    "row": "test_row_kernel.py",
}
"""That of two axes is in `test_two_axes_kernel.py`."""


@pytest.mark.parametrize(
    "name",
    [pytest.param(n, marks=pytest.mark.nightly(f"solver/kernels/{n}.py")) for n in RUN_BY],
)
def test_every_line_of_a_kernel_is_run_with_the_compiler_off(tmp_path, name):
    tests = Path(__file__).with_name(RUN_BY[name])
    assert_every_line_runs(f"solver/kernels/{name}.py", tests, tmp_path)
