"""A quantity prints the same on every sheet, on the terminal, in results.xlsx, in DXF and page."""

import io
import json
import math
import re

import openpyxl
import pytest

from fixtures import assessments, projects
from fixtures.marks import by_day
from fixtures.pages import page_of
from fixtures.spaces import spaced
from report.assessment.checks.sentence import texts as check_texts
from report.assessment.design.clearances import beside
from report.assessment.support.response_spectra import spectra
from report.drawing.plan_layers import plan_drawing
from report.pages.terminal import summary
from report.results.results_json import results_json
from report.results.xlsx import results_xlsx
from report.text.units import Quantity
from report.web.answers import answer

INCH, POUND = 0.0254, 4.4482216152605
# By hand: what is required and a demand up, what is provided and a capacity down.
WAYS = {
    "up": lambda x: math.ceil(x - 1e-6),
    "down": lambda x: math.floor(x + 1e-6),
    "nearest": lambda x: math.floor(x + 0.5),
}


SHEETS = (
    "letter", "summary", "limits", "plan", "comparison", "results", "method", "model", "notes",
    "accuracy",
)  # fmt: skip


OF_RUNS = ("comparison", "model", "results", "accuracy")


def number(value, decimals, way):
    return f"{WAYS[way](value * 10**decimals) / 10**decimals:.{decimals}f}"


def pair(value_si, quantity, way, us_first):
    us, si = (f"{number(value_si / u.si, u.decimals, way)} {u.symbol}" for u in quantity.value)
    return f"{us} ({si})" if us_first else f"{si} ({us})"


def failing():
    """The stand-in with clearances, slack, strength and a capacity that are not enough."""
    arrays = [
        projects.array("A1", 0.5, slack_m=0.9, interconnection_n=5e3, roof_capacity_pa=410.0),
        projects.array("A2", 0.5, slack_m=40.0 * INCH, wind_weight_pa=430.0),
    ]
    gaps = [projects.clearance("A1", "RTU-1", 20.03 * INCH), projects.clearance("A1", "A2", 1.2)]
    return assessments.package(arrays=arrays, clearances=gaps).assessment


CASES = {
    **{name: lambda name=name: assessments.shipped(name)
       for name in ("example", "school", "campus", "conditions")},
    "without motions": assessments.without_motions,
    "departing": lambda: assessments.departing().assessment,
    "not permitted": assessments.unpermitted,
}  # fmt: skip


@pytest.fixture(scope="module", params=by_day(CASES, 1))
def done(request):
    return CASES[request.param]()


def amounts(done):
    """Each amount of a project: its value, its quantity, and how it is rounded."""
    size, weight, velocity = Quantity.SIZE, Quantity.WEIGHT, Quantity.VELOCITY
    for item in done.arrays:
        array = item.array
        analysis, given = item.analysis, item.prescriptive
        values = item.permitted_m, analysis.value_m, given.value_m, given.minimum_m, item.floor_m
        peaks = analysis.mean_m, analysis.largest_m, *(run.prd_m for run in item.runs)
        yield from ((value, size, "up") for value in (*values, *peaks))
        yield item.interconnection_n, weight, "up"
        yield item.fastest_mps, velocity, "up"
        yield array.slack_m, size, "down"
        yield array.interconnection_n, weight, "down"
        yield array.weight_n, weight, "nearest"
        yield array.weight_pa, Quantity.PRESSURE, "nearest"
    for key in ("parapet_height_in", "parapet_over_cg_in"):
        yield done.rules.length_m(key), size, "up"
    for gap in done.clearances:
        yield gap.required_m, size, "up"
        yield gap.clearance.provided_m, size, "down"
        yield gap.clearance.pathway_m, size, "up"
        for array in beside(done.arrays, gap.clearance):
            yield array.permitted_m, size, "up"
    for near in done.neighbors:
        yield near.required_m, size, "up"
        yield near.gap_m, size, "down"


def texts(done):
    """What is printed, by output."""
    package = assessments.package_data(done)
    found = assessments.evidence(done)
    book = openpyxl.load_workbook(io.BytesIO(results_xlsx(done, found.spectra)), data_only=True)
    cells = [c.value for sheet in book for row in sheet.iter_rows() for c in row]
    return {
        **{
            f"sheet {id}": re.sub(r"\s+", " ", page_of(package, id))
            for id in SHEETS
            if done.has_motions or id not in OF_RUNS
        },
        "terminal": "\n".join(summary(done)),
        "results.json": results_json(done, found).decode(),
        "results.xlsx": "\n".join(value for value in cells if isinstance(value, str)),
        "DXF": "\n".join(text.words for text in plan_drawing(done).texts),
        "page": json.dumps(answer(done, is_provisional=False), ensure_ascii=False),
    }


def test_no_output_rounds_an_amount_another_way(done):
    us_first = done.project.us_first
    given = [each for each in amounts(done) if each[0] is not None and each[0] > 0.0]
    right = {pair(*each, us_first) for each in given}
    wrong = {pair(value, q, way, us_first) for value, q, _ in given for way in WAYS} - right
    assert len(right) > 5
    said = texts(done)
    for output, text in said.items():
        for each in wrong:
            assert not re.search(rf"(?<![\d.]){re.escape(each)}", text), (output, each)
    assert sum(any(each in text for text in said.values()) for each in right) > 5


def rows_of(sheet):
    head, *rows = sheet.iter_rows(min_row=4, values_only=True)
    return [dict(zip(head, row, strict=True)) for row in rows if row[0]]


def test_a_required_value_of_results_xlsx_shows_what_the_package_shows_and_its_ratio_is_exact(done):
    book = openpyxl.load_workbook(io.BytesIO(results_xlsx(done, spectra(done))), data_only=True)
    rounded = 0
    for sheet in ("Design", "Clearances"):
        for row in rows_of(book[sheet]) if sheet in book.sheetnames else ():
            for head, value in row.items():
                exact = row.get(head.replace(" [", ", unrounded [").replace("[mm]", "[in]"))
                is_rounded = head.endswith(("[in]", "[mm]", "[lb]")) and "unrounded" not in head
                if not (is_rounded and isinstance(exact, float)):
                    continue
                size = exact * 25.4 if head.endswith("[mm]") else exact
                decimals = 1 if head.endswith("[in]") else 0
                assert value == float(number(size, decimals, "up")), (sheet, head)
                rounded += 1
    assert rounded > 5 * len(done.arrays)
    for row, gap in zip(rows_of(book["Clearances"]), done.clearances, strict=True):
        assert row["Provided [in]"] == pytest.approx(gap.clearance.provided_m / INCH)
        if not math.isnan(gap.required_m):
            assert row["Required, unrounded [in]"] == pytest.approx(gap.required_m / INCH)
            assert row["D/C"] == float(number(gap.demand_capacity, 2, "up"))


def test_what_is_not_enough_reads_as_less_in_both_units_in_every_output():
    done = failing()
    said = "\n".join(texts(done).values())
    (short, *_) = done.clearances
    had = pair(short.clearance.provided_m, Quantity.SIZE, "down", us_first=True)
    needed = pair(short.required_m, Quantity.SIZE, "up", us_first=True)
    assert f"{had}. Required: at least {needed}" in spaced(said)
    rows = {(row.id, row.subject): row for row in done.checks}
    for id, subject in (
        ("electrical_slack", "A1"), ("interconnection", "A1"), ("roof_capacity", "A1"),
        ("wind_weight", "A2"),
    ):  # fmt: skip
        row = rows[id, subject]
        found, limit = (re.findall(r"[\d.]+", text) for text in check_texts(row, True))
        assert not row.is_satisfied
        is_at_most = id == "roof_capacity"
        for have, need in zip(map(float, found), map(float, limit), strict=True):
            assert (have > need) if is_at_most else (have != need), row
