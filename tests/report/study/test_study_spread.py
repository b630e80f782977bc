"""Spread of the motions' spectra and goodness of fit: what is said and exported of both."""

import dataclasses
import math
import re

import numpy as np
import pytest

from fixtures import pages
from fixtures.campaigns import motion
from fixtures.marks import by_day
from fixtures.study_workbooks import (
    command,
    library,
    limit_state,
    sheet_rows,
    study_input,
    with_fit,
    with_study,
    write,
)
from report.study import outputs
from report.study.capacity_runs import spectral_spread
from report.study.exports import export_files
from report.study.fragility_section import fragility as fragility_page
from report.study.run_study import planned, run_study
from report.study.sentences import headline, warnings
from report.study.study_input import StudyArray
from report.study.study_plan import FRICTION, SLOPE, ArrayPlan
from report.study.study_results import ArrayStudyResult
from report.text.units import digits_down
from solver.studies.fragility import Lognormal
from solver.studies.uncertainty import Spread


def like(number, factor):
    return dataclasses.replace(motion(number), scale=factor)


@pytest.mark.quick
def test_scaled_copies_of_a_motion_differ_by_the_spread_of_their_factors():
    factors = (0.5, 1.0, 1.7)
    found = spectral_spread([[like(1, factor) for factor in factors]])
    wanted = np.std(np.log(factors), ddof=1)
    assert found.median == pytest.approx(wanted, rel=1e-12)
    assert found.largest == pytest.approx(wanted, rel=1e-12)
    assert not found.is_one_spectrum


def test_copies_of_a_motion_are_one_spectrum_and_different_ones_are_not():
    assert spectral_spread([[like(1, 1.0), like(1, 1.05)]]).is_one_spectrum
    assert not spectral_spread([[motion(k) for k in range(4)]]).is_one_spectrum


@pytest.mark.quick
def test_each_building_has_its_own_motions():
    one, two = [like(1, 1.0), like(1, 1.0)], [like(2, 1.0), like(2, 2.0)]
    assert spectral_spread([one, two]).largest == pytest.approx(np.log(2.0) / math.sqrt(2.0))


@pytest.mark.quick
def test_one_motion_or_a_component_of_zeros_has_no_spread():
    zeros = dataclasses.replace(motion(1), ay_mps2=np.zeros(400))
    beside = dataclasses.replace(motion(2), ay_mps2=motion(3).ax_mps2)
    for motions in ([motion(1)], [zeros, beside]):
        found = spectral_spread([motions])
        assert not found.is_known
        assert not found.is_one_spectrum


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    folder = write(tmp_path_factory.mktemp("spread"), study_input(study_arrays=()), motions=3)
    return run_study(planned(folder)[0], folder / "out")


def said(results, motions):
    spread = spectral_spread([motions])
    return pages.study(dataclasses.replace(results, spread=spread))


def test_the_limits_name_the_spread_and_call_it_small_only_where_it_is(results):
    alike = said(results, [like(1, 1.0), like(1, 1.02)])
    assert "almost no record-to-record spread: the 84th percentile does not contain" in alike
    assert "have a median standard deviation of ln Sa of 0.015 and a maximum of 0.015" in alike
    other = said(results, [motion(k) for k in range(4)])
    assert "have a median standard deviation of ln Sa of" in other
    assert "almost no record-to-record spread" not in other
    assert "spectra of the" not in said(results, [motion(1)])


LEVELS = np.array([0.5, 1.0, 1.5, 2.0])


def with_state(results, motions, *, allow_matched=False, **changes):
    """The results with an array of one limit state (median 1.2, beta 0.06), and other motions."""
    state = limit_state("LS1", [1.13, 1.2, 1.27], LEVELS, words="slip begins")
    state = with_fit(state, Lognormal(theta=1.2, beta=0.06))
    array = ArrayPlan(
        array=StudyArray(id="S1", mat="A", slope_deg=2.0, clearance_m=0.1), building=0, seed=1,
        mu=0.4, spreads={FRICTION: Spread(center=0.4), SLOPE: Spread(center=2.0)}, shifts={},
        fragility=slice(0), samples=slice(0), bars=slice(0),
    )  # fmt: skip
    one = ArrayStudyResult(
        plan=array, states=(state,), exceedances=(), bars=(), center_m=math.nan, capacity_runs=0
    )
    spread = spectral_spread([motions])
    other = with_study(results, **changes)
    return dataclasses.replace(other, arrays=(one,), spread=spread, allow_matched=allow_matched)


MATCHED = [like(1, 1.0), like(1, 1.02), like(1, 0.98)]
UNMATCHED = [motion(k) for k in range(4)]


@pytest.mark.parametrize("motions", by_day([MATCHED, [motion(1)]], 1))
def test_a_fragility_without_record_to_record_dispersion_is_not_exported(results, motions):
    found = with_state(results, motions)
    assert export_files(found) == {}
    assert "fragility.csv is not written: the " in headline(found)[-1]
    assert headline(found)[-1].endswith("or write it with --allow-matched")
    assert pages.study(found).table("Dispersions").column("β exported") == ["not exported"]


def test_allow_matched_writes_the_warning_in_the_comments(results):
    found = with_state(results, MATCHED, allow_matched=True)
    wanted = (
        "Warning: the spectra of the 3 motions have a median standard deviation of ln Sa of 0.021, "
        "as motions matched to one spectrum do, and β does not contain the "
        "record-to-record dispersion of earthquakes. Written with --allow-matched."
    )
    assert warnings(found) == [wanted]
    assert f" {wanted} Study " in library(found)["BSA.S1"]["Comments"]
    assert headline(found)[-1] == wanted.rstrip(".")


def test_motions_that_differ_are_exported_without_a_warning(results):
    for allow in (False, True):
        (row,) = library(with_state(results, UNMATCHED, allow_matched=allow)).values()
        assert "Warning" not in row["Comments"]


def test_an_entered_record_to_record_value_replaces_that_of_the_motions(results):
    entered = {"record_beta": 0.3, "record_source": "Site & hazard"}
    found = with_state(results, MATCHED, modeling_beta=0.4, **entered)
    row = library(found)["BSA.S1"]
    assert (row["LS1-Theta_0"], row["LS1-Theta_1"]) == ("1.20000", "0.500000")
    said = (
        "Dispersions of LS1 (slip begins): record-to-record 0.30 (Site & hazard), modeling 0.40 "
        "(entered), quality of data not included (not entered), friction not included (mat A has "
        "no tests), slope not included (no tolerance is entered). "
        "Mass has no effect: each array is one "
        "rigid block with Coulomb friction."
    )
    assert said in row["Comments"]
    assert "\u00a0" not in row["Comments"]
    page = pages.study(found)
    assert "the dispersions β of the fits do not contain how much the spectra" in page
    assert "contains the record-to-record dispersion that is entered" in page
    assert "the dispersions β do not contain" in pages.study(with_state(results, MATCHED))
    table = page.table("Dispersions")
    assert table.title.endswith(
        ". Not included: quality of data (not entered), friction (mat A has no tests) and slope "
        "(no tolerance is entered)"
    )
    assert table.cells == (("LS1", "0.300", "0.400", "0.500"),)


@pytest.mark.nightly
def test_a_run_that_exports_nothing_leaves_no_export_of_a_former_one(tmp_path, monkeypatch):
    monkeypatch.setattr(outputs, "lay_out", str.encode)
    folder = write(tmp_path, study_input(intensities="0.2 to 2.4 by 0.2"), motions=1)
    first = command(folder, "--allow-matched")
    assert first.exit_code == 0, first.output
    assert "Warning: the record-to-record spread of 1 motion cannot be measured" in first.output
    former = folder / "out" / "study" / "fragility.csv"
    former.write_text("of two motions")
    again = command(folder)
    assert again.exit_code == 0, again.output
    assert "fragility.csv is not written" in again.output
    assert not former.exists()


@pytest.fixture(scope="module")
def fitted(tmp_path_factory):
    """A study whose array has one state that fits, one of two groups, and one that is censored."""
    folder = write(tmp_path_factory.mktemp("goodness"), study_input(), motions=1)
    found = run_study(planned(folder)[0], folder / "out")
    rng = np.random.default_rng(3)
    states = (
        limit_state("LS1", np.exp(0.2 * rng.standard_normal(7)), LEVELS),
        limit_state("LS2", [0.90, 0.901, 0.902, 0.903, 1.8, 1.801, 1.802], LEVELS, falls=2),
        limit_state("LS3", [1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 2.0], LEVELS, is_censored=True),
    )
    one = dataclasses.replace(found.arrays[0], states=states)
    return dataclasses.replace(found, arrays=(one,))


@pytest.mark.nightly
def test_the_chart_has_a_panel_for_each_state_with_the_p_value_of_the_table(fitted):
    charts = fragility_page(fitted, fitted.arrays[0]).charts
    assert list(charts) == ["fragility", "goodness"]
    texts = re.findall(r">(LS\d: [^<]*)<", charts["goodness"])
    p = [digits_down(s.fragility.p_value, 2) for s in fitted.arrays[0].states[:2]]
    assert texts == [f"LS1: p = {p[0]}", f"LS2: p = {p[1]}"]
    assert pages.study(fitted).table("Fragilities").column("p of fit") == [*p, "—"]
    assert "that contains the ranks of 95% of lognormal samples." in pages.study(fitted)


def test_without_a_p_value_there_is_no_chart(fitted):
    one = dataclasses.replace(fitted.arrays[0], states=fitted.arrays[0].states[2:])
    assert list(fragility_page(fitted, one).charts) == ["fragility"]


def test_the_band_leaves_out_the_capacities_whose_p_value_is_below_5_percent(fitted):
    """A rank beyond the band is what the test of Lilliefors rejects."""
    for one, is_inside in zip(fitted.arrays[0].states[:2], (True, False), strict=True):
        f = one.fragility
        x = np.sort(f.capacities.intensity)
        chance = f.fitted.at(x)
        ranks = np.arange(x.size + 1) / x.size
        off = np.maximum(ranks[1:] - chance, chance - ranks[:-1]).max()
        assert (off < f.critical) == is_inside == (f.p_value > 0.05)
    assert math.isnan(fitted.arrays[0].states[2].fragility.critical)


def test_the_workbook_has_the_p_value_and_the_motions_that_fall_below_the_limit_again(fitted):
    rows = sheet_rows(fitted, "Fragility")
    assert [row["Motions below the limit again"] for row in rows] == [0, 2, 0]
    assert [row["Censored capacities"] for row in rows] == [0, 0, 1]
    p = [row["Lilliefors p of fit"] for row in rows]
    wanted = [s.fragility.p_value for s in fitted.arrays[0].states[:2]]
    assert p == [*map(pytest.approx, wanted), "none"]
