"""The plan that a job of the page reads from a drawing, and what it says of it."""

import json
import shutil

import pytest

from fixtures.commands import output_of
from fixtures.dxf import BOX_FT, ROOF_FT, UNIT_FT, Sketch
from fixtures.workbooks import blank, type_into
from report.project.model.choices import UnitsFirst
from report.project.read.read import read
from report.web.jobs import perform

FEET_DRAWN_AS_INCHES = 1 / 12


def drawn(folder, shift_ft=0.0, factor=1.0, *, has_unit=True, unit="ft"):
    """Draw a roof with an array, and a unit or none, beside a workbook."""
    sketch = Sketch(unit=unit)
    every = [("ROOF-OUTLINE", ROOF_FT, ""), ("ARRAY", BOX_FT, "A1"), ("OBJECT", UNIT_FT, "RTU-1")]
    for layer, points, name in every if has_unit else every[:2]:
        sketch.ring(layer, [(factor * x + shift_ft, factor * y) for x, y in points], name)
    return sketch.saved(folder)


def plan_read(book, unit=""):
    """The answer of the page's job, or its problems; the workbook is then the one it filled in."""
    to = book.parent / "filled.xlsx"
    job = {"do": "read_plan", "workbook": str(book), "to": str(to), "layers": "{}", "unit": unit}
    done = perform(job)
    if "answer" in done:
        to.replace(book)
    return done


@pytest.mark.nightly
def test_a_second_drawing_says_on_the_page_what_the_command_prints(tmp_path):
    book = blank(tmp_path / "input.xlsx", UnitsFirst.US)
    drawn(tmp_path)
    assert plan_read(book) == {"answer": {"lines": []}}
    type_into(book, {"Objects/RTU-1/Height": 48})
    by_command = tmp_path / "by-command.xlsx"
    shutil.copy(book, by_command)
    drawing = drawn(tmp_path, 150.0, has_unit=False)
    lines = plan_read(book)["answer"]["lines"]
    assert any("the plan as a whole is moved by x 150.00" in line for line in lines)
    assert any(line.startswith("deleted with RTU-1: ") for line in lines)
    printed = output_of("plan", "read", drawing, by_command, "--replace").splitlines()
    assert [line for line in lines if line not in printed] == []
    assert read(book).inputs["objects"] == read(by_command).inputs["objects"]


def test_a_size_that_few_have_is_asked_about_on_the_page_and_answered_by_a_unit(tmp_path):
    book = blank(tmp_path / "input.xlsx", UnitsFirst.US)
    drawn(tmp_path, factor=FEET_DRAWN_AS_INCHES, unit="in")
    before = book.read_bytes()
    (problem,) = plan_read(book)["problems"]
    assert "Unit on the page): ft or m, or in if it is so, as it states" in json.dumps(problem)
    assert book.read_bytes() == before
    assert plan_read(book, "in") == {"answer": {"lines": []}}
    lines = plan_read(book, "ft")["answer"]["lines"]
    assert lines[0].startswith("the plan as a whole is 12 times as large")


@pytest.mark.nightly
def test_an_unknown_unit_is_refused(tmp_path):
    book = blank(tmp_path / "input.xlsx", UnitsFirst.US)
    drawn(tmp_path)
    problems = json.dumps(plan_read(book, "furlong")["problems"])
    assert "the drawing does not state its unit" in problems
