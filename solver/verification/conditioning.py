"""Cases in which the problem itself is sensitive to the last digits of the friction coefficient."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from solver.records.record import Record
from solver.studies.sweep import sweep
from solver.verification.evidence import Conditioning, percent_off
from solver.verification.stability import CRITICAL_MU, PPA_G, SLOPE_DEG
from solver.verification.verification_motions import scale_to


def conditioning(record: Record, *, quick: bool) -> Iterator[Conditioning]:
    """Compute the change of the exact PRD for small changes of the friction coefficient."""
    count = 60 if quick else 240
    # Toward the critical friction from both sides, to within a millionth of it.
    near = CRITICAL_MU * (1.0 + np.geomspace(1e-6, 0.5, count // 2))
    below = 2.0 * CRITICAL_MU - near[::-1]
    both = np.concatenate([below, near])
    wide = np.linspace(0.02, 0.8, count)
    still = "Without shaking the block slides freely if μ < tan θ and stays at rest if μ > tan θ. "
    still += "At the limit the result depends on the last digits of μ, for every method."
    shaken = "With shaking, a change in the 9th digit of μ changes the PRD by a similarly small "
    shaken += "share, except where a slip barely occurs."
    design = "This is the effect of 5% more or less friction on the PRD."
    for title, note, ppa_g, change, mu in (
        ("μ changed by 10⁻⁹, no shaking", still, 0.0, 1e-9, both),
        ("μ changed by 10⁻⁹, shaking, μ near tan θ", shaken, PPA_G, 1e-9, both),
        ("μ changed by 10⁻⁹, shaking", shaken, 1.0, 1e-9, wide),
        ("μ changed by 5%, shaking", design, 1.0, 0.05, wide),
    ):
        # One sweep for all three; its runs are bit-identical to those of the exact method.
        prd_m, less_m, more_m = sweep(
            record.a_mps2,
            record.dt_s,
            slopes_rad=math.radians(SLOPE_DEG),
            mus=np.concatenate([mu, mu * (1.0 - change), mu * (1.0 + change)]),
            scales=scale_to(record, ppa_g),
        ).prd_m.reshape(3, mu.size)
        yield Conditioning(
            title=title,
            note=note,
            record=record.name,
            slope_deg=SLOPE_DEG,
            ppa_g=ppa_g,
            mu=mu,
            prd_m=prd_m,
            change_percent=np.maximum(percent_off(less_m, prd_m), percent_off(more_m, prd_m)),
        )
