"""The comparison of models in the manual: the printed text follows from the results."""

import io
import re
from dataclasses import replace

import numba
import numpy as np
import pandas as pd
import pytest

import printed
from report.figures.base import load_fonts
from report.manual.rungs import rungs
from report.manual.summary import summary
from report.manual.table import verification_csv
from report.typeset.pdf import TEMPLATES
from report.words.formats import percent
from solver.verification import plane_scipy, rung_study
from solver.verification.evidence import Verification
from solver.verification.rung_evidence import HELD, SECOND
from solver.verification.triples import own_triples

pytestmark = pytest.mark.skipif(
    numba.config.DISABLE_JIT, reason="generated motions take minutes without JIT"
)


@pytest.fixture(scope="module")
def evidence():
    load_fonts(TEMPLATES / "fonts")
    return rung_study.rung_evidence(own_triples(True), quick=True)


def verification(*evidence):
    nothing = dict.fromkeys(
        (
            "checks",
            "work",
            "maps",
            "convergence",
            "links",
            "curves",
            "conditioning",
            "tables",
            "roofs",
        ),
        (),
    )
    return Verification(**nothing, rungs=evidence, peers=(), records=(), quick=True, seconds=1.0)


def page(evidence):
    """The section on the models below the summary."""
    found = verification(evidence)
    return printed.manual(found, summary(found), rungs(found))


def test_the_factor_of_the_second_axis_is_told(evidence):
    said = page(evidence)
    second = evidence.study.named(SECOND)
    assert f"PRD is {second.median:.2f} times that of one axis with the same heading" in said
    assert "One axis underestimates the PRD." in said
    assert "No records of three components were given" in said
    result = said.table("Key results").row("PRD in two axes relative to one axis, median")["Result"]
    assert result.startswith(f"{second.median:.2f} times")


def test_static_friction_is_told_beside_friction_by_speed(evidence):
    said = page(evidence)
    held, least = evidence.study.named(HELD), evidence.static.differences[-1]
    span = f"({held.at(10.0):.2f} to {held.at(90.0):.2f})"
    assert f"{held.median:.2f} times in two axes {span}" in said
    assert percent(100.0 * least.two_axes[-1]) in said
    assert "the power 2.0 and 2.0 of the difference" in said


def test_the_distribution_of_error_over_bound_is_told(evidence):
    said = page(evidence)
    assert "Every pair is within its bound." in said
    pairs = sum(group.n_pairs for group in evidence.bounds)
    assert f"{pairs:,} pairs of runs" in said
    group = evidence.bounds[0]
    broken = replace(group, ratios=np.array([0.5, 3.0]), n_unanswered=2)
    said = page(replace(evidence, bounds=(broken, *evidence.bounds[1:])))
    assert "Pairs over their bounds: 1; without a result: 2." in said


def test_no_number_is_printed_raw(evidence):
    said = page(evidence)
    assert not re.search(r"\bnan\b|\d+e[-+]?\d|None|\{|\}", said)


def test_recorded_motions_and_lifted_runs_are_told(evidence):
    study = replace(evidence.study, n_recorded=1, n_uplift=3)
    said = page(replace(evidence, study=study))
    assert "1 recorded in earthquakes" in said
    assert "In 3 runs the vertical component lifts the block" in said
    assert "No records of three" not in said


def test_where_nothing_slides_nothing_is_claimed(evidence):
    none = [replace(change, ratios=np.empty(0)) for change in evidence.study.changes]
    study = replace(evidence.study, changes=tuple(none))
    static = replace(evidence.static, n_scenes=0)
    said = page(replace(evidence, study=study, static=static))
    assert "No run slides 5 mm or more" in said
    assert "PRD in two axes relative to one axis" not in said


def test_without_scipy_the_manual_says_so(evidence, monkeypatch):
    monkeypatch.setattr(plane_scipy, "is_installed", lambda: False)
    work = tuple(point for point in evidence.work if "SciPy" not in point.method)
    said = page(replace(evidence, work=work))
    assert "SciPy is not installed here" in said


def test_the_charts_are_the_same_every_time(evidence):
    first, other = (rungs(verification(evidence)).charts for _ in range(2))
    assert first == other
    assert len(first) == 3


def test_the_runs_are_in_the_table_of_the_verification(evidence):
    table = pd.read_csv(io.BytesIO(verification_csv(verification(evidence))))
    assert set(table["kind"]) == {"run in two axes"}
    assert list(table["PRD error [%]"]) == pytest.approx(
        [point.error_percent for point in evidence.work], rel=1e-12
    )
    assert set(table["case"]) == {evidence.work_scene}
