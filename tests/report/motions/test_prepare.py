"""Records are bounded together before they are read."""

import pytest

from inputs import motion
from report.motions.prepare import MAX_BESIDE_FAULTS, MAX_TOGETHER, MOST_FAULTS
from sheets import at, make, problems

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
