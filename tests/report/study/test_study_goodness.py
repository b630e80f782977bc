"""The goodness of fit of a fragility: its chart, its column and its cells in study.xlsx."""

import dataclasses
import math
import re

import numpy as np
import pytest

import printed
from report.study.array_page import fragility as pages
from report.study.results import LimitState
from report.study.run import planned, run_study
from report.text.units import digits_down
from solver.studies.capacity import Capacities
from solver.studies.fragility import fragility
from study_books import given, sheet_rows, write

LEVELS = np.array([0.5, 1.0, 1.5, 2.0])


def state(name, intensity, *, falls=0, is_censored=False):
    x = np.array(intensity)
    found = Capacities(
        intensity=x, is_censored=np.arange(x.size) >= x.size - is_censored,
        end=np.full(x.size, 2.0), falls=np.arange(x.size) < falls,
        searched=np.zeros(x.size, int),
    )  # fmt: skip
    exceeds = x[:, None] < LEVELS
    return LimitState(
        name=name, words="is so", limit_m=0.1, effects={},
        fragility=fragility(LEVELS, exceeds, np.ones_like(exceeds), found, seed=1),
    )  # fmt: skip


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """A study whose array has one state that fits, one of two groups, and one that is censored."""
    folder = write(tmp_path_factory.mktemp("goodness"), given(), motions=1)
    found = run_study(planned(folder)[0], folder / "out")
    rng = np.random.default_rng(3)
    states = (
        state("LS1", np.exp(0.2 * rng.standard_normal(7))),
        state("LS2", [0.90, 0.901, 0.902, 0.903, 1.8, 1.801, 1.802], falls=2),
        state("LS3", [1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 2.0], is_censored=True),
    )
    one = dataclasses.replace(found.arrays[0], states=states)
    return dataclasses.replace(found, arrays=(one,))


def test_the_chart_has_a_panel_for_each_state_with_the_p_value_of_the_table(results):
    charts = pages(results, results.arrays[0]).charts
    assert list(charts) == ["fragility", "goodness"]
    texts = re.findall(r">(LS\d: [^<]*)<", charts["goodness"])
    p = [digits_down(s.fragility.p_value, 2) for s in results.arrays[0].states[:2]]
    assert texts == [f"LS1: p = {p[0]}", f"LS2: p = {p[1]}"]
    assert printed.study(results).table("Fragilities").column("p of fit") == [*p, "—"]
    assert "leave in 5\u00a0% of lognormal samples." in printed.study(results)


def test_without_a_p_value_there_is_no_chart(results):
    one = dataclasses.replace(results.arrays[0], states=results.arrays[0].states[2:])
    assert list(pages(results, one).charts) == ["fragility"]


def test_the_band_leaves_out_the_capacities_whose_p_value_is_below_5_percent(results):
    """A rank beyond the band is what the test of Lilliefors rejects."""
    for one, is_inside in zip(results.arrays[0].states[:2], (True, False), strict=True):
        f = one.fragility
        x = np.sort(f.capacities.intensity)
        chance = f.fitted.at(x)
        ranks = np.arange(x.size + 1) / x.size
        off = np.maximum(ranks[1:] - chance, chance - ranks[:-1]).max()
        assert (off < f.critical) == is_inside == (f.p_value > 0.05)
    assert math.isnan(results.arrays[0].states[2].fragility.critical)


def test_the_workbook_has_the_p_value_and_the_motions_that_fall_below_the_limit_again(results):
    rows = sheet_rows(results, "Fragility")
    assert [row["Motions below the limit again"] for row in rows] == [0, 2, 0]
    assert [row["Censored capacities"] for row in rows] == [0, 0, 1]
    p = [row["Lilliefors p of fit"] for row in rows]
    wanted = [s.fragility.p_value for s in results.arrays[0].states[:2]]
    assert p == [*map(pytest.approx, wanted), "none"]
