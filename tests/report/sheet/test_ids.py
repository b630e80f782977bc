"""Ids are spelled alike once, at the border: capitals do not distinguish them."""

import pytest

import stand_in
from report.sheet.schema import ProjectInput

pytestmark = pytest.mark.quick


def test_references_are_spelled_as_the_id_that_they_refer_to():
    given = stand_in.project().model_dump()
    first = given["clearances"][1]
    first["array"], first["object"] = first["array"].lower(), first["object"].lower()
    given["links"] = [stand_in.links("a2", "0.40, 0.50", 50)]
    project = ProjectInput.model_validate(given)
    assert project.clearances[1] == stand_in.project().clearances[1]
    assert project.links[0].array == "A2"
