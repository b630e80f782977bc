"""The part on clearances: what its template needs beside the clearances themselves."""

from __future__ import annotations

from collections.abc import Mapping

from report.assessment.evidence import Evidence
from report.assessment.friction import mus_words
from report.entities.evidence import NeighborResult
from report.pages.parts import PackageData
from report.pages.remedies import answers
from report.sheet.schema import ObjectKind


def clearances(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return the part on clearances, without its chart."""
    objects = {item.id: item for item in package.data.objects}
    arrays = {array.id: array for array in package.data.arrays}
    gaps = [
        (gap, objects[gap.clearance.object], arrays[gap.clearance.array])
        for gap in package.assessment.clearances
        if gap.clearance.object in objects
    ]
    beyond = [pair for pair in package.assessment.pairs if not pair.is_listed]
    return {
        "neighbors": list(map(NeighborResult.of, package.assessment.neighbors)),
        "n_beyond": len(beyond),
        "nearest": min(beyond, key=lambda pair: pair.gap_m, default=None),
        "friction": mus_words(package.data.arrays),
        "parapets": [
            gap
            for gap in gaps
            if gap[1].kind is ObjectKind.EDGE_WITH_PARAPET and gap[1].height_m is not None
        ],
        "is_least": any(gap.is_minimum_value for gap in package.assessment.clearances),
        "remedies": answers(package, evidence.remedies),
    }
