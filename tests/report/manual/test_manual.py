"""The comparisons of the manual, of roofs and of models: what is found, printed and charted."""

import io
import math
import re
from dataclasses import replace

import numba
import numpy as np
import pandas as pd
import pytest

from fixtures import commands, pages
from fixtures.paths import RECORDS
from fixtures.spaces import spaced
from fixtures.verify_run import only
from report.manual.check_sections import summary
from report.manual.manual_files import verification_csv
from report.manual.measured_buildings import building, models
from report.manual.precision import methods, work
from report.text.error_text import percent
from solver.building.roof import absolute_accelerations, roof_motion
from solver.building.structure import beam_modes, building_of_periods
from solver.errors import InputError
from solver.records.record import Record, write_record
from solver.records.spectrum import response_spectrum
from solver.sliding.checked import slide
from solver.verification import building_checks as checks
from solver.verification import checks as checks_by_digits
from solver.verification import model_study, workprecision
from solver.verification.building import (
    BY_HEIGHT,
    SPECTRUM_S,
    compare,
    identify,
    recorded_buildings,
)
from solver.verification.evidence import HELD, SECOND
from solver.verification.study_cases import CASES
from solver.verification.verification_motions import (
    near_fault_pulse,
    own_records,
    own_triples,
    shortened,
)

pytestmark = pytest.mark.skipif(
    numba.config.DISABLE_JIT, reason="each record takes minutes without compiled kernels"
)


@pytest.fixture(scope="module")
def made():
    return checks.made_building(own_records(True)[0])


@pytest.fixture(scope="module")
def comparison(made):
    return compare(made)


@pytest.fixture(scope="module")
def recorded(made):
    """The model building as if it had been recorded, with a period from its height."""
    about = {"title": "A tower", "description": "A frame.", "is_recorded": True}
    return compare(replace(made, **about, code_period_s=1.0))


def page(part, **found):
    """A section below the summary."""
    found = only(**found)
    return pages.manual(found, summary(found), part(found))


# What the verification finds


def test_every_check_passes_no_two_are_alike_and_a_fit_that_is_off_fails_its_own(made, comparison):
    rows = list(checks.building_checks(made, comparison))
    assert all(row.passed for row in rows), [row for row in rows if not row.passed]
    assert len({(row.problem, row.quantity) for row in rows}) == len(rows)
    best = comparison.predictions[0]
    for change in ({"period_s": 1.19}, {"damping": 0.05}, {"alpha0": 5.0}, {"unexplained": 0.1}):
        predictions = (replace(best, **change), *comparison.predictions[1:])
        off = replace(comparison, predictions=predictions)
        assert sum(not row.passed for row in checks.building_checks(made, off)) == 1


@pytest.mark.parametrize(
    ("name", "wrong"),
    [
        ("absolute_accelerations", lambda right: 1.00001 * right),
        ("roof_motion", lambda right: 1.001 * right),
        ("beam_modes", lambda right: replace(right, factors=1.001 * right.factors)),
        ("beam_modes", lambda right: replace(right, period_ratios=right.period_ratios**1.001)),
        ("story_modes", lambda right: replace(right, factors=1.001 * right.factors)),
    ],
)
def test_what_is_wrong_fails_the_checks_that_see_it(made, comparison, monkeypatch, name, wrong):
    true = getattr(checks, name)
    monkeypatch.setattr(checks, name, lambda *given, **named: wrong(true(*given, **named)))
    assert not all(row.passed for row in checks.building_checks(made, comparison))


@pytest.mark.quick
def test_a_beam_is_found_again_from_its_own_floors():
    ground = own_records(True)[0]
    modes, period_s, zeta = beam_modes(3.0, 12, [0.4, 1.0]), 0.83, 0.07
    histories = absolute_accelerations(
        ground.a_mps2, ground.dt_s, period_s * modes.period_ratios, np.full(12, zeta)
    )
    rigid = 1.0 - modes.factors.sum(axis=0)
    floors = histories @ modes.factors + ground.a_mps2[:, None] * rigid
    fit = identify(ground.a_mps2, ground.dt_s, (0.4, 1.0), floors, (0.4, 1.6))
    assert fit.period_s == pytest.approx(period_s, rel=5e-4)
    assert fit.damping == pytest.approx(zeta, rel=5e-3)
    assert fit.alpha0 == pytest.approx(3.0, rel=1e-2)
    assert fit.unexplained < 1e-5


def test_predictions_are_what_their_parts_say_to_the_ground_itself(made, recorded, comparison):
    assert spaced([prediction.name for prediction in recorded.predictions]) == [
        "fitted to the 12th and 24th floors", "fitted to the 12th floor", BY_HEIGHT,
        "first fit, but with 5% damping", "ground motion applied at the roof, no building",
    ]  # fmt: skip
    prediction = recorded.predictions[2]
    model = building_of_periods([1.0], damping=[0.05], alpha0=prediction.alpha0)
    roof = roof_motion(made.ground_mps2, made.dt_s, model)[: made.ground_mps2.size]
    np.testing.assert_array_equal(prediction.a_mps2, roof)
    assert prediction.unexplained == pytest.approx(
        ((roof - recorded.roof_mps2) ** 2).sum() / (recorded.roof_mps2**2).sum()
    )
    sa = response_spectrum(roof, made.dt_s, SPECTRUM_S)
    low, high = recorded.bands_s[3]
    ratios = (sa / recorded.roof_sa_mps2)[(low <= SPECTRUM_S) & (high >= SPECTRUM_S)]
    assert prediction.band_ratios[3] == pytest.approx(np.prod(ratios) ** (1.0 / ratios.size))
    both = [
        slide(roof, made.dt_s, slope_rad=math.radians(d), mu=0.3, scale=recorded.scale).prd_m
        for d in (2.0, -2.0)
    ]
    assert prediction.prd_m[2] == max(both)
    assert np.abs(recorded.roof_mps2).max() * recorded.scale == pytest.approx(9.80665)
    last = comparison.predictions[-1]
    np.testing.assert_array_equal(last.a_mps2, made.ground_mps2)
    assert last.n_modes == 0
    assert math.isnan(last.period_s)


# Records of a real building


@pytest.mark.nightly
def test_575_market_street_is_read_and_its_misfit_stays_what_it_was():
    if not (RECORDS / "roof_575_market").is_dir():
        pytest.skip("the records of the building are not here")
    (records,) = recorded_buildings(RECORDS)
    assert records.ground_mps2.size == 9694
    assert records.dt_s == 0.005
    peaks_g = np.abs(records.floors_mps2).max(axis=0) / 9.80665
    assert peaks_g == pytest.approx([0.16549, 0.13491], abs=1e-5)
    # The ground's instrument points the other way: in the floors' direction motions rise together.
    assert np.corrcoef(np.roll(records.ground_mps2, 106), records.floors_mps2[:, 0])[0, 1] > 0.8
    comparison = compare(records)
    fitted, without_roof, by_height = comparison.predictions[:3]
    assert fitted.period_s == pytest.approx(4.88, abs=0.02)
    assert fitted.damping == pytest.approx(0.126, abs=0.002)
    assert fitted.unexplained == pytest.approx(0.254, abs=0.005)
    assert without_roof.unexplained == pytest.approx(0.54, abs=0.02)
    assert by_height.name == BY_HEIGHT
    assert by_height.period_s == pytest.approx(4.505, abs=1e-3)
    assert (np.abs(np.log(fitted.band_ratios)) < 0.2).all()
    assert (fitted.prd_m / comparison.prd_m > 0.8).all()
    assert (fitted.prd_m / comparison.prd_m < 1.2).all()


@pytest.mark.quick
def test_records_are_cut_to_the_shortest_and_turned_to_one_direction_and_a_lost_one_named(tmp_path):
    folder = tmp_path / "roof_575_market"
    folder.mkdir()
    with pytest.raises(InputError, match=r"LomaPrieta_k_315\.csv: no such file"):
        recorded_buildings(tmp_path)
    for name, a in (("k_315", [1.0, 2.0, 3.0]), ("i_135", [0.5] * 4), ("c_135", [0.25] * 5)):
        record = Record(name=name, dt_s=0.01, a_mps2=9.80665 * np.array(a))
        write_record(folder / f"SF575Market_LomaPrieta_{name}.csv", record)
    (records,) = recorded_buildings(tmp_path)
    np.testing.assert_allclose(records.ground_mps2, -9.80665 * np.array([1.0, 2.0, 3.0]))
    assert records.floors_mps2.shape == (3, 2)


@pytest.mark.quick
def test_the_command_names_a_folder_without_records_and_exits_2(tmp_path):
    told = commands.errors_of("verify", "--records", tmp_path, "--out", tmp_path / "out")
    assert "no subfolder roof_575_market; use a folder that contains it" in told
    assert not (tmp_path / "out").exists()


# What the manual prints


def test_the_manual_says_how_far_off_predictions_are_or_that_none_was_compared(
    comparison, recorded
):
    said = page(building, roofs=(comparison, recorded))
    assert "Records of a real building were given: A tower." in said
    ratios = recorded.predictions[2].prd_m / recorded.prd_m
    span = f"{ratios.min():.2f} to {ratios.max():.2f}"
    assert f"{BY_HEIGHT}: {span}" in said
    assert f"{BY_HEIGHT}: PRD {span} times" in said
    assert "One building in one earthquake does not establish a margin for another" in said
    cells = [cell for table in said.tables[-3:] for row in table.cells for cell in row]
    for prediction in recorded.predictions:
        assert cells.count(spaced(prediction.name[0].upper() + prediction.name[1:])) == 3
        for ratio, scatter in zip(prediction.band_ratios, prediction.band_scatters, strict=True):
            assert f"{ratio:.2f} ({100 * scatter:.0f}%)" in cells
        for prd, true in zip(prediction.prd_m, recorded.prd_m, strict=True):
            assert f"{1e3 * prd:.0f} ({prd / true:.2f})" in cells
    assert cells.count("Recorded") == 2
    assert not any("nan" in cell for cell in cells)
    said = page(building, roofs=(comparison,))
    assert "No records of a real building were given to this run" in said
    assert "does not show how well a uniform beam represents a real building" in said
    headed = [line for line in said.splitlines() if line.startswith("## ")]
    assert headed[1:] == [f"## 2.1 {comparison.title}"]
    assert "computed from its ground motion" not in said


def test_charts_name_each_line_and_only_records_have_a_history(comparison, recorded):
    name = "building-model-building-of-24-stories"
    first = building(only(roofs=(comparison,))).charts[name]
    (other,) = building(only(roofs=(recorded,))).charts.values()
    for text in (">ground<", ">roof, integrated directly<", ">fitted to the 12th floor<"):
        assert text in first
    for text in (">roof, recorded<", f">{BY_HEIGHT}<", ">Roof acceleration: recorded (solid)"):
        assert text in other
    assert "Roof acceleration" not in first
    assert "ground motion applied at the roof" not in other


TWO_AXES = "PRD in two axes relative to one axis, median"


@pytest.fixture(scope="module")
def evidence():
    return model_study.model_evidence(own_triples(True), quick=True)


@pytest.fixture(scope="module")
def said(evidence):
    return page(models, models=(evidence,))


def test_the_factor_of_the_second_axis_and_static_friction_are_told(evidence, said):
    second = evidence.study.named(SECOND)
    assert f"PRD is {second.median:.2f} times that of one axis with the same heading" in said
    assert "One axis underestimates the PRD." in said
    assert "No records of three components were given" in said
    result = said.table("Key results").row(TWO_AXES)["Result"]
    assert result.startswith(f"{second.median:.2f} times")
    assert not re.search(r"\bnan\b|\d+e[-+]?\d|None|\{|\}", said.split("# 2 Models")[1])
    held = evidence.study.named(HELD)
    span = f"({held.at(10.0):.2f} to {held.at(90.0):.2f})"
    assert f"{held.median:.2f} times in two axes {span}" in said
    (table,) = [table for table in said.tables if "Distance" in table.title]
    assert [float(row[1]) for row in table.cells] == pytest.approx(
        1e3 * evidence.pushed["end_m"], abs=0.005
    )


def recorded_and_lifted(evidence):
    return replace(evidence, study=replace(evidence.study, n_recorded=1, n_uplift=3))


def nothing_slides(evidence):
    changes = tuple(replace(change, ratios=np.empty(0)) for change in evidence.study.changes)
    return replace(evidence, study=replace(evidence.study, changes=changes))


@pytest.mark.parametrize(
    ("changed", "wanted", "unsaid"),
    [
        (recorded_and_lifted, "1 recorded in earthquakes", "No records of three"),
        (nothing_slides, "No run slides 5 mm or more", TWO_AXES),
    ],
)
def test_what_differs_in_another_run_is_told(evidence, changed, wanted, unsaid):
    said = page(models, models=(changed(evidence),))
    assert wanted in said
    assert unsaid not in said


@pytest.fixture(scope="module")
def runs():
    part = shortened(near_fault_pulse(), 5.0)
    return workprecision.work_points([(part, CASES[1])], quick=True)


def test_every_method_stands_with_its_errors_against_50_digits():
    blocks = [*checks_by_digits.random_blocks()][:4]
    kinds = {checks_by_digits.RANDOM: blocks, checks_by_digits.ROOF: blocks[:1]}
    errors = checks_by_digits.rival_errors(kinds)
    said = page(methods, rivals=errors)
    (table,) = [table for table in said.tables if "50-digit" in table.title]
    assert len(table.cells) == errors["method"].nunique()
    (linear,) = [row for row in table.cells if row[0] == "Linear acceleration"]
    assert list(linear[1:]) == [
        spaced(percent(own["error [%]"].agg(of)))
        for _, own in errors[errors["method"] == "linear"].groupby("motions", sort=False)
        for of in ("median", "max")
    ]


def test_both_axes_are_compared_by_time_and_errors(evidence, runs):
    said = page(work, work=runs, models=(evidence,), records=("",))
    assert "motion-01, strongest 1 s, generated roof motion" in said
    (table,) = [table for table in said.tables if "Median times" in table.title]
    exact = table.row("Exact, event by event")
    assert exact["Time per run"] != exact["Single run"]
    ours = evidence.work[evidence.work["method"] == workprecision.OURS]
    ours = ours[ours["setting"] == 1e-6]
    compiled = evidence.work[evidence.work["method"].str.endswith("(compiled)")]
    longer = workprecision.times_longer(compiled, ours, "residual error [%]")
    assert f"takes {longer:.0f} times as long (median)" in said
    assert "nan" not in said
    one_axis = page(work, work=runs, records=("",))
    assert "power series" not in one_axis


def test_the_charts_are_the_same_every_time_and_the_runs_are_in_the_table(evidence, runs):
    first, other = (work(only(models=(evidence,), work=runs)).charts for _ in range(2))
    assert first == other
    assert len(first) == 1
    table = pd.read_csv(io.BytesIO(verification_csv(only(models=(evidence,)))))
    assert set(table["kind"]) == {"run in two axes"}
    for column in ("residual error [%]", "parameters", "case"):
        assert table[column].tolist() == spaced(evidence.work[column].tolist())
