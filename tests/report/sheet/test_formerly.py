"""Workbooks of earlier versions go on being read."""

from places import DATA, ROOT
from report.sheet import formerly
from report.sheet.fields import entries
from report.sheet.read import read
from report.sheet.schema import PROVISION_KEYS, SECTIONS
from sheets import edit, make, same


def test_the_workbook_of_0_1_reads_as_the_present_one():
    then, now = read(DATA / "input-0.1.xlsx"), read(ROOT / "projects" / "example")
    assert then.problems == ()
    assert same(then.project, now.project)


def test_a_former_key_of_a_provision_overrides_the_present_one(tmp_path):
    def change(book):
        book["Options"]["B26"] = "max_storeys"

    (override,) = read(edit(make(tmp_path), change)).project.overrides
    assert override.provision == "max_stories"


def test_a_former_choice_is_the_present_one(tmp_path, monkeypatch):
    monkeypatch.setitem(formerly.CHOICES, "old name", "fixed object")

    def change(book):
        for row in book["Objects"].iter_rows():
            for cell in row:
                if cell.value == "fixed object":
                    cell.value = "Old name"

    assert read(edit(make(tmp_path), change)).project.objects[0].kind == "fixed object"


def test_every_former_name_leads_to_a_present_one():
    known = {(section.key, entry.name) for section in SECTIONS for entry in entries(section.model)}
    assert formerly.LABELS.keys() | formerly.FIELDS.keys() <= known
    assert set(formerly.PROVISIONS.values()) <= PROVISION_KEYS.keys()
