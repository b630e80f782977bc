"""The package: its pages before and after their layout, its paper, and many or long names."""

import datetime as dt
import io
import re
from collections import Counter, defaultdict
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest
from pypdf import PdfReader

from fixtures import assessments, projects
from fixtures.marks import by_day, nightly
from fixtures.pages import FRONT, IDS, page_of, read
from fixtures.project_parts import HEAD
from report.drawing.on_paper import printed_plan
from report.figures.plan_figure import paper_svg
from report.package.html import pages as written
from report.package.html import part
from report.pages.drawings import draw_assessment
from report.project.model.choices import PlanPaper
from report.text.names import name_lines
from report.typeset.pdf import TEMPLATES, lay_out


def pages(pdf):
    return [page.extract_text() for page in PdfReader(io.BytesIO(pdf)).pages]


def flat(text):
    return " ".join(text.split())


@pytest.fixture(scope="module")
def html():
    done = assessments.usual()
    return written(done, assessments.evidence(done))


@pytest.fixture(scope="module")
def pdf(html):
    return lay_out(html)


@pytest.fixture(scope="module")
def texts(pdf):
    return pages(pdf)


@pytest.mark.nightly
def test_every_page_says_what_it_is_and_layout_drops_nothing(texts, html):
    assert 15 <= len(texts) <= 30
    for count, text in enumerate(texts, start=1):
        for piece in (
            "24-117 Alameda Warehouse", f"Sheet {count} of {len(texts)}", "Date 2026-03-05",
            "By Engineer of record", "Checked —", "Rev. 0", "Code SEAOC PV1-2012",
            "† Verify against the adopted code.",
        ):  # fmt: skip
            assert piece in flat(text)
    words = apart(re.sub(r"(?m)^\[.*\]$", " ", read(html)))
    laid = apart(" ".join(texts))
    missing = Counter(words) - Counter(laid)
    assert len(words) > 5000
    assert [word for word in missing if word not in "".join(laid)] == []
    for title in ("1 Summary", "A Records, software and references"):
        number, words = title.split(" ", 1)
        contents = flat(" ".join(texts[:3]))
        match = re.search(rf"{number}\s*{re.escape(words)}:\s*(\d+)", contents)
        assert match, title
        assert title in flat(texts[int(match[1]) - 1])


def apart(text):
    """Return the words of a text, without what stands for layout in the words of a page."""
    return re.sub(r"\(#[^)]*\)|[][|#^/();]", " ", text).split()


@pytest.mark.nightly
def test_the_document_says_what_it_is_in_shipped_fonts(pdf):
    reader = PdfReader(io.BytesIO(pdf))
    assert "24-117 Alameda Warehouse" in reader.metadata.title
    assert reader.metadata.author == "Engineer of record"
    assert reader.metadata.creation_date.date() == dt.date(2026, 3, 5)
    assert reader.trailer["/Root"]["/Lang"] == "en-US"
    titles = [item.title for item in reader.outline if not isinstance(item, list)]
    assert "1 Summary" in titles
    assert "A Records, software and references" in titles
    names = set(re.findall(rb"/BaseFont /[A-Z]{6}\+([\w-]+)", pdf))
    for page in PdfReader(io.BytesIO(pdf)).pages:
        for font in page["/Resources"]["/Font"].values():
            names.add(font.get_object()["/BaseFont"].split("+")[1].encode())
    assert names
    assert all(name.startswith(b"Source-") for name in names)


@pytest.mark.parametrize("name", ["package.css", "verification.css"])
@pytest.mark.quick
def test_no_type_is_smaller_than_eight_and_a_half_points(name):
    style = (TEMPLATES / name).read_text(encoding="utf-8")
    sizes = [float(size) for size in re.findall(r"font(?:-size)?: ([\d.]+)pt", style)]
    assert sizes
    assert min(sizes) >= 8.5


@pytest.fixture(scope="module")
def crowded():
    """The texts of the pages of twelve arrays, long names and markup."""
    project = projects.project().project.model_dump() | {
        "name": "<script>alert('x')</script> & " + "Unbreakable" * 40,
        "client": "<img src='file:///etc/hostname'>",
        "prepared_by": "W" * 200,
    }
    arrays = [
        projects.array(f"A{k}", 0.25 * k, x=90 * (k % 4), y=70 * (k // 4)) for k in range(1, 12)
    ]
    arrays.insert(
        0, projects.array("<b>" + "A" * 37, 0.0, mu_report="R" * 500, construction="{{ 7 * 7 }}")
    )
    edge = projects.roof_object("E" * 40, "edge without parapet", 0, 220, -1, 0)
    clearances = [projects.clearance(f"A{k}", f"A{k + 1}", 3.0) for k in range(1, 11)]
    clearances.append(projects.clearance("<b>" + "A" * 37, "E" * 40, 3.0))
    data = projects.project(project=project, arrays=arrays, objects=[edge], clearances=clearances)
    return pages(projects.package(projects.book(data, assessments.motions(3, seconds=4.0))))


@pytest.mark.nightly
def test_markup_in_a_field_is_printed_not_obeyed_and_twelve_arrays_have_room(crowded):
    assert "<script>alert('x')</script>" in flat(crowded[0])
    assert "<img src='file:///etc/hostname'>" in flat(crowded[0])
    assert "{{ 7 * 7 }}" in flat(" ".join(crowded))
    assert all(f"Sheet {n} of {len(crowded)}" in flat(text) for n, text in enumerate(crowded, 1))
    assert sum(flat(text).count("PRD of each run") for text in crowded) >= 12


def test_few_and_thirty_motions_and_an_analysis_above_the_prescriptive_value_are_told():
    arrays = [projects.array(f"A{k}", 4.0, x=100 * k) for k in (1, 2, 3)]
    package = assessments.package(assessments.motions(2), arrays=arrays)
    summary = page_of(package, "summary")
    for row in summary.table("Arrays").rows:
        assert row["Prescriptive [in]"] == "81.6§"
        assert {row[f"{name} [in]"] for name in ("Analysis", "Design")} == {"none"}
        assert (row["Governs"], row["D/C"]) == ("none", "none")
        assert row["Verdict"].startswith("NG")
    assert "cannot be made without a permitted design displacement" in summary
    arrays = [projects.array("A1", 2.0)]
    shaking = assessments.motions(30, seconds=3.0)
    package = assessments.package(shaking, arrays=arrays, objects=[], clearances=[])
    listed = page_of(package, "results").tables[0].column("Motion")
    assert listed[:30] == [f"M{k}" for k in range(1, 31)]
    arrays = [projects.array("A1", 3.0, mu=0.2)]
    shaking = assessments.motions(3, seconds=30.0)
    package = assessments.package(shaking, arrays=arrays, objects=[], clearances=[])
    text = page_of(package, "comparison").line("Array A1: ")
    match = re.search(
        r"analysis displacement is (\d\.\d\d) times the prescriptive displacement \(", text
    )
    (array,) = package.assessment.arrays
    ratio = array.analysis.value_m / array.prescriptive.value_m
    assert float(match[1]) == pytest.approx(ratio, abs=0.005)
    assert ratio > 1.0
    assert "(3 of 3 PRDs exceed it) and governs" in text


@pytest.mark.nightly
def test_a_block_that_leaves_the_roof_gives_no_value_with_its_time():
    up = np.repeat((0.0, -1.4 * projects.G, 0.0), 100)
    lifted = projects.motion("LIFT", np.zeros(300), up, signs=(1,))
    package = assessments.package((*assessments.motions(), lifted))
    results = page_of(package, "results")
    assert "1 of 13 runs: the normal force falls below zero, from 0.997 s on (LIFT)" in results
    for table in results.tables:
        *values, force, status = table.row("LIFT").values()
        assert set(values[1:-1]) == {"", "none"}  # it has no transverse runs
        assert (values[-1], force, status) == ("—", "−0.40", "uplift")
    row = page_of(package, "summary").table("Governing").row("Runs that come to rest")
    assert (row["Item"], row["Verdict"]) == ("A1 to A3", "NG")


@pytest.mark.parametrize("edition", by_day(["ASCE 7-16", "ASCE 7-22"], 1))
def test_other_editions_say_their_own_name_and_clauses(edition):
    site = projects.project().site.model_dump() | {"rule_set": edition, "s_ds_g": None}
    is_new = edition == "ASCE 7-22"
    if is_new:
        site |= {"f_a": None, "f_v": None, "s_ms_g": 2.36}
    package = assessments.package(site=site)
    said = "\n".join(page_of(package, id) for id in (*FRONT, *IDS))
    assert f"Code {edition}" in said
    assert f"{edition} 13.6.12" in said
    listed = said.split("References. ")[1]
    assert all(f"{name}: " in listed for name in (edition, "IBC 1613.3", "AC156"))
    assert ("AC156-24" in said, "7-16" in said) == ((True, False) if is_new else (False, True))
    assert re.findall(r"PV1[^.]*", said) == [
        "PV1 | Mean | Analysis | Floor | Design | Analysis / prescr",
        "PV1: prescriptive displacement by SEAOC PV1-2012, for information",
    ]


@pytest.mark.nightly
def test_how_much_of_the_slip_a_high_pass_takes_is_printed():
    row = {"record": "x", "recorded_at": "ground", "highpass_hz": 0.2}
    rows = [row | {"id": id} for id in ("G1", "G2", "G3")]
    data = projects.project(spectrum=[], motions=rows, building={"period_s": 0.5})
    book = assessments.grounded(data, assessments.motions(3, peak_g=0.5))
    half = tuple(replace(motion, ax_mps2=0.5 * motion.ax_mps2) for motion in book.motions)
    book = book.having(motions=half)
    table = page_of(projects.assessed(book), "motions").table("Effect of the")
    *_, with_it, _, without, _, share = table.cells[0]
    assert float(without) > float(with_it)
    lost = 100 * (1.0 - float(with_it) / float(without))
    assert float(share.replace("−", "-")) == pytest.approx(lost, abs=2)


def drifting(given, end_m):
    """What became of a motion that ends at rest, its first component at a displacement."""
    prepared = projects.prepared(given)
    level = {
        name: replace(measures, final_displacement_m=0.0, final_velocity_mps=0.0)
        for name, measures in prepared.measures.items()
    }
    level["horizontal"] = replace(level["horizontal"], final_displacement_m=end_m)
    return replace(prepared, measures=level)


@pytest.mark.parametrize(
    ("done", "end_m", "drift"),
    by_day(
        [
            ("as recorded", 0.0, None),
            ("as recorded", 0.0099, None),
            ("as recorded", -0.0101, "drifts"),
            ("high-pass 0.1 Hz", 0.0, "none"),
        ],
        2,
    ),
)
def test_what_was_done_is_one_sentence_where_nothing_was_done_and_no_motion_drifts(
    done, end_m, drift
):
    """Above ten millimeters a motion drifts."""
    book = projects.book(shaking=assessments.motions())
    first, *others = (drifting(motion, 0.0) for motion in book.motions)
    first = replace(drifting(book.motions[0], end_m), done=done)
    page = page_of(projects.assessed(book.having(prepared=(first, *others))), "motions")
    if drift is None:
        assert "The final velocity of every component is at most 0.00 in/s" in page
        assert "Processing, and final velocity" not in page
    else:
        column = page.table("Processing, and final velocity").column("Drift")
        assert column == [drift, "none", "none"]


LETTERS, WIDE_PT = 64, 175.0
"""What has room on a line: numbers beside an equation, and an equation beside its numbers."""


def test_numbers_stand_below_an_equation_where_there_is_no_room_beside_it():
    page = ElementTree.fromstring(part(assessments.package(), None, "method", defaultdict(tuple)))
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


LETTER, A4 = (8.5, 11.0), (210 / 25.4, 297 / 25.4)


@pytest.mark.parametrize(
    ("paper", "units", "size_in"),
    [
        (PlanPaper.BY_SIZE, "SI", A4),
        nightly((PlanPaper.A3, "US", A4)),
        nightly((PlanPaper.TABLOID, "SI", LETTER)),
    ],
)
def test_the_sheets_are_of_the_family_of_the_plan(paper, units, size_in):
    package = assessments.package(
        options={"plan_paper": paper}, project=HEAD | {"units_first": units}
    )
    made = lay_out(part(package, None, "provisions", {}))
    for sheet in PdfReader(io.BytesIO(made)).pages:
        assert [float(v) / 72 for v in sheet.mediabox[2:]] == pytest.approx(size_in, abs=0.01)


@pytest.mark.parametrize("id_", by_day(["summary", "plan", "limits", "notes"], 1))
def test_a_name_of_one_word_is_not_broken_in_a_table(id_):
    names = "ROOFTOPWEST2", "WAREHOUSEA12"
    arrays = [projects.array(name, 1.0 + k, x=200 * k) for k, name in enumerate(names)]
    given = projects.clearance(names[0], names[1], 3.0)
    package = assessments.package(arrays=arrays, objects=[], clearances=[given])
    drawings = draw_assessment(package)
    evidence = assessments.evidence(package.assessment)
    html = part(package, evidence, id_, drawings)
    # Of the parts that it refers to each is a place.
    places = "".join(f'<p id="{id}">.</p>' for id in set(re.findall(r'href="#([^"]+)"', html)))
    made = lay_out(html.replace("</body>", f"{places}</body>") if id_ == "summary" else html)
    text = "\n".join(pages(made))
    for name in names:
        assert text.count(name) == text.count(name[:6]) > 0


def test_places_in_plan_fill_the_sheet_before_the_plan_where_the_schedule_leaves_it_empty():
    def precede(name):
        at = {f"{name}{k}": {"x": 120 * (k // 2), "y": 100 * (k % 2)} for k in range(4)}
        arrays = [projects.array(name, 1.0, **corner) for name, corner in at.items()]
        a, b, c, d = at
        pairs = ((a, b), (a, c), (b, d), (c, d))
        given = [projects.clearance(*pair, 40 * projects.FOOT) for pair in pairs]
        page = page_of(assessments.package(arrays=arrays, objects=[], clearances=given), "plan")
        return page.index("location in plan") < page.index("To scale when printed")

    assert not precede("A")
    assert precede("WAREHOUSEA1")


@pytest.fixture(scope="module")
def long():
    return assessments.twelve(is_long=True)


@pytest.mark.nightly
def test_long_names_are_printed_as_they_are_on_the_plan_in_lines(long):
    on = printed_plan(long.assessment)
    shown = Counter(re.findall(r"<text[^>]*>([^<]*)</text>", paper_svg(on.plan)))
    rows = (*long.data.arrays, *long.data.objects)
    assert len(rows) == 24
    assert {len(row.id) for row in rows} == {40}
    lines = Counter(line for row in rows for line in name_lines(row.id))
    assert {line: shown[line] for line in lines} == lines
    assert not on.unnamed
    texts = pages(lay_out(written(long.assessment, assessments.evidence(long.assessment))))
    whole = flat(" ".join(texts))
    assert all(row.id in whole for row in (*rows, *long.data.motions))
    short = assessments.twelve(is_long=False)
    count = len(pages(lay_out(written(short.assessment, assessments.evidence(short.assessment)))))
    assert len(texts) <= 1.6 * count
