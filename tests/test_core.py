"""The core runs without its extras, and is as large as the docs say."""

import os
import re
import subprocess
import sys
from importlib.util import module_from_spec, spec_from_file_location

import pytest

from fixtures.paths import ROOT

_SPEC = spec_from_file_location("core", ROOT / "docs" / "core.py")
core = module_from_spec(_SPEC)
_SPEC.loader.exec_module(core)

ASKED = "formats of networks"
"""An extra of which every reading of a record asks whether the file is one of its own."""

# Runs a command where no module of an extra can be loaded.
WITHOUT = """
import sys
extras = tuple(sys.argv.pop(1).split(","))
class Missing:
    def find_spec(self, name, path=None, target=None):
        if name.startswith(extras):
            raise ImportError(f"{name} is an extra")
sys.meta_path.insert(0, Missing())
from report.cli.main import main
main(sys.argv[1:])
"""


def without_extras(*words):
    """The exit code and the errors of a command that has no module of an extra but those asked."""
    extras = [name for extra, names in core.extras().items() if extra != ASKED for name in names]
    command = [sys.executable, "-P", "-c", WITHOUT, ",".join(extras), *map(str, words)]
    path = {"PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        command, cwd=ROOT, env=os.environ | path, capture_output=True, text=True, check=False
    )
    return done.returncode, done.stderr


def test_a_project_is_checked_without_the_extras():
    assert without_extras("check", "projects/example", "--quiet") == (0, "")


@pytest.mark.nightly
def test_a_package_is_written_without_the_extras(tmp_path):
    code, errors = without_extras("report", "projects/example", "--out", tmp_path / "out")
    assert (code, "extra" in errors) == (0, False)
    assert (tmp_path / "out" / "calc-package.pdf").exists()


def test_a_command_of_an_extra_has_its_help_without_it_and_does_not_run():
    assert without_extras("study", "--help") == (0, "")
    code, errors = without_extras("study", "projects/study")
    assert code != 0
    assert "report.study is an extra" in errors


def test_the_core_is_counted_as_the_docs_print_it():
    page = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    printed = dict(re.findall(r"^\| (.+?) \| ([\d,]+) \|$", page, re.MULTILINE))
    folders, extras = core.counted()
    assert {f"`{folder}`" for folder in folders} | {*extras} <= printed.keys()
    (whole,) = re.findall(r"^\| core, total \| \*\*([\d,]+)\*\* \|$", page, re.MULTILINE)
    assert int(whole.replace(",", "")) == pytest.approx(folders.total(), rel=0.03)
