"""Run every benchmark, or those named, and write their figures to figures.csv and the docs.

    .venv/bin/python tests/bench/run.py [--smoke] [--records FOLDER] [NAME ...]

With --smoke each takes seconds, and nothing is written. A table of README or docs between
`<!-- figures of NAME -->` and `<!-- end -->` holds all figures of a benchmark; a line between
`<!-- machine of NAME -->` and the end holds its date, its machine and its first figure; a figure in
a sentence stands before `<!-- NAME: FIGURE -->`, and is "?" where none was printed.
"""

import argparse
import csv
import datetime as dt
import os
import re
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
FIGURES = HERE / "figures.csv"
DOCS = (ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")))
COLUMNS = ("script", "figure", "value", "unit", "machine", "date")
NAMES = sorted({path.stem for path in HERE.glob("*.py")} - {"measure", "run"})
_TABLE = re.compile(r"(<!-- figures of (\w+) -->\n).*?(<!-- end -->)", re.DOTALL)
_MACHINE = re.compile(r"(<!-- machine of (\w+) -->\n).*?(<!-- end -->)", re.DOTALL)
_QUOTED = re.compile(r"[^\s(]+(?=<!-- (\w+): (.+?) -->)")

Row = dict[str, str]


def measured(name: str, *options: str) -> list[Row]:
    """Run a benchmark, print what it prints, and return its figures."""
    path = os.pathsep.join(map(str, (ROOT, ROOT / "tests")))
    told = {"script": name, "machine": machine(), "date": dt.date.today().isoformat()}
    child = subprocess.Popen(
        [sys.executable, str(HERE / f"{name}.py"), *options],
        cwd=ROOT,
        # Threads of BLAS that wait for each other would count as processor time.
        env=os.environ | {"PYTHONPATH": path, "OPENBLAS_NUM_THREADS": "1"},
        stdout=subprocess.PIPE,
        text=True,
    )
    rows = []
    assert child.stdout
    for line in child.stdout:
        print(f"{name}: {line}", end="", flush=True)
        if found := re.fullmatch(r"figure (.+): (\S+) ?(.*)\n", line):
            rows.append(dict(zip(COLUMNS[1:4], found.groups(), strict=True)) | told)
    if child.wait():
        raise SystemExit(f"{name} ended with exit code {child.returncode}")
    return rows


def machine() -> str:
    """Return processor, number of cores, and how many processes want one before a run."""
    said = Path("/proc/cpuinfo").read_text()
    model = re.search(r"model name\s*: (.*)", said)
    name = model[1] if model else "processor without a name"
    return f"{name}; {os.cpu_count()} cores; load {os.getloadavg()[0]:.1f} before"


def read() -> list[Row]:
    """Return the figures of the last runs."""
    with FIGURES.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def write(rows: list[Row]) -> None:
    """Write figures by script, those of a script in the order in which it prints them."""
    with FIGURES.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(sorted(rows, key=lambda row: row["script"]))


def shown(row: Row) -> str:
    """Return a value with its unit, a percentage without a space."""
    return f"{row['value']} {row['unit']}".rstrip().replace(" %", "%")


def with_figures(text: str, rows: list[Row]) -> str:
    """Return a document with its tables and quoted figures written anew."""
    values = {(row["script"], row["figure"]): row["value"] for row in rows}

    def table(found: re.Match[str]) -> str:
        own = [row for row in rows if row["script"] == found[2]]
        lines = [f"| {row['figure']} | {shown(row)} |" for row in own]
        head = (
            f"| `{found[2]}` | {own[0]['date']}; {own[0]['machine']} |\n|---|---|\n" if own else ""
        )
        return found[1] + "\n" + head + "\n".join(lines) + "\n\n" + found[3]

    def measured_on(found: re.Match[str]) -> str:
        row = next(row for row in rows if row["script"] == found[2])
        words = "{date}; {machine}; {figure}: {value} {unit}.".format_map(row)
        return f"{found[1]}\n{words}\n\n{found[3]}"

    text = _MACHINE.sub(measured_on, _TABLE.sub(table, text))
    return _QUOTED.sub(lambda found: values.get((found[1], found[2]), "?"), text)


def main() -> None:
    """Measure, and write where all sizes are the full ones."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--smoke", action="store_true")
    parser.add_argument("--records")
    parser.add_argument("names", nargs="*", choices=[[], *NAMES])
    given = parser.parse_args()
    options = ["--smoke"] * given.smoke + ["--records", given.records] * bool(given.records)
    for name in given.names or NAMES:
        rows = measured(name, *options)
        if not given.smoke:
            write([row for row in read() if row["script"] != name] + rows)
            for path in DOCS:
                path.write_text(with_figures(path.read_text("utf-8"), read()), encoding="utf-8")


if __name__ == "__main__":
    main()
