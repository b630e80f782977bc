"""Reading an input workbook: the project is recovered for any arrangement of the sheets."""

import datetime as dt
import hashlib
import os
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from openpyxl import load_workbook
from openpyxl.utils import get_column_letter, range_boundaries
from openpyxl.worksheet.formula import ArrayFormula

from cells import address, cell
from inputs import FT
from nightly import by_day
from report.sheet import schema
from report.sheet.schema.choices import Polarity, SlopeUnit, UnitsFirst
from report.sheet.writing.template import write_template
from sheets import (
    at,
    edit,
    make,
    of,
    problems,
    project,
    read_workbook,
    said,
    same,
    saved_by_libreoffice,
    type_into,
)


@pytest.fixture(params=list(UnitsFirst))
def path(request, tmp_path):
    return make(tmp_path, request.param)


def test_a_project_is_read_as_it_was_written(path):
    before = path.read_bytes()
    book = read_workbook(path.parent)  # a folder is read as its input workbook
    assert same(book.input, project())
    assert (book.path, book.sha256) == (path, hashlib.sha256(before).hexdigest())
    assert path.read_bytes() == before


texts = st.text(
    st.characters(codec="utf-8", exclude_categories=["Cc", "Cf", "Cs", "Cn", "Zs", "Zl", "Zp"]),
    min_size=1,
    max_size=12,
)
lengths = st.floats(0.01, 1000)


@st.composite
def inputs(draw):
    """Projects of any values that the checks let pass."""
    base = project()
    array = base.arrays[0].model_dump()
    names = draw(st.lists(texts, min_size=1, max_size=3, unique_by=str.casefold))
    arrays = [
        array
        | {
            "id": name,
            "slope_value": draw(st.floats(0, 11.9)),
            "slope_unit": draw(st.sampled_from(SlopeUnit)),
            "mu": draw(st.floats(0, 1.5)),
            "weight_n": draw(st.floats(1, 1e7)),
            "cg_height_m": draw(lengths),
            "x_to_m": array["x_from_m"] + draw(lengths),
            "y_from_m": 10.0 * row,
            "y_to_m": 10.0 * row + 5.0,
            "construction": draw(texts),
        }
        for row, name in enumerate(names)
    ]
    motion = base.motions[0].model_dump() | {
        "scaling": draw(st.sampled_from(["factor", "PPA"])),
        "scale_value": draw(st.floats(0.01, 100)),
        "polarity": draw(st.sampled_from(Polarity)),
        "source": draw(st.just("") | texts),
    }
    head = base.project.model_dump() | {
        "name": draw(texts),
        "date": draw(st.dates(dt.date(2000, 1, 2), dt.date(2100, 1, 1))),
        "units_first": draw(st.sampled_from(UnitsFirst)),
    }
    changes = {"project": head, "arrays": arrays, "motions": [motion], "clearances": []}
    return project(**changes, objects=[])


@pytest.mark.parametrize("examples", [1, pytest.param(30, marks=pytest.mark.nightly)])
def test_every_valid_project_is_recovered_from_the_workbook(tmp_path, examples):
    path = make(tmp_path)

    @settings(max_examples=examples)
    @given(data=inputs(), units=st.sampled_from(UnitsFirst))
    def recovered(data, units):
        write_template(path, units=units, example=data)
        assert same(read_workbook(path).input, data)

    recovered()


# Changes that users make. openpyxl moves neither names nor tables, so they are moved here as Excel
# does.


def move(table, *, rows=0, columns=0):
    left, top, right, bottom = range_boundaries(table.ref)
    first, last = (get_column_letter(column + columns) for column in (left, right))
    table.ref = f"{first}{top + rows}:{last}{bottom + rows}"


def shift(book, title, rows):
    """Insert rows at the top of a sheet."""
    sheet = book[title]
    sheet.insert_rows(1, rows)
    for table in sheet.tables.values():
        move(table, rows=rows)
    fixed = re.compile(rf"'?{re.escape(title)}'?!\$[A-Z]+\$\d+(:\$[A-Z]+\$\d+)?")

    def moved(cells):
        return re.sub(r"(?<=\$)\d+", lambda row: str(int(row[0]) + rows), cells[0])

    for name in book.defined_names.values():
        name.attr_text = fixed.sub(moved, name.attr_text)


def rename(book, old, new):
    book[old].title = new
    for name in book.defined_names.values():
        name.attr_text = name.attr_text.replace(f"'{old}'!", f"'{new}'!")


def swap(book, title, first, second, rows):
    """Exchange the headings and rows of two columns of a table."""
    heads = [cell(book, f"{title}/heading/{heading}") for heading in (first, second)]
    for row in range(rows + 1):
        a, b = (head.offset(row=row) for head in heads)
        a.value, b.value = b.value, a.value
        a.number_format, b.number_format = b.number_format, a.number_format
    i, j = (head.column - 1 for head in heads)
    columns = next(iter(book[title].tables.values())).tableColumns
    columns[i].name, columns[j].name = columns[j].name, columns[i].name


def move_table(book, title, columns, rows):
    sheet = book[title]
    table = next(iter(sheet.tables.values()))
    sheet.move_range(table.ref, rows=rows, cols=columns)
    move(table, rows=rows, columns=columns)


def forget_tables(book):
    for sheet in book.worksheets:
        sheet.tables.clear()


def move_second_array(book, rows):
    first, last = (cell(book, f"Arrays/A2/{end}") for end in ("ID", "Downslope direction"))
    first.parent.move_range(f"{first.coordinate}:{last.coordinate}", rows=rows)


# Together where each can be told apart: no two move the same table or forget what finds it.
CHANGES = {
    "a table without heading row": lambda book: setattr(
        book["Arrays"].tables["arrays_table"], "headerRowCount", 0
    ),
    "rows inserted above, sheets renamed": lambda book: [
        *(shift(book, s, 3) for s in ("Site", "Arrays", "Project")),
        *(rename(book, s, f"My {s}") for s in ("Site", "Arrays")),
    ],
    "sheets reordered and hidden, a name in other capitals": lambda book: [
        book.move_sheet("Motions", -5),
        setattr(book["Arrays"], "sheet_state", "hidden"),
        setattr(book["Arrays"].tables["arrays_table"], "displayName", "ARRAYS_TABLE"),
    ],
    "columns reordered, blank rows between": lambda book: [
        swap(book, "Arrays", "Slope", "Weight", 3),
        move_second_array(book, 7),
    ],
    "table moved": lambda book: move_table(book, "Arrays", 4, 10),
    "tables forgotten": forget_tables,
    "names forgotten": lambda book: book.defined_names.clear(),
    "rows typed below the table": lambda book: move_second_array(book, 30),
}


@pytest.mark.parametrize("change", by_day(CHANGES.values(), 3), ids=CHANGES)
def test_arrangement_does_not_matter(tmp_path, change):
    assert same(read_workbook(edit(make(tmp_path), change)).input, project())


SPELLINGS = {
    "heading in capitals": ("Arrays/heading/Friction coefficient", " FRICTION\ncoefficient *"),
    "choices in capitals": ("Arrays/A1/Slope unit", " Degrees "),
    "numbers as text": ("Arrays/A1/Friction coefficient", " 0.45 "),
    "a date as text": ("Project/Date", "2026-03-05"),
    "a number as a text": ("Project/Revision", 1),
    "a logical value for a yes": ("Options/Peer review", True),
    "notes in a computed column": ("Arrays/A2/Kind of array", "ask the client"),
    "no width at the ends of a text": ("Motions/M1/ID", "\ufeffM1\u200b \u200b"),
    "no unit where none can be chosen": ("Site/S_DS/Unit", None),
    "a unit in capitals": ("Building/Period T1/Unit", " S "),
    "notes far to the right": ("Arrays!GR9", "ask the client"),  # the last column that is allowed
}


def test_spelling_and_notes_do_not_matter(tmp_path):
    """All in one workbook: each is in a cell that no other depends on."""
    path = type_into(make(tmp_path), dict(SPELLINGS.values()))
    assert same(read_workbook(path).input, project())


def test_units_of_headings_and_cells_are_followed(tmp_path):
    cells = of("Arrays/heading", {"CG height": "CG height [mm]", "Weight": "Weight [kg]"})
    cells |= of("Arrays/A1", {"CG height": 250, "Weight": 1000}) | {"Arrays/A2/CG height": 1}
    cells |= {"Site/Structure height h": 12, "Site/Structure height h/Unit": "m"}
    data = read_workbook(type_into(make(tmp_path), cells)).input
    assert data.arrays[0].cg_height_m == pytest.approx(0.25)
    assert data.arrays[0].weight_n == pytest.approx(9806.65)
    assert data.site.structure_height_m == pytest.approx(12)
    assert data.site.roof_height_m == pytest.approx(36 * FT)


def test_a_blank_choice_takes_its_default(tmp_path):
    statistic = "Options/Design value statistic"
    blank = (statistic, "Options/Peer review", "Motions/M2/Polarity")
    book = read_workbook(type_into(make(tmp_path), dict.fromkeys(blank)))
    assert book.input.options == schema.Options()
    assert book.input.motions[1].polarity is Polarity.BOTH
    row = echo(book)[at(statistic)]
    assert (row.typed, row.value) == ("", "rule set (default)")


def test_an_unknown_heading_is_listed_in_the_echo(tmp_path):
    def note(book):
        sheet, row = book["Arrays"], cell(book, "Arrays/heading/ID").row
        beside = sheet.max_column + 1
        sheet.cell(row, beside).value, sheet.cell(row + 1, beside).value = "Color", "black"

    book = read_workbook(edit(make(tmp_path), note))
    (row,) = [row for row in book.echo if row.value.startswith("not an input")]
    assert (row.sheet, row.label) == ("Arrays", "column 'Color'")
    assert load_workbook(book.path)["Arrays"][row.cell].value == "Color"


def echo(book):
    """The echoed rows by the addresses of their cells."""
    return {f"{row.sheet}!{row.cell}": row for row in book.echo}


def test_every_cell_is_echoed_as_typed_and_as_used(path):
    book = read_workbook(path)
    rows = echo(book)
    assert len(rows) == len(book.echo)
    weight = rows[at("Arrays/A1/Weight")]
    assert (weight.label, weight.value) == ("Weight", "186825 N")
    assert (weight.typed, weight.unit) in [("42000", "lb"), ("186.825307841", "kN")]
    for name, value in (("Site/S_1", "0.7 g"), ("Objects/OLD/Height", "—"),
                        ("Options/Peer review", "Yes")):  # fmt: skip
        assert rows[at(name)].value == value


# Formulas: openpyxl saves no values, so LibreOffice saved these.


@pytest.mark.quick
def test_a_workbook_saved_by_libreoffice_reads_the_same_and_shows_its_formulas(tmp_path):
    saved = saved_by_libreoffice(tmp_path)
    book = read_workbook(saved)
    former = {"mu_report": "Lab 12", "construction": "Tray 10 deg"}
    arrays = [array.model_dump() | former for array in project().arrays]
    client = {"client": "Harbor Logistics", "address": "1200 Alameda St", "prepared_by": "RG"}
    head = project().project.model_dump() | client
    assert same(book.input, project(project=head, arrays=arrays))
    first, second = (address(saved, f"Arrays/{name}/Friction coefficient") for name in ("A1", "A2"))
    assert echo(book)[first].typed == "=0.4+0.05 → 0.45"
    assert echo(book)[second].typed == f"={first.partition('!')[2]} → 0.45"


def test_an_array_formula_without_a_value_is_reported_like_any_other(tmp_path):
    name = "Arrays/A1/Friction coefficient"

    def change(book):
        found = cell(book, name)
        found.value = ArrayFormula(found.coordinate, "=SUM(C8:C9*0)")

    assert problems(edit(make(tmp_path), change))[0].startswith(
        f"{at(name)}: friction coefficient is a formula with no saved value (=SUM(C8:C9*0));"
    )


# Motions.


@pytest.fixture(scope="module")
def shaken(tmp_path_factory):
    """The project, its first motion with a transverse record: with the slashes of Windows."""
    path = recorded(make(tmp_path_factory.mktemp("shaken")), y="0.1\n" * 200)
    return read_workbook(type_into(path, {"Motions/M1/Transverse record": "records\\y.csv"}))


def test_motions_are_scaled_and_signed_as_requested(shaken):
    m1, m2, m3 = shaken.motions
    assert [m.id for m in shaken.motions] == ["M1", "M2", "M3"]
    assert (m1.scale, m1.signs, m1.has_vertical, m1.source) == (1.0, (1, -1), True, "made")
    assert (m2.scale, m2.signs, m2.has_vertical) == (2.0, (-1,), False)
    assert m3.signs == (1,)
    assert m3.scale * np.abs(m3.ax_mps2).max() == pytest.approx(1.5 * 9.80665, rel=1e-12)
    assert (m1.dt_s, m3.dt_s) == (0.01, 0.02)


def test_a_transverse_record_is_run_beside_the_horizontal_one_and_all_are_read_only(shaken):
    m1, m2, _ = shaken.motions
    assert np.allclose(m1.ay_mps2, 0.980665)
    names = [[one.name for one in motion.orientations] for motion in (m1, m2)]
    assert names == [["record +", "record −", "transverse +", "transverse −"], ["record −"]]
    for motion in shaken.motions:
        for a in (motion.ax_mps2, motion.ay_mps2, motion.az_mps2):
            assert not a.flags.writeable


def test_records_are_listed_with_their_hashes(shaken):
    assert [(r.motion_id, r.component, r.name) for r in shaken.records] == [
        ("M1", "horizontal", "records/x.csv"),
        ("M1", "transverse", "records\\y.csv"),
        ("M1", "vertical", "records/z.csv"),
        ("M2", "horizontal", "records/x2.csv"),
        ("M3", "horizontal", "records/x3.csv"),
    ]
    z = shaken.records[2]
    data = (shaken.path.parent / "records" / "z.csv").read_bytes()
    assert (z.sha256, z.npts) == (hashlib.sha256(data).hexdigest(), 200)
    assert z.peak_g == pytest.approx(0.25, abs=1e-4)


WITHIN = "give a file in the workbook's folder, such as records/m1-x.csv"


@pytest.mark.parametrize(
    ("name", "meant"),
    [("records/long_nmae.csv", "csv"), ("records/Long_Name.CSV", "csv"),
     ("records/long_name.at", "at2"), ("recs/long_name.at2", "at2"),
     ("long_name.csv | EW", "csv")],
)  # fmt: skip
def test_a_file_name_that_nearly_fits_is_asked_about(tmp_path, name, meant):
    path = type_into(make(tmp_path), {"Motions/M1/Horizontal record": name})
    for kind in ("at2", "csv"):
        (path.parent / "records" / f"long_name.{kind}").write_text("acc_g\n0\n1\n")
    (problem,) = problems(path)
    asked = f"'{name.partition(' |')[0]}' does not exist"
    assert problem.endswith(f"{asked}; did you mean 'records/long_name.{meant}'?")


REFUSED = [
    ("records/none.csv", f"'records/none.csv' does not exist; {WITHIN}"),
    ("records", f"'records' is not a file; {WITHIN}"),
    ("/etc/hostname", f"'/etc/hostname' is outside the workbook's folder; {WITHIN}"),
    ("../x.csv", f"'../x.csv' is outside the workbook's folder; {WITHIN}"),
    ("..\\x.csv", f"'../x.csv' is outside the workbook's folder; {WITHIN}"),
    ("C:\\x.csv", f"'C:/x.csv' is outside the workbook's folder; {WITHIN}"),
    ("\\\\host\\x", f"'//host/x' is outside the workbook's folder; {WITHIN}"),
    ("link.csv", f"'link.csv' is a link to a file outside the workbook's folder; {WITHIN}"),
    ("loop.csv", f"'loop.csv' cannot be found; {WITHIN}"),
    ("n" * 300, f"'{'n' * 300}' cannot be found; {WITHIN}"),
    ("pipe.csv", f"'pipe.csv' is not a file; {WITHIN}"),
    ("big.csv", "'big.csv' has 65 MB; give at most 64 MB"),
    (
        "input.xlsx",
        "input.xlsx: not a text file; a zip or a workbook; unpack it, or save its sheet as CSV",
    ),
]


@pytest.mark.parametrize("start", range(0, len(REFUSED), 3))
def test_a_record_must_be_a_file_within_the_folder(tmp_path, start):
    """Three at a time: the workbook has three motions."""
    folder = tmp_path / "job"
    refused = {
        f"Motions/{row}/Horizontal record": case
        for row, case in enumerate(REFUSED[start : start + 3], start=1)
    }
    path = type_into(make(folder), {cell: name for cell, (name, _) in refused.items()})
    (tmp_path / "outside.csv").write_text("0.1\n0.2\n")
    (folder / "link.csv").symlink_to(tmp_path / "outside.csv")
    (folder / "loop.csv").symlink_to(folder / "loop.csv")
    os.mkfifo(folder / "pipe.csv")
    with (folder / "big.csv").open("wb") as file:
        file.truncate(65_000_000)
    assert problems(path) == tuple(
        f"{at(cell)}: horizontal record: {line}" for cell, (_, line) in refused.items()
    )


def recorded(path, **texts):
    """Write records beside the workbook."""
    for name, text in texts.items():
        (path.parent / "records" / f"{name}.csv").write_text(text)
    return path


def timed(step, count):
    return "".join(f"{i * step:.2f},0.1\n" for i in range(count))


CHANNELS = "time (s),East (g),North (g),Up (g)\n" + "".join(
    f"{0.01 * i:.2f},{0.1 * i},{0.2 * i},{0.3 * i}\n" for i in range(101)
)
NAMES = "give one by name or number: 1 East; 2 North; 3 Up"
AS_IN_FILE = of("Motions/M1", {"Record units": None, "Time step": None})
PART = "0.1\n" * 100 + "0\n" * 100
STILL = {"Motions/M2/Horizontal record": "records/still.csv"}
SHORT = "<Motions/M2/Horizontal record>: horizontal record lasts"
NO_PEAK = "horizontal record is all zeros and cannot be scaled to a"

# Records, cells, and the resulting lines.
FAULTS = [
    ({"z": "0.1\nabc\n0.2\n"}, {},
     "<Motions/M1/Vertical record>: vertical record: z.csv:2: found 'abc'; give a number"),
    ({"x": timed(0.01, 150), "z": timed(0.02, 100)}, {"Motions/M1/Time step": None},
     "<Motions/M1/Vertical record>: vertical record has a time step of 0.02 s, but the horizontal"
     " record has 0.01 s; make them equal"),
    ({"all": CHANNELS},
     AS_IN_FILE | {"Motions/M1/Horizontal record": "records/all.csv",
                   "Motions/M1/Vertical record": "records/all.csv | Down"},
     f"<Motions/M1/Horizontal record>: horizontal record: all.csv: found several channels; {NAMES}",
     f"<Motions/M1/Vertical record>: vertical record: all.csv: found no channel 'Down'; {NAMES}"),
    ({"x3": "0\n" * 200}, {},
     f"<Motions/M3/Horizontal record>: {NO_PEAK} PPA; change the record or scaling"),
    *(({"x": PART}, of("Motions/M1", {"Scaling": scaling, "Factor or PPA": scale, "Start time": 1}),
       f"<Motions/M1/Horizontal record>: {NO_PEAK} {scaling}; change the record or scaling")
      for scaling, scale in (("PPA", 1), ("target spectrum", None))),
    # A verdict of OK followed from any of these.
    ({"still": "0\n" * 200}, STILL,
     "<Motions/M2/Horizontal record>: horizontal record is all zeros; give a record of the"
     " shaking"),
    ({"still": "0.1\n-0.1\n"}, STILL,
     f"{SHORT} 0.01 s as run (2 samples); give a record of 1 s or more"),
    ({"still": "0.1\n-0.1\n" * 50}, STILL,
     f"{SHORT} 0.99 s as run (100 samples); give a record of 1 s or more"),
    # Most of the weight was gone, or the block was pushed downslope by 1 g.
    ({"still": "1.1\n0.9\n" * 100}, STILL,
     "<Motions/M2/Horizontal record>: horizontal record has a mean of 1 g: gravity is in it; give"
     " it without, or remove the mean by the column Baseline"),
]  # fmt: skip


@pytest.mark.parametrize("case", FAULTS, ids=[lines[0][:70] for _, _, *lines in FAULTS])
def test_a_record_that_cannot_be_run_is_refused_at_its_cell(tmp_path, case):
    texts, cells, *lines = case
    assert problems(type_into(recorded(make(tmp_path), **texts), cells)) == said(*lines)


@pytest.mark.parametrize(
    ("cells", "wanted"),
    [
        # Units that neither file nor sheet states are requested; those that differ are reported.
        ({"Record units": "from file"},
         {"Horizontal record": "give units, one of", "Vertical record": "give units, one of"}),
        ({"Horizontal record": "records/all.csv | 1", "Vertical record": None,
          "Record units": "cm/s2"},
         {"Horizontal record": "horizontal record: all.csv:1: the file is in g but units"}),
        ({"Low-pass corner": 60},
         {"Horizontal record": "horizontal record: x.csv: low-pass corner is 60 Hz; give"}),
        # Records are checked even if their row has other errors.
        ({"ID": None, "Record units": "furlongs", "Horizontal record": "records/none.csv"},
         {"ID": "", "Horizontal record": "does not exist", "Record units": "furlongs"}),
    ],
)  # fmt: skip
def test_what_does_not_suit_a_record_is_reported_at_its_cell(tmp_path, cells, wanted):
    path = type_into(recorded(make(tmp_path), all=CHANNELS), of("Motions/M1", cells))
    for line, (heading, words) in zip(problems(path), wanted.items(), strict=True):
        assert line.startswith(at(f"<Motions/M1/{heading}>: "))
        assert words in line


def test_components_of_different_length_are_trimmed(tmp_path):
    path = recorded(make(tmp_path), x="0.1\n-0.2\n" * 100, z="0.1\n-0.2\n" * 98)
    book = read_workbook(path)
    assert len(book.motions[0].ax_mps2) == len(book.motions[0].az_mps2) == 196
    x, z = book.records[:2]
    assert (x.npts, x.npts_trimmed, z.npts_trimmed, z.notes) == (200, 4, 0, ())
    assert x.notes[-1] == "last 4 of 200 samples trimmed, to the length of the shortest component"
    # Not up to a common end time.
    book = read_workbook(type_into(path, {"Motions/M1/End time": 1.5}))
    assert len(book.motions[0].ax_mps2) == len(book.motions[0].az_mps2) == 151
    assert [record.npts_trimmed for record in book.records[:2]] == [0, 0]


@pytest.mark.parametrize("names", [("East", "north", " UP "), ("1", "2", "3")])
def test_channels_of_one_file_are_components(tmp_path, names):
    channels = dict(zip(("Horizontal", "Transverse", "Vertical"), names, strict=True))
    cells = {f"Motions/M1/{c} record": f"records/all.csv | {n}" for c, n in channels.items()}
    book = read_workbook(type_into(recorded(make(tmp_path), all=CHANNELS), cells | AS_IN_FILE))
    first = book.motions[0]
    for a, slope in ((first.ax_mps2, 0.1), (first.ay_mps2, 0.2), (first.az_mps2, 0.3)):
        assert a == pytest.approx(slope * 9.80665 * np.arange(101))
    assert book.records[1].name == f"records/all.csv | {names[1]}".strip()
    assert book.records[1].format == "text"


def test_records_are_processed_as_their_row_requests(tmp_path):
    row = {"Start time": 0.5, "End time": 1.5, "Baseline": "mean", "New time step": 0.005}
    cells = of("Motions/M1", row | {"Zero padding": 1})
    book = read_workbook(type_into(make(tmp_path), cells))
    first, prepared = book.motions[0], book.prepared[0]
    x = np.loadtxt(book.path.parent / "records" / "x.csv")[50:151] * 9.80665
    assert first.dt_s == 0.005
    assert first.ax_mps2[:201:2] == pytest.approx(x - x.mean())
    assert not first.ax_mps2[201:].any()
    assert len(first.ax_mps2) == len(first.az_mps2) == 201 + 200
    assert prepared.done.startswith("cut to 0.5 s to 1.5 s; mean removed")
    assert prepared.unfiltered == ()


def test_the_motion_without_its_high_pass_is_preserved_for_comparison(tmp_path):
    path = type_into(make(tmp_path), {"Motions/M1/High-pass corner": 2.0})
    book = read_workbook(path)
    (bare,) = book.prepared[0].unfiltered
    assert bare.ax_mps2 == pytest.approx(np.loadtxt(path.parent / "records/x.csv") * 9.80665)
    assert not np.allclose(book.motions[0].ax_mps2[: len(bare.ax_mps2)], bare.ax_mps2)


def test_a_ground_motion_is_carried_to_the_roof(tmp_path):
    cells = {"Motions/M1/Recorded at": "ground", "Building/Period T1": 0.5}
    book = read_workbook(type_into(make(tmp_path), cells))
    at_roof, prepared = book.motions[0], book.prepared[0]
    assert prepared.roof["horizontal"].building.periods_s[0] == 0.5
    assert np.array_equal(at_roof.ax_mps2, prepared.roof["horizontal"].a_mps2)
    assert book.prepared[1].roof == {}


def test_a_workbook_without_the_sheets_of_later_versions_is_read(tmp_path):
    def change(book):
        sides = [f"Roof {side}" for side in ("x from", "x to", "y from", "y to")]
        roof = (cell(book, f"Building/{label}") for label in (*sides, "Direction of north"))
        t_l = cell(book, "Site/Long-period transition T_L")
        for found in (*roof, t_l):
            found.offset(column=-1).value = None
        for title in ("Building", "Spectrum", "Links", "Friction tests", "Outlines"):
            book.remove(book[title])
        for name in list(book.defined_names):
            if name.startswith(("target_", "building_", "roof_")):
                del book.defined_names[name]

    assert same(read_workbook(edit(make(tmp_path), change)).input, project())


def test_one_horizontal_record_of_zeros_is_read_if_the_other_shakes(tmp_path):
    path = recorded(make(tmp_path), still="0\n" * 200)
    cells = STILL | {"Motions/M2/Transverse record": "records/x2.csv"}
    motion = read_workbook(type_into(path, cells)).motions[1]
    assert not motion.ax_mps2.any()
    assert motion.ay_mps2.any()
