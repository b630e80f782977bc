"""Every page is whole in every state of a project; echo, provisions and symbols."""

import re
from dataclasses import replace
from functools import cache
from xml.etree import ElementTree

import numpy as np
import pytest
from jinja2 import Environment, meta

from fixtures import assessments, packages, project_parts, projects
from fixtures.marks import by_day
from fixtures.pages import FRONT, page_of, read
from report.assessment.revision_changes import NO_FORMER, Change, ChangeKind
from report.package.html import pages
from report.pages.registry import package_data, pages_of
from report.project.read.workbook_data import EchoRow
from report.typeset.pdf import TEMPLATES

ARRAY, GAP, FOOT = projects.array, projects.clearance, projects.FOOT
MOTIONS = assessments.motions(3, seconds=3.0)
LEVEL = tuple(replace(motion, az_mps2=projects.NO_RECORD) for motion in MOTIONS)
LIFTING = projects.motion("UP", np.zeros(300), np.repeat((0.0, -1.4 * projects.G, 0.0), 100))
TWO = {
    "arrays": [ARRAY("A1", 0.5), ARRAY("A2", 0.5, x=220)],
    "objects": [projects.roof_object("N", "edge with parapet", 0, 320, 270, 271, height=0.8)],
    "clearances": [GAP("A1", "A2", 120 * FOOT), GAP("A2", "N", 195 * FOOT, "upslope")],
}
ONE = {"arrays": [ARRAY("A1", 0.5)], "objects": [], "clearances": []}
NARROW = {"clearances": [GAP("A1", "A2", 0.5 * FOOT)]}
OVERRIDE = {"provision": "analysis_factor", "value": 1.0, "reason": "Agreed on 2026-02-11"}
LINKS = projects.links("A1", "0.40, 0.45, 0.50", 50)


def of(shaking=MOTIONS, **changes):
    return lambda: assessments.package(shaking, **TWO | changes)


def revised():
    former, now = of()().assessment, of(**NARROW)().assessment
    return package_data(now, assessments.since(former, now))


STATES = {
    "no value": (
        of((*MOTIONS, LIFTING)),
        "governed by: none",
        "An array without a permitted design displacement is NG",
        "Changes that would satisfy NG items",
        "no limit the normal force falls below zero, which no model covers none",
        "A1, A2 −0.40 0.996 no limit",  # minimum normal force, time of uplift, demand
    ),
    "NG": (of(**NARROW), " checks is not satisfied: clearance A1 to A2 (D/C "),
    "plan check": (
        of(options={"package_edition": "plan check", "letter": False}),
        "A Records, software",
    ),
    "conditions": (
        of(),
        "OK with conditions No check is NG.",
        "Arrays of similar construction remain so",
    ),
    "one array": (
        of(**ONE),
        "No clearance is entered, so none is checked.",
        "One ballasted array (A1) was analyzed",
    ),
    "one motion": (of(MOTIONS[:1]), "number of motions (1, at least 3†)"),
    "no vertical": (of(LEVEL), "there is no vertical component to reverse"),
    "no transverse": (
        of(assessments.along(MOTIONS)),
        "No motion has a second horizontal component",
    ),
    "prescriptive": (
        of(assessments.along(MOTIONS)),
        "Arrays A1, A2: the prescriptive procedure is used",
    ),
    "peer review": (
        of(options=assessments.REVIEW),
        "Analysis peer reviewed by Reviewer of record",
    ),
    "override": (of(overrides=[OVERRIDE]), "One value of the rule set is overridden"),
    "links": (of(links=[LINKS]), "Adequacy of the rigid-block model"),
    "ground": (
        lambda: package_data(assessments.unpermitted()),
        "Ground motions are transferred to the roof",
    ),
    "revision": (revised, "Compared with revision 0 of"),
}


@cache
def package(state):
    return STATES[state][0]()


@pytest.mark.parametrize("state", by_day(STATES, 1))
def test_every_page_is_whole(state):
    made = package(state)
    with packages.undrawn():
        html = pages(made.assessment, assessments.evidence(made.assessment), made.changes)
    words = packages.words(html)  # every link leads to a place
    _, *claims = STATES[state]
    assert [claim for claim in claims if claim not in words] == []
    broken = r"\b(nan|inf|None(?! of the |: no slip| \d))\b|\{[{%]|\[\]|\(\)|\w+\.\w+ object at"
    assert [found[0] for found in re.finditer(f".{{0,40}}({broken})", words)] == []

    body = ElementTree.fromstring(html).find("body")
    listed = {one.get("data-no") for one in body.iterfind(".//section[@class='contents']//a")}
    references = re.findall(r"\b(?:Section (\d+(?:\.\d+)?)|Appendix ([A-Z]))\b", words)
    assert len(references) > 10
    assert {number or letter for number, letter in references} <= listed

    headings = [one for tag in ("h1", "h2", "figcaption") for one in body.iter(tag)]
    assert all("".join(one.itertext()).strip() for one in headings)
    assert all(one.get("alt") for one in body.iter("img"))
    tables = [table for table in read(html).tables if table.headings]
    assert [table.headings for table in tables if not (table.title and table.cells)] == []
    opened = [one.get("id") for one in body.iter("h1")]
    letter = ["letter"] if made.data.options.letter else []
    pages_ = [page.id for page in pages_of(made.edition, made.changes)]
    assert opened == [pages_[0], *letter, *pages_[1:]]


@pytest.mark.quick
def test_every_template_of_the_package_is_rendered_in_some_state():
    ids = {*FRONT, *(page for state in STATES for page in package(state).numbers)}
    reached, left = set(), {"package.html", "page.html", *(f"{id}.html" for id in ids)}
    while left:
        name = left.pop()
        reached.add(name)
        parsed = Environment().parse((TEMPLATES / name).read_text(encoding="utf-8"))
        left |= {*meta.find_referenced_templates(parsed)} - {None} - reached
    of_other_documents = {
        "page-file.html",
        "permit.html",
        "permit-plan.html",
        "section.html",
        "study.html",
        "verification.html",
    }
    assert reached == {path.name for path in TEMPLATES.glob("*.html")} - of_other_documents


def row(cell, label, typed="", value="", unit="", unseen=""):
    return EchoRow(
        sheet="S", cell=cell, label=label, typed=typed, unit=unit, value=value or typed or "—",
        unseen=unseen,
    )  # fmt: skip


def echo(*rows, changed=()):
    """The page of an echo, where cells at some addresses changed."""
    done = assessments.package().assessment
    done = replace(done, source=replace(done.source, echo=rows))
    items = (
        Change(kind=ChangeKind.INPUT, title="", before="", now="", cell=cell) for cell in changed
    )
    since = replace(NO_FORMER, revision="0", items=tuple(items))
    return page_of(package_data(done, since), "echo")


def table(*rows, **changed):
    (made,) = echo(*rows, **changed).tables
    assert made.title == "S"
    return made


IDS = row("B8", "ID", "A1"), row("B9", "ID", "A2")
ALIKE = (IDS[0], row("C8", "Slack", "60", "1.524 m", "in"),
         IDS[1], row("C9", "Slack", "60", "1.524 m", "in"))  # fmt: skip


@pytest.mark.parametrize(
    ("rows", "cells", "notes"),
    [
        pytest.param(
            (row("B5", "S_S", "1.9575", "1.9575 g", "g"), row("B6", "S_1", "0.7", "0.7 g", "g"),
             row("B7", "Site class", "C"), row("B8", "Checked by"),
             row("B9", "Hazard basis", value="mapped values (default)")),
            [("B5", "S_S", "1.9575 g", "B7", "Site class", "C"),
             ("B6", "S_1", "0.7 g", "", "", "")],
            ("Left blank: B8 Checked by; B9 Hazard basis = mapped values.",),
            id="single cells stand in two columns with their units, and those left blank in a note",
        ),
        pytest.param(
            (row("B5", "S_S", "1.5", "1.5 g", "g", unseen="hidden"),
             row("B6", "S_1", "=B5/2 → 0.75", "0.75 g", "g", unseen="hidden, struck through")),
            [("B5", "S_S", "1.5 g (hidden)",
              "B6", "S_1", "=B5/2 → 0.75 g: 0.75 g (hidden, struck through)")],
            (),
            id="a cell that the workbook does not show is marked with how",
        ),
        pytest.param(
            (*ALIKE[:2], *(replace(one, unseen="filtered out") for one in ALIKE[2:])),
            [("8", "A1", "60"), ("9", "A2 (filtered out)", "60 (filtered out)")],
            (),
            id="a column of which one cell is hidden is printed row by row",
        ),
        pytest.param(
            (IDS[0], row("C8", "Baseline", "linear"),
             IDS[1], row("C9", "Baseline", value="none (default)")),
            [("8", "A1", "linear"), ("9", "A2", "none (default)")],
            (),
            id="a column blank in some rows shows the default there",
        ),
    ],
)  # fmt: skip
def test_cells_are_printed_as_they_were_entered(rows, cells, notes):
    made = table(*rows)
    assert [*made.cells] == cells
    assert made.notes == notes


@pytest.mark.quick
def test_changed_cells_stay_in_their_rows_and_are_bold():
    made = table(*ALIKE, changed={"S!C9"})
    assert made.headings == ("Row", "B ID", "C Slack [in]")
    assert [*made.cells] == [("8", "A1", "60"), ("9", "A2", "60")]
    assert (made.kinds, made.bold) == (("", "changed"), ("60",))
    blank = (row("B7", "B7", value="3 (default)"), row("B8", "B8"))
    made = table(row("B5", "B5", "1", "1"), row("B6", "B6", "2", "2"), *blank,
                 changed={"S!B6", "S!B7", "T!B5"})  # fmt: skip
    assert [*made.cells] == [
        ("B5", "B5", "1", "B7", "B7", "3 (default)"), ("B6", "B6", "2", "", "", ""),
    ]  # fmt: skip
    assert (made.kinds, made.bold) == (("changed", "changed"), ("3 (default)", "2"))
    assert made.notes == ("Left blank: B8 B8.",)
    cells = (row("B8", "B", "a"), row("C8", "C", "<i>"), row("B9", "B", "b"), row("C9", "C", "d"))
    made = table(*cells, changed={"S!C8"})
    assert (made.kinds, made.bold) == (("changed", ""), ("<i>",))


@pytest.mark.quick
def test_every_cell_of_a_wide_table_is_printed_beside_its_name():
    letters = "BCDEFGHIJKLM"
    rows = [
        row(f"{letter}{number}", f"{letter} of some length", f"{letter}-entry-{number}", "x")
        for number in range(8, 19)
        for letter in letters
    ]
    tables = echo(*rows).tables
    printed_cells = {cell for made in tables for line in made.cells for cell in line}
    assert {echoed.typed for echoed in rows} <= printed_cells
    assert len(tables) > 1
    assert {made.headings[1] for made in tables} == {"B B of some length"}


FLOOR = {"provision": "analysis_floor", "value": 0.6, "reason": "Agreed on 2026-02-11"}
PAGES = ("comparison", "cover", "limits", "method", "motions", "provisions", "summary")


def values(page):
    """The numbers of the rule set as printed, in both halves of their table."""
    halves = [table for table in page.tables if table.title.startswith("Values from SEAOC")]
    assert len(halves) == 2
    return [value for half in halves for value in half.column("Value")]


@pytest.fixture(scope="module", params=[False, True], ids=["as usual", "confirmed"])
def shown(request):
    """The pages with marks, and whether the provisions are confirmed."""
    done = assessments.package(**assessments.CONFIRMED if request.param else {}).assessment
    return {page: page_of(done, page) for page in PAGES}, request.param


def test_confirmed_provisions_have_no_mark_and_are_said_by_whom(shown):
    shown, is_confirmed = shown
    for page, text in shown.items():
        if page == "motions":  # limits of AC156, which no confirmation of a rule set covers
            assert "≥ 3†" in text
        elif page not in ("provisions", "cover"):
            # Nor those of the fire code and of the existing-building code.
            others = "fire pathway", "motions for analysis", "Existing building"
            lines = [line for line in text.splitlines() if not any(of in line for of in others)]
            assert ("†" in "".join(lines)) is not is_confirmed, page
    marks = {value[-1] == "†" for value in values(shown["provisions"])}
    assert marks == ({False} if is_confirmed else {False, True})
    by = "SEAOC PV1-2012, confirmed by RG, SE, 2026-03-01"
    verify = "SEAOC PV1-2012, to be verified against the adopted code"
    assert f"Rule set: {by if is_confirmed else verify}." in shown["summary"]
    said = (
        "the values and section numbers of SEAOC PV1-2012, ASCE 7-16, 2022 CBC were compared with"
    )
    assert (f"Confirmed by RG, SE, 2026-03-01: {said}" in shown["provisions"]) is is_confirmed
    assert ("Section numbers are as commonly cited" in shown["provisions"]) is not is_confirmed
    verify, by = "† Verify against the adopted code.", "Confirmed by RG, SE except for †"
    assert (by in shown["cover"], verify in shown["cover"]) == (is_confirmed, not is_confirmed)


def test_an_override_stays_marked():
    done = assessments.package(**assessments.CONFIRMED, overrides=[FLOOR]).assessment
    marked = {value for value in values(page_of(done, "provisions")) if value[-1] in "†‡"}
    assert marked == {"0.6†‡"}


@pytest.mark.parametrize(
    ("edition", "own", "others"),
    [
        ("ASCE 7-16", {"ap", "Rp", "Fa", "Fv"}, {"CAR", "Rpo"}),
        ("ASCE 7-22", {"CAR", "Rpo"}, {"ap", "Rp", "Fa", "Fv"}),
    ],
)
def test_the_symbols_are_those_of_the_edition(edition, own, others):
    table = page_of(
        assessments.package(site=project_parts.SITE | {"edition_name": edition}), "symbols"
    ).table("Symbols")
    listed = {cell.replace(" ", "").replace("_", "") for row in table.cells for cell in row}
    assert own <= listed
    assert not others & listed


def test_the_symbols_of_the_approximate_period_are_listed():
    data = projects.project(
        motions=[{"id": "M1", "record": "x", "recorded_at": "ground"}],
        building={"structure": "other"},
        spectrum=[],
    )
    done = projects.assessed(assessments.grounded(data, assessments.motions(1)))
    assert "12.8.2.1, structure type “other”: Ct" in page_of(done, "motions").replace(" t h", "t h")
    listed = {cell for row in page_of(done, "symbols").table("Symbols").cells for cell in row}
    assert {"Ct", "x"} <= listed
