"""`roofslip check`, and what `report` says on the terminal, as JSON and by its exit code."""

import datetime as dt
import json

import pytest
from click.testing import CliRunner

import packages
from report.assessment.foresight import findings
from report.cli.main import main
from report.motions.prepare import prepare
from sheets import at, make, project, read_workbook

LIGHT = 30 * 4.4482216152605


def run(*arguments):
    return CliRunner().invoke(main, [str(item) for item in arguments])


def changes(**more):
    """The usual input with a weight that is improbable."""
    given = project().model_dump()
    arrays = [given["arrays"][0] | {"weight_n": LIGHT}, *given["arrays"][1:]]
    return {"arrays": arrays} | more


REASON = {"warning": "weight A1", "reason": "Frames alone, ballast by others"}


def test_check_prints_each_warning_with_its_cell_and_its_name(tmp_path):
    done = run("check", make(tmp_path, **changes()))
    assert done.exit_code == 0
    first, *lines = done.stdout.splitlines()
    assert "input.xlsx: no errors, " in first
    (line,) = (line for line in lines if "[weight A1]" in line)
    assert line.startswith(at("warning: <Arrays/A1/Weight>: weight is 30 lb"))
    components = at("warning: <Motions/heading/ID>: number of components of each motion")
    assert any(line.startswith(components) for line in lines)


def test_an_acknowledged_warning_is_printed_with_its_reason(tmp_path):
    done = run("check", make(tmp_path, **changes(acknowledged=[REASON])))
    (line,) = (line for line in done.output.splitlines() if "[weight A1]" in line)
    assert line.endswith("[weight A1] Acknowledged: Frames alone, ballast by others")


def test_check_as_json_has_a_schema_version_findings_and_errors(tmp_path):
    done = run("check", "--json", make(tmp_path, **changes(acknowledged=[REASON])))
    document = json.loads(done.output)
    assert (done.exit_code, document["schema_version"], document["errors"]) == (0, 1, [])
    (weight,) = (f for f in document["findings"] if f["id"] == "weight A1")
    assert (weight["level"], weight["cell"], weight["reason"]) == (
        "warning",
        at("Arrays/A1/Weight"),
        REASON["reason"],
    )
    assert (document["arrays"], document["motions"]) == (2, 3)
    wrong = run("check", "--json", tmp_path / "nothing")
    document = json.loads(wrong.output)
    assert (wrong.exit_code, document["schema_version"]) == (2, 1)
    assert document["errors"][0].startswith("no such file")


def test_check_alone_says_that_a_package_is_dated_in_the_future(tmp_path):
    issue = project().model_dump()["project"] | {"date": dt.date(9999, 1, 1)}
    folder = make(tmp_path, project=issue)
    lines = [line for line in run("check", folder).output.splitlines() if "after today" in line]
    assert lines == [
        f"note: {at('Project/Date')}: date is 9999-01-01, after today, {dt.date.today()}; correct"
        " it if that is not intended"
    ]
    sheet = read_workbook(folder)
    assert not any("after today" in f.text for f in findings(sheet, prepare(sheet)))
    assert "after today" not in run("check", make(tmp_path / "past")).output


def test_quiet_prints_nothing_but_errors(tmp_path):
    assert run("check", "--quiet", make(tmp_path)).output == ""
    assert "no such file" in run("check", "--quiet", tmp_path / "nothing").output


@pytest.fixture(scope="module")
def steep(tmp_path_factory):
    """A project that is NG by its slope, with a warning that is acknowledged."""
    given = changes(acknowledged=[REASON])
    given["arrays"] = [row | {"slope_value": 8.0} for row in given["arrays"]]
    # Padded, so that every run comes to rest.
    given["motions"] = [row | {"pad_s": 20.0} for row in project().model_dump()["motions"]]
    return make(tmp_path_factory.mktemp("steep"), **given)


@pytest.fixture(scope="module", autouse=True)
def unlaid():
    with packages.unlaid():
        yield


@pytest.fixture(scope="module")
def printed(steep):
    return run("report", steep, "--fail-on-ng")


@pytest.mark.nightly("report/cli/")
def test_report_exits_with_3_only_where_that_is_asked_for(steep, printed):
    assert printed.exit_code == 3
    with packages.unlaid():
        quiet = run("report", steep, "--quiet", "--out", steep.parent / "other")
    assert (quiet.exit_code, quiet.output) == (0, "")


def test_an_ng_that_is_not_of_the_clearance_says_what_it_is_of(printed):
    lines = printed.output.splitlines()
    (line,) = (text for text in lines if text.startswith("A1 "))
    assert "NG: roof slope, any ballasted system and " in line


def test_each_line_names_array_value_and_limit(printed):
    lines = printed.output.splitlines()
    assert (
        "NG: array A1, roof slope, any ballasted system: 8.00° (14.1 %); at most 4.76° (8.3 %) is"
        " permitted (IBC 1613.3)"
    ) in lines
    short = [line for line in lines if line.startswith("NG: clearance ")]
    assert all("; provide " in line or "no design displacement" in line for line in short)
    assert any("[weight A1] Acknowledged: Frames alone" in line for line in lines)
    assert lines[lines.index("") - 1] == "verdict: NG"


def test_the_package_lists_a_warning_with_its_reason(steep, printed):
    html = (steep.parent / "out" / "calc-package.pdf").read_text(encoding="utf-8")
    text = packages.words(html)
    assert "Warnings on the input" in text
    assert "Frames alone, ballast by others" in text
    results = json.loads((steep.parent / "out" / "results.json").read_text())
    (finding,) = (f for f in results["findings"] if f["id"] == "weight A1")
    assert (finding["cell"], finding["reason"]) == (at("Arrays/A1/Weight"), REASON["reason"])


def test_report_as_json_has_arrays_causes_and_files(steep):
    done = run("report", steep, "--json", "--quiet", "--out", steep.parent / "json")
    document = json.loads(done.output)
    assert (document["schema_version"], document["verdict"], document["errors"]) == (1, "NG", [])
    first = document["arrays"][0]
    assert (first["id"], first["verdict"]) == ("A1", "NG")
    assert "roof slope, analysis route" in first["causes"]
    assert any(name.endswith("calc-package.pdf") for name in document["files"])
    assert {line["level"] for line in document["attention"]} >= {"NG", "warning"}
