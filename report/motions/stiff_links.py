"""Finds links that are too stiff to integrate under the motions of a project.

`report.sheet.checking.checks` checks a row by itself and against its array.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from report.sheet.schema import ProjectInput
from report.sheet.schema.fields import Finding, Place
from report.sheet.schema.links import Links
from report.words.units import G_MPS2, Quantity
from solver.model import Motion
from solver.sliding.row import MOST_STEPS, BlockRow, minimum_steps


def stiff_links(data: ProjectInput, motions: Sequence[Motion]) -> Iterator[Finding]:
    """Yield the rows whose runs together need more than `MOST_STEPS` steps."""
    seconds = sum(
        len(motion.orientations) * motion.dt_s * len(motion.ax_mps2) for motion in motions
    )
    weights = {array.id: array.weight_n for array in data.arrays}
    for index, links in enumerate(data.links):
        most = _stiffest(links, weights[links.array], seconds)
        if links.stiffness_n_per_m > most:
            yield Finding.error(
                Place("links", index, "stiffness_n_per_m"),
                f"link stiffness is {_said(links.stiffness_n_per_m)}, too stiff to "
                f"integrate in {MOST_STEPS:.0e} steps",
                f"give {_said(0.9 * most)} or less (a stiffer row moves as one rigid "
                "block with the mean coefficient)",
            )


def _stiffest(links: Links, weight_n: float, seconds: float) -> float:
    """Return the stiffness [N/m] that needs `MOST_STEPS`; steps grow with its square root."""
    soft = BlockRow(mus=links.mus, stiffness_per_s2=1.0, damping_per_s=2.0 * links.damping_ratio)
    per_s2 = (MOST_STEPS / minimum_steps(soft, seconds)) ** 2
    return per_s2 * weight_n / (len(links.mus) * G_MPS2)


def _said(stiffness: float) -> str:
    us, si = (f"{stiffness / unit.si:.2g} {unit.symbol}" for unit in Quantity.STIFFNESS.value)
    return f"{us} ({si})"
