"""All combinations of a record, alone and of several at once."""

import numpy as np
import pytest

import solver
from fixtures.paths import ROOT
from solver.errors import InputError

FOLDER = ROOT / "projects" / "example" / "records"


@pytest.fixture(scope="module")
def records():
    return [solver.read_record(FOLDER / f"RM{n}-x.csv") for n in (1, 2, 3)]


def equal(a, b):
    return all(
        np.array_equal(getattr(a, name), getattr(b, name), equal_nan=True)
        for name in ("prd_m", "residual_m", "status")
    )


@pytest.mark.quick
@pytest.mark.parametrize("count", [1, 80], ids=["without threads", "on threads"])
def test_several_records_are_swept_as_each_alone(records, count):
    axes = {"slopes_rad": [0.0, 0.03], "mus": np.linspace(0.2, 0.6, count), "scales": [1.0, 1.4]}
    swept = solver.sweep_all(records, **axes)
    assert len(swept) == 3
    for record, together in zip(records, swept, strict=True):
        assert equal(together, solver.sweep(record, **axes))
    first = solver.slide(records[1], slope_rad=0.03, mu=0.2, scale=1.4)
    assert swept[1].prd_m[1, 0, 1] == first.prd_m


def test_motions_of_several_components_are_swept_with_their_scale(records):
    motion = solver.motion(records[0], ay_mps2=records[1], scale=1.2)
    axes = {"slopes_rad": [0.02], "mus": [0.4], "scales": [1.0, 0.9]}
    swept = solver.sweep_all([motion, records[2]], **axes)
    assert equal(swept[0], solver.sweep(motion, **axes))
    assert equal(swept[1], solver.sweep(records[2], **axes))


@pytest.mark.quick
def test_progress_goes_on_over_all_records_to_the_end(records):
    told = []
    axes = {"slopes_rad": [0.0, 0.03], "mus": [0.4], "scales": [1.0]}
    solver.sweep_all(records, **axes, progress=told.append)
    assert told == sorted(told)
    assert told[-1] == 1.0


@pytest.mark.quick
def test_faults_of_the_axes_and_of_records_are_named_together(records):
    with pytest.raises(InputError) as caught:
        solver.sweep_all([records[0], [1.0, 2.0]], slopes_rad=[2.0], mus=[0.4], scales=[1.0])
    assert "slopes_rad has 2.0" in str(caught.value)
    assert "record 2 is [1.0, 2.0]; use records or motions" in str(caught.value)
