"""What set-up compiles is all that a report with three components runs."""

import json
import os
import subprocess
import sys

from places import ROOT, TESTS

CODE = """
import json
from solver.kernels import one_axis, oscillator, rivals, row, two_axes
from numba.core.dispatcher import Dispatcher
from solver.sliding.checked import PARTS

def compiled():
    return {
        f"{module.__name__}.{name} {signature}"
        for module in (one_axis, oscillator, rivals, row, two_axes)
        for name, kernel in vars(module).items()
        if isinstance(kernel, Dispatcher)
        for signature in kernel.signatures
    }

for name in PARTS:
    PARTS[name]()
before = compiled()
import stand_in
from report.assessment.evidence import support
support(stand_in.assess_input(stand_in.project(), stand_in.motions(2, seconds=8.0)))
print(json.dumps([sorted(compiled() - before), sorted(before)]))
"""


def test_a_report_compiles_nothing_that_set_up_has_not():
    paths = {"PYTHONPATH": f"{ROOT}{os.pathsep}{TESTS}"}
    command = [sys.executable, "-c", CODE]
    told = subprocess.check_output(command, cwd=ROOT, env=os.environ | paths, timeout=300)
    new, former = json.loads(told)
    assert new == []
    assert sum("slide_plane" in name for name in former) == 2  # both friction laws
