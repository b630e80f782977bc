"""How the sheets of the shipped projects look, as far as a program can tell; their tags.

`CONTACT_SHEETS=FOLDER ./roofslip test tests/report/package/test_looks.py` leaves a PNG of all
sheets of each project in that folder: look at them before a release.
tests/bench/package_checks.py asks veraPDF, which knows every clause of PDF/A-3a and PDF/UA-1.
"""

import io
import os
import shutil
from base64 import b64encode
from itertools import takewhile
from pathlib import Path

import pikepdf
import pytest
from PIL import Image

from fixtures import altered_projects, packages, projects
from fixtures.commands import stdout_of
from fixtures.paths import ROOT
from fixtures.pdf import (
    broken_numbers,
    contact_sheet,
    headings_left_behind,
    is_drawing,
    read_sheets,
    short_sheets,
)
from report.assessment.support.evidence import support
from report.package.html import pages
from report.typeset.finish import FIELD, Attached
from report.typeset.pdf import lay_out

pytestmark = pytest.mark.quick


PROJECTS = tuple(
    path.parent.name
    for path in sorted(ROOT.glob("projects/*/input.xlsx"))
    if path.parent.name != "permit"  # a check of its numbers, of 7 sheets
)
LEAST_FILLED = 0.4
# Altered copies, and the sheets that each may have.
COPIES = {"too steep": 16, "no motions": 8, "prescriptive at the least friction": 7}
FILES = (
    Attached(name="input.xlsx", content=b"workbook", mime="application/vnd.ms-excel",
             relationship="Source", description="Input workbook"),
    Attached(name="records/a/x.csv", content=b"1\n2\n", mime="text/csv", relationship="Data",
             description="Record"),
    Attached(name="records/b/x.csv", content=b"3\n4\n", mime="text/csv", relationship="Data",
             description="Record"),
)  # fmt: skip


def _made(name, factory):
    """Return the PDF of a project, whichever command makes it."""
    if name != "study":
        return packages.reported(factory, name, packages.by_script).out / "calc-package.pdf"

    def run(folder):
        left_out = shutil.ignore_patterns("out")
        shutil.copytree(ROOT / "projects" / name, folder / name, ignore=left_out)
        stdout_of("study", folder / name)

    return packages.once(factory, "looked-study", run) / name / "out" / "study" / "study.pdf"


@pytest.fixture(scope="module", params=PROJECTS)
def sheets(request, tmp_path_factory):
    path = _made(request.param, tmp_path_factory)
    folder = os.environ.get("CONTACT_SHEETS") or tmp_path_factory.mktemp("contact-sheets")
    contact_sheet(path, Path(folder) / f"{request.param}.png")
    return read_sheets(path)


@pytest.mark.nightly
def test_the_sheets_have_no_fault_that_a_program_sees(sheets):
    assert len(sheets) > 10
    assert broken_numbers(sheets) == []
    assert headings_left_behind(sheets) == []
    # Each section of a study begins a sheet.
    is_study = sheets[0].blocks[0].lines[0].startswith("Study")
    assert is_study or short_sheets(sheets, LEAST_FILLED) == []


@pytest.mark.nightly
def test_plan_and_notes_begin_a_sheet_and_captions_and_equations_stay_whole(sheets):
    if sheets[0].blocks[0].lines[0].startswith("Study"):
        return
    first = [sheet.blocks[0].text for sheet in sheets]
    assert sum(text.endswith("Notes for the construction documents") for text in first) == 1
    assert any("Roof plan and schedule" in text for text in first)
    blocks = [block for sheet in sheets for block in sheet.blocks]
    (caption,) = {block.sheet for block in blocks if block.text.startswith("To scale when printed")}
    assert any(is_drawing(block) for block in blocks if block.sheet == caption)
    for title in ("Design displacement", "Separations"):
        of = [b for b in blocks if b.kind in ("H1", "H2", "Figure")]
        at = next(k for k, b in enumerate(of) if b.kind == "H2" and b.text.endswith(title))
        equations = takewhile(lambda b: b.kind == "Figure", of[at + 1 :])
        # The last follow from one another: value from analysis, floor, design displacement.
        assert len({b.sheet for b in list(equations)[-3:]}) == 1, title


@pytest.mark.nightly
@pytest.mark.parametrize("name", COPIES)
def test_packages_that_are_ng_or_prescriptive_have_no_short_sheet(name, tmp_path):
    done = altered_projects.assessed(name)
    made = tmp_path / "made.pdf"
    made.write_bytes(lay_out(pages(done, support(done))))
    sheets = read_sheets(made)
    assert short_sheets(sheets, LEAST_FILLED) == []
    assert len(sheets) <= COPIES[name]


SVG = (
    b'<svg xmlns="http://www.w3.org/2000/svg" width="360" height="300">'
    b'<rect width="360" height="300"/></svg>'
)
DRAWING = f'<p><img alt="A box" src="data:image/svg+xml;base64,{b64encode(SVG).decode()}"/></p>'
FAULTS = f"""<html lang="en-US"><head><title>T</title><style>
@page {{ size: Letter; margin: 0.9in 0.9in 0.95in }}
@page large {{ size: 17in 11in }}
table {{ table-layout: fixed; width: 100% }}
td {{ overflow-wrap: anywhere }}
p {{ margin: 0 }}
h2 {{ break-after: auto }}
</style></head><body>
<h1>Part</h1><p style="height: 7.5in">Full.</p>
<h2>Left behind</h2>{DRAWING}
<h2>Short</h2>{DRAWING}
<table style="break-before: page; width: 0.3in"><tr><td>2025-<br/>11-<br/>01</td></tr></table>
<h1 style="break-before: page">Before a larger sheet</h1><p>End.</p>
<h1 style="page: large">Last</h1><p>End.</p>
</body></html>"""


@pytest.mark.quick
def test_each_fault_is_seen_where_there_is_one(tmp_path):
    made = tmp_path / "faults.pdf"
    made.write_bytes(lay_out(FAULTS))
    sheets = read_sheets(made)
    assert headings_left_behind(sheets) == [(1, "Left behind")]
    ((sheet, cell),) = broken_numbers(sheets)
    assert (sheet, cell.replace(" / ", "")) == (3, "2025-11-01")
    assert [number for number, _ in short_sheets(sheets, LEAST_FILLED)] == [3]
    contact_sheet(made, tmp_path / "faults.png")
    with Image.open(tmp_path / "faults.png") as drawn:
        assert drawn.width > drawn.height


@pytest.fixture(scope="module")
def pdf():
    html = projects.html(projects.book(shaking=projects.motions(1, seconds=8.0)))
    with pikepdf.open(io.BytesIO(lay_out(html, FILES))) as opened:
        yield opened


@pytest.fixture(scope="module")
def elements(pdf):
    """Every structure element in order of reading, with its parent."""

    def below(element):
        kids = element.get("/K", [])
        for kid in kids if isinstance(kids, pikepdf.Array) else [kids]:
            if isinstance(kid, pikepdf.Dictionary) and "/S" in kid:
                yield kid
                yield from below(kid)

    return list(below(pdf.Root.StructTreeRoot))


def of_kind(elements, kind):
    return [element for element in elements if kind == element.S]


@pytest.mark.nightly
def test_attachments_keep_their_paths_and_the_document_claims_both_standards(pdf):
    assert list(pdf.attachments) == [file.name for file in FILES]
    associated = {str(spec.UF): spec for spec in pdf.Root.AF}
    for file in FILES:
        spec = associated[file.name]
        stream = spec.EF.F
        assert stream.read_bytes() == file.content
        assert stream.Subtype == f"/{file.mime}"
        assert stream.Params.Size == len(file.content)
        assert spec.AFRelationship == f"/{file.relationship}"
        assert str(spec.Desc) == file.description
    with pdf.open_metadata() as claims:
        assert claims["{http://www.aiim.org/pdfa/ns/id/}part"] == "3"
        assert claims["{http://www.aiim.org/pdfa/ns/id/}conformance"] == "A"
        assert claims["{http://www.aiim.org/pdfua/ns/id/}part"] == "1"
        assert "Alameda Warehouse" in claims["dc:title"]
    assert pdf.Root.Lang == "en-US"
    assert pdf.Root.MarkInfo.Marked
    assert pdf.Root.ViewerPreferences.DisplayDocTitle


@pytest.mark.nightly
def test_figures_have_alternate_texts_headings_skip_no_level_and_no_table_is_empty(elements):
    figures = of_kind(elements, "/Figure")
    assert len(figures) > 20
    assert all(str(figure.Alt).strip() for figure in figures)
    levels = [int(str(item.S)[2:]) for item in elements if str(item.S) in ("/H1", "/H2", "/H3")]
    assert levels[0] == 1
    assert set(levels) == {1, 2}
    assert all(body.K for body in of_kind(elements, "/TBody"))


@pytest.mark.nightly
def test_every_table_heading_has_the_scope_of_its_place_and_every_link_is_one(elements, pdf):
    headings = of_kind(elements, "/TH")
    scopes = {(str(heading.P.P.S), str(heading.A.Scope)) for heading in headings}
    assert scopes == {("/THead", "/Column"), ("/TBody", "/Row")}
    linked = {
        kid.Obj.objgen
        for element in of_kind(elements, "/Link")
        for kid in element.K
        if isinstance(kid, pikepdf.Dictionary) and kid.get("/Type") == "/OBJR"
    }
    links = [
        annotation.objgen
        for page in pdf.pages
        for annotation in page.get("/Annots", [])
        if annotation.Subtype == "/Link"
    ]
    assert len(links) > 30
    assert set(links) <= linked


@pytest.mark.nightly
def test_an_empty_signature_field_lies_over_the_seal_box(pdf, elements):
    (field,) = pdf.Root.AcroForm.Fields
    assert field.FT == "/Sig"
    assert str(field.T) == FIELD
    assert "/V" not in field
    assert field.objgen in {annotation.objgen for annotation in pdf.pages[0].Annots}
    left, bottom, right, top = map(float, field.Rect)
    # Letter, with margins of 0.75 in: right of the project's block, the left one of two boxes.
    assert left == pytest.approx((0.75 + 3.46 + 0.1) * 72, abs=1.0)
    assert right - left >= 1.65 * 72
    assert top - bottom >= 1.6 * 72
    (form,) = of_kind(elements, "/Form")
    assert form.K[0].Obj.objgen == field.objgen
