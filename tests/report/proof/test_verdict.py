"""Whatever versions a package names, all of it is compared with what its input gives here."""

import hashlib
import io
import json
import random

import pikepdf
import pytest

import packages
import tampering

OTHERS = "numpy=1.0 roofslip=0.0.9"


@pytest.fixture(scope="module")
def of_others(tmp_path_factory):
    """The package as other versions of Roofslip and of a library write it."""
    return packages.of_other_versions(tmp_path_factory, "conditions", OTHERS)


@pytest.fixture(scope="module")
def short(data, of_others):
    """The hash of the same input and the other version, from what the package itself lists."""
    manifest, results = (_attached(data, name) for name in ("roofslip.json", "results.json"))
    (book,) = (file["sha256"] for file in manifest["files"] if file["kind"] == "workbook")
    rows = [f"{row['motion']} {row['component']} {row['sha256']}" for row in results["records"]]
    return hashlib.sha256("\n".join(["0.0.9", book, *rows]).encode()).hexdigest()[:12]


def _attached(data, name):
    with pikepdf.open(io.BytesIO(data)) as pdf:
        return json.loads(tampering.file_of(pdf, name))


def test_other_versions_are_named_and_the_same_drawings_are_still_the_same(tampered, data):
    found = tampered(data, tampering.of_other_software)
    assert found.is_same, (found.differences, found.not_compared)
    assert found.how == "words of every sheet, and numbers to 1e-12, and every drawing"
    (named,) = found.versions
    assert named.startswith("harfbuzz 0.9 (here ")


@pytest.mark.parametrize("change", tampering.REFUSED, ids=lambda change: change.__name__)
@pytest.mark.by_day(1)
def test_what_no_report_writes_is_refused_whatever_software_is_named(tampered, few_sheets, change):
    found = tampered(few_sheets, tampering.of_other_software, change)
    assert found.versions
    assert found.differences, found.not_compared
    assert not found.is_same


@pytest.mark.parametrize("change", tampering.REDRAWN, ids=lambda change: change.__name__)
@pytest.mark.parametrize("name", ["harfbuzz", "zlib", ""])
@pytest.mark.nightly
def test_another_drawing_differs_unless_another_version_of_what_draws_explains_it(
    tampered, few_sheets, change, name
):
    named = [lambda pdf: tampering.of_other_software(pdf, name)] if name else []
    found = tampered(few_sheets, *named, change)
    is_explained = name == "harfbuzz"
    assert bool(found.not_compared) is is_explained
    assert bool(found.differences) is not is_explained
    assert not found.is_same
    assert not (is_explained and "drawing" in found.how)


@pytest.mark.parametrize("kind", [tampering.digit_in_text, tampering.digit_in_results])
def test_words_and_numbers_are_compared_whatever_software_is_named(proof, few_sheets, kind):
    named = tampering.rewritten(few_sheets, tampering.of_other_software)
    found = proof(kind(named, random.Random(3)), few_sheets)
    assert found.versions
    assert found.differences


def test_a_text_that_is_copied_as_another_one_differs(tampered, few_sheets):
    found = tampered(few_sheets, tampering.of_other_software, tampering.meant_otherwise)
    assert any("where the input gives" in text for text in found.differences)


@pytest.mark.parametrize("name", ["numpy", "click", "another"])
@pytest.mark.by_day(1)
def test_another_version_beside_an_old_bill_of_materials_differs(tampered, few_sheets, name):
    found = tampered(few_sheets, lambda pdf: tampering.of_other_software(pdf, name))
    (text,) = found.differences
    assert text.startswith("roofslip.json: sbom_sha256 ")


ENTRIES = {
    "hash": lambda manifest: manifest.update(hash="0" * 12),
    "sbom_sha256": lambda manifest: manifest.update(sbom_sha256="0" * 64),
    "roofslip_version": lambda manifest: manifest.update(roofslip_version="9.9"),
    "files[0].path": lambda manifest: manifest["files"][0].update(path="other.xlsx"),
    "files[1].bytes": lambda manifest: manifest["files"][1].update(bytes=7),
    "files[1].kind": lambda manifest: manifest["files"][1].update(kind="another"),
    "files": lambda manifest: manifest["files"].reverse(),
    "approved_by": lambda manifest: manifest.update(approved_by="the building department"),
}


@pytest.mark.parametrize("entry", ENTRIES)
@pytest.mark.by_day(2)
@pytest.mark.nightly("report/proof/", "report/provenance/")
def test_every_entry_of_the_manifest_is_compared(tampered, few_sheets, entry):
    found = tampered(few_sheets, tampering.of_manifest(ENTRIES[entry]))
    assert any(text.startswith(f"roofslip.json: {entry}") for text in found.differences)


@pytest.mark.nightly
def test_a_package_of_other_versions_has_the_same_words_and_numbers(proof, data, of_others, short):
    found = proof(of_others, data, short)
    assert not found.differences
    assert {text.split(" (")[0] for text in found.versions} == {"numpy 1.0", "roofslip 0.0.9"}
    assert "numbers to 1e-09" in found.how
    # They print other versions and another hash.
    assert "sheet 1" in found.not_compared
    assert not found.is_same


@pytest.mark.nightly
def test_a_package_of_other_versions_is_compared_as_well(proof, data, of_others):
    def change(pdf):
        tampering.opens_with_a_script(pdf)
        tampering.alternative_text(pdf)

    given = tampering.rewritten(tampering.digit_in_text(of_others, random.Random(3)), change)
    told = proof(given, data, "0" * 12).differences
    assert any("where the input gives" in text for text in told)
    assert any("/OpenAction" in text for text in told)
    assert any(text.endswith("/Alt") for text in told)
    assert any(text.startswith("roofslip.json: hash ") for text in told)
