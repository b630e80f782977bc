"""The displacements of the design event and of smaller ones add to what separate runs give."""

import math
from dataclasses import replace

import numpy as np
import pytest

import scenes
import stand_in
from one_by_one import prd_m
from printed import printed
from report.assessment.evidence import cumulative
from sheets import at, make, problems, read_workbook, type_into
from solver.sliding.least_model import DEFAULT

FACTORS = "0.50, 0.50, 0.25"
G = 9.80665
CELL = "Options/Smaller events"


def made(events=FACTORS, found=None, **changes):
    options = {"peer_reviewed": True, "smaller_events": events}
    return scenes.package(found, options=options, **changes).assessment


def scaled(motion, factor):
    records = ("ax_mps2", "ay_mps2", "az_mps2")
    return replace(motion, **{name: factor * getattr(motion, name) for name in records})


def test_sums_are_those_of_separate_runs_and_carry_the_factor():
    for item in cumulative(made()):
        for motion, total in zip(scenes.motions(), item.sums_m.values(), strict=True):
            events = [scaled(motion, factor) for factor in (1.0, 0.5, 0.5, 0.25)]
            peaks = [prd_m(event, item.array.array) for event in events]
            assert abs(total - sum(peaks)) <= sum(map(DEFAULT.bound_m, peaks))
        assert item.mean_m == pytest.approx(np.mean(list(item.sums_m.values())))
        assert item.largest_m == max(item.sums_m.values())
    # Three motions: 1.1 times the largest, which is what a sum is compared with.
    done = made()
    page = printed(done, "accuracy")
    table = page.table("Cumulative displacement over the motions")
    assert table.headings[1::2] == (
        "1.10 × mean sum [in]", "1.10 × largest sum [in]", "Design displacement [in]",
    )  # fmt: skip
    for item, row in zip(cumulative(done), table.cells, strict=True):
        for first, value_m in ((1, item.mean_m), (3, item.largest_m)):
            assert row[first] == f"{math.ceil(11.0 * value_m / 0.0254 - 1e-6) / 10:.1f}"
            assert row[first + 1] == f"{math.ceil(1100.0 * value_m - 1e-6)}"
    assert "carry the factor 1.10† of the value from analysis" in page


@pytest.mark.nightly
@pytest.mark.quick
def test_a_rectangular_pulse_gives_the_closed_form():
    """A level block under one pulse slides v^2 / 2 (1/(mu g) - 1/a) (Newmark 1965)."""
    mu, seconds, dt = 0.45, 0.5, 0.001
    pulse = np.zeros(4001)
    pulse[1000:1500] = 1.0 * G
    motion = stand_in.motion("P", pulse, dt_s=dt, signs=(1,))
    level = [stand_in.array("A1", 0.0, mu=mu)]
    (item,) = cumulative(made("0.60", (motion,), arrays=level, objects=[], clearances=[]))
    closed = sum((a * seconds) ** 2 / 2 * (1 / (mu * G) - 1 / a) for a in (G, 0.6 * G))
    assert item.sums_m[motion.id] == pytest.approx(closed, rel=3e-3)


@pytest.mark.quick
def test_smaller_events_are_off_or_without_a_sum_where_a_run_has_no_value():
    first = cumulative(made())[0]
    assert math.isnan(replace(first, sums_m={"M1": 1.0, "M2": math.nan}).largest_m)
    assert cumulative(made("")) == ()


@pytest.mark.parametrize(
    "typed", ["0.5, 1.2", "0.0", "half", "0,5", "-0.5", ", ".join(["0.5"] * 21)]
)
def test_factors_outside_of_the_range_are_refused_by_cell(tmp_path, typed):
    (line,) = problems(type_into(make(tmp_path), {CELL: typed}))
    assert line.startswith(at(CELL))
    assert "give up to 20 factors with decimal points, above 0.0 and up to 1.0" in line


def test_factors_are_read_from_the_sheet(tmp_path):
    path = type_into(make(tmp_path), {CELL: FACTORS})
    assert read_workbook(path).input.options.smaller_factors == (0.5, 0.5, 0.25)
