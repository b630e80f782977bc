"""All computations of a verification, returned as plain data.

Draws nothing and writes no files. Read `verify`, then `evidence` for the result.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from itertools import chain, product

from solver.model import Motion
from solver.records.record import Record
from solver.verification import (
    building,
    building_checks,
    checks,
    conditioning,
    design_checks,
    model_checks,
    model_study,
    paper_studies,
    stability,
    workprecision,
)
from solver.verification.building import FloorRecords
from solver.verification.evidence import Verification, Verified
from solver.verification.study_cases import compared_runs
from solver.verification.verification_motions import own_records, own_triples


def verify(
    *,
    quick: bool,
    progress: Callable[[str], None],
    buildings: Sequence[FloorRecords] = (),
    motions: Sequence[Motion] = (),
) -> Verification:
    """Check the solver and measure every method on the project's records and on given ones.

    Parameters
    ----------
    quick : bool
        Use fewer records, scenes, settings and cells.
    progress : callable
        Called with a line for each stage.
    buildings : sequence of FloorRecords
        Recorded buildings, see `recorded_buildings`; the model building always runs.
    motions : sequence of Motion
        Recorded motions of three components, see `recorded_triples`, for the comparison of models;
        the project's motions always run. If quick, only the first is used.

    Returns
    -------
    Verification
        Identical on every call except for run times. A failed check is returned as failed;
        nothing is raised for it.
    """
    start = time.perf_counter()
    progress("Generating the project's records")
    records = own_records(quick)
    progress("Checks: closed forms, 50-digit arithmetic, physical checks of the paper")
    # A list, because the checks of the exact method and of its rivals both read it.
    roof = list(chain.from_iterable(map(checks.roof_blocks, records)))
    rows = list(_rows(records[0], roof))
    rivals = checks.rival_errors({checks.RANDOM: [*checks.random_blocks()], checks.ROOF: roof})
    rows += checks.claims(rivals)
    progress("Roof motion from ground motion: modes, model building, recorded buildings if given")
    made = building_checks.made_building(records[0])
    roofs = tuple(building.compare(floors) for floors in (made, *buildings))
    rows += building_checks.building_checks(made, roofs[0])
    progress("Two axes: checks, comparison of models, accuracy against run time")
    triples = (*own_triples(quick), *(motions[:1] if quick else motions))
    rows += model_checks.model_checks(triples, quick=quick)
    models = model_study.model_evidence(triples, quick=quick)
    runs = compared_runs(quick)
    progress(f"Accuracy against run time: every method in {len(runs)} runs")
    work = workprecision.work_points(runs, quick=quick)
    progress("Stability: maps of error over two parameters")
    maps = tuple(stability.maps(records[0], quick=quick))
    progress("Sensitivity to small changes of friction")
    sensitive = tuple(conditioning.conditioning(records[0], quick=quick))
    progress("The paper's convergence study (Fig. 5)")
    convergence = {record.name: paper_studies.convergence(record) for record in records}
    progress("The paper's comparison with a link model (Figs. 6 to 9)")
    links = tuple(
        paper_studies.link_comparison(record, slope_deg)
        for record, slope_deg in product(records, paper_studies.LINK_MUS)
    )
    progress("The paper's design curves (Figs. 10 to 12)")
    curves = tuple(paper_studies.design_curves(record) for record in records)
    return Verification(
        checks=tuple(row for row in rows if row.is_run),
        left_out=tuple(row for row in rows if not row.is_run),
        rivals=rivals,
        work=work,
        maps=maps,
        convergence=convergence,
        links=links,
        curves=curves,
        conditioning=sensitive,
        roofs=roofs,
        models=(models,),
        records=tuple(record.name for record in records),
        quick=quick,
        seconds=time.perf_counter() - start,
    )


def _rows(record: Record, roof: Sequence[checks.KnownBlock]) -> Iterator[Verified]:
    yield from checks.closed_forms()
    yield from checks.physical_checks(record)
    yield from checks.fifty_digits(roof)
    yield from design_checks.design_checks()
