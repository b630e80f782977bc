"""Kills a run while it publishes, and lets two runs publish at once: are the sets ever mixed?

Run from the top: .venv/bin/python tests/bench/publish_kills.py [KILLS] [SETS]
Prints how many kills left files of two sets, how many of those the stamp of the set did not tell
(must be 0), how many the next run did not finish (must be 0), and the same for two runs at once.
"""

from __future__ import annotations

import hashlib
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from report.results.publish import STAMP, finish

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


def writer(folder: Path, start: int, step: int, stop: int) -> subprocess.Popen[bytes]:
    """Start a process that publishes sets numbered `start`, `start` + `step`, ..."""
    numbers = [str(number) for number in (start, step, stop)]
    return subprocess.Popen(
        [sys.executable, "-c", WRITER, str(folder), *numbers], stdout=subprocess.PIPE
    )


def state(folder: Path) -> tuple[bool, bool]:
    """Whether all files agree with the stamp, and whether they are of one set."""
    pairs = [line.split("  ", 1) for line in (folder / STAMP).read_text().splitlines()]
    contents = {name: (folder / name).read_bytes() for _, name in pairs}
    agree = all(hashlib.sha256(contents[name]).hexdigest() == digest for digest, name in pairs)
    return agree, len({content[:10] for content in contents.values()}) == 1


def kills(folder: Path, count: int, rng: random.Random) -> dict[str, int]:
    """Kill a writer at random moments after its first set."""
    found = {"kills": count, "of two sets": 0, "not told": 0, "not finished": 0}
    for trial in range(count):
        child = writer(folder, 10_000 * trial, 1, 10**8)
        assert child.stdout
        child.stdout.readline()
        time.sleep(rng.uniform(0.0, 0.05))
        child.send_signal(signal.SIGKILL)
        child.wait()
        child.stdout.close()
        agree, one = state(folder)
        found["of two sets"] += not one
        found["not told"] += agree and not one
        finish(folder)
        found["not finished"] += state(folder) != (True, True)
        found["not finished"] += sum(path.is_dir() for path in folder.iterdir())
    return found


def at_once(folder: Path, sets: int) -> dict[str, int]:
    """Let two writers publish to one folder, and read it all the while."""
    children = [writer(folder, start, 2, sets) for start in (0, 1)]
    found = {"sets": sets, "read": 0, "accepted": 0, "mixed and accepted": 0}
    while any(child.poll() is None for child in children):
        try:
            before = (folder / STAMP).read_bytes()
            agree, one = state(folder)
            accepted = agree and (folder / STAMP).read_bytes() == before
        except FileNotFoundError:
            continue
        found["read"] += 1
        found["accepted"] += accepted
        found["mixed and accepted"] += accepted and not one
    for child in children:
        assert child.stdout
        child.stdout.close()
        assert child.returncode == 0
    found["mixed at the end"] = state(folder) != (True, True)
    return found


def main() -> None:
    """Print the counts of both experiments."""
    count, sets = (int(text) for text in (*sys.argv[1:], *("200", "800")[len(sys.argv) - 1 :]))
    for title, run in (
        ("killed", lambda folder: kills(folder, count, random.Random(1))),
        ("two at once", lambda folder: at_once(folder, sets)),
    ):
        with tempfile.TemporaryDirectory() as folder:
            found = run(Path(folder))
        print(title, ", ".join(f"{name}: {int(value)}" for name, value in found.items()))


if __name__ == "__main__":
    main()
