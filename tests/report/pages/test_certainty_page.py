"""What the page on certainty says is computed again here from the results."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

import scenes
import stand_in
from printed import printed
from report.assessment.certainty import certainty
from report.assessment.remedies import remedies
from report.figures.base import load_fonts
from report.figures.certainty import contours
from report.figures.levels import MOST_LEVELS, levels
from report.typeset.pdf import TEMPLATES

PEER = {"peer_reviewed": True}


def made(found=None, **changes):
    """A package, what it has of certainty, and the page."""
    package = scenes.package(found, **{"options": PEER} | changes)
    done = certainty(package.assessment)
    return package, done, printed(package, "how-sure", certainty=done)


def without_nan(text):
    return not re.search(r"\b(nan|inf|None)\b", text)


@pytest.fixture(scope="module")
def usual():
    return made()


def test_the_page_gives_the_mean_on_the_grid_and_of_the_package(usual):
    package, found, page = usual
    text = page.line(f"Array {package.governing.id} (")
    mean = package.governing.analysis.mean_m / 0.0254
    assert text.count(f"{mean:.1f} in") == 2
    row = int(np.argmin(abs(found.surface.slopes_rad - package.governing.array.slope_rad)))
    column = int(np.argmin(abs(found.surface.mus - package.governing.array.mu)))
    here = found.surface.mean_m[row, column]
    assert f"{found.surface.mean_m[row, column - 1] / here:.2f} times" in text
    assert f"{found.surface.mean_m[row + 1, column] / here:.2f} times" in text


def test_the_angles_are_given_with_their_ratio_wherever_they_are_said(usual):
    package, found, page = usual
    ratios = [run.result.prd_m / found.used_m for run in found.turned]
    text = page.line("PRD used for array")
    assert f"{min(ratios):.2f} to {max(ratios):.2f} times" in text
    assert f"{found.reversed_m / found.used_m:.2f} times" in text
    table = page.table(f"Array {package.governing.id} under motion")
    inches = [f"{run.result.prd_m / 0.0254:.1f}" for run in found.turned]
    assert [*table.row("PRD [in]").values()][1:] == inches
    assert [*table.row("PRD / used").values()][1:] == [f"{ratio:.2f}" for ratio in ratios]
    basis = printed(package, "basis", certainty=found).line("Other orientations")
    assert f"{found.worst.result.prd_m / found.used_m:.2f} times" in basis


def test_the_smallest_margin_is_said():
    (roomy,) = made(clearances=[stand_in.clearance("A2", "A3", 9.0)])[0].assessment.clearances
    _, found, page = made(clearances=[stand_in.clearance("A2", "A3", 1.3 * roomy.required_m)])
    least = max(found.margins, key=lambda one: one.least_mu / one.array.array.mu)
    text = page.line("The smallest margin")
    assert f"{least.array.array.mu:.2f}, may be " in text
    assert f" % less: {least.least_mu:.2f}." in text
    shown = {row["Friction of"]: row for row in page.table("Least friction").rows}
    assert shown[least.array.id]["μ [least]"] == f"{least.least_mu:.2f}"


def test_a_clearance_without_margin_refers_to_what_would_do():
    page = made(clearances=[stand_in.clearance("A2", "A3", 0.05)])[2]
    assert page.line("Clearance 1 is not satisfied as given; part 9")
    assert set(page.table("Least friction").column("μ [least]")) == {"none"}


def test_one_component_and_no_clearance_are_said():
    package, _, page = made(scenes.along(scenes.motions()), clearances=[])
    text = page.line("PRD used for array")
    assert "one horizontal component" in text
    assert "no vertical component" in text
    assert "horizontal pair turned" not in page
    assert "lists no clearances" in page
    assert "one horizontal component" in printed(package, "basis")


def test_where_nothing_slides_there_are_no_contours_and_no_ratios():
    still = tuple(replace(motion, scale=1e-3) for motion in scenes.motions(3, 4.0))
    _, _, page = made(still, arrays=[stand_in.array("B1", 0.5, mu=1.0)], objects=[], clearances=[])
    assert "Nothing slides on the whole grid: no contours are drawn." in page
    assert "Contours of the mean" not in page
    assert without_nan(page)
    assert set([*page.tables[-1].row("PRD / used").values()][1:]) == {"—"}


def test_a_block_that_lifts_off_is_said_without_numbers():
    up, flat = np.zeros(400), np.zeros(400)
    up[100:200] = -1.4 * stand_in.G
    for record in (up, flat):
        record.setflags(write=False)
    lifted = tuple(stand_in.motion(f"L{k}", flat, up, ay=flat, signs=(1,)) for k in range(3))
    package, _, page = made(lifted)
    assert "48 of 48 points have no value" in page
    assert "no displacement" in page.line("PRD used for array")
    assert without_nan(page)
    assert "How to satisfy" in printed(package, "summary")


def test_the_chart_names_arrays_and_levels_and_is_the_same_twice(usual):
    package, found, _ = usual
    load_fonts(TEMPLATES / "fonts")
    arrays = package.assessment.arrays
    svg = contours(found.surface, arrays, us_first=True)
    assert svg == contours(found.surface, arrays, us_first=True)
    assert svg != contours(found.surface, arrays, us_first=False)
    assert all(f">{array.id}<" in svg for array in arrays)
    sizes = [float(size) for size in re.findall(r"font(?:-size)?: ?[^;\"]*?([\d.]+)px", svg)]
    assert sizes
    assert min(sizes) >= 8.5


def test_levels_are_round_inside_the_range_and_few():
    assert levels([3.0, 120.0]) == [5, 7, 10, 15, 20, 30, 50, 70, 100]
    for low, high in ((0.1, 3000.0), (1e-4, 1e3), (9.0, 11.0), (5.0, 5.0)):
        found = levels([low, high])
        assert len(found) <= MOST_LEVELS
        assert all(low < value < high for value in found)


def test_each_ng_says_what_would_do_with_the_values_found():
    (roomy,) = made(clearances=[stand_in.clearance("A2", "A3", 9.0)])[0].assessment.clearances
    gap = stand_in.clearance("A2", "A3", 0.6 * roomy.required_m)
    package = scenes.package(options=PEER, clearances=[gap])
    found = remedies(package.assessment)
    text = printed(package, "summary", remedies=found).line("Clearance 1, A2 to A3, would be")
    for one in found:
        if one.kind.value != "provided separation":
            assert f"{one.value:.2f}" in text
    assert f"{math.ceil(roomy.required_m / 0.0254 * 10 - 1e-6) / 10:.1f} in" in text
    table = printed(package, "clearances", remedies=found).table("How to satisfy")
    assert len(table.cells) == len(found)
    assert table.rows[-1]["Quantity"] == "SDS"


def test_a_floor_that_forbids_is_the_reason_given():
    package = scenes.package(clearances=[stand_in.clearance("A1", "RTU-1", 0.9)])
    text = printed(package, "summary").line("Clearance 1")
    assert "SDS of at most" in text
    assert "No friction coefficient is sufficient: the floor alone" in text
    table = printed(package, "clearances").table("How to satisfy")
    assert any("floor alone" in cell for row in table.cells for cell in row)


def test_without_ng_the_summary_says_nothing_about_it():
    package = scenes.package(options=PEER, clearances=[stand_in.clearance("A2", "A3", 9.0)])
    assert "How to satisfy" not in printed(package, "summary")
    assert "How to satisfy" not in printed(package, "clearances")
