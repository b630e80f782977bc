import re
from importlib import metadata

import pytest

from report.provenance.files import environment, versions

pytestmark = pytest.mark.quick


def test_the_parts_that_matter_are_named_with_their_versions_and_no_tool():
    known = versions()
    named = "numpy numba llvmlite pandas openpyxl matplotlib weasyprint pydyf fonttools"
    assert known.keys() - {"lxml"} == {"roofslip", "python", *named.split()}
    for name in named.split():
        assert known[name] == metadata.version(name)


def test_what_is_not_installed_is_left_out(monkeypatch):
    true = metadata.version

    def version(name):
        if name == "lxml":
            raise metadata.PackageNotFoundError(name)
        return true(name)

    monkeypatch.setattr(metadata, "version", version)
    assert "lxml" not in versions.__wrapped__()


def test_the_environment_names_system_and_processor_too():
    assert environment().keys() - versions().keys() == {"system"}
    assert re.fullmatch(r"[\w.+ -]+", environment()["system"])
