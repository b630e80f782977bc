"""Pictures converted ahead are those that the renderer draws on the page."""

import io
import os
import subprocess
import sys
import tempfile

import pytest
from pypdf import PdfReader

import packages
from report.typeset import drawings, renderer
from report.typeset.drawings import convert
from report.typeset.equations import data_uri, formula
from report.typeset.pdf import TEMPLATES, draw_ahead, lay_out
from solver.model import DefectError

CSS = TEMPLATES / "package.css"
FACES = "".join(
    f'@font-face {{ font-family: "Source Sans 3"; src: url("shipped:/fonts/{name}.ttf"); {look} }}'
    for name, look in (
        ("SourceSans3-Regular", "font-weight: 400"),
        ("SourceSans3-It", "font-weight: 400; font-style: italic"),
        ("SourceSans3-Semibold", "font-weight: 700"),
    )
)


def svg(content):
    return data_uri(
        '<svg xmlns="http://www.w3.org/2000/svg" width="144pt" height="72pt" '
        f'viewBox="0 0 144 72">{content}</svg>'
    )


WORDS = (
    '<g style="fill: #1f4e79"><text x="70" y="30" style="font-size: 9px; '
    "font-family: 'Source Sans 3'; text-anchor: middle; {}\">Array A2</text></g>"
)
CHART = svg(
    '<defs><clipPath id="c"><rect x="5" y="5" width="90" height="50"/></clipPath></defs>'
    '<path d="M 0 0 L 100 50 C 10 20 30 40 50 60" clip-path="url(#c)" '
    'style="fill: none; stroke: #c8651b; stroke-width: 0.6"/>'
    '<path d="M 10 10 h 30 v 20 z" style="fill: #707070; opacity: 0.4"/>' + WORDS.format("")
)
HATCHED = svg(
    '<defs><pattern id="h" width="4" height="4" patternUnits="userSpaceOnUse">'
    '<path d="M 0 0 L 4 4" style="stroke: #1a1a1a"/></pattern></defs>'
    '<rect x="1" y="1" width="90" height="50" fill="url(#h)"/>'
)


GRADED = svg(
    '<defs><linearGradient id="g"><stop offset="0" stop-color="#fff"/>'
    '<stop offset="1" stop-color="#000"/></linearGradient></defs>'
    '<rect x="1" y="1" width="90" height="50" fill="url(#g)"/>'
)
UNKNOWN = svg(WORDS.format("").replace("Array A2", "\U000f1234"))
SIZELESS = data_uri('<svg xmlns="http://www.w3.org/2000/svg"/>')


def page(*pictures, text=""):
    images = "".join(f'<img src="{source}" alt="A picture"/>' for source in pictures)
    return (
        f"<html lang='en-US'><head><title>Pictures</title><style>{FACES}</style></head>"
        f"<body>{images}{text}</body></html>"
    )


def both(html):
    """The page with its pictures drawn ahead, and as the renderer draws them."""
    made = lay_out(html, packages.drawn_ahead(html)), lay_out(html)
    return [PdfReader(io.BytesIO(pdf)).pages[0] for pdf in made]


def blank(kind):
    return kind({}, (0.0, 0.0, 192.0, 96.0), drawings.no_resources(), {}, None, {}, None)


def tree(stream):
    """Return everything that a stream draws, groups included."""
    resources = stream._resources
    groups = {name: tree(group) for name, group in resources["XObject"].items()}
    hatches = {name: (placed(tile), tree(tile)) for name, tile in resources["Pattern"].items()}
    states = {name: dict(state) for name, state in resources["ExtGState"].items()}
    glyphs = {font.hash: (font.to_unicode, font.widths) for font in stream._fonts.values()}
    box = list(stream.extra.get("BBox", ()))
    return b"\n".join(stream.stream), box, groups, hatches, states, glyphs


def placed(tile):
    """Return the steps of a hatch, and where it begins."""
    return tile.extra["XStep"], tile.extra["YStep"], list(tile.extra["Matrix"])


@pytest.mark.parametrize(
    "source",
    [
        pytest.param(CHART, id="a chart"),
        pytest.param(HATCHED, id="a hatch"),
        pytest.param(svg(WORDS.format("font-weight: 700")), id="bold words"),
        pytest.param(svg(WORDS.format("font-style: italic")), id="italic words"),
        pytest.param(data_uri(formula(r"\Delta=\frac{1}{n}\mu").svg), id="a formula"),
    ],
)
def test_operators_groups_hatches_and_glyphs_are_those_of_the_renderer(source):
    from weasyprint.pdf.stream import Stream

    fonts = drawings.fonts_of(CSS)
    data = drawings.svg_of(source)
    size = drawings.size_px(data)
    direct, replayed = blank(Stream), blank(Stream)
    drawings.draw(data, source, fonts, direct, *size)
    picture = convert([source], CSS)[source]
    for face in picture.faces:
        drawings.use(replayed, face, fonts)
    drawings.replay(replayed, picture.drawing)
    assert tree(replayed) == tree(direct)


def test_a_page_shows_the_words_of_its_pictures_in_fonts_that_it_uses_nowhere_else():
    html = page(svg(WORDS.format("font-style: italic")), svg(WORDS.format("font-weight: 700")))
    shown, direct = both(html)
    assert shown.extract_text() == direct.extract_text()
    assert shown.extract_text().count("Array A2") == 2
    names = [
        sorted(
            str(font.get_object()["/BaseFont"]) for font in drawn["/Resources"]["/Font"].values()
        )
        for drawn in (shown, direct)
    ]
    assert names[0] == names[1]
    assert len(names[0]) == 2


def test_a_picture_is_scaled_to_its_place():
    html = page(CHART).replace("<img ", '<img style="width: 100px" ')
    content = both(html)[0].get_contents().get_data()
    assert b"\n0.520833 0 0 0.520833 0 0 cm" in content  # 100 px / 192 px


def test_hatches_lie_where_the_renderer_places_them():
    html = page(CHART, HATCHED, HATCHED).replace("<img ", "<img width='99' ")
    places = [
        [list(tile.get_object()["/Matrix"]) for tile in page["/Resources"]["/Pattern"].values()]
        for page in both(html)
    ]
    assert places[0] == places[1]
    assert len(places[0]) == 2


@pytest.mark.parametrize(
    ("source", "word"), [(GRADED, "shadings"), (UNKNOWN, "notdef"), (SIZELESS, "width")],
    ids=["a gradient", "a glyph that no font has", "no size"],
)  # fmt: skip
def test_a_picture_that_cannot_be_converted_is_an_internal_error(source, word):
    with pytest.raises(DefectError, match=word):
        draw_ahead([source])


def test_pages_are_those_of_the_renderers_own_styles(monkeypatch):
    html = page(
        CHART,
        text="<h1>Roof</h1><p>p <b>b</b> <i>i</i> <sub>s</sub></p><ul><li>one</li></ul><ol><li>1"
        "</li></ol><table><thead><tr><th>a</th></tr></thead><tbody><tr><td>1</td></tr></tbody></table>",
    )
    ours = lay_out(html)
    monkeypatch.setattr(renderer, "TRIED", {"weasyprint": "0.1"})
    assert ours == lay_out(html)


def test_a_laid_out_document_leaves_no_fonts_in_the_temporary_folder(tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    page = f"<html lang='en'><title>t</title><style>{FACES}</style><body>a</body></html>"
    assert lay_out(page).startswith(b"%PDF")
    assert list(tmp_path.iterdir()) == []


def test_a_process_that_drew_pictures_ends_without_a_word_and_leaves_no_fonts(tmp_path):
    program = (
        "import gc, sys; from pathlib import Path; from report.typeset.drawings import fonts_of; "
        "fonts_of(Path(sys.argv[1])); gc.freeze(); gc.disable()"  # as commands do
    )
    done = subprocess.run(
        [sys.executable, "-c", program, str(CSS)],
        env=os.environ | {"TMPDIR": str(tmp_path)},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stderr == ""
    assert list(tmp_path.iterdir()) == []
