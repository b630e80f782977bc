"""A large report: 12 arrays, 11 motions of three components, 30 clearances. Time and memory.

The product and the records are those of the example: other friction and slopes, and four motions
reversed in time.
Run from the top: .venv/bin/python tests/bench/large_report.py [FOLDER]
"""

from __future__ import annotations

import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
ARRAYS, MOTIONS, CLEARANCES = 12, 11, 30
WAYS = ("down", "up", "across")
COMPONENTS = ("record", "transverse", "vertical")


def make(folder: Path) -> None:
    """Write the project."""
    sys.path.insert(0, str(ROOT))
    from report.sheet import example
    from report.sheet.schema import ProjectInput, UnitsFirst
    from report.sheet.template import write_template

    records = ROOT / "projects" / "example" / "records"
    shutil.copytree(records, folder / "records", dirs_exist_ok=True)
    data = example.project().model_dump()
    rows = range(ARRAYS)
    data["arrays"] = [
        example._array(
            f"A{k + 1}",
            0.5 * (1 + k % 6),
            0.40 + 0.01 * (k % 6),
            (30 + 110 * (k % 4), 110 + 110 * (k % 4)),
            (30 + 110 * (k // 4), 110 + 110 * (k // 4)),
            **({"mu_fast": 0.50, "mu_rate_s_per_m": 20.0} if k % 4 == 3 else {}),
        )
        for k in rows
    ]
    data["objects"] = [
        example._object(
            f"RTU-{k + 1}",
            "fixed object",
            (124 + 110 * (k % 4), 128 + 110 * (k % 4)),
            (60 + 110 * (k // 4), 70 + 110 * (k // 4)),
            48,
        )
        for k in rows
    ]
    pairs = [(f"A{k + 1}", f"RTU-{k + 1}", WAYS[k % 3]) for k in rows]
    pairs += [(f"A{k + 1}", f"A{k + 2}", "across") for k in rows if k % 4 != 3]
    pairs += [(f"A{k + 1}", f"A{k + 5}", "up") for k in rows if k < 8]
    pairs += [("A4", "RTU-3", "across")]
    data["clearances"] = [example._clearance(*pair, 12) for pair in pairs][:CLEARANCES]
    backward = [_backward(folder, row) for row in data["motions"]]
    data["motions"] = [*data["motions"], *backward][:MOTIONS]
    data["roof"] |= {"x_to_m": 480 * example.FOOT, "y_to_m": 360 * example.FOOT}
    project = ProjectInput.model_validate(data)
    write_template(folder / "input.xlsx", units=UnitsFirst.US, example=project)


def _backward(folder: Path, row: dict[str, Any]) -> dict[str, Any]:
    """Write the records of a motion from their last sample to the first, and return its row."""
    parts = {name: f"{row[name].removesuffix('.csv')}-back.csv" for name in COMPONENTS}
    for name, path in parts.items():
        head, heading, samples = (folder / row[name]).read_text().partition("_g\n")
        pairs = [line.split(",") for line in samples.splitlines()]
        times, values = zip(*pairs, strict=True)
        lines = (f"{t},{a}\n" for t, a in zip(times, reversed(values), strict=True))
        (folder / path).write_text("".join([head, heading, *lines]))
    return row | {"id": f"{row['id']}B"} | parts


def main() -> None:
    """Write the project, make its report in a fresh process and print what it took."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(sys.argv[1] if len(sys.argv) > 1 else scratch)
        folder.mkdir(parents=True, exist_ok=True)
        make(folder)
        before, started = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
        subprocess.run(
            [sys.executable, "-m", "report.cli", "report", str(folder)],
            cwd=ROOT,
            check=True,
            stdout=subprocess.DEVNULL,
        )
        wall, after = time.perf_counter() - started, resource.getrusage(resource.RUSAGE_CHILDREN)
    busy = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    print(f"{ARRAYS} arrays, {MOTIONS} motions, {CLEARANCES} clearances")
    print(f"time {wall:.1f} s, processor time of both processes {busy:.1f} s")
    print(f"memory of the larger process {after.ru_maxrss / 1024:.0f} MB")


if __name__ == "__main__":
    main()
