"""Runs hostile inputs by seed: each must be read, or refused with an input error, within 10 s.

Run from the top: PYTHONPATH=.:tests .venv/bin/python tests/bench/campaign.py [CASES] [FIRST SEED]
Nine cases in ten change a record. Prints every case that ended otherwise, and the count by kind.
"""

from __future__ import annotations

import sys
import time
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from mutations import trouble

_BATCH = 500


def kind_of(seed: int) -> str:
    """Return the kind of case of a seed."""
    return {3: "argument", 7: "part"}.get(seed % 20, "record")


def batch(first: int, last: int) -> list[tuple[str, int, str]]:
    """Run the cases of some seeds; return those at fault."""
    cases = ((kind_of(seed), seed) for seed in range(first, last))
    return [(kind, seed, told) for kind, seed in cases if (told := trouble(kind, seed))]


def main() -> None:
    """Run the campaign on all cores."""
    count, first = (int(text) for text in (*sys.argv[1:], *("10000", "0")[len(sys.argv) - 1 :]))
    started = time.monotonic()
    starts = range(first, first + count, _BATCH)
    with ProcessPoolExecutor() as pool:
        ends = [min(start + _BATCH, first + count) for start in starts]
        found = [case for cases in pool.map(batch, starts, ends) for case in cases]
    for kind, seed, told in found:
        print(f"{kind} {seed}: {told}")
    kinds = Counter(kind_of(seed) for seed in range(first, first + count))
    print(f"{dict(kinds)}: {len(found)} at fault, {time.monotonic() - started:.0f} s")


if __name__ == "__main__":
    main()
