"""The design curves: each run that of the solver, each statistic and figure of the docs counted."""

import json

import numpy as np
import pandas as pd
import pytest
from scipy import signal

import solver
from nightly import by_day
from places import ROOT
from projects.curves import make
from solver.building.roof import to_roof
from solver.building.structure import building_of_periods
from solver.model import InputError

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
    assert responses[1].ppa_mps2[period] == pytest.approx(
        np.abs(a).max() / plateau_g(component), rel=2e-3
    )


def test_statistics_count_components_and_a_run_without_a_value_is_the_largest():
    prd_m = np.broadcast_to(
        np.arange(100.0)[:, None, None, None, None], (100, 4, 29, 15, 16)
    ).copy()
    prd_m[0] = np.nan
    row = make.cases(prd_m).loc[(0.8, 2.0, 0.5, 1.0)]
    assert row["median_m"] == 50.0  # the 50th of 1 to 99, then the one without a value
    assert row["p84_m"] == 84.0
    assert row["envelope_m"] == np.inf
    assert row["without_value"] == 1
    assert row["share_over_prescriptive"] == 1.0  # 60 in x 0.36 is below a meter
    assert make.cases(prd_m).loc[(0.8, 2.0, 0.5, 2.2), "share_over_prescriptive"] == 0.96


def test_capacities_are_where_the_runs_cross_a_limit():
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


def test_the_least_friction_keeps_the_limit_and_is_rounded_up():
    axes = {"period_s": [0.0], "slope_deg": [2.0], "mu": make.MUS, "s_ds_g": [1.0]}
    index = pd.MultiIndex.from_product(axes.values(), names=list(axes))
    table = pd.DataFrame({"p84_m": 48 * make.INCH * (1.3 - make.MUS)}, index=index)
    row = make.least_friction(table).loc[(0.0, 2.0, 1.0)]
    assert row.tolist() == pytest.approx([np.nan, np.nan, 0.8, 0.3], nan_ok=True)
    table["p84_m"] += 1e-3
    assert make.least_friction(table).loc[(0.0, 2.0, 1.0), "least_mu_24_in"] == pytest.approx(0.81)


def test_events_are_whole_in_a_half_and_the_halves_alike():
    events = ["a"] * 5 + ["b"] * 4 + ["c"] * 3 + ["d"]
    assert make.halves(events).tolist() == [True] * 5 + [False] * 7 + [True]


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
    assert (
        f"PRD = {constants['c']} V² / A (1 − r)^{constants['p']} exp({constants['s']} √(θ / r))"
        in page
    )
    for value in (about["runs"], about["components"]):
        assert f"{value:,}" in page
    for name, tried in about["tried"]["all"].items():
        cells = [f"{tried[key]:.2f}".replace("-", "−") for key in ("mean", "deviation")]
        assert f"| {name} | {' | '.join(cells)} |" in page
    for row in about["peaks"]:
        assert f"{row['ppa_per_s_ds']:.2f}" in page
        assert f"{row['ppv_mps_per_s_ds_g']:.2f}" in page


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
