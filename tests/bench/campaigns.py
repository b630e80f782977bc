"""Claim: hostile inputs are read or refused within 10 s, and two axes end and keep to their bounds.

Hostile inputs are changed workbooks, parts, cells, records and arguments by seed; four in five
change a record. Pairs are random scenes of every kind of `solver.verification.random_pairs`, run
twice each, in child processes that are ended where a pair takes longer than 5 s. Every input and
every pair at fault is printed, and the exit code is 1.
"""

import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

from measure import SMOKE, figure

import report  # noqa: F401  # before openpyxl is loaded: it decides what that reads with
from fixtures.child_process import Ended, campaign, run_pair
from fixtures.hostile_inputs import trouble
from solver.verification.random_pairs import KINDS

INPUTS, PAIRS = (40, 20) if SMOKE else (10_000, 10_000)
AT_ONCE, BATCH = 2, 500


def kind_of(seed: int) -> str:
    """Return the kind of hostile input of a seed."""
    if seed % 200 == 0:
        return "book"
    return {3: "argument", 7: "part", 11: "cell", 17: "cell"}.get(seed % 20, "record")


def batch(seeds: range) -> list[str]:
    """Run the hostile inputs of some seeds; return those at fault."""
    cases = ((kind_of(seed), seed) for seed in seeds)
    return [f"{kind} {seed}: {told}" for kind, seed in cases if (told := trouble(kind, seed))]


def hostile_inputs() -> int:
    """Run hostile inputs; return how many are at fault."""
    seeds, at_fault = range(INPUTS), 0
    with ProcessPoolExecutor(AT_ONCE) as pool:
        for cases in pool.map(batch, [seeds[at : at + BATCH] for at in range(0, INPUTS, BATCH)]):
            at_fault += len(cases)
            for case in cases:
                print(case, flush=True)
    figure("hostile inputs", INPUTS)
    figure("neither read nor rejected within 10 s", at_fault)
    return at_fault


def pairs_of(kind: str) -> Iterator[Ended]:
    """Run the pairs of a kind, half of them in each of two processes."""
    halves = [[(kind, n) for n in range(half, PAIRS, 2)] for half in (0, 1)]
    with ThreadPoolExecutor(AT_ONCE) as pool:
        for ended in pool.map(campaign, [run_pair] * 2, halves):
            yield from ended


def two_axes() -> int:
    """Run pairs of every kind; return how many are at fault."""
    lost = over = 0
    for kind in KINDS:
        for call in pairs_of(kind):
            is_over = not call.trouble and call.outcome.ratio > 1.0
            lost, over = lost + bool(call.trouble), over + is_over
            if call.trouble or is_over:
                print(f"pair({kind!r}, {call.arguments[1]}): {call.trouble or call.outcome}")
    figure("pairs of random cases in two axes", len(KINDS) * PAIRS)
    figure("pairs that hang, crash or have no result", lost)
    figure("pairs that differ by more than their bounds", over)
    return lost + over


if __name__ == "__main__":
    sys.exit(1 if hostile_inputs() + two_axes() else 0)
