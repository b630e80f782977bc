"""Where methods fail, and where the problem itself is ill-conditioned: sections of the manual."""

from __future__ import annotations

import numpy as np

from report.document.sections import Section, section
from report.manual import stability_maps
from report.text.error_text import percent
from report.text.units import NO_BREAK
from solver.verification.evidence import StabilityMap, Verification


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
        by_chart=[
            (name, [f"({count}) {_note(sweep)}" for count, sweep in maps])
            for name, maps in by_chart.items()
        ],
        charts={
            name: stability_maps.stability([sweep for _, sweep in maps], first=maps[0][0])
            for name, maps in by_chart.items()
        },
    )


def _note(sweep: StabilityMap) -> str:
    return f"{sweep.note} Failed: {sweep.failed.sum()} of {sweep.failed.size} cells."


def conditioning(verification: Verification) -> Section:
    """Return the effect of a small change of friction, the largest and the median change [%]."""
    return section(
        "manual/conditioning",
        "Sensitivity to the friction coefficient",
        cases=[
            f"{case.title} (θ = {case.slope_deg:g}°, PPA = {case.ppa_g:g}{NO_BREAK}g, "
            f"{case.record}): largest change {percent(np.nanmax(case.change_percent))}, "
            f"median {percent(np.nanmedian(case.change_percent))}. {case.note}"
            for case in verification.conditioning
        ],
    )
