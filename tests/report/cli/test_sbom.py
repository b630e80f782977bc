import hashlib

from commands import printed, refused
from report.provenance.software import sbom, sbom_sha256


def test_the_bill_is_printed_or_written_with_its_hash(tmp_path):
    assert printed("sbom").encode() == sbom()
    path = tmp_path / "sbom.json"
    assert sbom_sha256() in printed("sbom", "--out", path)
    assert hashlib.sha256(path.read_bytes()).hexdigest() == sbom_sha256()


def test_a_folder_that_is_not_there_is_an_input_error(tmp_path):
    refused("sbom", "--out", tmp_path / "none" / "sbom.json")
