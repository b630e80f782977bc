"""Kills `roofslip report` at random moments: does the folder ever hold a mixture of two sets?

Two sets of one project are made, which differ in every file; then runs that would write the second
over the first are killed. Half of the kills fall in the whole run, half in its last second.

Run from the top: .venv/bin/python tests/bench/report_kills.py [KILLS] [PROJECT]
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

from openpyxl import load_workbook

from report.making import OUTPUTS
from report.results.publish import STAMP, finish

ROOT = Path(__file__).resolve().parents[2]
LAST_S = 1.0


def started(project: Path, out: Path) -> subprocess.Popen[bytes]:
    """Start a report in a process group of its own."""
    command = [sys.executable, "-m", "report.cli", "report", str(project), "--out", str(out)]
    return subprocess.Popen(
        [*command, "--quiet"], cwd=ROOT, start_new_session=True, stderr=subprocess.DEVNULL
    )


def changed(project: Path, folder: Path) -> Path:
    """Return a copy of a project with another clearance, so that every output is another."""
    shutil.copytree(project / "records", folder / "records")
    book = load_workbook(project / "input.xlsx")
    sheet = book["Clearances"]
    heading = next(
        cell
        for row in sheet.iter_rows()
        for cell in row
        if str(cell.value).startswith("Provided clearance [")
    )
    sheet.cell(heading.row + 1, heading.column).value -= 1
    book.save(folder / "input.xlsx")
    return folder


def contents(folder: Path) -> dict[str, str]:
    """Return the SHA-256 of every output, and of the stamp."""
    names = [name for name in (*OUTPUTS, STAMP) if (folder / name).exists()]
    return {name: hashlib.sha256((folder / name).read_bytes()).hexdigest() for name in names}


def agrees(folder: Path) -> bool:
    """Whether all files are those of the stamp."""
    lines = (folder / STAMP).read_text().splitlines()
    hashes = contents(folder)
    return all(hashes.get(name) == digest for digest, name in (x.split("  ", 1) for x in lines))


def main() -> None:
    """Kill, look, let the next run finish, and count."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    project = ROOT / "projects" / (sys.argv[2] if len(sys.argv) > 2 else "conditions")
    rng = random.Random(1)
    found = {"old": 0, "new": 0, "mixed, and the stamp says so": 0, "mixed and accepted": 0,
             "not finished by the next run": 0}  # fmt: skip
    with tempfile.TemporaryDirectory() as top:
        out, old, new = (Path(top) / name for name in ("out", "old", "new"))
        (Path(top) / "other").mkdir()
        other = changed(project, Path(top) / "other")
        assert started(project, old).wait() == 0
        begun = time.monotonic()
        assert started(other, new).wait() == 0
        lasts = time.monotonic() - begun
        sets = contents(old), contents(new)
        assert all(sets[0][name] != sets[1][name] for name in (*OUTPUTS, STAMP)), sets
        for trial in range(count):
            shutil.rmtree(out, ignore_errors=True)
            shutil.copytree(old, out)
            child = started(other, out)
            first = 0.0 if trial % 2 else max(0.0, lasts - LAST_S)
            time.sleep(rng.uniform(first, lasts))
            os.killpg(child.pid, signal.SIGKILL)
            child.wait()
            hashes = contents(out)
            if hashes in sets:
                found["old" if hashes == sets[0] else "new"] += 1
            else:
                found["mixed and accepted" if agrees(out) else "mixed, and the stamp says so"] += 1
            finish(out)
            left = [path for path in out.iterdir() if path.is_dir()]
            found["not finished by the next run"] += contents(out) not in sets or bool(left)
    print(f"{count} kills within {lasts:.1f} s:",
          ", ".join(f"{name}: {value}" for name, value in found.items()))  # fmt: skip
    sys.exit(bool(found["mixed and accepted"] or found["not finished by the next run"]))


if __name__ == "__main__":
    main()
