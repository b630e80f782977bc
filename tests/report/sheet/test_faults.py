"""Input errors are reported by cell: what was found, and what to give."""

import datetime as dt
import re

import pytest
from openpyxl.utils import coordinate_to_tuple, get_column_letter

from places import ROOT
from report.sheet.fields import Place
from report.sheet.read import read
from report.sheet.schema import UnitsFirst
from sheets import edit, make, problems, read_workbook, type_into
from solver.model import InputError


def together(folder, cases, touched):
    """Return what is reported for each case, in a workbook that it shares with others.

    Cases, cells with their contents, share one if they touch nothing in common.
    """
    books, taken, numbers = [], [], []
    for cells, places in zip(cases, touched, strict=True):
        number = next((k for k, other in enumerate(taken) if not other & places), len(books))
        if number == len(books):
            books.append({})
            taken.append(set())
        books[number] |= cells
        taken[number] |= places
        numbers.append(number)
    reported = [problems(type_into(make(folder / str(k)), book)) for k, book in enumerate(books)]
    return [reported[number] for number in numbers]


# Sheet, cell, its content, and the resulting line.
SINGLE_CELLS = [
    ("Arrays", "E8", "abc", "friction coefficient is 'abc'; give a number from 0 to 1.5"),
    ("Arrays", "E9", 1.7, "friction coefficient is 1.7; give a number from 0 to 1.5"),
    ("Arrays", "E8", -0.1, "friction coefficient is -0.1; give a number from 0 to 1.5"),
    ("Arrays", "E9", "0,45", "friction coefficient is '0,45'; write 0.45"),
    ("Arrays", "E8", ",45", "friction coefficient is ',45'; write 0.45"),
    ("Arrays", "H8", "42,000", "weight is '42,000'; write 42000, without a comma"),
    ("Arrays", "H8", 0, "weight is 0; give a number of more than 0 [lb]"),
    (
        "Arrays",
        "H8",
        "42 kip",
        "weight is '42 kip'; give a number of more than 0 [lb], with no unit in the cell",
    ),
    ("Arrays", "E9", None, "friction coefficient is missing; give a number from 0 to 1.5"),
    ("Arrays", "E8", "  ", "friction coefficient is missing; give a number from 0 to 1.5"),
    ("Arrays", "E9", "nan", "friction coefficient is 'nan'; give a number from 0 to 1.5"),
    ("Arrays", "E8", "1e999", "friction coefficient is '1e999'; give a number from 0 to 1.5"),
    ("Arrays", "E9", "0_4", "friction coefficient is '0_4'; give a number from 0 to 1.5"),
    ("Arrays", "E8", "٠.٤", "friction coefficient is '٠.٤'; give a number from 0 to 1.5"),
    (
        "Arrays",
        "E9",
        True,
        "friction coefficient is TRUE, a logical value; give a number from 0 to 1.5",
    ),
    (
        "Arrays",
        "C8",
        dt.datetime(2024, 5, 3),
        "slope is a date or time (2024-05-03); give a number of 0 or more, formatted as a number",
    ),
    (
        "Arrays",
        "C8",
        dt.time(2, 30),
        "slope is a date or time (02:30:00); give a number of 0 or more, formatted as a number",
    ),
    (
        "Arrays",
        "E8",
        "#DIV/0!",
        "friction coefficient is #DIV/0!; correct the formula, or type a value",
    ),
    ("Arrays", "E9", "#N/A", "friction coefficient is #N/A; correct the formula, or type a value"),
    (
        "Arrays",
        "E8",
        "=0.4+0.05",
        "friction coefficient is a formula with no saved value (=0.4+0.05); open the workbook in"
        " Excel or LibreOffice and save it",
    ),
    (
        "Arrays",
        "H8",
        1e308,
        "weight is 1e+308; give a number of more than 0 [lb], below 1e+15 in size",
    ),
    (
        "Arrays",
        "K8",
        -1e300,
        "x from is -1e+300; give a number [ft], below 1e+15 in size",
    ),
    (
        "Project",
        "B6",
        "a\u2028b",
        "project number is 'a?b', with control characters; retype it",
    ),
    (
        "Project",
        "B6",
        "a\u202eb\u2066c",
        "project number is 'a?b?c', with control characters; retype it",
    ),
    ("Options", "C35", -1, "value is -1 for parapet_height_in; give a number from 0 to 240"),
    ("Options", "C35", 1e9, "value is 1e+09 for parapet_height_in; give a number from 0 to 240"),
    ("Arrays", "D8", "deg", "slope unit is 'deg'; choose degrees, percent or in/12"),
    ("Arrays", "B8", "A" * 41, "ID is 'A{40}'; give text of at most 40 characters"),
    ("Arrays", "B8", None, "ID is missing; give text such as 'A1'"),
    (
        "Arrays",
        "I8",
        "9 in",
        "CG height is '9 in'; give a number of more than 0 [in], with no unit in the cell",
    ),
    (
        "Arrays",
        "F8",
        "x" * 2001,
        "friction test report is 2001 characters long; give text of at most 2000 characters",
    ),
    (
        "Project",
        "B6",
        dt.datetime(2024, 3, 5),
        "project number is 2024-03-05, which is not text; format the cell as text and retype it",
    ),
    (
        "Project",
        "B5",
        "A_x0007_B",
        "project name is 'A?B', with control characters; retype it",
    ),
    (
        "Project",
        "B5",
        "A_xFFFE_B",  # so Excel writes a character that XML does not allow
        "project name is 'A?B', with control characters; retype it",
    ),
    (
        "Project",
        "B6",
        "_xFFFF_",
        "project number is '?', with control characters; retype it",
    ),
    ("Arrays", "B8", "\u200b", "ID is missing; give text such as 'A1'"),
    ("Motions", "B9", " \u200b\ufeff\u2060 ", "ID is missing; give text such as 'M1'"),
    ("Project", "B11", "3/5/26", "date is '3/5/26'; give a date such as 2026-03-05"),
    (
        "Project",
        "B11",
        3.5,  # in a cell that is formatted as a date
        "date is 1900-01-03, before 2000-01-01; give a date such as 2026-03-05",
    ),
    ("Project", "B11", True, "date is TRUE; give a date such as 2026-03-05"),
    ("Site", "B15", 1.5, "number of stories is 1.5; give a whole number from 1 to 200"),
    ("Site", "B15", 0, "number of stories is 0; give a whole number from 1 to 200"),
    (
        "Site",
        "B5",
        "ASCE 7-10",
        "rule set is 'ASCE 7-10'; choose SEAOC PV1-2012, ASCE 7-16 or ASCE 7-22",
    ),
    ("Site", "B13", 7, "S_DS is 7; give a number of more than 0 to 5 [g]"),
    ("Motions", "G8", 0, "time step is 0; give a number of more than 0 to 1 [s]"),
    ("Motions", "G8", -0.01, "time step is -0.01; give a number of more than 0 to 1 [s]"),
    ("Options", "B6", "maybe", "peer review is 'maybe'; choose Yes or No"),
]


@pytest.fixture(scope="module")
def of_cells(tmp_path_factory):
    cases = [{f"{sheet}!{cell}": value} for sheet, cell, value, _ in SINGLE_CELLS]
    reported = together(tmp_path_factory.mktemp("cells"), cases, map(set, cases))
    return dict(zip(SINGLE_CELLS, reported, strict=True))


@pytest.mark.parametrize(
    "case", SINGLE_CELLS, ids=[f"{s}!{c} {str(v)[:20]!r}" for s, c, v, _ in SINGLE_CELLS]
)
def test_an_invalid_cell_is_named_with_its_content_and_what_to_give(of_cells, case):
    sheet, cell, _, line = case
    assert f"{sheet}!{cell}: {line.replace('A{40}', 'A' * 41)}" in of_cells[case]


# Cells that are changed together, and all resulting lines.
CONTRADICTIONS = [
    (
        {"Arrays!B9": "a1", "Clearances!C8": "RTU-1"},
        [
            "Arrays!B9: ID is 'a1', already used at Arrays!B8; give a unique ID",
            "Clearances!B10: array is 'A2', which is not in Arrays; give one of A1, a1",
            "Clearances!B11: array is 'A2', which is not in Arrays; give one of A1, a1",
            "Clearances!B12: array is 'A2', which is not in Arrays; give one of A1, a1",
        ],
    ),
    (
        {"Objects!B9": "A1", "Clearances!C11": "S", "Clearances!E11": 9},
        ["Objects!B9: ID is 'A1', already used at Arrays!B8; give a unique ID"],
    ),
    (
        {"Motions!B10": "m1"},
        ["Motions!B10: ID is 'm1', already used at Motions!B8; give a unique ID"],
    ),
    (
        {"Clearances!C10": "rtu-1"},
        [
            "Clearances!C10: object is 'rtu-1', which is not in Objects or Arrays; did you"
            " mean 'RTU-1'?"
        ],
    ),
    (
        {"Clearances!C10": "chimney"},
        [
            "Clearances!C10: object is 'chimney', which is not in Objects or Arrays; give one of"
            " RTU-1, OLD, N, S, A1, A2"
        ],
    ),
    (
        {"Clearances!B9": "RTU-1"},
        ["Clearances!B9: array is 'RTU-1', which is not in Arrays; give one of A1, A2"],
    ),
    (
        {"Clearances!C8": "A1"},
        ["Clearances!C8: object is 'A1', the array itself; give an object or another array"],
    ),
    (
        {"Clearances!C11": "RTU-1", "Clearances!E11": 50},
        [
            "Clearances!B11: array is 'A2', with the same object and direction as at"
            " Clearances!B10; delete one"
        ],
    ),
    (
        {"Clearances!E10": 61},
        [
            "Clearances!E10: provided clearance is 61.0 in (1549 mm), but A2 and RTU-1 are 60.0 in"
            " (1524 mm) apart in plan; reduce it, or correct the rectangles in"
            " Arrays!K9:N9 and Objects!E8:H8"
        ],
    ),
    (
        {"Objects!G8": 70},
        [
            "Clearances!E10: provided clearance is 60.0 in (1524 mm), but A2 and RTU-1 overlap in"
            " plan; correct their rectangles in Arrays!K9:N9 and Objects!E8:H8"
        ],
    ),
    (
        {"Clearances!E8": 121},
        [
            "Clearances!E8: provided clearance is 121.0 in (3073 mm), but A1 and A2 are 120.0 in"
            " (3048 mm) apart in plan; reduce it, or correct the rectangles in"
            " Arrays!K8:N8 and Arrays!K9:N9"
        ],
    ),
    (
        {"Arrays!L8": 120},
        [
            "Clearances!E8: provided clearance is 120.0 in (3048 mm), but A1 and A2 overlap in"
            " plan; correct their rectangles in Arrays!K8:N8 and Arrays!K9:N9"
        ],
    ),
    (
        {"Arrays!L8": 120} | {f"Clearances!{column}8": None for column in "BCDE"},
        ["Arrays!K8: A1 and A2 at Arrays!K9 overlap in plan; correct one of them"],
    ),
    (
        {"Objects!G8": 70} | {f"Clearances!{column}10": None for column in "BCDE"},
        ["Arrays!K9: A2 and RTU-1 at Objects!E8 overlap in plan; correct one of them"],
    ),
    (
        {"Site!B6": "IV", "Site!B7": 1.25},
        ["Site!B7: importance factor I_e is 1.25; give at least 1.5 for risk category IV"],
    ),
    (
        {"Site!B14": "C"},
        [
            "Site!B14: seismic design category is 'C'; S_DS = 1.566 g in risk category II requires"
            " D or higher (ASCE 7 Table 11.6-1)"
        ],
    ),
    (
        {"Site!B9": 0.75},
        [
            "Site!B14: seismic design category is 'D'; S_1 = 0.75 g in risk category II requires E"
            " or higher (ASCE 7 section 11.6)"
        ],
    ),
    ({"Site!B13": None}, ["Site!B13: S_DS is missing; give S_DS, S_MS, or both S_S and F_a"]),
    (
        {"Site!B13": None, "Site!B8": 1.97},
        ["Site!B11: F_a is missing; give S_DS, S_MS, or both S_S and F_a"],
    ),
    (
        {"Site!B13": None, "Site!B11": 1.2},
        ["Site!B8: S_S is missing; give S_DS, S_MS, or both S_S and F_a"],
    ),
    (
        {"Site!B8": 1.97, "Site!B11": 1.2},
        [
            "Site!B13: S_DS is 1.566 g, but 2/3 F_a S_S is 1.5760 g; leave one of them blank, or"
            " correct it"
        ],
    ),
    ({"Arrays!C8": 45}, ["Arrays!C8: slope is 45 degrees; give 0 to less than 45 degrees"]),
    ({"Arrays!C9": 120}, ["Arrays!C9: slope is 120 percent; give 0 to less than 100 percent"]),
    (
        {"Arrays!T8": 0.5},
        [
            "Arrays!U8: friction rate is missing; give high-velocity friction and friction rate,"
            " or neither"
        ],
    ),
    (
        {"Arrays!U9": 20, "Arrays!V9": 0.4},
        [
            "Arrays!T9: high-velocity friction is missing; give high-velocity friction and friction"
            " rate, or neither",
            "Arrays!V9: static friction is 0.4; give the friction coefficient, 0.45, or more",
        ],
    ),
    (
        {"Arrays!T8": 0.5, "Arrays!U8": 20, "Arrays!W8": "one axis"},
        [
            "Arrays!W8: model is 'one axis', which neglects velocity-dependent and static friction;"
            " select 'choose', or leave high-velocity and static friction blank"
        ],
    ),
    (
        {"Objects!D10": None},
        ["Objects!D10: height is missing; give the parapet's height above the roof"],
    ),
    (
        {"Objects!F8": None},
        ["Objects!F8: x to is missing; give all four sides of the rectangle, or none"],
    ),
    (
        {"Arrays!L8": 20},
        [
            "Arrays!L8: x to is 20.00 ft (6.10 m); give more than x from in Arrays!K8, 20.00 ft"
            " (6.10 m)"
        ],
    ),
    (
        {"Objects!H8": 70},
        [
            "Objects!H8: y to is 70.00 ft (21.34 m); give more than y from in Objects!G8, 80.00 ft"
            " (24.38 m)"
        ],
    ),
    ({"Motions!I9": None}, ["Motions!I9: factor or PPA is missing; give the factor"]),
    ({"Motions!I10": None}, ["Motions!I10: factor or PPA is missing; give the PPA in g"]),
    (
        {"Motions!D8": "records/x.csv"},
        [
            "Motions!D8: transverse record is 'records/x.csv', the same as the horizontal record;"
            " give another record"
        ],
    ),
    (
        {"Motions!H8": "target spectrum", "Motions!I8": 2},
        [
            "Motions!I8: factor or PPA is 2, but scaling is 'target spectrum'; change the"
            " scaling or leave this blank"
        ],
    ),
    (
        {"Motions!M8": 1.5, "Motions!N8": 1.5},
        ["Motions!N8: end time is 1.5 s; give more than the start time, 1.5 s"],
    ),
    (
        {"Motions!P8": 20, "Motions!Q8": 20},
        ["Motions!Q8: low-pass corner is 20 Hz; give more than the high-pass corner, 20 Hz"],
    ),
    (
        {"Motions!K9": "ground"},
        ["Building!B6: period T1 is missing; give it, or a structure type: Motions!K9 is 'ground'"],
    ),
    (
        {"Building!B7": 0.3},
        ["Building!B7: period T2 is 0.3 s; give period T1 as well, or leave it blank"],
    ),
    (
        {"Building!B6": 0.2, "Building!B7": 0.3},
        ["Building!B7: period T2 is 0.3 s; give at most period T1, 0.2 s, or leave it blank"],
    ),
    (
        {"Building!B6": 0.2, "Motions!K9": "ground", "Site!B15": 101},
        [
            "Site!B15: number of stories is 101, more than the 100 of the building model; give roof"
            " motions"
        ],
    ),
    (
        {"Spectrum!B8": 1, "Spectrum!C8": 1},
        ["Spectrum!B7: one row is given; give at least two, or none"],
    ),
    (
        {f"Spectrum!{c}{r}": 1 for r in (8, 9) for c in "BC"},
        ["Spectrum!B9: period is 1 s, already given at Spectrum!B8; give each period once"],
    ),
    (
        {f"Spectrum!{c}{r}": r for r in (8, 9) for c in "BC"} | {"Spectrum!D8": 1},
        ["Spectrum!D9: vertical is missing; give it in every row, or in none"],
    ),
    (
        {f"Spectrum!{c}{r}": r for r in (8, 9) for c in "BC"} | {"Motions!H8": "target spectrum"},
        [
            "Spectrum!B7: periods range from 8 to 9 s, but motions are scaled over 0.2 to 5 s; add"
            " rows, or change the scaling periods"
        ],
    ),
    (
        {"Options!B24": 5},
        ["Options!B25: longest scaling period is 5 s; give more than the shortest, 5 s"],
    ),
    (
        {"Motions!H8": "target spectrum", "Motions!P8": 0.5},
        [
            "Motions!P8: high-pass corner is 0.5 Hz, a period of 2 s, but the longest scaling"
            " period is 5 s; reduce one of them"
        ],
    ),
    (
        {"Motions!H8": "target spectrum", "Motions!K8": "ground", "Building!B6": 0.5},
        [
            "Site!B12: F_v is missing; Motions!H8 scales a ground motion to the design spectrum,"
            " which requires S_D1, or S_1 and F_v, and T_L",
            "Options!B23: long-period transition T_L is missing; Motions!H8 scales a ground motion"
            " to the design spectrum, which requires S_D1, or S_1 and F_v, and T_L",
        ],
    ),
    (
        {"Options!B23": 0.5, "Site!B12": 1.7},
        [
            "Options!B23: long-period transition T_L is 0.5 s; give more than T_S = S_D1/S_DS ="
            " 0.507 s"
        ],
    ),
    (
        {"Motions!I8": 2},
        [
            "Motions!I8: factor or PPA is 2, but scaling is 'as recorded'; change the scaling or"
            " leave this blank"
        ],
    ),
    (
        {f"Options!{c}36": v for c, v in zip("BCD", ("parapet_height_in", 20, "x"), strict=True)},
        ["Options!B36: provision is 'parapet_height_in', already given at Options!B35; delete one"],
    ),
    (
        {"Site!B8": 2.4},
        [
            "Site!B13: S_DS is 1.566 g; give at least 1.6 g, which is 2/3 F_a S_S with F_a of 1 for"
            " site class 'D' (ASCE 7-16 Table 11.4-1†), or select the hazard basis 'site-specific"
            " analysis' and give its report"
        ],
    ),
]


def sheets_of(case):
    """The sheets that a case changes, or names in its lines."""
    cells, lines = case
    return {name for text in (*cells, *lines) for name in re.findall(r"\b([A-Z][a-z]+)!", text)}


@pytest.fixture(scope="module")
def of_contradictions(tmp_path_factory):
    folder = tmp_path_factory.mktemp("contradictions")
    return together(folder, [cells for cells, _ in CONTRADICTIONS], map(sheets_of, CONTRADICTIONS))


@pytest.mark.parametrize(
    "number", range(len(CONTRADICTIONS)), ids=[" ".join(cells) for cells, _ in CONTRADICTIONS]
)
def test_inconsistencies_are_reported_at_the_cell_to_change(of_contradictions, number):
    """And nothing else is, on the sheets of the case."""
    case, reported = CONTRADICTIONS[number], of_contradictions[number]
    own = sheets_of(case)
    assert [line for line in reported if line.partition("!")[0] in own] == case[1]


def test_nothing_else_is_reported_beside_inconsistencies(of_contradictions):
    known = {line for _, lines in CONTRADICTIONS for line in lines}
    assert {line for reported in of_contradictions for line in reported} == known


def test_lengths_are_given_in_the_units_of_the_project_first(tmp_path):
    assert problems(type_into(make(tmp_path), {"Project!B13": "SI", "Arrays!N8": 10})) == (
        "Arrays!N8: y to is 3.05 m (10.00 ft); give more than y from in Arrays!M8, 4.57 m"
        " (15.00 ft)",
    )


def test_an_unknown_provision_is_reported_with_the_valid_ones(tmp_path):
    path = type_into(make(tmp_path), {"Options!B35": "parapet"})
    (line,) = problems(path)
    assert line.startswith("Options!B35: provision is 'parapet'; choose one of prescriptive_fac")


def test_all_errors_are_reported_together_in_the_order_of_the_sheets(tmp_path):
    changes = {
        "Motions!C8": "records/none.csv",
        "Arrays!E9": "abc",
        "Project!B5": None,
        "Site!B14": "C",
        "Arrays!C8": 50,
        "Clearances!E10": 61,
        "Objects!D8": "tall",
    }
    addresses = [line.split(": ")[0] for line in problems(type_into(make(tmp_path), changes))]
    assert addresses == [
        "Project!B5",
        "Site!B14",
        "Arrays!C8",
        "Arrays!E9",
        "Objects!D8",
        "Clearances!E10",
        "Motions!C8",
    ]


def test_a_percentage_is_not_a_number_in_percent(tmp_path):
    def change(book):
        book["Arrays"]["C9"] = 0.05
        book["Arrays"]["C9"].number_format = "0.0%"

    assert problems(edit(make(tmp_path), change)) == (
        "Arrays!C9: slope is a percentage (5%, which Excel holds as 0.05); give a number of 0 or"
        " more, formatted as a number",
    )


# Section and field, unit of the sheet, number format, and how it shows the number.
MISLEADING = [
    ("arrays", "cg_height_m", '0" mm"', "CG height is 9, shown in mm", "more than 0 [in]"),
    ("arrays", "weight_n", '0.0"kg"', "weight is 42000, shown in kg", "more than 0 [lb]"),
    ("arrays", "weight_n", "0,", "weight is 42000, shown divided by 1,000", "more than 0 [lb]"),
    ("arrays", "mu", '0.00"g"', "friction coefficient is 0.45, shown in g", "from 0 to 1.5"),
    ("arrays", "slope_value", '0.0"%"', "slope is 0.5, shown in %", "0 or more"),
    ("site", "structure_height_m", '0.0" m"', "structure height h is 36, shown in m", "0 [ft]"),
    ("overrides", "value", '0" ft"', "value is 18, shown in ft", "give a number"),
    ("motions", "scale_value", '0.0"g"', "factor or PPA is 2, shown in g", "more than 0"),
]


def formatted(path, section, field, code, row=0):
    """Give an input a number format; return its address."""
    address = read(path).addresses[Place(section, row, field)]
    sheet, cell = address.split("!")
    edit(path, lambda book: setattr(book[sheet][cell], "number_format", code))
    return address


@pytest.mark.parametrize(("section", "field", "code", "what", "wish"), MISLEADING)
@pytest.mark.by_day(3)
def test_a_number_shown_in_another_unit_or_in_thousands_is_an_error(
    tmp_path, section, field, code, what, wish
):
    path = make(tmp_path)
    row = 1 if section == "motions" else 0
    address = formatted(path, section, field, code, row)
    (line,) = problems(path)
    assert line.startswith(f"{address}: {what} by its number format ({code}); give a number")
    assert wish in line
    assert line.endswith(", formatted as a number")


@pytest.mark.parametrize(
    ("section", "field", "code", "row"),
    [
        ("arrays", "cg_height_m", '0.0" in"', 0),
        ("arrays", "weight_n", "#,##0", 0),
        ("arrays", "weight_n", '#,##0" lbs"', 0),
        ("arrays", "mu", '0.00" (lab)"', 0),
        ("arrays", "slope_value", "0.0°", 0),  # in degrees
        ("arrays", "slope_value", '0.0"%"', 1),  # in percent
        ("overrides", "value", '0" in"', 0),
        ("motions", "scale_value", '0.0"g"', 2),  # a PPA
        ("site", "s_ds_g", '0.000"g"', 0),
    ],
)
@pytest.mark.by_day(3)
def test_a_number_format_may_name_the_unit_of_its_cell(tmp_path, section, field, code, row):
    path = make(tmp_path)
    formatted(path, section, field, code, row)
    read_workbook(path)


def test_a_number_format_may_name_the_unit_of_a_sheet_in_si(tmp_path):
    path = make(tmp_path, UnitsFirst.SI)
    formatted(path, "arrays", "cg_height_m", '0.0" mm"')
    formatted(path, "site", "structure_height_m", '0.0" m"')
    read_workbook(path)


@pytest.mark.parametrize(("key", "noun"), [("arrays", "array"), ("motions", "motion")])
def test_at_least_one_row_is_required(tmp_path, key, noun):
    changes = {"clearances": [], key: []}
    assert problems(make(tmp_path, **changes)) == (
        f"{key.title()}!B7: no {noun} is given; fill in at least one row",
    )


def test_a_gap_may_be_rounded_by_half_an_inch_or_one_percent_up_to_an_inch(tmp_path):
    changes = {"Clearances!E10": 60.49, "Clearances!E8": 120.98, "Clearances!E11": 4000}
    assert read_workbook(type_into(make(tmp_path), changes)).input.clearances


def test_a_clearance_to_an_array_with_an_unreadable_plan_is_not_checked(tmp_path):
    assert problems(type_into(make(tmp_path), {"Arrays!L9": "abc"})) == (
        "Arrays!L9: x to is 'abc'; give a number [ft]",
    )


def test_a_missing_sheet_is_reported_once(tmp_path):
    path = edit(make(tmp_path), lambda book: book.remove(book["Arrays"]))
    assert problems(path) == (
        "Arrays: the sheet is missing: no table arrays_table and no row of its headings; copy it"
        " from a fresh workbook (roofslip new)",
    )


def test_a_missing_sheet_takes_no_other_table_for_its_own(tmp_path):
    path = edit(make(tmp_path), lambda book: book.remove(book["Objects"]))
    assert problems(path) == (
        "Objects: the sheet is missing: no table objects_table and no row of its headings; copy it"
        " from a fresh workbook (roofslip new)",
    )


def test_a_missing_sheet_of_single_fields_is_reported_once(tmp_path):
    path = edit(make(tmp_path), lambda book: book.remove(book["Site"]))
    assert problems(path) == (
        "Site: the sheet is missing, or all labels of Site and building; copy it from a fresh"
        " workbook (roofslip new)",
    )


def test_a_missing_single_field_is_reported_by_name_and_label(tmp_path):
    def change(book):
        del book.defined_names["project_number"]
        book["Project"]["A6"] = None

    assert problems(edit(make(tmp_path), change)) == (
        "Project: project number is missing (no name project_number and no label 'Project"
        " number'); copy it from a fresh workbook (roofslip new)",
    )


def test_a_missing_heading_is_reported(tmp_path):
    path = type_into(make(tmp_path), {"Arrays!E7": "Grip"})
    assert problems(path) == (
        "Arrays!E7: heading 'Friction coefficient' is missing, 'Grip' found; write it here in its"
        " own column, or copy it from a fresh workbook (roofslip new)",
    )


def test_a_deleted_required_column_is_pointed_at_where_it_was(tmp_path):
    path = edit(make(tmp_path), lambda book: book["Arrays"].delete_cols(8))
    assert problems(path) == (
        "Arrays!H7: heading 'Weight' is missing; write it here in its own column, or copy it from a"
        " fresh workbook (roofslip new)",
    )


def test_an_optional_column_may_be_deleted(tmp_path):
    path = edit(make(tmp_path), lambda book: book["Motions"].delete_cols(10))
    book = read_workbook(path)
    assert [motion.source for motion in book.input.motions] == ["", "", ""]


def test_a_renamed_optional_column_is_reported_not_ignored(tmp_path):
    path = type_into(make(tmp_path), {"Motions!E7": "Vertical file"})
    assert problems(path) == (
        "Motions!E7: heading 'Vertical record' is missing, 'Vertical file' found; write it here in"
        " its own column, or copy it from a fresh workbook (roofslip new)",
    )


def test_a_duplicate_heading_is_reported(tmp_path):
    path = type_into(make(tmp_path), {"Arrays!T7": "Slope"})
    assert problems(path) == ("Arrays!T7: heading 'Slope' appears twice; keep one",)


@pytest.mark.parametrize(
    "headings",
    [
        {
            "E7": ("Friction coefficient [%]", "friction coefficient is '%'; it has no unit: d"),
            "H7": ("Weight [t]", "weight is 't'; write one of lb, kip, N, kN, kg"),
            "I7": ("CG height", "CG height is missing; write one of in, ft, mm, cm, m"),
            "O7": ("Downslope direction [rad]", "downslope direction is 'rad'; give the number"),
        },
        {"I7": ("CG height [yd]", "CG height is 'yd'; write one of in, ft, mm, cm, m")},
    ],
)
def test_a_heading_must_have_a_valid_unit(tmp_path, headings):
    cells = {f"Arrays!{cell}": heading for cell, (heading, _) in headings.items()}
    reported = problems(type_into(make(tmp_path), cells))
    for line, (cell, (_, wanted)) in zip(reported, headings.items(), strict=True):
        assert line.startswith(f"Arrays!{cell}: unit of {wanted}")


def test_the_unit_of_a_single_field_must_be_valid(tmp_path):
    assert problems(type_into(make(tmp_path), {"Site!C16": "yd", "Site!C17": None})) == (
        "Site!C16: unit of structure height h is 'yd'; write one of in, ft, mm, cm, m",
        "Site!C17: unit of height of the array z is missing; write one of in, ft, mm, cm, m",
    )


@pytest.mark.parametrize(
    ("cell", "unit", "words"),
    [
        ("Site!C13", "m/s2", "S_DS is 'm/s2'; give the number in g, and write g"),
        ("Site!C11", "%", "F_a is '%'; it has no unit: delete it"),
        ("Building!C6", "Hz", "period T1 is 'Hz'; give the number in s, and write s"),
        ("Building!C9", "-", "damping is '-'; give the number in %, and write %"),
        ("Options!C23", "Hz", "long-period transition T_L is 'Hz'; give the number in s, and"),
    ],
)
@pytest.mark.by_day(2)
def test_a_unit_that_cannot_be_chosen_must_be_that_of_the_sheet(tmp_path, cell, unit, words):
    (line,) = problems(type_into(make(tmp_path), {cell: unit}))
    assert line.startswith(f"{cell}: unit of {words}")


def test_a_unit_that_cannot_be_chosen_may_be_blank(tmp_path):
    read_workbook(type_into(make(tmp_path), {"Site!C13": None, "Building!C6": " S "}))


def test_merged_cells_in_a_table_are_reported(tmp_path):
    path = edit(make(tmp_path), lambda book: book["Arrays"].merge_cells("F8:F9"))
    assert problems(path) == ("Arrays!F8:F9: cells are merged; unmerge them",)


@pytest.mark.parametrize("to", [(1, 0), (0, 1), (0, -1)], ids=["below", "unit", "label"])
@pytest.mark.by_day(1)
def test_merged_cells_that_cover_a_single_field_are_reported(tmp_path, to):
    path = make(tmp_path)
    sheet, cell = read(path).addresses[Place("site", 0, "structure_height_m")].split("!")
    row, column = coordinate_to_tuple(cell)
    ends = sorted([(row, column), (row + to[0], column + to[1])])
    area = ":".join(f"{get_column_letter(c)}{r}" for r, c in ends)
    edit(path, lambda book: book[sheet].merge_cells(area))
    assert problems(path) == (f"{sheet}!{area}: cells are merged; unmerge them",)


def test_cells_merged_beside_a_single_field_do_not_matter(tmp_path):
    path = make(tmp_path)
    sheet, cell = read(path).addresses[Place("project", 0, "name")].split("!")
    row, column = coordinate_to_tuple(cell)
    area = f"{cell}:{get_column_letter(column + 3)}{row}"
    edit(path, lambda book: book[sheet].merge_cells(area))
    assert read_workbook(path).input.project.name == "Alameda Warehouse"


def test_characters_of_no_width_at_the_ends_of_a_text_are_not_read(tmp_path):
    book = type_into(make(tmp_path), {"Motions!B8": "\ufeffM7\u200b \u200b"})
    assert read_workbook(book).input.motions[0].id == "M7"


@pytest.mark.parametrize(
    ("cell", "value"),
    [
        ("Site!B8", 1e-9),
        ("Site!B9", 1e-9),
        ("Site!B34", 1e9),
        ("Arrays!K8", 1e9),
        ("Arrays!M9", 1e9),
        ("Arrays!M8", 1e-9),
        ("Arrays!M10", 1e-9),
    ],
)
@pytest.mark.by_day(2)
def test_the_cell_of_an_extreme_value_is_named_where_another_cell_is_wrong_by_it(
    tmp_path, cell, value
):
    path = tmp_path / "input.xlsx"
    path.write_bytes((ROOT / "projects" / "example" / "input.xlsx").read_bytes())
    with pytest.raises(InputError) as caught:
        _ = read(type_into(path, {cell: value})).project
    sheet, name = cell.split("!")
    named = re.findall(rf"{sheet}!([A-Z]+)(\d+)(?::([A-Z]+)\2)?", str(caught.value))
    assert any(
        low <= name.rstrip("0123456789") <= (high or low) and name.endswith(row)
        for low, row, high in named
    ), caught.value
