"""Claim: no method in one axis is faster than the exact one, and each other one has an error.

Every method under the records and cases of the manual, in one run, at its default setting; errors
are relative to the exact method, which `solver_accuracy` compares with 40-digit arithmetic.
"""

from __future__ import annotations

from measure import SMOKE, figure

from solver.rivals.methods import METHODS
from solver.verification.scenes import own_records
from solver.verification.workprecision import work_points


def main() -> None:
    """Print time and error of each method."""
    found = work_points(own_records(quick=SMOKE), quick=SMOKE)
    is_default = [
        not METHODS[name].knob or value == METHODS[name].parameters[METHODS[name].knob]
        for name, value in zip(found["method"], found["setting"], strict=True)
    ]
    for name, runs in found[is_default].groupby("method", sort=False):
        method, errors = METHODS[name], runs["PRD error [%]"]
        at = f", {method.knob} = {method.parameters[method.knob]:g}" if method.knob else ""
        said = f"; error of the PRD {errors.median():.2g} % in the median, "
        said += f"{errors.max():.3g} % at most"
        figure(
            f"{method.label}{at}",
            runs["time per run [s]"].median() * 1e3,
            f"ms in {len(runs)} runs" + said * (name != "exact"),
        )


if __name__ == "__main__":
    main()
