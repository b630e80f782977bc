"""What the dearest inputs cost that `roofslip check` does not refuse by a limit, or until it does.

Run from the top: PYTHONPATH=.:tests .venv/bin/python tests/bench/check_limits.py [NAME ...]
Each input fills one limit of report/sheet or of the records. Prints processor time, peak memory,
exit code and the first words of the answer; an input beyond 10 s or 1 GB is marked.
"""

from __future__ import annotations

import math
import multiprocessing
import os
import random
import subprocess
import sys
import tempfile
import time
import zipfile
from collections.abc import Callable, Iterable
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from sheets import make, project

MOST_S, MOST_MB = 10.0, 1000.0
NS = 'xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"'


def rewritten(path: Path, changes: dict[str, Callable[[bytes], bytes]]) -> Path:
    """Change parts of a workbook; one that is not there is empty before."""
    with zipfile.ZipFile(path) as archive:
        parts = {name: archive.read(name) for name in archive.namelist()}
    for name, change in changes.items():
        parts[name] = change(parts.get(name, b""))
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in parts.items():
            archive.writestr(name, content)
    return path


def last_sheet(path: Path) -> str:
    """Return the part of the sheet that holds nothing but explanations."""
    from report.sheet.archive import sheet_parts

    with zipfile.ZipFile(path) as archive:
        return dict(sheet_parts(archive))["Options"]


def with_rows(folder: Path, rows: Iterable[str]) -> Path:
    """Add rows far below the fields of a sheet."""
    path = make(folder)
    added = "".join(rows).encode()
    return rewritten(
        path, {last_sheet(path): lambda old: old.replace(b"</sheetData>", added + b"</sheetData>")}
    )


def after_data(folder: Path, xml: str) -> Path:
    """Add elements behind the cells of a sheet."""
    path = make(folder)
    added = b"</sheetData>" + xml.encode()
    return rewritten(path, {last_sheet(path): lambda old: old.replace(b"</sheetData>", added, 1)})


def cells(n: int, inner: Callable[[int], str], attributes: str = "") -> Iterable[str]:
    """Yield rows of 50 cells each, with addresses."""
    letters = [chr(65 + k // 26 - 1) * (k >= 26) + chr(65 + k % 26) for k in range(50)]
    for row in range(n // 51):
        number = 1000 + row
        inside = "".join(
            f'<c r="{letter}{number}"{attributes}>{inner(50 * row + k)}</c>'
            for k, letter in enumerate(letters)
        )
        yield f'<row r="{number}">{inside}</row>'


def numbers(folder: Path) -> Path:
    """Fill the number of cells with numbers that differ."""
    return with_rows(folder, cells(290_000, lambda k: f"<v>{k * 1.37}</v>"))


def texts(folder: Path) -> Path:
    """Fill the number of cells with texts of 100 characters."""
    rng = random.Random(1)
    return with_rows(
        folder,
        cells(290_000, lambda k: f"<is><t>{rng.getrandbits(400):0100x}</t></is>", ' t="inlineStr"'),
    )


def shared_formulas(folder: Path) -> Path:
    """Fill the number of cells with one shared formula."""
    first = '<f t="shared" ref="A1000:AX9000" si="0">SUM(B1:C9)+D4*E5-F6/$G$7</f><v>1</v>'
    return with_rows(
        folder, cells(290_000, lambda k: '<f t="shared" si="0"/><v>1</v>' if k else first)
    )


def long_formula(folder: Path) -> Path:
    """Write a shared formula of 40 MB and use it again."""
    rng = random.Random(1)
    text = "+".join(f"A{rng.randrange(10**6)}" for _ in range(5_000_000))
    rows = [
        f'<row r="1000"><c r="A1000"><f t="shared" ref="A1000:A1100" si="0">{text}</f></c></row>'
    ]
    rows += [
        f'<row r="{n}"><c r="A{n}"><f t="shared" si="0"/></c></row>' for n in range(1001, 1100)
    ]
    return with_rows(folder, rows)


def sparse_rows(folder: Path) -> Path:
    """Place one cell in each row, down to the last row of a sheet."""
    return with_rows(
        folder,
        (f'<row r="{n}"><c r="XFD{n}"><v>1</v></c></row>' for n in range(900_000, 1_045_000)),
    )


def comments(folder: Path) -> Path:
    """Fill the number of other elements with comments."""
    path = make(folder)
    sheet = last_sheet(path)
    said = "".join(
        f'<comment ref="A{n}" authorId="0"><text><t>{"x" * 300}{n}</t></text></comment>'
        for n in range(1, 48_000)
    )
    part = f"<comments {NS}><authors><author>a</author></authors><commentList>{said}"
    relation = (
        '<Relationship Id="rIdC" Target="/xl/comments9.xml" Type="http://schemas.openxmlformats.org'
        '/officeDocument/2006/relationships/comments"/>'
    )
    relations = sheet.replace("worksheets/", "worksheets/_rels/") + ".rels"
    head = b'<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
    kind = (
        '<Override PartName="/xl/comments9.xml" ContentType="application/vnd.openxmlformats-'
        'officedocument.spreadsheetml.comments+xml"/>'
    )
    return rewritten(
        path,
        {
            "xl/comments9.xml": lambda _: f"{part}</commentList></comments>".encode(),
            relations: lambda old: (old or head + b"</Relationships>").replace(
                b"</Relationships>", relation.encode() + b"</Relationships>"
            ),
            "[Content_Types].xml": lambda old: old.replace(
                b"</Types>", kind.encode() + b"</Types>"
            ),
        },
    )


def merges(folder: Path) -> Path:
    """Fill the number of merged cells."""
    ranges = "".join(f'<mergeCell ref="A{n}:B{n}"/>' for n in range(2000, 50_000))
    return after_data(folder, f"<mergeCells>{ranges}</mergeCells>")


def validations(folder: Path) -> Path:
    """Fill the number of other elements with data validations of many ranges."""
    areas = " ".join(f"A{n}:B{n}" for n in range(1, 400))
    one = f'<dataValidation type="list" sqref="{areas}"><formula1>"a,b"</formula1></dataValidation>'
    return after_data(folder, f"<dataValidations>{one * 5000}</dataValidations>")


def conditional_formats(folder: Path) -> Path:
    """Fill the number of other elements with conditional formats."""
    rules = "".join(
        f'<conditionalFormatting sqref="A{n}:C{n}"><cfRule type="expression" priority="{n}">'
        f"<formula>A{n}&gt;1</formula></cfRule></conditionalFormatting>"
        for n in range(1, 32_000)
    )
    return after_data(folder, rules)


def styles(folder: Path) -> Path:
    """Fill the number of other elements with cell formats."""
    rng = random.Random(1)
    formats = "".join(
        f'<xf numFmtId="{rng.randrange(40)}" fontId="0" fillId="0" borderId="0" xfId="0"/>'
        for _ in range(90_000)
    ).encode()
    return rewritten(
        make(folder),
        {"xl/styles.xml": lambda old: old.replace(b"</cellXfs>", formats + b"</cellXfs>")},
    )


def names(folder: Path) -> Path:
    """Fill the number of other elements with defined names."""
    said = "".join(
        f'<definedName name="n{n}">Options!$A${n}</definedName>' for n in range(1, 90_000)
    )
    return rewritten(
        make(folder),
        {
            "xl/workbook.xml": lambda old: old.replace(
                b"</definedNames>", said.encode() + b"</definedNames>"
            )
        },
    )


def strings(folder: Path) -> Path:
    """Fill a part with one shared text after the other."""
    rng = random.Random(1)
    said = "".join(f"<si><t>{rng.getrandbits(160):040x}</t></si>" for _ in range(600_000)).encode()
    whole = f"<sst {NS}>".encode() + said + b"</sst>"
    return rewritten(make(folder), {"xl/sharedStrings.xml": lambda _: whole})


def long_string(folder: Path) -> Path:
    """Fill a part with one text."""
    said = b"<si><t>" + random.Random(1).randbytes(22_000_000).hex().encode() + b"</t></si>"
    whole = f"<sst {NS}>".encode() + said + b"</sst>"
    return rewritten(make(folder), {"xl/sharedStrings.xml": lambda _: whole})


def tags_of_shapes(folder: Path) -> Path:
    """Fill the number of tags in a part that is not counted otherwise."""
    rng = random.Random(1)
    said = b"".join(b"<a x='%d'/>" % rng.randrange(10**9) for _ in range(2_200_000))
    return rewritten(make(folder), {"xl/drawings/drawing99.xml": lambda _: b"<w>" + said + b"</w>"})


def deep(folder: Path) -> Path:
    """Nest elements as deep as their number allows."""
    depth = 90_000
    return after_data(folder, "<x>" * depth + "</x>" * depth)


def many_arrays(folder: Path) -> Path:
    """Give as many arrays and objects as a table takes, each with an outline of one cell."""
    given = project().model_dump()
    arrays, objects = [], []
    for k in range(1990):
        x, y = 20.0 * (k % 50), 20.0 * (k // 50)
        sides = {"x_from_m": x, "x_to_m": x + 10.0, "y_from_m": y, "y_to_m": y + 10.0}
        arrays.append(given["arrays"][0] | sides | {"id": f"A{k}"})
        objects.append(
            given["objects"][0]
            | {"id": f"O{k}"}
            | sides
            | {"x_from_m": x + 12.0, "x_to_m": x + 14.0}
        )
    return make(folder, arrays=arrays, objects=objects, clearances=[])


def outlines(folder: Path) -> Path:
    """Give arrays with outlines of as many vertices as the table takes."""
    given = project().model_dump()
    arrays, vertices = [], []
    sides = dict.fromkeys(("x_from_m", "x_to_m", "y_from_m", "y_to_m"))
    for k in range(10):
        arrays.append(given["arrays"][0] | sides | {"id": f"A{k}"})
        turns = [t / 199 * math.tau for t in range(199)]
        vertices += [
            {"name": f"A{k}", "x_m": 100.0 * k + 40 * math.cos(t), "y_m": 40 * math.sin(t)}
            for t in turns
        ]
    return make(folder, arrays=arrays, objects=[], clearances=[], outlines=vertices)


def motions(folder: Path, rows: int, lines: int, last: str = "") -> Path:
    """Name a record of its own in each row of motions."""
    given = project().model_dump()
    rng = random.Random(1)
    (folder / "records").mkdir(parents=True)
    for k in range(rows):
        text = "".join(f"{rng.gauss(0.0, 0.2):.6f}\n" for _ in range(lines))
        (folder / "records" / f"m{k}.csv").write_text(text + last)
    one = given["motions"][0] | {"vertical": None, "dt_s": 0.005}
    rows_given = [one | {"id": f"M{k}", "record": f"records/m{k}.csv"} for k in range(rows)]
    return make(folder, motions=rows_given)


def long_record(folder: Path) -> Path:
    """Give a record of as many samples as are taken."""
    return motions(folder, 3, 199_000)


def many_records(folder: Path) -> Path:
    """Give fifty records of four minutes each."""
    return motions(folder, 50, 48_000)


def as_many_records_as_rows(folder: Path) -> Path:
    """Give as many records of two minutes as a table takes."""
    return motions(folder, 1990, 12_000)


def fault_in_the_last_line(folder: Path) -> Path:
    """Give a record of a million lines with a fault in the last."""
    return motions(folder, 1, 999_998, "abc\n")


def wide_record(folder: Path) -> Path:
    """Give a record of 60 MB in columns."""
    path = make(folder)
    rng = random.Random(1)
    lines = ["".join(f"{rng.gauss(0, 0.2):.5f}," for _ in range(100)) + "0" for _ in range(1000)]
    (folder / "records" / "x.csv").write_text("\n".join(lines * 65))
    return path


CASES = (
    numbers, texts, shared_formulas, long_formula, sparse_rows, comments, merges, validations,
    conditional_formats, styles, names, strings, long_string, tags_of_shapes, deep, many_arrays,
    outlines, long_record, many_records, as_many_records_as_rows, fault_in_the_last_line,
    wide_record,
)  # fmt: skip


def measured(path: Path) -> tuple[float, float, int, str]:
    """Check a workbook in a process; return processor time [s], peak memory [MB], exit, answer."""
    with tempfile.TemporaryFile("w+") as said:
        child = subprocess.Popen(
            [sys.executable, "-m", "report.cli", "check", str(path)], stdout=said, stderr=said
        )
        _, status, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        said.seek(0)
        lines = said.read().splitlines()
    answer = " ".join(line.replace(str(path), "").strip() for line in lines[:2])
    return used.ru_utime + used.ru_stime, used.ru_maxrss / 1000.0, child.returncode, answer


def main() -> None:
    """Print one line for each case."""
    for case in CASES:
        if sys.argv[1:] and case.__name__ not in sys.argv[1:]:
            continue
        with tempfile.TemporaryDirectory() as name:
            started = time.monotonic()
            # In a process of its own: a child counts the memory of the process that started it.
            maker = multiprocessing.Process(target=case, args=(Path(name) / "job",))
            maker.start()
            maker.join()
            made_s = time.monotonic() - started
            seconds, megabytes, code, answer = measured(Path(name) / "job" / "input.xlsx")
        over = "OVER" if seconds > MOST_S or megabytes > MOST_MB else ""
        print(
            f"{case.__name__:24} {seconds:6.1f} s {megabytes:6.0f} MB  exit {code} {over:4} "
            f"{answer[:110]}  (made in {made_s:.0f} s)",
            flush=True,
        )


if __name__ == "__main__":
    main()
