"""Where methods fail, and where the problem itself is ill-conditioned."""

from __future__ import annotations

import numpy as np

from report.document.blocks import Picture
from report.figures import maps
from report.manual.blocks import (
    Block,
    Chart,
    ManualSection,
    percent,
)
from solver.verification.evidence import (
    Verification,
)


def stability(verification: Verification) -> ManualSection:
    """Return the stability maps with their notes."""
    intro = (
        "The maps show where a method diverges, stalls or loses accuracy. Each cell shows the "
        "largest error in PRD over the analysis cases of that cell. In a hatched cell the method "
        "failed to give a result. A line, where drawn, is the theoretical limit given in the note."
    )
    return ManualSection(
        id="stability",
        title="Stability",
        blocks=[
            Block(
                texts=(intro,) if at == 0 else (),
                charts=(
                    Chart(
                        name=f"stability-{at // maps.MOST + 1}",
                        picture=Picture(
                            svg=maps.stability(
                                verification.maps[at : at + maps.MOST], first=at + 1
                            ),
                            caption="Stability maps. Shading: error in PRD. Hatched: failed.",
                            alt="Maps of the error in PRD over two parameters of each method",
                        ),
                    ),
                ),
                items=[
                    f"({count}) {sweep.note} Failed: {int(sweep.failed.sum())} of "
                    f"{sweep.failed.size} cells."
                    for count, sweep in enumerate(
                        verification.maps[at : at + maps.MOST], start=at + 1
                    )
                ],
            )
            for at in range(0, len(verification.maps), maps.MOST)
        ],
    )


def conditioning(verification: Verification) -> ManualSection:
    """Return the effect of a small change of friction."""
    intro = (
        "Where the result depends on the last digits of the friction coefficient, the problem "
        "itself is ill-conditioned and no method can be accurate. The charts show the change of "
        "the exact PRD due to a small change of μ. Friction is known to a few percent at best, "
        "and a change of 5 % in friction has a far larger effect than the error of the exact "
        "method. Each package states that effect for its own arrays."
    )
    return ManualSection(
        id="conditioning",
        title="Sensitivity to the friction coefficient",
        blocks=[
            Block(
                texts=(intro,) if at == 0 else (),
                charts=(
                    Chart(
                        name=f"conditioning-{at // 2 + 1}",
                        picture=Picture(
                            svg=maps.conditioning(verification.conditioning[at : at + 2]),
                            caption="Exact PRD against the friction coefficient (top), and its "
                            "change for the change of μ stated in the title (bottom).",
                            alt="PRD and its change against the friction coefficient",
                        ),
                    ),
                ),
                items=[
                    f"{case.title} (θ = {case.slope_deg:g}°, PPA = {case.ppa_g:g} g, "
                    f"{case.record}): largest change "
                    f"{percent(float(np.nanmax(case.change_percent)))}, median "
                    f"{percent(float(np.nanmedian(case.change_percent)))}. {case.note}"
                    for case in verification.conditioning[at : at + 2]
                ],
            )
            for at in range(0, len(verification.conditioning), 2)
        ],
    )
