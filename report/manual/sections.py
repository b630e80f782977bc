"""The sections of the manual, in order. Read `summary` first."""

from __future__ import annotations

from collections.abc import Mapping

from report.document.sections import Section
from report.manual.building import building
from report.manual.features import features, known_errors
from report.manual.models import models
from report.manual.precision import work
from report.manual.robustness import conditioning, stability
from report.manual.section import section
from report.manual.shake_table import shake_table
from report.manual.studies import convergence, curves, links
from report.manual.summary import summary
from report.manual.tables import checks, methods, peers, software
from solver.verification.evidence import Verification

_SCOPE = section("scope", "Scope and terms")


def sections(verification: Verification, machine: Mapping[str, str]) -> tuple[Section, ...]:
    """Return all sections except cover and contents."""
    return (
        summary(verification),
        _SCOPE,
        checks(verification),
        methods(),
        work(verification),
        stability(verification),
        convergence(verification),
        links(verification),
        curves(verification),
        conditioning(verification),
        building(verification),
        *((models(verification),) if verification.models else ()),
        shake_table(verification),
        features(verification),
        known_errors(),
        *((peers(verification.peers),) if verification.peers else ()),
        software(machine),
    )
