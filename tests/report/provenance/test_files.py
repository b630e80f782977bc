import hashlib
import json
import re
import shutil
from dataclasses import replace
from importlib import metadata
from pathlib import Path

import pytest

from fixtures import assessments, projects
from fixtures.marks import by_day
from fixtures.paths import ROOT
from fixtures.workbooks import type_into
from report import making
from report.motions import record_reading
from report.motions.prepare import prepare
from report.project.read.documents import Document
from report.project.read.read import read
from report.provenance.package_sources import (
    MOST_RECORDS,
    attachments,
    environment,
    fingerprint,
    holds_records,
    record_bytes,
    sources,
    versions,
)
from report.provenance.release import version
from report.results.results_json import results_json
from report.web.open_project import open_project
from solver.errors import InputError

EXAMPLE = ROOT / "projects" / "example"


@pytest.fixture(scope="module")
def job():
    sheet = read(EXAMPLE)
    return sheet, prepare(sheet)


def attached(found):
    """The contents of the attachments by name, and the manifest among them."""
    contents = {file.name: file.content for file in attachments(found, b"{}", "abc")}
    return contents, json.loads(contents["roofslip.json"])


def test_workbook_records_and_a_document_are_attached_once_as_they_lie(job, tmp_path):
    found = sources(*job)
    assert [source.path for source in found[:2]] == ["input.xlsx", "records/RM1-x.csv"]
    assert len(found) == 25
    contents, listed = attached(found)
    assert contents.keys() == {*(source.path for source in found), "results.json", "roofslip.json"}
    assert listed["roofslip_version"] == version()
    assert (listed["hash"], listed["has_records"]) == ("abc", True)
    for source, entry in zip(found, listed["files"][:-1], strict=True):
        content = (EXAMPLE / entry["path"]).read_bytes()
        assert content == source.content == contents[entry["name"]]
        assert entry["sha256"] == hashlib.sha256(content).hexdigest()
        assert entry["bytes"] == len(content)
    sheet, shaking = job
    given = with_documents(sheet, tmp_path, "letter.pdf", "letter.pdf")
    assert fingerprint(given, shaking) != fingerprint(sheet, shaking)
    contents, listed = attached(sources(given, replace(shaking, records=())))
    assert contents["letter.pdf"] == LETTER
    kinds = {entry["path"]: entry["kind"] for entry in listed["files"]}
    assert kinds == {"input.xlsx": "workbook", "letter.pdf": "document", "results.json": "results"}
    found = attachments(sources(given, shaking), b"{}", "abc")
    (letter,) = (file for file in found if file.name == "letter.pdf")
    assert (letter.mime, letter.relationship) == ("application/pdf", "Supplement")


def test_what_changed_meanwhile_is_an_input_error_and_changes_the_hash(job, tmp_path, monkeypatch):
    sheet, shaking = job
    changed = replace(shaking.records[0], sha256="0" * 64)
    with pytest.raises(InputError, match=r"RM1-x\.csv: changed while the report was running"):
        sources(sheet, replace(shaking, records=(changed, *shaking.records)))
    given = with_documents(sheet, tmp_path, "letter.pdf", "letter.pdf")
    other = replace(given.documents[0], sha256=sheet.sha256)
    given = replace(given, documents=(other, given.documents[1]))
    with pytest.raises(InputError, match=r"letter\.pdf: changed while the report was running"):
        sources(given, replace(shaking, records=()))
    sheet, shaking = job
    first, second, *others = shaking.records
    other = replace(first, sha256="0" * 64)
    swapped = replace(first, sha256=second.sha256), replace(second, sha256=first.sha256)
    given = [
        (sheet, shaking),
        (replace(sheet, sha256="0" * 64), shaking),
        (sheet, replace(shaking, records=(other, second, *others))),
        (sheet, replace(shaking, records=(*swapped, *others))),
    ]
    hashes = [fingerprint(*pair) for pair in given]
    monkeypatch.setattr("report.provenance.package_sources.version", lambda: "9.9")
    hashes.append(fingerprint(sheet, shaking))
    assert len(set(hashes)) == 5
    assert all(len(short) == 12 for short in hashes)


def replacing(monkeypatch, name):
    """Put another file in the place of one as soon as it is opened, each time."""

    def opened(path, *mode, **options):
        file = open(path, *mode, **options)  # noqa: SIM115 - who opens it closes it
        if Path(path).name == name:
            Path(path).unlink()
            Path(path).write_bytes(OTHER)
        return file

    monkeypatch.setattr("solver.file_checks.open", opened, raising=False)


OTHER = b"another file"


@pytest.mark.parametrize("name", by_day(["input.xlsx", "records/RM1-x.csv", "letter.pdf"], 1))
def test_what_was_read_is_attached_whatever_lies_there_by_then(tmp_path, monkeypatch, name):
    project = tmp_path / "project"
    shutil.copytree(EXAMPLE, project, ignore=shutil.ignore_patterns("out", "*.py", "__pycache__"))
    (project / "letter.pdf").write_bytes(LETTER)
    type_into(project / "input.xlsx", {"Options/Letter of review": "letter.pdf"})
    was = {path: path.read_bytes() for path in project.rglob("*") if path.is_file()}
    replacing(monkeypatch, Path(name).name)
    sheet = read(project)
    contents, listed = attached(sources(sheet, prepare(sheet)))
    assert (project / name).read_bytes() == OTHER
    entries = {entry["path"]: entry for entry in listed["files"] if entry["kind"] != "results"}
    assert {project / path for path in entries} == was.keys()
    for path, entry in entries.items():
        assert contents[path] == was[project / path]
        assert entry["sha256"] == hashlib.sha256(was[project / path]).hexdigest()


LETTER = b"%PDF-1.7\nletter"


def with_documents(sheet, folder, *paths):
    """Return a sheet that names documents of one content in a folder beside it."""
    for path in paths:
        (folder / path).write_bytes(LETTER)
    shutil.copy(EXAMPLE / "input.xlsx", folder)
    sha256 = hashlib.sha256(LETTER).hexdigest()
    documents = [
        Document(label=f"Document {count}", path=path, size=len(LETTER), sha256=sha256)
        for count, path in enumerate(paths)
    ]
    sheet.book.files[sha256] = LETTER
    return replace(sheet, path=folder / "input.xlsx", documents=tuple(documents))


@pytest.mark.nightly
def test_former_results_are_attached_as_they_were_compared(tmp_path, monkeypatch):
    assessment = assessments.package(assessments.motions(3, 4.0)).assessment
    (tmp_path / "results.json").write_bytes(
        was := results_json(assessment, assessments.evidence(assessment))
    )
    kept = {}

    def keep_files(_html, files, tell):
        kept.update({file.name: file.content for file in files})
        tell(1)
        return b"%PDF"

    def replace_former(step):
        if step.doing == "running the motions":
            (tmp_path / "results.json").write_bytes(OTHER)

    monkeypatch.setattr(making, "lay_out", keep_files)
    making.make(EXAMPLE, tmp_path / "out", tmp_path / "results.json", replace_former)
    assert (tmp_path / "results.json").read_bytes() == OTHER
    assert kept["since/results.json"] == was


def test_records_are_kept_up_to_the_limit_and_hashed_beyond_it(job, monkeypatch):
    monkeypatch.setattr(record_reading, "MOST_RECORDS", 300_000)
    sheet = read(EXAMPLE)
    records = prepare(sheet).records
    assert 0 < sum(map(len, sheet.book.records.values())) <= 300_000 < record_bytes(records)
    assert records == job[1].records
    sheet, shaking = job
    monkeypatch.setattr("report.provenance.package_sources.MOST_RECORDS", 1_000_000)
    assert not holds_records(shaking.records)
    contents, listed = attached(sources(sheet, shaking))
    named = {document.path for document in sheet.documents}
    assert contents.keys() == {"input.xlsx", "results.json", "roofslip.json", *named}
    assert listed["has_records"] is False
    assert sum(entry["kind"] == "record" for entry in listed["files"]) == 21
    book = open_project(EXAMPLE / "input.xlsx").sheet.book
    assert not book.files
    assert not book.records


@pytest.mark.quick
def test_a_file_with_several_channels_counts_once():
    row = projects.book().shaking.records[0]
    rows = [
        replace(row, name="records/a.v2 | Up", size=MOST_RECORDS),
        replace(row, name=".\\records\\a.v2|North", size=MOST_RECORDS),
        replace(row, name="Data!a", size=0, format="pasted column"),
    ]
    assert record_bytes(rows) == MOST_RECORDS
    assert holds_records(rows)
    assert not holds_records([*rows, replace(row, name="b.csv", size=1)])


RENAMED = {
    "Results.json": "renamed/1/Results.json", "a.csv": "a.csv", "A.csv": "renamed/3/A.csv",
    "sub/a.csv": "sub/a.csv",
}  # fmt: skip


def test_names_that_collide_are_renamed_and_a_former_revision_has_its_own(job):
    sheet, shaking = job
    named = zip(shaking.records, RENAMED, strict=False)
    rows = tuple(replace(row, name=name) for row, name in named)
    _, listed = attached(sources(sheet, replace(shaking, records=rows)))
    records = [entry for entry in listed["files"] if entry["kind"] == "record"]
    assert {entry["path"]: entry["name"] for entry in records} == RENAMED
    found = sources(sheet, shaking, b"{}")
    assert (found[-1].path, found[-1].content) == ("since/results.json", b"{}")


@pytest.mark.quick
def test_parts_that_matter_and_the_system_are_named_and_what_is_not_installed_is_not(monkeypatch):
    known = versions()
    named = "numpy numba llvmlite pandas openpyxl matplotlib weasyprint pydyf fonttools"
    assert known.keys() - {"lxml"} == {"roofslip", "python", *named.split()}
    for name in named.split():
        assert known[name] == metadata.version(name)
    assert environment().keys() - versions().keys() == {"system"}
    assert re.fullmatch(r"[\w.+ -]+", environment()["system"])
    true = metadata.version

    def version(name):
        if name == "lxml":
            raise metadata.PackageNotFoundError(name)
        return true(name)

    monkeypatch.setattr(metadata, "version", version)
    assert "lxml" not in versions.__wrapped__()
