"""Records of a folder that are the components of a motion, and records pasted into a sheet."""

import datetime as dt
import re

import numpy as np
import pytest

from fixtures.marks import by_day
from fixtures.paths import RECORDS, SAMPLES
from fixtures.records import write_record
from fixtures.workbooks import (
    cell_address,
    edit,
    make,
    problems,
    read_workbook,
    type_into,
    with_addresses,
)
from report.motions.sets import LENGTHS_WITHIN, STARTS_WITHIN, sets_of, table
from solver.errors import InputError


def peer(path, component, dt_s=0.01):
    """A record of PEER, whose heading names its component."""
    values = "\n".join(f"{0.1 * np.sin(0.3 * k):.7E}" for k in range(100))
    heading = f"PEER\nKOBE 01/16/95, KJMA, {component}\nACCELERATION IN UNITS OF G\n"
    path.write_text(f"{heading}NPTS= 100, DT= {dt_s:.4f} SEC\n{values}\n")


def taken(folder):
    sets, left = sets_of(folder)
    named = {name: [each.name for each in group] for name, group in sets.items()}
    return named, {re.sub(r" \([^()]*\)", "", what): why for what, why in left}


@pytest.mark.parametrize(
    ("names", "motion"),
    [
        ("PET-000 PET-090 PET-UP", "PET"),
        ("KJM_H1 KJM_H2 KJM_V", "KJM"),
        ("RM1-x RM1-y RM1-z", "RM1"),
        ("CI.PAS.HNE CI.PAS.HNN CI.PAS.HNZ", "CI.PAS"),
        ("PAS.HN1 PAS.HN2 PAS.HNZ", "PAS"),
        ("AKT_E-W AKT_N-S AKT_U-D", "AKT"),
        ("A-ELC180 A-ELC270 A-ELC-UP", "A-ELC"),
        ("site_45 site_135 site_vert", "site"),
        ("WTMC_N28W WTMC_S62W WTMC_up", "WTMC"),
        ("ABC180 ABC270 ABCVRT", "ABC"),
        ("ABCN45E ABCN45W ABC-UP", "ABC"),
        ("ITACA-NS ITACA-WE ITACA-UP", "ITACA"),
        ("x y z", "quake"),
        ("RSN6_FN RSN6_FP RSN6_UP", "RSN6"),
        ("EQ1_R EQ1_T EQ1_V", "EQ1"),
        ("EQ1_Long EQ1_Trans EQ1_Vert", "EQ1"),
    ],
)
def test_sets_of_three_are_told_by_the_ends_of_names(tmp_path, names, motion):
    for name in names.split():
        write_record(tmp_path / "quake" / f"{name}.csv")
    (found,), left = taken(tmp_path)[0].items(), taken(tmp_path)[1]
    assert left == {}
    assert found[0] == motion
    first, second, vertical = (f"quake/{name}.csv" for name in names.split())
    assert {*found[1][:2]} == {first, second}
    assert found[1][2] == vertical


def asc(path, component):
    """A record as ESM and ITACA give it, whose heading names its component."""
    values = "\n".join(f"{10 * np.sin(0.3 * k):.6f}" for k in range(100))
    heading = f"SAMPLING_INTERVAL_S: 0.01\nNDATA: 100\nSTREAM: {component}\nUNITS: cm/s^2\n"
    path.write_text(f"{heading}{values}\n")


@pytest.mark.parametrize(
    ("name", "motion"),
    [
        ("HI.ARS1..{}.D.20190728.010101.C.ACC.MP", "HI.ARS1..D.20190728.010101.C.ACC.MP"),
        ("E.ABC.{}.D.2001", "E.ABC.D.2001"),
        ("{}_2001-01-01_ABC", "2001-01-01_ABC"),
        ("ABC__{}__2001", "ABC__2001"),
    ],
)
def test_the_word_of_the_heading_is_taken_out_wherever_it_stands_in_the_name(
    tmp_path, name, motion
):
    words = ("E", "N", "Z") if name.startswith("E.") else ("HNE", "HNN", "HNZ")
    for word in words:
        asc(tmp_path / f"{name.format(word)}.ASC", word)
    expected = [f"{name.format(word)}.ASC" for word in words]
    assert taken(tmp_path) == ({motion: expected}, {})


def test_the_location_in_the_identity_of_a_channel_is_no_azimuth(tmp_path):
    times = "20180101T000000Z__20180101T000200Z"
    for word in ("HNE", "HNN", "HNZ"):
        asc(tmp_path / f"BK.TCAS.00.{word}__{times}.asc", f"BK.TCAS.00.{word}")
    sets, left = taken(tmp_path)
    assert left == {}
    ((motion, group),) = sets.items()
    # An ID has at most 40 letters.
    assert motion == "BK.TCAS.00.20180101T000000Z"
    assert [name.split("__")[0][-3:] for name in group] == ["HNE", "HNN", "HNZ"]


@pytest.mark.parametrize(
    ("names", "why"),
    [
        ("PET-000 PET-090", "2 horizontal and 0 vertical of one motion; a set has 2 and 1;"
         " --without-vertical uses the two"),
        ("P-000 P-090 P-180 P-UP", "3 horizontal and 1 vertical of one motion; a set has 2 and 1"),
        ("P-000 P-180 P-UP", "the names of the horizontal components are not perpendicular"),
        ("P-000 P-090 P-DWN", "P-DWN.csv is positive downward: enter it with factor -1, as motion"
         " convert --factor -1 writes it"),
    ],
)  # fmt: skip
def test_what_is_not_clear_is_left_with_the_reason(tmp_path, names, why):
    for name in names.split():
        write_record(tmp_path / f"{name}.csv")
    sets, left = taken(tmp_path)
    assert sets == {}
    ((what, said),) = left.items()
    assert said == why
    assert sorted(what.split(", ")) == sorted(f"{name}.csv" for name in names.split())


@pytest.mark.parametrize("names", ["one two three", "site1 site2 site3", "a-x b-y c-z"])
def test_records_without_a_common_name_make_no_set(tmp_path, names):
    for name in names.split():
        write_record(tmp_path / f"{name}.csv")
    sets, left = taken(tmp_path)
    assert (sets, len(left)) == ({}, 3)


@pytest.mark.parametrize(
    ("dt_s", "count", "why"),
    [
        (0.02, 100, "time steps differ: 0.01 to 0.02 s"),
        (0.01, 94, "lengths differ: 94 to 100 samples"),
        (0.01, 95, ""),
    ],
)
def test_components_have_one_time_step_and_about_one_length(tmp_path, dt_s, count, why):
    assert LENGTHS_WITHIN == 0.05
    for axis in "xy":
        write_record(tmp_path / f"A-{axis}.csv")
    write_record(tmp_path / "A-z.csv", dt_s, count)
    sets, left = taken(tmp_path)
    assert (list(sets), list(left.values())) == (([], [why]) if why else (["A"], []))


@pytest.mark.parametrize(
    ("later", "why"),
    [
        ("2003/01/02 03:04:21", ""),
        ("2003/01/02 03:04:22", "start times differ: 2003-01-02 03:04:20 to 2003-01-02 03:04:22"),
        ("(none)", ""),
    ],
)
def test_components_begin_at_one_time_where_their_headings_say_when(tmp_path, later, why):
    assert dt.timedelta(seconds=1) == STARTS_WITHIN
    record = (SAMPLES / "knet.ns").read_text()
    for end, direction in (("NS", "N-S"), ("EW", "E-W"), ("UD", "U-D")):
        text = record.replace("N-S", direction)
        if end == "UD":
            text = text.replace("2003/01/02 03:04:20", later)
        (tmp_path / f"AKT.{end}").write_text(text)
    sets, left = taken(tmp_path)
    assert (list(sets), list(left.values())) == (([], [why]) if why else (["AKT"], []))


def test_headings_go_before_names_and_must_not_contradict_them(tmp_path):
    for number, component in (("012", "272 (STA 7)"), ("013", "UP (STA 7)"), ("014", "2 (STA 7)")):
        peer(tmp_path / f"free_CHAN{number}.AT2", component)
    for end, component in (("021", "21"), ("111", "111"), ("-UP", "UP")):
        peer(tmp_path / f"RSN4_36695{end}.AT2", component)
    for end, component in (("000", "0 (STA 7)"), ("090", "90 (STA 8)"), ("UP", "UP (STA 7)")):
        peer(tmp_path / f"two-{end}.AT2", component)
    peer(tmp_path / "wrong-UP.AT2", "180")
    peer(tmp_path / "wrong-090.AT2", "180")
    sets, left = taken(tmp_path)
    assert sets == {
        "RSN4_36695": [f"RSN4_36695{end}.AT2" for end in ("021", "111", "-UP")],
        "free": [f"free_CHAN{number}.AT2" for number in ("014", "012", "013")],
    }
    why = "its heading (180) and its name state different components"
    assert left["wrong-UP.AT2"] == left["wrong-090.AT2"] == why
    assert left["two-090.AT2"].startswith("1 horizontal and 0 vertical")


def test_the_heading_tells_where_a_glued_name_ends(tmp_path):
    for end, component in (("180", "180"), ("270", "270"), ("UP", "UP")):
        peer(tmp_path / f"RSN9_ABC{end}.AT2", component)
    for end, component in (("N45E", "N45E"), ("N45W", "N45W"), ("DWN", "DOWN")):
        peer(tmp_path / f"RSN8_ABC{end}.AT2", component)
    sets, left = taken(tmp_path)
    assert sets == {"RSN9_ABC": [f"RSN9_ABC{end}.AT2" for end in ("180", "270", "UP")]}
    ((what, why),) = left.items()
    assert what == "RSN8_ABCN45E.AT2, RSN8_ABCN45W.AT2, RSN8_ABCDWN.AT2"
    assert why.startswith("RSN8_ABCDWN.AT2 is positive downward: enter it with factor -1")


def channel(path, name, component):
    """A channel of CSMIP, whose heading names its component."""
    text = (SAMPLES / name).read_text()
    path.parent.mkdir(exist_ok=True)
    path.write_text(re.sub(r"(?im)^chan +1: +\d+ deg", f"Chan  1: {component}", text))


def test_files_named_by_their_channel_alone_are_a_set_and_the_corrected_one_is_taken(tmp_path):
    for number, component in enumerate(("90 deg", "Up", "0 deg"), start=1):
        channel(tmp_path / "CE99" / f"chan00{number}.v2", "csmip-new.v2", component)
        channel(tmp_path / "CE99" / f"chan00{number}.v1", "csmip-step.raw", component)
    sets, left = taken(tmp_path)
    assert sets == {"CE99": [f"CE99/chan00{number}.v2" for number in (3, 1, 2)]}
    assert list(left.values()) == ["uncorrected; the corrected records are used"]


def test_two_horizontal_records_are_a_set_where_that_is_asked(tmp_path):
    for name in ("P-000", "P-090", "Q-000", "Q-090", "Q-UP", "R-000"):
        write_record(tmp_path / f"{name}.csv")
    sets, left = sets_of(tmp_path, without_vertical=True)
    assert {name: len(group) for name, group in sets.items()} == {"P": 2, "Q": 3}
    assert [what for what, _ in left] == ["R-000.csv (horizontal 0 deg)"]


def test_the_table_says_what_each_file_was_taken_for(tmp_path):
    for name in ("K-NS", "K-EW", "K-UD", "M-H1"):
        write_record(tmp_path / f"{name}.csv")
    sets, left = sets_of(tmp_path)
    words = ["horizontal e", "horizontal n", "vertical, positive up"]
    assert [each.taken_for for each in sets["K"]] == words
    assert all(word in line for word, line in zip(words, list(table(sets))[1:], strict=True))
    assert left[0][0] == "M-H1.csv (horizontal h1)"


def test_several_channels_of_a_file_are_named_as_in_the_sheet(tmp_path):
    rows = "".join(f"{0.01 * k:.2f},0.1,{0.2 * (k % 2)},0.{k}\n" for k in range(8))
    (tmp_path / "PAS.csv").write_text(f"time [s],HNZ [g],HNN [g],HNE [g]\n{rows}")
    (tmp_path / "many.csv").write_text(f"time [s],a [g],b [g],c [g]\n{rows}")
    sets, left = taken(tmp_path)
    assert sets == {"PAS": ["PAS.csv | HNE", "PAS.csv | HNN", "PAS.csv | HNZ"]}
    assert left == {"many.csv": "neither its heading (a) nor its name states a component"}
    row = "PAS     x  PAS.csv | HNE  horizontal e             0.01        8  text"
    assert row in list(table(sets_of(tmp_path)[0]))


def test_a_name_of_two_sets_or_too_long_for_an_id_is_left(tmp_path):
    for name in ("a/M", "b/M", f"{'n' * 41}/x", "c/K"):
        for axis in "xyz":
            write_record(tmp_path / f"{name}-{axis}.csv")
    for axis in "xyz":
        write_record(tmp_path / "d" / f"{'q' * 41}-{axis}.csv")
    sets, left = taken(tmp_path)
    assert list(sets) == ["K", "x"]
    assert len(left) == 3
    names = {
        why.partition(";")[0].removeprefix("several sets have the name ") for why in left.values()
    }
    assert names == {"M", "q" * 41}


def test_hidden_files_and_numbers_that_are_no_azimuth_are_no_components(tmp_path):
    for name in (".git/A-x", "__MACOSX/A-x", ".A-x", "B.400", "C.x²", "D-361"):
        write_record(tmp_path / f"{name}.csv")
    (tmp_path / "B.²").write_bytes((tmp_path / "D-361.csv").read_bytes())
    sets, left = taken(tmp_path)
    assert (sets, sorted(left)) == ({}, ["B.400.csv", "B.²", "C.x².csv", "D-361.csv"])
    assert all("nor its name states a component" in why for why in left.values())


def test_more_files_than_a_session_takes_are_refused(tmp_path):
    for number in range(501):
        (tmp_path / f"{number}.csv").touch()
    with pytest.raises(InputError, match="has 501 files, more than 500"):
        sets_of(tmp_path)


@pytest.mark.skipif(not RECORDS.is_dir(), reason="the real records are not on this machine")
def test_real_records_are_told_by_their_headings():
    sets, left = taken(RECORDS)
    channels = {name: [each.partition("| ")[2][:16] for each in sets[name]] for name in sets}
    assert channels == {
        "20161113_110259_WTMC_20": ["Component S62W T", "Component N28W L", "Component Up Ver"],
        "20161113_110300_HSES_20": ["Component N10E L", "Component N80W T", "Component Up Ver"],
        "Free_Field": [""] * 3,
        "angol1002271parte1": ["CHAN 1: EW (STA ", "CHAN 2: NS (STA ", "CHAN 3: V (STA C"],
        "llolleo1002271": ["CHAN 1: L (STA C", "CHAN 3: T (STA C", "CHAN 2: V (STA C"],
    }  # fmt: skip
    # Three channels of one structure at different places are no set.
    assert sum("Structure_CHAN" in what for what in left) == 3


RECORD = "Motions/M2/Horizontal record"


def pasted(values, header="North", name="Pasted!North"):
    """Return the cells of a pasted column that M2 uses."""
    below = {f"Pasted!B{row}": value for row, value in enumerate(values, start=4)}
    return {"Pasted!B3": header, RECORD: name} | below


def timed(times, header="time_s"):
    """Return the cells of such a column with times beside it."""
    beside = {f"Pasted!A{row}": time for row, time in enumerate(times, start=4)}
    return pasted([0.1] * (len(times) - 1) + [-0.1]) | {"Pasted!A3": header} | beside


@pytest.fixture(scope="module")
def with_sheet(tmp_path_factory):
    """The bytes of the usual workbook with a sheet Pasted."""
    path = make(tmp_path_factory.mktemp("pasted"))
    return edit(path, lambda book: book.create_sheet("Pasted").append(["laboratory"])).read_bytes()


@pytest.fixture
def paste(tmp_path, with_sheet):
    """A function that types cells into such a workbook beside its records, and returns its path."""

    def type_cells(cells):
        path = make(tmp_path)
        path.write_bytes(with_sheet)
        return type_into(path, cells)

    return type_cells


@pytest.mark.parametrize("name", by_day(["pasted!north", "'Pasted'!North"], 1))
def test_a_pasted_column_is_a_record(paste, name):
    book = read_workbook(paste(pasted([0.1, "0.2", -0.3, 0] * 26, name=name)))
    expected = np.array([0.1, 0.2, -0.3, 0] * 26) * 9.80665
    assert book.motions[1].ax_mps2 == pytest.approx(expected)
    assert (book.records[2].name, book.records[2].npts) == (name, 104)


@pytest.mark.parametrize(
    ("header", "per_row"),
    by_day([("time_s", 0.01), ("t [ms]", 10.0), ("Time [min]", 0.01 / 60.0)], 1),
)
def test_a_pasted_column_agrees_with_the_times_and_units_beside_it(paste, header, per_row):
    cells = timed([per_row * i for i in range(104)], header)
    name = {"Pasted!B3": "North [g]", RECORD: "Pasted!North [g]"}
    assert read_workbook(paste(cells | name)).records[2].npts == 104


BLANK = "is blank, next to or above values; fill it in, or delete its row"
PASTED = f"<{RECORD}>: horizontal record:"


@pytest.mark.parametrize(
    ("cell", "code", "line"),
    by_day([("B6", '0.0" m/s²"', "0.1, shown in m/s²"), ("A6", '0.00" ms"', "0.02, shown in ms"),
     ("A6", '0.00" s"', None)], 1),
)  # fmt: skip
def test_a_pasted_column_is_shown_in_its_units(paste, cell, code, line):
    cells = timed([0.01 * i for i in range(104)], "t [s]")
    path = edit(paste(cells), lambda book: setattr(book["Pasted"][cell], "number_format", code))
    if line is None:
        read_workbook(path)
    else:
        line = cell_address(f"{PASTED} Pasted!{cell} is {line} by its number format")
        assert problems(path)[0].startswith(line)


@pytest.mark.parametrize(
    ("cells", "lines"),
    by_day([
        (pasted([0.1, "abc", 0.2]), ["Pasted!B5 is 'abc'; enter a number"]),
        (pasted([0.1, "#N/A", 0.2]),
         ["Pasted!B5 is #N/A; correct the formula, or type a value"]),
        (pasted([0.1, None, 0.2]), [f"Pasted!B5 {BLANK}"]),
        (pasted(["x"] * 8),
         [*(f"Pasted!B{row} is 'x'; enter a number" for row in range(4, 9)),
          "... and 3 more cells"]),
        (pasted([0.1, 0.2], header="East"),
         ["worksheet 'Pasted' has no heading 'North' in its first 10 rows; write it above the"
          " column"]),
        (pasted([0.1, 0.2], name="Elsewhere!North"),
         ["'Elsewhere!North' is not a worksheet of this workbook; enter Sheet!Header, or a file"]),
        (pasted([0.1, 0.2], header="North [m/s2]", name="Pasted!North [m/s2]"),
         ["Pasted!B3 is 'North [m/s2]', but the record units are g; correct one of them"]),
        (pasted([0.1, 0.2], header="North [km/s2]", name="Pasted!North [km/s2]"),
         ["Pasted!B3 is 'North [km/s2]', which is not an acceleration history; enter the column of"
          " one"]),
        (pasted([0.1, 0.2], header="Total [g]", name="Pasted!Total [g]"),
         ["Pasted!B3 is 'Total [g]', the magnitude of a vector; use a component"]),
        (pasted([0.1, 0.2, 0.0] * 4),
         ["Pasted!B3 is 'North', and no value below it is less than zero: this is a curve or a"
          " magnitude, not a record; use a component, or a heading such as acc_g if it is one"]),
        (pasted([0.1, -999, 0.2]),
         ["Pasted!North: sample 2 is -999 where no other exceeds 0.2 g; this is a code for missing"
          " data; use a record without gaps"]),
        (pasted([150.0, -290.0, 0.2]),
         ["Pasted!North: the values reach 290 g, which is more than 10 g; are they in"
          " cm/s2? Enter the correct units, or correct the values"]),
        (timed([0.0, 0.02, 0.04, 0.06]),
         ["Pasted!A3 has times at a step of 0.02 s, but the time step is 0.01 s; correct one of"
          " them"]),
        (timed([0.0, 0.01, 0.02, 0.05]),
         ["Pasted!A7 is 0.05 s, 0.03 s after the row above it, but the typical step is 0.01 s; fill"
          " in the missing rows, or use the record as a file, which is resampled"]),
        (timed([0.0, 0.01, 0.01, 0.02]),
         ["Pasted!A6: found time 0.01 s after 0.01 s, with a typical step of 0.01 s; enter"
          " increasing times"]),
        (timed([0.0, 1.0, 2.0, 3.0], header="Time [h]"),
         ["Pasted!A3 is 'Time [h]'; enter times in s, ms or min"]),
        (pasted([0.1, 0.2]) | {"Motions/M2/Time step": None},
         ["'Pasted!North' is a pasted column; enter its time step"]),
        (pasted([0.1, 0.2]) | {"Pasted!D2": "North"},
         ["heading 'North' appears at Pasted!D2 and Pasted!B3; rename one"]),
        (pasted([0.1, 0.2]) | {"Pasted!B300000": 1},
         ["Pasted!B300000 contains data more than 200,000 rows below the heading; clear it, or use"
          " the record as a file"]),
    ], 2),
)  # fmt: skip
def test_a_pasted_column_is_refused_by_its_cell(paste, cells, lines):
    assert problems(paste(cells)) == with_addresses(*(f"{PASTED} {line}" for line in lines))


@pytest.mark.quick
def test_gals_of_a_pasted_column_are_cm_s2(paste):
    cells = pasted([100.0, -200.0] * 51) | {"Motions/M2/Record units": "gal"}
    motion = read_workbook(paste(cells)).motions[1]
    assert motion.ax_mps2.tolist() == [1.0, -2.0] * 51
