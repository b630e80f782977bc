"""Ids are spelled alike once, at the border: capitals do not distinguish them."""

import pytest

import stand_in
from report.sheet.checking.findings import suggestion
from report.sheet.schema import ProjectInput
from sheets import at, make, problems, type_into

pytestmark = pytest.mark.quick


def test_references_are_spelled_as_the_id_that_they_refer_to():
    given = stand_in.project().model_dump()
    first = given["clearances"][1]
    first["array"], first["object"] = first["array"].lower(), first["object"].lower()
    given["links"] = [stand_in.links("a2", "0.40, 0.50", 50)]
    project = ProjectInput.model_validate(given)
    assert project.clearances[1] == stand_in.project().clearances[1]
    assert project.links[0].array == "A2"


CYRILLIC, GREEK = "\u0410", "\u0391"  # both look like A


@pytest.mark.parametrize(
    ("value", "ids", "said"),
    [
        (f"{CYRILLIC}1", ["A1"], f"it looks like 'A1', but '{CYRILLIC}' is a Cyrillic letter"),
        ("a1", [f"{GREEK}1"], f"it looks like '{GREEK}1', but '{GREEK}' is a Greek letter"),
        ("RTU-11", ["RTU-1"], "did you mean 'RTU-1'?"),
        ("\u03b2-1", ["A1"], "give one of A1"),
    ],
)
def test_a_letter_that_only_looks_latin_is_named(value, ids, said):
    assert suggestion(value, ids).startswith(said)


def test_an_id_that_looks_like_another_is_refused_with_its_letter(tmp_path):
    path = type_into(make(tmp_path), {"Arrays/A2/ID": f"{CYRILLIC}1"})
    said = f"ID is '{CYRILLIC}1', already used at <Arrays/A1/ID>; '{CYRILLIC}' is a Cyrillic letter"
    assert any(line.startswith(at(f"<Arrays/A2/ID>: {said}")) for line in problems(path))
