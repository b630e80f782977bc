"""The check of a parapet, with its numbers."""

import pytest

import scenes
import stand_in
from printed import printed


@pytest.mark.parametrize(
    ("height_in", "words"),
    [
        (
            30,
            (
                "top 30.0 in (762 mm) above the roof, at least 24.0 in (610 mm)†",
                "30.0 in (762 mm) − 9.0 in (229 mm) = 21.0 in (533 mm), at least 6.0 in",
                "it qualifies.",
            ),
        ),
        (20, ("it does not qualify, an edge without a parapet.",)),
    ],
)
def test_a_parapet_shows_both_comparisons_and_what_they_make_of_it(height_in, words):
    height_m = height_in * stand_in.INCH
    edge = stand_in.roof_object("N", "edge with parapet", 0, 220, 170, 171, height=height_m)
    gap = stand_in.clearance("A3", "N", 6.0)
    page = printed(scenes.package(objects=[edge], clearances=[gap]), "clearances")
    assert all(word in page.line("Parapet N beside A3") for word in words)
