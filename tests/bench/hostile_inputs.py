"""Runs hostile inputs by seed: each must be read, or refused with an input error, within 10 s.

Run from the top: PYTHONPATH=.:tests .venv/bin/python tests/bench/hostile_inputs.py [CASES]
    [FIRST SEED] [PROCESSES]
Four cases in five change a record. Prints every case that ended otherwise as soon as it is found,
then the count by kind.
"""

from __future__ import annotations

import sys
import time
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from mutations import trouble

import report  # noqa: F401  # before openpyxl is loaded: it decides what that reads with

_BATCH = 500


def kind_of(seed: int) -> str:
    """Return the kind of case of a seed."""
    if seed % 200 == 0:
        return "book"
    return {3: "argument", 7: "part", 11: "cell", 17: "cell"}.get(seed % 20, "record")


def batch(first: int, last: int) -> list[tuple[str, int, str]]:
    """Run the cases of some seeds; return those at fault."""
    cases = ((kind_of(seed), seed) for seed in range(first, last))
    return [(kind, seed, told) for kind, seed in cases if (told := trouble(kind, seed))]


def main() -> None:
    """Run the campaign, on all cores unless fewer are asked for."""
    given = dict(zip(("count", "first", "processes"), map(int, sys.argv[1:]), strict=False))
    count, first = given.get("count", 10_000), given.get("first", 0)
    started = time.monotonic()
    starts = range(first, first + count, _BATCH)
    ends = [min(start + _BATCH, first + count) for start in starts]
    found = 0
    with ProcessPoolExecutor(given.get("processes")) as pool:
        for cases in pool.map(batch, starts, ends):
            found += len(cases)
            for kind, seed, told in cases:
                print(f"{kind} {seed}: {told}", flush=True)
    kinds = Counter(kind_of(seed) for seed in range(first, first + count))
    print(f"{dict(kinds)}: {found} at fault, {time.monotonic() - started:.0f} s")


if __name__ == "__main__":
    main()
