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
from click.testing import CliRunner

import packages
import tampering
from nightly import by_day
from places import ROOT
from report.cli.main import main
from report.making import OUTPUTS
from report.proof.package import Agreement, opened, take_out
from sheets import type_into
from solver.model import InputError

RECORD = "records/RM1-x.csv"
LETTER = ROOT / "projects" / "school" / "peer-review.pdf"


@pytest.fixture(scope="module")
def package(data):
    return opened(data)


def run(path, *options):
    return CliRunner().invoke(main, ["verify-package", str(path), *options])


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
def after_record_changed(data, given):
    """How the command ends for a package of which a record was changed, and its hash."""

    def change(pdf):
        lines = tampering.file_of(pdf, RECORD).split(b"\n")
        lines[500:700] = [line.replace(b",0.", b",0.9", 1) for line in lines[500:700]]
        with_file(RECORD, b"\n".join(lines))(pdf)

    return run(given(data, change), "--json")


@pytest.mark.nightly
def test_a_package_is_the_same_to_the_byte_and_nothing_is_left_behind(job, after_record_changed):
    """A process of its own wrote it; this one has laid out a package before."""
    done = run(job / "out" / "calc-package.pdf")
    assert done.exit_code == 0, done.output
    assert "Same: the input in the package gives this package, to the byte." in done.output
    assert sorted(path.name for path in job.iterdir()) == ["input.xlsx", "out", "records"]
    assert sorted(path.name for path in (job / "out").glob("*.pdf")) == ["calc-package.pdf"]


@pytest.mark.nightly
def test_a_painted_package_is_not_compared_in_full_and_is_made_again_beside_it(data, given):
    path = given(data, tampering.painted_over)
    done = run(path)
    assert done.exit_code == 4, done.output
    assert "drawings not compared: read the package made again" in done.output
    assert "Same" not in done.output
    assert "OK" not in done.output
    again = path.with_name("given-again.pdf")
    assert again.read_bytes() == data
    done = run(path)
    assert done.exit_code == 2
    assert "given-again.pdf: already exists; give another --out" in done.output


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
    shutil.copy(LETTER, tmp_path / "job" / "friction.pdf")
    named = {"Friction tests/Test report file": "friction.pdf"}
    type_into(tmp_path / "job" / "input.xlsx", named)
    done = CliRunner().invoke(main, ["report", str(tmp_path / "job")])
    assert done.exit_code == 0, done.output
    path = tmp_path / "job" / "out" / "calc-package.pdf"
    assert opened(path.read_bytes()).files["friction.pdf"] == LETTER.read_bytes()
    done = run(path)
    assert done.exit_code == 0, done.output
    another = with_file("friction.pdf", LETTER.read_bytes() + b"%")
    done = run(given(path.read_bytes(), another), "--json")
    assert done.exit_code == 1, done.output
    (said,) = json.loads(done.stdout)["reasons"]
    assert said.startswith("roofslip.json: hash is ")


@pytest.mark.nightly
def test_this_process_alone_writes_every_file_as_two_do(job, tmp_path_factory):
    alone = packages.reported(tmp_path_factory, job.name).out
    for name in OUTPUTS:
        assert (alone / name).read_bytes() == (job / "out" / name).read_bytes(), name


@pytest.mark.nightly
def test_a_record_that_was_changed_with_its_hash_gives_other_numbers(after_record_changed):
    done = after_record_changed
    assert done.exit_code == 1, done.output
    said = json.loads(done.stdout)
    assert said["answer"] == "differs"
    assert said["reasons"][0].startswith("roofslip.json: hash is ")


def test_an_input_that_no_longer_runs_differs(data, given):
    done = run(given(data, with_file(RECORD, b"none")))
    assert done.exit_code == 1, done.output
    assert "its input does not run: " in done.output


def test_the_end_of_an_attached_pdf_is_not_that_of_the_package(data):
    """Compression stores what it cannot shrink as it is."""
    noise = random.Random(5).randbytes(5000)
    letter = b"%PDF-1.7\n" + noise + b"\nstartxref\n1234\n%%EOF\n"

    def attach(pdf):
        tampering.set_file(pdf, RECORD, letter)
        tampering.relisted(pdf)

    out = io.BytesIO()
    with pikepdf.open(io.BytesIO(data)) as pdf:
        attach(pdf)
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
    assert run(path).exit_code == (2 if content is None else 1)


@pytest.mark.quick
def test_a_pdf_without_the_input_is_no_package(tmp_path):
    path = tmp_path / "given.pdf"
    with pikepdf.new() as pdf:
        pdf.add_blank_page()
        pdf.save(path)
    done = run(path)
    assert done.exit_code == 1
    assert "holds no roofslip.json" in done.output


@pytest.mark.parametrize("name", ["roofslip.json", "results.json"])
def test_an_attachment_that_is_no_json_of_ours_makes_no_package(few_sheets, given, name):
    twice = b'{"schema_version": 1, "schema_version": 1}'

    def change(pdf):
        tampering.set_file(pdf, name, twice)
        if name == "results.json":
            tampering.relisted(pdf)

    done = run(given(few_sheets, change))
    assert done.exit_code == 1, done.output
    assert f"{name} is damaged" in done.output
    assert "Traceback" not in done.output


@pytest.mark.parametrize(
    "entries",
    by_day([{"files": {}}, {"files": [1]}, {"hash": 1}, {"environment": []},
            {"environment": {"numpy": 1}}, {"roofslip_version": "<b>"}, {"schema_version": "1"},
            {"schema_version": 99}, {"has_records": "no"}], 1),
    ids=str,
)  # fmt: skip
def test_an_entry_of_another_type_makes_no_package(few_sheets, given, entries):
    done = run(given(few_sheets, tampering.of_manifest(lambda manifest: manifest.update(entries))))
    assert done.exit_code == 1, done.output
    assert "roofslip.json" in done.output


@pytest.mark.nightly
def test_an_attachment_that_unpacks_to_a_thousand_times_its_size_is_refused(few_sheets, given):
    path = given(few_sheets, lambda pdf: tampering.set_file(pdf, RECORD, bytes(90_000_000)))
    assert path.stat().st_size < 2_000_000
    assert run(path).exit_code == 1


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
    "path", by_day(["../x.csv", "/x.csv", "a/../../x", "C:/x.csv", "a\\b.csv", "", "a\n", "x" * 300,
                    "a//b", "./a", "con", "a/Aux.csv", "NUL", "com1.txt"], 3)
)  # fmt: skip
def test_no_attachment_is_taken_out_of_the_folder(tmp_path, given, few_sheets, path):
    change = tampering.of_manifest(lambda manifest: manifest["files"][1].update(path=path))
    with pytest.raises(InputError, match="outside of its folder"):
        take_out(opened(given(few_sheets, change).read_bytes()), tmp_path / "there")
    assert not (tmp_path / "x.csv").exists()


@pytest.mark.parametrize("path", ["input.xlsx", "input.xlsx/a.csv"])
def test_no_attachment_is_written_over_another(tmp_path, given, few_sheets, path):
    change = tampering.of_manifest(lambda manifest: manifest["files"][1].update(path=path))
    with pytest.raises(InputError, match="in the way of another"):
        take_out(opened(given(few_sheets, change).read_bytes()), tmp_path / "there")


def test_attachments_beyond_the_limits_are_refused(data, monkeypatch):
    monkeypatch.setattr("report.proof.package.MAX_TOTAL", 1000)
    with pytest.raises(InputError, match="unpack to more than"):
        opened(data)


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


def test_two_workbooks_or_none_are_refused(data, given):
    change = tampering.of_manifest(lambda manifest: manifest["files"][1].update(kind="workbook"))
    with pytest.raises(InputError, match="no workbook or results, or more than one"):
        opened(given(data, change).read_bytes())
