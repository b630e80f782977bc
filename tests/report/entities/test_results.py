"""The schema of results: what is written is read back, and a field is shown as it says."""

import json
import math

import pytest
from click.testing import CliRunner

import scenes
from report.cli.main import main
from report.document.tables import table_of
from report.entities.clearance import ClearanceResult
from report.entities.results import Results
from report.entities.shown import UnitFormat
from report.results.results_json import results_json

pytestmark = pytest.mark.quick


@pytest.fixture(scope="module")
def content():
    assessment = scenes.package().assessment
    return results_json(assessment, scenes.evidence(assessment))


def test_what_is_written_is_read_back_and_the_schema_names_every_key(content):
    read = Results.model_validate_json(content, strict=True)
    assert list(json.loads(read.model_dump_json())) == list(json.loads(content))
    old, new = json.loads(content)["arrays"], read.model_dump(mode="json")["arrays"]
    assert new[0]["id"] == "A1"
    assert [list(array) for array in old] == [list(array) for array in new]
    assert [array["design_m"] for array in old] == [array["design_m"] for array in new]
    done = CliRunner().invoke(main, ["schema"])
    schema = json.loads(done.output)
    written = json.loads(content)
    assert set(written) == set(schema["properties"])
    models = {**schema["properties"], "runs": schema["$defs"]["ArrayResult"]["properties"]["runs"]}
    rows = {**written, "runs": written["arrays"][0]["runs"]}
    for key in ("arrays", "runs", "clearances", "motions", "records", "checks", "neighbors"):
        model = schema["$defs"][models[key]["items"]["$ref"].rpartition("/")[2]]
        assert set(rows[key][0]) == set(model["properties"]), key
        added = {"basis"} if key == "clearances" else set()  # files of before lack it
        assert set(rows[key][0]) == set(model["required"]) | added, key
    for key in ("remedies",):
        model = schema["$defs"][models[key]["items"]["$ref"].rpartition("/")[2]]
        for row in written[key]:
            assert set(model["required"]) <= set(row) <= set(model["properties"]), key
    assert schema["$defs"]["RunResult"]["properties"]["prd_m"]["type"] == ["number", "null"]
    schema = json.loads(CliRunner().invoke(main, ["schema"]).output)
    assert set(references(schema)) == {f"#/$defs/{name}" for name in schema["$defs"]}


def references(node):
    """Every "$ref" in a schema."""
    if isinstance(node, dict):
        yield from ([node["$ref"]] if "$ref" in node else [])
        node = list(node.values())
    for each in node if isinstance(node, list) else ():
        yield from references(each)


def gap(**changes):
    row = {
        "array": "A1", "object": "RTU-1", "direction": "any", "neighbor": "fixed object",
        "governing_array": "A1", "design_m": 0.5, "importance": 1.0,
        "factor": 1.0, "required_m": 0.5, "required_is_overridden": False, "provided_m": 1.0,
        "demand_capacity": 0.5, "verdict": "OK",
    }  # fmt: skip
    return ClearanceResult.model_validate(row | changes)


@pytest.mark.parametrize(
    ("us_first", "cells", "both"),
    [(True, ("19.7†", "500†"), "19.7 in (500 mm)†"),
     (False, ("500†", "19.7†"), "500 mm (19.7 in)†")],
)  # fmt: skip
def test_a_quantity_is_shown_in_both_systems_with_its_mark(us_first, cells, both):
    row, fmt = gap(marks={"required_m": "†"}), UnitFormat(us_first=us_first)
    assert table_of([row], "required_m", fmt).rows[0].cells == cells
    assert row.both("required_m", fmt) == both
    row = gap(required_m=None, marks={"required_m": "†"})
    assert math.isnan(row.required_m)
    assert table_of([row], "required_m", fmt).rows[0].cells == ("none", "none")
    assert row.both("required_m", fmt) == "none"
