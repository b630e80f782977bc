"""What no package has is refused in a time that its size bounds; numbers have a tolerance."""

import io

import pikepdf
import pytest
from pypdf import PdfReader

from fixtures.growth import grows_faster
from report.proof.differences import differences, first_other_word, parsed
from report.proof.pdf_contents import pages, refused, words
from solver.errors import InputError

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


def test_sheets_or_drawings_that_double_at_each_level_are_not_followed(monkeypatch):
    monkeypatch.setattr("report.proof.pdf_contents.MOST_SECONDS", 0.5)
    with pytest.raises(InputError, match="takes longer to read"):
        list(words(written(doubled_forms)))

    def change(pdf):
        below = pdf.Root.Pages.Kids[0]
        for _ in range(60):
            node = pikepdf.Dictionary(Type=pikepdf.Name.Pages, Kids=[below, below], Count=2)
            below = pdf.make_indirect(node)
        pdf.Root.Pages = below

    with pytest.raises(InputError, match="a sheet twice"):
        pages(written(change))


def test_objects_beyond_the_limit_are_not_followed(monkeypatch):
    monkeypatch.setattr("report.proof.pdf_contents.MOST_OBJECTS", 100)

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


BAD = {
    "deep": b'{"a": ' + b"[" * 100_000 + b"]" * 100_000 + b"}",
    "not closed": b"[" * 100_000,
    "a key twice below": b'{"a": [{"b": 1, "c": 2, "b": 1}]}',
    "not a number": b'{"a": NaN}',
    "beyond floats": b'{"a": 1e999}',
    "beyond floats, whole": b'{"a": ' + b"9" * 400 + b"}",
    "many digits": b'{"a": ' + b"9" * 100_000 + b"}",
    "not UTF-8": b'{"a": "\xff"}',
    "UTF-16": '{"a": 1}'.encode("utf-16"),
    "half a pair": b'{"a": "\\ud800"}',
    "empty": b"",
    "cut": b'{"a": 1',
}
"""What is no JSON of ours, under why."""


@pytest.mark.parametrize("why", BAD)
def test_json_that_two_programs_could_read_as_two_things_is_refused(why):
    """Without the words of its reader."""
    said = r"not JSON|the key \"\w+\" appears twice|\".+ is larger than any number of a package"
    with pytest.raises(InputError, match=rf"^results.json is damaged: ({said})$"):
        parsed(BAD[why], "results.json")


def test_json_is_read_as_it_is_and_types_shared_numbers_and_letters_are_compared():
    assert parsed(b'{"a": [1, 2.5, "x", null, true]}', "") == {"a": [1, 2.5, "x", None, True]}
    for other in ([], "x", 1, None, {"a": []}):
        assert list(differences(other, {"a": 1.0}))
    ours = {"a": 1.0, "name": "A", "list": [1.0, 2.0], "new": 3.0}
    theirs = {"a": 1.0, "name": "B", "list": [1.0], "old": 4}
    assert not list(differences(theirs, ours, shared=True))
    assert list(differences({"a": 1.1}, ours, shared=True)) == ["a is 1.1; the input produces 1.0"]
    assert len(list(differences({"list": [1.0, 2.1]}, ours, shared=True))) == 1
    assert first_other_word("RTU- 1\n10 .", "RTU-1 10.") == ""
    assert first_other_word("a b 24.0 in", "ab 24.1 in") == '"24.0" where the input produces "24.1"'
    assert first_other_word("24.0 in", "24.0") == '"in" where the input produces nothing'
    assert first_other_word("24.0", "24.0 in") == 'nothing where the input produces "in"'


@pytest.mark.parametrize(
    ("key", "one", "two", "count"),
    [
        ("design_m", 1.0 + 5e-10, 1.0, 0),
        ("design_m", 1.0 + 2e-9, 1.0, 1),
        ("design_m", 5e-15, 0.0, 0),
        ("design_m", 2e-14, 0.0, 1),
        ("error_m", 1.9e-9, 1e-9, 0),
        ("error_m", 2.1e-9, 1e-9, 1),
        ("error_m", -1e-10, 1e-9, 1),
        ("is_ok", True, 1, 1),
        ("name", "A1", "A2", 1),
    ],
)
def test_numbers_are_the_same_to_the_tolerance_and_no_further(key, one, two, count):
    told = list(differences({"runs": [{key: one}]}, {"runs": [{key: two}]}))
    assert len(told) == count
    assert all(text.startswith(f"runs[0].{key} is ") for text in told)


def test_an_object_of_many_keys_is_refused_in_a_time_that_grows_as_their_number():
    def twice(count):
        keys = [f'"k{k}": 1' for k in range(count)]
        return f"{{{', '.join([*keys, keys[-1]])}}}".encode()

    def read(content):
        with pytest.raises(InputError, match=r'the key "k\d+" appears twice'):
            parsed(content, "results.json")

    assert not grows_faster(read, twice, 2_000)
