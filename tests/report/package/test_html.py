"""What a second process typesets before the evidence is there, and draws after the pages."""

import pickle
import re
from collections import defaultdict
from xml.etree import ElementTree

import packages
import scenes
from report.assessment.changes import NO_FORMER
from report.assessment.evidence import support
from report.package.html import equations, pages, part, typeset_ahead
from report.pages.pictures import Later
from report.typeset.equations import data_uri, formula

LETTERS, WIDE_PT = 64, 175.0
"""What has room on a line: numbers beside an equation, and an equation beside its numbers."""


def test_every_equation_of_a_package_is_typeset_before_its_evidence_is_there():
    assessment = scenes.package().assessment
    with packages.undrawn():
        typeset = equations(assessment, NO_FORMER)
        ready = {equation.src for equation in typeset.values()}
        html = pages(assessment, support(assessment), NO_FORMER, typeset)
    printed = set(re.findall(r'<div class="symbols"><img src="([^"]+)"', html))
    assert len(printed) > 15
    assert printed == ready


def test_most_equations_are_typeset_before_a_project_is_read():
    formula.cache_clear()
    typeset_ahead()
    ahead = formula.cache_info().misses
    typeset = equations(scenes.package().assessment, NO_FORMER)
    assert formula.cache_info().misses - ahead <= 0.5 * len(typeset)


def test_pictures_that_the_pages_only_name_are_those_that_they_would_show():
    assessment = scenes.package().assessment
    evidence, later = support(assessment), Later()
    html = pages(assessment, evidence, draw=later)
    for name, draw in later.undrawn.items():
        assert html.count(f'"{name}"') == 1
        html = html.replace(f'"{name}"', f'"{data_uri(draw())}"')
    assert len(later.undrawn) > 8
    assert html == pages(assessment, evidence)


def test_nothing_that_a_second_process_is_given_changes_while_its_evidence_is_computed():
    # It is pickled beside that: what it caches meanwhile ended a report, now and then.
    assessment = scenes.package().assessment
    before = pickle.dumps(assessment)
    evidence = support(assessment)
    assert pickle.dumps(assessment) == before
    with packages.undrawn():
        apart = pickle.loads(pickle.dumps((assessment, evidence)))
        assert pages(*apart) == pages(assessment, evidence)


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
