"""What a report costs is said before it starts."""

from dataclasses import replace

import numpy as np
import pytest

from places import ROOT
from report.assessment.cost import cost, expected_s
from report.making import make
from sheets import make as make_book
from sheets import read_workbook
from solver.model import InputError


@pytest.fixture(scope="module")
def book(tmp_path_factory):
    return read_workbook(make_book(tmp_path_factory.mktemp("job")))


def lasting(book, samples):
    """The motions of a workbook, as long as given."""
    still = np.zeros(samples)
    motions = tuple(replace(motion, ax_mps2=still) for motion in book.shaking.motions)
    return replace(book.shaking, motions=motions)


def test_a_short_report_says_nothing(book):
    assert cost(book.input, book.shaking) == ""
    assert expected_s(book.input, book.shaking) < 15.0


def test_the_example_is_estimated_as_it_was_measured():
    book = read_workbook(ROOT / "projects" / "example" / "input.xlsx")
    # Processor time of the command: tests/bench/report_cost.py.
    assert expected_s(book.input, book.shaking) == pytest.approx(10.1, rel=0.1)


def test_a_long_report_says_what_makes_it_long(book):
    shaking = lasting(book, 700_000)
    # 6.2 + 2 arrays 0.06 + 3 motions 0.27 + 2.1 million samples (30 + 2 arrays 3.5)
    assert expected_s(book.input, shaking) == pytest.approx(84.83, abs=0.1)
    assert cost(book.input, shaking) == (
        "about 2 minutes of processor time for 2 arrays, 3 motions and 2,100,000 samples"
    )


def test_arrays_cost_runs_where_their_slope_or_friction_differs(book):
    shaking = lasting(book, 100_000)
    given = list(book.input.arrays)

    def more_s(*added):
        more = book.input.model_copy(update={"arrays": [*given, *added]})
        return expected_s(more, shaking) - expected_s(book.input, shaking)

    steeper = given[0].model_copy(update={"slope_value": 1.5})
    assert more_s(*given) == pytest.approx(2 * 0.06)
    assert more_s(steeper) == pytest.approx(0.06 + 0.3 * 3.5)


def test_a_report_says_it_before_the_runs(tmp_path, monkeypatch):
    path = make_book(tmp_path)

    def stopped(*_):
        raise InputError("the runs begin")

    monkeypatch.setattr("report.assessment.assess.assess", stopped)
    monkeypatch.setattr("report.assessment.cost.LONG_S", 1.0)
    said = []
    with pytest.raises(InputError, match="the runs begin"):
        make(path, None, None, said.append)
    cost_words = "about 2 minutes of processor time for 2 arrays, 3 motions and 600 samples"
    assert str(said[-1]) == f"running the motions ({cost_words})"
