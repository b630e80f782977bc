"""`roofslip check`, and what `report` says on the terminal, as JSON and by its exit code."""

import datetime as dt
import json
import re
import shlex
import shutil

import pytest
from openpyxl import load_workbook

from fixtures import packages, workbooks
from fixtures.commands import as_json, errors_of, run, stdout_of
from fixtures.marks import by_day
from fixtures.paths import ROOT
from fixtures.project_parts import LB
from fixtures.spaces import spaced
from fixtures.workbooks import arrays, cell_address, make, project, read_workbook
from report.assessment.assess import assess
from report.assessment.checks.sentence import texts
from report.assessment.precheck import findings
from report.motions.prepare import prepare
from report.project.model.input_rows import Place
from report.project.model.shapes import SIDES
from report.text.units import LENGTHS, PRESSURES, WEIGHTS

REASON = {"warning": "weight A1", "reason": "Frames alone, ballast by others"}
ANSWERED = {"arrays": arrays(weight_n=30 * LB), "acknowledged": [REASON]}


def with_text(text, lines):
    """The one line with a text."""
    (line,) = (line for line in lines if text in line)
    return line


def test_check_prints_each_warning_with_its_reason_also_as_json(tmp_path):
    first, *lines = stdout_of("check", make(tmp_path, **ANSWERED)).splitlines()
    assert "input.xlsx: no errors, " in first
    weight = with_text("[weight A1]", lines)
    assert weight.startswith(cell_address("warning: <Arrays/A1/Weight>: weight is 30 lb"))
    assert weight.endswith("[weight A1] Acknowledged: Frames alone, ballast by others")
    components = cell_address("note: <Motions/heading/ID>: Components per motion")
    assert any(line.startswith(components) for line in lines)
    done = run("check", "--quiet", make(tmp_path))
    assert (done.exit_code, done.output) == (0, "")
    assert "no such file" in errors_of("check", "--quiet", tmp_path / "nothing")
    document = as_json("check", make(tmp_path, **ANSWERED))
    assert (document["schema_version"], document["errors"]) == (1, [])
    (weight,) = (f for f in document["findings"] if f["id"] == "weight A1")
    place = cell_address("Arrays/A1/Weight")
    assert (weight["level"], weight["cell"]) == ("warning", place)
    assert weight["reason"] == REASON["reason"]
    assert (document["arrays"], document["motions"]) == (2, 3)
    document = json.loads(errors_of("check", "--json", tmp_path / "nothing"))
    assert document["schema_version"] == 1
    assert document["errors"][0].startswith("no such file")


@pytest.mark.nightly
def test_check_alone_says_that_a_package_is_dated_in_the_future(tmp_path):
    issue = project().project.model_dump() | {"date": dt.date(9999, 1, 1)}
    folder = make(tmp_path, project=issue)
    assert with_text("after today", stdout_of("check", folder).splitlines()) == (
        f"note: {cell_address('Project/Date')}: date is 9999-01-01, after today, {dt.date.today()};"
        " correct it if this is not intended"
    )
    sheet = read_workbook(folder)
    assert not any(
        "after today" in f.text for f in findings(sheet.source, sheet.project, prepare(sheet))
    )
    assert "after today" not in stdout_of("check", make(tmp_path / "past"))


@pytest.fixture(scope="module")
def steep(tmp_path_factory):
    """A project that is NG by its slope, with a warning that is acknowledged."""
    changes = {
        "arrays": [row | {"slope_value": 8.0} for row in ANSWERED["arrays"]],
        # Padded, so that every run comes to rest.
        "motions": [row | {"pad_s": 20.0} for row in project().model_dump()["motions"]],
    }
    return make(tmp_path_factory.mktemp("steep"), **ANSWERED | changes)


@pytest.fixture(scope="module", autouse=True)
def unlaid():
    with packages.unlaid(), packages.undrawn():
        yield


@pytest.fixture(scope="module")
def reported(steep):
    return run("report", steep, "--fail-on-ng")


@pytest.fixture(scope="module")
def lines(reported):
    return reported.output.splitlines()


@pytest.mark.nightly
def test_a_steep_roof_is_ng_with_its_value_and_limit_everywhere(steep, reported, lines):
    assert reported.exit_code == 3
    quiet = run("report", steep, "--quiet", "--out", steep.parent / "other")
    assert (quiet.exit_code, quiet.output) == (0, "")
    out = steep.parent / "out"
    text = packages.words((out / "calc-package.pdf").read_text(encoding="utf-8"))
    assert "Warnings on the input" in text
    assert "Frames alone, ballast by others" in text
    results = json.loads((out / "results.json").read_text())
    (finding,) = (f for f in results["findings"] if f["id"] == "weight A1")
    assert (finding["cell"], finding["reason"]) == (
        cell_address("Arrays/A1/Weight"),
        REASON["reason"],
    )
    # An NG that is not of the clearance says what it is of.
    (of_the_array,) = (line for line in lines if line.startswith("A1 "))
    assert "NG: roof slope, any ballasted system (D/C 1.68) and " in of_the_array
    assert (
        "NG: Roof slope, any ballasted system, A1: 8.00° (14.1%). Required: at most 4.76° (8.3%)†"
        " (IBC 1613.3†)."
    ) in lines
    assert any("[weight A1] Acknowledged: Frames alone" in line for line in lines)
    assert lines[-1].startswith("verdict: NG; ")
    assert lines[-1].endswith("calc-package.pdf, 1 sheet")


def test_report_as_json_has_arrays_causes_and_files(steep):
    document = as_json("report", steep, "--quiet", "--out", steep.parent / "json")
    assert (document["schema_version"], document["verdict"], document["errors"]) == (1, "NG", [])
    first = document["arrays"][0]
    assert (first["id"], first["verdict"]) == ("A1", "NG")
    assert "roof slope, analysis procedure (D/C 1.15)" in first["causes"]
    assert any(name.endswith("calc-package.pdf") for name in document["files"])
    assert {line["level"] for line in document["attention"]} >= {"NG", "warning"}


SI = LENGTHS | WEIGHTS | PRESSURES
NUMBER = re.compile(
    r"(?:at least|at most|≥|≤|=|enter|the friction coefficient,) (?:period T1, )?"
    r"(?P<value>[\d,]*\d(?:\.\d+)?)(?:° \((?P<percent>[\d.]+)%\))? ?(?P<unit>[a-zA-Z]\w*)?"
)
BLANK = re.compile(r"leave (?:it|this|one of them) blank")

# The projects that are altered, each with the cells that are.
PROJECTS = {
    "slack and strength": ("example", {
        "Arrays/A1/Electrical slack": 10, "Arrays/A2/Electrical slack": None,
        "Arrays/A3/Electrical slack": 47.3, "Arrays/A1/Interconnection strength": 100,
        "Arrays/A2/Interconnection strength": None, "Arrays/A1/Weight in wind design": 30000,
        **{f"Clearances/{number}/Provided clearance": 20 for number in (2, 4, 6)},
    }),
    "nothing given": ("conditions", {}),
    "almost enough": ("conditions", {
        "Arrays/A1/Interconnection strength": 2106, "Arrays/A1/Electrical slack": 21.5,
    }),
    "metric": ("school", {
        "Arrays/A1/Electrical slack": 0.2, "Arrays/A2/Electrical slack": None,
        "Arrays/A1/Interconnection strength": 10, "Clearances/2/Provided clearance": 100,
    }),
}  # fmt: skip


@pytest.fixture
def altered(tmp_path):
    """A function that copies a project with other cells, to a folder with a blank in its name."""

    def copied(source, cells):
        folder = tmp_path / f"the {source}"
        left_out = shutil.ignore_patterns("out", "make.py", "__pycache__")
        shutil.copytree(ROOT / "projects" / source, folder, ignore=left_out)
        return workbooks.type_into(folder / "input.xlsx", cells)

    return copied


def assessed(path):
    book = workbooks.read_workbook(path)
    return assess(book.sheet, book.shaking)


def unit_of(sheet, at):
    """The unit of a cell, as the heading of its column says."""
    heads = (sheet.cell(row, sheet[at].column).value for row in range(sheet[at].row - 1, 0, -1))
    return next(str(head) for head in heads if "[" in str(head)).partition("[")[2].partition("]")[0]


def typed(book, cell, text):
    """What is entered of a text such as `≥ 50.6 in (1285 mm)`, in the unit of its cell."""
    if BLANK.search(text):
        return None
    found = NUMBER.search(text)
    assert found, text
    value, unit = float(found["value"].replace(",", "")), found["unit"]
    title, at = cell.split("!")
    if found["percent"]:
        is_percent = book[title][at].offset(column=1).value == "percent"
        return float(found["percent"]) if is_percent else value
    return round(value * SI[unit] / SI[unit_of(book[title], at)], 9) if unit in SI else value


def required(assessment):
    """What is not satisfied and has a number: what it is, its cell, and the number as printed."""
    for check in assessment.checks:
        limit = spaced(texts(check, assessment.project.us_first)[1])
        if check.is_open and check.places and re.match(r"[≥=] [\d,.]+ \w", limit):
            yield (check.id, check.subject), check.places[-1], limit


def unplaced(given, row):
    """The cells of the object of a clearance in the plan, which a larger gap would contradict."""
    ids = [each.id for each in given.project.objects]
    index = ids.index(given.project.clearances[row].object)
    return {given.source.addresses[Place("objects", index, side)]: None for side in SIDES}


@pytest.mark.parametrize("name", PROJECTS)
@pytest.mark.nightly
def test_a_value_that_is_required_satisfies_as_it_is_printed(altered, name):
    path = altered(*PROJECTS[name])
    given, book = assessed(path), load_workbook(path)
    asked, cells = list(required(given)), {}
    for _, place, text in asked:
        cell = given.source.addresses[place]
        cells[cell] = typed(book, cell, text)
        if place.section == "clearances":
            cells |= unplaced(given, place.row)
    assert asked
    left = {key for key, _, _ in required(assessed(workbooks.type_into(path, cells)))}
    assert not left & {key for key, _, _ in asked}


# Altered cells of a workbook, each with how many pieces of advice with a number are printed.
CELLS = {
    "limits": ({
        "Site/Number of stories": 9, "Site/Fire code section": "2022 CFC, example section",
        "Arrays/A1/Slope": 12.3, "Arrays/A1/CG height": 32.5, "Arrays/A2/Slope": 15,
        "Arrays/A2/Support spacing": 40.17, "Arrays/A2/CG height": 20.1,
    }, 4),
    "importance": ({"Site/Risk category": "III"}, 1),
    "hazard below its table": ({"Site/S_S": 2.4}, 1),
    "edition": ({"Site/Rule set": "ASCE 7-22", "Site/Edition of ASCE 7": "ASCE 7-16"}, 1),
    "two values that differ": ({"Site/S_MS": 2.0}, 1),
    "period T2": ({
        "Building/Period T1": 0.3, "Building/Period T2": 0.5, "Motions/M1/Recorded at": "ground",
    }, 1),
    "factor of a motion as recorded": ({"Motions/M1/Factor or PPA": 2}, 1),
    "end time": ({"Motions/M2/Start time": 0.7, "Motions/M2/End time": 0.5}, 1),
    "static friction": ({"Arrays/A1/Static friction": 0.4}, 1),
    "friction above the tests": ({
        f"Friction tests/{n}/{head}": value
        for n, mu in enumerate((0.41, 0.412, 0.4113), start=1)
        for head, value in (("Surface", "dry"), ("Run", n), ("Kinetic coefficient", mu))
    }, 2),
}  # fmt: skip


PLACED = re.compile(r"\s*(?:warning: |note: )?(?P<cells>[A-Z][\w ]*![A-Z]+\d+[^:]*): (?P<text>.*)")
CELL = re.compile(r"[A-Z][\w ]*![A-Z]+\d+")


def advice(path):
    """Cell, what it is, and the advice, of each line of `check` with something to enter."""
    for line in run("check", path).output.splitlines():
        found = PLACED.match(line)
        text = found and re.search(r"\b(?:enter|leave|at most|at least)\b.*", found["text"])
        if text and (BLANK.search(text[0]) or NUMBER.search(text[0])):
            what = re.split(": | is ", found["text"])[0]
            if "Final " in what:  # of a record: no cell has it
                continue
            yield from ((cell, what, text[0]) for cell in CELL.findall(found["cells"]))


@pytest.mark.parametrize("name", by_day(CELLS, 2))
def test_what_check_advises_is_accepted_as_it_is_printed(tmp_path, name):
    cells, count = CELLS[name]
    path = workbooks.type_into(workbooks.make(tmp_path), cells)
    given, book = list(advice(path)), load_workbook(path)
    assert len(given) >= count, given
    # Of two limits on one cell the first is the smaller: it is entered last.
    workbooks.type_into(path, {cell: typed(book, cell, text) for cell, _, text in given[::-1]})
    left = {(cell, what) for cell, what, _ in advice(path)}
    assert not left & {(cell, what) for cell, what, _ in given}


def commands(output):
    """The commands that are printed, as a shell would take them apart."""
    for text in re.findall(r"(?<![\w./-])roofslip ([a-z][^,;()\n]*)", output):
        yield shlex.split(re.split(r" (?:restores|and) ", text)[0])


@pytest.mark.nightly
def test_each_command_that_is_printed_runs_as_it_is_pasted(altered, monkeypatch):
    heads = ("Array", "Object", "Direction", "Provided clearance")
    path = altered("conditions", {f"Clearances/2/{head}": None for head in heads})
    monkeypatch.chdir(path.parent)
    given = list(commands(run("check", path.parent).output))
    assert given.pop() == ["report", str(path.parent)]
    for words in given:
        done = run(*words)
        assert done.exit_code == 0, (words, done.output)
        more = [each for each in commands(done.output) if each not in given]
        given += [each for each in more if each[0] != "report"]
    assert {" ".join(words[:2]) for words in given} >= {"plan clearances"}
    after = run("check", path.parent).output
    assert "have no row" not in after


@pytest.mark.parametrize("content", [b"", b"PK"])
@pytest.mark.quick
def test_each_command_of_a_workbook_that_is_refused_runs(tmp_path, monkeypatch, content):
    (tmp_path / "input.xlsx").write_bytes(content)
    monkeypatch.chdir(tmp_path)
    for words in commands(run("check", tmp_path).output):
        assert run(*words).exit_code == 0, words
