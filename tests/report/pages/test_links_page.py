"""The text on rows of linked blocks where a row has no displacement, no ratio or no remedy."""

import re
from dataclasses import replace

import numpy as np
import pytest

import scenes
import stand_in
from printed import printed

pytestmark = pytest.mark.quick


def scene(requested, shaking=None, **changes):
    arrays = [stand_in.array("A1", 2.0, mu=0.45), stand_in.array("A2", 2.0, mu=0.40, x=120)]
    usual = {"arrays": arrays, "options": {"peer_reviewed": True}, "objects": [], "clearances": []}
    return scenes.package(shaking, **usual | changes, links=requested)


@pytest.fixture(scope="module")
def both():
    return scene(
        [stand_in.links(name, "0.40, 0.45, 0.50", 50, damping_ratio=0.05) for name in ("A1", "A2")]
    )


def held(package):
    """The page, and the rows of its two tables on linked blocks."""
    page = printed(package, "model")
    tables = map(page.table, ("Rows of linked blocks", "Adequacy of one rigid block"))
    return page, *(table.cells for table in tables)


def test_a_row_is_ng_by_one_block_and_stiffer_links_may_help(both):
    done = both.assessment
    assert [done.array_verdict(item).is_permitted for item in done.arrays] == [False, True]
    assert [design[-1] for design in held(both)[2]] == ["NG", "OK"]
    assert "Marked NG: 1 of 2 arrays." in printed(both, "summary")
    assert "(part 5 compares A1, A2 with a row" in printed(both, "basis")
    # Its row slides farther here than it does: it is given the result of the other one.
    far, near = both.assessment.linked
    near = replace(near, rigid=far.rigid, linked=far.linked)
    assert near.design.array.mu == min(near.row.mus)
    done = replace(both.assessment, linked=(near,))
    text = printed(done, "model").line("Array A2: a row of linked blocks slides")
    assert text.endswith(". Provide stiffer links.")


def test_a_row_without_a_displacement_or_a_limit_says_so():
    up = np.zeros(400)
    up[200:300] = -1.3 * stand_in.G
    lifted = stand_in.motion("UP", np.zeros(400), up, signs=(1,))
    shaking = (*scenes.motions(3, 4.0), lifted)
    page, rows, designs = held(scene([stand_in.links("A1", "0.40, 0.50", 50)], shaking))
    assert rows[0][6:] == ("none",) * 7
    assert designs[0][5:] == (*("none",) * 5, "NG")
    assert page.line("Array A1 as a row of linked blocks, UP record +: ")
    assert not re.search(r"\bnan\b", page)
    pushed = np.concatenate([0.25 * stand_in.G * np.sin(np.arange(400) / 10.0), np.zeros(600)])
    shaking = (stand_in.motion("M", pushed),) * 3
    row = stand_in.links("A1", "0.30, 0.31, 0.10", 0.01)
    page, _, designs = held(scene([row], shaking, arrays=[stand_in.array("A1", 2.0, mu=0.3)]))
    assert designs[0][5:] == ("∞", "none", "none", "∞", "∞", "NG")
    assert " = no limit" in page
    assert "in one axis, one rigid block does not slide" in page
