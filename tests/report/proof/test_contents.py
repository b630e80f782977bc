"""What no package has is refused in a time that its size bounds."""

import io

import pikepdf
import pytest
from pypdf import PdfReader

from report.proof.contents import pages, refused, words
from solver.model import InputError

pytestmark = pytest.mark.quick


def written(change):
    out = io.BytesIO()
    with pikepdf.new() as pdf:
        for _ in range(2):
            pdf.add_blank_page(page_size=(612, 792))
        pdf.attachments["a.txt"] = b"a"
        change(pdf)
        pdf.save(out)
    return PdfReader(io.BytesIO(out.getvalue()), strict=True)


def test_a_tree_of_sheets_that_doubles_at_each_level_is_not_followed():
    def change(pdf):
        below = pdf.Root.Pages.Kids[0]
        for _ in range(60):
            node = pikepdf.Dictionary(Type=pikepdf.Name.Pages, Kids=[below, below], Count=2)
            below = pdf.make_indirect(node)
        pdf.Root.Pages = below

    with pytest.raises(InputError, match="a sheet twice"):
        pages(written(change))


def doubled_forms(pdf):
    """Have each drawing paint the next one twice."""
    below = pdf.make_stream(b"0 0 1 1 re f")
    for _ in range(60):
        form = pdf.make_stream(b"/a Do /a Do")
        form.Resources = pikepdf.Dictionary(XObject=pikepdf.Dictionary(a=below))
        below = form
        below.Type, below.Subtype = pikepdf.Name.XObject, pikepdf.Name.Form
        below.BBox = [0, 0, 1, 1]
    page = pdf.pages[0].obj
    page.Contents = pdf.make_stream(b"/a Do")
    page.Resources = pikepdf.Dictionary(XObject=pikepdf.Dictionary(a=below))


def test_drawings_that_double_at_each_level_end_at_the_limit_of_time(monkeypatch):
    monkeypatch.setattr("report.proof.contents.MOST_SECONDS", 0.5)
    with pytest.raises(InputError, match="takes longer to read"):
        list(words(written(doubled_forms)))


def test_objects_beyond_the_limit_are_not_followed(monkeypatch):
    monkeypatch.setattr("report.proof.contents.MOST_OBJECTS", 100)

    def change(pdf):
        pdf.Root.Many = pikepdf.Array(range(101))
        for page in pdf.pages:
            page.Contents = pdf.make_stream(b"")

    with pytest.raises(InputError, match="more objects"):
        list(refused(written(change)))
    monkeypatch.undo()
    assert not list(refused(written(change)))


def test_below_what_is_refused_nothing_breaks_however_deep_it_goes():
    def change(pdf):
        below = pdf.make_indirect(pikepdf.Array())
        for _ in range(20_000):
            below = pdf.make_indirect(pikepdf.Array([below]))
        pdf.Root.Deep = below
        pdf.Root.OpenAction = below
        for page in pdf.pages:
            page.Contents = pdf.make_stream(b"")

    assert list(refused(written(change))) == ["document: an action (/OpenAction)"]
