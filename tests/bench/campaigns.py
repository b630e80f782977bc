"""Claim: hostile inputs are read or refused within 10 s, and two axes end and keep to their bounds.

Hostile inputs are changed workbooks, parts, cells, records and arguments by seed; four in five
change a record. Pairs are random scenes of every kind of `solver.verification.random_pairs`, run
twice each, in child processes that are ended where a pair takes longer than 5 s. Every input and
every pair at fault is printed, and the exit code is 1. `run.py` takes the sizes below; longer
campaigns: campaigns.py INPUTS PAIRS [FIRST SEED], in the PYTHONPATH .:tests.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import numpy as np
from measure import SMOKE, figure

import report  # noqa: F401  # before openpyxl is loaded: it decides what that reads with
from campaign import Ended, campaign, run_pair
from mutations import trouble
from solver.verification.random_pairs import KINDS

INPUTS, PAIRS = (40, 20) if SMOKE else (10_000, 10_000)
AT_ONCE, BATCH, PART = 2, 500, 10_000


def kind_of(seed: int) -> str:
    """Return the kind of hostile input of a seed."""
    if seed % 200 == 0:
        return "book"
    return {3: "argument", 7: "part", 11: "cell", 17: "cell"}.get(seed % 20, "record")


def batch(seeds: range) -> list[str]:
    """Run the hostile inputs of some seeds; return those at fault."""
    cases = ((kind_of(seed), seed) for seed in seeds)
    return [f"{kind} {seed}: {told}" for kind, seed in cases if (told := trouble(kind, seed))]


def hostile_inputs(count: int, first: int) -> int:
    """Run hostile inputs; return how many are at fault."""
    seeds, found = range(first, first + count), []
    with ProcessPoolExecutor(AT_ONCE) as pool:
        for cases in pool.map(batch, [seeds[at : at + BATCH] for at in range(0, count, BATCH)]):
            found += cases
            for case in cases:
                print(case, flush=True)
    figure("hostile inputs", count)
    figure("neither read nor refused within 10 s", len(found))
    return len(found)


def pairs_of(kind: str, numbers: range) -> Iterator[Ended]:
    """Run the pairs of a kind."""
    parts = [[(kind, n) for n in numbers[at : at + PART]] for at in range(0, len(numbers), PART)]
    with ThreadPoolExecutor(AT_ONCE) as pool:
        for part in pool.map(campaign, [run_pair] * len(parts), parts):
            yield from part


def two_axes(count: int, first: int) -> int:
    """Run pairs of every kind; return how many are at fault."""
    lost, over, medians, most = 0, 0, [], []
    for kind in KINDS:
        ratios = []
        for call in pairs_of(kind, range(first, first + count)):
            is_over = not call.trouble and call.outcome.ratio > 1.0
            lost, over = lost + bool(call.trouble), over + is_over
            if call.trouble or is_over:
                print(f"pair({kind!r}, {call.arguments[1]}): {call.trouble or call.outcome}")
            elif call.outcome.prd_m > 0.0:
                ratios.append(call.outcome.ratio)
        medians.append(float(np.median(ratios or [0.0])))
        most.append(float(np.percentile(ratios or [0.0], 99.0)))
        print(f"{kind}: median {medians[-1]:.1e}, 99th percentile {most[-1]:.1e} of the bound")
    figure("pairs of random cases in two axes", len(KINDS) * count)
    figure("pairs that hang, crash or have no result", lost)
    figure("pairs that differ by more than their bounds", over)
    figure("median difference relative to its bound, largest of all kinds of pairs", max(medians))
    figure("99th percentile of the same", max(most))
    return lost + over


def main() -> int:
    """Run both campaigns."""
    sizes = [int(word) for word in sys.argv[1:] if word.isdigit()]
    inputs, pairs = sizes[:2] or (INPUTS, PAIRS)
    first = sizes[2] if sizes[2:] else 0
    return 1 if hostile_inputs(inputs, first) + two_axes(pairs, first) else 0


if __name__ == "__main__":
    sys.exit(main())
