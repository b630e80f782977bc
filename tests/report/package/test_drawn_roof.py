"""The warehouse drawn in CAD with an L-shaped array around a unit: read, completed, reported."""

import json
import shutil

import pytest
from click.testing import CliRunner

import packages
from inputs import FT, NO_SIDES, clearance
from places import ROOT
from report.cli.main import main
from report.sheet.reading.read import read
from report.sheet.schema.choices import UnitsFirst
from report.sheet.schema.scene import Clearance, Roof
from report.sheet.writing.template import write_template
from sketch import Sketch

L_FT = ((30, 140), (180, 140), (180, 190), (140, 190), (140, 232), (30, 232))

pytestmark = pytest.mark.nightly


def box(x0, x1, y0, y1):
    return (x0, y0), (x1, y0), (x1, y1), (x0, y1)


def drawing(folder):
    sketch = Sketch()
    sketch.ring("ROOF-OUTLINE", box(0, 360, 0, 240))
    sketch.ring("ROOF-PARAPET", box(0, 360, 240, 241), "NORTH, height 30 in")
    sketch.ring("ARRAY", L_FT, "A1")
    sketch.ring("ARRAY", box(30, 150, 30, 132), "A2")
    sketch.ring("ARRAY", box(200, 350, 30, 180), "A3")
    sketch.ring("OBJECT", box(150, 162, 196, 208), "RTU-1, height 48 in")
    sketch.ring("OBJECT", box(260, 272, 13, 25), "RTU-2, height 48 in")
    return sketch.saved(folder)


CLEARANCES = (
    clearance("A1", "A2", 8 * FT, "down"),
    clearance("A1", "RTU-1", 6 * FT),
    clearance("A1", "NORTH", 8 * FT, "up"),
    clearance("A3", "RTU-2", 5 * FT, "down"),
    clearance("A3", "EDGE-2", 10 * FT, "across"),
)


def without_places(path):
    """Write the example without what a drawing gives, and with clearances of the plan."""
    given = read(ROOT / "projects" / "example" / "input.xlsx").project
    changes = {
        "roof": Roof(),
        "arrays": tuple(array.model_copy(update=NO_SIDES) for array in given.arrays),
        "objects": (),
        "clearances": tuple(map(Clearance.model_validate, CLEARANCES)),
        "motions": given.motions[:3],
    }
    write_template(path, units=UnitsFirst.US, example=given.model_copy(update=changes))


@pytest.fixture(scope="module")
def reported(tmp_path_factory):
    job = tmp_path_factory.mktemp("drawn")
    without_places(job / "input.xlsx")
    shutil.copytree(ROOT / "projects" / "example" / "records", job / "records")
    with packages.unlaid(), packages.undrawn():
        for words in (["plan", "read", drawing(job), job], ["report", job]):
            done = CliRunner().invoke(main, list(map(str, words)))
            assert done.exit_code == 0, done.output
    return job


def test_the_gap_is_that_of_the_outline_and_the_package_says_so(reported):
    document = json.loads((reported / "out" / "results.json").read_text())
    gaps = {(row["array"], row["other"]): row["gap_m"] for row in document["neighbors"]}
    # The unit is 6 ft above the lower leg and 10 ft from the upper one.
    assert gaps["A1", "RTU-1"] == pytest.approx(6 * FT, abs=1e-6)
    assert gaps["A1", "A2"] == pytest.approx(8 * FT, abs=1e-6)
    assert not any(row["contradictions"] for row in document["neighbors"])
    html = (reported / "out" / "calc-package.pdf").read_text(encoding="utf-8")
    said = "By an outline, of which the rectangle around it is given: A1 (6 vertices)."
    assert said in packages.words(html)
