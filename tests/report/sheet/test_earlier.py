"""Workbooks of 158bb098, whose formulas repeated what `check` refuses, give the results of then."""

import json
import shutil

import pytest
from click.testing import CliRunner

from packages import undrawn, unlaid
from places import DATA, ROOT
from report.cli.main import main
from report.sheet.checking.covered import CONFIRMATIONS, outdated
from report.sheet.reading.archive import open_book
from report.sheet.reading.locate import table_area
from report.sheet.reading.positions import CellPosition
from report.sheet.reading.read import read
from report.sheet.schema import SECTION, ProjectInput
from report.sheet.schema.fields import Place
from report.sheet.writing.filled import filled
from report.study.read import read_study
from report.study.schema import StudyInput
from sheets import edit, read_workbook, same

EARLIER = DATA / "158bb098"
CONFIRMED = DATA / "c9c3a2cf" / "confirmed"  # the example, with every confirmation on record
RECORDED = json.loads((EARLIER / "recorded.json").read_text())
COMPLETE = ("campus", "conditions", "example", "school")


def beside(folder, name, project):
    """Put a workbook where a project has its own, beside the project's records."""
    ignored = shutil.ignore_patterns("out", "*.py", "*.xlsx")
    shutil.copytree(ROOT / "projects" / project, folder, ignore=ignored)
    return shutil.copy(EARLIER / f"{name}.xlsx", folder / "input.xlsx")


@pytest.mark.parametrize("name", COMPLETE)
def test_a_project_is_read_as_it_was(tmp_path, name):
    sheet = read(beside(tmp_path / name, name, name))
    assert same(sheet.project, ProjectInput.model_validate(RECORDED[name]["input"]))


def test_what_stood_on_another_sheet_is_read_by_its_labels_there(tmp_path):
    def forget(book):
        for name in [name for name in book.defined_names if name.startswith(("roof_", "target_"))]:
            del book.defined_names[name]

    path = edit(beside(tmp_path / "example", "example", "example"), forget)
    found, wanted = read(path), ProjectInput.model_validate(RECORDED["example"]["input"])
    assert same(found.project, wanted)
    assert (wanted.target.t_l_s, wanted.roof.placed is None) == (8.0, False)
    moved = (Place("roof", 0, "x_from_m"), Place("target", 0, "t_l_s"))
    assert [found.addresses[place].partition("!")[0] for place in moved] == ["Site", "Options"]


def test_a_workbook_that_was_confirmed_stays_so_but_for_its_records(tmp_path):
    book = read_workbook(beside(tmp_path / "example", CONFIRMED, "example"))
    data, hashes = book.input, book.hashes
    on_record = {key for key, _, field, _ in CONFIRMATIONS if getattr(getattr(data, key), field)}
    assert on_record == {"project", "site", "friction_tests", "options"}
    # The records beside it were made again since; nothing else is another than was confirmed.
    assert outdated(data, hashes).outdated == {"options": "sheet Motions"}
    later = data.model_copy(update={"target": data.target.model_copy(update={"t_l_s": 6.0})})
    assert outdated(later, hashes).outdated == {"options": "sheets Motions, Options"}


@pytest.mark.quick
def test_a_study_is_read_as_it_was():
    sheet = read_study(EARLIER / "study.xlsx")
    assert same(sheet.project, StudyInput.model_validate(RECORDED["study"]["input"]))


@pytest.mark.parametrize(("name", "project"), [("begun", "example"), ("undone", "conditions")])
def test_what_is_wrong_in_a_half_filled_one_is_named_as_it_was(
    tmp_path, monkeypatch, name, project
):
    # However slow the machine is, it prints no progress.
    monkeypatch.setattr("report.cli.terminal.time.monotonic", lambda: 0.0)
    beside(tmp_path / "job", name, project)
    done = CliRunner().invoke(main, ["check", str(tmp_path / "job")])
    assert done.exit_code == 2
    assert done.output.replace(str(tmp_path), "").splitlines() == RECORDED[name]["check"]


@pytest.mark.nightly
def test_a_row_that_a_table_grows_by_has_all_the_formulas_of_its_version():
    book = open_book(EARLIER / "example.xlsx")
    area = table_area(book, SECTION["objects"])
    below = CellPosition("Objects", area.last + 1, area.headings["id"].column)
    grown = filled(book, {below: "RTU-99"})
    assert table_area(grown, SECTION["objects"]).last == area.last + 1
    assert grown.formula("Objects", f"A{area.last + 1}") == "=status_objects"


@pytest.mark.nightly
@pytest.mark.parametrize("name", ["example", "conditions"])
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
                assert row[key] == value, (row, key)
