"""Whether every output of `report` and every sheet of `new` is as an older commit makes it.

    python tests/unchanged.py COMMIT [--cases SI links] [--folder FOLDER] [--words]

For each project and for altered copies of them: results.json, plan.dxf, cells of results.xlsx;
cells of the blank and filled input sheets; with --words also words and drawings of each page of the
PDF. Prints what differs and ends with 1 if anything does. What the older commit made is kept in the
folder.
"""

from __future__ import annotations

import argparse
import difflib
import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from pypdf import PdfReader
from pypdf.generic import StreamObject

from places import ROOT
from report.sheet.reading.read import read
from report.sheet.schema import ProjectInput
from report.sheet.schema.answers import STATUS_FORMAT
from report.sheet.writing.counts import COUNT_FORMAT, START
from report.sheet.writing.template import write_template

Data = dict[str, Any]
NEW = {"new-us": [], "new-si": ["--units", "SI"], "new-study": ["--study"]}
FILLED = """
import sys
from pathlib import Path
try:
    from report.sheet.reading.read import read
    from report.sheet.writing.template import write_template
except ImportError:  # the older commit has no rooms
    from report.sheet.read import read
    from report.sheet.template import write_template
source, path = map(Path, sys.argv[1:])
project = read(source).project
path.parent.mkdir(parents=True)
write_template(path, units=project.project.units_first, example=project)
"""
"""A filled input sheet, from one that is filled."""
LINES = 40
"""Of a difference that are printed."""


def _having(**sections: Any) -> Callable[[Data], object]:
    """Return a change of some sections: of fields of a single one, of all rows of a table."""

    def change(data: Data) -> None:
        for name, value in sections.items():
            data[name] = data[name] | value if isinstance(value, dict) else value

    return change


def _three_motions(data: Data) -> None:
    data["motions"] = data["motions"][:3]


def _polygon(data: Data) -> None:
    first = data["arrays"][0]
    x0, x1, y0, y1 = (first.pop(f"{axis}_{end}_m") for axis in "xy" for end in ("from", "to"))
    middle = ((x0 + x1) / 2.0, (y0 + y1) / 2.0)
    points = ((x0, y0), (x1, y0), (x1, middle[1]), middle, (middle[0], y1), (x0, y1))
    data["outlines"] = [{"name": first["id"], "x_m": x, "y_m": y} for x, y in points]


def _no_vertical(data: Data) -> None:
    for motion in data["motions"]:
        motion["vertical"] = None


def _revision(data: Data) -> None:
    data["project"]["revision"] = "1"
    data["revisions"].append({
        "revision": "1", "date": data["project"]["date"], "description": "Clearance", "by": "",
    })  # fmt: skip
    data["clearances"][0]["provided_m"] -= 0.3048
    data["arrays"][1]["mu"] = 0.42


def _thirty_arrays(data: Data) -> None:
    one = data["arrays"][0]
    wide, high = one["x_to_m"] - one["x_from_m"], one["y_to_m"] - one["y_from_m"]
    others = []
    for k in range(30):
        x, y = (k % 6) * (wide + 1.5), 200.0 + (k // 6) * (high + 1.5)
        place = {"x_from_m": x, "x_to_m": x + wide, "y_from_m": y, "y_to_m": y + high}
        others.append(one | place | {"id": f"B{k + 1}", "slope_value": 0.5 + 0.1 * (k % 4)})
    data["arrays"] = others
    data["objects"], data["links"], data["roof"] = [], [], {}
    data["clearances"] = [
        {"array": f"B{k}", "object": f"B{k + 1}", "direction": "any", "provided_m": 1.5}
        for k in range(1, 30)
        if k % 6
    ]
    data["motions"] = data["motions"][:3]


def _ng(data: Data) -> None:
    for row in data["clearances"][:2]:
        row["provided_m"] = 0.2


CASES: Mapping[str, tuple[str, Callable[[Data], object]]] = {
    "example": ("example", _having()),
    "school": ("school", _having()),
    "conditions": ("conditions", _having()),
    "SI": ("example", _having(project={"units_first": "SI"})),
    "7-22": ("example", _having(site={
        "rule_set": "ASCE 7-22", "edition_name": "ASCE 7-22", "f_a": None, "f_v": None,
        "s_ms_g": 2.349, "s_m1_g": 1.8,
    })),
    "three-motions": ("example", _three_motions),
    "polygon": ("example", _polygon),
    "no-vertical": ("example", _no_vertical),
    "links": ("example", _having(links=[
        {"array": "A2", "friction": "0.4, 0.45, 0.5, 0.55", "stiffness_n_per_m": 3.5e5},
    ])),
    "peer-review": ("example", _having(
        options={"peer_reviewed": True, "peer_reviewer": "Reviewer of record",
                 "peer_license": "CA S0000", "peer_date": "2025-11-20"},
        overrides=[{"provision": "parapet_height_in", "value": 18.0,
                    "reason": "Agreed with the city"}],
    )),
    "revision": ("example", _revision),
    "thirty-arrays": ("school", _thirty_arrays),
    "NG": ("example", _ng),
    "NG-school": ("school", _ng),
}  # fmt: skip
"""Project and change of each case; `revision` is compared with the results of `example`."""


def write_case(name: str, folder: Path) -> None:
    """Write the workbook and the records of a case."""
    project, change = CASES[name]
    source = ROOT / "projects" / project
    shutil.copytree(source / "records", folder / "records")
    shutil.copy(source / "input.xlsx", folder)
    sheet = read(folder / "input.xlsx")
    data = sheet.project.model_dump(mode="json")
    before = ProjectInput.model_validate(data)
    change(data)
    after = ProjectInput.model_validate(data)
    if after != before:
        write_template(folder / "input.xlsx", units=after.project.units_first, example=after)


def make(tree: Path, cases: Path, out: Path, names: list[str]) -> None:
    """Make the outputs of every case that are not there, by the commands of a tree."""
    for name, words in NEW.items():
        if not (out / name).is_dir():
            _run(tree, "-m", "report.cli", "new", str(out / name), *words)
    for name in ("example", "school"):
        if not (out / f"filled-{name}").is_dir():
            workbook = cases / name / "input.xlsx"
            _run(tree, "-c", FILLED, str(workbook), str(out / f"filled-{name}" / "input.xlsx"))
    for name in names:
        if (out / name / "calc-package.pdf").is_file():
            continue
        since = ["--since", str(cases / "since.json")] if name == "revision" else []
        words = ["report", str(cases / name), "--out", str(out / name), "--quiet", *since]
        _run(tree, "-m", "report.cli", *words)


def _run(tree: Path, *words: str) -> None:
    command = [sys.executable, *words]
    subprocess.run(command, cwd=tree, env=os.environ | {"PYTHONPATH": str(tree)}, check=True)


def said(folder: Path, *, words: bool) -> dict[str, list[str]]:
    """Return what the files of a case hold, as lines by file and part."""
    found = {}
    for path in sorted(folder.iterdir()):
        if path.suffix == ".pdf" and words:
            for count, page in enumerate(PdfReader(path).pages, start=1):
                lines = (page.extract_text() or "").splitlines()
                found[f"{path.name}, sheet {count}"] = [*lines, *_drawn(page)]
        elif path.suffix == ".xlsx":
            from openpyxl import load_workbook  # after report, which decides what it reads with

            for sheet in load_workbook(path).worksheets:
                cells = (_of_input if path.name == "input.xlsx" else _of_results)(sheet)
                found[f"{path.name}!{sheet.title}"] = list(cells)
        elif path.is_file() and path.suffix in (".json", ".dxf"):
            found[path.name] = path.read_text(encoding="utf-8").splitlines()
    return found


def _drawn(page: Any) -> Iterator[str]:
    """Yield a hash of what a page draws, and of each picture of it."""
    yield f"drawn {_hash(page.get_contents().get_data())}"
    for name, item in (page["/Resources"].get("/XObject") or {}).items():
        stream = item.get_object()
        if isinstance(stream, StreamObject):
            yield f"picture {name} {_hash(stream.get_data())}"


def _hash(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()[:16]


def _cells(sheet: Any) -> Iterator[str]:
    for row in sheet.iter_rows():
        for cell in row:
            if cell.value is not None:
                yield f"{cell.coordinate} [{cell.number_format}] {cell.value!r}"
    for rule in sheet.conditional_formatting:
        yield f"{rule.sqref} {[one.formula for one in rule.rules]}"
    for rule in sheet.data_validations.dataValidation:
        yield f"{rule.sqref} {rule.formula1} {rule.prompt}"


def _of_results(sheet: Any) -> Iterator[str]:
    """Yield the cells of a table of results, without D/C and verdicts in one word, said anew."""
    said_anew = {"Clearances": "L", "Requirements": "F", "Design": "S"}.get(sheet.title, "-")
    for line in _cells(sheet):
        if not line.startswith(said_anew):
            words = line.replace("OK with conditions", "Condition")
            yield words.replace("limit on motions for analysis", "motions for analysis")


def _of_input(sheet: Any) -> Iterator[str]:
    """Yield the cells of an input sheet, without what counts and marks: it follows `check` now."""
    sheet.conditional_formatting = type(sheet.conditional_formatting)()
    for line in _cells(sheet):
        is_count = any(f"[{code}]" in line for code in (STATUS_FORMAT, COUNT_FORMAT))
        is_legend = sheet.title == START and line.startswith("C")
        if not (is_count or is_legend or line.startswith("A3 ")):
            yield line


def differences(before: Path, after: Path, *, words: bool) -> Iterator[str]:
    """Yield what differs between the files of two folders."""
    one, other = said(before, words=words), said(after, words=words)
    for name in sorted(one.keys() | other.keys()):
        lines = difflib.unified_diff(
            one.get(name, []), other.get(name, []), "before", "after", lineterm="", n=0
        )
        told = list(lines)
        if told:
            more = [f"... {len(told) - LINES} more lines"] if len(told) > LINES else []
            yield "\n".join([f"{before.name}/{name}", *told[2:LINES], *more])


def tree_of(commit: str, folder: Path) -> Path:
    """Return the files of a commit, in a folder of their own."""
    if not folder.is_dir():
        part = folder.with_suffix(".part")
        part.mkdir(parents=True, exist_ok=True)
        words = ["git", "archive", commit]
        packed = subprocess.run(words, cwd=ROOT, capture_output=True, check=True).stdout
        subprocess.run(["tar", "-x", "-C", str(part)], input=packed, check=True)
        part.rename(folder)
    return folder


def main() -> None:
    """Compare this tree with a commit."""
    parser = argparse.ArgumentParser()
    parser.add_argument("commit")
    parser.add_argument("--cases", nargs="*", choices=CASES, default=list(CASES))
    parser.add_argument("--folder", type=Path, help="keeps what the commit makes")
    parser.add_argument("--words", action="store_true", help="also those of the PDF")
    given = parser.parse_args()
    short = ["git", "rev-parse", "--short=12", given.commit]
    commit = subprocess.run(short, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    kept = given.folder or Path(tempfile.gettempdir()) / "roofslip-unchanged"
    top = kept / commit.strip()
    cases = top / "cases"
    for name in CASES:
        if not (cases / name).is_dir():
            write_case(name, cases / name)
    before, after = top / "before", top / "after"
    shutil.rmtree(after, ignore_errors=True)
    tree = tree_of(commit.strip(), top / "tree")
    if not (cases / "since.json").is_file():
        make(tree, cases, before, ["example"])
        shutil.copy(before / "example" / "results.json", cases / "since.json")
    make(tree, cases, before, given.cases)
    make(ROOT, cases, after, given.cases)
    count = 0
    for name in (*NEW, "filled-example", "filled-school", *given.cases):
        for text in differences(before / name, after / name, words=given.words):
            count += 1
            print(text, flush=True)
    print(f"{len(given.cases)} cases: {count} parts differ")
    sys.exit(bool(count))


if __name__ == "__main__":
    main()
