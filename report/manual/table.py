"""verification.csv: every check and every run of the comparison, units in the headings."""

from __future__ import annotations

from collections.abc import Mapping

import pandas as pd

from solver.verification.evidence import CheckRow, Verification, WorkPoint
from solver.verification.model_evidence import PlaneRun

_OF_CHECK = ("id", "section", "problem", "source", "quantity", "unit", "expected", "computed")
_OF_RUN = {
    "method": "method",
    "record": "record",
    "case": "scene",
    "time per run [s]": "seconds",
    "PRD error [m]": "prd_error_m",
    "PRD error [%]": "prd_error_percent",
    "residual error [m]": "residual_error_m",
    "residual error [%]": "residual_error_percent",
    "status": "status",
}
_COLUMNS = (
    "kind", *_OF_CHECK, "error [-]", "tolerance [-]", "passed", "method", "parameters",
    *list(_OF_RUN)[1:],
)  # fmt: skip


def verification_csv(verification: Verification) -> bytes:
    """Return one table: checks, runs, runs in two axes; a cell that does not apply is empty."""
    rows = [*map(_check, verification.checks), *map(_run, verification.work)]
    rows += [
        _run_in_two_axes(evidence.work_scene, point)
        for evidence in verification.models
        for point in evidence.work
    ]
    text: str = pd.DataFrame(rows, columns=list(_COLUMNS)).to_csv(index=False, lineterminator="\n")
    return text.encode()


def _check(row: CheckRow) -> Mapping[str, object]:
    return {
        "kind": "check",
        **{name: getattr(row, name) for name in _OF_CHECK},
        "error [-]": row.error,
        "tolerance [-]": row.tolerance,
        "passed": "yes" if row.passed else "no",
    }


def _run(point: WorkPoint) -> Mapping[str, object]:
    given = " ".join(f"{key}={value:g}" for key, value in point.parameters.items())
    found = {column: getattr(point, name) for column, name in _OF_RUN.items()}
    return {"kind": "run", "parameters": given, **found}


def _run_in_two_axes(scene: str, point: PlaneRun) -> Mapping[str, object]:
    return {
        "kind": "run in two axes",
        "method": point.method,
        "parameters": point.setting,
        "case": scene,
        "time per run [s]": point.seconds,
        "PRD error [%]": point.error_percent,
    }
