"""verification.csv: every check and every run of the comparison, units in the headings."""

from __future__ import annotations

import pandas as pd

from solver.verification.evidence import Verification

_CHECK = {
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
}
"""Heading of each column, by the field that it has."""

_OF_TWO_AXES = ["method", "parameters", "case", "time per run [s]", "PRD error [%]"]


def verification_csv(verification: Verification) -> bytes:
    """Return one table: checks, runs, runs in two axes; a cell that does not apply is empty."""
    checks = [
        {heading: getattr(row, name) for name, heading in _CHECK.items()}
        | {"passed": "yes" if row.passed else "no"}
        for row in verification.checks
    ]
    parts = [("check", pd.DataFrame(checks)), ("run", verification.work.drop(columns="setting"))]
    parts += [("run in two axes", evidence.work[_OF_TWO_AXES]) for evidence in verification.models]
    kinds, frames = zip(*parts, strict=True)
    table = pd.concat(frames, keys=kinds, names=["kind", None]).reset_index("kind")
    text: str = table.to_csv(index=False, lineterminator="\n")
    return text.encode()
