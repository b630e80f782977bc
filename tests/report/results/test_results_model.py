"""The schema of results.json: what is written is read back, and every key is described."""

import json

import pytest
from click.testing import CliRunner

from fixtures import assessments
from report.cli.main import main
from report.results.results_json import results_json
from report.results.results_model import Results

pytestmark = pytest.mark.quick


@pytest.fixture(scope="module")
def content():
    assessment = assessments.package().assessment
    return results_json(assessment, assessments.evidence(assessment))


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
