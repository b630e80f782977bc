"""`roofslip check`, and what `report` says on the terminal, as JSON and by its exit code."""

import datetime as dt
import json

import pytest

import packages
from commands import as_json, printed, refused, run
from inputs import LB
from report.assessment.precheck import findings
from report.motions.prepare import prepare
from sheets import arrays, at, make, project, read_workbook

REASON = {"warning": "weight A1", "reason": "Frames alone, ballast by others"}
ANSWERED = {"arrays": arrays(weight_n=30 * LB), "acknowledged": [REASON]}


def with_text(text, lines):
    """The one line with a text."""
    (line,) = (line for line in lines if text in line)
    return line


def test_check_prints_each_warning_with_its_reason_and_nothing_where_quiet(tmp_path):
    first, *lines = printed("check", make(tmp_path, **ANSWERED)).splitlines()
    assert "input.xlsx: no errors, " in first
    weight = with_text("[weight A1]", lines)
    assert weight.startswith(at("warning: <Arrays/A1/Weight>: weight is 30 lb"))
    assert weight.endswith("[weight A1] Acknowledged: Frames alone, ballast by others")
    components = at("note: <Motions/heading/ID>: number of components of each motion")
    assert any(line.startswith(components) for line in lines)
    done = run("check", "--quiet", make(tmp_path))
    assert (done.exit_code, done.output) == (0, "")
    assert "no such file" in refused("check", "--quiet", tmp_path / "nothing")


@pytest.mark.quick
def test_check_as_json_has_a_schema_version_findings_and_errors(tmp_path):
    document = as_json("check", make(tmp_path, **ANSWERED))
    assert (document["schema_version"], document["errors"]) == (1, [])
    (weight,) = (f for f in document["findings"] if f["id"] == "weight A1")
    place = at("Arrays/A1/Weight")
    assert (weight["level"], weight["cell"]) == ("warning", place)
    assert weight["reason"] == REASON["reason"]
    assert (document["arrays"], document["motions"]) == (2, 3)
    document = json.loads(refused("check", "--json", tmp_path / "nothing"))
    assert document["schema_version"] == 1
    assert document["errors"][0].startswith("no such file")


@pytest.mark.nightly
def test_check_alone_says_that_a_package_is_dated_in_the_future(tmp_path):
    issue = project().project.model_dump() | {"date": dt.date(9999, 1, 1)}
    folder = make(tmp_path, project=issue)
    assert with_text("after today", printed("check", folder).splitlines()) == (
        f"note: {at('Project/Date')}: date is 9999-01-01, after today, {dt.date.today()}; correct"
        " it if that is not intended"
    )
    sheet = read_workbook(folder)
    assert not any("after today" in f.text for f in findings(sheet, prepare(sheet)))
    assert "after today" not in printed("check", make(tmp_path / "past"))


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
    with packages.unlaid():
        yield


@pytest.fixture(scope="module")
def reported(steep):
    return run("report", steep, "--fail-on-ng")


@pytest.fixture(scope="module")
def lines(reported):
    return reported.output.splitlines()


@pytest.mark.nightly
def test_a_steep_roof_is_ng_in_terminal_package_and_exit_code(steep, reported):
    assert reported.exit_code == 3
    quiet = run("report", steep, "--quiet", "--out", steep.parent / "other")
    assert (quiet.exit_code, quiet.output) == (0, "")
    out = steep.parent / "out"
    text = packages.words((out / "calc-package.pdf").read_text(encoding="utf-8"))
    assert "Warnings on the input" in text
    assert "Frames alone, ballast by others" in text
    results = json.loads((out / "results.json").read_text())
    (finding,) = (f for f in results["findings"] if f["id"] == "weight A1")
    assert (finding["cell"], finding["reason"]) == (at("Arrays/A1/Weight"), REASON["reason"])


@pytest.mark.nightly
def test_each_line_names_array_value_and_limit(lines):
    # An NG that is not of the clearance says what it is of.
    (of_the_array,) = (line for line in lines if line.startswith("A1 "))
    assert "NG: roof slope, any ballasted system, over its limit and " in of_the_array
    assert (
        "NG: array A1, roof slope, any ballasted system: 8.00° (14.1 %); at most 4.76° (8.3 %) is"
        " permitted (IBC 1613.3)"
    ) in lines
    short = [line for line in lines if line.startswith("NG: clearance ")]
    assert all("; provide " in line or "no design displacement" in line for line in short)
    assert any("[weight A1] Acknowledged: Frames alone" in line for line in lines)
    assert lines[lines.index("") - 1] == "verdict: NG"


def test_report_as_json_has_arrays_causes_and_files(steep):
    document = as_json("report", steep, "--quiet", "--out", steep.parent / "json")
    assert (document["schema_version"], document["verdict"], document["errors"]) == (1, "NG", [])
    first = document["arrays"][0]
    assert (first["id"], first["verdict"]) == ("A1", "NG")
    assert "roof slope, analysis route, over its limit" in first["causes"]
    assert any(name.endswith("calc-package.pdf") for name in document["files"])
    assert {line["level"] for line in document["attention"]} >= {"NG", "warning"}
