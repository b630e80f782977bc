"""A suite of one motion given sample by sample: what its files say of it."""

import hashlib
import json
import math

import pytest

import waves
from report.suite.files import suite_files, suite_table
from report.suite.inputs import ac156_targets
from report.text.units import G_MPS2
from solver.rules.hazard import Tail
from waves import PEAK_G

pytestmark = pytest.mark.quick


def test_the_files_of_a_suite_say_what_its_samples_are():
    suite = waves.suite(1)
    targets = ac156_targets("asce7-16", s_ds_g=1.2, z_over_h=1.0, tail=Tail.AC156)
    files = suite_files(suite, targets, seed=3, records={})
    document = json.loads(files["suite.json"])
    (motion,) = document["motions"]
    for each in motion["components"]:
        assert each["sha256"] == hashlib.sha256(files[each["file"]]).hexdigest()
        assert each["pga_g"] == pytest.approx(PEAK_G, rel=1e-3)
    first = motion["components"][0]
    # The velocity of a sine that starts at rest reaches twice its amplitude, a / (pi f).
    assert first["pgv_mps"] == pytest.approx(PEAK_G * G_MPS2 / (math.pi * 0.5), rel=1e-3)
    assert motion["correlation_xy"] == pytest.approx(0.0, abs=1e-9)
    assert document["envelope_s"] == pytest.approx([1.0, 2.0, 1.0])
    assert any(not row["satisfied"] for row in document["acceptance"])
    assert files["suite.png"].startswith(b"\x89PNG")
    assert any(
        line.startswith("0 of 3 components have spectra of 0.90 to 1.30")
        for line in suite_table(suite, targets)
    )
