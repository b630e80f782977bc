"""Records are bounded together before they are read."""

import pytest

from report.motions import prepare as module
from sheets import make, problems, read_workbook, said

RECORDS = ("x", "z", "x2", "x3")


@pytest.fixture
def path(tmp_path):
    """Three motions; the first has two records of 200 samples, each of 1.8 to 2 kB."""
    return make(tmp_path)


def test_records_of_too_many_bytes_together_are_refused_by_cell(path, monkeypatch):
    sizes = [(path.parent / "records" / f"{name}.csv").stat().st_size for name in RECORDS]
    together = sum(sizes)
    monkeypatch.setattr(module, "MAX_TOGETHER", together)
    assert len(read_workbook(path).motions) == 3
    monkeypatch.setattr(module, "MAX_TOGETHER", together - 1)
    assert problems(path) == said(
        "<Motions/M3/Horizontal record>: the records to here have more than 64 MB together; give "
        "fewer motions, or convert the records (roofslip motion convert)"
    )


def test_once_a_record_is_at_fault_the_others_are_read_within_a_bound(path, monkeypatch):
    for name in RECORDS:
        (path.parent / "records" / f"{name}.csv").write_text("0.1\nabc\n0.2\n")
    assert len(problems(path)) == 4
    monkeypatch.setattr(module, "MAX_BESIDE_FAULTS", 0)
    assert tuple(line.split(":")[0] for line in problems(path)) == said(
        "Motions/M1/Horizontal record", "Motions/M1/Vertical record"
    )
