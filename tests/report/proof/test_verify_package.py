"""A package verifies against its own input; tampered ones do not, and it is said where."""

import io
import json
import random
import shutil
from dataclasses import replace

import pikepdf
import pytest
from click.testing import CliRunner

import packages
import tampering
from growth import grows_faster
from places import ROOT
from report.cli.main import main
from report.making import OUTPUTS
from report.proof.package import open_package, take_out
from sheets import type_into
from solver.model import InputError

RECORD = "records/RM1-x.csv"
LETTER = ROOT / "projects" / "school" / "peer-review.pdf"


@pytest.fixture(scope="module")
def package(job):
    return open_package(job / "out" / "calc-package.pdf")


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


@pytest.mark.nightly("report/proof/", "report/provenance/")
def test_a_package_is_the_same_to_the_last_bit_and_nothing_is_left_behind(
    job, after_record_changed
):
    """A process beside another wrote it; this one is alone, and has laid out a package before."""
    done = run(job / "out" / "calc-package.pdf")
    assert done.exit_code == 0, done.output
    assert "Same: the input in the package gives this package, to the last bit." in done.output
    assert sorted(path.name for path in job.iterdir()) == ["input.xlsx", "out", "records"]


@pytest.mark.nightly("report/proof/", "report/provenance/", "report/sheet/reading/beside.py")
def test_a_package_with_a_document_verifies_and_with_another_one_differs(tmp_path, given):
    ignored = shutil.ignore_patterns("out", "make.py", "__pycache__")
    shutil.copytree(ROOT / "projects" / "conditions", tmp_path / "job", ignore=ignored)
    shutil.copy(LETTER, tmp_path / "job" / "friction.pdf")
    named = {"Friction tests/Test report file": "friction.pdf"}
    type_into(tmp_path / "job" / "input.xlsx", named)
    done = CliRunner().invoke(main, ["report", str(tmp_path / "job")])
    assert done.exit_code == 0, done.output
    path = tmp_path / "job" / "out" / "calc-package.pdf"
    assert open_package(path).files["friction.pdf"] == LETTER.read_bytes()
    done = run(path)
    assert done.exit_code == 0, done.output
    another = with_file("friction.pdf", LETTER.read_bytes() + b"%")
    done = run(given(path.read_bytes(), another), "--json")
    assert done.exit_code == 3, done.output
    said = json.loads(done.stdout)["differences"]
    assert said[0].startswith("roofslip.json: hash is ")
    assert any(text.startswith("sheet ") and "where the input gives" in text for text in said)


@pytest.mark.nightly("report/proof/", "report/provenance/")
def test_this_process_alone_writes_every_file_as_two_do(job, tmp_path_factory):
    alone = packages.reported(tmp_path_factory, job.name).out
    for name in OUTPUTS:
        assert (alone / name).read_bytes() == (job / "out" / name).read_bytes(), name


def test_a_record_that_was_changed_with_its_hash_gives_other_numbers(after_record_changed):
    done = after_record_changed
    assert done.exit_code == 3, done.output
    said = json.loads(done.stdout)
    assert said["is_same"] is False
    assert any(text.startswith("results.json: ") for text in said["differences"])
    assert any(text.startswith("sheet 1: ") for text in said["differences"])


def test_an_input_that_no_longer_runs_differs(data, given):
    done = run(given(data, with_file(RECORD, b"none")))
    assert done.exit_code == 3, done.output
    assert "its input: " in done.output


def test_the_end_of_an_attached_pdf_is_not_that_of_the_package(data, tmp_path):
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
    path = tmp_path / "given.pdf"
    path.write_bytes(out.getvalue())
    package = open_package(path)
    assert package.files[RECORD] == letter
    assert package.first == package.data


@pytest.mark.parametrize("content", [b"", b"words", b"%PDF-1.7\n", None])
def test_what_is_no_package_is_an_input_error(tmp_path, content):
    path = tmp_path / "given.pdf"
    if content is not None:
        path.write_bytes(content)
    assert run(path).exit_code == 2


def test_many_ends_that_point_to_many_digits_are_refused_in_a_time_that_grows_as_they_do(tmp_path):
    path = tmp_path / "given.pdf"

    def refused(count):
        path.write_bytes(b"%PDF-1.7\n" + b"1" * 400 * count + b"\nstartxref\n9\n%%EOF" * count)
        with pytest.raises(InputError, match="is no PDF, or is cut off"):
            open_package(path)

    assert not grows_faster(refused, int, 500)


def test_a_pdf_without_the_input_is_an_input_error(tmp_path):
    path = tmp_path / "given.pdf"
    with pikepdf.new() as pdf:
        pdf.add_blank_page()
        pdf.save(path)
    done = run(path)
    assert done.exit_code == 2
    assert "holds no roofslip.json" in done.output


@pytest.mark.parametrize("name", ["roofslip.json", "results.json"])
@pytest.mark.by_day(1)
def test_an_attachment_that_is_no_json_of_ours_makes_no_package(few_sheets, given, name):
    twice = b'{"schema_version": 1, "schema_version": 1}'
    done = run(given(few_sheets, lambda pdf: tampering.set_file(pdf, name, twice)))
    assert done.exit_code == 2, done.output
    assert f"{name} is damaged" in done.output
    assert "Traceback" not in done.output


@pytest.mark.parametrize(
    "entries",
    [{"files": {}}, {"files": [1]}, {"hash": 1}, {"environment": []}, {"environment": {"numpy": 1}},
     {"sbom_sha256": "OK"}, {"schema_version": "1"}, {"schema_version": 99}, {"has_records": "no"}],
    ids=str,
)  # fmt: skip
@pytest.mark.by_day(1)
def test_an_entry_of_another_type_makes_no_package(few_sheets, given, entries):
    done = run(given(few_sheets, tampering.of_manifest(lambda manifest: manifest.update(entries))))
    assert done.exit_code == 2, done.output
    assert "roofslip.json" in done.output


def test_a_package_larger_than_any_is_not_unpacked(proof, few_sheets, monkeypatch):
    monkeypatch.setattr("report.proof.objects.MOST_UNPACKED", 100_000)
    with pytest.raises(InputError, match="unpacks to more than"):
        proof(tampering.rewritten(few_sheets, tampering.turned), few_sheets)


def test_an_attachment_that_unpacks_to_a_thousand_times_its_size_is_refused(few_sheets, given):
    path = given(few_sheets, lambda pdf: tampering.set_file(pdf, RECORD, bytes(90_000_000)))
    assert path.stat().st_size < 2_000_000
    assert run(path).exit_code == 2


def test_a_package_that_needs_no_password_and_is_encrypted_differs(proof, few_sheets):
    given = io.BytesIO()
    with pikepdf.open(io.BytesIO(few_sheets)) as pdf:
        pdf.save(given, encryption=pikepdf.Encryption(owner="owner", user=""))
    try:
        found = proof(given.getvalue(), few_sheets)
    except InputError:
        return
    assert "document /Encrypt" in " ".join(found.differences)


@pytest.mark.nightly
def test_drawings_that_cannot_be_compared_end_with_a_code_of_their_own(data, given):
    def change(pdf):
        tampering.of_other_software(pdf)
        tampering.painted_over(pdf)

    done = run(given(data, change))
    assert done.exit_code == 4, done.output
    assert "It names other versions than those here: harfbuzz 0.9 (here " in done.output
    assert "Nothing differs in what could be compared: words" in done.output
    assert "as the software here draws them: sheet 1. The other versions" in done.output
    assert "Same" not in done.output


@pytest.mark.by_day(1)
def test_a_file_that_was_only_written_again_has_the_same_content(proof, data):
    again = tampering.rewritten(data, lambda pdf: None)
    assert again != data
    found = proof(again)
    assert found.is_same, found.differences
    assert found.how == "words of every sheet, and numbers to 1e-12, and every drawing"


@pytest.mark.parametrize("kind", tampering.OF_THE_FILE, ids=lambda kind: kind.__name__)
@pytest.mark.by_day(1)
def test_tampering_is_found(proof, data, few_sheets, kind):
    # Every sheet after one that is missing is compared by its words.
    whole = few_sheets if kind is tampering.without_sheet else data
    given = kind(whole, random.Random(1))
    assert given != whole
    try:
        found = proof(given, whole)
    except InputError:
        assert kind in (tampering.cut, tampering.flipped, tampering.byte_in_attachment)
    else:
        assert not found.is_same
        assert found.differences


def test_another_type_of_an_attachment_is_found(tampered, data):
    def change(pdf):
        pdf.attachments[RECORD].obj.EF.F.Subtype = pikepdf.Name("/text/plain")

    assert not tampered(data, change).is_same


INFO = ("/Title", "/Author", "/Creator", "/Producer", "/CreationDate")


def other_information(pdf):
    pdf.docinfo.update(dict.fromkeys(INFO, "Another one"))


def more_information(pdf):
    pdf.docinfo["/Subject"] = "Approved"


def no_information(pdf):
    del pdf.trailer["/Info"]


def other_metadata(pdf):
    stream = pdf.Root.Metadata
    stream.write(stream.read_bytes().replace(b"Warehouse", b"Hospital"))


@pytest.mark.parametrize(
    ("change", "places"),
    [
        (other_information, {f"/Info {key}" for key in INFO}),
        (more_information, {"/Info /Subject"}),
        (no_information, {"/Info"}),
        (other_metadata, {"/Metadata"}),
    ],
)
def test_what_the_document_says_of_itself_is_compared(tampered, few_sheets, change, places):
    assert set(tampered(few_sheets, change).differences) >= {f"document {at}" for at in places}


def test_a_changed_digit_is_told_with_its_sheet_and_its_words(proof, data):
    found = proof(tampering.digit_in_text(data, random.Random(3)))
    assert not found.is_same
    assert any(
        text.startswith("sheet ") and "where the input gives" in text for text in found.differences
    )


def test_a_changed_number_is_told_with_its_place_and_by_how_much(tampered, few_sheets):
    def change(pdf):
        results = json.loads(tampering.file_of(pdf, "results.json"))
        results["arrays"][0]["design_m"] *= 1.001
        with_file("results.json", json.dumps(results).encode())(pdf)

    found = tampered(few_sheets, change).differences
    told = next(text for text in found if "arrays[0].design_m" in text)
    assert told.endswith("(1.0e-03 of it)")


@pytest.mark.parametrize(
    "path", ["../x.csv", "/x.csv", "a/../../x", "C:/x.csv", "a\\b.csv", "", "a\n", "x" * 300]
)
def test_no_attachment_is_taken_out_of_the_folder(tmp_path, package, path):
    first, second, *others = package.manifest.files
    files = (first, second.model_copy(update={"path": path}), *others)
    given = replace(package, manifest=package.manifest.model_copy(update={"files": files}))
    with pytest.raises(InputError, match="outside of its folder"):
        take_out(given, tmp_path / "there")
    assert not (tmp_path / "x.csv").exists()


def test_attachments_beyond_the_limits_are_refused(job, monkeypatch):
    monkeypatch.setattr("report.proof.package.MAX_TOTAL", 1000)
    with pytest.raises(InputError, match="unpack to more than"):
        open_package(job / "out" / "calc-package.pdf")


def test_records_that_were_left_out_are_taken_from_a_folder_and_their_hash_is_checked(
    job, data, given, tmp_path
):
    change = tampering.of_manifest(lambda manifest: manifest.update(has_records=False))
    package = open_package(given(data, change))
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
    with pytest.raises(InputError, match="no workbook, or more than one"):
        open_package(given(data, change))
