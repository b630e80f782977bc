"""Where methods fail, and where the problem itself is ill-conditioned."""

from __future__ import annotations

import numpy as np

from report.document.sections import Section, section
from report.figures import maps
from solver.verification.evidence import Verification


def stability(verification: Verification) -> Section:
    """Return the stability maps with their notes."""
    counted = list(enumerate(verification.maps, start=1))
    by_chart = {
        f"stability-{at // maps.MOST + 1}": counted[at : at + maps.MOST]
        for at in range(0, len(counted), maps.MOST)
    }
    return section(
        "manual/stability",
        "Stability",
        by_chart=by_chart,
        charts={
            name: maps.stability([sweep for _, sweep in found], first=found[0][0])
            for name, found in by_chart.items()
        },
    )


def conditioning(verification: Verification) -> Section:
    """Return the effect of a small change of friction."""
    cases = verification.conditioning
    by_chart = {f"conditioning-{at // 2 + 1}": cases[at : at + 2] for at in range(0, len(cases), 2)}
    return section(
        "manual/conditioning",
        "Sensitivity to the friction coefficient",
        by_chart={
            # A case with the largest and the median change [%].
            name: [
                (case, np.nanmax(case.change_percent), np.nanmedian(case.change_percent))
                for case in found
            ]
            for name, found in by_chart.items()
        },
        charts={name: maps.conditioning(found) for name, found in by_chart.items()},
    )
