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


def test_the_floor_satisfies_clearances_that_it_does_not_exceed():
    found = saving(scenes.without_motions())
    assert found.prescriptive_m == pytest.approx(PRESCRIPTIVE_M, rel=1e-4)
    assert found.floor_m == pytest.approx(0.5 * PRESCRIPTIVE_M, rel=1e-4)
    # A1 to RTU-1 48 in, A3 to RTU-2 60, to PV-OLD 72 and to EAST 120 in; 40.8, and 61.2 to the edge
    assert (found.n_short, found.n_satisfied) == (4, 4)
    assert (found.ids, found.others) == (["A1", "A2", "A3"], [])
    given = scenes.without_motions()
    rows = list(given.project.clearances)
    rows[1] = rows[1].model_copy(update={"provided_m": 40.0 * 0.0254})
    found = saving(with_inputs(clearances=tuple(rows)))
    assert (found.n_short, found.n_satisfied) == (4, 3)


def test_steep_roofs_and_a_whole_floor_leave_nothing_to_save():
    given = with_inputs(slopes=[8.0])
    assert (saving(given).ids, saving(given).others) == (["A2", "A3"], ["A1"])
    assert said(given).endswith("The roof is too steep for an analysis (PV1-2012†) under array A1.")
    text = said(with_inputs(slopes=[8.0, 8.0, 8.0]))
    assert text == (
        "No analysis is permitted instead: the roof of every array is too steep for it (PV1-2012†)."
    )
    site = scenes.without_motions().project.site
    low = type(site)(**site.model_dump() | {"rule_set": "ASCE 7-16", "sdc": "C"})
    text = said(with_inputs(slopes=[4.0, 4.0, 4.0], site=low))
    assert text.startswith("No analysis is permitted instead without peer review: ")
    override = {"provision": "analysis_floor", "value": 1.0, "reason": "Agreed on 2026-02-10"}
    text = said(with_inputs(overrides=(override,)))
    assert text.startswith("An analysis could save nothing without peer review: the floor is 100 %")
