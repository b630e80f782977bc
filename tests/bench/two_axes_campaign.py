"""Whether two axes end and keep to their bounds, over random scenes of every kind.

Run from the top: PYTHONPATH=tests .venv/bin/python tests/bench/two_axes_campaign.py [PAIRS [FIRST]]
Two runs to a pair (`solver.verification.random_pairs`), 100,000 pairs of each kind, in child
processes that are ended where a pair takes longer than 5 s. Prints each pair that hangs, crashes,
has no answer or differs by more than its bounds; half an hour on two cores.
"""

from __future__ import annotations

import sys
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from campaign import Ended, campaign, run_pair
from solver.verification.random_pairs import KINDS

AT_ONCE = 2
PART = 10_000


def main() -> int:
    """Print a row for each kind, and how the bad ones can be made again."""
    count = int(sys.argv[1]) if sys.argv[1:] else 100_000
    begin = int(sys.argv[2]) if sys.argv[2:] else 0
    print(f"{'kind':24}{'pairs':>8}{'no end':>8}{'over':>6}{'median':>9}{'99 %':>9}{'largest':>9}")
    bad: list[Ended] = []
    started = time.perf_counter()
    with ThreadPoolExecutor(AT_ONCE) as pool:
        for kind in KINDS:
            ends = range(begin, begin + count)
            parts = [[(kind, n) for n in ends[at : at + PART]] for at in range(0, count, PART)]
            ended = [
                call for part in pool.map(campaign, [run_pair] * len(parts), parts) for call in part
            ]
            troubled = [call for call in ended if call.trouble]
            over = [call for call in ended if not call.trouble and call.outcome.ratio > 1.0]
            bad += troubled + over
            ratios = [
                call.outcome.ratio
                for call in ended
                if not call.trouble and call.outcome.prd_m > 0.0
            ]
            middle, most = np.percentile(ratios, (50.0, 99.0))
            print(
                f"{kind:24}{len(ended):8}{len(troubled):8}{len(over):6}{middle:9.1e}{most:9.1e}"
                f"{max(ratios):9.1e}",
                flush=True,
            )
    for call in bad:
        kind, index = call.arguments
        print(f"pair({kind!r}, {index}): {call.trouble or call.outcome}")
    print(f"{time.perf_counter() - started:.0f} s")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
