"""The target of a suite, from a workbook's cells or a table; its rows there, all or nothing."""

import json
import warnings
from pathlib import Path

import numpy as np
import pytest
from openpyxl import Workbook, load_workbook

import report.suite.suite_files
from fixtures import commands, records
from fixtures.cells import address, cell
from fixtures.marks import by_day
from fixtures.packages import unlaid
from fixtures.workbooks import cell_address, edit, make, type_into
from report.project.read.read import read
from report.results.added_motions import other_sources
from report.results.publish import STAMP
from report.suite.target_table import MAX_ROWS, read_target
from report.suite.targets import ac156_targets, site_targets
from solver.errors import InputError
from solver.rules.ac156 import Tail


def test_the_target_of_a_suite_is_the_site_of_the_workbook_with_its_cells_and_edition(tmp_path):
    sheet = read(make(tmp_path))
    targets, lines = site_targets(sheet)
    site = sheet.project.site
    assert targets.facts["s_ds_g"] == site.s_ds
    assert targets.facts["z_over_h"] == pytest.approx(site.z_over_h, rel=1e-11)
    assert (targets.facts["tail"], targets.facts["code"]) == (Tail.AC156, site.rule_set)
    given = (
        cell_address("Site/S_DS")
        if site.s_ds_g
        else f"{cell_address('Site/S_S')} and {cell_address('Site/F_a')}"
    )
    assert lines[0] == f"S_DS {site.s_ds:.4g} g from {given}"
    assert f"code pv1 from {cell_address('Site/Rule set')}" in lines
    path = type_into(make(tmp_path), {"Site/Edition of ASCE 7": "ASCE 7-22", "Site/S_DS": 1.2})
    targets, lines = site_targets(read(path))
    assert f"edition ASCE 7-22 from {cell_address('Site/Edition of ASCE 7')}" in lines
    alike = {name: targets.facts[name] for name in ("s_ds_g", "z_over_h")}
    alike = ac156_targets("asce7-22", **alike, tail=Tail(targets.facts["tail"]))
    assert targets.horizontal[1].tolist() == alike.horizontal[1].tolist()


@pytest.mark.parametrize(
    ("options", "said"),
    by_day(
        [
            (("--zh", 0.5), "no target; use --sds and --code, or --target"),
            (("--sds", 0.5, "--code", "asce7-22"), "AC156 with ASCE 7-22, S_DS 0.5 g, z/h 1"),
            (("--sds", 0.5, "--code", "ASCE 7-16"), "AC156 with ASCE 7-16, S_DS 0.5 g, z/h 1"),
        ],
        1,
    ),
)
def test_a_target_is_that_of_the_options_or_of_the_workbook(tmp_path, quick, options, said):
    path, made = make(tmp_path), tmp_path / "made"
    words = (*suite(made, "--into", path), *options)
    refused = said.startswith("no target")
    assert said in (commands.errors_of(*words) if refused else commands.stdout_of(*words))
    assert made.exists() != refused


def test_what_the_workbook_lacks_or_has_out_of_range_or_beside_is_an_error_at_its_cells(tmp_path):
    cells = ("S_S", "F_a", "S_DS", "S_MS", "Rule set", "Structure height h")
    path = type_into(make(tmp_path), {f"Site/{label}": None for label in cells})
    with pytest.raises(InputError) as caught:
        site_targets(read(path))
    lacking = [text.partition(": ")[2].split()[0] for text in caught.value.problems]
    assert lacking == ["S_DS", "z/h", "code"]
    assert caught.value.problems[2].startswith(cell_address("Site/Rule set"))
    with pytest.raises(InputError) as caught:
        site_targets(read(edit(path, lambda book: book.remove(book["Site"]))))
    assert len(caught.value.problems) == 3
    path = type_into(make(tmp_path), {"Site/S_DS": 0.005})
    with pytest.raises(InputError, match=r"^S_DS is 0\.005 g; enter"):
        site_targets(read(path))
    points = [{"period_s": t, "horizontal_g": a} for t, a in ((0.02, 0.5), (5.0, 0.1))]
    sheet = read(make(tmp_path, spectrum=points))
    with pytest.raises(
        InputError, match="the workbook has its own target spectrum instead of AC156; add"
    ):
        site_targets(sheet)


@pytest.fixture
def quick(monkeypatch):
    """Motions of sines at once."""
    monkeypatch.setattr(
        report.suite.suite_files, "make_suite", lambda *_, count, **__: records.suite(count)
    )


def suite(*words):
    return ("motion", "suite", *words, "--count", 1)


def test_a_suite_goes_into_the_workbook_with_its_rows(tmp_path, quick):
    path = make(tmp_path)
    path.chmod(0o640)
    before = read(path).project.motions
    told = commands.stdout_of(*suite(tmp_path / "records" / "made", "--into", path))
    cells = address(path, "Motions/motion-01/ID:Source")
    assert f"{path}: 1 row added to the Motions worksheet: {cells}\n" in told
    assert f"code pv1 from {cell_address('Site/Rule set')}" in told
    *standing, new = read(path).project.motions
    assert tuple(standing) == before
    assert (new.id, new.record) == ("motion-01", "records/made/motion-01-x.csv")
    assert (new.transverse, new.vertical) == tuple(
        f"records/made/motion-01-{axis}.csv" for axis in "yz"
    )
    document = json.loads((tmp_path / "records" / "made" / "suite.json").read_text())
    assert new.source == (
        f"Generated, seed 1; AC156 with SEAOC PV1-2012, S_DS {document['target']['s_ds_g']:g} g,"
        f" z/h {document['target']['z_over_h']:g}"
    )
    assert (tmp_path / "records" / "made" / STAMP).is_file()
    assert path.stat().st_mode & 0o777 == 0o640


MADE = "Motions/motion-01/Source"


@pytest.mark.nightly
def test_rows_of_a_suite_are_renewed_and_those_of_a_person_are_not(tmp_path, quick):
    path, made = make(tmp_path), tmp_path / "records" / "made"
    commands.stdout_of(*suite(made, "--into", path))
    type_into(path, {"Motions/motion-01/Polarity": "as recorded"})
    told = commands.stdout_of(*suite(made, "--into", path, "--seed", 2), "--count", 2)
    assert f"{path}: 1 row added to the Motions worksheet, 1 updated: Motions!" in told
    *_, first, second = read(path).project.motions
    assert (first.id, first.polarity, second.id) == ("motion-01", "as recorded", "motion-02")
    assert first.source == second.source
    assert first.source.startswith("Generated, seed 2; AC156 with ")
    for typed in ({MADE: "by hand"}, {"Motions/motion-01/Vertical record": "records/z.csv"}):
        before = type_into(path, typed).read_bytes()
        refused = commands.errors_of(*suite(made, "--into", path), "--count", 2)
        assert refused.count("already; remove the row, or leave the motion out") == 1
        assert path.read_bytes() == before


@pytest.mark.nightly
def test_a_suite_that_is_made_anew_names_the_workbook_whose_source_is_the_former(tmp_path, quick):
    path, made = make(tmp_path), tmp_path / "records" / "made"
    commands.stdout_of(*suite(made, "--into", path))
    source = cell(load_workbook(path), MADE).value
    anew = (*suite(made), "--sds", 1.5, "--code", "pv1")
    told = commands.run(*anew).stderr
    said = "Generated, seed 1; AC156 with SEAOC PV1-2012, S_DS 1.5 g, z/h 1"
    line = (
        f"warning: {{}}{address(path, MADE)}: source is '{source}', but suite.json next to the"
        f" records states '{said}'; update it with motion suite --into, or correct it\n"
    )
    assert told.endswith(line.format(f"{path}: "))
    # What `check` prints, `report` warns of; the package has no suite.json inside.
    assert line.format("") in commands.stdout_of("check", path)
    with unlaid(), warnings.catch_warnings():
        warnings.simplefilter("always")
        assert line.format("") in commands.run("report", path).stderr
    commands.stdout_of(*anew, "--into", path)
    assert "suite.json" not in commands.stdout_of("check", path)
    assert "suite.json" not in commands.run(*anew).stderr


@pytest.mark.parametrize(
    ("source", "is_other"),
    [
        ("Generated, seed 1; another code", True),
        ("AC156, S_DS = 1.2 g", True),
        ("seed 7", True),
        ("AC156 at S_DS 1.566 g", False),
        ("by the testing laboratory, 2025", False),
        (None, False),
    ],
)
@pytest.mark.nightly
def test_a_source_that_a_person_typed_is_another_by_its_numbers(tmp_path, quick, source, is_other):
    path = make(tmp_path)
    commands.stdout_of(*suite(tmp_path / "made", "--into", path), "--sds", 1.566, "--code", "pv1")
    found = list(other_sources(read(type_into(path, {MADE: source}))))
    assert bool(found) == is_other


@pytest.mark.parametrize("content", [b"", b'{"motions": 1}', b'{"motions": []}'])
@pytest.mark.nightly
def test_a_suite_json_that_is_of_other_records_or_damaged_says_nothing(tmp_path, quick, content):
    path, made = make(tmp_path), tmp_path / "made"
    commands.stdout_of(*suite(made, "--into", path))
    type_into(path, {MADE: "seed 7"})
    assert list(other_sources(read(path)))
    (made / "suite.json").write_bytes(content)
    assert not list(other_sources(read(path)))


@pytest.mark.parametrize("place", by_day(["../other", "link", "a!b", "a|b"], 1))
def test_a_suite_outside_the_folder_of_the_workbook_is_refused(tmp_path, quick, place):
    path, outside = make(tmp_path / "p"), tmp_path / "outside"
    outside.mkdir()
    (tmp_path / "p" / "link").symlink_to(outside)
    before = path.read_bytes()
    told = commands.errors_of(*suite(tmp_path / "p" / place, "--into", path))
    assert "is outside the workbook's folder" in told or "in its name; rename it" in told
    assert path.read_bytes() == before
    assert not list(outside.iterdir())
    assert {entry.name for entry in (tmp_path / "p").iterdir()} == {"input.xlsx", "link", "records"}


@pytest.mark.nightly
def test_where_a_file_cannot_be_written_nothing_changes(tmp_path, quick, files_up_to):
    path = make(tmp_path)
    before = path.read_bytes()
    with files_up_to(5_000):
        commands.errors_of(*suite(tmp_path / "made", "--into", path))
    assert path.read_bytes() == before
    assert not (tmp_path / "made").exists() or not list((tmp_path / "made").iterdir())


ROWS = [("Period [s]", "Horizontal [g]", "Vertical [g]")] + [
    (period, 1.0 / (1.0 + period), 0.5) for period in (0.02, 0.1, 0.5, 1.0, 4.0)
]


def book(tmp_path, rows, *, title="Target", others=("Notes",)):
    workbook = Workbook()
    sheet = workbook.active
    sheet.title = title
    for row in rows:
        sheet.append(row)
    for name in others:
        workbook.create_sheet(name)
    path = tmp_path / "spectra.xlsx"
    workbook.save(path)
    return path


def text(tmp_path, content):
    path = tmp_path / "target.csv"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return str(path)


def problems(named):
    with pytest.raises(InputError) as caught:
        read_target(str(named))
    return caught.value.problems


def test_a_sheet_is_read_by_its_headings_in_any_order_and_far_away_cells_rejected(tmp_path):
    title = ("Site-specific", None, None, None)
    rows = [title, ("note", "Vertical (g)", "T [s]", "SA [g]")]
    rows += [("x", row[2], row[0], row[1]) for row in ROWS[3:] + ROWS[1:3]]
    target = read_target(f"{book(tmp_path, rows)}!target")
    assert target.source == "spectra.xlsx!Target"
    period = np.array([4.0, 1.0, 0.5, 0.1, 0.02])
    assert target.freq_hz == pytest.approx(1.0 / period, rel=1e-12)
    assert target.horizontal_g == pytest.approx(1.0 / (1.0 + period), rel=1e-12)
    assert target.vertical_g.tolist() == [0.5] * 5
    assert target.has_vertical
    path = book(tmp_path, [*ROWS, *[(None,)] * (MAX_ROWS + 10), (1.0,)])
    (problem,) = problems(f"{path}!Target")
    assert f"Target!A{MAX_ROWS + 17}: contains data beyond row" in problem
    long = "period,sa\n" + "1,1\n" * (MAX_ROWS + 10)
    assert f"enter at most {MAX_ROWS} rows" in problems(text(tmp_path, long))[0]
    target = read_target(text(tmp_path, "period [s],horizontal [g]\n0.03,1\n3.33,0.3\n"))
    assert target.freq_hz.tolist() == [1 / 3.33, 1 / 0.03]


@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_csv_of_frequencies_is_read_without_a_vertical(tmp_path, separator):
    lines = ["frequency_hz,horizontal_g", "0.1,0.2", "", "1.3,2", "33.3,1.2"]
    content = "\ufeff" + "\r\n".join(lines).replace(",", separator)
    path = text(tmp_path, content)
    target = read_target(path)
    Path(path).write_bytes(content.encode("utf-16-le"))  # as Excel's Unicode text
    assert read_target(path).freq_hz.tolist() == target.freq_hz.tolist()
    assert target.freq_hz.tolist() == [0.1, 1.3, 33.3]
    assert target.horizontal_g.tolist() == [0.2, 2.0, 1.2]
    assert not target.has_vertical
    # A comma is decimal where a semicolon separates.
    lines = ["frequency;horizontal", "0,1;0,2", "1,3;1,234", "33,3;1,2"]
    assert read_target(text(tmp_path, "\n".join(lines))).horizontal_g.tolist() == [0.2, 1.234, 1.2]


@pytest.mark.quick
def test_every_invalid_cell_is_reported_by_its_address_or_its_line(tmp_path):
    rows = [list(row) for row in ROWS]
    rows[1][1] = "1,5,0"
    rows[2][2] = None
    rows[3][0] = 0
    rows[4][1] = True
    rows[5][2] = 250
    assert problems(f"{book(tmp_path, rows)}!Target") == (
        "Target!A4: period is 0; enter a number from 0.001 to 1000 s",
        "Target!B2: horizontal is '1,5,0'; enter a number greater than 0 [g]",
        "Target!B5: horizontal is TRUE, a logical value; enter a number greater than 0 [g]",
        "Target!C3: vertical is blank; enter a number greater than 0",
        "Target!C6: vertical is 250; enter a number from 1e-06 to 100 g",
    )
    rows = [list(row) for row in ROWS]
    rows[1][1] = "=1+1"  # a formula that was never computed
    (problem,) = problems(f"{book(tmp_path, rows)}!Target")
    assert problem.startswith("Target!B2: horizontal ")
    assert "=1+1" in problem
    content = "frequency [Hz],horizontal [g]\n0.1,0.2\n1,x\n50\n"
    assert problems(text(tmp_path, content)) == (
        "target.csv:3: horizontal is 'x'; enter a number greater than 0 [g]",
        "target.csv:4: horizontal is blank; enter a number greater than 0",
    )


@pytest.mark.parametrize(
    ("heading", "expected"),
    [
        ("period [ms],horizontal [g]", "target.csv:1: is 'period [ms]'; enter period [s]"),
        ("period [s],horizontal [m/s2]", "is 'horizontal [m/s2]'; enter horizontal [g]"),
        ("period [s],sa [g],sa [g]", "target.csv:1: a second horizontal column; delete one"),
        ("period,frequency,sa", "both frequency and period; delete one of them"),
        ("period [s],sa [%g]", "is 'sa [%g]'; enter horizontal [g]"),
        ("period,sa,Vertical PSA (g)", "target.csv:1: is 'Vertical PSA (g)'; enter vertical [g]"),
        ("Sa in cm/s2\nperiod,sa", "target.csv:1: says 'Sa in cm/s2'; use accelerations in g"),
        ("# damping: 2%\nperiod,sa", "target.csv:1: says '# damping: 2%'; use the spectrum at 5%"),
        ("2%-damped\nperiod,sa", "target.csv:1: says '2%-damped'; use the spectrum at 5% damping"),
        ("10 % of critical damping\nperiod,sa", "target.csv:1: says '10 % of critical damping'; u"),
        ("zeta = 0.02\nperiod,sa", "target.csv:1: says 'zeta = 0.02'; use the spectrum at 5% dam"),
        ("Damping: .1\nperiod,sa", "target.csv:1: says 'Damping: .1'; use the spectrum at 5% dam"),
        ("2 percent of critical damping\nperiod,sa", "target.csv:1: says '2 percent of critical"),
        ("period,sa", "target.csv:2: has 3 values below 2 headings; enter decimal points, or semi"),
        ("PSV in/s\nperiod,sa", "target.csv:1: says 'PSV in/s'; use accelerations in g"),
        ("Normalized to PGA\nperiod,sa", "target.csv:1: says 'Normalized to PGA'; use acc"),
        ("Sa in percent of g\nperiod,sa", "target.csv:1: says 'Sa in percent of g'; use acc"),
        ("Values x 0.01\nperiod,sa", "target.csv:1: says 'Values x 0.01'; use accelerations"),
        ("# Units: mg\nperiod,sa", "target.csv:1: says '# Units: mg'; use accelerations in g"),
        ("Velocity (cm/s)\nperiod,sa", "target.csv:1: says 'Velocity (cm/s)'; use accelerat"),
        ("MCE_R\nperiod,sa", "target.csv:1: says 'MCE_R'; use accelerations in g"),
        ("Scale: 1000\nperiod,sa", "target.csv:1: says 'Scale: 1000'; use accelerations"),
        ("1.5 x design\nperiod,sa", "target.csv:1: says '1.5 x design'; use accelerations"),
        ("Units: 0.1 g\nperiod,sa", "target.csv:1: says 'Units: 0.1 g'; use accelerations"),
        ("Sa / S_DS\nperiod,sa", "target.csv:1: says 'Sa / S_DS'; use accelerations in g"),
        ("h = 2%\nperiod,sa", "target.csv:1: says 'h = 2%'; use the spectrum at 5% damping"),
        ("a,b", "target.csv: no row of headings in the first 10 rows; enter frequency [Hz]"),
    ],
)
def test_ambiguous_headings_are_rejected(tmp_path, heading, expected):
    reported = problems(text(tmp_path, heading + "\n0.01,1,1\n5,1,1\n"))
    assert any(expected in problem for problem in reported)


def test_values_in_another_unit_below_a_heading_without_a_unit_are_rejected(tmp_path):
    body = "0.01,{0},{0}\n5,1,1\n"
    for high, told in (("4.9", []), ("11.8", ["'Horizontal'", "'vertical'"])):
        content = "Period,Horizontal,vertical\n" + body.format(high)
        if not told:
            assert read_target(text(tmp_path, content)).horizontal_g.max() == 4.9
            continue
        assert sorted(problems(text(tmp_path, content))) == [
            f"target.csv:1: is {name}, above values up to 11.8; enter {name.strip(chr(39)).lower()}"
            " [g], and the values in g"
            for name in told
        ]
    content = "Period,Horizontal [g]\n" + "0.01,11.8\n5,1\n"
    assert read_target(text(tmp_path, content)).horizontal_g.max() == 11.8


@pytest.mark.parametrize("damping", ["damping 5", "ξ = 0.05", "Damping = 5 pct", "damped 0.2 s"])
def test_a_line_that_states_5_percent_damping_is_accepted(tmp_path, damping):
    content = f"{damping}\nperiod,sa\n0.01,1\n5,1\n"
    assert read_target(text(tmp_path, content)).horizontal_g.tolist() == [1.0, 1.0]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("0.1,1\n", "has 1 row of numbers; enter at least 2"),
        ("0.1,1\n50,1\n50,2\n", "50 Hz (0.02 s) appears twice"),
        ("0.5,1\n50,1\n", "covers 0.5 to 50 Hz; enter 0.3 to 33.3 Hz (periods from 0.03"),
    ],
)
def test_a_table_too_short_is_rejected(tmp_path, body, expected):
    (problem,) = problems(text(tmp_path, "frequency [Hz],horizontal [g]\n" + body))
    assert expected in problem


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("!Nothing", "spectra.xlsx: has no worksheet 'Nothing'; enter one of 'Target', 'Notes'"),
        ("", "spectra.xlsx: has 2 worksheets; enter spectra.xlsx!Sheet, one of 'Target', 'Notes'"),
        ("!Notes", "spectra.xlsx!Notes: no row of headings"),
    ],
)
def test_a_sheet_that_is_not_there_is_reported_and_the_only_one_needs_no_name(
    tmp_path, name, expected
):
    (problem,) = problems(f"{book(tmp_path, ROWS)}{name}")
    assert expected in problem
    assert read_target(str(book(tmp_path, ROWS, others=()))).source == "spectra.xlsx!Target"


@pytest.mark.parametrize(
    ("name", "content", "expected"),
    [
        ("target.csv", b"\x00\x01", "not a text file"),
        ("target.csv", b'period,"sa\n', "not CSV"),
        ("target.csv", b"x" * 1001, "found a line of 1001 characters; enter at most 1000"),
        ("spectra.xlsx", b"PK nonsense", "not a workbook, or truncated"),
        ("none.xlsx", None, "no such file"),
    ],
)
def test_a_file_that_is_not_a_table_is_reported(tmp_path, name, content, expected):
    if content is not None:
        (tmp_path / name).write_bytes(content)
    named = f"{tmp_path / name}{'!Target' if name.endswith('xlsx') else ''}"
    assert expected in problems(named)[0]
