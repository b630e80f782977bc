"""A campaign of hostile inputs; `tests/bench/campaigns.py` runs a longer one."""

from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mutations import trouble
from solver.formats import read_motion_file

# 10^4 cases a night: most on the records and the cells.
CASES = {"record": 7300, "cell": 2000, "argument": 500, "part": 150, "book": 50}
made = settings(max_examples=200, derandomize=True)


@pytest.mark.parametrize("share", [0.1, pytest.param(1.0, marks=pytest.mark.nightly)])
@pytest.mark.parametrize("kind", CASES)
def test_hostile_inputs_are_read_or_refused(kind, share):
    seeds = range(round(share * CASES[kind]))
    ended = {seed: told for seed in seeds if (told := trouble(kind, seed))}
    assert ended == {}


@pytest.fixture(scope="module")
def folder():
    with TemporaryDirectory() as name:
        yield Path(name)


@made
@given(
    values=st.lists(
        st.floats(-50.0, 50.0).filter(lambda a: a == 0.0 or abs(a) > 1e-3), min_size=2, max_size=40
    ),
    dt_s=st.sampled_from([0.001, 0.005, 0.01, 0.02]),
)
def test_a_record_of_any_values_comes_back_as_it_was_written(folder, values, dt_s):
    path = folder / "back.csv"
    rows = (f"{i * dt_s!r},{value / 9.80665!r}\n" for i, value in enumerate(values))
    path.write_text("".join(rows))
    (record,) = read_motion_file(path, units="g").channels
    assert record.a_mps2 == pytest.approx(values, rel=1e-14)
    assert record.dt_s == pytest.approx(dt_s, rel=1e-12)
