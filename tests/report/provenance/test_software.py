import hashlib
import json
import re
from importlib import metadata

from report.provenance.software import distributions, environment, sbom, sbom_sha256


def test_the_bill_lists_what_the_command_needs_and_no_tool():
    names = set(distributions())
    needed = "roofslip numpy numba llvmlite weasyprint pydyf openpyxl brotli"
    assert names >= set(needed.split())
    assert not names & {"pytest", "ruff", "mypy", "pikepdf", "scipy"}
    document = json.loads(sbom())
    assert document["bomFormat"] == "CycloneDX"
    assert document["metadata"]["component"]["name"] == "roofslip"
    assert {part["name"] for part in document["components"]} == names - {"roofslip"}
    for part in document["components"]:
        assert part["version"] == metadata.version(part["name"])
        assert part["purl"] == part["bom-ref"] == f"pkg:pypi/{part['name']}@{part['version']}"
        assert part["licenses"], part["name"]


def test_every_dependency_refers_to_a_component():
    document = json.loads(sbom())
    known = {part["bom-ref"] for part in document["components"]}
    known.add(document["metadata"]["component"]["bom-ref"])
    refs = [entry["ref"] for entry in document["dependencies"]]
    assert sorted(refs) == sorted(known)
    assert all(set(entry["dependsOn"]) <= known for entry in document["dependencies"])


def test_the_bill_has_no_time_and_a_hash():
    assert not re.search(rb"20\d\d-\d\d|timestamp|serialNumber", sbom())
    assert sbom_sha256() == hashlib.sha256(sbom()).hexdigest()


def test_the_environment_names_what_decides_bytes():
    known = environment()
    assert known["numpy"] == metadata.version("numpy")
    assert re.fullmatch(r"\d+\.\d+\.\d+", known["pango"])
    assert re.fullmatch(r"\d+\.\d+\.\d+", known["harfbuzz"])
