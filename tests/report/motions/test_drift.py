"""Records that end away from where they began are not accepted until they are corrected."""

import shutil
from dataclasses import replace

import pytest

from fixtures import assessments, projects
from fixtures.paths import RECORDS
from fixtures.project_parts import motion
from fixtures.workbooks import make
from report.assessment.checks.motion_checks import MOST_DRIFT_M, MOST_END_MPS, drift_limits
from report.assessment.design.verdict import Verdict
from report.motions.prepare import prepare
from report.project.read.read import read


def ended(displacement_m, velocity_mps=0.0, basis=""):
    """Return an assessment of roofs for analysis alone; the second of three motions ends so."""
    book = projects.book(projects.steep(), assessments.motions())
    prepared = [replace(item, drift_basis="") for item in book.shaking.prepared]
    ends = {"final_displacement_m": 0.0, "final_velocity_mps": 0.0}
    for number, item in enumerate(prepared):
        if number == 1:
            ends = {"final_displacement_m": displacement_m, "final_velocity_mps": velocity_mps}
        measures = {name: replace(each, **ends) for name, each in item.measures.items()}
        prepared[number] = replace(item, measures=measures, drift_basis=basis)
        ends = dict.fromkeys(ends, 0.0)
    return projects.assessed(book.having(prepared=tuple(prepared)))


@pytest.mark.parametrize(
    ("displacement_m", "velocity_mps", "basis", "is_accepted", "verdict"),
    [
        (0.0, 0.0, "", True, Verdict.OK),
        (0.4, 0.0, "", True, Verdict.CONDITION),
        (-0.6, 0.0, "", False, Verdict.CONDITION),
        (-0.6, 0.0, "RG, SE, GNSS at the station", True, Verdict.CONDITION),
        (0.0, -0.11, "", False, Verdict.OK),
        (0.6, 0.11, "RG, SE, GNSS at the station", False, Verdict.CONDITION),
    ],
)
def test_a_record_that_ends_elsewhere_is_not_accepted_unless_the_displacement_is_stated(
    displacement_m, velocity_mps, basis, is_accepted, verdict
):
    done = ended(displacement_m, velocity_mps, basis)
    assert done.acceptance.qualifies is is_accepted
    (drift,) = (each for each in done.checks if (each.id, each.subject) == ("drift", "M2"))
    assert drift.verdict is verdict
    if not drift.is_satisfied:
        assert basis in drift.note
        assert ("Correct the baseline" in drift.remedy) is not bool(basis)
    refused = [
        row
        for row in done.checks
        if not row.is_satisfied
        and row.title.startswith(("Final displacement of each", "Final velocity"))
    ]
    assert bool(refused) is not is_accepted
    for row in refused:
        assert "Correct the baseline of M2 " in row.remedy
        assert (row.verdict, row.clause) == (Verdict.NG, "limit set by this program")
    assert all(item.is_permitted is is_accepted for item in done.arrays)


ROOF = "roof_575_market/SF575Market_LomaPrieta_g_45.csv"
UNCORRECTED = "renadic/llolleo1002271.v1"
NEAR_FAULT = "Chi_Chi_Taiwan_1999_TCU068-000.txt"


@pytest.mark.parametrize(
    ("record", "given", "is_accepted"),
    [
        (ROOF, {}, False),
        (ROOF, {"highpass_hz": 0.1}, True),
        (UNCORRECTED, {}, False),
        (UNCORRECTED, {"highpass_hz": 0.05}, True),
        (NEAR_FAULT, {"dt_s": 0.005}, False),
        (NEAR_FAULT, {"dt_s": 0.005, "drift_by": "RG, SE"}, False),
        (NEAR_FAULT, {"dt_s": 0.005, "drift_by": "RG, SE", "drift_source": "GNSS"}, True),
        (NEAR_FAULT, {"dt_s": 0.005, "baseline": "linear", "highpass_hz": 0.05}, True),
        ("at2/RIO270.AT2", {}, True),
        ("csmip_rio_dell_1992/Structure_CHAN4.V2", {}, True),
    ],
)
def test_real_records_of_roofs_and_faults_are_accepted_once_corrected(
    record, given, is_accepted, tmp_path
):
    if not RECORDS.is_dir():
        pytest.skip("the real records are not here")
    name = record.rpartition("/")[2].replace(".txt", ".csv")
    (tmp_path / "records").mkdir()
    shutil.copy(RECORDS / record, tmp_path / "records" / name)
    channel = " | 1" if name.endswith(".v1") else ""
    units = "g" if name.endswith(".csv") and "dt_s" in given else "from file"
    row = motion("M1", units=units, **given) | {"record": f"records/{name}{channel}"}
    prepared = prepare(read(make(tmp_path, motions=[row]))).prepared
    displacement, velocity = drift_limits(prepared)
    assert (displacement.limit, velocity.limit) == (MOST_DRIFT_M, MOST_END_MPS)
    assert (displacement.ok and velocity.ok) is is_accepted
