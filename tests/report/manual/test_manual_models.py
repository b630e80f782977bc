"""The comparison of models in the manual: the printed text follows from the results."""

import io
import re
from dataclasses import replace

import numba
import numpy as np
import pandas as pd
import pytest

import printed
from report.manual.measured import models
from report.manual.render import summary, verification_csv
from solver.verification import model_study
from solver.verification.evidence import HELD, SECOND
from solver.verification.study import own_triples
from verified import only

pytestmark = pytest.mark.skipif(
    numba.config.DISABLE_JIT, reason="generated motions take minutes without JIT"
)
TWO_AXES = "PRD in two axes relative to one axis, median"


@pytest.fixture(scope="module")
def evidence():
    return model_study.model_evidence(own_triples(True), quick=True)


def page(evidence):
    """The section on the models below the summary."""
    found = only(models=(evidence,))
    return printed.manual(found, summary(found), models(found))


@pytest.fixture(scope="module")
def said(evidence):
    return page(evidence)


def test_the_factor_of_the_second_axis_is_told(evidence, said):
    second = evidence.study.named(SECOND)
    assert f"PRD is {second.median:.2f} times that of one axis with the same heading" in said
    assert "One axis underestimates the PRD." in said
    assert "No records of three components were given" in said
    result = said.table("Key results").row(TWO_AXES)["Result"]
    assert result.startswith(f"{second.median:.2f} times")


def test_static_friction_is_told_beside_friction_by_speed(evidence, said):
    held = evidence.study.named(HELD)
    span = f"({held.at(10.0):.2f} to {held.at(90.0):.2f})"
    assert f"{held.median:.2f} times in two axes {span}" in said
    (table,) = [table for table in said.tables if "Distance" in table.title]
    assert [float(row[1]) for row in table.cells] == pytest.approx(
        1e3 * evidence.pushed["end_m"], abs=0.005
    )


def test_no_number_is_printed_raw(said):
    _, models = said.split("# 2 Models")
    assert not re.search(r"\bnan\b|\d+e[-+]?\d|None|\{|\}", models)


def recorded_and_lifted(evidence):
    return replace(evidence, study=replace(evidence.study, n_recorded=1, n_uplift=3))


def nothing_slides(evidence):
    changes = tuple(replace(change, ratios=np.empty(0)) for change in evidence.study.changes)
    return replace(evidence, study=replace(evidence.study, changes=changes))


def without_scipy(evidence):
    is_ours = ~evidence.work["method"].str.contains("SciPy")
    return replace(evidence, work=evidence.work[is_ours])


@pytest.mark.parametrize(
    ("changed", "wanted", "unsaid"),
    [
        (recorded_and_lifted, "1 recorded in earthquakes", "No records of three"),
        (recorded_and_lifted, "In 3 runs the vertical component lifts the block", "No records of"),
        (nothing_slides, "No run slides 5 mm or more", TWO_AXES),
        (without_scipy, "SciPy is not installed here", "SciPy's DOP853"),
    ],
)
def test_what_differs_in_another_run_is_told(evidence, changed, wanted, unsaid):
    said = page(changed(evidence))
    assert wanted in said
    assert unsaid not in said


def test_the_charts_are_the_same_every_time(evidence):
    first, other = (models(only(models=(evidence,))).charts for _ in range(2))
    assert first == other
    assert len(first) == 1


def test_the_runs_are_in_the_table_of_the_verification(evidence):
    table = pd.read_csv(io.BytesIO(verification_csv(only(models=(evidence,)))))
    assert set(table["kind"]) == {"run in two axes"}
    for column in ("residual error [%]", "parameters", "case"):
        assert table[column].tolist() == evidence.work[column].tolist()
