"""Claim: one axis is exact to rounding error, and two axes keep to their tolerance.

One axis against 40-digit arithmetic, over the records of the example with and without their
vertical component and 18 real ones; two axes against SciPy's DOP853 restarted at every sample and
event, over the strong part of three-component motions: those of --records, else of the example.
Errors of every place that is reported, relative to the PRD.
"""

import itertools
import math
import statistics
from dataclasses import replace

import numpy as np
from measure import RECORDS, SMOKE, figure, made_records

import oracle
import plane_oracle
from peers import real_records
from solver.formats import read_record
from solver.model import STANDARD_GRAVITY_MPS2 as G
from solver.model import Floats, coulomb
from solver.records.record import NO_RECORD
from solver.sliding.checked import slide
from solver.sliding.two_axes import follow
from solver.sliding.uplift import uplift
from solver.verification.study_cases import Case, scene_of
from solver.verification.verification_motions import cut, own_triples, recorded_triples

# Slope [deg], friction coefficient, PPA [g].
SCENES = ((0.0, 0.1, 1.0), (4.0, 0.3, 1.5), (-7.0, 0.5, 2.0), (2.0, 0.45, 1.5))
PLANE = ((0.0, 0.2, 0.6), (0.0, 0.4, 1.0), (4.0, 0.3, 0.8), (7.0, 0.5, 1.2), (2.0, 0.8, 1.6))
TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10)
STRONG_S = 0.5 if SMOKE else 3.0


Motions = list[tuple[Floats, Floats | None, float]]


def made() -> Motions:
    """Return the motions of the example without and with their vertical component."""
    found: Motions = []
    for path in made_records():
        x, z = (read_record(path.with_name(path.name.replace("-x", s))) for s in ("-x", "-z"))
        found += [(x.a_mps2, None, x.dt_s), (x.a_mps2, z.a_mps2, x.dt_s)]
    return found


def one_axis(kind: str, records: Motions) -> None:
    """Print the largest and the median error over records and scenes."""
    errors = []
    cases = itertools.product(records[:1] if SMOKE else records, SCENES)
    for (ax, az, dt), (degrees, mu, ppa) in cases:
        scene = {"slope_rad": math.radians(degrees), "mu": mu}
        scale = ppa * G / float(np.abs(ax).max())
        result = slide(ax, dt, az_mps2=az, scale=scale, units="m/s2", **scene)
        exact = oracle.slide(ax, dt, az=az, scale=scale, **scene)
        if math.isnan(result.prd_m) or not exact.prd:
            continue
        off = max(abs(result.prd_m - exact.prd), abs(result.residual_m - exact.residual))
        errors.append(float(off / exact.prd))
    figure(f"runs of {kind} records in one axis", len(errors))
    figure(f"largest error over {kind} records, relative to the PRD", max(errors))
    figure(f"median error over {kind} records, relative to the PRD", statistics.median(errors))


def two_axes() -> None:
    """Print, for each tolerance, the largest error and the largest bound."""
    given = recorded_triples(RECORDS) if RECORDS else own_triples(quick=SMOKE)
    errors, bounds = (dict[float, list[float]]() for _ in range(2))
    motions, cases = given[:2], PLANE[: 1 if SMOKE else None]
    for triple, (slope_deg, mu, ppa_g) in itertools.product(motions, cases):
        part = cut(triple, 1 + round(STRONG_S / triple.dt_s))
        scene = scene_of(part, Case(slope_deg, mu, ppa_g), coulomb(mu))
        if uplift(scene).lifts:
            scene = replace(scene, az_mps2=NO_RECORD)
        exact = plane_oracle.follow(scene)
        for tolerance in TOLERANCES if exact.prd > 0.0 else ():
            outcome = follow(scene, tolerance)
            off = float(np.abs(np.subtract(outcome.places, exact.places)).max())
            errors.setdefault(tolerance, []).append(off / exact.prd)
            bounds.setdefault(tolerance, []).append(outcome.error_m / exact.prd)
    kind = "recorded" if RECORDS else "generated"
    figure("runs in two axes", len(errors[TOLERANCES[0]]), f"of {kind} motions")
    for tolerance in TOLERANCES:
        figure(f"largest error in two axes to {tolerance:.0e}", max(errors[tolerance]))
        figure(f"largest reported bound in two axes to {tolerance:.0e}", max(bounds[tolerance]))


if __name__ == "__main__":
    one_axis("generated", made())
    one_axis("real", [(record.a_mps2, None, record.dt_s) for record in real_records()])
    two_axes()
