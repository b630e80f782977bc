"""The sections of the manual, in order. Read `front` first."""

from __future__ import annotations

from report.manual.blocks import ManualSection
from report.manual.building import building
from report.manual.front import scope, summary
from report.manual.machine import Machine
from report.manual.precision import work
from report.manual.robustness import conditioning, stability
from report.manual.rungs import rungs
from report.manual.studies import convergence, curves, links
from report.manual.tables import checks, methods, peers, software
from solver.verification.evidence import Verification


def sections(found: Verification, machine: Machine) -> tuple[ManualSection, ...]:
    """Return all sections but cover and contents."""
    return (
        summary(found),
        scope(found),
        checks(found),
        methods(),
        work(found),
        stability(found),
        convergence(found),
        links(found),
        curves(found),
        conditioning(found),
        building(found),
        *((rungs(found),) if found.rungs else ()),
        *((peers(found.peers),) if found.peers else ()),
        software(found, machine),
    )
