"""The verification finds what is right and what is wrong, and its records are complete."""

import dataclasses
import math

import numpy as np
import pytest

import oracle
from fixtures import verify_run
from solver.rivals import by_scipy
from solver.rivals.methods import METHODS
from solver.sliding.checked import slide
from solver.verification import checks, paper_studies, reference, study_cases
from solver.verification.evidence import ROUNDING, SECTIONS, DesignCurves, Verified, percent_off
from solver.verification.features import FEATURES, statuses
from solver.verification.model_checks import model_checks
from solver.verification.reference import (
    half_sine_travel,
    harmonic_travel,
    pulse_travel,
    slope_pulse,
    yield_accelerations,
)
from solver.verification.study_cases import Case
from solver.verification.verification_motions import (
    near_fault_pulse,
    own_records,
    own_triples,
    scale_to,
    shortened,
)


@pytest.fixture(scope="module")
def verification(tmp_path_factory):
    """That of the command, which counts the steps that it reports."""
    return verify_run.verified(tmp_path_factory).verification


@pytest.fixture(scope="module")
def pulse():
    return near_fault_pulse()


@pytest.mark.nightly
def test_a_quick_verification_passes_and_fills_every_part(verification):
    assert verification.passed
    assert verification.quick
    assert verification.records == ("motion-01-x", "near-fault-pulse")
    parts = [
        "checks",
        "rivals",
        "work",
        "maps",
        "convergence",
        "links",
        "curves",
        "conditioning",
        "roofs",
        "models",
    ]
    assert all(len(getattr(verification, part)) > 0 for part in parts)
    assert len(verification.convergence) == len(verification.curves) == 2
    assert [(link.record, link.slope_deg) for link in verification.links] == [
        (record, slope) for record in verification.records for slope in (0.0, 4.0)
    ]


@pytest.mark.nightly
def test_every_section_has_rows_with_a_source_and_a_tolerance_and_no_two_are_alike(verification):
    rows = verification.checks
    assert {row.section for row in rows} == {*SECTIONS.values()}
    assert all(row.source and row.unit and row.tolerance <= 0.025 for row in rows)
    digits = [row for row in rows if row.section == SECTIONS["DA"]]
    assert max(row.error for row in digits) <= 1e-12
    names = [(row.section, row.problem, row.quantity) for row in rows]
    assert len(set(names)) == len(names)


@pytest.mark.nightly
def test_every_check_that_a_feature_names_ran_and_every_check_belongs_to_one(verification):
    ran = {row.id for row in verification.checks}
    named = {id for feature in FEATURES for id in feature.checks}
    extra = {id for feature in FEATURES for id in feature.extra}
    assert named <= ran
    assert ran <= named | extra
    assert extra <= ran or not by_scipy.is_installed()
    for status in statuses(verification.checks):
        assert status.is_verified == bool(status.feature.checks), status


def of_two_axes():
    return model_checks(own_triples(quick=True), quick=True)


def claimed():
    """What is said of methods, over a few random records and one longer one."""
    few = [*checks.random_blocks()][:3]
    return checks.claims(checks.rival_errors({checks.RANDOM: few, checks.ROOF: few[:1]}))


@pytest.mark.parametrize(
    ("made", "left_out"),
    [
        (claimed, ["ME-2"] * 4),
        pytest.param(of_two_axes, ["TA-13"] * 6, marks=pytest.mark.nightly),
    ],
)
def test_without_scipy_its_checks_are_named_and_left_out(made, left_out, monkeypatch):
    whole = [row.problem for row in made()]
    monkeypatch.setattr(by_scipy, "is_installed", lambda: False)
    rows = list(made())
    assert [row.problem for row in rows] == whole
    left = [row for row in rows if not row.is_run]
    assert [row.id for row in left] == left_out
    assert not any(row.passed for row in left)


def test_a_solver_that_is_a_millionth_off_fails_the_checks_that_see_it(monkeypatch, pulse):
    def wrong(*args, **kwargs):
        right = slide(*args, **kwargs)
        names = "prd_m", "residual_m", "down_m"
        off = {name: (1.0 + 1e-6) * getattr(right, name) for name in names}
        return dataclasses.replace(right, **off)

    blocks = [*checks.roof_blocks(pulse)]
    monkeypatch.setattr(checks, "slide", wrong)
    closed = [row for row in checks.closed_forms() if row.tolerance == ROUNDING]
    assert closed
    assert not any(row.passed for row in closed)
    assert not any(row.passed for row in checks.fifty_digits(blocks) if row.expected != 0.0)


def test_a_method_without_a_number_fails_its_check(monkeypatch):
    def lost(*args, **kwargs):
        return dataclasses.replace(slide(*args, **kwargs), prd_m=math.nan)

    monkeypatch.setattr(checks, "slide", lost)
    rows = [row for row in claimed() if row.is_run]
    assert rows
    assert all(math.isnan(row.error) and not row.passed for row in rows)


def test_a_link_that_diverges_leaves_holes(monkeypatch, pulse):
    monkeypatch.setattr(paper_studies, "LINK_PER_M", 1e9)
    link = paper_studies.link_comparison(pulse, 4.0)
    assert np.isnan([*link.runs_m["PRD, link"], link.worst_percent, link.mean_percent]).all()


def test_a_method_that_is_said_to_be_as_accurate_and_is_not_fails_its_check(monkeypatch):
    names, blocks = ("exact", "compiled-rk45", "linear"), [*checks.random_blocks()]
    monkeypatch.setattr(checks, "runnable_methods", lambda: [METHODS[name] for name in names])
    found = checks.rival_errors({checks.RANDOM: blocks[:193], checks.ROOF: blocks[:7]})
    assert found.groupby("method").size().tolist() == [200] * 3
    assert all(row.passed for row in checks.claims(found) if row.is_run)

    def passes_over_a_stop(*args, method, **kwargs):
        is_one = kwargs["ax_mps2"] is blocks[7].given["ax_mps2"] and method == "compiled-rk45"
        return slide(*args, method="linear" if is_one else method, **kwargs)

    monkeypatch.setattr(checks, "slide", passes_over_a_stop)
    found = checks.rival_errors({checks.RANDOM: blocks, checks.ROOF: blocks[:7]})
    failed = [row.problem for row in checks.claims(found) if row.is_run and not row.passed]
    assert failed == [f"{METHODS['compiled-rk45'].title}: {checks.RANDOM}"]


def test_closed_forms_and_the_physical_checks_of_the_paper_pass(pulse):
    rows = [*checks.closed_forms(), *checks.physical_checks(pulse)]
    assert [row for row in rows if not row.passed] == []


@pytest.mark.parametrize("with_vertical", [False, True])
@pytest.mark.parametrize(("degrees", "mu"), [(0, 0.3), (4, 0.2), (-30, 0.1), (7, 0.0)])
def test_fifty_decimal_digits_agree_with_forty_binary_ones(pulse, degrees, mu, with_vertical):
    ax = shortened(pulse, 4.0).a_mps2
    az = 0.3 * ax[::-1] if with_vertical else None
    scene = {"slope_rad": math.radians(degrees), "mu": mu, "scale": 0.7}
    exact = oracle.slide(ax, 0.01, **scene, az=az, g=9.81)
    decimal = reference.slide(ax.tolist(), 0.01, **scene, az_mps2=az, g_mps2=9.81)
    assert (decimal.prd_m, decimal.residual_m) == (float(exact.prd), float(exact.residual))


def test_records_of_the_project_are_the_same_every_time_and_read_only():
    records, other = own_records(True), own_records(True)
    for a, b in zip(records, other, strict=True):
        np.testing.assert_array_equal(a.a_mps2, b.a_mps2)
        assert not a.a_mps2.flags.writeable
        assert scale_to(a, 1.0) * np.abs(a.a_mps2).max() == pytest.approx(9.80665)


@pytest.mark.quick
def test_errors_have_a_floor_of_a_millimeter_and_are_absolute_where_nothing_is_expected():
    off = percent_off(np.array([1.01, 1e-4, math.nan]), np.array([1.0, 0.0, 1.0]))
    assert off == pytest.approx([1.0, 10.0, math.nan], nan_ok=True)
    row = Verified("CF-1", "c", "d", "m", "b", 0.0, -3e-4, 1e-3)
    assert (row.error, row.passed) == (3e-4, True)
    assert Verified("CF-1", "c", "d", "m", "b", 2.0, 2.1, 0.04).error == pytest.approx(0.05)


# The paper's figures


@pytest.mark.nightly
def test_the_papers_method_converges_at_first_order_under_an_envelope(verification):
    assert len(paper_studies.CONVERGENCE_CASES) == 60
    for found in verification.convergence.values():
        assert found.index.tolist() == [1, 2, 4, 8, 16, 32, 64, 128, 256]
        error, by_finest = (found[f"{name}_percent"].to_numpy() for name in ("exact", "finest"))
        # Not smoothly: an event falls differently on each grid.
        assert (error[3:] < 0.5 * error[:-3]).all()
        assert 16 < error[0] / error[6] < 1000
        assert by_finest[-1] == 0.0
        assert by_finest[:4] == pytest.approx(error[:4], rel=0.1)
        assert (found["prd_percent"] <= error * (1.0 + 1e-12)).all()
        assert found["worst_case"].str.contains("PPA").all()
        assert (found["seconds"] > 0.0).all()
    assert 0.01 < found.loc[64, "exact_percent"] < 1.0  # of a pulse; 0.48 % in the paper


@pytest.mark.nightly
def test_the_link_differs_by_about_as_much_as_in_the_paper(verification):
    for link in verification.links:
        assert len(link.runs_m) == (10 if link.slope_deg == 0.0 else 6)
        assert link.mean_percent < link.worst_percent < 15.0  # 6.78 and 1.69 % in the paper
        run_m, end_m = link.runs_m.loc[link.history_mu], link.history_m.iloc[-1].abs()
        assert end_m["exact"] == run_m["RRD, exact"]
        assert end_m["link"] == run_m["RRD, link"]
        assert (link.runs_m["PRD, exact"] >= link.runs_m["RRD, exact"] - 1e-15).all()


@pytest.mark.nightly
def test_design_curves_are_the_papers_6960_runs(verification):
    curves = verification.curves[0]
    assert curves.runs == 6960
    assert curves.prd_m.shape == (15, 15, 16)
    cases = [Case(slope_deg, curves.mus[2], curves.ppas_g[15]) for slope_deg in (-4.0, 4.0)]
    both_m = [study_cases.run(own_records(True)[0], case).prd_m for case in cases]
    assert curves.prd_m[8, 2, 15] == pytest.approx(max(both_m), rel=1e-9)


@pytest.mark.quick
def test_the_least_friction_is_read_off_between_the_runs():
    mus = np.array([0.2, 0.4, 0.6, 0.8])
    prd = np.array([4.0, 1.0, 2.0, 0.0])[None, :, None] * np.array([0.0, 1.0])
    curves = DesignCurves(
        record="r", runs=1, seconds=0.0, mus=mus, prd_m=np.concatenate([prd, 3.0 * prd]),
        slopes_deg=np.array([0.0, 2.0]), ppas_g=np.array([0.0, 1.0]),
    )  # fmt: skip
    assert curves.prd(1.0, 0.5) == pytest.approx([4.0, 1.0, 2.0, 0.0])
    # From 0.4 to 0.5 it is within 1.5 too, but not from there on.
    assert curves.minimum_mu(0.0, 1.0, 1.5) == pytest.approx(0.65)
    assert curves.minimum_mu(0.0, 1.0, 5.0) == 0.2
    assert math.isnan(curves.minimum_mu(0.0, 1.0, -1.0))


G = 9.81


def slope_travel(degrees, mu, horizontal, vertical, duration):
    drive, resist = slope_pulse(math.radians(degrees), mu, horizontal, vertical, G)
    return pulse_travel(drive, resist, duration, 0.0)


@pytest.mark.parametrize(
    ("travel", "given", "expected_m"),
    [
        (half_sine_travel, (0.5, 0.2, 1.0, G), 0.280945),
        (half_sine_travel, (0.8, 0.4, 2.0, G), 0.067791),
        (half_sine_travel, (1.0, 0.1, 1.0, G), 4.214008),
        (harmonic_travel, (0.5, 0.2, 1.0, G), 0.193314),
        (slope_travel, (5, 0.4, 0.6, 0.0, 0.3), 0.269578),
        (slope_travel, (10, 0.5, 0.8, 0.0, 0.15), 0.159855),
        (slope_travel, (5, 0.4, 0.6, -0.3, 0.3), 0.404575),
        (slope_travel, (5, 0.4, 0.6, 0.3, 0.3), 0.159320),
        # Newmark's rectangular pulse: A g, mu g, its length, and no ramp.
        (pulse_travel, (0.4 * G, 0.1 * G, 0.2, 0.0), 0.235440),
        (pulse_travel, (0.5 * G, 0.2 * G, 0.3, 0.0), 0.331087),
        (pulse_travel, (1.0 * G, 0.4 * G, 0.1, 0.0), 0.073575),
    ],
)
def test_travels_are_those_printed(travel, given, expected_m):
    assert travel(*given) == pytest.approx(expected_m, abs=1e-6)


def test_yield_accelerations_are_symmetric_on_a_flat_roof_and_lock_on_a_steep_one():
    assert yield_accelerations(0.0, 0.4, G) == pytest.approx((-0.4 * G, 0.4 * G))
    assert yield_accelerations(math.radians(60), 0.7, G)[1] == math.inf
