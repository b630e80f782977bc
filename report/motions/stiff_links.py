"""Links that are too stiff to integrate in the steps of a row of blocks.

Steps grow with the square root of the stiffness: 100 times as stiff takes ten times as long.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from report.project.model import ProjectInput
from report.project.model.finding import Finding
from report.project.model.place import Place
from report.text.units import G_MPS2, Quantity
from solver.model import Motion


def stiff_links(data: ProjectInput, motions: Sequence[Motion]) -> Iterator[Finding]:
    """Yield the rows whose runs together need more than `MOST_STEPS` steps."""
    if not data.links:
        return
    from solver.sliding.row import MOST_STEPS, BlockRow, minimum_steps  # with the compiler

    seconds = sum(
        len(motion.orientations) * motion.dt_s * len(motion.ax_mps2) for motion in motions
    )
    weights = {array.id: array.weight_n for array in data.arrays}
    for index, links in enumerate(data.links):
        # Steps grow with the square root of the stiffness, per mass of a block.
        damping_per_s = 2.0 * links.damping_ratio
        soft = BlockRow(mus=links.mus, stiffness_per_s2=1.0, damping_per_s=damping_per_s)
        per_s2 = (MOST_STEPS / minimum_steps(soft, seconds)) ** 2
        largest = per_s2 * weights[links.array] / (len(links.mus) * G_MPS2)
        if links.stiffness_n_per_m > largest:
            yield Finding.error(
                Place("links", index, "stiffness_n_per_m"),
                f"link stiffness is {_stiffness_text(links.stiffness_n_per_m)}, too stiff to "
                f"integrate in {MOST_STEPS:.0e} steps",
                f"give {_stiffness_text(0.9 * largest)} or less (a stiffer row moves as one rigid "
                "block with the mean coefficient)",
            )


def _stiffness_text(stiffness: float) -> str:
    us, si = (f"{stiffness / unit.si:.2g} {unit.symbol}" for unit in Quantity.STIFFNESS.value)
    return f"{us} ({si})"
