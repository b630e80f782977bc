"""Workbooks of earlier versions can still be read."""

import json
import shutil

import pytest
from click.testing import CliRunner

from cells import cell
from places import DATA, ROOT
from report.cli.main import main
from report.sheet.reading.archive import open_book
from report.sheet.reading.read import read
from report.sheet.schema import SECTION, SECTIONS, ProjectInput, layout
from report.sheet.schema.fields import entries
from report.sheet.writing.filled import overwritten, what_is_new
from sheets import edit, make, project, same, type_into
from solver.rules.provisions import OVERRIDABLE


@pytest.mark.quick
def test_the_workbook_of_0_1_is_read_as_what_it_was_made_from():
    book = read(DATA / "input-0.1.xlsx")
    made_from = json.loads((DATA / "input-0.1.json").read_text())
    assert book.problems == ()
    assert same(book.project, ProjectInput.model_validate(made_from))


def test_check_has_one_note_of_what_a_workbook_of_0_1_lacks_and_a_new_one_has_none(tmp_path):
    shutil.copy(DATA / "input-0.1.xlsx", tmp_path / "input.xlsx")
    shutil.copytree(ROOT / "projects" / "example" / "records", tmp_path / "records")
    done = CliRunner().invoke(main, ["check", str(tmp_path)])
    assert done.exit_code == 0
    (line,) = (line for line in done.output.splitlines() if "of version 0.1" in line)
    assert line.startswith("note: ")
    assert "lacks 18 columns and the sheets Friction tests, Outlines, Layers, " in line
    assert line.endswith("Run roofslip new FOLDER and copy your cells into the new workbook")
    assert list(what_is_new(open_book(make(tmp_path / "new")))) == []


PRESENT = [(section, entry) for section in SECTIONS for entry in entries(section.model)]


def earlier_labels(book):
    """Replace each renamed label and heading by its oldest name, and remove all defined names."""
    oldest = {
        (section.sheet, entry.cell.label): layout.LABELS[section.key, entry.name][0]
        for section, entry in PRESENT
        if (section.key, entry.name) in layout.LABELS
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


def without(section, *fields):
    """Remove labels and names of single cells: workbooks from before them lack them."""
    section = SECTION[section]

    def change(book):
        for field in fields:
            del book.defined_names[section.cell_name(field)]
            label = section.entry(field).cell.label
            cell(book, f"{section.sheet}/{label}").offset(column=-1).value = None

    return change


@pytest.mark.parametrize(
    "fields",
    [("site", "hazard_report"), ("site", "building_code", "building_code_year", "jurisdiction"),
     ("friction_tests", "report_file"), ("options", "peer_letter"), ("site", "hazard_printout"),
     ("site", "fire_code_section", "fire_lane_m")],
)  # fmt: skip
def test_a_workbook_from_before_some_cells_is_read_as_it_is(tmp_path, fields):
    book = read(edit(make(tmp_path), without(*fields)))
    assert book.problems == ()
    assert list(overwritten(book.book)) == []
    assert same(book.project, project())


def test_lost_cells_are_refused_and_an_earlier_provision_overrides_the_present_one(tmp_path):
    (problem,) = read(edit(make(tmp_path), without("site", "hazard_date"))).problems
    assert "date of hazard is missing" in problem[1].found
    path = type_into(make(tmp_path), {"Options/1/Provision": "max_storeys"})
    (override,) = read(path).project.overrides
    assert override.provision == "max_stories"


@pytest.mark.quick
def test_every_earlier_name_belongs_to_a_present_one():
    known = {(section.key, entry.name) for section, entry in PRESENT}
    assert layout.LABELS.keys() | layout.FIELDS.keys() <= known
    labels = {(section.key, other.cell.label): other.name for section, other in PRESENT}
    for (section, field), earlier in layout.LABELS.items():
        for label in earlier:
            assert labels.get((section, label), field) == field
    assert set(layout.PROVISIONS.values()) <= OVERRIDABLE.keys()
