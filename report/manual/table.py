"""verification.csv: every check and every run of the comparison, units in the headings."""

from __future__ import annotations

import pandas as pd

from solver.verification.evidence import CheckRow, Verification, WorkPoint
from solver.verification.rung_evidence import PlaneWork


def verification_csv(verification: Verification) -> bytes:
    """Return one table: checks, runs, runs in two axes; a cell that does not apply is empty."""
    rows = [*map(_check, verification.checks), *map(_run, verification.work)]
    rows += [
        _run_in_two_axes(evidence.work_scene, point)
        for evidence in verification.rungs
        for point in evidence.work
    ]
    text: str = pd.DataFrame(rows, columns=list(_COLUMNS)).to_csv(index=False, lineterminator="\n")
    return text.encode()


_COLUMNS = (
    "kind",
    "id",
    "section",
    "problem",
    "source",
    "quantity",
    "unit",
    "expected",
    "computed",
    "error [-]",
    "tolerance [-]",
    "passed",
    "method",
    "parameters",
    "record",
    "case",
    "time per run [s]",
    "PRD error [m]",
    "PRD error [%]",
    "residual error [m]",
    "residual error [%]",
    "status",
)


def _check(row: CheckRow) -> dict[str, object]:
    return {
        "kind": "check",
        "id": row.id,
        "section": row.section,
        "problem": row.problem,
        "source": row.source,
        "quantity": row.quantity,
        "unit": row.unit,
        "expected": row.expected,
        "computed": row.computed,
        "error [-]": row.error,
        "tolerance [-]": row.tolerance,
        "passed": "yes" if row.passed else "no",
    }


def _run(point: WorkPoint) -> dict[str, object]:
    return {
        "kind": "run",
        "method": point.method,
        "parameters": " ".join(f"{key}={value:g}" for key, value in point.parameters.items()),
        "record": point.record,
        "case": point.scene,
        "time per run [s]": point.seconds,
        "PRD error [m]": point.prd_error_m,
        "PRD error [%]": point.prd_error_percent,
        "residual error [m]": point.residual_error_m,
        "residual error [%]": point.residual_error_percent,
        "status": point.status.value,
    }


def _run_in_two_axes(scene: str, point: PlaneWork) -> dict[str, object]:
    return {
        "kind": "run in two axes",
        "method": point.method,
        "parameters": point.setting,
        "case": scene,
        "time per run [s]": point.seconds,
        "PRD error [%]": point.error_percent,
    }
