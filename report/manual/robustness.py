"""Where methods fail, and where the problem itself leaves no method a chance."""

from __future__ import annotations

import numpy as np

from report.figures import maps
from report.manual.blocks import (
    Block,
    Chart,
    ManualSection,
    percent,
)
from report.pages.parts import Picture
from solver.verification.evidence import (
    Verification,
)


def stability(found: Verification) -> ManualSection:
    """Return the stability maps with their notes."""
    intro = (
        "Where a method blows up, stalls, or is off: largest error in PRD of the scenes in each "
        "cell. A hatched cell failed: the method gave no number. Where a line is drawn it is the "
        "theoretical limit of the note below."
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
                            svg=maps.stability(found.maps[at : at + maps.MOST], first=at + 1),
                            caption="Stability maps. Shading: error in PRD. Hatched: failed.",
                            alt="Maps of the error in PRD over two settings of each method",
                        ),
                    ),
                ),
                items=[
                    f"({count}) {one.note} Failed: {int(one.failed.sum())} of "
                    f"{one.failed.size} cells."
                    for count, one in enumerate(found.maps[at : at + maps.MOST], start=at + 1)
                ],
            )
            for at in range(0, len(found.maps), maps.MOST)
        ],
    )


def conditioning(found: Verification) -> ManualSection:
    """Return what a small change of friction does."""
    intro = (
        "Where the answer hangs on the last digits of the friction coefficient, no method can be "
        "better than that: the problem itself is ill-conditioned there. Below is what a small "
        "change of μ does to the exact PRD. Friction is known to percents at best, and what 5 % of "
        "it changes is far more than any error of the exact method: each package states it for its "
        "own arrays."
    )
    return ManualSection(
        id="conditioning",
        title="Where no method can help",
        blocks=[
            Block(
                texts=(intro,) if at == 0 else (),
                charts=(
                    Chart(
                        name=f"conditioning-{at // 2 + 1}",
                        picture=Picture(
                            svg=maps.conditioning(found.conditioning[at : at + 2]),
                            caption="Exact PRD over the friction coefficient, and its change when "
                            "the coefficient changes as the title says.",
                            alt="PRD and its change over the friction coefficient",
                        ),
                    ),
                ),
                items=[
                    f"{one.title} (θ = {one.slope_deg:g}°, PPA = {one.ppa_g:g} g, {one.record}): "
                    f"largest change {percent(float(np.nanmax(one.change_percent)))}, median "
                    f"{percent(float(np.nanmedian(one.change_percent)))}. {one.note}"
                    for one in found.conditioning[at : at + 2]
                ],
            )
            for at in range(0, len(found.conditioning), 2)
        ],
    )
