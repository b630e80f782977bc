"""Bytes decide; without them nothing is the same, and what differs or was not compared is said."""

import random

import pytest

import tampering
from nightly import by_day
from report.proof.package import Agreement, compared, failed, opened
from solver.model import InputError


def test_the_same_bytes_are_the_same(proof, data):
    found = proof(data)
    assert (found.answer, found.reasons, found.is_to_be_read) == (Agreement.SAME, (), False)


@pytest.mark.nightly
def test_a_file_that_was_only_written_again_is_not_the_same(proof, data):
    again = tampering.rewritten(data, lambda pdf: None)
    found = proof(again)
    assert found.answer == Agreement.PARTLY
    assert found.reasons == ("drawings not compared: read the package made again",)
    assert found.is_to_be_read


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


NOT_SEEN = {"glyphs mapped by a stream", "another producer"}
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
        assert found.answer == (Agreement.PARTLY if change in NOT_SEEN else Agreement.DIFFERS)


def of_another_version(pdf):
    tampering.of_manifest(lambda manifest: manifest.update(roofslip_version="0.0.9"))(pdf)


@pytest.mark.parametrize("change", tampering.REFUSED)
@pytest.mark.nightly
def test_nor_does_another_version_of_roofslip_explain_it(tampered, few_sheets, change):
    try:
        found = tampered(few_sheets, of_another_version, tampering.REFUSED[change])
    except InputError:
        assert change == "another file"
    else:
        words_only = {"smaller", "mapped by a stream", "alternative text", "text read instead",
                      "alternative text of a link", "title of a bookmark"}  # fmt: skip
        is_seen = change not in NOT_SEEN | words_only
        assert found.answer == (Agreement.DIFFERS if is_seen else Agreement.PARTLY)


@pytest.mark.nightly
@pytest.mark.parametrize("change", by_day(tampering.REDRAWN, 1), ids=lambda change: change.__name__)
@pytest.mark.parametrize("software", by_day(["", "harfbuzz"], 1))
def test_another_drawing_is_never_the_same(tampered, few_sheets, change, software):
    named = [lambda pdf: tampering.of_other_software(pdf, software)] if software else []
    found = tampered(few_sheets, *named, change)
    assert found.answer in (Agreement.PARTLY, Agreement.DIFFERS)
    assert found.answer == Agreement.DIFFERS or "drawings not compared" in found.reasons[0]


@pytest.mark.parametrize("kind", [tampering.digit_in_text, tampering.digit_in_results])
def test_words_and_numbers_are_compared_whatever_software_is_named(proof, few_sheets, kind):
    named = tampering.rewritten(few_sheets, tampering.of_other_software)
    (told,) = proof(kind(named, random.Random(3)), few_sheets).reasons
    assert "the input gives" in told


@pytest.mark.nightly
def test_a_text_that_is_copied_as_another_one_differs(tampered, few_sheets):
    found = tampered(few_sheets, tampering.of_other_software, tampering.meant_otherwise)
    assert "where the input gives" in found.reasons[0]


@pytest.mark.nightly
def test_other_versions_that_print_as_such_are_named_and_explain_drawings_only(
    tampered, data, few_sheets
):
    found = tampered(data, lambda pdf: tampering.of_other_software(pdf, "llvmlite"))
    assert found.answer == Agreement.DIFFERS  # the sheet prints the version that made it
    found = tampered(few_sheets, lambda pdf: tampering.of_other_software(pdf, "system"))
    (told,) = found.reasons
    assert told.startswith(
        "drawings not compared: read the package made again; it names system 0.9"
    )


@pytest.mark.nightly
def test_another_version_of_roofslip_is_named_and_numbers_still_count(tampered, few_sheets):
    found = tampered(few_sheets, of_another_version)
    assert found.answer == Agreement.PARTLY
    (told,) = found.reasons
    assert told.startswith("Roofslip 0.0.9 made it: install that version")
    assert "words and drawings not compared: read the package made again" in told

    def changed(pdf):
        of_another_version(pdf)
        results = tampering.file_of(pdf, "results.json")
        tampering.set_file(pdf, "results.json", results.replace(b'"mu": 0.', b'"mu": 0.1'))
        tampering.relisted(pdf)

    assert tampered(few_sheets, changed).answer == Agreement.DIFFERS


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
    "files[1].kind": lambda manifest: manifest["files"][1].update(kind="another"),
    "files": lambda manifest: manifest["files"].reverse(),
    "approved_by": lambda manifest: manifest.update(approved_by="the building department"),
}


@pytest.mark.parametrize("entry", ENTRIES)
@pytest.mark.nightly
def test_every_entry_of_the_manifest_is_compared(tampered, few_sheets, entry):
    (told,) = tampered(few_sheets, tampering.of_manifest(ENTRIES[entry])).reasons
    assert told.startswith(f"roofslip.json: {entry}")


INFO = ("/Title", "/Author", "/Creator", "/CreationDate")


@pytest.mark.parametrize("key", [*INFO, "/Subject"])
@pytest.mark.nightly
def test_what_the_document_says_of_itself_is_compared(tampered, few_sheets, key):
    def change(pdf):
        pdf.docinfo[key] = "Another one"

    (told,) = tampered(few_sheets, change).reasons
    assert told.startswith("document (")


@pytest.mark.nightly
def test_a_changed_digit_is_told_with_its_sheet_and_its_words(proof, data):
    (told,) = proof(tampering.digit_in_text(data, random.Random(3))).reasons
    assert told.startswith("sheet ")
    assert "where the input gives" in told


def test_bytes_before_the_package_are_not_the_same(data):
    with pytest.raises(InputError, match="is no PDF"):
        compared(opened(b"\n" + data), opened(data))
