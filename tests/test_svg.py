"""The SVG of a figure says where things are, in points with y down the page, and nothing twice."""

from xml.etree import ElementTree

import pytest
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle

from report.figures.base import load_fonts, style
from report.figures.svg import svg_text
from report.pdf import TEMPLATES

NAMES = "{http://www.w3.org/2000/svg}"


@pytest.fixture(autouse=True)
def styled():
    load_fonts(TEMPLATES / "fonts")
    with style():
        yield


def sheet():
    """A figure of 2 in by 1 in whose axes count points from the lower left corner."""
    figure = Figure(figsize=(2.0, 1.0), frameon=False)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(0.0, 144.0), ylim=(0.0, 72.0))
    axes.set_axis_off()
    return figure, axes


def elements(figure, tag):
    return list(ElementTree.fromstring(svg_text(figure)).iter(NAMES + tag))


def test_a_line_is_a_path_in_points_from_the_top():
    figure, axes = sheet()
    axes.plot([10.0, 20.0, 20.0], [12.0, 12.0, 32.0], color="#123456", linewidth=1.5)
    (path,) = elements(figure, "path")
    assert path.attrib["d"] == "M10.00 60.00L20.00 60.00L20.00 40.00"
    assert (path.attrib["stroke"], path.attrib["stroke-width"]) == ("#123456", "1.5")
    assert path.attrib["fill"] == "none"


def test_a_gap_in_a_line_is_a_new_piece():
    figure, axes = sheet()
    axes.plot([10.0, 20.0, float("nan"), 30.0, 40.0], [12.0] * 5)
    (path,) = elements(figure, "path")
    assert path.attrib["d"] == "M10.00 60.00L20.00 60.00M30.00 60.00L40.00 60.00"


def test_dashes_and_transparency_are_written():
    figure, axes = sheet()
    line = Line2D([1, 2], [1, 2], linestyle=(1.0, (4.0, 2.0)), linewidth=2.0, color=(0, 0, 0, 0.5))
    axes.add_line(line)
    (path,) = elements(figure, "path")
    assert path.attrib["stroke-dasharray"] == "8 4"
    assert path.attrib["stroke-dashoffset"] == "2"
    assert path.attrib["stroke-opacity"] == "0.5"


def test_all_markers_of_a_line_are_one_path():
    figure, axes = sheet()
    axes.plot([10.0, 20.0, 30.0], [12.0] * 3, linestyle="", marker="s", markersize=4)
    (path,) = elements(figure, "path")
    assert path.attrib["d"].count("M") == path.attrib["d"].count("Z") == 3


def test_only_what_reaches_outside_is_cut_off():
    figure, axes = sheet()
    axes.add_patch(Rectangle((0.0, 0.0), 144.0, 10.0))
    axes.add_patch(Rectangle((10.0, 10.0), 500.0, 10.0))
    axes.add_patch(Rectangle((10.0, 30.0), 500.0, 10.0))
    within, *outside = [p for p in elements(figure, "path") if "fill" in p.attrib]
    assert "clip-path" not in within.attrib
    assert [p.attrib["clip-path"] for p in outside] == ["url(#d1)", "url(#d1)"]
    (cut,) = elements(figure, "clipPath")
    assert cut.attrib["id"] == "d1"
    assert cut[0].attrib["d"] == "M0.00 72.00L144.00 72.00L144.00 0.00L0.00 0.00Z"


def test_a_hatch_rises_as_it_is_asked_to_and_is_defined_once():
    figure, axes = sheet()
    for x in (10.0, 60.0):
        axes.add_patch(Rectangle((x, 10.0), 40.0, 40.0, facecolor="white", hatch="/"))
    (pattern,) = elements(figure, "pattern")
    shapes = [p for p in elements(figure, "path") if "url" in p.attrib.get("fill", "")]
    assert {p.attrib["fill"] for p in shapes} == {f"url(#{pattern.attrib['id']})"}
    ground, lines = pattern
    assert ground.attrib["fill"] == "#ffffff"
    begin, end = (part.split() for part in lines.attrib["d"].lstrip("M").split("M")[0].split("L"))
    assert (float(end[0]) - float(begin[0])) * (float(end[1]) - float(begin[1])) < 0.0


def test_words_stay_words_at_their_left_end():
    figure, axes = sheet()
    axes.text(20.0, 22.0, "a < b & c", fontsize=10.0, weight="semibold")
    axes.text(144.0, 22.0, "end", ha="right")
    axes.text(72.0, 36.0, "up", rotation=90.0)
    start, end, up = elements(figure, "text")
    assert (start.text, start.attrib["x"], start.attrib["y"]) == ("a < b & c", "20.00", "50.00")
    assert (start.attrib["font-size"], start.attrib["font-weight"]) == ("10", "600")
    assert 125.0 < float(end.attrib["x"]) < 135.0
    assert up.attrib["transform"].startswith("rotate(-90 ")


def test_two_figures_alike_give_the_same_text():
    def drawn():
        figure, axes = sheet()
        axes.plot([1.0, 2.0], [3.0, 4.0])
        return svg_text(figure)

    assert drawn() == drawn()
