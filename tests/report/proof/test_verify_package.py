"""A package verifies against its own input; tampered ones do not, and it is said where."""

import io
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pikepdf
import pytest

from fixtures import commands, packages, tampering
from fixtures.marks import by_day
from fixtures.paths import ROOT
from fixtures.workbooks import type_into
from report.proof.opened_package import opened, take_out
from report.proof.package_comparison import Agreement, compared, failed
from report.results.publish import OUTPUTS
from solver.errors import InputError

RECORD = "records/RM1-x.csv"
LETTER = ROOT / "projects" / "school" / "peer-review.pdf"


@pytest.fixture(scope="module")
def given(tmp_path_factory):
    """A function that writes a package after a change to its objects, and returns its path."""

    def write(data, change):
        path = tmp_path_factory.mktemp("given") / "given.pdf"
        path.write_bytes(tampering.rewritten(data, change))
        return path

    return write


def with_file(name, content):
    """A change of an attachment, and of its hash in the manifest."""

    def change(pdf):
        tampering.set_file(pdf, name, content)
        tampering.relisted(pdf)

    return change


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The project with its package as a process of its own wrote it."""
    return packages.reported(tmp_path_factory, "conditions", packages.by_script).project


@pytest.fixture(scope="module")
def after_record_changed(whole, given):
    """How the command ends for a package of which a record was changed, and its hash."""

    def change(pdf):
        lines = tampering.file_of(pdf, RECORD).split(b"\n")
        lines[500:700] = [line.replace(b",0.", b",0.9", 1) for line in lines[500:700]]
        with_file(RECORD, b"\n".join(lines))(pdf)

    data = (whole / "out" / "calc-package.pdf").read_bytes()
    return commands.run("verify-package", given(data, change), "--json")


@pytest.mark.nightly
def test_a_package_is_the_same_to_the_byte_unless_a_record_was_changed(whole, after_record_changed):
    """A process of its own wrote it; this one has laid out a package before."""
    told = commands.stdout_of("verify-package", whole / "out" / "calc-package.pdf")
    assert "Same: the embedded input reproduces this package byte for byte." in told
    assert sorted(path.name for path in whole.iterdir()) == ["input.xlsx", "out", "records"]
    assert sorted(path.name for path in (whole / "out").glob("*.pdf")) == ["calc-package.pdf"]
    done = after_record_changed
    assert done.exit_code == 1, done.output
    said = json.loads(done.stdout)
    assert said["answer"] == "differs"
    assert said["reasons"][0].startswith("roofslip.json: hash is ")


def test_errors_of_the_version_that_made_a_package_are_named_first(few_sheets, given, monkeypatch):
    def change(pdf):
        results = json.loads(tampering.file_of(pdf, "results.json")) | {"schema_version": 2}
        with_file("results.json", json.dumps(results).encode())(pdf)
        tampering.of_manifest(lambda manifest: manifest.update(roofslip_version="0.3.0"))(pdf)

    monkeypatch.setattr("report.cli.package_proof.made_again", lambda *_: few_sheets)
    path = given(few_sheets, change)
    done = commands.run("verify-package", path)
    assert done.exit_code == 4, done.output
    head, *errors, answer, _, _ = done.stdout.splitlines()  # progress of a slow machine is no part
    assert head == "Known errors of the version that created the package, which may affect it:"
    assert any("above 10 g were accepted. A record in cm/s²" in error for error in errors)
    assert answer.startswith("Not compared in full")
    path.with_name("given-again.pdf").unlink()
    listed = json.loads(commands.run("verify-package", path, "--json").stdout)["known_errors"]
    assert len(listed) == len(errors)


@pytest.mark.nightly
def test_a_package_of_another_commit_is_that_of_other_software(whole, tmp_path):
    program = [sys.executable, "-m", "report.cli", "verify-package"]
    out = [whole / "out" / "calc-package.pdf", "--out", tmp_path / "again.pdf"]
    env = os.environ | {"ROOFSLIP_VERSION": "0.4.0.dev2+12345678"}
    done = subprocess.run(
        [*program, *out], cwd=ROOT, env=env, capture_output=True, text=True, check=False
    )
    assert done.returncode == 4, done.stderr
    made_by = os.environ["ROOFSLIP_VERSION"]
    assert f"Roofslip {made_by} created it: install that version to compare" in done.stdout


@pytest.mark.nightly
def test_a_painted_package_is_not_compared_in_full_and_is_made_again_beside_it(whole, given):
    data = (whole / "out" / "calc-package.pdf").read_bytes()
    path = given(data, tampering.painted_over)
    told = commands.output_of("verify-package", path, exit_code=4)
    assert "drawings not compared: read the regenerated package" in told
    assert "Same" not in told
    assert "OK" not in told
    again = path.with_name("given-again.pdf")
    assert again.read_bytes() == data
    told = commands.errors_of("verify-package", path)
    assert "given-again.pdf: already exists; use another --out" in told


@pytest.mark.parametrize("name", ["SIGTERM", "SIGINT"])
@pytest.mark.nightly
def test_no_file_is_left_when_a_signal_ends_it(job, tmp_path, name):
    # Not by `python -m`, which a signal may end by itself though it is answered: where it comes
    # while code from a string runs, as a dataclass's does.
    program = Path(sys.executable).with_name("roofslip")
    words = [program, "verify-package", job / "out" / "calc-package.pdf"]
    there = {path.name for path in (job / "out").iterdir()}
    with subprocess.Popen(
        words, cwd=ROOT, env=os.environ | {"TMPDIR": str(tmp_path)},
        stderr=subprocess.PIPE, restore_signals=True,
    ) as process:  # fmt: skip
        end = time.monotonic() + 60
        while not list(tmp_path.glob("roofslip-*/input/input.xlsx")) and time.monotonic() < end:
            time.sleep(0.01)
        assert list(tmp_path.glob("roofslip-*"))
        process.send_signal(getattr(signal, name))
        assert process.wait(timeout=60) == 130
        process.stderr.read()
    assert not list(tmp_path.glob("roofslip-*"))
    assert {path.name for path in (job / "out").iterdir()} == there


@pytest.mark.nightly
def test_a_package_with_a_document_verifies_and_with_another_one_differs(tmp_path, given):
    ignored = shutil.ignore_patterns("out", "make.py", "__pycache__")
    shutil.copytree(ROOT / "projects" / "conditions", tmp_path / "job", ignore=ignored)
    name = "Pr\u00fcfung.pdf"
    shutil.copy(LETTER, tmp_path / "job" / name)
    named = {"Friction tests/Test report file": name}
    type_into(tmp_path / "job" / "input.xlsx", named)
    commands.stdout_of("report", tmp_path / "job")
    path = tmp_path / "job" / "out" / "calc-package.pdf"
    assert opened(path.read_bytes()).files[name] == LETTER.read_bytes()
    commands.stdout_of("verify-package", path)
    another = given(path.read_bytes(), with_file(name, LETTER.read_bytes() + b"%"))
    done = commands.run("verify-package", another, "--json")
    assert done.exit_code == 1, done.output
    (said,) = json.loads(done.stdout)["reasons"]
    assert said.startswith("roofslip.json: hash is ")


@pytest.mark.nightly
def test_this_process_writes_every_file_as_a_script_does(whole, tmp_path_factory):
    alone = packages.reported(tmp_path_factory, whole.name).out
    for name in OUTPUTS:
        assert (alone / name).read_bytes() == (whole / "out" / name).read_bytes(), name


def test_a_name_with_an_accent_is_one_name_in_the_two_encodings_of_the_renderer(data):
    name = "records/S\u00fcd.csv"

    def change(pdf):
        names = pdf.Root.Names.EmbeddedFiles.Names
        at = 2 * [str(key) for key in names[::2]].index(RECORD)
        names[at] = names[at + 1].F = pikepdf.String(name.encode())
        names[at + 1].UF = name
        tampering.of_manifest(lambda manifest: rename(manifest["files"]))(pdf)

    def rename(files):
        (record,) = (file for file in files if file["name"] == RECORD)
        record["name"] = name

    files = opened(tampering.rewritten(data, change)).files
    assert name in files
    assert RECORD not in files


def test_an_input_that_no_longer_runs_differs(data, given):
    path = given(data, with_file(RECORD, b"none"))
    assert "its input cannot be run: " in commands.output_of("verify-package", path, exit_code=1)


def test_the_end_of_an_attached_pdf_is_not_that_of_the_package(data):
    """Compression stores what it cannot shrink as it is."""
    noise = random.Random(5).randbytes(5000)
    letter = b"%PDF-1.7\n" + noise + b"\nstartxref\n1234\n%%EOF\n"

    out = io.BytesIO()
    with pikepdf.open(io.BytesIO(data)) as pdf:
        with_file(RECORD, letter)(pdf)
        pdf.save(out, compress_streams=False)
    assert letter[-25:] in out.getvalue()
    assert opened(out.getvalue()).files[RECORD] == letter


@pytest.mark.parametrize("content", [b"", b"words", b"%PDF-1.7\n", None])
@pytest.mark.quick
def test_what_is_no_package_differs_and_a_file_that_is_not_there_is_an_input_error(
    tmp_path, content
):
    path = tmp_path / "given.pdf"
    if content is not None:
        path.write_bytes(content)
    commands.output_of("verify-package", path, exit_code=2 if content is None else 1)


@pytest.mark.quick
def test_a_pdf_without_the_input_is_no_package(tmp_path):
    path = tmp_path / "given.pdf"
    with pikepdf.new() as pdf:
        pdf.add_blank_page()
        pdf.save(path)
    assert "contains no roofslip.json" in commands.output_of("verify-package", path, exit_code=1)


@pytest.mark.parametrize("name", by_day(["roofslip.json", "results.json"], 1))
def test_an_attachment_that_is_no_json_of_ours_makes_no_package(few_sheets, given, name):
    def change(pdf):
        tampering.set_file(pdf, name, b'{"schema_version": 1, "schema_version": 1}')
        if name == "results.json":
            tampering.relisted(pdf)

    told = commands.output_of("verify-package", given(few_sheets, change), exit_code=1)
    assert f"{name} is damaged" in told


@pytest.mark.parametrize(
    "entries",
    by_day([{"files": [1]}, {"hash": 1}, {"environment": {"numpy": 1}}, {"roofslip_version": "<b>"},
            {"schema_version": 99}, {"has_records": "no"}], 1),
    ids=str,
)  # fmt: skip
def test_an_entry_of_another_type_makes_no_package(few_sheets, given, entries):
    path = given(few_sheets, tampering.of_manifest(lambda manifest: manifest.update(entries)))
    assert "roofslip.json" in commands.output_of("verify-package", path, exit_code=1)


@pytest.mark.nightly
def test_an_attachment_that_unpacks_to_a_thousand_times_its_size_is_refused(few_sheets, given):
    path = given(few_sheets, lambda pdf: tampering.set_file(pdf, RECORD, bytes(90_000_000)))
    assert path.stat().st_size < 2_000_000
    commands.output_of("verify-package", path, exit_code=1)


def test_a_package_that_needs_no_password_and_is_encrypted_is_refused(few_sheets):
    given = io.BytesIO()
    with pikepdf.open(io.BytesIO(few_sheets)) as pdf:
        pdf.save(given, encryption=pikepdf.Encryption(owner="owner", user=""))
    with pytest.raises(InputError, match=r"is encrypted|is damaged"):
        opened(given.getvalue())


@pytest.mark.nightly
def test_another_type_of_an_attachment_is_not_the_same(tampered, few_sheets):
    def change(pdf):
        pdf.attachments[RECORD].obj.EF.F.Subtype = pikepdf.Name("/text/plain")

    assert tampered(few_sheets, change).answer == Agreement.PARTLY


@pytest.mark.parametrize(
    "path", by_day(["../x.csv", "/x.csv", "a/../../x", "C:/x.csv", "a\\..\\..\\b", "", "a\n",
                    "x" * 300, "a//b", "./a", "con", "a/Aux.csv", "NUL", "com1.txt"], 2)
)  # fmt: skip
def test_no_attachment_is_taken_out_of_the_folder(tmp_path, given, few_sheets, path):
    change = tampering.of_manifest(lambda manifest: manifest["files"][1].update(path=path))
    with pytest.raises(InputError, match=r"^the attachment '.*' (is|has)"):
        take_out(opened(given(few_sheets, change).read_bytes()), tmp_path / "there")
    assert not (tmp_path / "x.csv").exists()


@pytest.mark.parametrize("path", by_day(["input.xlsx", "input.xlsx/a.csv"], 1))
def test_no_attachment_is_written_over_another(tmp_path, given, few_sheets, path):
    change = tampering.of_manifest(lambda manifest: manifest["files"][1].update(path=path))
    with pytest.raises(InputError, match="in the way of another"):
        take_out(opened(given(few_sheets, change).read_bytes()), tmp_path / "there")


def test_attachments_beyond_the_limits_and_two_workbooks_are_refused(data, monkeypatch, given):
    monkeypatch.setattr("report.proof.opened_package.MAX_TOTAL", 1000)
    with pytest.raises(InputError, match="unpack to more than"):
        opened(data)
    monkeypatch.undo()
    change = tampering.of_manifest(lambda manifest: manifest["files"][1].update(kind="workbook"))
    with pytest.raises(InputError, match="no workbook or results, or more than one"):
        opened(given(data, change).read_bytes())


def test_records_that_were_left_out_are_taken_from_a_folder_and_their_hash_is_checked(
    job, data, given, tmp_path
):
    def change(pdf):
        tampering.of_manifest(lambda manifest: manifest.update(has_records=False))(pdf)
        for name in [name for name in pdf.attachments if name.startswith("records/")]:
            del pdf.attachments[name]

    package = opened(given(data, change).read_bytes())
    with pytest.raises(InputError, match="--records"):
        take_out(package, tmp_path / "one")
    workbook, _ = take_out(package, tmp_path / "two", job)
    assert (workbook.parent / RECORD).read_bytes() == (job / RECORD).read_bytes()
    shutil.copytree(job / "records", tmp_path / "other" / "records")
    with (tmp_path / "other" / "records" / "RM2-x.csv").open("a") as file:
        file.write("\n")
    with pytest.raises(InputError, match="SHA-256"):
        take_out(package, tmp_path / "three", tmp_path / "other")


def test_the_same_bytes_are_the_same_and_more_before_them_are_not(proof, data):
    found = proof(data)
    assert (found.answer, found.reasons, found.is_to_be_read) == (Agreement.SAME, (), False)
    with pytest.raises(InputError, match="is not a PDF"):
        compared(opened(b"\n" + data), opened(data))


@pytest.mark.nightly
def test_what_was_only_written_again_is_not_the_same(proof, data, tampered, few_sheets):
    again = tampering.rewritten(data, lambda pdf: None)
    found = proof(again)
    assert found.answer == Agreement.PARTLY
    assert found.reasons == ("drawings not compared: read the regenerated package",)
    assert found.is_to_be_read
    found = tampered(few_sheets, tampering.of_other_software, tampering.meant_otherwise)
    assert "where the input produces" in found.reasons[0]


@pytest.mark.parametrize("kind", by_day(tampering.OF_THE_FILE, 1), ids=lambda kind: kind.__name__)
def test_a_file_that_was_tampered_with_is_never_the_same(proof, data, few_sheets, kind):
    whole = few_sheets if kind is tampering.without_sheet else data
    given = kind(whole, random.Random(1))
    assert given != whole
    try:
        found = proof(given, whole)
    except InputError:
        assert kind in (tampering.cut, tampering.flipped, tampering.byte_in_attachment)
    else:
        # A bit anywhere may be in a drawing, which is not compared.
        may_be_hidden = kind is tampering.flipped and found.answer == Agreement.PARTLY
        assert may_be_hidden or found.answer == Agreement.DIFFERS
        assert found.reasons


NOT_SEEN = "another producer"
"""Of what no report writes: all that shows is drawings, which are not compared."""


@pytest.mark.parametrize("change", by_day(tampering.REFUSED, 1))
@pytest.mark.parametrize("software", by_day(["", "harfbuzz", "numpy"], 1))
def test_what_no_report_writes_is_refused_whatever_software_is_named(
    tampered, few_sheets, change, software
):
    named = [lambda pdf: tampering.of_other_software(pdf, software)] if software else []
    try:
        found = tampered(few_sheets, *named, tampering.REFUSED[change])
    except InputError as error:
        assert change == "another file"
        assert "other.txt is not listed" in str(error)  # noqa: PT017
    else:
        assert found.answer == (Agreement.PARTLY if change == NOT_SEEN else Agreement.DIFFERS)


def of_another_version(pdf):
    tampering.of_manifest(lambda manifest: manifest.update(roofslip_version="0.0.9"))(pdf)


@pytest.mark.nightly
@pytest.mark.parametrize("change", by_day(tampering.REDRAWN, 1), ids=lambda change: change.__name__)
@pytest.mark.parametrize("software", by_day(["", "harfbuzz"], 1))
def test_another_drawing_is_never_the_same(tampered, few_sheets, change, software):
    named = [lambda pdf: tampering.of_other_software(pdf, software)] if software else []
    found = tampered(few_sheets, *named, change)
    assert found.answer in (Agreement.PARTLY, Agreement.DIFFERS)
    assert found.answer == Agreement.DIFFERS or "drawings not compared" in found.reasons[0]


@pytest.mark.parametrize("kind", by_day([tampering.digit_in_text, tampering.digit_in_results], 1))
def test_words_and_numbers_are_compared_whatever_software_is_named(proof, few_sheets, kind):
    named = tampering.rewritten(few_sheets, tampering.of_other_software)
    (told,) = proof(kind(named, random.Random(3)), few_sheets).reasons
    assert "the input produces" in told


@pytest.mark.nightly
def test_other_versions_explain_drawings_and_words_and_no_number(tampered, data, few_sheets):
    found = tampered(data, lambda pdf: tampering.of_other_software(pdf, "llvmlite"))
    assert found.answer == Agreement.DIFFERS  # the sheet prints the version that made it
    found = tampered(few_sheets, lambda pdf: tampering.of_other_software(pdf, "system"))
    (told,) = found.reasons
    said = "drawings not compared: read the regenerated package; it names system 0.9"
    assert told.startswith(said)
    found = tampered(few_sheets, of_another_version)
    assert found.answer == Agreement.PARTLY
    (told,) = found.reasons
    assert told.startswith("Roofslip 0.0.9 created it: install that version")
    assert "text and drawings not compared: read the regenerated package" in told

    def changed(pdf):
        of_another_version(pdf)
        results = tampering.file_of(pdf, "results.json")
        tampering.set_file(pdf, "results.json", results.replace(b'"mu": 0.', b'"mu": 0.1'))
        tampering.relisted(pdf)

    found = tampered(few_sheets, changed)
    assert found.answer == Agreement.DIFFERS
    assert "install that version" in found.reasons[1]  # it may have had an error


def test_an_input_that_does_not_run_differs_unless_another_version_wrote_it(few_sheets):
    assert failed(opened(few_sheets), ["bad"]).answer == Agreement.DIFFERS
    found = failed(opened(tampering.rewritten(few_sheets, of_another_version)), ["bad"])
    assert found.answer == Agreement.PARTLY
    assert "install that version" in found.reasons[0]
    assert not found.is_to_be_read


ENTRIES = {
    "hash": lambda manifest: manifest.update(hash="0" * 12),
    "files[0].path": lambda manifest: manifest["files"][0].update(path="other.xlsx"),
    "files[1].bytes": lambda manifest: manifest["files"][1].update(bytes=7),
    "files": lambda manifest: manifest["files"].reverse(),
    "approved_by": lambda manifest: manifest.update(approved_by="the building department"),
}


@pytest.mark.parametrize("entry", ENTRIES)
@pytest.mark.nightly
def test_every_entry_of_the_manifest_is_compared(tampered, few_sheets, entry):
    (told,) = tampered(few_sheets, tampering.of_manifest(ENTRIES[entry])).reasons
    assert told.startswith(f"roofslip.json: {entry}")


@pytest.mark.parametrize("key", ["/Title", "/Author", "/CreationDate", "/Subject"])
@pytest.mark.nightly
def test_what_the_document_says_of_itself_is_compared(tampered, few_sheets, key):
    def change(pdf):
        pdf.docinfo[key] = "Another one"

    (told,) = tampered(few_sheets, change).reasons
    assert told.startswith("document (")
