"""The design displacement of a study: that of a package; and answers on the safe side."""

import dataclasses
import json
import math
import re

import numpy as np
import pytest
from hypothesis import HealthCheck, example, settings
from hypothesis import given as over
from hypothesis import strategies as st

from fixtures import pages, projects
from fixtures.marks import by_day
from fixtures.spaces import spaced
from fixtures.study_workbooks import sheet_rows, study_input, with_study, write
from report.assessment.design.routes import Route
from report.study.allowed_answers import allowed
from report.study.page_parts import design_length
from report.study.prescribed import compare
from report.study.run_study import planned, run_study
from report.study.sentences import design, headline
from report.study.study_input import Intensity, Mat, RuleSetName, StudyArray
from report.study.study_results import STATISTICS
from report.study.wording import both
from solver.rules.provisions import analysis_floor_m, analysis_value, prescriptive_displacement
from solver.rules.rulesets import RULE_SETS
from solver.studies.fragility import Lognormal

S_DS = 1.0
S_DS_GIVEN = {"intensity": Intensity.S_DS, "s_ds_g": 0.5, "intensities": "0.5, 1, 2"}


def run(folder, *, motions=7, **changes):
    """Run a study whose intensity is S_DS."""
    about = {**S_DS_GIVEN, "study_arrays": (), "slopes_deg": "0, 4, 6", "mus": "0.3"}
    study = study_input(**{**about, **changes})
    write(folder, study, motions=motions)
    return run_study(planned(folder)[0], folder / "out")


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    return run(tmp_path_factory.mktemp("design"), allowed_m=0.3)


def peaks_m(results, slope_deg, mu, level):
    """PRDs of the motions, by the assessment of a package; and its array."""
    motions = [
        dataclasses.replace(m, scale=m.scale * level) for m in results.plan.motions.motions[0]
    ]
    site = projects.site(s_ds_g=level)
    data = projects.project(
        arrays=[projects.array("A1", slope_deg, mu=mu)], objects=[], clearances=[], site=site
    )
    (array,) = projects.assess_input(data, motions).arrays
    return [run.governing.prd_m for run in array.motions], array


def test_the_design_displacement_is_that_of_a_package_with_the_same_motions(results):
    """On 4 degrees the prescriptive displacement is not permitted, and the analysis is used."""
    x = results.plan.input.intensities.index(S_DS)
    for m, mu in enumerate(results.plan.input.mus):
        _, array = peaks_m(results, 4.0, mu, S_DS)
        assert array.route is Route.ANALYSIS
        assert results.design_m[0, 1, m, x] == pytest.approx(array.design_m, rel=1e-12)
        assert results.curves.mean_m[0, 1, m, x] == pytest.approx(array.analysis.mean_m, rel=1e-12)


@pytest.mark.quick
def test_the_floor_governs_in_some_cases_and_the_analysis_in_others(results):
    floor = results.plan.design_rule.floor_m
    assert (results.design_m == floor).any()
    assert (results.design_m > floor).any()
    assert results.design_m == pytest.approx(np.maximum(1.1 * results.curves.mean_m, floor))


@pytest.mark.parametrize(
    ("motions", "rule_set"),
    by_day([(7, "SEAOC PV1-2012"), (7, "ASCE 7-16"), (5, "ASCE 7-22"), (3, "SEAOC PV1-2012")], 2),
)
def test_the_rule_set_and_the_number_of_motions_decide(tmp_path, motions, rule_set):
    found = run(tmp_path, motions=motions, rule_set=RuleSetName(rule_set), mus="")
    rules, mu = RULE_SETS[rule_set], found.plan.input.mus[0]
    for x, level in enumerate(found.plan.input.intensities):
        prd, _ = peaks_m(found, 4.0, mu, level)
        least = analysis_floor_m(
            rules, prescriptive_displacement(rules, s_ds_g=level, sdc="D", importance=1.0)
        )
        wanted = max(analysis_value(rules, prd).value_m, least)
        assert found.design_m[0, 1, 0, x] == pytest.approx(wanted, rel=1e-12)
    said = design(found.plan.design_rule)
    assert rule_set in said
    assert ("1.1† times the mean PRD" in said) == (motions >= 7)
    assert ("1.1† times the largest PRD" in said) == (motions < 7)
    assert f"{rules['analysis_floor']:g}† times the prescriptive displacement" in said
    assert ("I_e = 1" in said) == (rule_set != "SEAOC PV1-2012")


@pytest.mark.parametrize("motions", by_day([1, 2], 1))
def test_too_few_motions_give_no_design_displacement_and_it_is_said(tmp_path, motions):
    found = run(tmp_path, motions=motions, allowed_m=0.3)
    assert np.isnan(found.design_m).all()
    text = pages.study(found)
    assert "There is no design displacement: SEAOC PV1-2012 needs 3† motions or more" in text
    assert compare(found, 0) == ()
    assert "For a mean PRD of at most" in text
    assert all("design displacement" not in line for line in headline(found))


@pytest.mark.nightly
def test_without_s_ds_the_displacement_is_called_before_the_floor(tmp_path):
    found = run(tmp_path, intensity=Intensity.PPA, intensities="0.5, 1", s_ds_g=None, allowed_m=0.3)
    assert found.design_m == pytest.approx(1.1 * found.curves.mean_m, nan_ok=True)
    text = pages.study(found)
    assert "before its floor of 0.5† times the prescriptive displacement, which follows" in text
    assert "For a design displacement before the floor of at most" in text
    assert "the floor by itself" not in text


def test_the_manifest_states_the_rule_and_the_answers_have_the_design_displacement(results):
    about = results.manifest["design_displacement"]
    assert json.loads(json.dumps(about))["floor_m"] == results.plan.design_rule.floor_m.tolist()
    assert (about["rule_set"], about["statistic"]) == ("SEAOC PV1-2012", "1.1 x mean")
    named = {row["Displacement"] for row in sheet_rows(results, "Least friction")}
    assert named == {"design displacement", *STATISTICS}


def test_the_prescriptive_displacement_is_permitted_by_slope_and_friction(results):
    (found,) = compare(results, 0)
    slopes, mus = results.plan.input.slopes_deg, results.plan.input.mus
    permitted = np.array([[slope <= 3.0 and mu >= 0.4 for mu in mus] for slope in slopes])
    assert (found.permitted == permitted).all()
    assert (found.unsafe_not_permitted == found.unsafe & ~permitted[..., None]).all()
    assert found.unsafe.any()


MUS, SLOPES = "0.3, 0.4333333, 0.5012345", "0.25, 2, 3.3333333"
AXES = {"mus": MUS, "slopes_deg": SLOPES, "mats": (Mat(id="A", mu=0.6),), "study_arrays": ()}
LENGTHS = st.floats(0.01, 5.0) | st.just(math.nan)
TABLES = st.lists(LENGTHS, min_size=36, max_size=36)


def made_up(results, values):
    """The results with other axes and displacements."""
    study = study_input(**S_DS_GIVEN, **AXES)
    lengths = np.array(values).reshape(1, 3, 4, 3)
    return dataclasses.replace(
        results,
        plan=dataclasses.replace(results.plan, input=study),
        design_m=lengths,
        curves=dataclasses.replace(results.curves, mean_m=lengths / 1.1),
    )


def reading(cell):
    """A printed answer as a number; NaN for none."""
    return math.nan if cell == "none" else float(cell.strip("≤≥ "))


def excess(axis, lengths, value, allowed_m, *, upward):
    """By how much a displacement exceeds the allowed one anywhere from an answer on [m]."""
    end = axis[-1] if upward else axis[0]
    assert min(axis) <= value <= max(axis)
    points = np.concatenate([axis, np.linspace(value, end, 50)])
    points = points[points >= value] if upward else points[points <= value]
    return np.max(np.interp(points, axis, lengths)) - allowed_m


def check(axis, lengths, value, allowed_m, step, *, upward):
    """Hold an answer to the safe side, and to no more than a step beyond."""
    last = lengths[-1 if upward else 0]
    if math.isnan(value):
        assert not last <= allowed_m
        return
    steepest = np.nanmax(np.abs(np.diff(lengths) / np.diff(axis)), initial=0.0)
    slack = 1.01e-6 * step * steepest + 1e-12
    assert excess(axis, lengths, value, allowed_m, upward=upward) <= slack
    inner = value - 1.01 * step if upward else value + 1.01 * step
    if axis[0] <= inner <= axis[-1]:
        over_all = excess(axis, lengths, inner, allowed_m, upward=upward)
        assert not over_all <= -slack or not over_all <= 0.0


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@over(values=TABLES, allowed_m=st.floats(0.005, 5.0))
@example(values=[0.02] * 36, allowed_m=0.1)
@example(values=[2.0] * 36, allowed_m=0.1)
@example(values=[math.nan] * 36, allowed_m=0.1)
def test_printed_and_exported_answers_are_on_the_safe_side(results, values, allowed_m):
    found = made_up(results, values)
    axes = found.plan.input
    levels = axes.intensities
    for name, frictions, _, slopes, _ in allowed(found, 0, allowed_m).content["answers"]:
        lengths = found.displacements[name][0]
        for line, row in enumerate(frictions.rows):
            for x, cell in enumerate(row.cells[1:]):
                check(np.array(axes.mus), lengths[line, :, x], reading(cell), allowed_m, 0.01,
                      upward=True)  # fmt: skip
        for line, row in enumerate(slopes.rows):
            for x, cell in enumerate(row.cells[1:]):
                check(np.array(axes.slopes_deg), lengths[:, line, x], reading(cell), allowed_m,
                      0.1, upward=False)  # fmt: skip
        # The workbook and the first lines have the same numbers as the tables.
        printed_values = [[reading(cell) for cell in row.cells[1:]] for row in slopes.rows]
        values = found.largest_slopes(0, name, allowed_m)
        assert np.array_equal(values, np.array(printed_values), equal_nan=True)
    values = found.largest_slopes(0, found.plan.design_rule.name, allowed_m)
    lines = spaced(headline(with_study(found, allowed_m=allowed_m))[1 : 1 + len(axes.mus)])
    for line, values_at in zip(lines, values[:, len(levels) // 2], strict=True):
        number = re.search(r"largest slope (?:≥ )?([\d.]+|none)", line)[1]
        assert reading(number) == pytest.approx(values_at, abs=0.0, nan_ok=True)
        stated = float(re.search(r"of at most ([\d.]+) in", line)[1])
        assert stated * 0.0254 >= allowed_m - 1e-8


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@over(value_m=st.floats(0.0, 20.0))
def test_design_displacements_and_clearances_print_rounded_up(results, value_m):
    inch, mm = map(
        float, re.match(r"([\d.]+) in \((\d+) mm\)", spaced(both(results, value_m))).groups()
    )
    assert design_length(results, value_m) == f"{inch:.1f}"
    assert 0.0 <= inch - value_m / 0.0254 + 1e-6 < 0.1001
    assert 0.0 <= mm - value_m / 1e-3 + 1e-6 < 1.0001


def test_chances_and_medians_are_rounded_to_the_safe_side(tmp_path):
    arrays = (StudyArray(id="S1", mat="A", slope_deg=2.0, clearance_m=0.1),)
    found = run(tmp_path, study_arrays=arrays, site_intensity=1.0, intensities="0.2 to 2 by 0.2")
    array = found.arrays[0]
    for value, text in ((1.0, "100%"), (0.9961, "100%"), (0.1441, "15%"), (0.00123, "0.13%")):
        chance = dataclasses.replace(array.exceedances[0], value=value, low=value, high=value)
        one = dataclasses.replace(array, exceedances=(chance,))
        line = spaced(headline(dataclasses.replace(found, arrays=(one,)))[-1])
        assert f": {text} (" in line
    for theta, beta in ((1.2345, 0.0561), (0.99999, 0.2), (12.39, 1.011)):
        state = array.states[2]
        known = dataclasses.replace(state.fragility, fitted=Lognormal(theta=theta, beta=beta))
        one = dataclasses.replace(
            array, exceedances=(), states=(dataclasses.replace(state, fragility=known),)
        )
        line = spaced(headline(dataclasses.replace(found, arrays=(one,)))[-1])
        printed_theta, spread = map(float, re.search(r" ([\d.]+) g, beta ([\d.]+)", line).groups())
        assert 0.0 <= theta - printed_theta < 0.1
        assert 0.0 <= spread - beta < 0.1
