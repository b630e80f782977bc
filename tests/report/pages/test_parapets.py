"""The check of a parapet, with its numbers."""

import stand_in
from report.pages.clearances import clearances
from report.pages.registry import package_data


def notes(height_in):
    objects = [
        stand_in.roof_object(
            "N", "edge with parapet", 0, 220, 170, 171, height=height_in * stand_in.INCH
        )
    ]
    data = stand_in.project(objects=objects, clearances=[stand_in.clearance("A3", "N", 6.0)])
    done = stand_in.assess_input(data, stand_in.motions(3, seconds=8.0))
    return clearances(package_data(done), ())["notes"]


def test_a_parapet_that_qualifies_shows_both_comparisons():
    text = " ".join(notes(30))
    assert "top 30.0 in (762 mm) above the roof, at least 24.0 in (610 mm)†" in text
    assert "30.0 in (762 mm) − 9.0 in (229 mm) = 21.0 in (533 mm), at least 6.0 in" in text
    assert "it qualifies." in text


def test_a_low_parapet_is_an_edge_without_one():
    assert "it does not qualify, an edge without a parapet." in " ".join(notes(20))
