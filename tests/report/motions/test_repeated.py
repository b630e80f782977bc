"""A motion that is given twice is refused, by the samples of its horizontal records."""

import numpy as np
import pytest

from nightly import by_day
from sheets import at, make, problems, read_workbook

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


def motion(x, y="", **others):
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
        [motion("a", "b"), motion("a", "b", scaling="factor", scale_value=2.0)],
        {"a": A[0], "b": A[1]}, AGAIN),
    **{f"a copy under another name, times {factor}": (
        [motion(name) for name in "abc"], {"a": A[0], "b": A[1], "c": factor * A[0]},
        AGAIN.replace("M2", "M3")) for factor in (1.0, -1.0, 0.37)},
    "swapped components": (
        [motion("a", "b"), motion("c", "d")], {"a": A[0], "b": A[1], "c": A[1], "d": A[0]},
        f"<Motions/M2/Horizontal record>: horizontal {TRANSVERSE}"),
    "one component in common": (
        [motion("a", "b"), motion("c", "b")], {"a": A[0], "b": A[1], "c": A[2]},
        f"<Motions/M2/Transverse record>: transverse {TRANSVERSE}"),
    "other filters": ([motion("a"), motion("a", highpass_hz=0.2)], {"a": A[0]}, AGAIN),
    "parts that overlap": (
        [motion("a", to_s=2.0), motion("a", from_s=1.9)], {"a": A[0]},
        "<Motions/M2/Horizontal record>: horizontal record repeats the horizontal record"),
}  # fmt: skip


@pytest.mark.parametrize("name", by_day(CASES, 3))
def test_a_motion_that_is_given_again_is_refused_with_both_cells(tmp_path, name):
    motions, records, line = CASES[name]
    (problem,) = problems(book(tmp_path, *motions, **records))
    assert problem.startswith(at(line))


@pytest.mark.quick
def test_parts_of_one_record_are_motions_if_they_do_not_overlap(tmp_path):
    first, second = motion("a", to_s=2.0), motion("a", from_s=2.0)
    assert len(read_workbook(book(tmp_path, first, second, a=A[0])).motions) == 2


def test_records_of_zeros_are_not_compared(tmp_path):
    zeros = np.zeros(400)
    path = book(tmp_path, motion("a", "z"), motion("b", "z"), a=A[0], b=A[1], z=zeros)
    assert len(read_workbook(path).motions) == 2


def test_the_vertical_may_be_in_common(tmp_path):
    motions = [motion(name, vertical="records/z.csv") for name in "ab"]
    assert len(read_workbook(book(tmp_path, *motions, a=A[0], b=A[1], z=A[2])).motions) == 2
