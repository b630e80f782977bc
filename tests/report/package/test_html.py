"""The pages before their layout."""

import re
from collections import defaultdict
from xml.etree import ElementTree

import pytest

import scenes
from report.package.html import part

pytestmark = pytest.mark.quick

LETTERS, WIDE_PT = 64, 175.0
"""What has room on a line: numbers beside an equation, and an equation beside its numbers."""


def test_numbers_stand_below_an_equation_where_there_is_no_room_beside_it():
    page = ElementTree.fromstring(part(scenes.package(), None, "method", defaultdict(tuple)))
    places = [one for one in page.iter("div") if one.get("class") in ("numbers", "below-line")]
    widths = [
        float(re.match(r"width: ([\d.]+)pt", image.get("style"))[1])
        for image in page.iterfind(".//div[@class='symbols']/img")
    ]
    assert len(places) == len(widths) > 15
    for place, width in zip(places, widths, strict=True):
        rows = ["".join(row.itertext()) for row in place if row.get("class") != "small"]
        is_long = width > WIDE_PT or max(map(len, rows), default=0) > LETTERS
        assert (place.get("class") == "below-line") == is_long, rows
    assert {place.get("class") for place in places} == {"numbers", "below-line"}
