"""The study workbook: what is written is read, every error names its cell; hazard and years."""

import io
import json
import math
import re
import shutil
from dataclasses import replace
from zipfile import ZipFile

import numpy as np
import pytest
from openpyxl import load_workbook

from fixtures import pages
from fixtures.cells import address, cell
from fixtures.marks import by_day
from fixtures.paths import ROOT
from fixtures.study_workbooks import (
    cell_address,
    command,
    plan,
    problems,
    study_input,
    usual,
    write,
)
from fixtures.workbooks import edit, type_into
from projects.study.make import study
from report.project.model.choices import UnitsFirst
from report.project.read.read import read
from report.project.read.years_file import SUPPORTING, StudyYears
from report.study import outputs
from report.study.hazard_curve import points_of
from report.study.manifest import manifest_of
from report.study.outputs import study_files, study_html
from report.study.read_study import read_study, write_study
from report.study.run_study import planned, run_study
from report.study.study_input import (
    Hazard,
    HazardPoint,
    Intensity,
    Mat,
    Sampling,
    StudyArray,
    StudyBuilding,
    StudyFrictionRun,
    StudyMotion,
    values,
)
from report.study.years import RECURRENCES
from report.typeset.pdf import lay_out
from solver.errors import InputError
from solver.friction_tests import Surface
from solver.studies.rates import exceedance_rates

FOLDER = "<Study/Folder of motions>"


@pytest.mark.parametrize(
    ("text", "wanted"),
    [("0, 1, 2.5", (0.0, 1.0, 2.5)), ("0.1 to 0.3 by 0.1", (0.1, 0.2, 0.3)), ("1; 2", (1.0, 2.0)),
     ("0,5", ()), ("1, 1", ()), ("", ()), ("a, b", ()), ("0 to 1 by 0.3", ()), ("0 to 1 by 0", ()),
     ("1 to 0 by 0.1", ()), ("0 to 1 by 0.0001", ()), ("nan", ()), ("0 to inf by 1", ())],
)  # fmt: skip
@pytest.mark.quick
def test_lists_are_read_or_refused(text, wanted):
    found = values(text)
    assert found == wanted or (text == "nan" and len(found) == 1)


@pytest.mark.parametrize("units", list(UnitsFirst))
def test_what_is_written_is_read(tmp_path, units):
    write(tmp_path)
    study = study_input(allowed_m=0.5, site_intensity=1.2, s_ds_g=1.0)
    write_study(tmp_path / "input.xlsx", units=units, example=study)
    found = read_study(tmp_path).project
    assert found.study.allowed_m == pytest.approx(0.5)
    assert found.study.model_copy(update={"allowed_m": 0.5}) == study.study
    assert (found.mats, found.motions, found.buildings) == (study.mats, (), ())
    assert found.study_arrays[0].clearance_m == pytest.approx(0.3)


def test_the_grid_has_the_friction_of_the_mats(tmp_path):
    found = plan(write(tmp_path, study_input(mus="0.5, 0.7")))
    assert found.input.mus == (0.4, 0.5, 0.6, 0.7)
    assert found.shape == (1, 3, 4, 4)
    assert len(found.campaign.cases) == 3 * 4 * 4 + 4


def test_a_folder_gives_motions_with_their_components(tmp_path):
    found = plan(write(tmp_path, letters="xyz"))
    assert [motion.id for motion in found.motions.motions[0]] == ["M0", "M1", "M2"]
    assert all(m.has_transverse and m.has_vertical for m in found.motions.motions[0])


def test_intensity_one_has_the_measure_one(tmp_path):
    for kind, s_ds_g, scale in ((Intensity.PPA, None, 1.0), (Intensity.S_DS, 0.8, 1.25)):
        found = plan(write(tmp_path, study_input(intensity=kind, s_ds_g=s_ds_g)))
        assert found.motions.motions[0][0].scale == pytest.approx(scale, rel=1e-6)


def test_ground_motions_go_through_every_building(tmp_path):
    buildings = (StudyBuilding(id="stiff", period_s=0.05), StudyBuilding(id="soft", period_s=0.8))
    study = study_input(intensity=Intensity.PGA, recorded_at="ground", buildings=buildings)
    found = plan(write(tmp_path, study))
    assert found.motions.buildings == ("stiff", "soft")
    assert found.shape[0] == 2
    stiff, soft = (m[0] for m in found.motions.motions)
    assert stiff.scale == soft.scale == pytest.approx(1.0, rel=1e-6)
    assert abs(stiff.ax_mps2).max() != pytest.approx(abs(soft.ax_mps2).max(), rel=0.05)


def test_listed_motions_are_read(tmp_path):
    rows = (StudyMotion(id="K1", record="records/M0-x.csv", source="Kobe"),)
    found = plan(write(tmp_path, study_input(folder="", motions=rows)))
    assert [(m.id, m.source) for m in found.motions.motions[0]] == [("K1", "Kobe")]


def test_all_combinations_take_every_tested_value(tmp_path):
    study = study_input(
        site_intensity=1.0, sampling=Sampling.ALL_COMBINATIONS, slope_tolerance_deg=0.5
    )
    found = plan(write(tmp_path, study))
    cases = found.campaign.cases[found.arrays[0].samples]
    assert sorted(set(cases.mu)) == [0.38, 0.40, 0.42]
    assert len(cases) == 9


@pytest.mark.quick
def test_a_study_workbook_is_told_which_command_reads_it(tmp_path):
    folder = write(tmp_path, study_input())
    with pytest.raises(InputError, match="run roofslip study"):
        read(folder)


def test_an_ordinary_workbook_is_told_what_to_do(tmp_path):
    shutil.copy(ROOT / "projects" / "example" / "input.xlsx", tmp_path / "input.xlsx")
    assert "roofslip new DIR --study" in problems(tmp_path)


@pytest.mark.parametrize(
    ("changes", "wanted"),
    by_day([
        ({"slopes_deg": "2, 1"}, ("<Study/Slopes>: slopes are '2, 1'", "0 to 7 by 0.5")),
        ({"slopes_deg": "50"}, ("<Study/Slopes>: slopes have 50; enter numbers from 0 to 45",)),
        ({"intensities": "inf"}, ("<Study/Intensities>: intensities have inf",)),
        ({"mats": (), "study_arrays": ()},
         ("<Study/Friction coefficients>: friction coefficients are missing",)),
        ({"intensity": Intensity.S_DS},
         ("<Study/S_DS of the motions>: S_DS of the motions is missing",)),
        ({"intensity": Intensity.PGA},
         ("<Study/Intensity measure>: is PGA, but the motions are roof motions",)),
        ({"folder": "elsewhere"}, (f"{FOLDER}: 'elsewhere' is not a folder",)),
        ({"folder": "../"}, (f"{FOLDER}: '..' is not a folder",)),
        ({"recorded_at": "ground"}, ("Buildings!", "at least one building")),
        ({"buildings": (StudyBuilding(id="b", period_s=0.5),)},
         ("<Buildings/1/ID>", "roof motions")),
        ({"mats": (Mat(id="A", mu=0.4), Mat(id="a", mu=0.5))},
         ("<Mats/2/ID>: ID is 'a', already used at <Mats/1/ID>",)),
        ({"mats": (Mat(id="A", tested="0.4, 0.5"),)},
         ("<Mats/1/Tested values>: tested values are '0.4, 0.5'",)),
        ({"mats": (Mat(id="B", mu=0.4),)},
         ("<Arrays/1/Mat>: mat 'a' is not on the Mats worksheet",)),
        ({"site_intensity": 1.0, "study_arrays": ()},
         ("<Study/Intensity at the site>: is entered, but no array is",)),
        ({"site_intensity": 1.0, "intensity_beta": 0.2, "sampling": Sampling.ALL_COMBINATIONS},
         ("<Study/Dispersion of intensity>: all combinations use the median",)),
        ({"record_beta": 0.4},
         ("<Study/Record-to-record source>: the record-to-record dispersion needs its source",)),
        ({"slopes_deg": "0 to 45 by 0.1", "intensities": "1 to 100 by 0.25",
          "mus": "0.1 to 2 by 0.01"}, ("<Study/Intensities>: make", "cases")),
    ], 4),
    ids=lambda value: str(value)[:40] if isinstance(value, dict) else "",
)  # fmt: skip
def test_errors_name_the_cell_and_what_to_do(tmp_path, changes, wanted):
    found = problems(write(tmp_path, study_input(**changes)))
    assert all(cell_address(text) in found for text in wanted), found


def test_cells_of_a_wrong_kind_are_all_listed(tmp_path):
    folder = write(tmp_path)
    wrong = {"Study/Title": None, "Study/Tolerance of slope": "many",
             "Mats/A/Friction coefficient": -1}  # fmt: skip
    type_into(folder / "input.xlsx", wrong)
    lines = problems(folder).splitlines()
    assert [line.split(":")[0] for line in lines] == [address(usual(), name) for name in wrong]


@pytest.mark.parametrize(
    ("letters", "change", "wanted"),
    by_day(
        [
            ("x", lambda folder: (folder / "M1-x.csv").write_text("no record"), "M1-x.csv"),
            (
                "xz",
                lambda folder: (folder / "M2-z.csv").unlink(),
                "motion M2 has 1 components, the first has 2",
            ),
            (
                "xz",
                lambda folder: (folder / "M1-x.csv").unlink(),
                "'records' contains no record M1-x",
            ),
            (
                "x",
                lambda folder: [path.unlink() for path in folder.iterdir()],
                "'records' contains no record",
            ),
        ],
        2,
    ),
    ids=["damaged", "other components", "without its first component", "empty"],
)
def test_a_folder_of_motions_is_refused_at_its_cell(tmp_path, letters, change, wanted):
    folder = write(tmp_path, letters=letters)
    (folder / "records" / "suite.json").write_text("{}")
    change(folder / "records")
    (line,) = problems(folder).splitlines()
    assert line.startswith(cell_address(FOLDER))
    assert wanted in line


def test_too_many_samples_and_runs_are_refused_at_their_cell(tmp_path, monkeypatch):
    folder = write(tmp_path)
    monkeypatch.setattr("report.study.study_motions.MOST_SAMPLES", 1000)
    assert cell_address(f"{FOLDER}: the records have 1,200 samples") in problems(folder)
    monkeypatch.undo()
    monkeypatch.setattr("report.study.study_plan.MOST_RUNS", 10)
    assert cell_address("<Study/Intensities>: make") in problems(folder)


def test_the_project_is_what_its_script_writes(tmp_path):
    again = tmp_path / "input.xlsx"
    write_study(again, units=UnitsFirst.US, example=study())
    with ZipFile(again) as made, ZipFile(ROOT / "projects/study/input.xlsx") as committed:
        names = set(made.namelist())
        assert names == set(committed.namelist())
        for part in names - {"docProps/core.xml"}:
            assert made.read(part) == committed.read(part), part


def test_what_a_study_reads_from_hidden_cells_is_a_warning(tmp_path):
    folder = write(tmp_path)
    assert plan(folder).warnings == ()
    edit(folder / "input.xlsx", lambda book: setattr(book["Mats"], "sheet_state", "hidden"))
    ((cell, text),) = plan(folder).warnings
    assert cell.startswith("Mats!")
    assert text.startswith("the worksheet is hidden, but cells ")
    assert text.endswith(" on it are used: unhide it, or clear the cells that you do not want")
    shown = command(folder, "--dry-run")
    assert f"warning: {cell}: {text}" in shown.stderr
    assert " MB of disk space" in shown.output
    assert not (folder / "out").exists()


def test_an_intensity_may_be_shown_in_the_unit_of_its_measure(tmp_path):
    folder = write(tmp_path, study_input(site_intensity=1.2))
    name = "Study/Intensity at the site"
    plan(formatted(folder, name, '0.0" g"'))
    formatted(folder, name, '0.0" m/s"')
    assert "is 1.2, shown in m/s by its number format" in problems(folder)


def formatted(folder, name, code):
    """Give a cell a number format; return the folder."""
    edit(folder / "input.xlsx", lambda book: setattr(cell(book, name), "number_format", code))
    return folder


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
    return study_input(**{**about, "study_arrays": arrays, **changes})


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    folder = write(
        tmp_path_factory.mktemp("years"), yearly(hazard=hazard(recenter_m=0.05)), motions=4
    )
    return run_study(planned(folder)[0], folder / "out")


@pytest.fixture(scope="module")
def made(results):
    """Its files; the layout of a study is read elsewhere."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(outputs, "lay_out", str.encode)
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
    ("heading", "is_spectral"),
    [
        ("PGA [g],annual rate of exceedance [1/yr]", False),
        ("Peak ground acceleration (g),Mean annual frequency of exceedence", False),
        ("# Site 34, -118; Vs30 = 760 m/s\nPGA_g,lambda", False),
        ("Sa(1.0 s) [g],annual rate", True),
        ("Los Angeles\nSA1P0,rate\ng,1/year", True),
        ("iml,lambda", True),
        ("PGA [g],MAFE", False),
        ("PSA(T=1.0s) [g],AFOE", True),
        ("Site 34.05 S\nim,rate", False),
        ("Spectral acceleration, 1.0 sec, 2018 model\nim,rate", True),
    ],
)
def test_a_heading_of_the_measure_and_the_rate_is_read(heading, is_spectral):
    lines = f"{heading}\n0.1,0.05\n1,0.0001\n".splitlines()
    assert points_of(lines, is_spectral=is_spectral) == [(0.1, 0.05), (1.0, 1e-4)]


def test_columns_without_a_heading_in_the_other_order_are_noticed():
    points = [(0.05, 0.03), (0.2, 0.004), (0.8, 1e-4)]
    assert points_of([f"{x},{rate}" for x, rate in points], is_spectral=False) == points
    with pytest.raises(InputError, match=r"has no heading, and 0\.0001 in the first column, less"):
        points_of([f"{rate},{x}" for x, rate in reversed(points)], is_spectral=False)


@pytest.mark.parametrize(
    ("heading", "found", "is_spectral"),
    by_day([
        ("Sa(1.0 s) [cm/s2],annual rate", ["Sa(1.0 s) [cm/s2]"], True),
        ("PGA [g],probability of exceedance in 50 years", ["probability of exceedance"], False),
        ("PGV [cm/s],return period [years]", ["PGV [cm/s]", "return period [years]"], False),
        ("PGA [%g],annual rate", ["PGA [%g]"], False),
        ("Sa(1 s) [g],annual rate", ["Sa(1 s) [g]"], False),
        ("PGA [g],annual rate", ["PGA [g]"], True),
        ("Sa(0.2 s) [g],annual rate", ["Sa(0.2 s) [g]"], True),
        ("Period [s],Sa [g]", ["Period [s]", "Sa [g]"], True),
        ("PGA,rate\ngal,1/yr", ["gal"], False),
        ("# intensities in cm/s2\nim,rate", ["# intensities in cm/s2"], False),
        ("# PGV\n", ["# PGV"], False),
        ("# Sa(1 s)\n", ["# Sa(1 s)"], False),
        ("SA 0.2 s\nim,rate", ["SA 0.2 s"], False),
        ("Rates x 10^-3\nim,rate", ["Rates x 10^-3"], False),
        ("84th percentile\nim,rate", ["84th percentile"], False),
        ("im = ln(PGA)\nim,rate", ["im = ln(PGA)"], False),
        ("in % g\nim,rate", ["in % g"], True),
        ("Spectral acceleration\nim,rate", ["Spectral acceleration"], False),
        ("# Scale: 1000\nim,rate", ["# Scale: 1000"], False),
        ("Multiplier 0.001\nim,rate", ["Multiplier 0.001"], False),
        ("# MCE_R\nim,rate", ["# MCE_R"], True),
        ("# vertical PGA\nim,rate", ["# vertical PGA"], False),
        ("# 50-year exposure\nim,rate", ["# 50-year exposure"], False),
        ("# 2% damping\nim,rate", ["# 2% damping"], True),
        ("PSA 0.2\nim,rate", ["PSA 0.2"], True),
        ("T = 0.2 sec\nim,rate", ["T = 0.2 sec"], True),
        ("# Sa(0.5 s)\n", ["# Sa(0.5 s)"], True),
        ("# acceleration, cm/s2\n", ["# acceleration, cm/s2"], False),
        ("# PoE, 50 yr\n", ["# PoE, 50 yr"], False),
        ("Probabilities in 50 years\n", ["Probabilities in 50 years"], False),
    ], 3),
)  # fmt: skip
def test_a_heading_of_another_quantity_is_refused(heading, found, is_spectral):
    with pytest.raises(InputError) as caught:
        points_of(f"{heading}\n0.1,0.05\n1,0.0001\n".splitlines(), is_spectral=is_spectral)
    assert len(caught.value.problems) == len(found)
    for problem, text in zip(caught.value.problems, found, strict=True):
        assert problem.startswith(f"has the heading '{text}")
        assert ("Sa(1 s) [g]" if is_spectral else "PGA [g]") in problem or "1/year" in problem


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("Ground Motion (g)", "Ground Motion (cm/s2)", "has the heading 'Ground Motion (cm/s2)'"),
        ("Annual Frequency of", "Probability of", "has the heading 'Probability of Exceedence'"),
    ],
)
def test_labels_of_the_tool_are_read_too(old, new, said):
    with pytest.raises(InputError, match=re.escape(said)):
        points_of(SAVED.replace(old, new).splitlines(), is_spectral=False)


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
    by_day([
        ({"hazard": hazard(site_factor=None, site_basis="")}, ["Factor to the site is missing"]),
        ({"hazard": hazard(site_basis="")}, ["Basis of this factor is missing"]),
        ({"hazard": hazard(site_vs30_mps=760.0)}, ["Factor to the site is entered"]),
        ({"hazard": hazard(source="", edition="")},
         ["Source of the curve is missing", "Hazard model is missing"]),
        ({"hazard": hazard(file="a.csv")}, ["Hazard curve file is named"]),
        ({"hazard_points": ()}, ["Site is entered without a hazard curve"]),
        ({"intensity": Intensity.PPV}, ["has no hazard curve"]),
        ({"study_arrays": ()}, ["but no array is"]),
        ({"hazard_points": curve((0.1, 0.5), (1.0, 0.6))}, ["point 2 of the curve is 1 at 0.6"]),
        ({"hazard_points": curve((0.1, 0.0), (1.0, 0.6))}, ["has 1 point with a rate above 0"]),
        ({"hazard_points": curve((0.1, 50.0), (1.0, 2.0))}, ["point 1 of the curve is 0.1 at 50"]),
        ({"hazard_points": curve((10.0, 0.9), (980.0, 0.1))}, ["point 2 of the curve is 980 at"]),
        ({"hazard_points": curve((1e-320, 0.9), (1.0, 0.1))}, ["point 1 of the curve is 9.99"]),
        ({"hazard_points": curve((0.1, 0.9), (1.0, 1e-320))}, ["point 2 of the curve is 1 at 9"]),
        ({"friction_runs": (StudyFrictionRun(mat="Z", surface=Surface.DRY, number=1, mu=0.5),)},
         ["mat 'Z' is not on the Mats worksheet"]),
        ({"friction_runs": (StudyFrictionRun(mat="A", surface=Surface.DRY, number=1, mu=0.5),)},
         ["1 friction runs on 1 surfaces"]),
    ], 3),
)  # fmt: skip
def test_what_a_hazard_lacks_is_said_at_its_cell(tmp_path, changes, lines):
    write(tmp_path, yearly(**changes))
    said = problems(tmp_path).splitlines()
    assert len(said) == len(lines)
    for line, wanted in zip(said, lines, strict=True):
        assert wanted.casefold() in line.casefold()
        assert "!" in line.partition(":")[0]


def test_what_rates_follow_from_is_in_the_identity_and_needs_no_new_runs(results):
    study_plan = results.plan
    former = manifest_of(study_plan.campaign, study_plan.about)
    runs = yearly().friction_runs
    others = [
        {"hazard": hazard(site_factor=1.3, recenter_m=0.05)},
        {"hazard": hazard(roof_factor=2.6, recenter_m=0.05)},
        {"hazard": hazard(recenter_m=0.06)},
        {"friction_runs": (*runs[:-1], runs[-1].model_copy(update={"mu": 0.43}))},
        {"study_arrays": (results.plan.input.study_arrays[0].model_copy(update={"slope_deg": 1}),)},
    ]
    plans = [replace(study_plan, input=study_plan.input.model_copy(update=one)) for one in others]
    # The content of a file of the curve is in no cell.
    plans.append(replace(study_plan, hazard=(ended(study_plan.hazard[0]),)))
    made = [manifest_of(each.campaign, each.about) for each in plans]
    assert len({former["identity"], *(each["identity"] for each in made)}) == len(plans) + 1
    assert {each["runs_identity"] for each in made} == {former["runs_identity"]}


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
    assert always[1].p95_m == 0.0
    for found in (*never, *above, *always):
        assert math.isinf(found.mean_m) is (found.without_value > 0.0)
    assert always[0].p95_m <= never[0].p95_m
    assert never[0].beyond >= never[1].beyond


@pytest.mark.nightly
def test_the_page_of_the_years_is_laid_out(results):
    assert lay_out(study_html(results)).startswith(b"%PDF-")


def test_the_page_says_what_the_curve_is_and_what_follows(results):
    text = pages.study(results)
    assert text.count(SUPPORTING) >= 1
    for said in ("Here, 34, -118; Survey; Model 2018", "760 m/s, which is rock", "(Table S)"):
        assert said in text
    assert "The hazard curve ends" not in text
    shown = pages.study(
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
