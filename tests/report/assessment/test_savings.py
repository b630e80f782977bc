"""What an analysis could save where there are no motions: the floor, and what it would satisfy."""

import pytest

import scenes
from report.assessment.assess import assess, changed
from report.assessment.evidence import saving
from report.document.templates import sentence
from report.entities.requirement import Marked
from report.typeset.pdf import TEMPLATES

PRESCRIPTIVE_M = 60 * 0.0254 * (1.566 - 0.4) ** 2


def with_inputs(*, slopes=(), **sections):
    """The example without motions, with other slopes of its arrays and other sections."""
    given = scenes.without_motions()
    arrays = list(given.project.arrays)
    for at, slope in enumerate(slopes):
        arrays[at] = arrays[at].model_copy(update={"slope_value": slope})
    project = changed(given.project, arrays=tuple(arrays), **sections)
    return assess(given.sheet, given.shaking, project=project)


def said(given):
    return sentence(TEMPLATES, "saving", Marked(assessment=given), saving(given))


def test_it_is_the_floor_and_the_clearances_that_it_would_satisfy():
    found = saving(scenes.without_motions())
    assert found.prescriptive_m == pytest.approx(PRESCRIPTIVE_M, rel=1e-4)
    assert found.floor_m == pytest.approx(0.5 * PRESCRIPTIVE_M, rel=1e-4)
    # A1 to RTU-1 48 in, A3 to RTU-2 60, to PV-OLD 72 and to EAST 120 in; 40.8, and 61.2 to the edge
    assert (found.n_short, found.n_satisfied) == (4, 4)
    assert (found.ids, found.others) == (["A1", "A2", "A3"], [])


def test_a_clearance_that_is_less_than_the_floor_requires_is_not_counted():
    given = scenes.without_motions()
    rows = list(given.project.clearances)
    rows[1] = rows[1].model_copy(update={"provided_m": 40.0 * 0.0254})
    found = saving(with_inputs(clearances=tuple(rows)))
    assert (found.n_short, found.n_satisfied) == (4, 3)


def test_an_array_too_steep_for_an_analysis_is_told_apart():
    given = with_inputs(slopes=[8.0])
    assert (saving(given).ids, saving(given).others) == (["A2", "A3"], ["A1"])
    assert said(given).endswith("The roof is too steep for an analysis (PV1-2012†) under array A1.")


def test_where_every_roof_is_too_steep_it_saves_nothing():
    text = said(with_inputs(slopes=[8.0, 8.0, 8.0]))
    assert text == (
        "No analysis is permitted instead: the roof of every array is too steep for it (PV1-2012†)."
    )


def test_peer_review_may_lift_the_slope_limit_in_a_low_category():
    site = scenes.without_motions().project.site
    low = type(site)(**site.model_dump() | {"rule_set": "ASCE 7-16", "sdc": "C"})
    text = said(with_inputs(slopes=[4.0, 4.0, 4.0], site=low))
    assert text.startswith("No analysis is permitted instead without peer review: ")


def test_a_floor_of_the_whole_saves_nothing():
    override = {"provision": "analysis_floor", "value": 1.0, "reason": "Agreed on 2026-02-10"}
    text = said(with_inputs(overrides=(override,)))
    assert text.startswith("An analysis could save nothing without peer review: the floor is 100 %")
