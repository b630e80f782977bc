"""Every page of the package is whole in every state that a project may have."""

import re
from dataclasses import replace
from functools import cache
from xml.etree import ElementTree

import numpy as np
import pytest
from jinja2 import Environment, meta

import packages
import printed
import scenes
import stand_in
from nightly import by_day
from report.assessment.evidence import support
from report.package.html import pages
from report.pages.registry import package_data, pages_of
from report.typeset.pdf import TEMPLATES

ARRAY, GAP, FOOT = stand_in.array, stand_in.clearance, stand_in.FOOT
MOTIONS = scenes.motions(3, seconds=3.0)
LEVEL = tuple(replace(motion, az_mps2=stand_in.NO_RECORD) for motion in MOTIONS)
LIFTING = stand_in.motion("UP", np.zeros(300), np.repeat((0.0, -1.4 * stand_in.G, 0.0), 100))
TWO = {
    "arrays": [ARRAY("A1", 0.5), ARRAY("A2", 0.5, x=220)],
    "objects": [stand_in.roof_object("N", "edge with parapet", 0, 320, 270, 271, height=0.8)],
    "clearances": [GAP("A1", "A2", 120 * FOOT), GAP("A2", "N", 195 * FOOT, "up")],
}
ONE = {"arrays": [ARRAY("A1", 0.5)], "objects": [], "clearances": []}
NARROW = {"clearances": [GAP("A1", "A2", 0.5 * FOOT)]}
OVERRIDE = {"provision": "analysis_factor", "value": 1.0, "reason": "Agreed on 2026-02-11"}
LINKS = stand_in.links("A1", "0.40, 0.45, 0.50", 50)


def of(shaking=MOTIONS, **changes):
    return lambda: scenes.package(shaking, **TWO | changes)


def revised():
    former, now = of()().assessment, of(**NARROW)().assessment
    return package_data(now, scenes.since(former, now))


STATES = {
    "no value": (
        of((*MOTIONS, LIFTING)),
        "governed by: none",
        "An array without a permitted design displacement is NG",
        "Changes that are sufficient, each by itself",
        "no limit the normal force falls below zero, which no model covers none",
        "A1, A2 −0.40 0.996 no limit",  # minimum normal force, time of uplift, demand
    ),
    "NG": (of(**NARROW), ". Marked NG: 2 of 2 arrays, 1 of 1 clearance."),
    "plan check": (
        of(options={"package_edition": "plan check", "letter": False}),
        "A Records, software",
    ),
    "conditions": (
        of(),
        "OK with conditions All limits and clearances are satisfied;",
        "Arrays that are alike remain alike",
    ),
    "one array": (
        of(**ONE),
        "All limits are satisfied; the workbook lists no clearance, and none is checked; ",
        "One ballasted array (A1) was analyzed",
        "The workbook lists no clearances; none is checked.",
    ),
    "one motion": (of(MOTIONS[:1]), "; too few motions)"),
    "no vertical": (of(LEVEL), "there is no vertical component to reverse"),
    "no transverse": (of(scenes.along(MOTIONS)), "No motion has a second horizontal component"),
    "prescriptive": (of(scenes.along(MOTIONS)), "Arrays A1, A2: the prescriptive route is taken"),
    "peer review": (of(options=scenes.REVIEW), "removed by peer review: Reviewer of record"),
    "override": (of(overrides=[OVERRIDE]), "One number of the rule set is overridden"),
    "links": (of(links=[LINKS]), "Adequacy of the rigid-block model"),
    "ground": (lambda: package_data(scenes.unpermitted()), "Motions given at the ground are"),
    "revision": (revised, "Compared with revision 0 of"),
}


@cache
def package(state):
    return STATES[state][0]()


@pytest.mark.parametrize("state", by_day(STATES, 2))
def test_every_page_is_whole(state):
    made = package(state)
    with packages.undrawn():
        html = pages(made.assessment, support(made.assessment), made.changes)
    words = packages.words(html)  # every link leads to a place
    _, *claims = STATES[state]
    assert [claim for claim in claims if claim not in words] == []
    broken = r"\b(nan|inf|None(?! of the |: no slip| \d))\b|\{[{%]|\[\]|\(\)|\w+\.\w+ object at"
    assert [found[0] for found in re.finditer(f".{{0,40}}({broken})", words)] == []

    body = ElementTree.fromstring(html).find("body")
    listed = {one.get("data-no") for one in body.iterfind(".//section[@class='contents']//a")}
    references = re.findall(r"\b(?:part (\d+(?:\.\d+)?)|appendix ([A-Z]))\b", words)
    assert len(references) > 10
    assert {number or letter for number, letter in references} <= listed

    headings = [one for tag in ("h1", "h2", "figcaption") for one in body.iter(tag)]
    assert all("".join(one.itertext()).strip() for one in headings)
    assert all(one.get("alt") for one in body.iter("img"))
    tables = [table for table in printed.read(html).tables if table.headings]
    assert [table.headings for table in tables if not (table.title and table.cells)] == []
    opened = [one.get("id") for one in body.iter("h1")]
    letter = ["letter"] if made.data.options.letter else []
    pages_ = [page.id for page in pages_of(made.edition, made.changes)]
    assert opened == [pages_[0], *letter, *pages_[1:]]


@pytest.mark.quick
def test_every_template_of_the_package_is_rendered_in_some_state():
    ids = {
        *printed.FRONT,
        *(page for state in STATES for page in package(state).numbers),
    }
    reached, left = set(), {"package.html", *(f"{id}.html" for id in ids)}
    while left:
        name = left.pop()
        reached.add(name)
        parsed = Environment().parse((TEMPLATES / name).read_text(encoding="utf-8"))
        left |= {*meta.find_referenced_templates(parsed)} - {None} - reached
    of_other_documents = {"section.html", "study.html", "verification.html"}
    assert reached == {path.name for path in TEMPLATES.glob("*.html")} - of_other_documents
