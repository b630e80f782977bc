"""Documents that a workbook attaches: which files it may name, and what is said of the others."""

import hashlib

import pytest

import sheets
from report.sheet.reading import linked_files
from report.sheet.reading.read import read
from sheets import at, problems, type_into

LETTER, REPORT = "Options/Letter of review", "Friction tests/Test report file"
PRINTOUT = "Site/Hazard printout"
PDF = b"%PDF-1.7\nletter"


@pytest.fixture
def workbook(tmp_path):
    return sheets.make(tmp_path / "project")


def naming(workbook, name, content=None):
    """Return the workbook with the letter of review named, and the file beside it if it has one."""
    if content is not None:
        path = workbook.parent / name.replace("\\", "/")
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(content)
    return type_into(workbook, {LETTER: name})


@pytest.mark.parametrize(
    ("name", "path"),
    [("letter.pdf", "letter.pdf"), ("./review/a.PDF", "review/a.PDF"), ("b\\a.pdf", "b/a.pdf")],
)
def test_a_document_beside_the_workbook_is_read_with_its_hash(workbook, name, path):
    (found,) = read(naming(workbook, name, PDF)).documents
    assert (found.label, found.path, found.size) == ("Letter of review", path, len(PDF))
    assert found.sha256 == hashlib.sha256(PDF).hexdigest()


@pytest.mark.quick
def test_without_a_document_none_is_read(workbook):
    assert read(workbook).documents == ()


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("up/letter.pdf", "is a link to a file outside the workbook's folder"),
        ("records/x.csv", "is no PDF; attach it as a PDF"),
        ("leter.pdf", "does not exist; did you mean 'letter.pdf'?"),
        ("missing.pdf", "does not exist; give a file in the workbook's folder, such as"),
    ],
)
def test_what_may_not_be_attached_is_an_error_of_its_cell(workbook, name, said):
    """`test_read` has the other files that a workbook may not name."""
    folder = workbook.parent
    for home in (folder, folder.parent):
        (home / "letter.pdf").write_bytes(PDF)
    (folder / "up").symlink_to(folder.parent)
    (problem,) = problems(naming(workbook, name))
    assert problem.startswith(f"{at(LETTER)}: letter of review: '{name}' {said}")


def test_all_documents_together_have_a_limit(workbook, monkeypatch):
    monkeypatch.setattr(linked_files, "MAX_DOCUMENTS", 2 * len(PDF) - 1)
    naming(workbook, "letter.pdf", PDF)
    assert len(read(workbook).documents) == 1
    (workbook.parent / "report.pdf").write_bytes(PDF)
    (problem,) = problems(type_into(workbook, {REPORT: "report.pdf"}))
    assert problem.startswith(f"{at(LETTER)}: ")
    assert "'letter.pdf' and the other documents have more than" in problem


def test_one_file_in_three_cells_is_named_three_times(workbook):
    naming(workbook, "both.pdf", PDF)
    documents = read(type_into(workbook, {REPORT: "both.pdf", PRINTOUT: "both.pdf"})).documents
    labels = ["Hazard printout", "Test report file", "Letter of review"]
    assert [(each.label, each.path) for each in documents] == [
        (name, "both.pdf") for name in labels
    ]


def test_a_record_that_another_motion_has_is_not_the_one_that_was_meant(workbook):
    for name in ("x", "x2", "x3"):
        path = workbook.parent / "records" / f"{name}.csv"
        path.rename(path.with_name(f"RM{name[1:] or 1}-x.csv"))
    records = {"M1": "RM-x.csv", "M2": "RM2-x.csv", "M3": "RM3-x.csv"}
    cells = {f"Motions/{at}/Horizontal record": f"records/{r}" for at, r in records.items()}
    (problem,) = problems(type_into(workbook, cells))
    assert "'records/RM-x.csv' does not exist; did you mean 'records/RM1-x.csv'?" in problem
