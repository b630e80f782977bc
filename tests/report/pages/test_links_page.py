"""The text on rows of linked blocks, and its absence where none is requested."""

import re

import numpy as np
import pytest

import stand_in
from report.assessment.certainty import certainty
from report.pages import front, inputs, links, model
from report.pages.limits import troubles
from report.pages.registry import package_data

MATTERS = "1 mm (0.04 in) or 0.5 %"


def scene(requested, shaking=None, **changes):
    arrays = [stand_in.array("A1", 2.0, mu=0.45), stand_in.array("A2", 2.0, mu=0.40, x=120)]
    data = stand_in.project(
        **{"arrays": arrays, "options": {"peer_reviewed": True}, "links": requested}
        | {"objects": [], "clearances": []}
        | changes
    )
    book = stand_in.book(data, shaking or stand_in.motions(3, seconds=12.0))
    return package_data(stand_in.assessed(book))


@pytest.fixture(scope="module")
def both():
    rows = [
        stand_in.links(name, "0.40, 0.45, 0.50", 50, damping_ratio=0.05) for name in ("A1", "A2")
    ]
    return scene(rows)


def texts(row):
    return [re.sub("<[^>]+>", "", str(cell)) for cell in row.cells]


def test_the_inputs_list_the_rows_as_given(both):
    rows = [texts(row) for row in inputs.inputs(both)["links"].rows]
    assert rows[0] == ["A1", "3", "0.400, 0.450, 0.500", "50", "8.8", "0.050"]
    assert len(rows) == 2


def test_each_array_has_its_row_and_its_effect_on_the_design(both):
    page = model.page(both)["links"]
    first, second = both.assessment.linked
    for linked, row, design in zip(
        (first, second), page["rows"].rows, page["design"].rows, strict=True
    ):
        shown, held = texts(row), texts(design)
        assert shown[:6] == [linked.design.id, "3", "0.400 to 0.500", "50", "8.8", "0.050"]
        assert shown[6] == f"{linked.rigid_prd_m / 0.0254:.1f}"
        assert shown[8] == f"{linked.farthest.prd_m / 0.0254:.1f}"
        assert shown[10] == "1"
        assert shown[12] == f"{linked.link_force_n / 1e3:.2f}"
        assert held[1] == f"{linked.rigid.value_m / 0.0254:.1f}"
        assert held[3] == f"{linked.linked.value_m / 0.0254:.1f}"
        assert float(held[5]) == pytest.approx(linked.ratio, abs=1e-3)
        assert held[6] == f"{linked.design.design_m / 0.0254:.1f}"
        assert held[8] == f"{linked.estimated_m / 0.0254:.1f}"
    assert [texts(row)[-1] for row in page["design"].rows] == ["NG", "OK"]
    assert "1.1 × largest of the motions' PRDs" in page["design"].notes[0]
    assert MATTERS in page["design"].notes[0]


def test_the_equation_has_its_numbers(both):
    _, line = model.page(both)["links"]["lines"]
    linked = both.assessment.linked[0]
    text, result = line.steps[0]
    assert text.startswith(f"A1: max(max(1, {links._ratio(linked.ratio)}) × ")
    assert result == both.fmt.both(linked.estimated_m)


def test_an_array_for_which_one_block_is_not_adequate_is_ng_everywhere(both):
    first, second = both.assessment.arrays
    assert not both.assessment.verdict.is_permitted
    assert (
        both.assessment.array_verdict(first).is_permitted,
        both.assessment.array_verdict(second).is_permitted,
    ) == (False, True)
    (text,) = links.link_troubles(both)
    assert text in troubles(both)
    assert text.startswith("Array A1: a row of linked blocks slides 1.")
    assert text.endswith(
        "Enter 0.400, the smallest value of its blocks, as its friction coefficient, or provide"
        " stiffer links."
    )
    assert front.summary(both, (), ())["sentence"] == "Marked NG: 1 of 2 arrays."
    assert (
        "(part 12 compares A1, A2 with a row"
        in front.basis(both, certainty(both.assessment))["linked"]
    )


def test_nothing_is_printed_where_no_row_is_requested():
    package = scene([])
    page = model.page(package)
    assert not page["links"]["rows"].rows
    assert page["links"]["lines"] == ()
    assert front.basis(package, certainty(package.assessment))["linked"] == ""
    assert not inputs.inputs(package)["links"].rows
    assert page["neglected"].notes[0].endswith("the flexibility of the array (part 3).")


def test_a_row_without_a_displacement_says_so_and_is_ng():
    up = np.zeros(400)
    up[200:300] = -1.3 * stand_in.G
    lifted = stand_in.motion("UP", np.zeros(400), up, signs=(1,))
    package = scene(
        [stand_in.links("A1", "0.40, 0.50", 50)], (*stand_in.motions(3, seconds=4.0), lifted)
    )
    page = model.page(package)["links"]
    shown, held = texts(page["rows"].rows[0]), texts(page["design"].rows[0])
    assert shown[6:] == ["none"] * 7
    assert held[5:] == ["none", "none", "none", "none", "none", "NG"]
    assert "Array A1 as a row of linked blocks, UP record +: " in page["troubles"][0]
    assert not re.search(r"\bnan\b", " ".join([*shown, *held, *page["troubles"]]))


def test_a_row_that_slides_where_one_block_does_not_has_no_limit():
    pushed = np.concatenate([0.25 * stand_in.G * np.sin(np.arange(400) / 10.0), np.zeros(600)])
    shaking = (stand_in.motion("M", pushed),) * 3
    package = scene(
        [stand_in.links("A1", "0.30, 0.31, 0.10", 0.01)],
        shaking,
        arrays=[stand_in.array("A1", 2.0, mu=0.3)],
    )
    page = model.page(package)["links"]
    assert texts(page["design"].rows[0])[5:] == ["∞", "none", "none", "∞", "∞", "NG"]
    assert page["lines"][1].steps[0][1] == "no limit"
    assert "in one axis, one rigid block does not slide" in page["troubles"][1]


def test_only_stiffer_links_help_where_the_array_has_the_least_coefficient_already(both):
    linked = both.assessment.linked[1]
    assert links._remedy(linked) == "Provide stiffer links."


def test_without_a_permitted_displacement_one_rigid_block_is_not_called_adequate():
    done = stand_in.unpermitted(links=[stand_in.links("A1", "0.3, 0.3", 50)])
    page = model.page(package_data(done))["links"]
    assert texts(page["design"].rows[0])[-1] == "NG"
    assert page["troubles"] == (
        "Array A1: there is no permitted design displacement to compare a row of linked blocks "
        "with.",
    )
