"""Cover, letter, references, symbols and departures say what the project at hand has."""

import datetime as dt
import io
import re
from dataclasses import replace
from html import unescape

import pytest
from pypdf import PdfReader

import stand_in
from report.pages.cover import cover
from report.pages.front import verdict_sentence
from report.pages.letter import letter
from report.pages.provisions import provisions
from report.pages.references import codes, references
from report.pages.registry import package_data
from report.pages.symbols import SYMBOLS
from report.sheet.schema import Options
from report.typeset.pdf import lay_out
from solver.records.acceptance_row import Consequence

MOTIONS = stand_in.motions(3, seconds=4.0)


def plain(text):
    return " ".join(unescape(re.sub(r"<[^>]+>", "", str(text))).split())


def package(motions=MOTIONS, **changes):
    return package_data(stand_in.assess_input(stand_in.project(**changes), motions))


@pytest.fixture(scope="module")
def usual():
    return package()


@pytest.fixture(scope="module")
def html():
    tests = {"standard": "ASTM G115-10", "laboratory": "L", "report": "R"}
    data = stand_in.project(friction_tests=tests)
    return stand_in.html(stand_in.book(data, MOTIONS))


def block(made):
    return {label: plain(value) for label, value in cover(made)["block"]}


def test_the_cover_has_verdict_and_governing_numbers(usual):
    rows = block(usual)
    gaps = usual.assessment.clearances
    assert rows["Verdict"].startswith("NG Marked NG: ")
    governing = rows["Governing array"]
    assert governing.startswith("A2: NG; μ 0.45; design displacement 40.8 in")
    worst = max(gaps, key=lambda gap: gap.required_m / gap.clearance.provided_m)
    assert worst.clearance.object == "S edge"  # 1.5 x 40.8 in beside 60 in
    assert rows["Governing clearance"] == "A2 to S edge: D/C 1.02"


def test_the_cover_has_codes_and_attachments(usual):
    rows = block(usual)
    assert rows["Applicable codes"].startswith("SEAOC PV1-2012, Structural Seismic Requirements")
    assert rows["Applicable codes"].endswith("Arrays; ASCE 7-16; IBC 1613.3; AC156")
    assert rows["In this file"] == (
        "workbook input.xlsx (SHA-256 5f5f5f5f5f5f…); nine record files; results.json"
    )
    assert rows["Beside it"] == "results.xlsx, results.json, plan.dxf"
    assert rows["Verification"].startswith("roofslip verify-package FILE computes")
    assert rows["Verification"].endswith(usual.fingerprint)


def test_the_cover_says_that_large_records_are_left_out(usual, monkeypatch):
    monkeypatch.setattr("report.provenance.files.MOST_RECORDS", 800_000)
    rows = block(usual)
    assert "not the nine record files, 0.9 MB in all: appendix B" in rows["In this file"]
    assert "verify-package FILE --records FOLDER" in rows["Verification"]


def test_a_project_without_clearances_or_value_names_neither():
    made = package(motions=MOTIONS[:2], arrays=[stand_in.array("A1", 4.0)], clearances=[])
    rows = block(made)
    assert rows["Governing clearance"] == "none given"
    assert "design displacement none" in rows["Governing array"]
    page = letter(made)
    assert "The workbook lists no clearances; none is checked." in page["texts"]
    assert any("without a permitted design displacement is NG" in text for text in page["texts"])


def test_lines_for_the_license_are_on_cover_and_letter(html):
    head = html[html.index('class="cover"') : html.index('id="summary"')]
    assert head.count("License no.") == head.count("License expires") == 2


def test_asce_7_22_is_cited_in_its_own_edition():
    site = stand_in.project().site.model_dump() | {
        "rule_set": "ASCE 7-22",
        "s_ds_g": None,
        "s_ms_g": 2.36,
        "f_a": None,
        "f_v": None,
    }
    made = package(site=site)
    assert [document.cited for document in codes(made)] == ["ASCE 7-22", "IBC 1613.3", "AC156"]
    full = " ".join(document.full for document in references(made))
    assert "AC156-24" in full
    assert "7-16" not in full
    assert "PV1" not in full


def test_the_letter_counts_what_was_run(usual):
    page = letter(usual)
    runs = sum(len(m.runs) for item in usual.assessment.arrays for m in item.motions)
    assert plain(page["analyzed"]) == (
        "Three ballasted arrays (A1, A2, A3) were analyzed by response history under three "
        f"motions, in {runs} runs, and compared with SEAOC PV1-2012 for SDS = 1.566 g and seismic "
        "design category D."
    )
    assert sum(gap.ok for gap in usual.assessment.clearances) == 4
    assert "Four of five clearances are satisfied." in page["texts"]
    rows = [plain(row.cells[-1]) for row in page["arrays"].rows]
    assert rows == [usual.assessment.array_verdict(a).value for a in usual.assessment.arrays]
    assert not any("departure" in text or "overridden" in text for text in page["texts"])


def test_one_array_is_counted_in_the_singular():
    made = package(arrays=[stand_in.array("A1", 1.0)], objects=[], clearances=[])
    assert plain(letter(made)["analyzed"]).startswith("One ballasted array (A1) was analyzed")


def test_the_letter_is_one_page():
    """Only the letter and the parts around it are laid out."""
    arrays = [stand_in.array(f"A{k}", 0.5, x=90 * k) for k in range(12)]
    data = stand_in.project(arrays=arrays, objects=[], clearances=[])
    html = stand_in.html(stand_in.book(data, MOTIONS[:1]))
    head, *parts = re.split(r'(?=<section class="[^"]*\bstarts\b)', html)
    (at,) = (k for k, part in enumerate(parts) if '<h1 id="letter">' in part)
    near = re.sub(r' href="#[^"]*"', "", "".join((head, *parts[at : at + 2])))
    pdf = lay_out(f"{near}</body></html>")
    texts = [page.extract_text() for page in PdfReader(io.BytesIO(pdf)).pages]
    assert len(texts) > 2
    assert texts[1].startswith("Letter of results")
    assert "License expires" in texts[1]
    assert "1 Summary" in texts[2]


@pytest.mark.parametrize(
    ("n_conditions", "n_severe", "text"),
    [
        (9, 0, "Nine requirements are open; the summary (part 1) lists them as conditions."),
        (1, 0, "One requirement is open; the summary (part 1) lists it as a condition."),
        (0, 1, "One requirement is open; the summary (part 1) lists it as NG."),
        (0, 2, "Two requirements are open; the summary (part 1) lists them as NG."),
        (
            9,
            1,
            "10 requirements are open; the summary (part 1) lists one as NG and nine conditions.",
        ),
    ],
)
def test_the_letter_says_where_open_requirements_are_listed(usual, n_conditions, n_severe, text):
    row = usual.assessment.conditions[0]
    assert row.consequence is Consequence.CONDITION
    rows = (row,) * n_conditions + (replace(row, consequence=Consequence.NG),) * n_severe
    made = replace(usual, assessment=replace(usual.assessment, rows=rows))
    assert text in letter(made)["texts"]


def test_a_departure_is_printed_with_its_reason_reviewer_license_and_date(usual):
    assert provisions(usual)["departure"] is None
    options = Options(
        directional=True,
        directional_reason="Agreed on site",
        directional_reviewer="R. Viewer",
        directional_license="CA S1234",
        directional_date=dt.date(2026, 3, 1),
    )
    made = package(options=options.model_dump())
    table = provisions(made)["departure"]
    assert table.rows[0].cells[1:] == ("Agreed on site", "R. Viewer", "CA S1234", "2026-03-01")
    assert any("a departure from the rule set" in text for text in letter(made)["texts"])


def test_the_note_of_a_provision_is_printed(usual):
    (note,) = provisions(usual)["table"].notes
    assert plain(note) == (
        "Maximum slope for the analysis route [deg]: "
        "quoted for attached arrays (Sec. 4); an unattached array on a slope over 3 deg may be "
        "outside PV1-2012†."
    )


def test_the_three_verdicts_are_defined(html):
    basis = plain(html[html.index('id="basis"') : html.index('id="inputs"')])
    for word in ("OK: every", "OK with conditions: ", "NG: "):
        assert word in basis


def test_every_document_is_listed_exactly_where_it_is_cited(html):
    body = html[html.index("<body>") :]
    start = body.index('<h2 class="plain">References')
    before, listed = plain(body[:start]), plain(body[start:])
    for name in ("PV1-2012", "ASCE 7-16", "IBC 1613.3", "AC156", "Housner", "Ishiyama", "G115-10"):
        assert name in before, name
        assert name in listed, name
    for name in ("ASCE 7-22", "Constantinou"):
        assert name not in before, name
        assert name not in listed, name


def test_every_symbol_of_the_pages_is_in_the_list(html):
    used = set(re.findall(r"<i>([^<]+)</i><sub>([^<]+)</sub>", html[: html.index('id="symbols"')]))
    missing = {f"{stem}_{below}" for stem, below in used} - SYMBOLS.keys()
    assert missing - {"F_p/W_p"} == set()


def test_no_symbol_is_printed_as_it_is_typed(html):
    """The input echo prints headings of the workbook."""
    body = html[html.index("<body>") : html.index('id="echo"')]
    typed = [name for name in SYMBOLS if "_" in name and name.isascii()]
    assert "S_DS" in typed
    found = re.findall(rf"\b(?:{'|'.join(typed)})\b", re.sub(r"<[^>]+>", "", body))
    assert found == []


def test_the_symbols_of_the_equations_are_in_the_list(html):
    images = re.findall(r'<div class="symbols"><img src="[^"]*" alt="([^"]*)"', html)
    assert len(images) > 15
    found = set().union(*(symbols(unescape(latex)) for latex in images))
    assert {"k", "k_a", "k_f", "k_p", "c_1", "Δ_MPV"} <= found
    assert found - SYMBOLS.keys() - {"i", "d", "dt"} == set()  # indices


GREEK = {r"\Delta": "Δ", r"\theta": "θ", r"\mu": "μ", r"\phi": "φ"}
_WORDS = re.compile(r"\\mathrm\{(?!PRD)[^}]*\}|\\(?!Delta|theta|mu\b|phi)[A-Za-z]+|[{}]")


def symbols(latex):
    """Return the symbols of an equation, with their first subscript."""
    rest = re.sub(r"\\mathrm\{PRD\}(_i)?|\\sum(_\{[^}]*\}|\^\{[^}]*\})*|_i\b", " ", latex)
    for name, sign in GREEK.items():
        rest = rest.replace(name, sign)
    rest = _WORDS.sub(" ", re.sub(r"_\{([^{}]*)\}", r"_\1 ", rest))
    names = re.findall(r"[A-Za-zΔθμφ](?:_[A-Za-z0-9]+)?", rest)
    return set(names) - {"e"}  # of the exponential


def test_a_verdict_that_a_requirement_alone_makes_names_it(usual):
    assert not verdict_sentence(usual).endswith("NG: .")
