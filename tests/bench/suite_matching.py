"""Claim: made suites satisfy AC156 for every seed, uncorrelated and without drift.

Seven motions of each of three seeds, ASCE 7-16 at the roof.
"""

import time

from measure import SMOKE, figure

from solver.rules.ac156 import ac156_horizontal, ac156_vertical
from solver.rules.hazard import EDITIONS
from solver.synthesis.matching import spectrum_fit
from solver.synthesis.suite import make_suite

S_DS_G = 1.2
SEEDS, COUNT = (1, 1) if SMOKE else (3, 7)


if __name__ == "__main__":
    horizontal = ac156_horizontal(EDITIONS["ASCE 7-16"], s_ds_g=S_DS_G, z_over_h=1.0)
    vertical = ac156_vertical(s_ds_g=S_DS_G)
    across, upward = (horizontal.freq_hz, horizontal.sa_g), (vertical.freq_hz, vertical.sa_g)
    make_suite(across, upward, count=1, seed=0)  # compiled
    fits, correlations, drift, begun = [], [], 0, time.process_time()
    for seed in range(SEEDS):
        for motion in make_suite(across, upward, count=COUNT, seed=seed):
            correlations += [abs(value) for value in motion.correlations]
            for record, target in zip(motion.components, (across, across, upward), strict=True):
                fits.append(spectrum_fit(record, target))
                whole = [round(a) for a in (record.a_mps2 / 9.80665 * 1e5).tolist()]
                drift = max(drift, abs(sum(whole)), abs(sum(n * k for n, k in enumerate(whole))))
    taken = time.process_time() - begun
    figure("seeds", SEEDS)
    figure("components", len(fits))
    figure("time to generate and check a component", taken / len(fits), "s")
    figure("smallest ratio to the target", min(fit.minimum for fit in fits), digits=3)
    figure("largest ratio to the target", max(fit.maximum for fit in fits), digits=3)
    figure("smallest mean ratio", min(fit.mean for fit in fits), digits=3)
    figure("largest mean ratio", max(fit.mean for fit in fits), digits=3)
    figure("largest correlation of two components", max(correlations))
    figure("sums of samples and moments, largest deviation from zero", drift)
