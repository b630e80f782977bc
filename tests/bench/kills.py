"""Claim: a killed run leaves the old set of files or the new one, or a mixture its stamp tells.

A writer of sets is killed while it publishes, and the next run makes whole what it left; two
writers publish to one folder at once while it is read.
"""

from __future__ import annotations

import hashlib
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from measure import SMOKE, figure

from report.results.publish import STAMP

KILLS, SETS = (2, 20) if SMOKE else (100, 800)
# Files of the size of a package and its tables.
WRITER = """
import sys
from pathlib import Path
from report.results.publish import publish
start, step, stop = map(int, sys.argv[2:5])
sizes = {"calc-package.pdf": 150_000, "plan.dxf": 20_000, "results.xlsx": 5_000,
         "results.json": 30_000}
for n in range(start, stop, step):
    publish({name: b"%09d\\n" % n * size for name, size in sizes.items()}, Path(sys.argv[1]))
    print(n, flush=True)
"""


def writer(folder: Path, *numbers: int) -> subprocess.Popen[bytes]:
    """Start a process that publishes sets numbered from, by, up to."""
    words = [sys.executable, "-c", WRITER, str(folder), *map(str, numbers)]
    return subprocess.Popen(words, stdout=subprocess.PIPE)


def state(folder: Path) -> tuple[bool, bool]:
    """Whether all files agree with the stamp, and whether they are of one set of the writer."""
    lines = [line.split("  ", 1) for line in (folder / STAMP).read_text().splitlines()]
    contents = {name: (folder / name).read_bytes() for _, name in lines}
    agree = all(hashlib.sha256(contents[name]).hexdigest() == digest for digest, name in lines)
    return agree, len({content[:10] for content in contents.values()}) == 1


def publishing(folder: Path) -> int:
    """Kill a writer at random moments after its first set; return how often that was not told."""
    rng, untold, unfinished = random.Random(1), 0, 0
    for trial in range(KILLS):
        child = writer(folder, 10_000 * trial, 1, 10**8)
        assert child.stdout
        child.stdout.readline()
        time.sleep(rng.uniform(0.0, 0.05))
        child.kill()
        child.wait()
        child.stdout.close()
        untold += state(folder) == (True, False)
        child = writer(folder, 10_000 * trial, 1, 10_000 * trial + 1)
        child.communicate()
        unfinished += state(folder) != (True, True)
    figure("writers killed while they publish", KILLS)
    figure("mixed sets that the stamp accepts", untold)
    figure("sets that the next run does not make whole", unfinished)
    return untold + unfinished


def at_once(folder: Path) -> int:
    """Let two writers publish to one folder, and read it all the while."""
    children, mixed = [writer(folder, start, 2, SETS) for start in (0, 1)], 0
    while any(child.poll() is None for child in children):
        try:
            before = (folder / STAMP).read_bytes()
            is_mixed = state(folder) == (True, False)
            mixed += is_mixed and (folder / STAMP).read_bytes() == before
        except FileNotFoundError:
            continue
    for child in children:
        assert child.stdout
        child.stdout.close()
        assert child.returncode == 0
    mixed += state(folder) != (True, True)
    figure("sets published by two runs at once", SETS)
    figure("mixed sets of these that were accepted", mixed)
    return mixed


def main() -> int:
    """Run both experiments, each in a folder of its own."""
    bad = 0
    for experiment in (publishing, at_once):
        with tempfile.TemporaryDirectory() as folder:
            bad += experiment(Path(folder))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
