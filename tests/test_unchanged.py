"""Results, plan and tables are to the bit as before results had a schema."""

import subprocess
import sys

import pytest

from places import ROOT, TESTS

BEFORE = "286e05a"
"""The last commit before that change."""


@pytest.mark.nightly("tests/unchanged.py")
def test_results_plans_and_tables_are_as_before_their_schema(tmp_path):
    words = ["git", "cat-file", "-e", f"{BEFORE}^{{commit}}"]
    if subprocess.run(words, cwd=ROOT, capture_output=True, check=False).returncode:
        pytest.skip("the commit to compare with is not in this clone")
    cases = ["example", "conditions", "SI", "links", "revision", "NG"]
    command = [sys.executable, str(TESTS / "unchanged.py"), BEFORE, "--folder", str(tmp_path)]
    done = subprocess.run(
        [*command, "--cases", *cases], capture_output=True, text=True, check=False, timeout=900
    )
    assert done.returncode == 0, done.stdout + done.stderr[-2000:]
