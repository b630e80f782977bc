"""Cover, letter, references, symbols and notes say what the project at hand has."""

import datetime as dt
import io
import math
import re
from dataclasses import replace
from html import unescape

import pytest
from pypdf import PdfReader

from fixtures import assessments, packages, project_parts, projects
from fixtures.pages import page_of
from report.assessment.design.verdict import Verdict
from report.pages.symbols import SYMBOLS
from report.typeset.pdf import lay_out
from solver.rules.limit import Consequence

pytestmark = pytest.mark.quick


MOTIONS = assessments.motions(3, seconds=4.0)


def with_open(done, rows):
    """The assessment with these checks open alone."""
    met = (replace(check, is_satisfied=True) for check in done.checks)
    other = replace(done)
    object.__setattr__(other, "checks", (*met, *rows))
    return other


def plain(text):
    return " ".join(unescape(re.sub(r"<[^>]+>", "", str(text))).split())


@pytest.fixture(scope="module")
def html():
    tests = {"standard": "ASTM G115-10", "laboratory": "L", "report": "R"}
    data = projects.project(friction_tests=tests)
    with packages.undrawn():
        return projects.html(projects.book(data, MOTIONS))


def test_the_records_say_that_large_files_are_left_out():
    done = assessments.package().assessment
    large = tuple(replace(file, size=9_000_000) for file in done.shaking.records)
    given = replace(done, shaking=replace(done.shaking, records=large))
    line = page_of(given, "records").line("Embedded in this PDF")
    assert "; not the nine record files, 81.0 MB in total; results.json. Issued separately" in line
    assert "verify-package FILE --records FOLDER" in line
    assert line.endswith(f"{assessments.package().fingerprint}.")
    line = page_of(done, "records").line("Embedded in this PDF")
    assert "; nine record files; results.json. Issued separately" in line
    assert "verify-package FILE, which regenerates" in line


@pytest.mark.nightly
@pytest.mark.parametrize("n_arrays", [1, 12])
def test_the_letter_is_one_page(n_arrays):
    """Only the letter and the parts around it are laid out."""
    arrays = [projects.array(f"A{k}", 0.5, x=90 * k) for k in range(n_arrays)]
    data = projects.project(arrays=arrays, objects=[], clearances=[])
    with packages.undrawn():
        html = projects.html(projects.book(data, MOTIONS[:1]))
    head, *_ = html.partition("<section")
    _, *parts = re.split(r'(?=<section class="[^"]*\bstarts\b)', html)
    (at,) = (k for k, part in enumerate(parts) if '<h1 id="letter">' in part)
    near = re.sub(r' href="#[^"]*"', "", head + parts[at])  # and the parts that follow it
    near, *_ = near.partition("</body>")
    pdf = lay_out(f"{near}</body></html>")
    texts = [page.extract_text() for page in PdfReader(io.BytesIO(pdf)).pages]
    assert "Results letter" in texts[0]
    assert "License expires" in texts[0]
    assert "2 Comparison with" not in texts[0]
    assert "2 Comparison with" in texts[1]


@pytest.mark.parametrize(
    ("n_conditions", "n_severe", "text"),
    [
        (9, 0, "Nine requirements are open; the summary (Section 1) lists them as conditions."),
        (1, 0, "One requirement is open; the summary (Section 1) lists it as a condition."),
        (0, 1, "One requirement is open; the summary (Section 1) lists it as NG."),
        (0, 2, "Two requirements are open; the summary (Section 1) lists them as NG."),
        (9, 1, "10 requirements are open; the summary (Section 1) lists one as NG and nine "
         "conditions."),
    ],
)  # fmt: skip
def test_the_letter_says_where_open_requirements_are_listed(n_conditions, n_severe, text):
    done = assessments.package().assessment
    row = next(check for check in done.checks if check.id == "roof_outline")
    assert row.verdict is Verdict.CONDITION
    severe = replace(row, consequence=Consequence.NG)
    every = (row,) * n_conditions + (severe,) * n_severe
    rows = tuple(replace(one, title=str(k)) for k, one in enumerate(every))
    assert page_of(with_open(done, rows), "letter").line(text)


def test_what_is_said_of_several_arrays_counts_once_wherever_conditions_are_counted():
    done = assessments.package().assessment
    row = next(check for check in done.checks if check.id == "roof_outline")
    rows = tuple(replace(row, subject=item.id) for item in done.arrays)
    alike = with_open(done, rows)
    assert len([check for check in alike.checks if check.is_open]) > 1
    assert "One requirement is open" in page_of(alike, "letter")
    assert "One open condition in Section 1 shall be closed first." in page_of(alike, "notes")


def test_every_document_is_listed_exactly_where_it_is_cited(html):
    body = html[html.index("<body>") :]
    start = body.index('<p class="references">References')
    before, listed = plain(body[:start]), plain(body[start:])
    for name in ("PV1-2012", "ASCE 7-16", "IBC 1613.3", "AC156", "Housner", "Ishiyama", "G115-10"):
        assert name in before, name
        assert name in listed, name
    for name in ("ASCE 7-22", "Constantinou"):
        assert name not in before, name
        assert name not in listed, name


@pytest.mark.quick
@pytest.mark.parametrize(
    ("code", "clause", "name"),
    [({}, "IBC 1613.3", "International Building Code, 2018 or 2021."),
     ({"building_code": "CBC", "building_code_year": 2022}, "CBC 1613.3, 2022",
      "California Building Code."),
     ({"building_code": "IBC", "building_code_year": 2021}, "IBC 1613.3, 2021",
      "International Building Code.")],
)  # fmt: skip
def test_the_slope_limit_of_the_code_is_cited_by_the_code_that_is_named(code, clause, name):
    made = assessments.package(site=projects.site(**code))
    assert f"{clause}: {name}" in page_of(made, "records")
    assert f"; {clause}; AC156" in page_of(made, "cover").facts["Codes"]
    rows = page_of(made, "limits").table("All checks").rows
    assert f"{clause}†" in [row["Code section"] for row in rows]
    assert "due to Seismic Motion, manuscript that names no authors" in page_of(made, "records")


@pytest.mark.quick
def test_the_head_has_firm_license_place_and_drawing_where_they_are_given():
    given = {"firm": "Example Engineers", "firm_contact": "500 Main St; 213 555 0100",
             "license": "CA S0000", "plan_number": "S-101",
             "plan_date": dt.date(2026, 2, 27)}  # fmt: skip
    place = {"latitude_deg": 34.0362, "longitude_deg": -118.2334}
    made = assessments.package(project=project_parts.HEAD | given, site=projects.site(**place))
    head = page_of(made, "cover")
    assert head.facts["Lat., long."] == "34.0362°, −118.2334°"
    assert head.facts["Drawing"] == "S-101, 2026-02-27"
    assert head.facts["Firm"] == "Example Engineers, 500 Main St; 213 555 0100"
    assert "License no. CA S0000" in head
    assert "CA S0000 License no., state" in " ".join(page_of(made, "letter").split())
    bare = page_of(assessments.package(), "cover").facts
    assert not {"Lat., long.", "Drawing", "Firm"} & bare.keys()
    assert "structural observation" in page_of(made, "notes")


def test_contact_pressures_stand_beside_each_other_and_are_not_compared():
    arrays = [projects.array("A1", 0.5, contact_pressure_pa=4788.0), ARRAYS[1]]
    tests = assessments.TESTS | {"contact_pressure_pa": 7182.0}
    said = page_of(package(arrays=arrays, friction_tests=tests), "inputs").line("Contact pressure")
    assert said == (
        "Contact pressure (not compared by any rule): 150.0 psf (7.18 kPa) in the tests; supports"
        " of array A1 100.0 psf (4.79 kPa), array A2 not entered."
    )
    assert "Contact pressure" not in page_of(package(), "inputs")


def test_every_symbol_is_in_the_list_and_none_printed_as_typed(html):
    used = set(re.findall(r"<i>([^<]+)</i><sub>([^<]+)</sub>", html[: html.index('id="symbols"')]))
    missing = {f"{stem}_{below}" for stem, below in used} - SYMBOLS.keys()
    assert missing - {"F_p/W_p"} == set()
    # The input echo prints headings of the workbook.
    body = html[html.index("<body>") : html.index('id="echo"')]
    typed = [name for name in SYMBOLS if "_" in name and name.isascii()]
    assert "S_DS" in typed
    found = re.findall(rf"\b(?:{'|'.join(typed)})\b", re.sub(r"<[^>]+>", "", body))
    assert found == []
    images = re.findall(r'<div class="symbols"><img src="[^"]*" alt="([^"]*)"', html)
    assert len(images) > 15
    found = set().union(*(symbols(unescape(latex)) for latex in images))
    assert {"k", "k_a", "k_f", "k_p", "c_1", "Δ_MPV"} <= found
    assert found - SYMBOLS.keys() - {"i", "d", "dt"} == set()  # indices


GREEK = {r"\Delta": "Δ", r"\theta": "θ", r"\mu": "μ", r"\phi": "φ"}
_WORDS = re.compile(r"\\mathrm\{(?!PRD)[^}]*\}|\\(?!Delta|theta|mu\b|phi)[A-Za-z]+|[{}]")


def symbols(latex):
    """Return the symbols of an equation, with their first subscript."""
    rest = re.sub(r"\\mathrm\{PRD\}(_i)?|\\sum_\{[^}]*\}\^\{[^}]*\}|_i\b", " ", latex)
    for name, sign in GREEK.items():
        rest = rest.replace(name, sign)
    rest = _WORDS.sub(" ", re.sub(r"_\{([^{}]*)\}", r"_\1 ", rest))
    names = re.findall(r"[A-Za-zΔθμφ](?:_[A-Za-z0-9]+)?", rest)
    return set(names) - {"e"}  # of the exponential


FOOT = projects.FOOT
ARRAYS = [projects.array("A1", 0.5), projects.array("A2", 0.5, x=220)]
GAPS = [projects.clearance("A1", "A2", 120 * FOOT)]


def package(**changes):
    return assessments.package(**{"arrays": ARRAYS, "objects": [], "clearances": GAPS} | changes)


def notes(**changes):
    return page_of(package(**changes), "notes")


def test_the_schedule_of_gaps_is_rounded_up():
    near = projects.roof_object("RTU-9", "fixed object", 101, 106, 35, 42)
    rows = [*GAPS, projects.clearance("A1", "RTU-9", FOOT)]
    made = package(objects=[near], clearances=rows, options=project_parts.REVIEW)
    table = page_of(made, "notes").table("Clearance schedule")
    least = [math.ceil(gap.required_m * 1e3) for gap in made.assessment.clearances]
    assert [(row["To"], row["Minimum [mm]"], row["Measured, date, by"]) for row in table.rows] == [
        ("A2", str(least[0]), ""), ("RTU-9", str(least[1]), ""),
    ]  # fmt: skip
    assert least[1] != round(made.assessment.clearances[1].required_m * 1e3)


@pytest.mark.parametrize("height_m", [1.2, 0.3])
def test_only_a_parapet_that_qualifies_is_relied_on(height_m):
    edge = projects.roof_object("N", "edge with parapet", 0, 400, 200, 202, height=height_m)
    page = notes(objects=[edge], clearances=[projects.clearance("A1", "N", 60.0)])
    assert ("Parapets required by the clearances" in page) is (height_m == 1.2)
    assert ("Height of the parapets above the roof measured: N." in page) is (height_m == 1.2)
