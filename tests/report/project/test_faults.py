"""Input errors are reported by cell: what was found, and what to give."""

import datetime as dt
import re

import pytest

from fixtures import workbooks
from fixtures.cells import address
from fixtures.errors import input_problems
from fixtures.marks import by_day
from fixtures.paths import ROOT
from fixtures.project_parts import links
from fixtures.workbooks import (
    cell_address,
    edit,
    make,
    problems,
    read_workbook,
    row_cells,
    type_into,
    with_addresses,
)
from report.project.check.plan_shapes import MOST_OVERLAPS
from report.project.model.input_rows import suggestion
from report.project.read.read import read


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


NUMBER = "enter a number from 0 to 1.5"
WEIGHT = "enter a number greater than 0 [lb]"
CONTROL = "with control characters; retype it"
FORMATTED = "enter a number of 0 or more, formatted as a number"
PARAPET = "for the qualifying parapet height above the roof [in]; enter a number from 0"

# Of each cell, what is typed there, and how the line goes on after `its label is `.
SINGLE_CELLS = {
    "Arrays/A1/Friction coefficient": {
        "abc": f"'abc'; {NUMBER}", "  ": f"missing; {NUMBER}", -0.1: f"-0.1; {NUMBER}",
        "#DIV/0!": "#DIV/0!; correct the formula, or type a value",
        "=0.4+0.05": "a formula with no saved value (=0.4+0.05); open the workbook in Excel or"
                     " LibreOffice and save it",
        "1e999": f"'1e999'; {NUMBER}", 1.7: f"1.7; {NUMBER}",
        True: f"TRUE, a logical value; {NUMBER}", None: f"missing; {NUMBER}",
    },
    "Arrays/A1/Weight": {
        "42,000": "'42,000'; write 42000, without a comma", 0: f"0; {WEIGHT}",
        "42 kip": f"'42 kip'; {WEIGHT}, with no unit in the cell",
        1e308: f"1e+308; {WEIGHT}, below 1e+15 in size",
    },
    "Arrays/A1/Slope": {
        dt.datetime(2024, 5, 3): f"a date or time (2024-05-03); {FORMATTED}",
        dt.time(2, 30): f"a date or time (02:30:00); {FORMATTED}",
        "0.\u200b5": "'0.?5'; enter a number of 0 or more",
    },
    "Arrays/A2/Slope": {
        "1/2:12": "'1/2:12'; enter a number of 0 or more, or choose the slope unit in/12",
    },
    "Friction tests/1/Kinetic coefficient": {
        "0.45 (dry)": "'0.45 (dry)'; enter a number from 0 to 1.5",
    },
    "Friction tests/1/Velocity": {-1: "-1; enter a number of 0 or more [in/s]"},
    "Links/1/Block friction": {
        "0.4," * 51: "204 characters long; enter text of at most 200 characters",
    },
    "Arrays/A1/x from": {-1e300: "-1e+300; enter a number [ft], below 1e+15 in size"},
    "Arrays/A1/ID": {
        "A" * 41: f"'{'A' * 41}'; enter text of at most 40 characters",
        None: "missing; enter text such as 'A1'", "\u200b": "missing; enter text such as 'A1'",
    },
    "Arrays/A1/Friction test report": {
        "x" * 2001: "2001 characters long; enter text of at most 2000 characters",
    },
    "Project/Project name": {
        "A_x0007_B": f"'A?B', {CONTROL}",
        "A_xFFFE_B": f"'A?B', {CONTROL}",  # so Excel writes a character that XML does not allow
    },
    "Project/Project number": {
        "a\u2028b": f"'a?b', {CONTROL}", "a\u202eb\u2066c": f"'a?b?c', {CONTROL}",
        "_xFFFF_": f"'?', {CONTROL}",
        dt.datetime(2024, 3, 5): "2024-03-05, which is not text; format the cell as text and retype"
                                 " it",
    },
    "Project/Date": {
        "3/5/2026": "'3/5/2026'; write 2026-03-05 or 2026-05-03",
        True: "TRUE; enter a date such as 2026-03-05",
        # in a cell that is formatted as a date
        3.5: "1900-01-03, before 2000-01-01; enter a date such as 2026-03-05",
    },
    "Site/Number of stories": {1.5: "1.5; enter a whole number from 1 to 200"},
    "Site/Rule set": {"ASCE 7-10": "'ASCE 7-10'; choose SEAOC PV1-2012, ASCE 7-16 or ASCE 7-22"},
    "Clearances/1/Fire pathway": {
        "no": "'no'; enter a number of 0 or more [in], or none",
        -1: "-1; enter a number of 0 or more [in], or none",
    },
    "Motions/M2/ID": {" \u200b\ufeff\u2060 ": "missing; enter text such as 'M1'"},
    "Motions/M1/Time step": {0: "0; enter a number greater than 0, at most 1 [s]"},
    "Options/1/Value": {1e9: f"1e+09 {PARAPET} to 240"},
}  # fmt: skip
CONTENTS = [(name, typed, line) for name, of in SINGLE_CELLS.items() for typed, line in of.items()]


@pytest.fixture(scope="module")
def of_cells(tmp_path_factory):
    cases = [{name: content} for name, content, _ in CONTENTS]
    return together(tmp_path_factory.mktemp("cells"), cases, map(set, cases))


@pytest.mark.parametrize(
    "number", range(len(CONTENTS)), ids=[f"{name} {str(v)[:20]!r}" for name, v, _ in CONTENTS]
)
@pytest.mark.nightly
def test_an_invalid_cell_is_named_with_its_content_and_what_to_give(of_cells, number):
    name, _, line = CONTENTS[number]
    assert set(with_addresses(f"{name} is {line}")) <= set(of_cells[number])


NO_CLEARANCE = dict.fromkeys(("Array", "Object", "Direction", "Provided clearance", "Fire pathway"))
IN_ARRAYS, AND_OBJECTS = (
    "which is not in Arrays; enter one of",
    "which is not in Objects or Arrays;",
)
SPECTRUM = row_cells("Spectrum/1", {"Period": 8, "Horizontal": 8})
SPECTRUM |= row_cells("Spectrum/2", {"Period": 9, "Horizontal": 9})
NEEDS = "<Motions/M1/Scaling> scales a ground motion to the design spectrum, which requires S_D1"


def roof(*sides):
    return dict(zip((f"Building/Roof {edge}" for edge in FOUR_SIDES), sides, strict=True))


FOUR_SIDES = ("x from", "x to", "y from", "y to")

# Cells that are changed together, and all resulting lines.
CONTRADICTIONS = [
    ({"Arrays/A2/ID": "a1", "Clearances/1/Object": "RTU-1"},
     "Arrays/A2/ID is 'a1', already used at <Arrays/A1/ID>; enter a unique ID",
     *(f"Clearances/{row}/Array is 'A2', {IN_ARRAYS} A1, a1" for row in (3, 4, 5))),
    ({"Objects/OLD/ID": "A1", "Clearances/4/Object": "S", "Clearances/4/Provided clearance": 9},
     "Objects/OLD/ID is 'A1', already used at <Arrays/A1/ID>; enter a unique ID"),
    ({"Clearances/3/Object": "rtu-1"},
     f"Clearances/3/Object is 'rtu-1', {AND_OBJECTS} did you mean 'RTU-1'?"),
    ({"Clearances/1/Object": "A1"},
     "Clearances/1/Object is 'A1', the array itself; enter an object or another array"),
    ({"Clearances/4/Object": "RTU-1", "Clearances/4/Provided clearance": 50},
     "Clearances/4/Array is 'A2', with the same object and direction as at <Clearances/3/Array>;"
     " delete one"),
    ({"Clearances/3/Provided clearance": 61},
     "Clearances/3/Provided clearance is 61.0 in (1549 mm), but A2 and RTU-1 are 60.0 in (1524 mm)"
     " apart on the plan; reduce it, or correct the rectangles in <Arrays/A2/x from:y to> and"
     " <Objects/RTU-1/x from:y to>"),
    ({"Objects/RTU-1/y from": 70},
     "Clearances/3/Provided clearance is 60.0 in (1524 mm), but A2 and RTU-1 overlap in plan;"
     " correct their rectangles in <Arrays/A2/x from:y to> and <Objects/RTU-1/x from:y to>"),
    ({"Arrays/A1/x to": 120} | row_cells("Clearances/1", NO_CLEARANCE),
     "<Arrays/A1/x from>: A1 and A2 at <Arrays/A2/x from> overlap in plan; correct one of them"),
    ({"Site/Risk category": "IV", "Site/Importance factor I_e": 1.25},
     "Site/Importance factor I_e is 1.25; enter at least 1.5 for risk category IV"),
    ({"Site/S_DS": None}, "Site/S_DS is missing; enter S_DS, S_MS, or both S_S and F_a"),
    ({"Site/Rule set": None, "Site/S_DS": None, "Site/S_1": None,
      "Site/Seismic design category": None},
     "Site/Rule set is missing; choose SEAOC PV1-2012, ASCE 7-16 or ASCE 7-22",
     "Site/S_DS is missing; enter S_DS, S_MS, or both S_S and F_a",
     "Site/Seismic design category is missing; choose A, B, C, D, E or F, or enter S_1 and S_D1"),
    ({"Arrays/A2/Slope": 120}, "Arrays/A2/Slope is 120 percent; enter 0 to less than 100 percent"),
    (row_cells("Arrays/A2", {"Friction rate": 20, "Static friction": 0.4}),
     "Arrays/A2/High-velocity friction is missing; enter high-velocity friction and friction rate,"
     " or neither",
     "Arrays/A2/Static friction is 0.4; enter the friction coefficient, 0.45, or more"),
    ({"Objects/N/Height": None},
     "Objects/N/Height is missing; enter the parapet's height above the roof"),
    ({"Objects/RTU-1/x to": None},
     "Objects/RTU-1/x to is missing; enter all four sides of the rectangle, or none"),
    ({"Objects/RTU-1/y to": 70},
     "Objects/RTU-1/y to is 70.00 ft (21.34 m); enter more than y from in <Objects/RTU-1/y from>,"
     " 80.00 ft (24.38 m)"),
    ({"Motions/M3/Factor or PPA": None},
     "Motions/M3/Factor or PPA is missing; enter the factor, or the PPA in g"),
    ({"Motions/M1/Transverse record": "records/x.csv"},
     "Motions/M1/Transverse record is 'records/x.csv', the same as the horizontal record; use"
     " another record"),
    (row_cells("Motions/M1", {"Scaling": "target spectrum", "Factor or PPA": 2}),
     "Motions/M1/Factor or PPA is 2, but scaling is 'target spectrum'; change the scaling or leave"
     " this blank"),
    (row_cells("Motions/M1", {"Start time": 1.5, "End time": 1.5}),
     "Motions/M1/End time is 1.5 s; enter 2.5 s or more"),
    (row_cells("Motions/M1", {"High-pass corner": 20, "Low-pass corner": 20}),
     "Motions/M1/Low-pass corner is 20 Hz; enter more than the high-pass corner, 20 Hz"),
    ({"Motions/M2/Recorded at": "ground"},
     "Building/Period T1 is missing; enter it, or a structure type, because a ground motion is"
     " listed"),
    ({"Building/Period T1": 0.2, "Building/Period T2": 0.3},
     "Building/Period T2 is 0.3 s; enter at most period T1, 0.2 s, or leave it blank"),
    ({"Building/Period T1": 0.2, "Motions/M2/Recorded at": "ground", "Site/Number of stories": 101},
     "Site/Number of stories is 101, more than the 100 of the building model; use roof motions"),
    (SPECTRUM | {"Spectrum/2/Period": 8},
     "Spectrum/2/Period is 8 s, already entered at <Spectrum/1/Period>; enter each period once"),
    (SPECTRUM | {"Motions/M1/Scaling": "target spectrum"},
     "<Spectrum/heading/Period>: periods range from 8 to 9 s, but motions are scaled over 0.2 to"
     " 5 s; add rows, or change the scaling periods"),
    (row_cells("Options", {"Confirmed by": "RG", "Confirmed rule set": "SEAOC PV1-2012"}),
     *(f"Options/{label} is missing; enter all five cells of the confirmation, or none"
       for label in ("Confirmed on", "Confirmed edition of ASCE 7", "Confirmed building code"))),
    (row_cells("Motions/M1", {"Scaling": "target spectrum", "High-pass corner": 0.5}),
     "Motions/M1/High-pass corner is 0.5 Hz, a period of 2 s, but the longest scaling period is"
     " 5 s; reduce one of them"),
    (row_cells("Motions/M1", {"Scaling": "target spectrum", "Recorded at": "ground"})
     | {"Building/Period T1": 0.5},
     *(f"Site/{label} is missing; {NEEDS}, or S_1 and F_v, and T_L"
       for label in ("F_v", "Long-period transition T_L"))),
    ({"Site/Long-period transition T_L": 0.5, "Site/F_v": 1.7},
     "Site/Long-period transition T_L is 0.5 s; enter more than T_S = S_D1/S_DS = 0.507 s"),
    (row_cells("Options/2", {"Provision": "parapet_height_in", "Value": 20, "Reason": "x"}),
     "Options/2/Provision is 'Qualifying parapet height above the roof', already entered"
     " at <Options/1/Provision>; delete one"),
    ({"Site/Latitude": 34.0},
     "Site/Longitude is missing; enter latitude and longitude, or neither"),
    ({"Site/S_S": 2.4},
     "Site/S_DS is 1.566 g; enter at least 1.6 g, which is 2/3 F_a S_S with F_a of 1 for site class"
     " 'D' (ASCE 7-16 Table 11.4-1†), or select 'site-specific analysis' as basis of seismic"
     " parameters and enter its report"),
    (roof(25, 300, 0, 74),
     "Arrays/A1/x from is 20.00 ft (6.10 m), outside the roof; enter 25.00 ft (7.62 m) or more, or"
     " correct the outline at <Building/Roof x from>",
     *(f"Arrays/{array}/y to is 75.00 ft (22.86 m), outside the roof; enter 74.00 ft (22.56 m) or"
       " less, or correct the outline at <Building/Roof y to>" for array in ("A1", "A2"))),
]  # fmt: skip


def sheets_of(case):
    """The sheets that a case changes, or names in its lines."""
    cells, *lines = case
    named = [line for text in lines for line in re.findall(r"(?:^|<)([A-Z][a-z]+)/", text)]
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
    assert tuple(line for line in reported if line.partition("!")[0] in own) == with_addresses(
        *case[1:]
    )


@pytest.mark.nightly
def test_nothing_else_is_reported_beside_inconsistencies(of_contradictions):
    known = {line for _, *lines in CONTRADICTIONS for line in with_addresses(*lines)}
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
    assert tuple(line.split(": ")[0] for line in reported) == with_addresses(*wrong)


@pytest.mark.nightly
def test_thousands_of_overlaps_and_settings_given_twice_are_told(tmp_path):
    assert problems(make(tmp_path, clearances=[], arrays=[])) == with_addresses(
        "<Arrays/heading/ID>: no array is entered; fill in at least one row"
    )
    assert read_workbook(make(tmp_path, motions=[])).input.motions == ()
    twice = {"Site!A90": "S_DS *", "Site!B90": 0.2, "Site!A91": "S_1"}  # S_1 is beside nothing
    assert problems(
        edit(make(tmp_path), lambda book: workbooks.put(book, twice))
    ) == with_addresses("<Site/S_DS>: label 'S_DS' appears twice, also in Site!B90; keep one")
    same = [workbooks.arrays()[0] | {"id": f"A{k}"} for k in range(1, 51)]
    found = problems(make(tmp_path, arrays=same))
    assert sum("overlap in plan; correct one of them" in each for each in found) == MOST_OVERLAPS


@pytest.mark.quick
def test_a_gap_may_be_rounded_by_half_an_inch_or_one_percent_up_to_an_inch(tmp_path):
    gaps = {1: 120.98, 3: 60.49, 4: 4000}
    changes = {f"Clearances/{row}/Provided clearance": gap for row, gap in gaps.items()}
    assert read_workbook(type_into(make(tmp_path), changes)).input.clearances


FRESH = "copy it from a new workbook (roofslip new FOLDER)"
HEADING = f"write it here in its own column, or {FRESH}"
LENGTHS = "write one of in, ft, mm, cm, m"
LOW_SDC = "Prescriptive displacement in SDC A, B, C"

# Cells that are changed, each case in a workbook of its own, and all resulting lines.
TYPED = [
    ({"Project/Primary units": "SI", "Arrays/A1/y to": 10},
     "Arrays/A1/y to is 3.05 m (10.00 ft); enter more than y from in <Arrays/A1/y from>, 4.57 m"
     " (15.00 ft)"),
    # The clearance to an array with an unreadable plan is not checked.
    ({"Arrays/A2/x to": "abc"}, "Arrays/A2/x to is 'abc'; enter a number [ft]"),
    # An optional column that is renamed is not ignored.
    ({"Motions/heading/Vertical record": "Vertical file"},
     "<Motions/heading/Vertical record>: heading 'Vertical record' is missing, 'Vertical file'"
     f" found; {HEADING}"),
    ({"Arrays/heading/High-velocity friction": "Slope"},
     "<Arrays/heading/High-velocity friction>: heading 'Slope' appears twice, also in"
     f" {cell_address('Arrays/heading/Slope').partition('!')[2]}; keep one"),
    ({"Site/Structure height h/Unit": "yd", "Site/Roof height z/Unit": None},
     f"<Site/Structure height h/Unit>: unit of structure height h is 'yd'; {LENGTHS}",
     f"<Site/Roof height z/Unit>: unit of roof height z is missing; {LENGTHS}"),
    ({"Options/1/Provision": "qualifying parapet height over roof"},
     "Options/1/Provision is 'qualifying parapet height over roof'; did you mean"
     " 'Qualifying parapet height above the roof'?"),
    ({"Site/Rule set": "ASCE 7-16", "Options/1/Value": 20, "Options/1/Provision": LOW_SDC},
     f"Options/1/Provision is '{LOW_SDC}', which is not in ASCE 7-16; delete the row"),
]  # fmt: skip


@pytest.mark.parametrize(
    "number", by_day(range(len(TYPED)), 3), ids=[" ".join(cells) for cells, *_ in TYPED]
)
def test_what_is_typed_is_reported_with_what_to_write(tmp_path, number):
    cells, *lines = TYPED[number]
    assert problems(type_into(make(tmp_path), cells)) == with_addresses(*lines)


@pytest.mark.parametrize(
    ("name", "value"),
    by_day([("Site/S_1", 1e-9), ("Arrays/3/y from", 1e-9), ("Building/Roof x from", 1e9),
     ("Arrays/1/x from", 1e9)], 2),
)  # fmt: skip
def test_the_cell_of_an_extreme_value_is_named_where_another_cell_is_wrong_by_it(
    tmp_path, name, value
):
    path = tmp_path / "input.xlsx"
    path.write_bytes((ROOT / "projects" / "example" / "input.xlsx").read_bytes())
    sheet, at_cell = address(path, name).split("!")
    message = "; ".join(input_problems(lambda: read(type_into(path, {name: value})).project))
    named = re.findall(rf"{sheet}!([A-Z]+)(\d+)(?::([A-Z]+)\2)?", message)
    assert any(
        low <= at_cell.rstrip("0123456789") <= (high or low) and at_cell.endswith(row)
        for low, row, high in named
    ), message


def test_references_are_spelled_as_the_id_that_they_refer_to():
    rows = workbooks.project().model_dump()
    first = rows["clearances"][1]
    first["array"], first["object"] = first["array"].lower(), first["object"].lower()
    respelled = workbooks.project(
        clearances=rows["clearances"], links=[links("a2", "0.40, 0.50", 50)]
    )
    assert respelled.clearances[1] == workbooks.project().clearances[1]
    assert respelled.links[0].array == "A2"


CYRILLIC = "\u0410"  # looks like A


def test_an_id_that_looks_like_another_is_refused_with_its_letter(tmp_path):
    line = suggestion(f"{CYRILLIC}1", ["A1"])
    assert line.startswith(f"it looks like 'A1', but '{CYRILLIC}' is a Cyrillic letter")
    assert suggestion("RTU-11", ["RTU-1"]) == "did you mean 'RTU-1'?"
    reported = problems(type_into(make(tmp_path), {"Arrays/A2/ID": f"{CYRILLIC}1"}))
    again = f"'{CYRILLIC}1', already used at <Arrays/A1/ID>; '{CYRILLIC}' is a Cyrillic letter"
    assert any(line.startswith(*with_addresses(f"Arrays/A2/ID is {again}")) for line in reported)
