"""verification.csv: every check and every run of the comparison, units in the headings."""

from __future__ import annotations

from collections.abc import Mapping

import pandas as pd

from solver.verification.evidence import Verification, WorkPoint

_COLUMNS = {
    "kind": "kind",
    "id": "id",
    "section": "section",
    "problem": "problem",
    "source": "source",
    "quantity": "quantity",
    "unit": "unit",
    "expected": "expected",
    "computed": "computed",
    "error": "error [-]",
    "tolerance": "tolerance [-]",
    "passed": "passed",
    "method": "method",
    "parameters": "parameters",
    "record": "record",
    "scene": "case",
    "seconds": "time per run [s]",
    "prd_error_m": "PRD error [m]",
    "prd_error_percent": "PRD error [%]",
    "residual_error_m": "residual error [m]",
    "residual_error_percent": "residual error [%]",
    "status": "status",
}
"""Heading of each column, by the field that it has."""


def verification_csv(verification: Verification) -> bytes:
    """Return one table: checks, runs, runs in two axes; a cell that does not apply is empty."""
    rows = [_row("check", row, passed="yes" if row.passed else "no") for row in verification.checks]
    rows += [_row("run", point, parameters=_given(point)) for point in verification.work]
    rows += [
        _row(
            "run in two axes",
            point,
            parameters=point.setting,
            scene=evidence.work_scene,
            prd_error_percent=point.error_percent,
        )
        for evidence in verification.models
        for point in evidence.work
    ]
    frame = pd.DataFrame(rows, columns=list(_COLUMNS)).rename(columns=_COLUMNS)
    text: str = frame.to_csv(index=False, lineterminator="\n")
    return text.encode()


def _row(kind: str, item: object, **more: str | float) -> Mapping[str, object]:
    own = {name: getattr(item, name) for name in _COLUMNS if hasattr(item, name)}
    return own | {"kind": kind} | more


def _given(point: WorkPoint) -> str:
    return " ".join(f"{name}={value:g}" for name, value in point.parameters.items())
