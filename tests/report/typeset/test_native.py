"""Where the native libraries are found."""

import subprocess
import sys

import pytest

IMPORTED = """
import ctypes.util, subprocess, sys
usual = ctypes.util.find_library
subprocess.Popen = None  # what looks for a library starts other programs
from report.libraries import load_renderer
load_renderer()
assert "weasyprint" in sys.modules and ctypes.util.find_library is usual
"""


@pytest.mark.skipif(sys.platform != "linux", reason="other systems look in other ways")
def test_the_renderer_is_loaded_without_a_compiler_or_linker():
    run = subprocess.run([sys.executable, "-c", IMPORTED], capture_output=True, text=True)
    assert (run.returncode, run.stderr) == (0, "")
