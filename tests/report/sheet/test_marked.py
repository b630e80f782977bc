"""A cell is red where `roofslip check` refuses it, and nothing is green where it refuses any."""

import datetime as dt
import math

import pytest
from openpyxl.utils.cell import coordinate_to_tuple

from marked import marked
from report.sheet.schema import SECTIONS
from report.sheet.schema.fields import entries
from sheets import at, edit, make, of, problems, type_into
from typed import address_of

ROWS = {  # of sections that the usual project leaves blank
    "friction_tests": {"laboratory": "Lab", "report": "R1"},
    "friction_runs": [{"surface": "dry", "number": n, "mu": 0.9} for n in (1, 2)],
    "building": {"structure": "other"},
    "links": [{"array": "A1", "friction": "0.40, 0.45, 0.50", "stiffness_n_per_m": 1e5}],
    "spectrum": [{"period_s": 0.01, "horizontal_g": 1.0}, {"period_s": 99.0, "horizontal_g": 0.1}],
    "layers": [{"layer": "L", "kind": "array"}],
    "acknowledged": [{"warning": "w", "reason": "r"}],
}


def number(entry):
    return entry.kind in (int, float) and not entry.choices


def text(entry):
    """What no field of its kind accepts, as text."""
    if number(entry) or entry.kind is dt.date:
        return "3/5/2026"
    return "|".join(entry.choices[:2]) if entry.choices else "x" * (entry.max_length + 1)


def low(entry):
    if number(entry) and math.isfinite(entry.bounds.low):
        return entry.bounds.low - (0 if entry.bounds.excludes_low else 1)
    return {int: 1.5, float: -1e17, dt.date: 3.5}.get(entry.kind)


def high(entry):
    if number(entry):
        return min(1e19, entry.bounds.high + (0 if entry.bounds.excludes_high else 1))
    return dt.date(1999, 12, 31) if entry.kind is dt.date else None


def fill(path, values):
    """Fill every field of the first rows, but not with None."""

    def change(book):
        for section in SECTIONS:
            for entry in entries(section.model):
                value = values(entry)
                if value is not None:
                    title, place = address_of(book, section, entry)
                    book[title][place] = value

    return edit(path, change)


SPECTRUM_BLANK = {f"Spectrum/{n}/{head}": None for n in (1, 2) for head in ("Period", "Horizontal")}
ROOF = {"Roof x from": 30, "Roof x to": 190, "Roof y from": -10, "Roof y to": 240}
TOGETHER = (
    {
        "Site/Risk category": "III", "Site/Site class": "BC", "Site/Seismic design category": "C",
        "Site/S_MS": 2.0, "Site/Number of stories": 150, "Site/Building code": "CBC",
        "Site/Roof x from": 0, "Arrays/A1/Slope": 50, "Arrays/A2/Static friction": 0.4,
        "Objects/RTU-1/x from": 200, "Objects/N/Height": None, "Motions/M1/Recorded at": "ground",
        "Motions/M1/Transverse record": "records/z.csv", "Motions/M3/Factor or PPA": None,
        "Motions/M1/Factor or PPA": 2, "Building/Period T2": 0.5, "Friction tests/2/Run": 1,
        "Spectrum/2/Period": 0.01, "Clearances/1/Object": "Q", "Clearances/2/Array": "a1",
        "Options/1/Provision": "Parapet", "Options/Displacement by direction": "Yes",
    },
    {
        "Site/Rule set": "ASCE 7-16", "Site/Edition of ASCE 7": "ASCE 7-22", "Site/F_a": 1.2,
        "Arrays/A1/Static friction": 0.5, "Arrays/A1/Model": "one axis", "Arrays/A2/ID": "a1",
        "Objects/S/ID": "N", "Clearances/1/Object": "A1", "Spectrum/1/Vertical": 0.5,
        "Motions/M2/ID": "m1", "Motions/M1/End time": 1, "Motions/M1/Start time": 1,
        "Options/Shortest scaling period": 6, "Building/Period T2": 0.5, "Building/Period T1": 0.3,
    },
    {
        "Site/S_S": 1.5, "Site/F_a": 0.9, "Site/F_v": 1.0, "Site/Year of building code": 2022,
        "Arrays/A1/High-velocity friction": 0.5, "Arrays/A2/x from": 50,
        "Clearances/1/Object": "S", "Motions/M1/Low-pass corner": 1,
        "Motions/M1/High-pass corner": 2, "Links/2/Array": "A1", "Links/2/Link stiffness": 100,
        "Links/2/Block friction": "0.40, 0.45", **of("Site", ROOF),
    },
    {
        "Site/S_DS": None, "Site/S_S": 1.5, "Site/S_MS": 1.2, "Arrays/A2/Friction rate": 20,
        "Clearances/1/Provided clearance": 125, "Clearances/3/Provided clearance": 400,
        "Arrays/A1/x from": None, "Objects/RTU-1/y to": None,
    },
    SPECTRUM_BLANK | {
        "Site/S_D1": 1.2, "Options/Long-period transition T_L": 0.3, "Site/S_DS": 2.4,
        "Clearances/1/Provided clearance": 120.6, "Motions/M1/Factor or PPA": 1,
        "Outlines/1/Outline of": "A1", "Outlines/1/x": 0, "Outlines/1/y": 0,
        "Outlines/1/From": "drawing",
    },
    SPECTRUM_BLANK | {
        "Motions/M1/Recorded at": "ground", "Motions/M1/Scaling": "target spectrum",
        "Building/Structure type": None,
    },
    {},
)  # fmt: skip


def blank(entry):
    """Every required cell, but one of each block, which asks for the others."""
    is_first = entry.name in ("name", "rule_set")
    return "" if entry.is_required and not is_first else None


ALONE = (text, low, high, blank)
UNTOLD = {  # what no formula tells, and what is red elsewhere
    "Site/F_v", "Motions/M1/Horizontal record", "Links/1/Array", "Links/1/Block friction",
    "Spectrum/heading/Period",
}  # fmt: skip


@pytest.fixture(scope="module")
def looks(tmp_path_factory):
    """The looks of workbooks by path."""
    folder = tmp_path_factory.mktemp("marked")
    paths = [make(folder / str(n), **ROWS) for n in range(len(TOGETHER) + len(ALONE))]
    for path, change in zip(paths, (*TOGETHER, *ALONE), strict=True):
        fill(path, change) if callable(change) else type_into(path, change)
    return dict(zip(paths, marked(paths, folder), strict=True))


def refused(path):
    lines = () if path.parent.name == str(len(TOGETHER) - 1) else problems(path)
    return {line.partition(": ")[0]: line for line in lines}


def row(address):
    title, place = address.split("!")
    return title, coordinate_to_tuple(place)[0]


@pytest.mark.nightly("report/sheet/checking", "report/sheet/writing/needs.py")
def test_each_cell_that_check_refuses_is_red(looks):
    untold = {at(name) for name in UNTOLD}
    for path, look in looks.items():
        lost = {a: line for a, line in refused(path).items() if look.get(a) != "red"}
        assert {a: line for a, line in lost.items() if a not in untold} == {}, path


@pytest.mark.nightly("report/sheet/checking", "report/sheet/writing/needs.py")
def test_nothing_is_green_where_check_refuses_a_cell(looks):
    for path, look in looks.items():
        cells = refused(path)
        rows, titles = set(map(row, cells)), {address.split("!")[0] for address in cells}
        green = [address for address, color in look.items() if color == "green"]
        assert [a for a in green if row(a) in rows and not a.startswith("Start")] == []
        assert [a for a in green if a.endswith("!A3") and a.split("!")[0] in titles] == []
        assert [t for t in titles if look[at(f"Start/{t}")] == "green"] == [], path


@pytest.mark.nightly("report/sheet/checking", "report/sheet/writing/needs.py")
def test_what_no_formula_tells_says_see_check(looks):
    accepted = looks[next(path for path in looks if path.parent.name == str(len(TOGETHER) - 1))]
    assert refused(next(iter(looks)))
    said = {name: accepted[at(name)] for name in ("Motions/M1/Status", "Links/1/Status")}
    assert set(said.values()) == {"see check"}
    assert accepted[at("Objects/RTU-1/Status")] == "green"


@pytest.mark.nightly("report/sheet/writing/marks.py")
def test_a_row_from_a_drawing_looks_so_but_where_it_is_refused(looks):
    (drawn,) = (look for path, look in looks.items() if path.parent.name == "4")
    names = ("Outline of", "x", "y", "From")
    assert [drawn[at(f"Outlines/1/{name}")] for name in names] == ["red", *["drawn"] * 3]
