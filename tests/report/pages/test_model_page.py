"""Models, rows of linked blocks and neighbors: what is said where a value or a place is missing."""

import re
from dataclasses import replace

import numpy as np
import pytest

from fixtures import assessments, project_parts, projects
from fixtures.pages import page_of
from report.assessment.design.verdict import Verdict
from report.assessment.plan.neighbors import Cover
from solver.sliding.model_selection import Model


def scene(shaking=None, **changes):
    return assessments.package(shaking, objects=[], clearances=[], **changes)


def table(package, title):
    return page_of(package, "model").table(title)


USED, NEGLECTED, CHECKS = "Model used, by array", "Neglected effects", "Checks independent"


def alone(motions):
    return tuple(replace(motion, ay_mps2=np.empty(0)) for motion in motions)


@pytest.mark.nightly
def test_a_neglected_vertical_component_has_its_exact_effect():
    gentle = tuple(replace(m, az_mps2=m.az_mps2 * 1e-3) for m in alone(assessments.motions(3, 8.0)))
    package = scene(gentle, arrays=[projects.array("A1", 1.0, mu=0.5)])
    item = package.assessment.arrays[0]
    solutions = [run.solution for m in item.motions for run in m.runs]
    assert {solution.model for solution in solutions} == {Model.ONE_AXIS}
    (row,) = table(package, NEGLECTED).cells
    effect = max(solution.next_effect_m for solution in solutions)
    assert 0.0 < effect < 2e-3
    assert (row[1], row[3], row[-1]) == (
        "Vertical shaking", f"{1e3 * effect:.0f}", "exact: both models run"
    )  # fmt: skip


def test_a_model_that_is_run_or_not_requested_is_said_so():
    gentle, full = alone(assessments.motions(2, 8.0))
    gentle = replace(gentle, az_mps2=gentle.az_mps2 * 1e-3)
    package = scene((gentle, full, full), arrays=[projects.array("A1", 1.0, mu=0.5)])
    models = {run.solution.model for m in package.assessment.arrays[0].motions for run in m.runs}
    assert models == {Model.ONE_AXIS, Model.ONE_AXIS_VERTICAL}
    assert float(table(package, NEGLECTED).cells[0][2]) < 0.1
    one = tuple(replace(motion, signs=(1,)) for motion in assessments.motions())
    package = scene(one)
    said = page_of(package, "model")
    assert "with the polarities that the workbook requests: two runs per motion" in said
    assert "with both polarities: four runs per motion" in page_of(scene(), "model")


@pytest.mark.quick
def test_where_nothing_slips_nothing_is_neglected_and_the_largest_demand_said():
    still = tuple(replace(motion, scale=1e-3) for motion in assessments.motions(3, 4.0))
    package = scene(still, arrays=[projects.array("A1", 1.0)])
    assert table(package, USED).row("A1")["Model"] == "0, no slip"
    assert table(package, NEGLECTED).row("A1")["Neglected"] == "none; no slip"
    still = [replace(m, scale=0.02 * k) for k, m in enumerate(assessments.motions(3, 4.0), start=1)]
    row = table(scene(tuple(still[::-1]), arrays=[projects.array("A1", 1.0)]), USED).row("A1")
    assert row["Model"] == "0, no slip"
    assert f"the required friction coefficient, {row['Demand']}," in row["Reason"]


@pytest.mark.quick
def test_a_stable_array_has_its_tipping_ratios():
    """Of the whole motion, also where the model of the array neglects its vertical component."""
    arrays = [projects.array("A1", 1.0, mu=0.5), projects.array("A2", 1.0, mu=0.5)]
    gentle = tuple(replace(m, az_mps2=m.az_mps2 * 1e-3) for m in alone(assessments.motions(3, 8.0)))
    package = scene(gentle, arrays=arrays)
    (row,) = table(package, CHECKS).cells
    assert row[0] == "A1, A2"  # all of their numbers are equal
    first, _ = package.assessment.arrays
    assert {run.solution.model for motion in first.motions for run in motion.runs} == {
        Model.ONE_AXIS
    }
    modeled = min(run.result.n_min_g for motion in first.motions for run in motion.runs)
    assert first.uplift.n_min_g < modeled
    for array in package.assessment.arrays:
        capacity = 0.5 * array.array.support_spacing_m / array.array.cg_height_m
        held = min(array.tipping.demand, array.array.mu) / capacity
        assert array.tipping.at_rest_ratio == pytest.approx(held, rel=1e-12)
        assert row[4] == f"{array.tipping.ratio * capacity:.2f}"
        assert row[5] == f"{capacity:.2f}"
        assert (row[2], row[8]) == ("none", "OK")


@pytest.mark.quick
@pytest.mark.parametrize(
    ("n_vertical", "uplift_s", "text"),
    [
        (0, "not checked", "No motion has a vertical component; uplift is not checked"),
        (2, "none", "2 of 3 motions have a vertical component; uplift is not checked for the"),
        (3, "none", ""),
    ],
)
def test_uplift_is_said_to_be_checked_only_under_motions_with_a_vertical(
    n_vertical, uplift_s, text
):
    found = (*assessments.motions()[:n_vertical], *assessments.level()[n_vertical:])
    page = page_of(scene(found, arrays=[projects.array("A1", 0.5)]), "model")
    assert page.table(CHECKS).row("A1")["Uplift time [s]"] == uplift_s
    assert ("uplift is not checked" in page) is bool(text)
    assert text in page


@pytest.mark.quick
def test_an_array_that_begins_to_tip_is_not_ok_and_is_named():
    tall = projects.array("A1", 0.5, cg_height_m=0.9, support_spacing_m=0.5)
    package = scene(assessments.motions(3, 6.0), arrays=[tall])
    done = package.assessment
    assert done.arrays[0].tipping.ratio > 1.0
    assert not done.verdict.is_permitted
    assert not done.array_verdict(done.arrays[0]).is_permitted
    row = (
        page_of(package, "summary")
        .table("Governing")
        .row("V/N divided by the tipping limit b/(2c)")
    )
    assert (row["Item"], row["Verdict"]) == ("A1", "NG")
    assert float(row["Found"]) > 1.0
    assert table(package, CHECKS).row("A1")["Verdict"] == "NG"


def linked(requested, shaking=None, **changes):
    arrays = [projects.array("A1", 2.0, mu=0.45), projects.array("A2", 2.0, mu=0.40, x=120)]
    usual = {"arrays": arrays, "options": project_parts.REVIEW, "objects": [], "clearances": []}
    return assessments.package(shaking, **usual | changes, links=requested)


@pytest.fixture(scope="module")
def both():
    return linked(
        [projects.links(name, "0.40, 0.45, 0.50", 50, damping_ratio=0.05) for name in ("A1", "A2")]
    )


def held(package):
    """The page, and the rows of its two tables on linked blocks."""
    page = page_of(package, "model")
    tables = map(page.table, ("Rows of linked blocks", "Adequacy of one rigid block"))
    return page, *(table.cells for table in tables)


@pytest.mark.quick
def test_a_row_is_ng_by_one_block_and_stiffer_links_may_help(both):
    done = both.assessment
    assert [done.array_verdict(item).is_permitted for item in done.arrays] == [False, True]
    assert [design[-1] for design in held(both)[2]] == ["NG", "OK"]
    row = page_of(both, "summary").table("Governing").rows[0]
    assert (row["Item"], row["Verdict"]) == ("A1", "NG")
    assert "(Section 5 compares A1, A2 with a row" in page_of(both, "basis")
    # Its row slides farther here than it does: it is given the result of the other one.
    far, near = both.assessment.linked
    near = replace(near, rigid=far.rigid, linked=far.linked)
    assert near.design.array.mu == min(near.row.mus)
    done = replace(both.assessment, linked=(near,))
    text = page_of(done, "model").line("Design displacement as a row of linked blocks, A2: ")
    assert text.endswith("To close: provide stiffer links between the parts of the array.")


@pytest.mark.quick
def test_a_row_without_a_displacement_or_a_limit_says_so():
    up = np.zeros(400)
    up[200:300] = -1.3 * projects.G
    lifted = projects.motion("UP", np.zeros(400), up, signs=(1,))
    shaking = (*assessments.motions(3, 4.0), lifted)
    page, rows, designs = held(linked([projects.links("A1", "0.40, 0.50", 50)], shaking))
    assert rows[0][6:] == ("none",) * 7
    assert designs[0][5:] == (*("none",) * 5, "NG")
    assert page.line(
        "Design displacement as a row of linked blocks, A1: not every block comes to rest (UP)"
    )
    assert not re.search(r"\bnan\b", page)
    pushed = np.concatenate([0.25 * projects.G * np.sin(np.arange(400) / 10.0), np.zeros(600)])
    shaking = (projects.motion("M", pushed),) * 3
    row = projects.links("A1", "0.30, 0.31, 0.10", 0.01)
    page, _, designs = held(linked([row], shaking, arrays=[projects.array("A1", 2.0, mu=0.3)]))
    assert designs[0][5:] == ("∞", "none", "none", "∞", "∞", "NG")
    assert " = no limit" in page
    assert "one rigid block does not slide in one axis" in page


FOOT = projects.FOOT
NEAR = projects.roof_object("RTU-9", "fixed object", 101, 106, 35, 42)
FAR = projects.roof_object("RTU-8", "fixed object", 190, 200, 35, 42)
NOWHERE = {"id": "OLD", "kind": "fixed object"}
ARRAYS = [projects.array("A1", 0.5), projects.array("A2", 0.5, x=220)]
CAPTION = "Adjacent items"
PARTS = [
    "Array",
    "Adjacent item",
    "Type",
    "On plan [in]",
    "Twice displ. [in]",
    "Clearance",
    "Remark",
]


def page(**changes):
    package = assessments.package(**{"arrays": ARRAYS, "objects": [], "clearances": []} | changes)
    return page_of(package, "plan")


def test_distances_are_printed_with_their_rows_and_rounded_up():
    rows = [
        projects.clearance("A1", "RTU-9", 2 * FOOT), projects.clearance("A2", "A1", 120 * FOOT),
    ]  # fmt: skip
    made = page(objects=[NEAR, FAR], clearances=rows)
    table = made.table(CAPTION)
    assert [[row[part] for part in PARTS] for row in table.rows] == [
        ["A1", "RTU-9", "fixed object", "12.0", "81.6", "No. 1", "differs from the plan"]
    ]
    assert made.line("Clearances that agree with the plan: No. 2.").endswith(
        " The other three pairs on the plan are more than twice the design displacement apart and "
        "satisfy the required separation; the closest are A2 and RTU-8, 240.0 in (6096 mm)."
    )
    arrays, options = [projects.array("A1", 0.5, mu=0.3)], project_parts.REVIEW
    made = assessments.package(arrays=arrays, objects=[NEAR], clearances=[], options=options)
    (near,) = made.assessment.neighbors
    assert near.reach_m / 0.0254 % 0.1 < 0.05  # rounded it would print less
    row = page_of(made, "plan").table(CAPTION).row("RTU-9")
    assert float(row["Twice displ. [in]"]) > near.reach_m / 0.0254
    table = page(objects=[NEAR]).table(CAPTION)
    assert [[row[part] for part in PARTS] for row in table.rows] == [
        ["A1", "RTU-9", "fixed object", "12.0", "81.6", "—", "not entered; NG"]
    ]


@pytest.mark.quick
@pytest.mark.parametrize("other", [("A2", 120 * FOOT), ("RTU-9", FOOT)])
def test_clearances_that_are_as_in_the_plan_are_named_and_not_listed(other):
    made = page(objects=[NEAR], clearances=[projects.clearance("A1", *other)])
    is_lacking = other[0] == "A2"  # the near unit has no clearance
    assert (CAPTION in made) is is_lacking
    assert made.line(f"Clearances that agree with the plan: {'No. 1' if is_lacking else 'all'}.")


@pytest.mark.quick
def test_what_is_not_in_plan_or_near_is_named():
    lost = NOWHERE | {"id": "LOST"}
    made = page(objects=[NOWHERE, lost], clearances=[projects.clearance("A1", "OLD", 9.0)])
    line = made.line("To scale when printed")
    assert (
        "Neither drawn nor measured, because a location in plan is not entered: clearance 1."
        in line
    )
    assert made.line("Not checked, because neither").endswith("LOST.")
    assert CAPTION not in made
    assert page().line("The other pair on the plan") == (
        "The other pair on the plan is more than twice the design displacement apart and satisfies "
        "the required separation: A1 and A2, 1440.0 in (36576 mm)."
    )
    assert "on the plan" not in page(arrays=ARRAYS[:1])


@pytest.mark.quick
@pytest.mark.parametrize("is_given", [True, False])
def test_edges_are_those_of_the_outline_where_it_is_given(is_given):
    roof = project_parts.sides(0, 380, 0, 170) if is_given else {}
    assert ("The outline of the roof is not entered" in page(roof=roof)) is not is_given


@pytest.mark.quick
def test_distances_that_are_not_known_or_not_of_the_plan_are_told():
    made = page_of(assessments.unpermitted(), "plan")
    (line,) = (line for line in made.splitlines() if "The other seven pairs on the plan" in line)
    assert "more than twice the design displacement apart; the closest are A1 and" in line
    rows = [projects.clearance("A1", "RTU-9", 2 * FOOT) | {"source": "drawing"}]
    (near,) = (near for near in drawn(clearances=rows).assessment.neighbors)
    assert near.cover is Cover.DIFFERS


def drawn(**changes):
    """A package with a distance from the drawing, and one that is measured."""
    rows = [
        projects.clearance("A1", "RTU-9", FOOT) | {"source": "drawing"},
        projects.clearance("A2", "A1", 120 * FOOT) | {"source": "measured"},
    ]
    given = {"arrays": ARRAYS, "objects": [NEAR], "clearances": rows}
    return assessments.package(**given | changes)


@pytest.mark.quick
def test_drawing_distances_are_conditions_until_confirmed():
    package = drawn()
    (row,) = (row for row in package.assessment.checks if row.id == "drawing_distances")
    assert (row.subject, row.found, row.is_satisfied) == ("A1", "not confirmed", False)
    assert row.verdict is Verdict.CONDITION
    made = page_of(package, "plan")
    words = " Clearances provided: drawing, not confirmed No. 1; measured No. 2."
    assert made.line("Factor").endswith(words)
    line = page_of(package, "notes").line("Clearances to be measured first")
    assert line.endswith("because their distances are from the drawing and not confirmed: No. 1.")
    confirmed = {"drawing_confirmed_by": "MT", "drawing_confirmed_date": project_parts.HEAD["date"]}
    package = drawn(project=project_parts.HEAD | confirmed)
    (row,) = (row for row in package.assessment.checks if row.id == "drawing_distances")
    assert row.is_satisfied
    assert row.found == "confirmed by MT, 2026-03-05"
    made = page_of(package, "plan")
    words = " Clearances provided: drawing, confirmed No. 1; measured No. 2."
    assert made.line("Factor").endswith(words)
    assert "Clearances to be measured first" not in page_of(package, "notes")
