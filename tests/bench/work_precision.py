"""Claim: no method in one axis is faster than the exact one, and each other one has an error.

Every method under the records and cases of the manual, in one run, at its default setting; errors
are relative to the exact method, which `solver_accuracy` compares with 40-digit arithmetic.
"""

from __future__ import annotations

import statistics
from collections import defaultdict

from measure import SMOKE, figure

from solver.rivals.methods import METHODS
from solver.verification.evidence import WorkPoint
from solver.verification.scenes import own_records
from solver.verification.workprecision import work_points


def main() -> None:
    """Print time and error of each method."""
    by_method: dict[str, list[WorkPoint]] = defaultdict(list)
    for point in work_points(own_records(quick=SMOKE), quick=SMOKE):
        method = METHODS[point.method]
        if not method.knob or point.setting == method.parameters[method.knob]:
            by_method[point.method].append(point)
    for name, points in by_method.items():
        method = METHODS[name]
        errors = [point.prd_error_percent for point in points]
        at = f", {method.knob} = {method.parameters[method.knob]:g}" if method.knob else ""
        said = (
            f"; error of the PRD {statistics.median(errors):.2g} % in the median, "
            f"{max(errors):.3g} % at most"
        )
        figure(
            f"{method.label}{at}; {len(points)} runs",
            statistics.median(point.seconds for point in points) * 1e3,
            "ms" + said * (name != "exact"),
        )


if __name__ == "__main__":
    main()
