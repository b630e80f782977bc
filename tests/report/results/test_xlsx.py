"""results.xlsx: its formulas, evaluated here independently, give its values."""

import datetime as dt
import io
import math
import re
from dataclasses import replace

import openpyxl
import pytest

import stand_in
from report.assessment.spectra import spectra
from report.results.xlsx import results_xlsx
from report.sheet.schema import Direction


def xlsx(assessment):
    return results_xlsx(assessment, spectra(assessment))


def opened(content):
    """The formulas and the values of a workbook."""
    return [openpyxl.load_workbook(io.BytesIO(content), data_only=flag) for flag in (False, True)]


def short():
    return stand_in.motions(seconds=10.0)


def made(book):
    return opened(xlsx(stand_in.assessed(book)))


@pytest.fixture(scope="module")
def assessment():
    return stand_in.assessed(stand_in.book())


@pytest.fixture(scope="module")
def content(assessment):
    return xlsx(assessment)


@pytest.fixture(scope="module")
def usual(content):
    return opened(content)


class Text(str):
    """A text in a formula: larger than any number, and an error in arithmetic, as in Excel."""

    def __gt__(self, other):
        return True if isinstance(other, float | int) else str.__gt__(self, other)

    def __lt__(self, other):
        return False if isinstance(other, float | int) else str.__lt__(self, other)

    def __le__(self, other):
        return self < other or self == other

    def _error(self, *_):
        return Text("#VALUE!")

    __mul__ = __rmul__ = __sub__ = __rsub__ = __truediv__ = __rtruediv__ = _error


class Number(float):
    """A number in a formula; division by zero is no error until its value is used."""

    def __truediv__(self, other):
        return math.nan if other == 0 else float(self) / other

    def __gt__(self, other):
        return False if isinstance(other, str) else float(self) > other


def numbers(items):
    return [item for item in items if not isinstance(item, str)]


FUNCTIONS = {
    "MAX": lambda *items: max(numbers(items)),
    "COUNT": lambda *items: len(numbers(items)),
    "AVERAGE": lambda *items: sum(numbers(items)) / len(numbers(items)),
    "IF": lambda test, yes, no: yes if test else no,
    "OR": lambda *items: any(items),
    "AND": lambda *items: all(items),
    "ISTEXT": lambda item: isinstance(item, str),
    "ISNUMBER": lambda item: not isinstance(item, str),
    "Text": Text,
    "Number": Number,
}


def compute(book, sheet, cell, known):
    """Evaluate a cell of a workbook, once: only what the result formulas use."""
    if (sheet, cell) not in known:
        known[sheet, cell] = evaluated(book, sheet, cell, known)
    return known[sheet, cell]


def evaluated(book, sheet, cell, known):
    value = book[sheet][cell].value
    if not (isinstance(value, str) and value.startswith("=")):
        return value
    if book[sheet][cell].data_type != "f":
        return value

    def shown(value):
        return f"Text({value!r})" if isinstance(value, str) else f"Number({value!r})"

    def reference(match):
        if match["quoted"]:
            return match["quoted"]
        where = match["sheet"] or sheet
        if match["first"]:
            block = book[where][f"{match['first']}:{match['last']}"]
            found = (compute(book, where, c.coordinate, known) for row in block for c in row)
            return ",".join(map(shown, found))
        return shown(compute(book, where, match["cell"].replace("$", ""), known))

    at = r"\$?[A-Z]{1,2}\$?\d+"
    area = rf"(?P<first>{at}):(?P<last>{at})"
    pattern = rf'(?P<quoted>"[^"]*")|(?:(?P<sheet>\w+)!)?(?:{area}|(?P<cell>{at})\b)'
    parts = re.split(r'("[^"]*")', value[1:])
    text = "".join(
        part
        if part.startswith('"')
        else re.sub(r"(?<![<>])=(?!=)", "==", part).replace("^", "**").replace("&", "+")
        for part in parts
    )
    return eval(re.sub(pattern, reference, text), {"__builtins__": {}}, FUNCTIONS)


SITE = stand_in.project().site.model_dump()
CASES = {
    "PV1": {},
    "PV1, low category": {"site": SITE | {"sdc": "C", "s_ds_g": 0.45}},
    "ASCE 7-16": {"site": SITE | {"rule_set": "ASCE 7-16", "risk_category": "III", "i_e": 1.25}},
    "peer reviewed": {"options": {"peer_reviewed": True, "statistic": "1.1 x largest"}},
    "a row of linked blocks": {
        "links": [stand_in.links("A1", "0.40, 0.50", 50), stand_in.links("A3", "0.55, 0.55", 50)],
        "options": {"peer_reviewed": True},
    },
    "prescriptive, by direction": {
        "site": SITE | {"s_ds_g": 1.0},
        "options": {"directional": True, "statistic": "mean"},
    },
    "a row beside a model that is requested": {
        "arrays": [stand_in.array("A1", 0.5, model="one axis")],
        "clearances": [],
        "links": [stand_in.links("A1", "0.40, 0.50", 50)],
    },
}


@pytest.mark.parametrize("case", CASES)
def test_every_formula_gives_the_value_written_with_it(case):
    formulas, values = made(stand_in.book(stand_in.project(**CASES[case]), short()))
    assert check_formulas(formulas, values) > 50


def check_formulas(formulas, values):
    """Hold every formula against the value written with it; return how many there are."""
    checked, known = 0, {}
    for sheet in formulas:
        for row in sheet.iter_rows():
            for cell in row:
                if cell.data_type == "f":
                    cached = values[sheet.title][cell.coordinate].value
                    value = compute(formulas, sheet.title, cell.coordinate, known)
                    if not isinstance(cached, str):
                        cached = pytest.approx(cached, rel=1e-12, abs=1e-12)
                    assert value == cached, cell
                    checked += 1
    return checked


def test_the_effect_of_links_follows_from_their_runs():
    data = stand_in.project(**CASES["a row of linked blocks"])
    assessment = stand_in.assessed(stand_in.book(data, short()))
    formulas, values = opened(xlsx(assessment))
    first, second = assessment.linked
    rows = list(values["LinkRuns"].iter_rows(min_row=2, values_only=True))
    assert len(rows) == 2 * 28
    assert rows[0][5] == pytest.approx(first.motions[0].runs[0].prd_m / 0.0254)
    assert rows[0][7].split(", ")[0] == f"{first.motions[0].runs[0].row.prd_m[0] / 0.0254:.2f}"
    sheet = values["Links"]
    assert [sheet[f"{c}5"].value for c in "ALO"] == [
        "A1", pytest.approx(first.estimated_m / 0.0254), "NG",
    ]  # fmt: skip
    assert [sheet[f"{c}6"].value for c in "AO"] == ["A3", "OK"]
    assert formulas["Links"]["I6"].value == "=H6/G6"
    assert formulas["Links"]["M6"].value == "=Design!N7"
    assert sheet["L6"].value == pytest.approx(second.design.design_m / 0.0254)


def test_without_rows_of_linked_blocks_the_workbook_has_no_links_sheets(usual):
    formulas, _ = usual
    assert not {"Links", "LinkRuns"} & set(formulas.sheetnames)


def test_a_row_without_a_value_is_ng_in_the_workbook():
    data = stand_in.project(links=[stand_in.links("A1", "0.40, 0.50", 50)])
    _, values = made(stand_in.book(data, stand_in.motions(2, seconds=8.0)))
    assert [values["Links"][f"{c}5"].value for c in "ALO"] == ["A1", "none", "NG"]


def test_the_prescriptive_value_is_a_live_formula(usual):
    formulas, values = usual
    assert formulas["Design"]["F5"].value == "=MAX(C5*D5*MAX(B5-0.4,0)^2,E5)"
    assert values["Design"]["F5"].value == pytest.approx(81.573, abs=5e-4)


def test_a_clearance_follows_from_the_runs_through_its_direction():
    options = {
        "peer_reviewed": True,
        "directional": True,
        "directional_reason": "test",
        "directional_reviewer": "Reviewer of record",
        "directional_license": "CA S0000",
        "directional_date": dt.date(2026, 3, 1),
    }
    assessment = stand_in.assessed(stand_in.book(stand_in.project(options=options)))
    formulas, values = opened(xlsx(assessment))
    gap = assessment.clearances[3]
    assert (gap.governing_array, gap.governing_direction) == ("A3", Direction.UP)
    assert values["Clearances"]["E8"].value == "A3, up"
    source = formulas["Clearances"]["F8"].value
    row = re.fullmatch(r"=Directions!\$H\$(\d+)", source)[1]
    head = [cell.value for cell in formulas["Directions"][4]]
    assert (values["Directions"][f"A{row}"].value, values["Directions"][f"B{row}"].value) == (
        "A3",
        "up",
    )
    assert values["Directions"][f"H{row}"].value == pytest.approx(gap.design_m / 0.0254)
    assert head[7] == "In this direction [in]"
    peaks = re.fullmatch(
        r"=AVERAGE\(Peaks!D(\d+):D(\d+)\)", formulas["Directions"][f"C{row}"].value
    )
    assert int(peaks[2]) - int(peaks[1]) == 6
    assert formulas["Peaks"][f"D{peaks[1]}"].value.startswith("=MAX(Runs!")


def test_a_clearance_takes_the_full_displacement_of_the_sheet_design(assessment, usual):
    formulas, values = usual
    gap = assessment.clearances[3]
    assert values["Clearances"]["E8"].value == "A3, any"
    assert formulas["Clearances"]["F8"].value == "=Design!$N$7"
    assert values["Design"]["N7"].value == pytest.approx(gap.design_m / 0.0254)


def test_the_model_of_every_run_is_listed(usual):
    _, values = usual
    head, first, *_ = values["Runs"].iter_rows(values_only=True)
    assert first[head.index("Model")] == "3, two axes with vertical"
    assert "second horizontal component" in first[head.index("Reason")]
    assert first[head.index("Cross-slope [in]")] > 0.0


def test_without_a_value_the_workbook_states_no_value_and_no_verdict():
    _, values = made(stand_in.book(stand_in.steep(), stand_in.motions(2)))
    assert values["Design"]["N5"].value == "none"
    assert values["Clearances"]["I5"].value == "none"
    assert values["Clearances"]["M5"].value == "none"
    assert values["Design"]["S5"].value == "NG"


def test_text_that_looks_like_a_formula_stays_text():
    data = stand_in.project(arrays=[stand_in.array("=1+1", 1.0)], clearances=[])
    formulas, _ = made(stand_in.book(data, short()))
    for sheet, cell in (("Design", "A5"), ("Runs", "A2")):
        assert (formulas[sheet][cell].value, formulas[sheet][cell].data_type) == ("=1+1", "s")


def test_every_run_is_listed(usual):
    _, values = usual
    rows = list(values["Runs"].iter_rows(min_row=2, values_only=True))
    assert len(rows) == 3 * 7 * 4
    assert sum(row[4] == "yes" for row in rows) == 3 * 7


def test_the_spectrum_of_every_motion_is_listed_by_component(usual):
    _, values = usual
    head = [cell.value for cell in values["Spectra"][1]]
    assert head[:3] == ["Period [s]", "Horizontal, target [g]", "Horizontal, M1 [g]"]
    assert len(head) == 1 + 3 * 8
    assert "Transverse, M7 [g]" in head


def test_two_runs_give_the_same_bytes(assessment, content, usual):
    assert xlsx(assessment) == content
    formulas, _ = usual
    assert formulas.properties.created.date() == assessment.sheet.project.project.date


def test_the_processing_of_each_component_is_listed(usual):
    _, values = usual
    head, *rows = values["Motions"].iter_rows(values_only=True)
    assert len(rows) == 7 * 3
    assert rows[1][:5] == ("M1", "transverse", "roof", "as recorded", "as recorded")
    assert rows[0][head.index("PGA [g]")] == pytest.approx(1.7)


@pytest.mark.parametrize("count", [2, 3])
def test_the_prescriptive_route_has_one_design_value_in_every_direction(count):
    """Of two motions there is no value from analysis; three give one that lacks components."""
    shaking = [replace(motion, ay_mps2=stand_in.NO_RECORD) for motion in stand_in.motions(count)]
    assessment = stand_in.assessed(stand_in.book(shaking=tuple(shaking)))
    formulas, values = opened(xlsx(assessment))
    for row, item in enumerate(assessment.arrays):
        assert item.governs == "prescriptive"
        for cell in (f"{column}{5 + 4 * row + k}" for column in "HI" for k in range(4)):
            assert values["Directions"][cell].value == pytest.approx(item.design_m / 0.0254)
        assert formulas["Directions"][f"H{5 + 4 * row}"].value == f"=Design!N{5 + row}"


def test_every_requirement_and_limit_and_every_verdict_is_in_the_workbook(assessment, usual):
    _, values = usual
    first = values.worksheets[0]
    assert [first["A3"].value, first["B3"].value] == ["Verdict", assessment.verdict.value]
    words = [first.cell(5 + k, 19).value for k in range(3)]
    assert words == [assessment.array_verdict(item).value for item in assessment.arrays]
    rows = [row[:6] for row in values["Requirements"].iter_rows(min_row=5, values_only=True)]
    for row in assessment.rows:
        item = row.subject or "Project"
        cells = (item, row.title, row.found, row.limit, row.basis, row.verdict.value)
        assert rows.count(cells) == 1
    limits = [c for item in assessment.arrays for c in item.limits]
    motions = assessment.acceptance.rows
    count = len(assessment.rows) + len(assessment.building_checks) + len(limits) + len(motions)
    assert len(rows) == count
    slope = next(c for c in limits if c.measure == "deg")
    found = next(row for row in rows if row[:2] == ("A1", slope.title))
    assert float(found[2].removesuffix(" deg")) == pytest.approx(slope.value, rel=1e-5)
    assert found[5] == ("OK" if slope.ok else "NG")


def test_a_limit_that_is_not_satisfied_is_ng_in_the_workbook():
    _, values = made(stand_in.book(stand_in.steep(), stand_in.motions(2, seconds=4.0)))
    assert values.worksheets[0]["B3"].value == "NG"
    rows = list(values["Requirements"].iter_rows(min_row=5, values_only=True))
    assert any(row[0] == "Motions" and row[5] == "not satisfied: NG" for row in rows)


def test_the_workbook_has_no_verdict_where_no_route_is_permitted():
    assessment = stand_in.unpermitted(links=[stand_in.links("A1", "0.3, 0.3", 50)])
    formulas, values = opened(xlsx(assessment))
    check_formulas(formulas, values)
    rows = rows_of(values["Clearances"])
    assert [row["Governing array, direction"] for row in rows[:2]] == ["A1, any"] * 2
    for row in rows[:2]:
        headings = ("Design [in]", "Required [in]", "Required [mm]", "D/C", "Result")
        assert [row[heading] for heading in headings] == ["none"] * 5
    assert rows[2]["Result"] == "OK"
    assert [row["Verdict"] for row in rows_of(values["Design"])] == ["NG", "NG"]
    assert rows_of(values["Links"])[0]["Result"] == "NG"


def rows_of(sheet):
    """The rows of a sheet below its headings, by heading."""
    head, *rows = sheet.iter_rows(min_row=4, values_only=True)
    return [dict(zip(head, row, strict=True)) for row in rows]
