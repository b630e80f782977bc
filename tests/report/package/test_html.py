"""What a second process draws and typesets before the evidence is there."""

import pickle
import re
from collections import defaultdict
from xml.etree import ElementTree

import packages
import scenes
from report.assessment.changes import NO_FORMER
from report.assessment.evidence import support
from report.package.html import begin, pages, part
from report.workers import SameProcess

LETTERS, WIDE_PT = 64, 175.0
"""What has room on a line: numbers beside an equation, and an equation beside its numbers."""


def test_every_equation_of_a_package_is_typeset_before_its_evidence_is_there():
    assessment = scenes.package().assessment
    with packages.undrawn():
        begun = begin(assessment, NO_FORMER, SameProcess())
        ready = {equation.src for equation in begun.equations.result().values()}
        evidence = support(assessment)
        html = pages(assessment, evidence, NO_FORMER, begun.plot(evidence))
    printed = set(re.findall(r'<div class="symbols"><img src="([^"]+)"', html))
    assert len(printed) > 15
    assert printed == ready


class Apart(SameProcess):
    """Runs each function on copies, as a second process does."""

    def submit(self, fn, /, *given):
        return super().submit(fn, *pickle.loads(pickle.dumps(given)))


def test_nothing_that_a_second_process_is_given_changes_while_the_pages_are_made():
    # It is pickled beside them: what it caches meanwhile ended a report, now and then.
    assessment = scenes.package().assessment
    with packages.undrawn():
        begun = begin(assessment, NO_FORMER, Apart())
        before = pickle.dumps(begun.package)
        evidence = support(assessment)
        pages(assessment, evidence, NO_FORMER, begun.plot(evidence))
    assert pickle.dumps(begun.package) == before


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
