"""Claim: a killed run leaves the old set of files or the new one, or a mixture its stamp tells.

A writer of sets is killed while it publishes; two writers publish to one folder at once while it is
read; and `roofslip report` is killed as it would write a set over another that differs in every
file, half of the times in its last second. The next run makes whole what a kill left.
"""

from __future__ import annotations

import hashlib
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from measure import ROOT, SMOKE, command, figure
from openpyxl import load_workbook

from report.making import OUTPUTS
from report.results.publish import STAMP

KILLS, SETS, REPORT_KILLS = (2, 20, 1) if SMOKE else (100, 800, 10)
PROJECT = ROOT / "projects" / "conditions"
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


def hashes(folder: Path) -> dict[str, str]:
    """Return the SHA-256 of every output, and of the stamp."""
    names = [name for name in (*OUTPUTS, STAMP) if (folder / name).exists()]
    return {name: hashlib.sha256((folder / name).read_bytes()).hexdigest() for name in names}


def agrees(folder: Path) -> bool:
    """Whether all files are those of the stamp."""
    found, lines = hashes(folder), (folder / STAMP).read_text().splitlines()
    return all(found.get(name) == digest for digest, name in (x.split("  ", 1) for x in lines))


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


def started(project: Path, out: Path) -> subprocess.Popen[bytes]:
    """Start a report in a process group of its own."""
    words = command("report", str(project), "--out", str(out), "--quiet")
    return subprocess.Popen(words, cwd=ROOT, start_new_session=True, stderr=subprocess.DEVNULL)


def changed(folder: Path) -> Path:
    """Return a copy of the project with another clearance, so that every output is another."""
    shutil.copytree(PROJECT / "records", folder / "records")
    book = load_workbook(PROJECT / "input.xlsx")
    cells = (cell for row in book["Clearances"].iter_rows() for cell in row)
    heading = next(c for c in cells if str(c.value).startswith("Provided clearance ["))
    book["Clearances"].cell(heading.row + 1, heading.column).value -= 1
    book.save(folder / "input.xlsx")
    return folder


def reports(top: Path) -> int:
    """Kill reports; return how often the folder then held a mixture, or stayed unfinished."""
    out, old, new = (top / name for name in ("out", "old", "new"))
    assert started(PROJECT, old).wait() == 0
    other, begun = changed(top / "other"), time.monotonic()
    assert started(other, new).wait() == 0
    lasts, sets, rng = time.monotonic() - begun, (hashes(old), hashes(new)), random.Random(1)
    assert all(sets[0][name] != sets[1][name] for name in (*OUTPUTS, STAMP)), sets
    kept = replaced = wrong = 0
    for trial in range(REPORT_KILLS):
        shutil.rmtree(out, ignore_errors=True)
        shutil.copytree(old, out)
        child = started(other, out)
        time.sleep(rng.uniform(0.0 if trial % 2 else max(0.0, lasts - 1.0), lasts))
        os.killpg(child.pid, signal.SIGKILL)
        child.wait()
        left = hashes(out)
        kept, replaced = kept + (left == sets[0]), replaced + (left == sets[1])
        is_accepted = left not in sets and agrees(out)
        assert started(other, out).wait() == 0
        wrong += is_accepted or hashes(out) != sets[1]
    figure("runs of `report` killed", REPORT_KILLS)
    figure("runs that left the old set", kept)
    figure("runs that left the new set", replaced)
    figure("mixed sets accepted, or not made whole by the next run", wrong)
    return wrong


def main() -> int:
    """Run the three experiments, each in a folder of its own."""
    bad = 0
    for experiment in (publishing, at_once, reports):
        with tempfile.TemporaryDirectory() as folder:
            bad += experiment(Path(folder))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
