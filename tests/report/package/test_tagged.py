"""The package as PDF/A-3a and PDF/UA-1: attachments, tags, and the signature field.

tests/bench/package_checks.py asks veraPDF, which knows every clause.
"""

import io

import pikepdf
import pytest

import packages
from packages import FILES
from report.typeset.finish import FIELD

pytestmark = pytest.mark.nightly


@pytest.fixture(scope="module")
def pdf(tmp_path_factory):
    with pikepdf.open(io.BytesIO(packages.of_one_motion(tmp_path_factory))) as opened:
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


def test_attachments_keep_their_paths_types_and_relationships(pdf):
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


def test_the_document_claims_both_standards_its_language_and_its_title(pdf):
    with pdf.open_metadata() as claims:
        assert claims["{http://www.aiim.org/pdfa/ns/id/}part"] == "3"
        assert claims["{http://www.aiim.org/pdfa/ns/id/}conformance"] == "A"
        assert claims["{http://www.aiim.org/pdfua/ns/id/}part"] == "1"
        assert "Alameda Warehouse" in claims["dc:title"]
    assert pdf.Root.Lang == "en-US"
    assert pdf.Root.MarkInfo.Marked
    assert pdf.Root.ViewerPreferences.DisplayDocTitle


def test_every_figure_has_an_alternate_text(elements):
    figures = of_kind(elements, "/Figure")
    assert len(figures) > 20
    assert all(str(figure.Alt).strip() for figure in figures)


def test_headings_skip_no_level(elements):
    levels = [int(str(item.S)[2:]) for item in elements if str(item.S) in ("/H1", "/H2", "/H3")]
    assert levels[0] == 1
    assert set(levels) == {1, 2}


def test_every_table_heading_has_the_scope_of_its_place(elements):
    headings = of_kind(elements, "/TH")
    scopes = {(str(heading.P.P.S), str(heading.A.Scope)) for heading in headings}
    assert scopes == {("/THead", "/Column"), ("/TBody", "/Row")}


def test_every_link_is_tagged_as_one(pdf, elements):
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


def test_an_empty_signature_field_lies_over_the_seal_box(pdf, elements):
    (field,) = pdf.Root.AcroForm.Fields
    assert field.FT == "/Sig"
    assert str(field.T) == FIELD
    assert "/V" not in field
    assert field.objgen in {annotation.objgen for annotation in pdf.pages[0].Annots}
    left, bottom, right, top = map(float, field.Rect)
    # Letter, with margins of 0.75 in: the left one of two boxes with 0.15 in between them.
    assert left == pytest.approx(0.75 * 72, abs=0.1)
    assert right == pytest.approx((8.5 / 2 - 0.075) * 72, abs=0.1)
    assert top - bottom == pytest.approx(1.1 * 72, abs=10.0)
    (form,) = of_kind(elements, "/Form")
    assert form.K[0].Obj.objgen == field.objgen


def test_tables_without_rows_leave_no_tags(elements):
    assert all(body.K for body in of_kind(elements, "/TBody"))
