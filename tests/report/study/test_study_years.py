"""Rates and lives of a study: the sheet Hazard, its errors, pages, tables and years.json."""

import io
import json
import math
from dataclasses import replace

import numpy as np
import pytest
from openpyxl import load_workbook

import printed
from report.sheet.reading.linked_files import SUPPORTING, StudyYears
from report.study.files import study_files
from report.study.run import planned, run_study
from report.study.schema import Hazard, HazardPoint, Intensity, StudyArray, StudyFrictionRun
from report.study.shaking import points_of
from report.study.years import RECURRENCES
from solver.friction_tests import Surface
from solver.model import InputError
from solver.studies.rates import exceedance_rates
from study_books import given, plan, problems, write

POINTS = ((0.01, 0.5), (0.1, 0.05), (0.3, 0.006), (1.0, 1e-4), (3.0, 5e-7), (7.0, 0.0))
TWO = "im_g,annual_rate\n" + "\n".join(f"{x},{rate}" for x, rate in POINTS) + "\n"
SAVED = """IMT,PGA
Ground Motion (g),0.01,0.1,1
Annual Frequency of Exceedence,0.5,0.05,0.0001

IMT,1.00 Second Spectral Acceleration
Ground Motion (g),0.02,0.2
Annual Frequency of Exceedence,0.3,0.03
"""


def hazard(**changes):
    about = {
        "site": "Here, 34, -118",
        "source": "Survey",
        "edition": "Model 2018",
        "vs30_mps": 760.0,
        "site_vs30_mps": 260.0,
        "site_factor": 1.2,
        "site_basis": "Table S",
        "roof_factor": 2.5,
        "roof_basis": "Table R",
    }
    return Hazard(**{**about, **changes})


def curve(*points):
    return tuple(HazardPoint(intensity=x, annual_rate=rate) for x, rate in points)


def yearly(**changes):
    """A study with a typed curve, an array and six friction runs."""
    rows = curve(*POINTS)
    values = ((Surface.DRY, 0.47), (Surface.DRY, 0.44), (Surface.DRY, 0.46),
              (Surface.WET, 0.38), (Surface.WET, 0.40), (Surface.WET, 0.42))  # fmt: skip
    runs = tuple(
        StudyFrictionRun(mat="a", surface=surface, number=k, mu=mu)
        for k, (surface, mu) in enumerate(values, start=1)
    )
    arrays = (StudyArray(id="S1", mat="A", slope_deg=2.0, clearance_m=0.3, reaches="RTU"),)
    about = {"hazard": hazard(), "hazard_points": rows, "friction_runs": runs}
    return given(**{**about, "study_arrays": arrays, **changes})


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    folder = write(
        tmp_path_factory.mktemp("years"), yearly(hazard=hazard(recenter_m=0.05)), motions=4
    )
    return run_study(planned(folder)[0], folder / "out")


@pytest.fixture(scope="module")
def made(results):
    return study_files(results)


def test_files_of_two_columns_and_of_the_tool_are_read():
    assert points_of(TWO.splitlines(), is_spectral=False) == list(POINTS)
    assert points_of(SAVED.splitlines(), is_spectral=False) == [
        (0.01, 0.5),
        (0.1, 0.05),
        (1.0, 1e-4),
    ]
    assert points_of(SAVED.splitlines(), is_spectral=True) == [(0.02, 0.3), (0.2, 0.03)]
    padded = SAVED.replace("IMT,PGA", "IMT,PGA,,").replace(",0.03\n", ",0.03,\n")
    assert points_of(padded.splitlines(), is_spectral=True) == [(0.02, 0.3), (0.2, 0.03)]
    assert points_of("im;rate\n0,01;0,5\n0,1;0,05\n".splitlines(), is_spectral=False) == list(
        POINTS[:2]
    )


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("im,rate\n0.1,0.2\n0.2,low\n", "has '0.2,low'"),
        ("nothing\n", "has 'nothing'"),
        (SAVED + "\n" + SAVED, "has 2 curves of PGA"),
    ],
)
def test_other_files_are_refused(text, said):
    with pytest.raises(InputError, match=said):
        points_of(text.splitlines(), is_spectral=False)


def test_a_file_is_read_to_the_roof(tmp_path):
    study = yearly(hazard=hazard(file="curve.csv"), hazard_points=(), record_beta=0.3,
                   record_source="Here")  # fmt: skip
    write(tmp_path, study)
    (tmp_path / "curve.csv").write_text(TWO)
    (curve,) = plan(tmp_path).hazard
    assert curve.intensity == pytest.approx(3.0 * np.array([x for x, _ in POINTS[:-1]]))
    assert curve.rate.tolist() == [rate for _, rate in POINTS[:-1]]
    assert curve.beta == 0.3
    (tmp_path / "curve.csv").write_text("0.1,0.2\n0.05,0.1\n")
    assert "<" not in (said := problems(tmp_path))
    assert "point 2 of the curve is 0.05 at 0.1 a year" in said
    assert said.startswith("Hazard!")


@pytest.mark.parametrize(
    ("changes", "lines"),
    [
        ({"hazard": hazard(site_factor=None, site_basis="")}, ["Factor to the site is missing"]),
        ({"hazard": hazard(roof_factor=None, roof_basis="")}, ["Factor to the roof is missing"]),
        ({"hazard": hazard(site_basis="")}, ["Basis of this factor is missing"]),
        ({"hazard": hazard(site_vs30_mps=760.0)}, ["Factor to the site is given"]),
        ({"hazard": hazard(source="", edition="")},
         ["Source of the curve is missing", "Hazard model is missing"]),
        ({"hazard": hazard(file="a.csv")}, ["Hazard curve file is named"]),
        ({"hazard_points": ()}, ["Site is given without a hazard curve"]),
        ({"intensity": Intensity.PPV}, ["has no hazard curve"]),
        ({"study_arrays": ()}, ["but no array is"]),
        ({"hazard_points": curve((0.1, 0.5), (1.0, 0.6))}, ["point 2 of the curve is 1 at 0.6"]),
        ({"hazard_points": curve((0.1, 0.0), (1.0, 0.6))}, ["has 1 point with a rate above 0"]),
        ({"hazard_points": curve((0.1, 0.5), (1.0, 0.0), (2.0, 0.1))}, ["point 2 of the curve is"]),
        ({"hazard_points": curve((0.1, 50.0), (1.0, 2.0))}, ["point 1 of the curve is 0.1 at 50"]),
        ({"friction_runs": (StudyFrictionRun(mat="Z", surface=Surface.DRY, number=1, mu=0.5),)},
         ["mat 'Z' is not on the sheet Mats"]),
        ({"friction_runs": (StudyFrictionRun(mat="A", surface=Surface.DRY, number=1, mu=0.5),)},
         ["1 friction runs on 1 surfaces"]),
    ],
)  # fmt: skip
def test_what_a_hazard_lacks_is_said_at_its_cell(tmp_path, changes, lines):
    write(tmp_path, yearly(**changes))
    said = problems(tmp_path).splitlines()
    assert len(said) == len(lines)
    for line, wanted in zip(said, lines, strict=True):
        assert wanted.casefold() in line.casefold()
        assert "!" in line.partition(":")[0]


def test_a_workbook_without_the_sheets_has_no_years(tmp_path):
    write(tmp_path)
    book = load_workbook(tmp_path / "input.xlsx")
    del book["Hazard"], book["Friction runs"]
    book.save(tmp_path / "input.xlsx")
    found = plan(tmp_path)
    assert (found.hazard, found.predicted) == ((), {})


def test_rates_are_those_of_the_responses(results):
    (one,), (curve,) = results.years, results.plan.hazard
    assert one.change < 0.005
    assert one.mus == results.plan.predicted["a"].quantiles
    exact = exceedance_rates(curve, one.responses.levels, one.responses.prd_m, np.array([0.3]))
    assert one.clearance_rates[0] == pytest.approx(exact.mean(), rel=1e-12)
    low, high = one.clearance_rates[1:]
    assert low <= one.clearance_rates[0] <= high
    for years, prd_m in zip(RECURRENCES, one.prd_m, strict=True):
        if 0.0 < prd_m < math.inf:
            found = exceedance_rates(
                curve, one.responses.levels, one.responses.prd_m, np.array([prd_m])
            )
            assert found.mean() == pytest.approx(1.0 / years, rel=5e-3)
    assert (np.diff(one.prd_by_mu_m, axis=0) <= 0.0).all()
    assert one.shares.sum() == pytest.approx(1.0)


def test_lives_are_put_back_as_they_say(results):
    (one,) = results.years
    never, above, always = one.statistics.values()
    assert above[1].p95_m <= 0.05 or math.isinf(above[1].p95_m)
    assert always[1].mean_m == 0.0
    assert always[0].p95_m <= never[0].p95_m
    assert never[0].beyond >= never[1].beyond


def test_the_page_says_what_the_curve_is_and_what_follows(results, made):
    assert made["study.pdf"].startswith(b"%PDF-")
    text = printed.study(results)
    assert text.count(SUPPORTING) >= 1
    for said in ("Here, 34, -118; Survey; Model 2018", "760 m/s, which is rock", "(Table S)"):
        assert said in text
    assert "The hazard curve ends" not in text
    shown = printed.study(
        replace(results, plan=replace(results.plan, hazard=(ended(results.plan.hazard[0]),)))
    )
    assert "The hazard curve ends at PPA = 0.9 g" in shown


def ended(curve):
    """The curve without its last points."""
    return replace(curve, intensity=curve.intensity[:3], rate=curve.rate[:3])


def test_tables_have_the_numbers_of_the_page(results, made):
    (one,) = results.years
    book = load_workbook(io.BytesIO(made["study.xlsx"]))
    for sheet in book:
        assert SUPPORTING in [cell.value for row in sheet for cell in row]
    rows = {row[2:4]: row[4:] for row in book["25 years"].values}
    assert rows["Clearance exceeded", "annual rate"][0] == pytest.approx(one.clearance_rates[0])
    assert rows["PRD", "475 years"][0] == pytest.approx(one.prd_m[1] / 0.0254)
    found = StudyYears.model_validate_json(made["years.json"])
    assert found.note == SUPPORTING
    assert found.arrays[0].prd_m["700"] == pytest.approx(one.prd_m[2])
    assert json.loads(made["years.json"])["hazard"]["site_factor"] == 1.2
