"""Cases of a parametrized test that run with `./roofslip test --nightly` alone."""

import pytest


def nightly(case):
    """Return a case, marked; a tuple is of several arguments."""
    values = case if isinstance(case, tuple) else (case,)
    return pytest.param(*values, marks=pytest.mark.nightly)


def by_day(cases, n):
    """Return the cases with all but n, evenly spaced, marked."""
    cases = list(cases)
    kept = {k * len(cases) // n for k in range(n)}
    return [case if k in kept else nightly(case) for k, case in enumerate(cases)]
