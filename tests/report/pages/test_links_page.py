"""The text on rows of linked blocks, and its absence where none is requested."""

import re
from dataclasses import replace

import numpy as np
import pytest

import scenes
import stand_in
from printed import printed

ROWS, DESIGN = "Rows of linked blocks", "Adequacy of one rigid block"


def scene(requested, shaking=None, **changes):
    arrays = [stand_in.array("A1", 2.0, mu=0.45), stand_in.array("A2", 2.0, mu=0.40, x=120)]
    usual = {"arrays": arrays, "options": {"peer_reviewed": True}, "objects": [], "clearances": []}
    return scenes.package(shaking or scenes.motions(3, 12.0), **usual | changes, links=requested)


@pytest.fixture(scope="module")
def both():
    return scene(
        [stand_in.links(name, "0.40, 0.45, 0.50", 50, damping_ratio=0.05) for name in ("A1", "A2")]
    )


def held(package):
    """The page, and the rows of its two tables on linked blocks."""
    page = printed(package, "model")
    return page, *(page.table(title).cells for title in (ROWS, DESIGN))


def test_the_inputs_list_the_rows_as_given(both):
    rows = printed(both, "inputs").table("Arrays to be compared").cells
    assert rows[0] == ("A1", "3", "0.400, 0.450, 0.500", "50", "8.8", "0.050")
    assert len(rows) == 2


def test_each_array_has_its_row_and_its_effect_on_the_design(both):
    page, rows, designs = held(both)
    for linked, shown, design in zip(both.assessment.linked, rows, designs, strict=True):
        assert shown[:6] == (linked.design.id, "3", "0.400 to 0.500", "50", "8.8", "0.050")
        assert shown[6] == f"{linked.rigid_prd_m / 0.0254:.1f}"
        assert shown[8] == f"{linked.farthest.prd_m / 0.0254:.1f}"
        assert shown[10] == "1"
        assert shown[12] == f"{linked.link_force_n / 1e3:.2f}"
        assert design[1] == f"{linked.rigid.value_m / 0.0254:.1f}"
        assert design[3] == f"{linked.linked.value_m / 0.0254:.1f}"
        assert float(design[5]) == pytest.approx(linked.ratio, abs=1e-3)
        assert design[6] == f"{linked.design.design_m / 0.0254:.1f}"
        assert design[8] == f"{linked.estimated_m / 0.0254:.1f}"
    assert [design[-1] for design in designs] == ["NG", "OK"]
    ratio = both.assessment.linked[0].ratio
    estimated = both.fmt.both(both.assessment.linked[0].estimated_m)
    found = re.search(r"A1: max\(max\(1, ([\d.]+)\) × .* = (.*)", page)
    assert (float(found[1]), found[2]) == (pytest.approx(ratio, abs=1e-3), estimated)


def test_an_array_for_which_one_block_is_not_adequate_is_ng_everywhere(both):
    done = both.assessment
    assert not done.verdict.is_permitted
    assert [done.array_verdict(item).is_permitted for item in done.arrays] == [False, True]
    remedy = (
        "Enter 0.400, the smallest value of its blocks, as its friction coefficient, or provide "
        "stiffer links."
    )
    for id in ("summary", "model", "basis"):
        text = printed(both, id).line("Array A1: a row of linked blocks slides 1.")
        assert text.endswith(remedy)
    assert "Marked NG: 1 of 2 arrays." in printed(both, "summary")
    assert "(part 12 compares A1, A2 with a row" in printed(both, "basis")


def test_nothing_is_printed_where_no_row_is_requested():
    package = scene([])
    for id in ("model", "basis", "inputs"):
        assert "linked" not in printed(package, id)
    page = printed(package, "model")
    assert page.table("Neglected").notes[0].endswith("the flexibility of the array (part 3).")


def test_a_row_without_a_displacement_says_so_and_is_ng():
    up = np.zeros(400)
    up[200:300] = -1.3 * stand_in.G
    lifted = stand_in.motion("UP", np.zeros(400), up, signs=(1,))
    shaking = (*scenes.motions(3, 4.0), lifted)
    page, rows, designs = held(scene([stand_in.links("A1", "0.40, 0.50", 50)], shaking))
    assert rows[0][6:] == ("none",) * 7
    assert designs[0][5:] == (*("none",) * 5, "NG")
    assert page.line("Array A1 as a row of linked blocks, UP record +: ")
    assert not re.search(r"\bnan\b", page)


def test_a_row_that_slides_where_one_block_does_not_has_no_limit():
    pushed = np.concatenate([0.25 * stand_in.G * np.sin(np.arange(400) / 10.0), np.zeros(600)])
    shaking = (stand_in.motion("M", pushed),) * 3
    row = stand_in.links("A1", "0.30, 0.31, 0.10", 0.01)
    page, _, designs = held(scene([row], shaking, arrays=[stand_in.array("A1", 2.0, mu=0.3)]))
    assert designs[0][5:] == ("∞", "none", "none", "∞", "∞", "NG")
    assert " = no limit" in page
    assert "in one axis, one rigid block does not slide" in page


def test_only_stiffer_links_help_where_the_array_has_the_least_coefficient_already(both):
    """Its row slides farther here than it does: it is given the result of the other one."""
    far, near = both.assessment.linked
    near = replace(near, rigid=far.rigid, linked=far.linked)
    assert near.design.array.mu == min(near.row.mus)
    done = replace(both.assessment, linked=(near,))
    text = printed(done, "model").line("Array A2: a row of linked blocks slides")
    assert text.endswith(". Provide stiffer links.")


def test_without_a_permitted_displacement_one_rigid_block_is_not_called_adequate():
    done = stand_in.unpermitted(links=[stand_in.links("A1", "0.3, 0.3", 50)])
    page, _, designs = held(done)
    assert designs[0][-1] == "NG"
    assert page.line(
        "Array A1: there is no permitted design displacement to compare a row of linked blocks "
        "with."
    )
