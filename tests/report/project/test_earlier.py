"""Workbooks of earlier versions are read, and give the results of then."""

import json
import shutil
from itertools import takewhile

import pytest
from click.testing import CliRunner
from openpyxl import load_workbook

from fixtures.cells import address, cell
from fixtures.marks import by_day
from fixtures.packages import undrawn, unlaid
from fixtures.paths import DATA, ROOT
from fixtures.workbooks import edit, make, project, read_workbook, same, type_into
from report.cli.main import main
from report.project.check.covered import CONFIRMATIONS, outdated
from report.project.model import ProjectInput
from report.project.model.choices import Direction
from report.project.model.overrides import provision_key
from report.project.read.read import read
from report.project.workbook import SECTION, SECTIONS
from report.project.write.overwritten import overwritten
from report.study.read_study import read_study
from report.study.study_input import StudyInput
from solver.rules.provisions import Neighbor
from solver.rules.rulesets import ALLOWED

EARLIER = DATA / "0.3.0"
RECORDED = json.loads((EARLIER / "recorded.json").read_text())


def beside(folder, name, project):
    """Put a workbook where a project has its own, beside the project's records."""
    ignored = shutil.ignore_patterns("out", "*.py", "*.xlsx")
    shutil.copytree(ROOT / "projects" / project, folder, ignore=ignored)
    return shutil.copy(EARLIER / f"{name}.xlsx", folder / "input.xlsx")


@pytest.mark.parametrize("name", by_day(["campus", "conditions", "example", "school"], 1))
def test_a_project_is_read_as_it_was(tmp_path, name):
    sheet = read(beside(tmp_path / name, name, name))
    assert same(sheet.project, ProjectInput.model_validate(RECORDED[name]["input"]))


def test_a_workbook_that_was_confirmed_stays_so_but_for_its_records(tmp_path):
    book = read_workbook(beside(tmp_path / "campus", "campus", "campus"))
    data, hashes = book.input, book.hashes
    on_record = {key for key, _, field, _ in CONFIRMATIONS if getattr(getattr(data, key), field)}
    assert on_record == {"site", "friction_tests", "options"}
    # The records beside it were made again since; nothing else is another than was confirmed.
    assert outdated(data, hashes).outdated == {"options": "worksheet Motions"}
    later = data.model_copy(update={"target": data.target.model_copy(update={"t_l_s": 16.0})})
    assert outdated(later, hashes).outdated == {"options": "worksheets Site, Motions"}


@pytest.mark.quick
def test_a_study_is_read_as_it_was():
    sheet = read_study(EARLIER / "study.xlsx")
    assert same(sheet.project, StudyInput.model_validate(RECORDED["study"]["input"]))


def test_what_is_wrong_in_a_half_filled_one_is_named_as_it_was(tmp_path, monkeypatch):
    # However slow the machine is, it prints no progress.
    monkeypatch.setattr("report.cli.progress.time.monotonic", lambda: 0.0)
    beside(tmp_path / "job", "undone", "conditions")
    done = CliRunner().invoke(main, ["check", str(tmp_path / "job")])
    assert done.exit_code == 2
    assert done.output.replace(str(tmp_path), "").splitlines() == RECORDED["undone"]["check"]


WORDS = {
    "direction": Direction,
    "neighbor": Neighbor,
    "prescriptive_governs": {"formula": "equation"}.get,
}
"""What has another word in results than it had then."""


@pytest.mark.nightly
@pytest.mark.parametrize("name", ["conditions"])
def test_the_results_are_those_of_then(tmp_path, name):
    beside(tmp_path / name, name, name)
    with unlaid(), undrawn():
        done = CliRunner().invoke(main, ["report", "--quiet", str(tmp_path / name)])
    assert done.exit_code == 0, done.output
    results = json.loads((tmp_path / name / "out" / "results.json").read_text())
    for section in ("arrays", "clearances"):
        for row, wanted in zip(results[section], RECORDED[name][section], strict=True):
            for key, value in wanted.items():
                if isinstance(value, float):
                    value = pytest.approx(value, rel=1e-9, abs=1e-14)
                elif key in WORDS:
                    value = WORDS[key](value)
                assert row[key] == value, (row, key)


PRESENT = [(section, entry) for section in SECTIONS for entry in section.entries]


def earlier_labels(book):
    """Replace each renamed label and heading by its oldest name, and remove all defined names."""
    oldest = {
        (section.sheet, entry.heading): entry.former for section, entry in PRESENT if entry.former
    }
    book.defined_names.clear()
    changed = set()
    for found in (found for sheet in book.worksheets for row in sheet.iter_rows() for found in row):
        label, bracket, unit = str(found.value).removesuffix(" *").partition(" [")
        place = found.parent.title, label
        if place in oldest:
            found.value = oldest[place] + bracket + unit
            changed.add(place)
    assert changed == oldest.keys()


def test_every_earlier_label_is_read_as_the_present_one(tmp_path):
    assert same(read(edit(make(tmp_path), earlier_labels)).project, project())


@pytest.mark.quick
def test_every_earlier_name_of_a_provision_is_that_of_the_present_one():
    sheet = load_workbook(EARLIER / "example.xlsx", read_only=True)["Provisions"]
    names = takewhile(bool, (row[0] for row in sheet.iter_rows(min_row=6, values_only=True)))
    assert [provision_key(name) for name in names] == list(ALLOWED)


@pytest.mark.parametrize("renamed", [False, True])
def test_displacement_by_direction_of_an_earlier_workbook_is_refused_with_its_cell(
    tmp_path, renamed
):
    label = "Options/Displacement by direction"
    told = {"Options/Reason for direction": "Agreed", label: "Yes"}
    path = type_into(beside(tmp_path / "example", "example", "example"), told)
    where = address(path, label)

    def rename(book):
        cell(book, label).offset(column=-1).value = "By direction"

    if renamed:  # the cell has its name still
        edit(path, rename)
    ((_, problem),) = read(path).problems
    assert str(problem).startswith(f"{where}: displacement by direction is 'Yes'; select No: ")


def test_a_model_that_an_earlier_workbook_requests_is_refused_with_its_cell(tmp_path):
    told = {"Arrays/A1/Model": "choose", "Arrays/A2/Model": "one axis", "Arrays/A3/Model": None}
    path = type_into(beside(tmp_path / "example", "example", "example"), told)
    ((_, problem),) = read(path).problems
    assert str(problem).startswith(
        f"{address(path, 'Arrays/A2/Model')}: model is 'one axis'; select 'choose': "
    )


@pytest.mark.quick
@pytest.mark.parametrize("answer", ["No", "no ", False, None])
def test_an_earlier_workbook_that_asks_for_nothing_that_is_gone_is_read_as_it_was(tmp_path, answer):
    told = {
        "Options/Displacement by direction": answer,
        "Arrays/A1/Model": "Choose" if answer else None,
    }
    path = type_into(beside(tmp_path / "example", "example", "example"), told)
    wanted = ProjectInput.model_validate(RECORDED["example"]["input"])
    assert same(read(path).project, wanted)


def without(section, *fields):
    """Remove labels and names of single cells: workbooks from before them lack them."""
    section = SECTION[section]

    def change(book):
        for field in fields:
            del book.defined_names[section.cell_name(field)]
            label = section.entry(field).heading
            cell(book, f"{section.sheet}/{label}").offset(column=-1).value = None

    return change


def test_a_workbook_from_before_a_cell_is_read_as_it_is(tmp_path):
    book = read(edit(make(tmp_path), without("options", "study_years")))
    assert book.problems == ()
    assert list(overwritten(book.book)) == []
    assert same(book.project, project())


def test_lost_cells_are_refused(tmp_path):
    (problem,) = read(edit(make(tmp_path), without("site", "hazard_date"))).problems
    assert "date of seismic parameters is missing" in problem[1].found
