"""Reading an input workbook: the project is recovered for any arrangement of the sheets."""

import datetime as dt
import hashlib
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from openpyxl import load_workbook
from openpyxl.utils import get_column_letter, range_boundaries
from openpyxl.worksheet.formula import ArrayFormula

from places import DATA
from report.sheet import schema
from report.sheet.schema import UnitsFirst
from report.sheet.template import write_template
from sheets import FT, edit, make, problems, project, read_workbook, same, type_into

DATA = DATA


@pytest.fixture(params=list(UnitsFirst))
def path(request, tmp_path):
    return make(tmp_path, request.param)


def test_a_project_is_read_as_it_was_written(path):
    assert same(read_workbook(path).input, project())


def test_a_folder_is_read_as_its_input_workbook(path):
    book = read_workbook(path.parent)
    assert book.path == path
    assert book.sha256 == hashlib.sha256(path.read_bytes()).hexdigest()


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
            "slope_unit": draw(st.sampled_from(schema.SlopeUnit)),
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
        "polarity": draw(st.sampled_from(schema.Polarity)),
        "source": draw(st.just("") | texts),
    }
    head = base.project.model_dump() | {
        "name": draw(texts),
        "date": draw(st.dates(dt.date(2000, 1, 2), dt.date(2100, 1, 1))),
        "units_first": draw(st.sampled_from(UnitsFirst)),
    }
    changes = {"project": head, "arrays": arrays, "motions": [motion], "clearances": []}
    return project(**changes, objects=[])


@pytest.mark.parametrize("examples", [3, pytest.param(30, marks=pytest.mark.nightly)])
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


def shift(book, title, rows):
    """Insert rows at the top of a sheet."""
    sheet = book[title]
    sheet.insert_rows(1, rows)
    for table in sheet.tables.values():
        left, top, right, bottom = range_boundaries(table.ref)
        first, last = (get_column_letter(column) for column in (left, right))
        table.ref = f"{first}{top + rows}:{last}{bottom + rows}"
    for name in book.defined_names.values():
        sheet_name, cell = name.attr_text.split("!")
        if sheet_name.strip("'") == title:
            moved = re.sub(r"(?<=\$)\d+", lambda row: str(int(row[0]) + rows), cell)
            name.attr_text = f"{sheet_name}!{moved}"


def rename(book, old, new):
    book[old].title = new
    for name in book.defined_names.values():
        name.attr_text = name.attr_text.replace(f"'{old}'!", f"'{new}'!")


def swap(book, title, first, second, rows):
    """Exchange two columns of a table."""
    sheet = book[title]
    table = next(iter(sheet.tables.values()))
    for row in rows:
        a, b = sheet[f"{first}{row}"], sheet[f"{second}{row}"]
        a.value, b.value = b.value, a.value
        a.number_format, b.number_format = b.number_format, a.number_format
    i, j = (ord(c) - ord("B") for c in (first, second))
    columns = table.tableColumns
    columns[i].name, columns[j].name = columns[j].name, columns[i].name


def move_table(book, title, columns, rows):
    sheet = book[title]
    table = next(iter(sheet.tables.values()))
    sheet.move_range(table.ref, rows=rows, cols=columns)
    left, top, right, bottom = range_boundaries(table.ref)
    first, last = (get_column_letter(column + columns) for column in (left, right))
    table.ref = f"{first}{top + rows}:{last}{bottom + rows}"


def forget_tables(book):
    for sheet in book.worksheets:
        for name in list(sheet.tables):
            del sheet.tables[name]


def forget_names(book):
    for name in list(book.defined_names):
        del book.defined_names[name]


def leave_blank_rows(book):
    sheet = book["Arrays"]
    sheet.move_range("B9:O9", rows=7)


def type_below_the_table(book):
    sheet = book["Arrays"]
    sheet.move_range("B9:O9", rows=30)


def hide_headings(book):
    book["Arrays"].tables["arrays_table"].headerRowCount = 0


def name_in_capitals(book):
    book["Arrays"].tables["arrays_table"].displayName = "ARRAYS_TABLE"


# Together where each can be told apart: no two move the same table or forget what finds it.
CHANGES = {
    "a table without heading row": hide_headings,
    "rows inserted above, sheets renamed": lambda book: [
        *(shift(book, s, 3) for s in ("Site", "Arrays", "Project")),
        *(rename(book, s, f"My {s}") for s in ("Site", "Arrays")),
    ],
    "sheets reordered and hidden, a name in other capitals": lambda book: [
        book.move_sheet("Motions", -5),
        setattr(book["Arrays"], "sheet_state", "hidden"),
        name_in_capitals(book),
    ],
    "columns reordered, blank rows between": lambda book: [
        swap(book, "Arrays", "C", "H", range(7, 11)),
        leave_blank_rows(book),
    ],
    "table moved": lambda book: move_table(book, "Arrays", 4, 10),
    "tables forgotten": forget_tables,
    "names forgotten": forget_names,
    "rows typed below the table": type_below_the_table,
}


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
@pytest.mark.by_day(2)
def test_arrangement_does_not_matter(tmp_path, change):
    assert same(read_workbook(edit(make(tmp_path), change)).input, project())


SPELLINGS = {
    "heading in capitals": ("Arrays!E7", " FRICTION\ncoefficient *"),
    "choices in capitals": ("Arrays!D8", " Degrees "),
    "numbers as text": ("Arrays!E8", " 0.45 "),
    "a date as text": ("Project!B11", "2026-03-05"),
    "a number as a text": ("Project!B12", 1),
    "a logical value for a yes": ("Options!B6", True),
    "notes beside the table": ("Arrays!Z9", "ask the client"),
    "notes far to the right": ("Arrays!GR9", "ask the client"),
}


def test_spelling_and_notes_do_not_matter(tmp_path):
    """All in one workbook: each is in a cell that no other depends on."""
    path = type_into(make(tmp_path), dict(SPELLINGS.values()))
    assert same(read_workbook(path).input, project())


def test_units_of_headings_and_cells_are_followed(tmp_path):
    cells = {
        "Arrays!I7": "CG height [mm]", "Arrays!I8": 250, "Arrays!I9": 1,
        "Arrays!H7": "Weight [kg]", "Arrays!H8": 1000, "Site!C16": "m", "Site!B16": 12,
    }  # fmt: skip
    data = read_workbook(type_into(make(tmp_path), cells)).input
    assert data.arrays[0].cg_height_m == pytest.approx(0.25)
    assert data.arrays[0].weight_n == pytest.approx(9806.65)
    assert data.site.structure_height_m == pytest.approx(12)
    assert data.site.roof_height_m == pytest.approx(36 * FT)


def test_a_blank_choice_takes_its_default(tmp_path):
    blank = dict.fromkeys(("Options!B5", "Options!B6", "Motions!L9"))
    book = read_workbook(type_into(make(tmp_path), blank))
    assert book.input.options == schema.Options()
    assert book.input.motions[1].polarity is schema.Polarity.BOTH
    assert ("B5", "", "rule set (default)") in [
        (row.cell, row.typed, row.value) for row in book.echo if row.sheet == "Options"
    ]


def test_an_unknown_heading_is_listed_in_the_echo(tmp_path):
    noted = {"Arrays!AA7": "Color", "Arrays!AA8": "black"}
    book = read_workbook(type_into(make(tmp_path), noted))
    (row,) = [row for row in book.echo if row.value.startswith("not an input")]
    assert (row.sheet, row.cell, row.label) == ("Arrays", "AA7", "column 'Color'")


def test_every_cell_is_echoed_as_typed_and_as_used(path):
    book = read_workbook(path)
    rows = {(row.sheet, row.cell): row for row in book.echo}
    weight = rows["Arrays", "H8"]
    assert (weight.label, weight.value) == ("Weight", "186825 N")
    assert (weight.typed, weight.unit) in [("42000", "lb"), ("186.825307841", "kN")]
    assert rows["Site", "B9"].value == "0.7 g"
    assert rows["Objects", "D9"].value == "—"
    assert rows["Options", "B6"].value == "Yes"
    fields = [(row.sheet, row.cell) for row in book.echo]
    assert len(fields) == len(set(fields))


# Formulas: openpyxl saves no values, so LibreOffice saved these.


@pytest.fixture
def saved(tmp_path):
    """The project as LibreOffice saved it, when its motions were one record."""
    path = make(tmp_path)
    path.write_bytes((DATA / "saved-by-libreoffice.xlsx").read_bytes())
    return type_into(path, {"Motions!C9": "records/x2.csv", "Motions!C10": "records/x3.csv"})


def test_a_workbook_saved_by_libreoffice_reads_the_same(saved):
    assert same(read_workbook(saved).input, project())


def test_formulas_use_their_saved_values_and_are_shown_in_the_echo(saved):
    rows = {(row.sheet, row.cell): row.typed for row in read_workbook(saved).echo}
    assert rows["Arrays", "E8"] == "=0.4+0.05 → 0.45"
    assert rows["Arrays", "E9"] == "=E8 → 0.45"


def test_an_array_formula_without_a_value_is_reported_like_any_other(tmp_path):
    formula = ArrayFormula("E8", "=SUM(C8:C9*0)")
    path = edit(make(tmp_path), lambda book: book["Arrays"].__setitem__("E8", formula))
    assert problems(path)[0].startswith(
        "Arrays!E8: friction coefficient is a formula with no saved value (=SUM(C8:C9*0));"
    )


# Motions.


def test_motions_are_scaled_and_signed_as_requested(tmp_path):
    book = read_workbook(make(tmp_path))
    m1, m2, m3 = book.motions
    assert [m.id for m in book.motions] == ["M1", "M2", "M3"]
    assert (m1.scale, m1.signs, m1.has_vertical, m1.source) == (1.0, (1, -1), True, "made")
    assert (m2.scale, m2.signs, m2.has_vertical) == (2.0, (-1,), False)
    assert m3.signs == (1,)
    assert m3.scale * np.abs(m3.ax_mps2).max() == pytest.approx(1.5 * 9.80665, rel=1e-12)
    assert (m1.dt_s, m3.dt_s) == (0.01, 0.02)


def test_motions_are_read_only(tmp_path):
    for motion in read_workbook(make(tmp_path)).motions:
        assert not motion.ax_mps2.flags.writeable
        assert not motion.az_mps2.flags.writeable


def test_a_transverse_record_is_run_beside_the_horizontal_one(tmp_path):
    motions = [motion.model_dump() for motion in project().motions]
    motions[0] |= {"transverse": "records/y.csv"}
    path = make(tmp_path, motions=motions)
    (path.parent / "records" / "y.csv").write_text("0.1\n" * 200)
    book = read_workbook(path)
    m1, m2, _ = book.motions
    assert np.allclose(m1.ay_mps2, 0.980665)
    assert [heading.name for heading in m1.headings] == [
        "record +",
        "record −",
        "transverse +",
        "transverse −",
    ]
    assert [heading.name for heading in m2.headings] == ["record −"]
    assert [r.component for r in book.records[:3]] == ["horizontal", "transverse", "vertical"]
    assert not m2.ay_mps2.flags.writeable


def test_records_are_listed_with_their_hashes(tmp_path):
    path = make(tmp_path)
    records = read_workbook(path).records
    assert [(r.motion_id, r.component, r.name) for r in records] == [
        ("M1", "horizontal", "records/x.csv"),
        ("M1", "vertical", "records/z.csv"),
        ("M2", "horizontal", "records/x2.csv"),
        ("M3", "horizontal", "records/x3.csv"),
    ]
    data = (path.parent / "records" / "z.csv").read_bytes()
    assert records[1].sha256 == hashlib.sha256(data).hexdigest()
    assert records[1].npts == 200
    assert records[1].peak_g == pytest.approx(0.25, abs=1e-4)


def test_names_of_records_may_have_the_slashes_of_windows(tmp_path):
    path = type_into(make(tmp_path), {"Motions!C8": "records\\x.csv"})
    assert len(read_workbook(path).motions) == 3


WITHIN = "give a file in the workbook's folder, such as records/m1-x.csv"


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("records/long_nmae.csv", "records/long_name.csv"),
        ("records/Long_Name.CSV", "records/long_name.csv"),
        ("records/long_name.at", "records/long_name.at2"),
        ("recs/long_name.at2", "records/long_name.at2"),
        ("long_name.csv | EW", "records/long_name.csv"),
    ],
)
@pytest.mark.by_day(2)
def test_a_file_name_that_nearly_fits_is_asked_about(tmp_path, name, meant):
    path = type_into(make(tmp_path), {"Motions!C8": name})
    for kind in ("at2", "csv"):
        (path.parent / "records" / f"long_name.{kind}").write_text("acc_g\n0\n1\n")
    (problem,) = problems(path)
    asked = name.partition(" |")[0]
    assert problem.endswith(f"'{asked}' does not exist; did you mean '{meant}'?")


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
    ("input.xlsx", "input.xlsx: not a text file; give the text of a record"),
]


@pytest.mark.parametrize("at", range(0, len(REFUSED), 3))
def test_a_record_must_be_a_file_within_the_folder(tmp_path, at):
    """Three at a time: the workbook has three motions."""
    folder = tmp_path / "job"
    refused = {f"Motions!C{row}": case for row, case in enumerate(REFUSED[at : at + 3], start=8)}
    path = type_into(make(folder), {cell: name for cell, (name, _) in refused.items()})
    (tmp_path / "outside.csv").write_text("0.1\n0.2\n")
    (folder / "link.csv").symlink_to(tmp_path / "outside.csv")
    (folder / "loop.csv").symlink_to(folder / "loop.csv")
    os_pipe(folder / "pipe.csv")
    with (folder / "big.csv").open("wb") as file:
        file.truncate(65_000_000)
    assert problems(path) == tuple(
        f"{cell}: horizontal record: {line}" for cell, (_, line) in refused.items()
    )


def os_pipe(path):
    import os

    os.mkfifo(path)


def test_an_invalid_line_of_a_record_is_reported_with_its_file_and_number(tmp_path):
    path = make(tmp_path)
    (path.parent / "records" / "z.csv").write_text("0.1\nabc\n0.2\n")
    assert problems(path) == ("Motions!E8: vertical record: z.csv:2: found 'abc'; give a number",)


def test_components_of_different_step_are_rejected(tmp_path):
    path = make(tmp_path)
    for name, step, count in (("x", 0.01, 50), ("z", 0.02, 40)):
        text = "".join(f"{i * step:.2f},0.1\n" for i in range(count))
        (path.parent / "records" / f"{name}.csv").write_text(text)
    others = [f"Motions!{column}{row}" for column in "BCDEFGHIJL" for row in (9, 10)]
    assert problems(type_into(path, dict.fromkeys(["Motions!G8", *others]))) == (
        "Motions!E8: vertical record has a time step of 0.02 s, but the horizontal record has 0.01"
        " s; make them equal",
    )


def test_components_of_different_length_are_trimmed_to_the_shortest(tmp_path):
    path = make(tmp_path)
    for name, count in (("x", 200), ("z", 196)):
        (path.parent / "records" / f"{name}.csv").write_text("0.1\n-0.2\n" * (count // 2))
    book = read_workbook(path)
    assert len(book.motions[0].ax_mps2) == len(book.motions[0].az_mps2) == 196
    x, z = (record for record in book.records if record.motion_id == "M1")
    assert (x.npts, x.npts_trimmed, z.npts_trimmed) == (200, 4, 0)
    assert x.notes[-1] == "last 4 of 200 samples trimmed, to the length of the shortest component"
    assert z.notes == ()


def test_nothing_is_trimmed_up_to_a_common_end_time(tmp_path):
    path = make(tmp_path)
    for name, count in (("x", 200), ("z", 196)):
        (path.parent / "records" / f"{name}.csv").write_text("0.1\n-0.2\n" * (count // 2))
    book = read_workbook(type_into(path, {"Motions!N8": 1.5}))
    assert len(book.motions[0].ax_mps2) == len(book.motions[0].az_mps2) == 151
    assert [record.npts_trimmed for record in book.records if record.motion_id == "M1"] == [0, 0]


CHANNELS = "time (s),East (g),North (g),Up (g)\n" + "".join(
    f"{0.01 * i:.2f},{0.1 * i},{0.2 * i},{0.3 * i}\n" for i in range(101)
)


@pytest.mark.parametrize("names", [("East", "north", " UP "), ("1", "2", "3")])
def test_channels_of_one_file_are_components(tmp_path, names):
    path = make(tmp_path)
    (path.parent / "records" / "all.csv").write_text(CHANNELS)

    cells = {f"Motions!{c}8": f"records/all.csv | {n}" for c, n in zip("CDE", names, strict=True)}
    of_file = {"Motions!F8": None, "Motions!G8": None}  # the file says its units and times
    book = read_workbook(type_into(path, cells | of_file))
    first = book.motions[0]
    for a, slope in zip(
        (first.ax_mps2, first.ay_mps2, first.az_mps2), (0.1, 0.2, 0.3), strict=True
    ):
        assert a == pytest.approx(slope * 9.80665 * np.arange(101))
    assert book.records[1].name == f"records/all.csv | {names[1]}".strip()
    assert book.records[1].format == "text"


def test_an_unnamed_or_missing_channel_is_reported_with_the_names(tmp_path):
    path = make(tmp_path)
    (path.parent / "records" / "all.csv").write_text(CHANNELS)

    cells = {"Motions!C8": "records/all.csv", "Motions!E8": "records/all.csv | Down"}
    cells |= {"Motions!F8": None, "Motions!G8": None}
    names = "give one by name or number: 1 East; 2 North; 3 Up"
    assert problems(type_into(path, cells)) == (
        f"Motions!C8: horizontal record: all.csv: found several channels; {names}",
        f"Motions!E8: vertical record: all.csv: found no channel 'Down'; {names}",
    )


def test_units_that_neither_file_nor_sheet_states_are_requested(tmp_path):
    path = type_into(make(tmp_path), {"Motions!F8": "from file"})
    reported = problems(path)
    assert [line.split(": ")[0] for line in reported] == ["Motions!C8", "Motions!E8"]
    assert all("give units, one of" in line for line in reported)


def test_units_that_differ_between_file_and_sheet_are_reported(tmp_path):
    path = make(tmp_path)
    (path.parent / "records" / "all.csv").write_text(CHANNELS)
    cells = {"Motions!C8": "records/all.csv | 1", "Motions!E8": None, "Motions!F8": "cm/s2"}
    (line,) = problems(type_into(path, cells))
    assert line.startswith("Motions!C8: horizontal record: all.csv:1: the file is in g but units")


def test_records_are_processed_as_their_row_requests(tmp_path):
    row = {"M": 0.5, "N": 1.5, "O": "mean", "S": 0.005, "T": 1}
    cells = {f"Motions!{column}8": value for column, value in row.items()}
    book = read_workbook(type_into(make(tmp_path), cells))
    first = book.motions[0]
    x = np.loadtxt(book.path.parent / "records" / "x.csv")[50:151] * 9.80665
    level = x - x.mean()
    assert first.dt_s == 0.005
    assert first.ax_mps2[:201:2] == pytest.approx(level)
    assert not first.ax_mps2[201:].any()
    assert len(first.ax_mps2) == len(first.az_mps2) == 201 + 200
    assert book.prepared[0].done.startswith("cut to 0.5 s to 1.5 s; mean removed")
    assert book.prepared[0].unfiltered == ()


def test_the_motion_without_its_high_pass_is_preserved_for_comparison(tmp_path):
    path = type_into(make(tmp_path), {"Motions!P8": 2.0})
    book = read_workbook(path)
    (bare,) = book.prepared[0].unfiltered
    assert bare.ax_mps2 == pytest.approx(np.loadtxt(path.parent / "records/x.csv") * 9.80665)
    assert not np.allclose(book.motions[0].ax_mps2[: len(bare.ax_mps2)], bare.ax_mps2)


def test_processing_that_does_not_suit_a_record_is_reported(tmp_path):
    path = type_into(make(tmp_path), {"Motions!Q8": 60})
    (line,) = problems(path)
    assert line.startswith("Motions!C8: horizontal record: x.csv: low-pass corner is 60 Hz; give")


def test_a_ground_motion_is_carried_to_the_roof(tmp_path):
    cells = {"Motions!K8": "ground", "Building!B6": 0.5}
    book = read_workbook(type_into(make(tmp_path), cells))
    at_roof, prepared = book.motions[0], book.prepared[0]
    assert prepared.roof["horizontal"].building.periods_s[0] == 0.5
    assert np.array_equal(at_roof.ax_mps2, prepared.roof["horizontal"].a_mps2)
    assert book.prepared[1].roof == {}


def test_a_workbook_without_the_sheets_of_later_versions_is_read(tmp_path):
    def change(book):
        for title in ("Building", "Spectrum"):
            book.remove(book[title])
        for name in [n for n in book.defined_names if n.startswith(("target_", "building_"))]:
            del book.defined_names[name]
        for row in range(9, 17):
            book["Options"][f"A{row}"] = None

    data = read_workbook(edit(make(tmp_path), change)).input
    assert same(data, project())


def test_a_record_of_zeros_cannot_be_scaled_to_a_peak(tmp_path):
    path = make(tmp_path)
    (path.parent / "records" / "x3.csv").write_text("0\n0\n0\n")
    assert (
        "Motions!C10: horizontal record is all zeros and cannot be scaled to a PPA; change the"
        " record or scaling" in problems(path)
    )


@pytest.mark.parametrize(
    ("scaling", "goal"), [("PPA", "a PPA"), ("target spectrum", "a target spectrum")]
)
def test_a_part_of_zeros_cannot_be_scaled_either(tmp_path, scaling, goal):
    path = make(tmp_path)
    (path.parent / "records" / "x.csv").write_text("0.1\n" * 100 + "0\n" * 100)
    scale = 1 if scaling == "PPA" else None
    cells = {"Motions!H8": scaling, "Motions!I8": scale, "Motions!M8": 1.5}
    assert problems(type_into(path, cells)) == (
        f"Motions!C8: horizontal record is all zeros and cannot be scaled to {goal}; change the"
        " record or scaling",
    )


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("0\n" * 200, "horizontal record is all zeros; give a record of the shaking"),
        (
            "0.1\n-0.1\n",
            "horizontal record lasts 0.01 s as run (2 samples); give a record of 1 s or more",
        ),
        (
            "0.1\n-0.1\n" * 50,
            "horizontal record lasts 0.99 s as run (100 samples); give a record of 1 s or more",
        ),
    ],
)
def test_a_record_without_shaking_is_refused(tmp_path, text, words):
    # A verdict of OK followed from any of these.
    path = make(tmp_path)
    (path.parent / "records" / "still.csv").write_text(text)
    changed = type_into(path, {"Motions!C9": "records/still.csv"})
    assert problems(changed) == (f"Motions!C9: {words}",)


def test_one_horizontal_record_of_zeros_is_read_if_the_other_shakes(tmp_path):
    path = make(tmp_path)
    (path.parent / "records" / "still.csv").write_text("0\n" * 200)
    cells = {"Motions!C9": "records/still.csv", "Motions!D9": "records/x2.csv"}
    motion = read_workbook(type_into(path, cells)).motions[1]
    assert not motion.ax_mps2.any()
    assert motion.ay_mps2.any()


def test_records_are_checked_even_if_their_row_has_other_errors(tmp_path):
    cells = {"Motions!B9": None, "Motions!F9": "furlongs", "Motions!C9": "records/none.csv"}
    assert [line.split(":")[0] for line in problems(type_into(make(tmp_path), cells))] == [
        "Motions!B9",
        "Motions!C9",
        "Motions!F9",
    ]


def test_the_workbook_on_disk_is_never_changed(tmp_path):
    path = make(tmp_path)
    before = path.read_bytes()
    read_workbook(path)
    assert path.read_bytes() == before
    assert load_workbook(path)
