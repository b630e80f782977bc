import datetime as dt
import io
import re
from collections import Counter
from dataclasses import replace
from html import unescape

import numpy as np
import pytest
from pypdf import PdfReader

import packages
import printed
import scenes
import stand_in
from report.assessment.evidence import support
from report.motions.components import Components
from report.motions.history import shake
from report.package.html import pages as written
from report.pages.motions import drifts
from report.typeset.pdf import TEMPLATES, lay_out
from solver.model import DefectError
from solver.records.record import Record


def made(data=None, shaking=None):
    return stand_in.package(stand_in.book(data, shaking))


def pages(pdf):
    return [page.extract_text() for page in PdfReader(io.BytesIO(pdf)).pages]


def flat(text):
    return " ".join(text.split())


@pytest.fixture
def said():
    """The words of a package before layout, its running head first, in a tenth of the time."""

    def words(data=None, shaking=None):
        html = stand_in.html(stand_in.book(data, shaking))
        running = " ".join(re.findall(r'data-(?:head|foot)="([^"]*)"', html))
        return f"{flat(unescape(running))} {packages.words(html)}"

    return words


@pytest.fixture
def undrawn():
    """Do not draw figures: others of the same kind are drawn for `pdf` and `crowded`."""
    with packages.undrawn():
        yield


def few(count=3, seconds=8.0):
    return stand_in.motions(count, seconds=seconds)


@pytest.fixture(scope="module")
def html():
    done = scenes.usual()
    return written(done, support(done))


@pytest.fixture(scope="module")
def pdf(html):
    return lay_out(html)


@pytest.fixture(scope="module")
def texts(pdf):
    return pages(pdf)


@pytest.fixture(scope="module")
def whole(texts):
    return flat(" ".join(texts))


def test_the_package_has_fifteen_to_thirty_five_pages(texts):
    assert 15 <= len(texts) <= 35


def test_every_page_carries_project_sheet_date_by_checked_revision_and_edition(texts):
    for count, text in enumerate(texts, start=1):
        line = flat(text)
        assert "24-117 Alameda Warehouse" in line
        assert f"Sheet {count} of {len(texts)}" in line
        for piece in (
            "Date 2026-03-05",
            "By Engineer of record",
            "Checked —",
            "Rev. 0",
            "Code SEAOC PV1-2012",
            "† verify against the adopted code",
        ):
            assert piece in line


def test_the_papers_prescriptive_value_is_printed(whole):
    assert "81.6 in (2072 mm)" in whole


def test_the_layout_drops_no_word_of_a_page(html, texts):
    """Some cells touch in the text of the PDF, and an equation there has no alternative text."""
    words = apart(re.sub(r"(?m)^\[.*\]$", " ", printed.read(html)))
    laid = apart(" ".join(texts))
    missing = Counter(words) - Counter(laid)
    assert len(words) > 5000
    assert [word for word in missing if word not in "".join(laid)] == []


def apart(text):
    """Return the words of a text, without what stands for layout in the words of a page."""
    return re.sub(r"\(#[^)]*\)|[][|#^/()]", " ", text).split()


def test_the_document_says_what_it_is(pdf):
    reader = PdfReader(io.BytesIO(pdf))
    assert "24-117 Alameda Warehouse" in reader.metadata.title
    assert reader.metadata.author == "Engineer of record"
    assert reader.metadata.creation_date.date() == dt.date(2026, 3, 5)
    assert reader.trailer["/Root"]["/Lang"] == "en-US"
    titles = [item.title for item in reader.outline if not isinstance(item, list)]
    assert "1 Summary" in titles
    assert "B Records and software" in titles


@pytest.mark.parametrize("name", ["package.css", "verification.css"])
def test_no_type_is_smaller_than_eight_and_a_half_points(name):
    style = (TEMPLATES / name).read_text(encoding="utf-8")
    sizes = [float(size) for size in re.findall(r"font(?:-size)?: ([\d.]+)pt", style)]
    assert sizes
    assert min(sizes) >= 8.5


def test_only_shipped_fonts_are_used(pdf):
    names = set(re.findall(rb"/BaseFont /[A-Z]{6}\+([\w-]+)", pdf))
    for page in PdfReader(io.BytesIO(pdf)).pages:
        for font in page["/Resources"]["/Font"].values():
            names.add(font.get_object()["/BaseFont"].split("+")[1].encode())
    assert names
    assert all(name.startswith(b"Source-") for name in names)


def test_contents_name_the_sheet_of_each_part(texts):
    for title in ("1 Summary", "8 Comparison with the prescriptive displacement", "A Input echo"):
        number, words = title.split(" ", 1)
        match = re.search(rf"{number}\s*{re.escape(words)}\s*\.*\s*(\d+)", texts[1])
        assert match, title
        assert title in flat(texts[int(match[1]) - 1])


def test_unverified_values_carry_a_dagger_and_confirmed_ones_do_not(whole):
    assert "50 % of prescriptive, PV1-2012†" in whole
    assert "60 in × (1.566 − 0.4)" in whole
    assert "60† in" not in whole


def test_what_fails_is_said_on_the_summary(texts):
    summary = flat(next(text for text in texts if "1 Summary" in text and "Verdict" in text))
    assert "NG Marked NG: 1 of 3 arrays, 1 of 5 clearances." in summary


def test_every_run_and_every_cell_is_listed(texts, whole):
    for name in ("A1", "A2", "A3"):
        page = next(text for text in texts if f"Array {name}: PRD of every motion" in flat(text))
        assert all(f"M{k}" in page for k in range(1, 8))
        assert "Mean" in page
        assert "Design" in page
    assert "ab" * 32 in whole
    assert "5f" * 32 in whole


def test_si_comes_first_where_wanted(undrawn, said):
    project = stand_in.project().project.model_dump() | {"units_first": "SI"}
    whole = said(stand_in.project(project=project), few())
    assert "2072 mm (81.6 in)" in whole
    assert "81.6 in (2072 mm)" not in whole


@pytest.fixture(scope="module")
def crowded():
    """The texts of the pages of twelve arrays, long names and markup, without vertical motion."""
    project = stand_in.project().project.model_dump() | {
        "name": "<script>alert('x')</script> & " + "Unbreakable" * 40,
        "client": "<img src='file:///etc/hostname'>",
        "prepared_by": "W" * 200,
    }
    arrays = [
        stand_in.array(f"A{k}", 0.25 * k, x=90 * (k % 4), y=70 * (k // 4)) for k in range(1, 12)
    ]
    arrays.insert(
        0, stand_in.array("<b>" + "A" * 37, 0.0, mu_report="R" * 500, construction="{{ 7 * 7 }}")
    )
    edge = stand_in.roof_object("E" * 40, "edge without parapet", 0, 220, -1, 0)
    clearances = [stand_in.clearance(f"A{k}", f"A{k + 1}", 3.0) for k in range(1, 11)]
    clearances.append(stand_in.clearance("<b>" + "A" * 37, "E" * 40, 3.0))
    data = stand_in.project(project=project, arrays=arrays, objects=[edge], clearances=clearances)
    level = (replace(motion, az_mps2=stand_in.NO_RECORD) for motion in few(seconds=4.0))
    return pages(made(data, tuple(level)))


@pytest.mark.nightly("report/package/html.py")
def test_markup_in_a_field_is_printed_not_obeyed(crowded):
    assert "<script>alert('x')</script>" in flat(crowded[0])
    assert "<img src='file:///etc/hostname'>" in flat(crowded[0])
    assert "{{ 7 * 7 }}" in flat(" ".join(crowded))
    assert all(f"Sheet {n} of {len(crowded)}" in flat(text) for n, text in enumerate(crowded, 1))


@pytest.mark.nightly("report/package/html.py")
def test_twelve_arrays_have_room(crowded):
    assert sum("every motion in every run" in text for text in crowded) >= 12


@pytest.mark.nightly("report/package/html.py")
def test_motions_without_a_vertical_component_are_counted(crowded):
    assert "0 of 3 a vertical component" in flat(" ".join(crowded))


def test_too_few_motions_give_no_value_and_no_verdict_on_clearances(said):
    whole = said(stand_in.steep(), few(2))
    summary = whole[whole.index("1 Summary Marked") if "1 Summary Marked" in whole else 0 :]
    for name in ("A1", "A2", "A3"):
        row = re.search(rf"{name} \d\.\d\d 0\.\d\d (none .*?) (OK|NG) none NG", summary)
        assert row, name
        assert row[1] == "none none 81.6 2072 none none none"
    assert "without a verdict: 5 of 5 clearances" in whole
    assert "too few motions" in whole
    assert not re.search(r"\bnan\b", whole, re.IGNORECASE)


def test_a_block_that_leaves_the_roof_gives_no_value_with_its_time(said):
    up = np.zeros(800)
    up[300:400] = -1.4 * stand_in.G
    lifted = stand_in.motion("LIFT", np.zeros(800), up, signs=(1,))
    whole = said(shaking=(*few(), lifted))
    assert "motion LIFT, record +: the normal force falls below zero" in whole
    assert re.search(r"LIFT (none ){8}— −0\.40 uplift", whole)
    assert "3 of 3 arrays" in whole
    assert not re.search(r"\bnan\b", whole, re.IGNORECASE)


def test_an_analysis_above_the_prescriptive_value_is_said_and_governs(said):
    arrays = [stand_in.array("A1", 3.0, mu=0.2)]
    data = stand_in.project(arrays=arrays, objects=[], clearances=[])
    whole = said(data, stand_in.motions(3, seconds=30.0))
    match = re.search(r"by analysis is (\d\.\d\d) times the prescriptive displacement \(", whole)
    assert float(match[1]) > 1.0
    assert "(3 of 3 PRDs exceed it) and governs" in whole


def test_clearances_take_the_full_displacement(whole):
    assert "A2 1.50" in whole
    assert "A3 1.00" in whole
    assert "Direction Factor" not in whole
    assert "It is taken in full in every direction." in whole


def test_thirty_motions_of_one_array_without_clearances_are_listed(said):
    data = stand_in.project(arrays=[stand_in.array("A1", 2.0)], objects=[], clearances=[])
    whole = said(data, few(30, seconds=3.0))
    assert all(f"M{k} " in whole for k in range(1, 31))
    assert "The workbook lists no clearances" in whole


def test_overrides_are_printed_with_their_reason(undrawn, said):
    override = {"provision": "analysis_floor", "value": 0.8, "reason": "Agreed on 2026-02-10"}
    whole = said(stand_in.project(overrides=[override]), few())
    assert "Agreed on 2026-02-10" in whole
    assert "0.8 †‡" in whole
    assert "80 % of prescriptive, PV1-2012†‡" in whole


@pytest.mark.parametrize("edition", ["ASCE 7-16", "ASCE 7-22"])
def test_other_editions_say_their_own_name_and_clauses(undrawn, said, edition):
    site = stand_in.project().site.model_dump() | {"rule_set": edition, "s_ds_g": None}
    if edition == "ASCE 7-22":
        site |= {"f_a": None, "f_v": None, "s_ms_g": 2.36}
    whole = said(stand_in.project(site=site), few())
    assert f"Code {edition}" in whole
    assert f"{edition} 13.6.12" in whole
    assert "PV1" not in whole


def test_a_line_in_the_renderers_log_is_a_defect():
    with pytest.raises(DefectError, match="unknown property"):
        lay_out("<html lang='en-US'><title>Words</title><p style='colour: red'>x</p></html>")


@pytest.mark.parametrize(
    "address",
    ["file:///etc/hostname", "https://example.org/x.png", "shipped:/../pyproject.toml", "x.png"],
)
def test_nothing_is_fetched_but_what_is_shipped(address):
    with pytest.raises(DefectError):
        lay_out(f"<html lang='en-US'><title>A picture</title><img alt='x' src='{address}'/></html>")


def ground(name="G1", **changes):
    """A ground motion transferred through a building of 0.5 s, with its prepared."""
    (given,) = stand_in.motions(1, seconds=8.0, peak_g=0.5)
    row = {"id": name, "record": "x", "recorded_at": "ground"}
    data = stand_in.project(
        spectrum=[], motions=[row | changes], building={"period_s": 0.5}, target={"t_l_s": 8.0}
    )
    components = {
        field: Record(name=field, dt_s=given.dt_s, a_mps2=a)
        for field, a in (("record", given.ax_mps2), ("vertical", given.az_mps2))
    }
    prepared = Components(files=(), records=components, unfiltered=components, whole={})
    ((motion, prepared),) = shake(data, [prepared])
    return data, motion, prepared


def words_of(data, motion, prepared):
    book = stand_in.book(data, (motion,) * 3).having(prepared=(prepared,) * 3)
    html = stand_in.html(book)
    return flat(unescape(re.sub(r"<style.*?</style>|<[^>]+>", " ", html)))


def test_the_way_from_ground_to_roof_is_said_with_its_numbers():
    data, motion, prepared = ground()
    whole = words_of(data, motion, prepared)
    assert "5.4 From ground to roof" in whole
    assert "5.5 Response spectra" in whole
    assert "one story; period 0.5 s; damping 5 % of critical." in whole
    assert "The mass of the array is neglected" in whole
    assert "The vertical motion at the roof is that of the ground" in whole
    roof = prepared.roof["horizontal"]
    peaks = f"{roof.ground_peak_mps2 / stand_in.G:.3f} {roof.roof_peak_mps2 / stand_in.G:.3f}"
    assert f"G1 record {peaks}" in whole
    assert "with ground records transferred through the building of part 5" in whole
    assert "Ground, horizontal Target" in whole
    assert "the two-period design response spectrum of ASCE 7" in whole
    assert "0.793 g" in whole


def test_how_much_of_the_slip_a_high_pass_takes_is_printed(undrawn):
    data, motion, prepared = ground(highpass_hz=0.2)
    half = replace(motion, ax_mps2=0.5 * motion.ax_mps2)
    whole = words_of(data, half, prepared)
    assert "Effect of the high-pass filter: PRD of array" in whole
    row = re.search(r"G1 0\.2 5 ([\d.]+) \d+ ([\d.]+) \d+ (−?\d+)", whole)
    assert row
    with_it, without = float(row[1]), float(row[2])
    assert without > with_it
    assert float(row[3]) == pytest.approx(100 * (without - with_it) / without, abs=2)


def test_drift_is_marked_above_ten_millimeters():
    base = stand_in.motions(1, seconds=8.0)[0]
    still = stand_in.prepared(base)
    for end_m, is_marked in ((0.0099, False), (-0.0101, True)):
        drifted = replace(still.measures["horizontal"], final_displacement_m=end_m)
        level = {name: replace(m, final_displacement_m=0.0) for name, m in still.measures.items()}
        prepared = replace(still, measures=level | {"horizontal": drifted})
        assert drifts(prepared) is is_marked


def still(given):
    """The prepared of a motion that ends at rest, without residual displacement."""
    prepared = stand_in.prepared(given)
    level = {
        name: replace(measures, final_displacement_m=0.0, final_velocity_mps=0.0)
        for name, measures in prepared.measures.items()
    }
    return replace(prepared, measures=level)


@pytest.mark.parametrize("done", ["as recorded", "high-pass 0.1 Hz"])
def test_what_was_done_is_one_sentence_where_nothing_was_done_and_a_table_else(undrawn, done):
    book = stand_in.book(shaking=few())
    first, *others = map(still, book.motions)
    preparations = (replace(first, done=done), *others)
    html = stand_in.html(book.having(prepared=preparations))
    is_said = (
        "The final velocity of every component is at most 0.00 in/s and its final displacement "
        "at most 0.00 in"
    )
    assert (is_said in html) == (done == "as recorded")
    assert ("Processing, and final velocity" in html) == (done != "as recorded")


def test_a_project_specific_spectrum_replaces_that_of_ac156(undrawn, said):
    rows = [{"period_s": t, "horizontal_g": a, "vertical_g": a} for t, a in ((0.03, 2), (10, 1))]
    whole = said(stand_in.project(spectrum=rows), few())
    assert "Target at the roof: the project-specific spectrum" in whole
    assert "Target, project-specific [g]" in whole
    assert "1.6 × 1.566" not in whole
    assert "0.67 × 1.566" not in whole


def test_notes_of_the_reading_are_printed_once_for_a_motion(undrawn):
    book = stand_in.book(shaking=few())
    noted = tuple(replace(row, notes=("uneven times resampled",)) for row in book.records)
    html = stand_in.html(book.having(records=noted))
    assert html.count("<li>Motion M1: uneven times resampled.</li>") == 1
