"""Packages of other ways to begin: without motions, and from a roof that was drawn in CAD."""

import json
import math
import re
import shutil
from itertools import pairwise

import pytest

from fixtures import assessments, commands, packages, pages, projects
from fixtures.dxf import Sketch
from fixtures.libreoffice import recalculated
from fixtures.paths import ROOT
from fixtures.project_parts import FT, NO_SIDES, clearance
from fixtures.spaces import spaced
from fixtures.workbooks import type_into, without_motions
from report.assessment.checks.sentence import sentence
from report.assessment.design.routes import Route
from report.assessment.design.verdict import Verdict
from report.cli.project_findings import findings_before_runs, lines
from report.drawing.layers import Layer
from report.drawing.plan_dxf import write_dxf
from report.drawing.plan_layers import plan_drawing
from report.making import make
from report.pages.registry import OF_MOTIONS, PAGES, package_data, pages_in
from report.pages.terminal import summary
from report.project.model.choices import PackageEdition, UnitsFirst
from report.project.model.roof import Clearance, Roof
from report.project.read.read import read
from report.project.write.template import write_template
from report.results.results_json import former_from, results_json
from report.results.xlsx import results_xlsx

PRESCRIPTIVE_M = 60 * 0.0254 * (1.566 - 0.4) ** 2


def with_arrays(**changes):
    """The example without motions, its first array changed."""
    given = assessments.without_motions()
    first, *others = given.project.arrays
    arrays = (first.model_copy(update=changes), *others)
    return projects.assessed_anew(given, given.project.changed(arrays=arrays))


def test_all_take_the_prescriptive_displacement_and_what_is_not_permitted_is_ng():
    for item in assessments.without_motions().arrays:
        assert item.route is Route.PRESCRIPTIVE
        assert item.is_permitted
        assert item.design_m == pytest.approx(PRESCRIPTIVE_M, rel=1e-4)
        assert not item.runs
        assert math.isnan(item.analysis.value_m)
    given = assessments.without_motions()
    verdicts = {gap.between: gap.verdict for gap in given.clearances}
    assert verdicts["A1", "A2"] is Verdict.OK  # 96 in, for 81.6
    assert verdicts["A1", "RTU-1"] is Verdict.NG  # 48 in
    assert given.verdict is Verdict.NG
    given = with_arrays(mu=0.35)
    first = given.arrays[0]
    assert given.array_verdict(first) is Verdict.NG
    assert math.isnan(first.permitted_m)
    assert {gap.verdict for gap in given.gaps_of("A1")} == {Verdict.NONE}
    failed = {check.id: check for check in given.open if check.verdict is Verdict.NG}
    said = sentence(failed["prescriptive_min_mu"], us_first=True)
    assert said.startswith("Friction coefficient, prescriptive procedure, A1")
    assert ": 0.350. Required: at least 0." in said
    way = "Enter motions on the Motions worksheet, for an analysis."
    assert failed["design"].remedy == way
    steep = with_arrays(slope_value=8.0)
    assert not any(check.remedy == way for check in steep.open if "A1" in check.arrays)


def test_pages_and_plan_are_those_that_need_no_run():
    array = with_arrays(mu=0.5, cg_height_m=1.0, support_spacing_m=0.8).arrays[0]
    assert array.tipping.ratio == pytest.approx(0.5 / (0.8 / 2.0))
    assert not array.tipping.is_ok
    package = package_data(assessments.without_motions(), edition=PackageEdition.COMPLETE)
    ids = [page.id for page in PAGES]
    assert set(ids) >= OF_MOTIONS
    left = [id for id in ids if id not in OF_MOTIONS]
    # The plan begins a sheet, and follows the first one where nothing else would fill the second.
    assert left[1:3] == ["basis", "plan"]
    assert [page.id for page in pages_in(package)] == [left[0], "plan", "basis", *left[3:]]
    usual = package_data(assessments.usual(), edition=PackageEdition.COMPLETE)
    assert [page.id for page in pages_in(usual)] == ids
    drawn = write_dxf(plan_drawing(assessments.without_motions())).decode()
    layers = [after.strip() for at, after in pairwise(drawn.splitlines()) if at.strip() == "8"]
    assert Layer.DESIGN.title in layers
    assert Layer.RUNS.title not in layers


CLAIMED = re.compile(
    r"PRD|final value|as run|runs? of [0-9]|response history|every run|all runs|AC156",
    re.IGNORECASE,
)
"""What only runs give."""


@pytest.mark.parametrize(
    "id", [*pages.FRONT, *(id for id in pages.IDS if id not in OF_MOTIONS | {"symbols"})]
)
def test_no_page_states_anything_of_runs(id):
    text = pages.page_of(assessments.without_motions(), id)
    # What the workbook was given, and the numbers of the rule set, are no claims.
    if id not in ("echo", "provisions"):
        assert not CLAIMED.search(text)
    assert "nan" not in text.split()


def test_check_says_what_is_made_and_the_screen_what_an_analysis_could_save(tmp_path):
    path = type_into(without_motions(tmp_path), {"Options/Smaller events": "0.50"})
    sheet = read(path)
    _, found = findings_before_runs(sheet)
    notes = [line for line in lines(sheet, found) if line.startswith("note: ")]
    assert any("Motions!" in note and "uses the prescriptive displacement" in note
               for note in notes)  # fmt: skip
    assert any("smaller events requires motions and is skipped" in note for note in notes)
    said = list(summary(assessments.without_motions()))
    assert said[0].split()[:3] == ["array", "prescriptive", "design"]
    (note,) = [line for line in said if line.startswith("note: no motions are listed")]
    assert "81.6 in (2072 mm)" in spaced(note)
    assert "40.8 in (1036 mm)" in spaced(note)
    assert re.fullmatch(r"verdict: NG, largest D/C \d\.\d\d", said[-1])


def test_results_json_has_null_for_what_needs_runs_and_is_read_as_a_former_revision():
    given = assessments.without_motions()
    content = results_json(given, assessments.evidence(given))
    document = json.loads(content)
    assert document["motions"] == []
    assert "motions" not in {row["id"] for row in document["checks"]}
    assert document["certainty"] is None
    array = document["arrays"][0]
    assert array["computed_m"] is array["peak_speed_mps"] is array["uplift"]["n_min_g"] is None
    assert array["design_governs"] == "prescriptive"
    assert array["runs"] == []
    former = former_from(content, "former")
    assert former.arrays[0].design_m == given.arrays[0].design_m


@pytest.mark.nightly
def test_results_xlsx_follows_from_the_site_by_formula(tmp_path):
    path = tmp_path / "results.xlsx"
    path.write_bytes(results_xlsx(assessments.without_motions(), ()))
    (book,) = recalculated([path], tmp_path)
    assert book.sheetnames == [
        "Summary", "Design", "Clearances", "Adjacent items", "Requirements", "Inputs",
    ]  # fmt: skip
    rows = [[cell.value for cell in row] for row in book["Design"].iter_rows(min_row=4)]
    heads, first = rows[0], rows[1]
    design = dict(zip(heads, first, strict=False))
    assert design["Analysis [in]"] == "none"
    assert design["Number of motions"] == 0
    assert first.count(pytest.approx(PRESCRIPTIVE_M / 0.0254, abs=0.05)) >= 3
    cells = [cell for sheet in book for row in sheet for cell in row if cell.value is not None]
    assert not [cell.coordinate for cell in cells if str(cell.value).startswith("#")]


@pytest.mark.nightly
def test_the_package_is_made_and_verified_from_the_workbook_alone(tmp_path):
    made = make(without_motions(tmp_path), None, None, lambda _: None)
    assert {path.name for path in made.folder.iterdir()} >= made.files.keys()
    commands.stdout_of("verify-package", made.folder / "calc-package.pdf")


L_FT = ((30, 140), (180, 140), (180, 190), (140, 190), (140, 232), (30, 232))


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
    clearance("A1", "A2", 8 * FT, "downslope"),
    clearance("A1", "RTU-1", 6 * FT),
    clearance("A1", "NORTH", 8 * FT, "upslope"),
    clearance("A3", "RTU-2", 5 * FT, "downslope"),
    clearance("A3", "EDGE-2", 10 * FT, "cross-slope"),
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
    for folder in ("documents", "records"):
        shutil.copytree(ROOT / "projects" / "example" / folder, job / folder)
    with packages.unlaid(), packages.undrawn():
        commands.stdout_of("plan", "read", drawing(job), job)
        commands.stdout_of("report", job)
    return job


@pytest.mark.nightly
def test_the_gap_is_that_of_the_outline_and_the_package_says_so(reported):
    document = json.loads((reported / "out" / "results.json").read_text())
    gaps = {(row["array"], row["other"]): row["gap_m"] for row in document["neighbors"]}
    # The unit is 6 ft above the lower leg and 10 ft from the upper one.
    assert gaps["A1", "RTU-1"] == pytest.approx(6 * FT, abs=1e-6)
    assert gaps["A1", "A2"] == pytest.approx(8 * FT, abs=1e-6)
    assert not any(row["contradictions"] for row in document["neighbors"])
    html = (reported / "out" / "calc-package.pdf").read_text(encoding="utf-8")
    said = "Outline (bounding rectangle listed): A1 (6 vertices)."
    assert said in packages.words(html)
