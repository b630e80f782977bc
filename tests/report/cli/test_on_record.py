"""`report` puts on record what a confirmation covers, and says what has changed since."""

import datetime as dt
import os
from pathlib import Path

import pytest

import scenes
from cells import address
from commands import printed
from inputs import SITE
from nightly import by_day
from places import ROOT
from report.making import make as make_package
from report.motions.prepare import prepare
from report.proof.package import opened
from report.sheet.checking.covered import outdated, to_record
from report.sheet.reading.archive import open_book
from report.sheet.reading.read import read
from sheets import at, edit, make, type_into

SHIPPED = sorted(path.parent.name for path in (ROOT / "projects").glob("*/input.xlsx"))
PLACES = "<Site/Hazard covered>, <Options/Review covered>"


def confirmed(folder: Path, **changes) -> Path:
    """A project with a hazard and a peer review that have dates."""
    options = scenes.REVIEW | {"peer_letter": ""}
    site = SITE | {"hazard_source": "Hazard Tool", "hazard_date": dt.date(2026, 2, 20)}
    return make(folder, **{"site": site, "options": options} | changes)


@pytest.mark.parametrize("name", [name for name in SHIPPED if name != "study"])
@pytest.mark.quick
def test_a_shipped_project_has_on_record_what_its_confirmations_cover(name):
    sheet = read(ROOT / "projects" / name)
    hashes = prepare(sheet).hashes
    assert to_record(sheet.project, hashes) == {}
    assert outdated(sheet.project, hashes).outdated == {}


@pytest.mark.parametrize("units", by_day(["US", "SI"], 1))
def test_the_example_has_on_record_what_its_confirmations_cover(tmp_path, units):
    printed("new", tmp_path, "--example", "--units", units)
    sheet = read(tmp_path)
    assert sheet.project.site.hazard_covered
    hashes = prepare(sheet).hashes
    assert to_record(sheet.project, hashes) == {}
    assert outdated(sheet.project, hashes).outdated == {}


@pytest.mark.nightly
def test_report_puts_a_confirmation_on_record_once_and_attaches_the_workbook_with_it(tmp_path):
    path = confirmed(tmp_path)
    says = open_book(path).calculation
    output = printed("report", path)
    assert f"{path}: {at(PLACES)}: what was confirmed is on record" in output.splitlines()
    sheet = read(path)
    assert sheet.project.site.hazard_covered.startswith("2026-02-20: Site ")
    assert sheet.project.options.peer_covered.startswith("2026-03-01: Site ")
    assert open_book(path).calculation == says
    files = {file.name for file in tmp_path.iterdir() if not file.name.startswith(".")}
    assert files == {"input.xlsx", "records", "out"}  # no copy: the former one may still be needed
    package = opened((tmp_path / "out" / "calc-package.pdf").read_bytes())
    (workbook,) = package.manifest.of_kind("workbook")
    assert workbook.sha256 == sheet.sha256
    printed("verify-package", tmp_path / "out" / "calc-package.pdf")

    # What changes is named, and the record stays until there is a new date.
    type_into(path, {"Arrays/A1/Friction coefficient": 0.4})
    before = path.read_bytes()
    (tmp_path / "records" / "z.csv").write_text("0.1\n" * 200)
    output = printed("report", path)
    (line,) = (line for line in output.splitlines() if "given before" in line)
    said = "peer review: 2026-03-01, given before these inputs changed: sheets Arrays, Motions;"
    assert line.startswith(f"condition: {said}")
    assert path.read_bytes() == before
    assert "on record" not in output


@pytest.mark.nightly
def test_a_report_of_several_puts_a_confirmation_on_record(tmp_path):
    path = confirmed(tmp_path)
    output = printed("report", path, path)
    assert f"{path}: {at(PLACES)}: what was confirmed is on record" in output.splitlines()
    assert read(path).project.options.peer_covered.startswith("2026-03-01: ")


@pytest.mark.nightly
def test_a_workbook_that_is_read_only_stays_as_it_is(tmp_path, monkeypatch):
    path = confirmed(tmp_path)
    before, usual = path.read_bytes(), os.access
    monkeypatch.setattr(os, "access", lambda at, mode: Path(at) != path and usual(at, mode))
    lines = []
    make_package(path, None, None, lambda _: None, on_record=lines.append)
    assert path.read_bytes() == before
    (line,) = lines
    assert line.endswith("not put on record: the workbook is read-only, or was saved meanwhile")


@pytest.mark.nightly
def test_a_workbook_that_is_open_or_of_an_earlier_version_stays_as_it_is(tmp_path):
    path = confirmed(tmp_path)
    beside = path.with_name("~$input.xlsx")
    beside.touch()
    before = path.read_bytes()
    output = printed("report", path)
    assert path.read_bytes() == before
    (line,) = (line for line in output.splitlines() if "on record" in line)
    assert line.startswith(f"{path}: {at(PLACES)}: what was confirmed is not put on record: ")
    assert "a program has the workbook open" in line
    printed("verify-package", tmp_path / "out" / "calc-package.pdf")
    beside.unlink()

    for label in ("Site/Hazard covered", "Options/Review covered"):
        sheet, cell = address(before, label).split("!")
        type_into(path, {f"{sheet}!A{cell[1:]}": None})
    earlier = _without_names(path)
    output = printed("report", path)
    assert "on record" not in output
    assert path.read_bytes() == earlier


def _without_names(path: Path) -> bytes:
    """Remove the defined names of the cells, which an earlier workbook lacks."""

    def change(book):
        for name in ("site_hazard_covered", "options_peer_covered"):
            del book.defined_names[name]

    return edit(path, change).read_bytes()
