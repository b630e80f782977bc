"""Records are bounded together before they are read; a motion that is given twice is refused."""

import numpy as np
import pytest

from inputs import motion
from nightly import by_day
from report.motions.prepare import MAX_BESIDE_FAULTS, MAX_TOGETHER, MOST_FAULTS
from sheets import at, make, problems, read_workbook

pytestmark = pytest.mark.quick

NO_TEXT = "not a text file; give the text of a record"
TOO_MUCH = (
    "the records to here have more than 64 MB together; give fewer motions, or convert the records"
    " (roofslip motion convert --help)"
)


NOT_READ = "the records from here on are not read; correct those before it first"


def grown(path, together, names):
    """What is reported once the last of these records, made no record, has them reach a size."""
    *before, last = (path.parent / "records" / f"{name}.csv" for name in names)
    with last.open("wb") as file:
        file.truncate(together - sum(other.stat().st_size for other in before))
    return problems(path)


def test_records_of_too_many_bytes_together_are_refused_by_cell(tmp_path):
    path, names = make(tmp_path), ("x", "z", "x2", "x3")
    last = at("<Motions/M3/Horizontal record>: ")
    read = (f"{last}horizontal record: x3.csv: {NO_TEXT}",)
    assert grown(path, MAX_TOGETHER, names) == read
    assert grown(path, MAX_TOGETHER + 1, names) == (last + TOO_MUCH,)


def test_once_a_record_is_at_fault_the_others_are_read_within_a_bound(tmp_path):
    path, names = make(tmp_path), ("x", "z", "x2")
    (path.parent / "records" / "x.csv").write_text("0.1\nabc\n0.2\n")
    wrong = at(
        "<Motions/M1/Horizontal record>: horizontal record: x.csv:2: found 'abc'; give a number"
    )
    read = at(f"<Motions/M2/Horizontal record>: horizontal record: x2.csv: {NO_TEXT}")
    second, third = (at(f"<Motions/M{k}/Horizontal record>: ") + NOT_READ for k in (2, 3))
    assert grown(path, MAX_BESIDE_FAULTS, names) == (wrong, read, third)
    assert grown(path, MAX_BESIDE_FAULTS + 1, names) == (wrong, second)


@pytest.mark.nightly
def test_of_many_motions_whose_records_are_missing_the_first_hundred_are_told(tmp_path):
    lost = [motion(f"M{k}", f"lost{k}") for k in range(2 * MOST_FAULTS)]
    *told, last = problems(make(tmp_path, motions=lost))
    assert len(told) == MOST_FAULTS + 1
    assert f"'records/lost{MOST_FAULTS}.csv' does not exist" in told[-1]
    assert last == f"Motions!C{8 + len(told)}: {NOT_READ}"


A = np.random.default_rng(7).normal(size=(4, 400)).round(5)


def book(folder, *motions, **records):
    """A workbook of motions, and of records in g at 0.01 s."""
    rows = [
        {"id": f"M{i}", "units": "g", "dt_s": 0.01, **motion}
        for i, motion in enumerate(motions, start=1)
    ]
    path = make(folder, motions=rows)
    for name, samples in records.items():
        text = "".join(f"{sample:.5f}\n" for sample in samples)
        (folder / "records" / f"{name}.csv").write_text(text)
    return path


def taking(x, y="", **others):
    transverse = {"transverse": f"records/{y}.csv"} if y else {}
    return {"record": f"records/{x}.csv", **transverse, **others}


AGAIN = (
    "<Motions/M2/Horizontal record>: horizontal record repeats the horizontal record at"
    " <Motions/M1/Horizontal record> (equal samples, apart from scale and sign): M2 is M1 again;"
    " give each motion once"
)
TRANSVERSE = "record repeats the transverse record at <Motions/M1/Transverse record>"
CASES = {
    "the same file": (
        [taking("a", "b"), taking("a", "b", scaling="factor", scale_value=2.0)],
        {"a": A[0], "b": A[1]}, AGAIN),
    **{f"a copy under another name, times {factor}": (
        [taking(name) for name in "abc"], {"a": A[0], "b": A[1], "c": factor * A[0]},
        AGAIN.replace("M2", "M3")) for factor in (1.0, -1.0, 0.37)},
    "swapped components": (
        [taking("a", "b"), taking("c", "d")], {"a": A[0], "b": A[1], "c": A[1], "d": A[0]},
        f"<Motions/M2/Horizontal record>: horizontal {TRANSVERSE}"),
    "one component in common": (
        [taking("a", "b"), taking("c", "b")], {"a": A[0], "b": A[1], "c": A[2]},
        f"<Motions/M2/Transverse record>: transverse {TRANSVERSE}"),
    "other filters": ([taking("a"), taking("a", highpass_hz=0.2)], {"a": A[0]}, AGAIN),
    "parts that overlap": (
        [taking("a", to_s=2.0), taking("a", from_s=1.9)], {"a": A[0]},
        "<Motions/M2/Horizontal record>: horizontal record repeats the horizontal record"),
}  # fmt: skip


@pytest.mark.parametrize("name", by_day(CASES, 3))
def test_a_motion_that_is_given_again_is_refused_with_both_cells(tmp_path, name):
    motions, records, line = CASES[name]
    (problem,) = problems(book(tmp_path, *motions, **records))
    assert problem.startswith(at(line))


@pytest.mark.quick
def test_parts_of_one_record_are_motions_if_they_do_not_overlap(tmp_path):
    first, second = taking("a", to_s=2.0), taking("a", from_s=2.0)
    assert len(read_workbook(book(tmp_path, first, second, a=A[0])).motions) == 2


def test_zeros_and_a_vertical_in_common_are_not_compared(tmp_path):
    zeros = np.zeros(400)
    path = book(tmp_path, taking("a", "z"), taking("b", "z"), a=A[0], b=A[1], z=zeros)
    assert len(read_workbook(path).motions) == 2
    motions = [taking(name, vertical="records/z.csv") for name in "ab"]
    assert len(read_workbook(book(tmp_path, *motions, a=A[0], b=A[1], z=A[2])).motions) == 2
