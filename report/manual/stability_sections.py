"""Where methods fail, and where the problem itself is ill-conditioned: sections of the manual."""

from __future__ import annotations

import numpy as np

from report.document.sections import Section, section
from report.manual import stability_maps
from solver.verification.evidence import Verification


def stability(verification: Verification) -> Section:
    """Return the stability maps with their notes."""
    # Numbered through all charts: the notes name a map by its number.
    counted = list(enumerate(verification.maps, start=1))
    by_chart = {
        f"stability-{k // stability_maps.MOST + 1}": counted[k : k + stability_maps.MOST]
        for k in range(0, len(counted), stability_maps.MOST)
    }
    return section(
        "manual/stability",
        "Stability",
        by_chart=by_chart,
        charts={
            name: stability_maps.stability([sweep for _, sweep in maps], first=maps[0][0])
            for name, maps in by_chart.items()
        },
    )


def conditioning(verification: Verification) -> Section:
    """Return the effect of a small change of friction, the largest and the median change [%]."""
    return section(
        "manual/conditioning",
        "Sensitivity to the friction coefficient",
        cases=[
            (case, np.nanmax(case.change_percent), np.nanmedian(case.change_percent))
            for case in verification.conditioning
        ],
    )
