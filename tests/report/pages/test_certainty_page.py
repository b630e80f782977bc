import math
import re
from dataclasses import replace
from html import unescape

import numpy as np
import pytest

import stand_in
from report.assessment.certainty import certainty
from report.assessment.evidence import support
from report.assessment.remedies import remedies
from report.figures.base import load_fonts
from report.figures.certainty import contours
from report.figures.levels import MOST_LEVELS, levels
from report.package.html import pages
from report.pages import certainty as page
from report.pages import front
from report.pages import remedies as remedy_page
from report.pages.registry import package_data
from report.typeset.equations import symbol
from report.typeset.pdf import TEMPLATES

PEER = {"peer_reviewed": True}
SHORT = stand_in.motions(3, seconds=8.0)


@pytest.fixture(scope="module", autouse=True)
def fonts():
    load_fonts(TEMPLATES / "fonts")


def made(found=SHORT, **changes):
    data = stand_in.project(**({"options": PEER} | changes))
    return package_data(stand_in.assessed(stand_in.book(data, found)))


def without_nan(text):
    return not re.search(r"\b(nan|inf|None)\b", text)


@pytest.fixture(scope="module")
def usual():
    package = made()
    return package, certainty(package.assessment)


def test_the_page_gives_the_mean_on_the_grid_and_of_the_package(usual):
    package, found = usual
    text = page.page(package, found)["surface"]
    mean = package.governing.analysis.mean_m / 0.0254
    assert text.count(f"{mean:.1f} in") == 2
    assert f"Array {package.governing.id}" in text
    row = int(np.argmin(abs(found.surface.slopes_rad - package.governing.array.slope_rad)))
    column = int(np.argmin(abs(found.surface.mus - package.governing.array.mu)))
    here = found.surface.mean_m[row, column]
    assert f"{found.surface.mean_m[row, column - 1] / here:.2f} times" in text
    assert f"{found.surface.mean_m[row + 1, column] / here:.2f} times" in text


def test_the_angles_are_given_with_their_ratio_and_said_not_to_be_in_the_design(usual):
    package, found = usual
    content = page.page(package, found)
    assert "not part of the design value" in content["angles"]
    ratios = [run.result.prd_m / found.used_m for run in found.turned]
    assert f"{min(ratios):.2f} to {max(ratios):.2f} times" in content["angles"]
    assert f"{found.reversed_m / found.used_m:.2f} times" in content["angles"]
    inches, _, shares = content["turned"].rows
    assert shares.cells[1:] == tuple(f"{ratio:.2f}" for ratio in ratios)
    peaks = tuple(f"{run.result.prd_m / 0.0254:.1f}" for run in found.turned)
    assert inches.cells[1:] == peaks


def test_the_basis_page_says_what_the_angles_give(usual):
    package, found = usual
    text = front.basis(package, found)["angles"]
    assert "not part of the design value" in text
    assert f"{found.worst.result.prd_m / found.used_m:.2f} times" in text
    assert package.part("how-sure") in text


def test_the_smallest_margin_is_said():
    roomy = made(clearances=[stand_in.clearance("A2", "A3", 9.0)])
    required = roomy.assessment.clearances[0].required_m
    package = made(clearances=[stand_in.clearance("A2", "A3", 1.3 * required)])
    found = certainty(package.assessment)
    content = page.page(package, found)
    least = max(found.margins, key=lambda one: one.least_mu / one.array.array.mu)
    assert f"{least.array.array.mu:.2f}, may be " in content["margin"]
    assert f" % less: {least.least_mu:.2f}." in content["margin"]
    shown = {row.cells[3]: row.cells[5] for row in content["margins"].rows}
    assert shown[least.array.id] == f"{least.least_mu:.2f}"


def test_a_clearance_without_margin_refers_to_what_would_do():
    package = made(clearances=[stand_in.clearance("A2", "A3", 0.05)])
    content = page.page(package, certainty(package.assessment))
    assert "Clearance 1 is not satisfied as given" in content["margin"]
    assert package.part("clearances") in content["margin"]
    assert {row.cells[5] for row in content["margins"].rows} == {"none"}


def test_one_component_and_no_clearance_are_said():
    alone = tuple(replace(m, ay_mps2=np.empty(0), az_mps2=np.empty(0)) for m in SHORT)
    package = made(alone, clearances=[])
    found = certainty(package.assessment)
    content = page.page(package, found)
    assert "one horizontal component" in content["angles"]
    assert "no vertical component" in content["angles"]
    assert content["turned"] is None
    assert "lists no clearances" in content["margin"]
    assert "one horizontal component" in front.basis(package, found)["angles"]


def test_where_nothing_slides_there_are_no_contours_and_no_ratios():
    still = tuple(replace(motion, scale=1e-3) for motion in stand_in.motions(3, seconds=4.0))
    package = made(still, arrays=[stand_in.array("B1", 0.5, mu=1.0)], objects=[], clearances=[])
    found = certainty(package.assessment)
    content = page.page(package, found)
    assert page.pictures(package, found.surface) == ()
    assert "Nothing slides" in content["surface"]
    assert without_nan(content["surface"] + content["angles"])
    assert set(content["turned"].rows[-1].cells[1:]) == {"—"}


def test_a_block_that_lifts_off_is_said_without_numbers():
    up = np.zeros(400)
    up[100:200] = -1.4 * stand_in.G
    flat = np.zeros(400)
    for record in (up, flat):
        record.setflags(write=False)
    lifted = tuple(stand_in.motion(f"L{k}", flat, up, ay=flat, signs=(1,)) for k in range(3))
    package = made(lifted)
    found = certainty(package.assessment)
    content = page.page(package, found)
    assert "48 of 48 points have no value" in content["surface"]
    assert "no displacement" in content["angles"]
    assert without_nan(content["surface"] + content["angles"] + content["margin"])
    html = unescape(pages(package.assessment, support(package.assessment)))
    assert "What would do" in html


def test_the_chart_names_arrays_and_levels_and_is_the_same_twice(usual):
    package, found = usual
    (picture,) = page.pictures(package, found.surface)
    assert picture.svg == page.pictures(package, found.surface)[0].svg
    for array in package.assessment.arrays:
        assert f">{array.id}<" in picture.svg
    sizes = [
        float(size) for size in re.findall(r"font(?:-size)?: ?[^;\"]*?([\d.]+)px", picture.svg)
    ]
    assert sizes
    assert min(sizes) >= 8.5
    metric = contours(found.surface, package.assessment.arrays, us_first=False)
    assert metric != picture.svg


def test_levels_are_round_inside_the_range_and_few():
    assert levels([3.0, 120.0]) == [5, 7, 10, 15, 20, 30, 50, 70, 100]
    for low, high in ((0.1, 3000.0), (1e-4, 1e3), (9.0, 11.0), (5.0, 5.0)):
        found = levels([low, high])
        assert len(found) <= MOST_LEVELS
        assert all(low < value < high for value in found)


def answers(package):
    found = remedies(package.assessment)
    return found, remedy_page.sentences(package, found), remedy_page.table(package, found)


def test_each_ng_says_what_would_do_with_the_values_found():
    roomy = made(clearances=[stand_in.clearance("A2", "A3", 9.0)])
    required = roomy.assessment.clearances[0].required_m
    package = made(clearances=[stand_in.clearance("A2", "A3", 0.6 * required)])
    found, texts, table = answers(package)
    assert texts[0].startswith("Clearance 1, A2 to A3, would be satisfied with μ of at least")
    for one in found:
        if one.kind.value != "provided separation":
            assert f"{one.value:.2f}" in texts[0]
    inches = math.ceil(required / 0.0254 * 10 - 1e-6) / 10
    assert f"{inches:.1f} in" in texts[0]
    assert any(text.endswith("seismic design category D.") for text in texts)
    for text in (*texts, *table.notes, table.rows[-1].cells[1]):
        assert "S_DS" not in text
    assert table.rows[-1].cells[1] == symbol("S_DS")
    assert len(table.rows) == len(found)
    summary = front.summary(package, found, ())
    assert summary["answers"] == texts


def test_a_floor_that_forbids_is_the_reason_given():
    package = made(options={}, clearances=[stand_in.clearance("A1", "RTU-1", 0.9)])
    _, texts, table = answers(package)
    assert "No friction coefficient would do: the floor alone" in texts[0]
    assert f"{symbol('S_DS')} of at most" in texts[0]
    assert any("floor alone" in str(row.cells[-1]) for row in table.rows)


def test_without_ng_the_summary_says_nothing_about_it():
    package = made(clearances=[stand_in.clearance("A2", "A3", 9.0)])
    html = unescape(pages(package.assessment, support(package.assessment)))
    assert "What would do" not in html
    assert '<h1 id="how-sure">' in html
