"""The list of symbols has those of the edition that a project is designed by."""

import pytest

import inputs
import scenes
import stand_in
from printed import printed

pytestmark = pytest.mark.quick


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


@pytest.mark.parametrize(("made", "is_cited"), [(scenes.usual, False), (scenes.unpermitted, True)])
def test_the_source_of_the_modal_equations_is_listed_where_it_is_cited(made, is_cited):
    assert ("Nigam and Jennings, 1969" in printed(made(), "motions")) is is_cited
    assert ("Nigam and Jennings, 1969: " in printed(made(), "records")) is is_cited


def test_the_symbols_of_the_approximate_period_are_listed():
    data = stand_in.project(
        motions=[{"id": "M1", "record": "x", "recorded_at": "ground"}],
        building={"structure": "other"},
        spectrum=[],
    )
    done = stand_in.assessed(scenes.grounded(data, scenes.motions(1)))
    assert "12.8.2.1, structure type “other”: Ct" in printed(done, "motions").replace(" t h", "t h")
    listed = {cell for row in printed(done, "symbols").table("Symbols").cells for cell in row}
    assert {"Ct", "x"} <= listed
