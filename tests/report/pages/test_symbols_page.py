"""The list of symbols has those of the edition that a project is designed by."""

import pytest

import inputs
import scenes
from printed import printed


@pytest.mark.parametrize(
    ("edition", "own", "others"),
    [
        ("ASCE 7-16", {"ap", "Rp", "Fa", "Fv"}, {"CAR", "Rpo"}),
        ("ASCE 7-22", {"CAR", "Rpo"}, {"ap", "Rp", "Fa", "Fv"}),
    ],
)
def test_the_symbols_are_those_of_the_edition(edition, own, others):
    table = printed(scenes.package(site=inputs.SITE | {"edition_name": edition}), "symbols").table(
        "Symbols"
    )
    listed = {cell.replace(" ", "").replace("_", "") for row in table.cells for cell in row}
    assert own <= listed
    assert not others & listed
