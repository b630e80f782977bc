"""The study workbook: what is written is read, and every error names its cell."""

import shutil
from zipfile import ZipFile

import pytest

from cells import address, cell
from places import ROOT
from projects.study.make import study
from report.sheet.reading.read import read
from report.sheet.schema.choices import UnitsFirst
from report.study.read import read_study, write_study
from report.study.schema import Intensity, Mat, Sampling, StudyBuilding, StudyMotion, values
from sheets import edit, type_into
from solver.model import InputError
from study_books import at, command, given, plan, problems, usual, write

FOLDER = "<Study/Folder of motions>"


@pytest.mark.parametrize(
    ("text", "wanted"),
    [("0, 1, 2.5", (0.0, 1.0, 2.5)), ("0 to 1 by 0.25", (0.0, 0.25, 0.5, 0.75, 1.0)), ("3", (3.0,)),
     ("0.1 to 0.3 by 0.1", (0.1, 0.2, 0.3)), ("1; 2", (1.0, 2.0)), ("0,5", ()), ("2, 1", ()),
     ("1, 1", ()), ("", ()), ("a, b", ()), ("0 to 1 by 0.3", ()), ("0 to 1 by 0", ()),
     ("1 to 0 by 0.1", ()), ("0 to 1 by 0.0001", ()), ("nan", ()), ("0 to inf by 1", ())],
)  # fmt: skip
@pytest.mark.quick
def test_lists_are_read_or_refused(text, wanted):
    found = values(text)
    assert found == wanted or (text == "nan" and len(found) == 1)


@pytest.mark.parametrize("units", list(UnitsFirst))
def test_what_is_written_is_read(tmp_path, units):
    write(tmp_path)
    study = given(allowed_m=0.5, site_intensity=1.2, s_ds_g=1.0)
    write_study(tmp_path / "input.xlsx", units=units, example=study)
    found = read_study(tmp_path).project
    assert found.study.allowed_m == pytest.approx(0.5)
    assert found.study.model_copy(update={"allowed_m": 0.5}) == study.study
    assert (found.mats, found.motions, found.buildings) == (study.mats, (), ())
    assert found.study_arrays[0].clearance_m == pytest.approx(0.3)


def test_the_grid_has_the_friction_of_the_mats(tmp_path):
    found = plan(write(tmp_path, given(mus="0.5, 0.7")))
    assert found.input.mus == (0.4, 0.5, 0.6, 0.7)
    assert found.shape == (1, 3, 4, 4)
    assert len(found.campaign.cases) == 3 * 4 * 4 + 4


def test_a_folder_gives_motions_with_their_components(tmp_path):
    found = plan(write(tmp_path, letters="xyz"))
    assert [motion.id for motion in found.motions.motions[0]] == ["M0", "M1", "M2"]
    assert all(m.has_transverse and m.has_vertical for m in found.motions.motions[0])


def test_intensity_one_has_the_measure_one(tmp_path):
    for kind, s_ds_g, scale in ((Intensity.PPA, None, 1.0), (Intensity.S_DS, 0.8, 1.25)):
        found = plan(write(tmp_path, given(intensity=kind, s_ds_g=s_ds_g)))
        assert found.motions.motions[0][0].scale == pytest.approx(scale, rel=1e-6)


def test_ground_motions_go_through_every_building(tmp_path):
    buildings = (StudyBuilding(id="stiff", period_s=0.05), StudyBuilding(id="soft", period_s=0.8))
    study = given(intensity=Intensity.PGA, recorded_at="ground", buildings=buildings)
    found = plan(write(tmp_path, study))
    assert found.motions.buildings == ("stiff", "soft")
    assert found.shape[0] == 2
    stiff, soft = (m[0] for m in found.motions.motions)
    assert stiff.scale == soft.scale == pytest.approx(1.0, rel=1e-6)
    assert abs(stiff.ax_mps2).max() != pytest.approx(abs(soft.ax_mps2).max(), rel=0.05)


def test_listed_motions_are_read(tmp_path):
    rows = (StudyMotion(id="K1", record="records/M0-x.csv", source="Kobe"),)
    found = plan(write(tmp_path, given(folder="", motions=rows)))
    assert [(m.id, m.source) for m in found.motions.motions[0]] == [("K1", "Kobe")]


def test_all_combinations_take_every_tested_value(tmp_path):
    study = given(site_intensity=1.0, sampling=Sampling.ALL_COMBINATIONS, slope_tolerance_deg=0.5)
    found = plan(write(tmp_path, study))
    cases = found.campaign.cases[found.arrays[0].samples]
    assert sorted(set(cases.mu)) == [0.38, 0.40, 0.42]
    assert len(cases) == 9


@pytest.mark.quick
def test_a_study_workbook_is_told_which_command_reads_it(tmp_path):
    folder = write(tmp_path, given())
    with pytest.raises(InputError, match="run roofslip study"):
        read(folder)


def test_an_ordinary_workbook_is_told_what_to_do(tmp_path):
    shutil.copy(ROOT / "projects" / "example" / "input.xlsx", tmp_path / "input.xlsx")
    assert "roofslip new DIR --study" in problems(tmp_path)


@pytest.mark.parametrize(
    ("changes", "wanted"),
    [
        ({"slopes_deg": "2, 1"}, ("<Study/Slopes>: slopes are '2, 1'", "0 to 7 by 0.5")),
        ({"slopes_deg": "50"}, ("<Study/Slopes>: slopes have 50; give numbers from 0 to 45",)),
        ({"slopes_deg": "nan"}, ("<Study/Slopes>: slopes have nan",)),
        ({"intensities": "0, 1"}, ("<Study/Intensities>: intensities have 0",)),
        ({"intensities": "inf"}, ("<Study/Intensities>: intensities have inf",)),
        ({"mats": (), "study_arrays": ()},
         ("<Study/Friction coefficients>: friction coefficients are missing",)),
        ({"mus": "-0.1, 0.4"}, ("<Study/Friction coefficients>: friction coefficients have -0.1",)),
        ({"intensity": Intensity.S_DS},
         ("<Study/S_DS of the motions>: S_DS of the motions is missing",)),
        ({"intensity": Intensity.PGA},
         ("<Study/Intensity measure>: is PGA, but the motions are roof motions",)),
        ({"folder": ""}, (f"{FOLDER}: no folder",)),
        ({"folder": "elsewhere"}, (f"{FOLDER}: 'elsewhere' is no folder",)),
        ({"folder": "../"}, (f"{FOLDER}: '..' is no folder",)),
        ({"recorded_at": "ground"}, ("Buildings!", "at least one building")),
        ({"buildings": (StudyBuilding(id="b", period_s=0.5),)},
         ("<Buildings/1/ID>", "roof motions")),
        ({"mats": (Mat(id="A", mu=0.4), Mat(id="a", mu=0.5))},
         ("<Mats/2/ID>: ID is 'a', already used at <Mats/1/ID>",)),
        ({"mats": (Mat(id="A"),)},
         ("<Mats/1/Friction coefficient>: friction coefficient and tested values",)),
        ({"mats": (Mat(id="A", tested="0.4, 0.5"),)},
         ("<Mats/1/Tested values>: tested values are '0.4, 0.5'",)),
        ({"mats": (Mat(id="B", mu=0.4),)}, ("<Arrays/1/Mat>: mat 'a' is not on the sheet Mats",)),
        ({"site_intensity": 1.0, "study_arrays": ()},
         ("<Study/Intensity at the site>: is given, but no array is",)),
        ({"site_intensity": 1.0, "intensity_beta": 0.2, "sampling": Sampling.ALL_COMBINATIONS},
         ("<Study/Dispersion of intensity>: all combinations take the median",)),
        ({"record_beta": 0.4},
         ("<Study/Record-to-record source>: the record-to-record dispersion needs its source",)),
        ({"record_source": "A paper"},
         ("<Study/Record-to-record dispersion>: a source is given without the dispersion",)),
        ({"slopes_deg": "0 to 45 by 0.1", "intensities": "1 to 100 by 0.25",
          "mus": "0.1 to 2 by 0.01"}, ("<Study/Intensities>: make", "cases")),
    ],
    ids=lambda value: str(value)[:40] if isinstance(value, dict) else "",
)  # fmt: skip
def test_errors_name_the_cell_and_what_to_do(tmp_path, changes, wanted):
    found = problems(write(tmp_path, given(**changes)))
    assert all(at(text) in found for text in wanted), found


def test_cells_of_a_wrong_kind_are_all_listed(tmp_path):
    folder = write(tmp_path)
    wrong = {"Study/Title": None, "Study/Tolerance of slope": "many",
             "Mats/A/Friction coefficient": -1}  # fmt: skip
    type_into(folder / "input.xlsx", wrong)
    lines = problems(folder).splitlines()
    assert [line.split(":")[0] for line in lines] == [address(usual(), name) for name in wrong]


@pytest.mark.parametrize(
    ("letters", "change", "wanted"),
    [("x", lambda folder: (folder / "M1-x.csv").write_text("no record"), "M1-x.csv"),
     ("xz", lambda folder: (folder / "M2-z.csv").unlink(),
      "motion M2 has 1 components, the first has 2"),
     ("xz", lambda folder: (folder / "M1-x.csv").unlink(), "'records' has no record M1-x"),
     ("x", lambda folder: [path.unlink() for path in folder.iterdir()], "'records' has no record")],
    ids=["damaged", "other components", "without its first component", "empty"],
)  # fmt: skip
def test_a_folder_of_motions_is_refused_at_its_cell(tmp_path, letters, change, wanted):
    folder = write(tmp_path, letters=letters)
    (folder / "records" / "suite.json").write_text("{}")
    change(folder / "records")
    (line,) = problems(folder).splitlines()
    assert line.startswith(at(FOLDER))
    assert wanted in line


def test_too_many_samples_and_runs_are_refused_at_their_cell(tmp_path, monkeypatch):
    folder = write(tmp_path)
    monkeypatch.setattr("report.study.shaking.MOST_SAMPLES", 1000)
    assert at(f"{FOLDER}: the records have 1,200 samples") in problems(folder)
    monkeypatch.undo()
    monkeypatch.setattr("report.study.plan.MOST_RUNS", 10)
    assert at("<Study/Intensities>: make") in problems(folder)


# The project of the repository.

PROJECT = ROOT / "projects" / "study"


def test_the_project_is_what_its_script_writes(tmp_path):
    again = tmp_path / "input.xlsx"
    write_study(again, units=UnitsFirst.US, example=study())
    with ZipFile(again) as made, ZipFile(PROJECT / "input.xlsx") as committed:
        names = set(made.namelist())
        assert names == set(committed.namelist())
        for part in names - {"docProps/core.xml"}:
            assert made.read(part) == committed.read(part), part


def test_the_project_has_the_size_of_a_catalog():
    found = plan(PROJECT)
    assert found.shape == (1, 8, 3, 20)
    assert [motion.id for motion in found.motions.motions[0]] == [f"RM{n}" for n in range(1, 8)]
    assert len(found.campaign.columns) == 28


def test_what_a_study_reads_from_hidden_cells_is_a_warning(tmp_path):
    folder = write(tmp_path)
    assert plan(folder).warnings == ()
    edit(folder / "input.xlsx", lambda book: setattr(book["Mats"], "sheet_state", "hidden"))
    ((cell, text),) = plan(folder).warnings
    assert cell.startswith("Mats!")
    assert text.startswith("the sheet is hidden, and cells ")
    assert text.endswith(" on it are read: show it, or clear what is not meant")
    shown = command(folder, "--dry-run")
    assert f"warning: {cell}: {text}" in shown.stderr


@pytest.mark.quick
def test_a_mat_shown_in_percent_as_text_is_an_error(tmp_path):
    folder = write(tmp_path)
    name = "Mats/A/Friction coefficient"
    formatted(folder, name, '0.0"%"')
    assert problems(folder).startswith(
        at(f'<{name}>: friction coefficient is 0.4, shown in % by its number format (0.0"%");')
    )


def test_an_intensity_may_be_shown_in_the_unit_of_its_measure(tmp_path):
    folder = write(tmp_path, given(site_intensity=1.2))
    name = "Study/Intensity at the site"
    plan(formatted(folder, name, '0.0" g"'))
    formatted(folder, name, '0.0" m/s"')
    assert "is 1.2, shown in m/s by its number format" in problems(folder)


def formatted(folder, name, code):
    """Give a cell a number format; return the folder."""
    edit(folder / "input.xlsx", lambda book: setattr(cell(book, name), "number_format", code))
    return folder
