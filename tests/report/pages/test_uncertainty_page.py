"""Margins and other directions on the page of accuracy, where golden texts have no such state."""

import re
from dataclasses import replace

import pytest

import scenes
import stand_in
from printed import printed
from report.assessment.uncertainty import uncertainty
from report.web.views import MOST_LEVELS, levels


def made(found=None, **changes):
    """A package, what it has of margins, and the page."""
    package = scenes.package(found, **{"options": {"peer_reviewed": True}} | changes)
    done = uncertainty(package.assessment)
    return package, done, printed(package, "accuracy", uncertainty=done)


def test_the_smallest_margin_is_said_with_what_ends_the_search():
    (roomy,) = made(clearances=[stand_in.clearance("A2", "A3", 9.0)])[0].assessment.clearances
    _, found, page = made(clearances=[stand_in.clearance("A2", "A3", 1.3 * roomy.required_m)])
    least = max(found.margins, key=lambda one: one.minimum_mu / one.array.array.mu)
    text = page.line("The smallest margin")
    assert f"{least.array.array.mu:.2f}, may be " in text
    assert f" % less: {least.minimum_mu:.2f}." in text
    shown = {row["Array"]: row for row in page.table("Least friction").rows}
    assert shown[least.array.id]["μ [least]"] == f"{least.minimum_mu:.2f}"
    package, found, _ = made()
    margins = tuple(
        replace(margin, minimum_mu=0.4, required_m=0.1004, limited_by=limited_by)
        for margin, limited_by in zip(
            found.margins, ("clearance", "Friction", "search"), strict=False
        )
    )
    page = printed(package, "accuracy", uncertainty=replace(found, margins=margins))
    rows = page.table("Least friction").rows
    assert {row["Required there [mm]"] for row in rows} == {"101"}
    assert [row["Limited by"] for row in rows] == ["clearance", "friction", "search"]


@pytest.mark.quick
def test_ratios_need_slip_and_levels_are_round():
    still = tuple(replace(motion, scale=1e-3) for motion in scenes.motions(3, 4.0))
    _, _, page = made(still, arrays=[stand_in.array("B1", 0.5, mu=1.0)], objects=[], clearances=[])
    assert "lists no clearances: there is no margin" in page
    assert not re.search(r"\b(nan|inf|None)\b", page)
    line = page.line("PRD used for array B1")
    assert "more angles of the horizontal pair give PRDs up to 0.0 in (0 mm);" in line
    assert "times that PRD" not in line
    assert levels([3.0, 120.0]) == [5, 7, 10, 15, 20, 30, 50, 70, 100]
    for low, high in ((0.1, 3000.0), (1e-4, 1e3), (9.0, 11.0), (5.0, 5.0)):
        found = levels([low, high])
        assert len(found) <= MOST_LEVELS
        assert all(low < value < high for value in found)
