"""What a report costs by arrays, motions and samples, for `report.assessment.cost`.

Run from the top: PYTHONPATH=.:tests .venv/bin/python tests/bench/report_cost.py
Arrays and motions of the example, repeated, the motions in reverse; longer motions are its motions
one after the other.
Prints the processor time of the command with its second process, then the fit; rows of linked
blocks are in no term of it, and shown to cost little.
"""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
COMPONENTS = ("record", "transverse", "vertical")
# Arrays, motions, length of the motions as a multiple of 30 s, rows of linked blocks.
CASES = (
    (3, 7, 1, 0), (12, 7, 1, 0), (3, 14, 1, 0), (3, 7, 4, 0), (12, 14, 1, 0), (12, 14, 3, 0),
    (24, 7, 2, 0), (3, 7, 1, 2), (6, 7, 2, 4),
)  # fmt: skip


def make(folder: Path, arrays: int, motions: int, length: int, rows: int) -> None:
    """Write a project."""
    spec = importlib.util.spec_from_file_location("make", ROOT / "projects/example/make.py")
    example: Any = importlib.util.module_from_spec(spec)  # type: ignore[arg-type]
    spec.loader.exec_module(example)  # type: ignore[union-attr]
    from report.sheet.schema import ProjectInput, UnitsFirst
    from report.sheet.template import write_template
    from solver.formats import read_record

    (folder / "records").mkdir(parents=True)
    for path in (ROOT / "projects" / "example" / "records").iterdir():
        record = read_record(path)
        a_g = np.tile(record.a_mps2 / 9.80665, length)
        for name, samples in ((path.name, a_g), (_back(path.name), a_g[::-1])):
            lines = (f"{k * record.dt_s:.4f},{a:.6f}\n" for k, a in enumerate(samples))
            (folder / "records" / name).write_text("time_s,acceleration_g\n" + "".join(lines))
    data = example.project().model_dump()
    first = data["arrays"]
    data["arrays"] = [
        first[k % 3]
        | {
            "id": f"A{k + 1}",
            "x_from_m": 60.0 * (k % 5),
            "x_to_m": 60.0 * (k % 5) + 20.0,
            "y_from_m": 60.0 * (k // 5),
            "y_to_m": 60.0 * (k // 5) + 20.0,
        }
        for k in range(arrays)
    ]
    data["objects"], data["clearances"] = [], []
    data["roof"] |= {"x_to_m": 300.0, "y_to_m": 300.0}
    given = data["motions"]
    backward = [row | {name: _back(row[name]) for name in COMPONENTS} for row in given]
    rows_of = [*given, *backward][:motions]
    data["motions"] = [row | {"id": f"R{k + 1}"} for k, row in enumerate(rows_of)]
    data["links"] = [
        {"array": f"A{k + 1 + k // 2}", "friction": "0.4, 0.5, 0.6", "stiffness_n_per_m": 1e5}
        for k in range(rows)
    ]
    project = ProjectInput.model_validate(data)
    write_template(folder / "input.xlsx", units=UnitsFirst.US, example=project)


def _back(name: str) -> str:
    """Return the name of a record reversed in time: no motion may be given twice."""
    return f"{name.removesuffix('.csv')}-back.csv"


def seconds(folder: Path) -> float:
    """Return the processor time [s] of a report."""
    child = subprocess.Popen(
        [sys.executable, "-m", "report.cli", "report", str(folder), "--quiet"],
        stdout=subprocess.PIPE,
    )
    assert child.stdout
    child.stdout.read()
    _, status, used = os.wait4(child.pid, 0)
    assert status == 0, status
    return used.ru_utime + used.ru_stime


def main() -> None:
    """Measure every case, and fit seconds to a sum of products."""
    terms, measured = [], []
    for arrays, motions, length, rows in CASES:
        with tempfile.TemporaryDirectory() as name:
            make(Path(name) / "job", arrays, motions, length, rows)
            measured.append(seconds(Path(name) / "job"))
        samples = 6001 * length * motions
        terms.append((1.0, arrays, motions, samples / 1e6, arrays * samples / 1e6))
        print(f"{arrays:3d} arrays {motions:3d} motions {length:2d} x 30 s {rows:2d} rows "
              f"{measured[-1]:7.1f} s", flush=True)  # fmt: skip
    # Relative errors: a short report is to be told as well as a long one.
    relative = np.array(terms) / np.array(measured)[:, None]
    fit, *_ = np.linalg.lstsq(relative, np.ones(len(measured)), rcond=None)
    print("constant, per array, per motion, per million samples, of these per array:")
    print("  ".join(f"{value:.3g}" for value in fit))
    print("fitted over measured:", np.round(relative @ fit, 2))


if __name__ == "__main__":
    main()
