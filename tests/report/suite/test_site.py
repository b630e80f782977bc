"""A suite in a workbook: what its target takes from which cells, its rows, and all or nothing."""

import json
import warnings

import pytest
from openpyxl import load_workbook

import commands
import report.suite.files
import waves
from cells import address, cell
from packages import unlaid
from report.results.motions import other_sources
from report.results.publish import STAMP
from report.sheet.reading.read import read
from report.suite.inputs import ac156_targets, site_targets
from sheets import at, edit, make, type_into
from solver.model import InputError
from solver.rules.hazard import Tail


def test_the_target_of_a_suite_is_the_site_of_the_workbook_with_its_cells(tmp_path):
    sheet = read(make(tmp_path))
    targets, lines = site_targets(sheet)
    site = sheet.project.site
    assert targets.facts["s_ds_g"] == site.s_ds
    assert targets.facts["z_over_h"] == pytest.approx(site.z_over_h, rel=1e-11)
    assert (targets.facts["tail"], targets.facts["code"]) == (Tail.AC156, site.rule_set)
    given = at("Site/S_DS") if site.s_ds_g else f"{at('Site/S_S')} and {at('Site/F_a')}"
    assert lines[0] == f"S_DS {site.s_ds:.4g} g from {given}"
    assert f"code pv1 from {at('Site/Rule set')}" in lines


def test_the_edition_of_the_workbook_has_its_spectrum(tmp_path):
    path = type_into(make(tmp_path), {"Site/Edition of ASCE 7": "ASCE 7-22", "Site/S_DS": 1.2})
    targets, lines = site_targets(read(path))
    assert f"edition ASCE 7-22 from {at('Site/Edition of ASCE 7')}" in lines
    alike = {name: targets.facts[name] for name in ("s_ds_g", "z_over_h")}
    alike = ac156_targets("asce7-22", **alike, tail=Tail(targets.facts["tail"]))
    assert targets.horizontal[1].tolist() == alike.horizontal[1].tolist()


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--zh", 0.5), "no target; give --sds and --code, or --target"),
        (("--sds", 0.5, "--code", "asce7-22"), "AC156 with ASCE 7-22, S_DS 0.5 g, z/h 1"),
        (("--sds", 0.5, "--code", "ASCE 7-16"), "AC156 with ASCE 7-16, S_DS 0.5 g, z/h 1"),
    ],
)
def test_a_target_is_that_of_the_options_or_of_the_workbook(tmp_path, quick, options, said):
    path, made = make(tmp_path), tmp_path / "made"
    words = (*suite(made, "--into", path), *options)
    refused = said.startswith("no target")
    assert said in (commands.refused(*words) if refused else commands.printed(*words))
    assert made.exists() != refused


@pytest.mark.quick
def test_a_site_out_of_range_is_told_without_an_option(tmp_path):
    path = type_into(make(tmp_path), {"Site/S_DS": 0.005})
    with pytest.raises(InputError, match=r"^S_DS is 0\.005 g; give"):
        site_targets(read(path))


def test_each_value_that_the_workbook_lacks_is_an_error_at_its_cells(tmp_path):
    cells = ("S_S", "F_a", "S_DS", "S_MS", "Rule set", "Structure height h")
    path = type_into(make(tmp_path), {f"Site/{label}": None for label in cells})
    with pytest.raises(InputError) as caught:
        site_targets(read(path))
    assert [text.partition(": ")[2].split()[0] for text in caught.value.problems] == [
        "S_DS",
        "z/h",
        "code",
    ]
    assert caught.value.problems[2].startswith(at("Site/Rule set"))


def test_a_workbook_without_the_sheet_lacks_all_its_values(tmp_path):
    path = edit(make(tmp_path), lambda book: book.remove(book["Site"]))
    with pytest.raises(InputError) as caught:
        site_targets(read(path))
    assert len(caught.value.problems) == 3


def test_a_target_spectrum_of_the_workbook_is_not_passed_over(tmp_path):
    points = [{"period_s": t, "horizontal_g": a} for t, a in ((0.02, 0.5), (5.0, 0.1))]
    sheet = read(make(tmp_path, spectrum=points))
    with pytest.raises(InputError, match="a target spectrum is given, not that of AC156; add --ta"):
        site_targets(sheet)


@pytest.fixture
def quick(monkeypatch):
    """Motions of sines at once."""
    monkeypatch.setattr(
        report.suite.files, "make_suite", lambda *_, count, **__: waves.suite(count)
    )


def suite(*words):
    return ("motion", "suite", *words, "--count", 1)


def test_a_suite_goes_into_the_workbook_with_its_rows(tmp_path, quick):
    path = make(tmp_path)
    path.chmod(0o640)
    before = read(path).project.motions
    told = commands.printed(*suite(tmp_path / "records" / "made", "--into", path))
    cells = address(path, "Motions/motion-01/ID:Source")
    assert f"{path}: 1 row added to the sheet Motions: {cells}\n" in told
    assert f"code pv1 from {at('Site/Rule set')}" in told
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
    commands.printed(*suite(made, "--into", path))
    type_into(path, {"Motions/motion-01/Polarity": "as recorded"})
    told = commands.printed(*suite(made, "--into", path, "--seed", 2), "--count", 2)
    assert f"{path}: 1 row added to the sheet Motions, 1 renewed: Motions!" in told
    *_, first, second = read(path).project.motions
    assert (first.id, first.polarity, second.id) == ("motion-01", "as recorded", "motion-02")
    assert first.source == second.source
    assert first.source.startswith("Generated, seed 2; AC156 with ")
    for typed in ({MADE: "by hand"}, {"Motions/motion-01/Vertical record": "records/z.csv"}):
        before = type_into(path, typed).read_bytes()
        refused = commands.refused(*suite(made, "--into", path), "--count", 2)
        assert refused.count("already; remove the row, or leave the motion out") == 1
        assert path.read_bytes() == before


@pytest.mark.nightly
def test_a_suite_that_is_made_anew_names_the_workbook_whose_source_is_the_former(tmp_path, quick):
    path, made = make(tmp_path), tmp_path / "records" / "made"
    commands.printed(*suite(made, "--into", path))
    source = cell(load_workbook(path), MADE).value
    anew = (*suite(made), "--sds", 1.5, "--code", "pv1")
    told = commands.run(*anew).stderr
    said = "Generated, seed 1; AC156 with SEAOC PV1-2012, S_DS 1.5 g, z/h 1"
    line = (
        f"warning: {{}}{address(path, MADE)}: source is '{source}', and suite.json beside the"
        f" records says '{said}'; renew it by motion suite with --into, or correct it\n"
    )
    assert told.endswith(line.format(f"{path}: "))
    # What `check` prints, `report` warns of; the package has no suite.json inside.
    assert line.format("") in commands.printed("check", path)
    with unlaid(), warnings.catch_warnings():
        warnings.simplefilter("always")
        assert line.format("") in commands.run("report", path).stderr
    commands.printed(*anew, "--into", path)
    assert "suite.json" not in commands.printed("check", path)
    assert "suite.json" not in commands.run(*anew).stderr


@pytest.mark.parametrize(
    ("source", "is_other"),
    [
        ("Generated, seed 1; another code", True),
        ("AC156, S_DS = 1.2 g", True),
        ("seed 7", True),
        ("AC156 at z/h 0.50", True),
        ("AC156 at S_DS 1.566 g", False),
        ("by the testing laboratory, 2025", False),
        (None, False),
    ],
)
@pytest.mark.nightly
def test_a_source_that_a_person_typed_is_another_by_its_numbers(tmp_path, quick, source, is_other):
    path = make(tmp_path)
    commands.printed(*suite(tmp_path / "made", "--into", path), "--sds", 1.566, "--code", "pv1")
    found = list(other_sources(read(type_into(path, {MADE: source}))))
    assert bool(found) == is_other


@pytest.mark.parametrize("content", [b"", b"[]", b'{"motions": 1}', b'{"motions": []}'])
@pytest.mark.nightly
def test_a_suite_json_that_is_of_other_records_or_damaged_says_nothing(tmp_path, quick, content):
    path, made = make(tmp_path), tmp_path / "made"
    commands.printed(*suite(made, "--into", path))
    type_into(path, {MADE: "seed 7"})
    assert list(other_sources(read(path)))
    (made / "suite.json").write_bytes(content)
    assert not list(other_sources(read(path)))


@pytest.mark.parametrize("place", ["../other", "link", "a!b", "a|b"])
def test_a_suite_outside_the_folder_of_the_workbook_is_refused(tmp_path, quick, place):
    path, outside = make(tmp_path / "p"), tmp_path / "outside"
    outside.mkdir()
    (tmp_path / "p" / "link").symlink_to(outside)
    before = path.read_bytes()
    told = commands.refused(*suite(tmp_path / "p" / place, "--into", path))
    assert "is outside the workbook's folder" in told or "in its name; rename it" in told
    assert path.read_bytes() == before
    assert not list(outside.iterdir())
    assert {entry.name for entry in (tmp_path / "p").iterdir()} == {"input.xlsx", "link", "records"}


@pytest.mark.nightly
def test_where_a_file_cannot_be_written_nothing_changes(tmp_path, quick, files_up_to):
    path = make(tmp_path)
    before = path.read_bytes()
    with files_up_to(5_000):
        commands.refused(*suite(tmp_path / "made", "--into", path))
    assert path.read_bytes() == before
    assert not (tmp_path / "made").exists() or not list((tmp_path / "made").iterdir())
