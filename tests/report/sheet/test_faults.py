"""Input errors are reported by cell: what was found, and what to give."""

import datetime as dt
import re

import pytest
from openpyxl.utils import coordinate_to_tuple, get_column_letter

from cells import address, cell
from nightly import by_day
from places import ROOT
from report.sheet.checking.plan_checks import MOST_OVERLAPS
from report.sheet.reading.read import read
from report.sheet.schema.choices import UnitsFirst
from sheets import (
    arrays,
    at,
    edit,
    make,
    of,
    problems,
    put,
    read_workbook,
    said,
    type_into,
)
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


NUMBER = "give a number from 0 to 1.5"
RULE_SETS = "choose SEAOC PV1-2012, ASCE 7-16 or ASCE 7-22"
CONTROL = "with control characters; retype it"

# Cell, its content, how the line begins, and what it goes on with for each content.
PARAPET = "for the minimum height of a qualifying parapet above the roof [in]"
SINGLE_CELLS = [
    ("Arrays/A1/Friction coefficient", "friction coefficient is ", {
        "abc": f"'abc'; {NUMBER}", "0_4": f"'0_4'; {NUMBER}", "٠.٤": f"'٠.٤'; {NUMBER}",
        "  ": f"missing; {NUMBER}",
        -0.1: f"-0.1; {NUMBER}", "0.45 (dry 0.52)": f"'0.45 (dry 0.52)'; {NUMBER}",
        "#DIV/0!": "#DIV/0!; correct the formula, or type a value",
        "=0.4+0.05": "a formula with no saved value (=0.4+0.05); open the workbook in Excel or"
                     " LibreOffice and save it",
    }),
    ("Arrays/A2/Friction coefficient", "friction coefficient is ", {
        "nan": f"'nan'; {NUMBER}", "1e999": f"'1e999'; {NUMBER}", 1.7: f"1.7; {NUMBER}",
        True: f"TRUE, a logical value; {NUMBER}", None: f"missing; {NUMBER}",
        "0,45,5": f"'0,45,5'; {NUMBER}", "#N/A": "#N/A; correct the formula, or type a value",
    }),
    ("Arrays/A1/Weight", "weight is ", {
        "42,000": "'42,000'; write 42000, without a comma",
        0: "0; give a number of more than 0 [lb]",
        "42 kip": "'42 kip'; give a number of more than 0 [lb], with no unit in the cell",
        1e308: "1e+308; give a number of more than 0 [lb], below 1e+15 in size",
    }),
    ("Arrays/A1/CG height", "CG height is ", {
        "9 in": "'9 in'; give a number of more than 0 [in], with no unit in the cell",
    }),
    ("Arrays/A1/Slope", "slope is a date or time ", {
        dt.datetime(2024, 5, 3): "(2024-05-03); give a number of 0 or more, formatted as a number",
        dt.time(2, 30): "(02:30:00); give a number of 0 or more, formatted as a number",
    }),
    ("Arrays/A2/Slope", "slope is ", {
        "1/2:12": "'1/2:12'; give a number of 0 or more, or choose the slope unit in/12",
    }),
    ("Friction tests/1/Kinetic coefficient", "kinetic coefficient is ", {
        "0.45 (dry)": "'0.45 (dry)'; write the number alone, and dry in the column Surface",
    }),
    ("Arrays/A1/x from", "x from is ", {
        -1e300: "-1e+300; give a number [ft], below 1e+15 in size",
    }),
    ("Arrays/A1/Slope unit", "slope unit is ", {
        "rad": "'rad'; choose degrees, percent or in/12",
    }),
    ("Arrays/A1/ID", "ID is ", {
        "A" * 41: f"'{'A' * 41}'; give text of at most 40 characters",
        None: "missing; give text such as 'A1'", "\u200b": "missing; give text such as 'A1'",
    }),
    ("Arrays/A1/Friction test report", "friction test report is ", {
        "x" * 2001: "2001 characters long; give text of at most 2000 characters",
    }),
    ("Project/Project name", "project name is ", {
        "A_x0007_B": f"'A?B', {CONTROL}",
        "A_xFFFE_B": f"'A?B', {CONTROL}",  # so Excel writes a character that XML does not allow
    }),
    ("Project/Project number", "project number is ", {
        "a\u2028b": f"'a?b', {CONTROL}", "a\u202eb\u2066c": f"'a?b?c', {CONTROL}",
        "_xFFFF_": f"'?', {CONTROL}",
        dt.datetime(2024, 3, 5): "2024-03-05, which is not text; format the cell as text and retype"
                                 " it",
    }),
    ("Project/Date", "date is ", {
        "3/5/2026": "'3/5/2026'; write 2026-03-05 or 2026-05-03",
        "3/5/26": "'3/5/26'; give a date such as 2026-03-05",
        True: "TRUE; give a date such as 2026-03-05",
        # in a cell that is formatted as a date
        3.5: "1900-01-03, before 2000-01-01; give a date such as 2026-03-05",
    }),
    ("Site/Number of stories", "number of stories is ", {
        1.5: "1.5; give a whole number from 1 to 200", 0: "0; give a whole number from 1 to 200",
    }),
    ("Site/Rule set", "rule set is ", {"ASCE 7-10": f"'ASCE 7-10'; {RULE_SETS}"}),
    ("Site/S_DS", "S_DS is ", {7: "7; give a number of more than 0 to 5 [g]"}),
    ("Motions/M2/ID", "ID is ", {" \u200b\ufeff\u2060 ": "missing; give text such as 'M1'"}),
    ("Motions/M1/Time step", "time step is ", {
        0: "0; give a number of more than 0 to 1 [s]",
        -0.01: "-0.01; give a number of more than 0 to 1 [s]",
    }),
    ("Options/1/Value", "value is ", {
        -1: f"-1 {PARAPET}; give a number from 0 to 240",
        1e9: f"1e+09 {PARAPET}; give a number from 0 to 240",
    }),
    ("Options/Peer review", "peer review is ", {"maybe": "'maybe'; choose Yes or No"}),
]  # fmt: skip
CONTENTS = [
    (name, content, f"<{name}>: {begin}{line}")
    for name, begin, lines in SINGLE_CELLS
    for content, line in lines.items()
]


@pytest.fixture(scope="module")
def of_cells(tmp_path_factory):
    cases = [{name: content} for name, content, _ in CONTENTS]
    return together(tmp_path_factory.mktemp("cells"), cases, map(set, cases))


@pytest.mark.parametrize(
    "number", range(len(CONTENTS)), ids=[f"{name} {str(v)[:20]!r}" for name, v, _ in CONTENTS]
)
@pytest.mark.nightly
def test_an_invalid_cell_is_named_with_its_content_and_what_to_give(of_cells, number):
    assert at(CONTENTS[number][2]) in of_cells[number]


NO_CLEARANCE = dict.fromkeys(("Array", "Object", "Direction", "Provided clearance"))

# Cells that are changed together, and all resulting lines.
CONTRADICTIONS = [
    ({"Arrays/A2/ID": "a1", "Clearances/1/Object": "RTU-1"},
     "<Arrays/A2/ID>: ID is 'a1', already used at <Arrays/A1/ID>; give a unique ID",
     "<Clearances/3/Array>: array is 'A2', which is not in Arrays; give one of A1, a1",
     "<Clearances/4/Array>: array is 'A2', which is not in Arrays; give one of A1, a1",
     "<Clearances/5/Array>: array is 'A2', which is not in Arrays; give one of A1, a1"),
    ({"Objects/OLD/ID": "A1", "Clearances/4/Object": "S", "Clearances/4/Provided clearance": 9},
     "<Objects/OLD/ID>: ID is 'A1', already used at <Arrays/A1/ID>; give a unique ID"),
    ({"Motions/M3/ID": "m1"},
     "<Motions/M3/ID>: ID is 'm1', already used at <Motions/M1/ID>; give a unique ID"),
    ({"Clearances/3/Object": "rtu-1"},
     "<Clearances/3/Object>: object is 'rtu-1', which is not in Objects or Arrays; did you mean"
     " 'RTU-1'?"),
    ({"Clearances/3/Object": "chimney"},
     "<Clearances/3/Object>: object is 'chimney', which is not in Objects or Arrays; give one of"
     " RTU-1, OLD, N, S, A1, A2"),
    ({"Clearances/2/Array": "RTU-1"},
     "<Clearances/2/Array>: array is 'RTU-1', which is not in Arrays; give one of A1, A2"),
    ({"Clearances/1/Object": "A1"},
     "<Clearances/1/Object>: object is 'A1', the array itself; give an object or another array"),
    ({"Clearances/4/Object": "RTU-1", "Clearances/4/Provided clearance": 50},
     "<Clearances/4/Array>: array is 'A2', with the same object and direction as at"
     " <Clearances/3/Array>; delete one"),
    ({"Clearances/3/Provided clearance": 61},
     "<Clearances/3/Provided clearance>: provided clearance is 61.0 in (1549 mm), but A2 and"
     " RTU-1 are 60.0 in (1524 mm) apart in plan; reduce it, or correct the rectangles in"
     " <Arrays/A2/x from:y to> and <Objects/RTU-1/x from:y to>"),
    ({"Objects/RTU-1/y from": 70},
     "<Clearances/3/Provided clearance>: provided clearance is 60.0 in (1524 mm), but A2 and"
     " RTU-1 overlap in plan; correct their rectangles in <Arrays/A2/x from:y to> and"
     " <Objects/RTU-1/x from:y to>"),
    ({"Clearances/1/Provided clearance": 121},
     "<Clearances/1/Provided clearance>: provided clearance is 121.0 in (3073 mm), but A1 and A2"
     " are 120.0 in (3048 mm) apart in plan; reduce it, or correct the rectangles in"
     " <Arrays/A1/x from:y to> and <Arrays/A2/x from:y to>"),
    ({"Arrays/A1/x to": 120},
     "<Clearances/1/Provided clearance>: provided clearance is 120.0 in (3048 mm), but A1 and A2"
     " overlap in plan; correct their rectangles in <Arrays/A1/x from:y to> and <Arrays/A2/x"
     " from:y to>"),
    ({"Arrays/A1/x to": 120} | of("Clearances/1", NO_CLEARANCE),
     "<Arrays/A1/x from>: A1 and A2 at <Arrays/A2/x from> overlap in plan; correct one of them"),
    ({"Objects/RTU-1/y from": 70} | of("Clearances/3", NO_CLEARANCE),
     "<Arrays/A2/x from>: A2 and RTU-1 at <Objects/RTU-1/x from> overlap in plan; correct one of"
     " them"),
    ({"Site/Risk category": "IV", "Site/Importance factor I_e": 1.25},
     "<Site/Importance factor I_e>: importance factor I_e is 1.25; give at least 1.5 for risk"
     " category IV"),
    ({"Site/Seismic design category": "C"},
     "<Site/Seismic design category>: seismic design category is 'C'; S_DS = 1.566 g in risk"
     " category II requires D or higher (ASCE 7 Table 11.6-1)"),
    ({"Site/S_DS": None},
     "<Site/S_DS>: S_DS is missing; give S_DS, S_MS, or both S_S and F_a"),
    ({"Site/S_DS": None, "Site/S_S": 1.97, "Site/Site class": None},
     "<Site/F_a>: F_a is missing; give S_DS, S_MS, or both S_S and F_a"),
    ({"Site/S_DS": None, "Site/F_a": 1.2},
     "<Site/S_S>: S_S is missing; give S_DS, S_MS, or both S_S and F_a"),
    ({"Site/S_S": 1.97, "Site/F_a": 1.2},
     "<Site/S_DS>: S_DS is 1.566 g, but 2/3 F_a S_S is 1.5760 g; leave one of them blank, or"
     " correct it"),
    ({"Arrays/A1/Slope": 45},
     "<Arrays/A1/Slope>: slope is 45 degrees; give 0 to less than 45 degrees"),
    ({"Arrays/A2/Slope": 120},
     "<Arrays/A2/Slope>: slope is 120 percent; give 0 to less than 100 percent"),
    ({"Arrays/A1/High-velocity friction": 0.5},
     "<Arrays/A1/Friction rate>: friction rate is missing; give high-velocity friction and"
     " friction rate, or neither"),
    ({"Arrays/A2/Friction rate": 20, "Arrays/A2/Static friction": 0.4},
     "<Arrays/A2/High-velocity friction>: high-velocity friction is missing; give high-velocity"
     " friction and friction rate, or neither",
     "<Arrays/A2/Static friction>: static friction is 0.4; give the friction coefficient, 0.45,"
     " or more"),
    ({"Arrays/A1/High-velocity friction": 0.5, "Arrays/A1/Friction rate": 20,
      "Arrays/A1/Model": "one axis"},
     "<Arrays/A1/Model>: model is 'one axis', which neglects velocity-dependent and static"
     " friction; select 'choose', or leave high-velocity and static friction blank"),
    ({"Objects/N/Height": None},
     "<Objects/N/Height>: height is missing; give the parapet's height above the roof"),
    ({"Objects/RTU-1/x to": None},
     "<Objects/RTU-1/x to>: x to is missing; give all four sides of the rectangle, or none"),
    ({"Arrays/A1/x to": 20},
     "<Arrays/A1/x to>: x to is 20.00 ft (6.10 m); give more than x from in <Arrays/A1/x from>,"
     " 20.00 ft (6.10 m)"),
    ({"Objects/RTU-1/y to": 70},
     "<Objects/RTU-1/y to>: y to is 70.00 ft (21.34 m); give more than y from in"
     " <Objects/RTU-1/y from>, 80.00 ft (24.38 m)"),
    ({"Motions/M2/Factor or PPA": None},
     "<Motions/M2/Factor or PPA>: factor or PPA is missing; give the factor, or the PPA in g"),
    ({"Motions/M3/Factor or PPA": None},
     "<Motions/M3/Factor or PPA>: factor or PPA is missing; give the factor, or the PPA in g"),
    ({"Motions/M1/Transverse record": "records/x.csv"},
     "<Motions/M1/Transverse record>: transverse record is 'records/x.csv', the same as the"
     " horizontal record; give another record"),
    ({"Motions/M1/Scaling": "target spectrum", "Motions/M1/Factor or PPA": 2},
     "<Motions/M1/Factor or PPA>: factor or PPA is 2, but scaling is 'target spectrum'; change"
     " the scaling or leave this blank"),
    ({"Motions/M1/Start time": 1.5, "Motions/M1/End time": 1.5},
     "<Motions/M1/End time>: end time is 1.5 s; give 2.5 s or more"),
    ({"Motions/M1/High-pass corner": 20, "Motions/M1/Low-pass corner": 20},
     "<Motions/M1/Low-pass corner>: low-pass corner is 20 Hz; give more than the high-pass"
     " corner, 20 Hz"),
    ({"Motions/M2/Recorded at": "ground"},
     "<Building/Period T1>: period T1 is missing; give it, or a structure type: a motion is"
     " recorded at the ground"),
    ({"Building/Period T2": 0.3},
     "<Building/Period T2>: period T2 is 0.3 s; give period T1 as well, or leave it blank"),
    ({"Building/Period T1": 0.2, "Building/Period T2": 0.3},
     "<Building/Period T2>: period T2 is 0.3 s; give at most period T1, 0.2 s, or leave it blank"),
    ({"Building/Period T1": 0.2, "Motions/M2/Recorded at": "ground", "Site/Number of stories": 101},
     "<Site/Number of stories>: number of stories is 101, more than the 100 of the building"
     " model; give roof motions"),
    (of("Spectrum/1", {"Period": 1, "Horizontal": 1}),
     "<Spectrum/heading/Period>: one row is given; give at least two, or none"),
    ({"Spectrum/1/Period": 1, "Spectrum/1/Horizontal": 1, "Spectrum/2/Period": 1,
      "Spectrum/2/Horizontal": 1},
     "<Spectrum/2/Period>: period is 1 s, already given at <Spectrum/1/Period>; give each period"
     " once"),
    ({"Spectrum/1/Period": 8, "Spectrum/1/Horizontal": 8, "Spectrum/2/Period": 9,
      "Spectrum/2/Horizontal": 9, "Spectrum/1/Vertical": 1},
     "<Spectrum/2/Vertical>: vertical is missing; give it in every row, or in none"),
    ({"Spectrum/1/Period": 8, "Spectrum/1/Horizontal": 8, "Spectrum/2/Period": 9,
      "Spectrum/2/Horizontal": 9, "Motions/M1/Scaling": "target spectrum"},
     "<Spectrum/heading/Period>: periods range from 8 to 9 s, but motions are scaled over 0.2 to"
     " 5 s; add rows, or change the scaling periods"),
    ({"Options/Confirmed by": "RG", "Options/Confirmed rule set": "SEAOC PV1-2012"},
     *(f"<Options/{label}>: {label.lower().replace('asce', 'ASCE')} is missing; give all five"
       " cells of the confirmation, or none"
       for label in ("Confirmed on", "Confirmed edition of ASCE 7", "Confirmed building code"))),
    ({"Building/Shortest scaling period": 5},
     "<Building/Longest scaling period>: longest scaling period is 5 s; give more than the"
     " shortest, 5 s"),
    ({"Motions/M1/Scaling": "target spectrum", "Motions/M1/High-pass corner": 0.5},
     "<Motions/M1/High-pass corner>: high-pass corner is 0.5 Hz, a period of 2 s, but the"
     " longest scaling period is 5 s; reduce one of them"),
    ({"Motions/M1/Scaling": "target spectrum", "Motions/M1/Recorded at": "ground",
      "Building/Period T1": 0.5},
     "<Site/F_v>: F_v is missing; <Motions/M1/Scaling> scales a ground motion to the design"
     " spectrum, which requires S_D1, or S_1 and F_v, and T_L",
     "<Site/Long-period transition T_L>: long-period transition T_L is missing;"
     " <Motions/M1/Scaling> scales a ground motion to the design spectrum, which requires S_D1,"
     " or S_1 and F_v, and T_L"),
    ({"Site/Long-period transition T_L": 0.5, "Site/F_v": 1.7},
     "<Site/Long-period transition T_L>: long-period transition T_L is 0.5 s; give more than"
     " T_S = S_D1/S_DS = 0.507 s"),
    ({"Motions/M1/Factor or PPA": 2},
     "<Motions/M1/Factor or PPA>: factor or PPA is 2, but scaling is 'as recorded'; change the"
     " scaling or leave this blank"),
    ({"Options/2/Provision": "parapet_height_in", "Options/2/Value": 20, "Options/2/Reason": "x"},
     "<Options/2/Provision>: provision is 'Minimum height of a qualifying parapet above the"
     " roof', already given at"
     " <Options/1/Provision>; delete one"),
    ({"Site/S_S": 2.4},
     "<Site/S_DS>: S_DS is 1.566 g; give at least 1.6 g, which is 2/3 F_a S_S with F_a of 1 for"
     " site class 'D' (ASCE 7-16 Table 11.4-1†), or select the hazard basis 'site-specific"
     " analysis' and give its report"),
    ({"Building/Roof x from": 0, "Building/Roof x to": 300, "Building/Roof y from": 0},
     "<Building/Roof y to>: roof y to is missing; give all four sides of the rectangle, or none"),
    ({"Building/Roof x from": 300, "Building/Roof x to": 0, "Building/Roof y from": 0,
      "Building/Roof y to": 120},
     "<Building/Roof x to>: x to is 0.00 ft (0.00 m); give more than x from in"
     " <Building/Roof x from>, 300.00 ft (91.44 m)"),
    ({"Building/Roof x from": 25, "Building/Roof x to": 300, "Building/Roof y from": 0,
      "Building/Roof y to": 74},
     "<Arrays/A1/x from>: x from is 20.00 ft (6.10 m), outside the roof; give 25.00 ft (7.62 m) or"
     " more, or correct the outline at <Building/Roof x from>",
     *(f"<Arrays/{array}/y to>: y to is 75.00 ft (22.86 m), outside the roof; give 74.00 ft"
       " (22.56 m) or less, or correct the outline at <Building/Roof y to>"
       for array in ("A1", "A2"))),
]  # fmt: skip


def sheets_of(case):
    """The sheets that a case changes, or names in its lines."""
    cells, *lines = case
    named = [line for text in lines for line in re.findall(r"<([A-Z][a-z]+)/", text)]
    return {name.partition("/")[0] for name in (*cells, *named)}


@pytest.fixture(scope="module")
def of_contradictions(tmp_path_factory):
    folder = tmp_path_factory.mktemp("contradictions")
    cases = [cells for cells, *_ in CONTRADICTIONS]
    return together(folder, cases, map(sheets_of, CONTRADICTIONS))


@pytest.mark.parametrize(
    "number", range(len(CONTRADICTIONS)), ids=[" ".join(cells) for cells, *_ in CONTRADICTIONS]
)
@pytest.mark.nightly
def test_inconsistencies_are_reported_at_the_cell_to_change(of_contradictions, number):
    """And nothing else is, on the sheets of the case."""
    case, reported = CONTRADICTIONS[number], of_contradictions[number]
    own = sheets_of(case)
    assert tuple(line for line in reported if line.partition("!")[0] in own) == said(*case[1:])


@pytest.mark.nightly
def test_nothing_else_is_reported_beside_inconsistencies(of_contradictions):
    known = {line for _, *lines in CONTRADICTIONS for line in said(*lines)}
    assert {line for reported in of_contradictions for line in reported} == known


def test_all_errors_are_reported_together_in_the_order_of_the_sheets(tmp_path):
    wrong = {
        "Project/Project name": None,
        "Site/Seismic design category": "C",
        "Arrays/A1/Slope": 50,
        "Arrays/A2/Friction coefficient": "abc",
        "Objects/RTU-1/Height": "tall",
        "Clearances/3/Provided clearance": 61,
        "Motions/M1/Horizontal record": "records/none.csv",
    }
    reported = problems(type_into(make(tmp_path), dict(reversed(wrong.items()))))
    assert tuple(line.split(": ")[0] for line in reported) == said(*wrong)


# Cell, number format, and how it shows the number; what to give instead.
MISLEADING = [
    ("Arrays/A1/CG height", '0" mm"', "CG height is 9, shown in mm", "more than 0 [in]"),
    ("Arrays/A1/Weight", '0.0"kg"', "weight is 42000, shown in kg", "more than 0 [lb]"),
    ("Arrays/A1/Weight", "0,", "weight is 42000, shown divided by 1,000", "more than 0 [lb]"),
    ("Arrays/A1/Friction coefficient", '0.00"g"', "friction coefficient is 0.45, shown in g",
     "from 0 to 1.5"),
    ("Arrays/A1/Slope", '0.0"%"', "slope is 0.5, shown in %", "0 or more"),
    ("Site/Structure height h", '0.0" m"', "structure height h is 36, shown in m", "0 [ft]"),
    ("Options/1/Value", '0" ft"', "value is 18, shown in ft", "give a number"),
    ("Motions/M2/Factor or PPA", '0.0"g"', "factor or PPA is 2, shown in g", "more than 0"),
]  # fmt: skip


def formatted(path, formats):
    """Give cells their number formats."""

    def change(book):
        for name, code in formats.items():
            cell(book, name).number_format = code

    return edit(path, change)


@pytest.mark.parametrize(("name", "code", "what", "wish"), by_day(MISLEADING, 2))
def test_a_number_shown_in_another_unit_or_in_thousands_is_an_error(
    tmp_path, name, code, what, wish
):
    (line,) = problems(formatted(make(tmp_path), {name: code}))
    assert line.startswith(f"{at(name)}: {what} by its number format ({code}); give a number")
    assert line.endswith(", formatted as a number")
    assert wish in line


@pytest.mark.parametrize(
    ("units", "formats"),
    [
        ("US", {
            "Arrays/A1/CG height": '0.0" in"', "Arrays/A1/Weight": "#,##0",
            "Arrays/A2/Weight": '#,##0" lbs"', "Arrays/A1/Friction coefficient": '0.00" (lab)"',
            "Arrays/A1/Slope": "0.0°",  # in degrees
            "Arrays/A2/Slope": '0.0"%"',  # in percent
            "Options/1/Value": '0" in"', "Site/S_DS": '0.000"g"',
            "Motions/M3/Factor or PPA": '0.0"g"',  # a PPA
        }),
        ("SI", {"Arrays/A1/CG height": '0.0" mm"', "Site/Structure height h": '0.0" m"'}),
    ],
)  # fmt: skip
def test_a_number_format_may_name_the_unit_of_its_cell(tmp_path, units, formats):
    read_workbook(formatted(make(tmp_path, UnitsFirst(units)), formats))


def test_at_least_one_array_is_required(tmp_path):
    assert problems(make(tmp_path, clearances=[], arrays=[])) == said(
        "<Arrays/heading/ID>: no array is given; fill in at least one row"
    )


def test_no_motion_is_required(tmp_path):
    assert read_workbook(make(tmp_path, motions=[])).input.motions == ()


@pytest.mark.quick
def test_a_gap_may_be_rounded_by_half_an_inch_or_one_percent_up_to_an_inch(tmp_path):
    gaps = {1: 120.98, 3: 60.49, 4: 4000}
    changes = {f"Clearances/{row}/Provided clearance": gap for row, gap in gaps.items()}
    assert read_workbook(type_into(make(tmp_path), changes)).input.clearances


def test_a_setting_that_is_given_twice_is_reported_with_both_cells(tmp_path):
    twice = {"Site!A90": "S_DS *", "Site!B90": 0.2, "Site!A91": "S_1"}  # S_1 is beside nothing
    assert problems(edit(make(tmp_path), lambda book: put(book, twice))) == said(
        "<Site/S_DS>: label 'S_DS' appears twice, also in Site!B90; keep one"
    )


FRESH = "copy it from a fresh workbook (roofslip new FOLDER)"
HEADING = f"write it here in its own column, or {FRESH}"
LENGTHS = "write one of in, ft, mm, cm, m"

# Cells that are changed, each case in a workbook of its own, and all resulting lines.
TYPED = [
    ({"Project/Primary units": "SI", "Arrays/A1/y to": 10},
     "<Arrays/A1/y to>: y to is 3.05 m (10.00 ft); give more than y from in <Arrays/A1/y from>,"
     " 4.57 m (15.00 ft)"),
    # The clearance to an array with an unreadable plan is not checked.
    ({"Arrays/A2/x to": "abc"}, "<Arrays/A2/x to>: x to is 'abc'; give a number [ft]"),
    ({"Arrays/heading/Friction coefficient": "Grip"},
     "<Arrays/heading/Friction coefficient>: heading 'Friction coefficient' is missing, 'Grip'"
     f" found; {HEADING}"),
    # An optional column that is renamed is not ignored.
    ({"Motions/heading/Vertical record": "Vertical file"},
     "<Motions/heading/Vertical record>: heading 'Vertical record' is missing, 'Vertical file'"
     f" found; {HEADING}"),
    ({"Arrays/heading/High-velocity friction": "Slope"},
     "<Arrays/heading/High-velocity friction>: heading 'Slope' appears twice, also in"
     f" {at('Arrays/heading/Slope').partition('!')[2]}; keep one"),
    ({"Site/Structure height h/Unit": "yd", "Site/Height of the array z/Unit": None},
     f"<Site/Structure height h/Unit>: unit of structure height h is 'yd'; {LENGTHS}",
     f"<Site/Height of the array z/Unit>: unit of height of the array z is missing; {LENGTHS}"),
    ({"Options/1/Provision": "parapet"},
     "<Options/1/Provision>: provision is 'parapet'; choose a name from the list of the cell"),
    ({"Options/1/Provision": "minimum height of qualifying parapet above roof"},
     "<Options/1/Provision>: provision is 'minimum height of qualifying parapet above roof'; did"
     " you mean 'Minimum height of a qualifying parapet above the roof'?"),
    ({"Site/Rule set": "ASCE 7-16", "Options/1/Value": 20,
      "Options/1/Provision": "Prescriptive displacement in SDC A, B, C"},
     "<Options/1/Provision>: provision is 'Prescriptive displacement in SDC A, B, C', which"
     " ASCE 7-16 does not have; delete the row"),
    ({"Arrays/heading/CG height": "CG height [yd]"},
     f"<Arrays/heading/CG height>: unit of CG height is 'yd'; {LENGTHS}"),
]  # fmt: skip


@pytest.mark.parametrize("case", TYPED, ids=[" ".join(cells) for cells, *_ in TYPED])
def test_what_is_typed_is_reported_with_what_to_write(tmp_path, case):
    cells, *lines = case
    assert problems(type_into(make(tmp_path), cells)) == said(*lines)


# Cells that are changed in one workbook, and how the line of each begins after `unit of`.
UNITS = [
    {
        "Arrays/heading/Friction coefficient": (
            "Friction coefficient [%]", "friction coefficient is '%'; it has no unit: delete it"),
        "Arrays/heading/Weight": ("Weight [t]", "weight is 't'; write one of lb, kip, N, kN, kg"),
        "Arrays/heading/CG height": ("CG height", f"CG height is missing; {LENGTHS}"),
        "Arrays/heading/Downslope direction": (
            "Downslope direction [rad]", "downslope direction is 'rad'; give the number"),
    },
    # A unit that cannot be chosen must be that of the sheet.
    {
        "Site/F_a/Unit": ("%", "F_a is '%'; it has no unit: delete it"),
        "Site/S_DS/Unit": ("m/s2", "S_DS is 'm/s2'; give the number in g, and write g"),
        "Building/Period T1/Unit": ("Hz", "period T1 is 'Hz'; give the number in s, and write s"),
        "Building/Damping/Unit": ("-", "damping is '-'; give the number in %, and write %"),
        "Site/Long-period transition T_L/Unit": (
            "Hz", "long-period transition T_L is 'Hz'; give the number in s, and"),
    },
]  # fmt: skip


@pytest.mark.parametrize("units", UNITS, ids=["headings", "single fields"])
def test_a_unit_must_be_valid(tmp_path, units):
    cells = {name: unit for name, (unit, _) in units.items()}
    reported = problems(type_into(make(tmp_path), cells))
    for line, (name, (_, wanted)) in zip(reported, units.items(), strict=True):
        assert line.startswith(f"{at(name)}: unit of {wanted}")


def remove(sheet):
    return lambda book: book.remove(book[sheet])


def percent(book):
    slope = cell(book, "Arrays/A2/Slope")
    slope.value, slope.number_format = 0.05, "0.0%"


def forget_number(book):
    del book.defined_names["project_number"]
    number = cell(book, "Project/Project number")
    number.offset(column=-1).value = None


# What is changed in a workbook, and the resulting line.
EDITED = [
    (percent,
     "<Arrays/A2/Slope>: slope is a percentage (5%, which Excel holds as 0.05); give a number of 0"
     " or more, formatted as a number"),
    (remove("Arrays"),
     f"Arrays: the sheet is missing: no table arrays_table and no row of its headings; {FRESH}"),
    # It takes no other table for its own.
    (remove("Objects"),
     f"Objects: the sheet is missing: no table objects_table and no row of its headings; {FRESH}"),
    (remove("Site"),
     f"Site: the sheet is missing, or all labels of Site and building; {FRESH}\n"
     "Site: long-period transition T_L is missing (no name target_t_l_s and no label 'Long-period"
     f" transition T_L'); {FRESH}"),
    (forget_number,
     "Project: project number is missing (no name project_number and no label 'Project number');"
     f" {FRESH}"),
    # A required column is pointed at where it was.
    (lambda book: book["Arrays"].delete_cols(cell(book, "Arrays/A1/Weight").column),
     f"<Arrays/heading/Weight>: heading 'Weight' is missing; {HEADING}"),
]  # fmt: skip


@pytest.mark.parametrize(("change", "line"), EDITED, ids=[line[:40] for _, line in EDITED])
def test_what_is_missing_or_in_percent_is_reported_once(tmp_path, change, line):
    assert problems(edit(make(tmp_path), change)) == said(*line.splitlines())


@pytest.mark.parametrize(
    ("name", "to"),
    [("Arrays/A1/Friction test report", (1, 0)), ("Site/Structure height h", (1, 0)),
     ("Site/Structure height h", (0, 1)), ("Site/Structure height h", (0, -1))],
    ids=["table", "below", "unit", "label"],
)  # fmt: skip
def test_merged_cells_of_a_table_or_over_a_single_field_are_reported(tmp_path, name, to):
    sheet, first = at(name).split("!")
    row, column = coordinate_to_tuple(first)
    (top, bottom), (left, right) = (sorted((0, step)) for step in to)
    corners = ((row + top, column + left), (row + bottom, column + right))
    cells = ":".join(f"{get_column_letter(across)}{down}" for down, across in corners)
    path = edit(make(tmp_path), lambda book: book[sheet].merge_cells(cells))
    assert problems(path) == (f"{sheet}!{cells}: cells are merged; unmerge them",)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        *((name, 1e-9) for name in ("Site/S_S", "Site/S_1")),
        *((name, 1e9) for name in ("Building/Roof x from", "Arrays/1/x from", "Arrays/2/y from")),
        *((f"Arrays/{row}/y from", 1e-9) for row in (1, 3)),
    ],
)
def test_the_cell_of_an_extreme_value_is_named_where_another_cell_is_wrong_by_it(
    tmp_path, name, value
):
    path = tmp_path / "input.xlsx"
    path.write_bytes((ROOT / "projects" / "example" / "input.xlsx").read_bytes())
    place = address(path, name)
    with pytest.raises(InputError) as caught:
        _ = read(type_into(path, {name: value})).project
    sheet, at_cell = place.split("!")
    named = re.findall(rf"{sheet}!([A-Z]+)(\d+)(?::([A-Z]+)\2)?", str(caught.value))
    assert any(
        low <= at_cell.rstrip("0123456789") <= (high or low) and at_cell.endswith(row)
        for low, row, high in named
    ), caught.value


def test_of_a_thousand_overlaps_and_more_a_thousand_are_told(tmp_path):
    same = [arrays()[0] | {"id": f"A{k}"} for k in range(1, 51)]
    found = problems(make(tmp_path, arrays=same))
    assert sum("overlap in plan; correct one of them" in each for each in found) == MOST_OVERLAPS
