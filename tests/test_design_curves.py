"""The design curves: each run that of the solver, each statistic and figure of the docs counted."""

import json
import re
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from scipy import signal

import solver
from fixtures.marks import by_day
from fixtures.paths import ROOT
from projects.curves import make
from projects.curves.equation import (
    LEAST_PRD_M,
    Equation,
    RoofRuns,
    Scatter,
    ambraseys_menu_m,
    fit_equation,
    jibson_m,
    pooled,
    saygili_rathje_m,
    scatter,
)
from solver.building.roof import to_roof
from solver.building.structure import building_of_periods
from solver.errors import InputError
from solver.model import STANDARD_GRAVITY_MPS2
from solver.studies.sweep import sweep

TABLES = ROOT / "projects" / "curves"


def pulses(seed, count=600):
    """Return a made-up record [g]."""
    rng = np.random.default_rng(seed)
    return 0.3 * np.sin(np.linspace(0.0, np.pi, count)) ** 2 * rng.standard_normal(count)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder as that of SLAMMER, with two events."""
    records = tmp_path_factory.mktemp("records")
    lines = []
    for count, (event, name) in enumerate((("First 1990", "A-000"), ("Second 1991", "B-090"))):
        (records / event).mkdir()
        (records / event / name).write_text("\n".join(map(repr, pulses(count).tolist())))
        lines.append(f"{event}\t{name}\t0.01\t6.0")
    (records / make.LIST).write_text("\n".join(lines))
    return records


@pytest.fixture(scope="module")
def responses(folder):
    return [make.respond(component) for component in make.components(folder)]


def plateau_g(component):
    """The geometric mean of the spectrum over the plateau, by SciPy's linear systems."""
    fine = np.arange(0.0, (component.a_mps2.size - 1) * component.dt_s, component.dt_s / 20.0)
    a = np.interp(fine, np.arange(component.a_mps2.size) * component.dt_s, component.a_mps2)
    peaks = []
    for omega in 2.0 * np.pi / make.PLATEAU_S:
        oscillator = signal.lti([-1.0], [1.0, 0.1 * omega, omega**2])
        peaks.append(omega**2 * np.abs(signal.lsim(oscillator, a, fine)[1]).max() / make.G)
    return np.exp(np.log(peaks).mean())


@pytest.mark.nightly
@pytest.mark.parametrize(
    ("period", "slope", "mu", "s_ds"), by_day([(2, 28, 14, 12), (0, 8, 2, 9)], 1)
)
def test_a_run_is_that_of_the_solver(folder, responses, period, slope, mu, s_ds):
    component = make.components(folder)[1]
    a, dt_s = component.a_mps2, component.dt_s
    scale = make.S_DS_G[s_ds] / plateau_g(component)
    if make.PERIODS_S[period]:
        roof = to_roof(a, dt_s, building_of_periods([make.PERIODS_S[period]]))
        a, dt_s = roof.a_mps2, roof.dt_s
    slope_rad, mu_value = np.radians(make.SLOPES_DEG[slope]), make.MUS[mu]
    result = solver.slide(scale * a, dt_s, slope_rad=slope_rad, mu=mu_value)
    assert responses[1].prd_m[period, slope, mu, s_ds] == pytest.approx(result.prd_m, rel=0.01)
    assert result.prd_m > 0.02
    ppa_mps2 = np.abs(a).max() / plateau_g(component)
    assert responses[1].ppa_mps2[period] == pytest.approx(ppa_mps2, rel=2e-3)


def test_statistics_count_components_and_events_are_whole_in_a_half():
    numbers = np.arange(100.0)[:, None, None, None, None]
    prd_m = np.broadcast_to(numbers, (100, 4, 29, 15, 16)).copy()
    prd_m[0] = np.nan
    row = make.cases(prd_m).loc[(0.8, 2.0, 0.5, 1.0)]
    assert row["median_m"] == 50.0  # the 50th of 1 to 99, then the one without a value
    assert row["p84_m"] == 84.0
    assert row["envelope_m"] == np.inf
    assert row["without_value"] == 1
    assert row["share_over_prescriptive"] == 1.0  # 60 in x 0.36 is below a meter
    assert make.cases(prd_m).loc[(0.8, 2.0, 0.5, 2.2), "share_over_prescriptive"] == 0.96
    events = ["a"] * 5 + ["b"] * 4 + ["c"] * 3 + ["d"]
    assert make.halves(events).tolist() == [True] * 5 + [False] * 7 + [True]


def test_capacities_are_where_the_runs_cross_a_limit_and_the_least_friction_keeps_it():
    cross_g = np.linspace(0.5, 2.5, 101)  # of each component, with a PRD that grows as S_DS
    prd_m = 24 * make.INCH * (make.S_DS_G / cross_g[:, None])
    whole = np.broadcast_to(prd_m[:, None, None, None, :], (101, 4, 29, 15, 16))
    row = make.capacities(whole).loc[(0.0, 0.0, 0.5, 24)]
    assert row["s_ds_50_g"] == pytest.approx(1.5)
    assert (row["s_ds_16_g"], row["s_ds_84_g"]) == pytest.approx((0.82, 2.18), abs=0.011)
    assert row["beta"] == pytest.approx(0.5 * np.log(row["s_ds_84_g"] / row["s_ds_16_g"]))
    most = make.capacities(2.0 * whole).loc[(0.0, 0.0, 0.5, 48)]
    assert most["s_ds_50_g"] == pytest.approx(1.5)
    assert np.isnan(make.capacities(0.1 * whole).loc[(0.0, 0.0, 0.5, 24), "s_ds_84_g"])
    axes = {"period_s": [0.0], "slope_deg": [2.0], "mu": make.MUS, "s_ds_g": [1.0]}
    index = pd.MultiIndex.from_product(axes.values(), names=list(axes))
    table = pd.DataFrame({"p84_m": 48 * make.INCH * (1.3 - make.MUS)}, index=index)
    row = make.least_friction(table).loc[(0.0, 2.0, 1.0)]
    assert row.tolist() == pytest.approx([np.nan, np.nan, 0.8, 0.3], nan_ok=True)
    table["p84_m"] += 1e-3
    assert make.least_friction(table).loc[(0.0, 2.0, 1.0), "least_mu_24_in"] == pytest.approx(0.81)


def test_all_that_is_missing_is_named(folder, tmp_path):
    with pytest.raises(InputError, match=r"eq\.sql: not found"):
        make.components(tmp_path)
    (tmp_path / make.LIST).write_text("E\tF\t0.01\nE\tG\t0.02\n")
    (tmp_path / "E").mkdir()
    (tmp_path / "E" / "G").write_text("0.1 what")
    with pytest.raises(InputError) as caught:
        make.components(tmp_path)
    assert [problem.split(": ")[0] for problem in caught.value.problems] == [
        str(tmp_path / "E" / "F"), str(tmp_path / "E" / "G"),
    ]  # fmt: skip


@pytest.fixture(scope="module")
def page():
    return (ROOT / "docs" / "design-curves.md").read_text()


@pytest.fixture(scope="module")
def about():
    return json.loads((TABLES / "equation.json").read_text())


def test_the_page_states_the_equation_and_what_was_run(page, about):
    constants = about["constants"]
    c, p, s = (constants[name] for name in "cps")
    assert f"PRD = {c} V² / A (1 − r)^{p} exp({s} √(θ / r))" in page
    for value in (about["runs"], about["components"]):
        assert f"{value:,}" in page
    for name, tried in about["tried"]["all"].items():
        cells = [f"{tried[key]:.2f}".replace("-", "−") for key in ("mean", "deviation")]
        assert f"| {name} | {' | '.join(cells)} |" in page
    for place in ("rock", "roofs"):
        for tried in about["tried"][place].values():
            shown = f"{tried['mean']:z.2f} ± {tried['deviation']:.2f}".replace("-", "−")
            assert f"| {shown} |" in page
    for row in about["peaks"]:
        assert f"{row['ppa_per_s_ds']:.2f}" in page
        assert f"{row['ppv_mps_per_s_ds_g']:.2f}" in page


def test_the_page_states_the_scatter_of_all_runs_before_that_of_each_half(page, about):
    halves = [Scatter(**about["fitted"]), Scatter(**about["tried"]["all"]["this formula"])]
    assert pooled(halves) == Scatter(**about["every_run"])
    shown = [
        f"{about['every_run']['deviation']:.3f}",
        *(f"{half.deviation:.3f}" for half in halves),
    ]
    places = [page.index(text) for text in shown]
    assert places == sorted(places)
    assert "(1 − r)" in page[: places[0]]
    assert f"over all {about['every_run']['runs']:,} such runs" in page
    factor = np.exp(about["every_run"]["deviation"])
    assert f"a factor of {factor:.2f} for the 84th percentile" in page


def test_the_example_is_computed_with_the_numbers_that_are_printed(page, about):
    text = page.partition("Example: ")[2].partition("\n\n")[0].replace("\n", " ")
    (row,) = (row for row in about["peaks"] if row["period_s"] == 0.8)
    a_g, v_mps = round(row["ppa_per_s_ds"], 2), round(row["ppv_mps_per_s_ds_g"], 2)
    assert "S_DS = 1.0 g, a slope of 2° and μ = 0.5. With" in text
    assert f"A = {a_g:.2f} g, V = {v_mps:.2f} m/s" in text
    theta = np.radians(2.0)
    k = np.tan(np.arctan(0.5) - theta)
    r, length_m = k / a_g, v_mps**2 / (a_g * STANDARD_GRAVITY_MPS2)
    c, p, s = (about["constants"][name] for name in "cps")
    root = np.sqrt(theta / r)
    steep, ratchets = (1.0 - r) ** p, np.exp(s * root)
    prd_m = c * length_m * steep * ratchets
    assert f"V² / A = {length_m:.3f} m, k = {k:.3f}, r = {r:.3f} and" in text
    product = f"{c} × {length_m:.3f} × {steep:.3f} × {ratchets:.2f} = {prd_m:.3f} m"
    assert f"√(θ / r) = {root:.3f}, the PRD is {product}" in text
    median_m = cases().loc[(0.8, 2.0, 0.5, 1.0), "median_m"]
    assert (
        f"({prd_m / make.INCH:.1f} in). The median of the runs is {median_m / make.INCH:.1f}"
        in text
    )


def cases():
    return pd.read_parquet(TABLES / "curves.parquet")


def test_the_shares_over_the_prescriptive_displacement_are_those_of_the_table(page):
    share = 100.0 * cases()["share_over_prescriptive"]
    shown = {
        at: [f"{share.loc[(period, at[0], 0.5, at[1])]:.0f}%" for period in (0.8, 1.5)]
        for at in ((2.0, 1.0), (2.0, 1.6), (4.0, 1.0))
    }
    short, long = shown[2.0, 1.0]
    assert f"μ = 0.5, a slope of 2° and S_DS = 1.0 g ({short} for 0.8 s, {long} for 1.5 s)." in page
    high, steep = (" and ".join(shown[at]) for at in ((2.0, 1.6), (4.0, 1.0)))
    assert f"At 1.6 g the shares are {high}; at 4° and 1.0 g they are {steep}:" in page


def test_no_value_of_the_tables_or_the_page_is_minus_zero(page):
    for name in ("curves", "least-friction", "fragility"):
        text = (TABLES / f"{name}.csv").read_text()
        assert not re.search(r"(?<![\d.e])-0(?:\.0*)?(?![.\d])", text)
    assert not re.search(r"[-−]0(?:\.0*)?(?![.\d])", page)


@pytest.mark.quick
def test_a_sweep_in_which_nothing_slips_has_no_minus_zero():
    swept = sweep(0.1 * pulses(1), 0.01, slopes_rad=np.zeros(1), mus=np.ones(1), scales=np.ones(1))
    assert (swept.prd_m == 0.0).all()
    assert not np.signbit(swept.prd_m).any()


@pytest.mark.parametrize("name", ["curves", "least-friction", "fragility"])
def test_both_files_of_a_table_agree(name):
    exact = pd.read_parquet(TABLES / f"{name}.parquet").reset_index()
    typed = pd.read_csv(TABLES / f"{name}.csv")
    assert list(exact) == list(typed)
    np.testing.assert_allclose(typed, exact, rtol=6e-4)


def test_more_friction_or_less_shaking_never_gives_a_larger_median():
    median = pd.read_parquet(TABLES / "curves.parquet")["median_m"]
    assert (median.unstack("s_ds_g").diff(axis=1).iloc[:, 1:] >= 0.0).all(axis=None)
    assert (median.unstack("mu").diff(axis=1).iloc[:, 1:] <= 1e-4).all(axis=None)


TRUTH = Equation(c=3.0, p=2.5, s=1.8)


def runs(count=400, seed=1):
    """Runs with the PRD of the formula."""
    rng = np.random.default_rng(seed)
    peaks = {
        "ppa_mps2": rng.uniform(3.0, 30.0, count),
        "ppv_mps": rng.uniform(0.3, 3.0, count),
        "slope_rad": np.radians(rng.uniform(0.0, 7.0, count)),
        "mu": rng.uniform(0.3, 1.0, count),
    }
    made = RoofRuns(**peaks, prd_m=np.zeros(count))
    with np.errstate(invalid="ignore"):
        return RoofRuns(**peaks, prd_m=TRUTH.prd_m(made))


def test_runs_that_follow_the_formula_give_its_constants_and_their_scatter():
    made = runs()
    assert 100 < made.holds.sum() < made.holds.size  # some slide too little, and are not fitted
    parts = [made.only(np.arange(400) % 3 == k) for k in range(3)]
    assert fit_equation([made]) == fit_equation(parts) == TRUTH
    made = runs().only(runs().holds)
    off = np.random.default_rng(2).normal(0.1, 0.5, made.prd_m.size)
    found = scatter(made.prd_m * np.exp(off), TRUTH.prd_m(made))
    assert (found.mean, found.deviation) == pytest.approx((off.mean(), off.std()))
    assert found.runs == off.size


def test_what_hardly_slides_has_no_value_or_one_slope_is_not_fitted():
    made = RoofRuns(
        ppa_mps2=np.full(4, 10.0),
        ppv_mps=np.ones(4),
        slope_rad=np.zeros(4),
        mu=np.array([0.5, 0.5, 0.5, 1.0]),
        prd_m=np.array([LEAST_PRD_M, np.nan, 0.5 * LEAST_PRD_M, 1.0]),
    )
    assert made.holds.tolist() == [True, False, False, False]  # the last has r = 0.98
    flat = replace(runs(), slope_rad=np.zeros(400), prd_m=np.ones(400))
    with pytest.raises(InputError, match="more slopes"):
        fit_equation([flat])


@pytest.mark.quick
def test_published_formulas_give_what_their_terms_do_by_hand():
    half = RoofRuns(
        ppa_mps2=np.array([STANDARD_GRAVITY_MPS2]),
        ppv_mps=np.array([1.0]),
        slope_rad=np.zeros(1),
        mu=np.array([0.5]),
        prd_m=np.zeros(1),
    )
    assert half.r == pytest.approx(0.5)
    # 10^0.90 0.5^(2.53 - 1.09) and 10^0.215 0.5^(2.341 - 1.438) cm
    assert ambraseys_menu_m(half) == pytest.approx(0.02928, rel=1e-3)
    assert jibson_m(half) == pytest.approx(0.00877, rel=1e-3)
    # exp(-1.56 - 2.29 - 5.21 + 5.59375 - 1.90625 + 1.55 ln 100) cm
    assert saygili_rathje_m(half) == pytest.approx(0.01 * np.exp(1.76551), rel=1e-4)
