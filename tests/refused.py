"""What is said of an input that is refused."""

import pytest

from solver.model import InputError


def refused(call, *arguments, **options):
    """Return the problems of the error with which a call refuses its arguments."""
    with pytest.raises(InputError) as caught:
        call(*arguments, **options)
    return caught.value.problems
