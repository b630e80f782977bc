import hashlib
import json
import shutil
from dataclasses import replace
from importlib.metadata import version

import pytest

import stand_in
from places import ROOT
from report.motions.prepare import prepare
from report.provenance import files
from report.provenance.files import (
    MOST_RECORDS,
    attachments,
    fingerprint,
    holds_records,
    record_bytes,
    sources,
)
from report.sheet.reading.beside import Document
from report.sheet.reading.read import read
from solver.model import InputError

EXAMPLE = ROOT / "projects" / "example"


@pytest.fixture(scope="module")
def job():
    sheet = read(EXAMPLE)
    return sheet, prepare(sheet)


def attached(found):
    """The contents of the attachments by name, and the manifest among them."""
    contents = {file.name: file.content for file in attachments(found, b"{}", "abc")}
    return contents, json.loads(contents["roofslip.json"])


def test_workbook_and_records_are_attached_as_they_lie(job):
    found = sources(*job)
    assert [source.path for source in found[:2]] == ["input.xlsx", "records/RM1-x.csv"]
    assert len(found) == 22
    contents, listed = attached(found)
    assert contents.keys() == {*(source.path for source in found), "results.json", "roofslip.json"}
    assert listed["roofslip_version"] == version("roofslip")
    assert (listed["hash"], listed["has_records"]) == ("abc", True)
    for source, entry in zip(found, listed["files"][:-1], strict=True):
        content = (EXAMPLE / entry["path"]).read_bytes()
        assert content == source.content == contents[entry["name"]]
        assert entry["sha256"] == hashlib.sha256(content).hexdigest()
        assert entry["bytes"] == len(content)


def test_the_hash_follows_workbook_records_their_order_and_the_version(job, monkeypatch):
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
    monkeypatch.setattr(files, "version", lambda name: "9.9")
    hashes.append(fingerprint(sheet, shaking))
    assert len(set(hashes)) == 5
    assert all(len(short) == 12 for short in hashes)


def test_a_file_that_changed_during_the_run_is_an_input_error(job):
    sheet, shaking = job
    changed = replace(shaking.records[0], sha256="0" * 64)
    with pytest.raises(InputError, match="changed while the report ran"):
        sources(sheet, replace(shaking, records=(changed,)))


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
    return replace(sheet, path=folder / "input.xlsx", documents=tuple(documents))


def test_a_document_is_attached_once_and_is_part_of_the_hash(job, tmp_path):
    sheet, shaking = job
    given = with_documents(sheet, tmp_path, "letter.pdf", "letter.pdf")
    assert fingerprint(given, shaking) != fingerprint(sheet, shaking)
    contents, listed = attached(sources(given, replace(shaking, records=())))
    assert contents["letter.pdf"] == LETTER
    kinds = {entry["path"]: entry["kind"] for entry in listed["files"]}
    assert kinds == {"input.xlsx": "workbook", "letter.pdf": "document", "results.json": "results"}
    (letter,) = (
        f for f in attachments(sources(given, shaking), b"{}", "abc") if f.name == "letter.pdf"
    )
    assert (letter.mime, letter.relationship) == ("application/pdf", "Supplement")


def test_a_document_that_changed_during_the_run_is_an_input_error(job, tmp_path):
    sheet, shaking = job
    given = with_documents(sheet, tmp_path, "letter.pdf")
    (tmp_path / "letter.pdf").write_bytes(b"%PDF-1.7\nanother")
    with pytest.raises(InputError, match=r"letter\.pdf: changed while the report ran"):
        sources(given, replace(shaking, records=()))


def test_records_beyond_the_limit_are_left_out_and_hashed(job, monkeypatch):
    sheet, shaking = job
    monkeypatch.setattr(files, "MOST_RECORDS", 1_000_000)
    assert not holds_records(shaking.records)
    contents, listed = attached(sources(sheet, shaking))
    assert contents.keys() == {"input.xlsx", "results.json", "roofslip.json"}
    assert listed["has_records"] is False
    assert sum(entry["kind"] == "record" for entry in listed["files"]) == 21


def test_a_file_with_several_channels_counts_once():
    row = stand_in.book().shaking.records[0]
    rows = [
        replace(row, name="records/a.v2 | Up", size=MOST_RECORDS),
        replace(row, name=".\\records\\a.v2|North", size=MOST_RECORDS),
        replace(row, name="Data!a", size=0, format="pasted column"),
    ]
    assert record_bytes(rows) == MOST_RECORDS
    assert holds_records(rows)
    assert not holds_records([*rows, replace(row, name="b.csv", size=1)])


RENAMED = {
    "Results.json": "renamed/1/Results.json",
    "a.csv": "a.csv",
    "A.csv": "renamed/3/A.csv",
    "sub/a.csv": "sub/a.csv",
}


def test_names_that_collide_are_renamed_with_a_map(job, tmp_path):
    sheet, shaking = job
    rows = []
    for row, name in zip(shaking.records, RENAMED, strict=False):
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(name)
        rows.append(replace(row, name=name, sha256=hashlib.sha256(name.encode()).hexdigest()))
    path = tmp_path / "input.xlsx"
    shutil.copy(EXAMPLE / "input.xlsx", path)
    moved = replace(sheet, book=replace(sheet.book, path=path), path=path)
    _, listed = attached(sources(moved, replace(shaking, records=tuple(rows))))
    records = [entry for entry in listed["files"] if entry["kind"] == "record"]
    assert {entry["path"]: entry["name"] for entry in records} == RENAMED


def test_a_former_revision_is_attached_under_a_name_of_its_own(job, tmp_path):
    sheet, shaking = job
    (tmp_path / "results.json").write_text("{}")
    found = sources(sheet, shaking, tmp_path / "results.json")
    assert (found[-1].path, found[-1].content) == ("since/results.json", b"{}")
