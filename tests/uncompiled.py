"""Runs a test file with numba's compiler off and asks that every line of a module was run."""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def assert_every_line_runs(module, test_file, folder):
    """Fail with what the tests print, or with the lines that no test runs."""
    data = f"--data-file={folder / 'coverage'}"
    coverage = [sys.executable, "-m", "coverage"]
    tests = [str(test_file), "-p", "no:cacheprovider", "--which", "all"]
    for command in (
        [*coverage, "run", data, f"--include={ROOT / module}", "-m", "pytest", *tests],
        [*coverage, "report", data, "--show-missing", "--fail-under=100"],
    ):
        done = subprocess.run(
            command,
            cwd=ROOT,
            env=os.environ | {"NUMBA_DISABLE_JIT": "1", "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"},
            capture_output=True,
            text=True,
            check=False,
            timeout=120,
        )
        assert done.returncode == 0, done.stdout + done.stderr
