"""A campaign of hostile inputs; `tests/bench/campaigns.py` runs a longer one."""

import contextlib
import math
import re
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import sheets
from mutations import trouble
from report.sheet.reading.archive import open_book
from sheets import make, pack
from solver import InputError, slide
from solver.formats import read_motion_file

# With what Hypothesis makes, 10^4 cases a night: most on the records and the cells.
CASES = {"record": 6700, "cell": 2000, "argument": 500, "part": 150, "book": 50}
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


SEPARATORS = st.sampled_from([",", ";", "\t", " ", ", ", "  "])
WORDS = st.sampled_from(
    ["", "time", "acc (g)", "Unit: g", "dt 0.01", "# note", "nan", "1e999", "-", "NPTS= 3", "x y z"]
)
NUMBERS = st.floats(allow_nan=False, width=32).map(repr) | st.integers(-9, 9).map(str)


@made
@given(
    rows=st.lists(st.lists(NUMBERS | WORDS, min_size=1, max_size=4), max_size=12),
    separator=SEPARATORS,
    head=st.lists(WORDS | st.text(max_size=30), max_size=4),
    end=st.sampled_from(["\n", "\r\n", "\r"]),
)
@pytest.mark.nightly
def test_a_record_of_any_lines_is_read_or_refused(folder, rows, separator, head, end):
    path = folder / "any.csv"
    lines = [*head, *(separator.join(row) for row in rows)]
    path.write_bytes(end.join(lines).encode("utf-8", "replace"))
    with contextlib.suppress(InputError):
        for record in read_motion_file(path, units="g", dt_s=0.01).channels:
            assert np.isfinite(record.a_mps2).all()
            assert 0.0 < record.dt_s < math.inf


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


@pytest.fixture(scope="module")
def parts(folder):
    return sheets.parts(make(folder))


TAGS = st.sampled_from(["c", "row", "v", "f", "is", "t", "mergeCell", "sheet", "Relationship", "x"])
ATTRIBUTES = st.dictionaries(
    st.sampled_from(["r", "t", "s", "ref", "si", "name", "Id", "Target", "r:id", "spans"]),
    st.sampled_from(
        ["A1", "0", "-1", "s", "e", "shared", "A1:XFD1048576", "XFE9", "9" * 30, "", "é"]
    ),
    max_size=3,
)
ELEMENTS = st.recursive(
    st.text('a<&>"0', max_size=5),
    lambda inner: st.tuples(TAGS, ATTRIBUTES, st.lists(inner, max_size=3)),
    max_leaves=8,
)


def written(element):
    if isinstance(element, str):
        return element.replace("&", "&amp;").replace("<", "&lt;")
    tag, attributes, inside = element
    said = "".join(f' {name}="{value}"' for name, value in attributes.items())
    return f"<{tag}{said}>{''.join(map(written, inside))}</{tag}>"


@pytest.mark.parametrize("examples", [10, pytest.param(100, marks=pytest.mark.nightly)])
def test_a_workbook_with_any_elements_in_a_part_is_opened_or_refused(folder, parts, examples):
    @settings(made, max_examples=examples, suppress_health_check=[HealthCheck.too_slow])
    @given(data=st.data())
    def opened_or_refused(data):
        name = data.draw(st.sampled_from(sorted(parts)))
        added, content = written(data.draw(ELEMENTS)).encode(), parts[name]
        ends = [found.start() for found in re.finditer(b"<", content)] or [0]
        at = ends[data.draw(st.integers(0, len(ends) - 1))]
        changed = {name: content[:at] + added + content[at:]}
        with contextlib.suppress(InputError):
            open_book(pack(folder / "any.xlsx", parts | changed))

    opened_or_refused()


@made
@given(
    a_mps2=st.lists(st.floats(-1e3, 1e3) | st.floats(), max_size=6),
    dt_s=st.floats(1e-4, 1.0) | st.floats(),
    slope_rad=st.floats(-1.5, 1.5) | st.floats(),
    mu=st.floats(0.0, 2.0) | st.floats(),
    scale=st.floats(0.0, 5.0) | st.floats(),
)
@pytest.mark.quick
def test_a_run_of_any_numbers_is_finite_or_says_why_not(a_mps2, dt_s, slope_rad, mu, scale):
    with contextlib.suppress(InputError):
        result = slide(a_mps2, dt_s, slope_rad=slope_rad, mu=mu, scale=scale, units="m/s2")
        assert math.isfinite(result.prd_m) or result.status
