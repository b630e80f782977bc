"""One family of paper in a package, and as many sheets with long names as with short ones."""

import io
import re

import pytest
from pypdf import PdfReader

import scenes
from inputs import HEAD
from printed import printed
from report.assessment.evidence import support
from report.drawing.on_paper import printed_plan
from report.figures.plan import paper_svg
from report.package.html import pages, part
from report.sheet.schema.choices import PlanPaper
from report.typeset.pdf import lay_out

LETTER, A4 = (8.5, 11.0), (210 / 25.4, 297 / 25.4)


def sheets(html):
    return PdfReader(io.BytesIO(lay_out(html))).pages


@pytest.mark.parametrize(
    ("paper", "units", "size_in"),
    [
        (PlanPaper.BY_SIZE, "SI", A4),
        pytest.param(PlanPaper.BY_SIZE, "US", LETTER, marks=pytest.mark.nightly),
        pytest.param(PlanPaper.A3, "US", A4, marks=pytest.mark.nightly),
        pytest.param(PlanPaper.TABLOID, "SI", LETTER, marks=pytest.mark.nightly),
    ],
)
def test_the_sheets_are_of_the_family_of_the_plan(paper, units, size_in):
    package = scenes.package(options={"plan_paper": paper}, project=HEAD | {"units_first": units})
    for sheet in sheets(part(package, None, "provisions", {})):
        assert [float(v) / 72 for v in sheet.mediabox[2:]] == pytest.approx(size_in, abs=0.01)


@pytest.fixture(scope="module")
def long():
    return scenes.twelve(is_long=True)


@pytest.mark.nightly
def test_the_plan_names_every_array_and_object_and_has_the_key(long):
    page, names = printed(long, "plan"), long.data.names.keys
    on = printed_plan(long.assessment)
    shown = re.findall(r"<text[^>]*>([^<]*)</text>", paper_svg(on.plan))
    rows = (*long.data.arrays, *long.data.objects)
    assert len(rows) == 24
    for row in rows:
        assert len(row.id) == 40
        assert names[row.id] in shown
        assert " ".join(page.split()).count(f"{names[row.id]} {row.id}") == 1
    assert not on.unnamed


@pytest.mark.nightly
def test_long_names_stand_in_the_keys_alone(long):
    html = pages(long.assessment, support(long.assessment))
    texts = [sheet.extract_text() for sheet in sheets(html)]
    whole = " ".join(" ".join(texts).split())
    keys = long.data.names.keys
    assert len(keys) == 31
    for name, key in keys.items():
        assert whole.count(name) == whole.count(f"{key} {name}") == 1
    short = scenes.twelve(is_long=False)
    count = len(sheets(pages(short.assessment, support(short.assessment))))
    assert abs(len(texts) - count) <= 0.1 * count
