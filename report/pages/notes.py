"""The notes for the construction documents: the schedules, and what must be measured first."""

from __future__ import annotations

from collections.abc import Mapping

from report.assessment.design.verdict import Verdict
from report.pages.array_tables import schedule
from report.pages.clearance_tables import field_schedule, numbered_gaps
from report.pages.parts import PackageData
from report.project.model.choices import DistanceBasis
from solver.rules.provisions import Neighbor


def page(package: PackageData) -> Mapping[str, object]:
    """Return the schedules, and the parapets and gaps that the notes name."""
    gaps = numbered_gaps(package.assessment)
    # In the order of the clearances, each once.
    parapets = dict.fromkeys(
        gap.check.clearance.object for gap in gaps if gap.check.neighbor is Neighbor.PARAPET
    )
    return {
        "arrays": schedule(package),
        "gaps": field_schedule(package),
        "parapet_ids": list(parapets),
        "parapets": [item for item in package.data.objects if item.id in parapets],
        "drawn": [str(gap.number) for gap in gaps if gap.check.basis is DistanceBasis.DRAWN],
        "short": [str(gap.number) for gap in gaps if gap.check.verdict is Verdict.NG],
        "missing": [pair for pair in package.assessment.neighbors if pair.is_missing],
    }
