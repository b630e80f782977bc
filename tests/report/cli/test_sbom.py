import hashlib

from click.testing import CliRunner

from report.cli.main import main
from report.provenance.software import sbom, sbom_sha256


def test_the_bill_is_printed_or_written_with_its_hash(tmp_path):
    done = CliRunner().invoke(main, ["sbom"])
    assert done.exit_code == 0
    assert done.output.encode() == sbom()
    path = tmp_path / "sbom.json"
    done = CliRunner().invoke(main, ["sbom", "--out", str(path)])
    assert done.exit_code == 0
    assert hashlib.sha256(path.read_bytes()).hexdigest() == sbom_sha256()
    assert sbom_sha256() in done.output


def test_a_folder_that_is_not_there_is_an_input_error(tmp_path):
    done = CliRunner().invoke(main, ["sbom", "--out", str(tmp_path / "none" / "sbom.json")])
    assert done.exit_code == 2
