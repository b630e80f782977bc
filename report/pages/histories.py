"""Histories and paths in plan of the governing runs, by group of arrays."""

from __future__ import annotations

from collections.abc import Mapping

from report.assessment.support.evidence import Evidence
from report.pages.parts import PackageData
from report.text.names import named


def page(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return of each group: its names, whether any path leaves the slope, and those that do not."""
    groups = []
    for group, paths in zip(package.assessment.alike, evidence.histories, strict=True):
        # In one axis a path is a line along the slope: it is drawn, and the caption says why.
        straight = [
            run.motion.id
            for run, path in zip(group[0].motions, paths, strict=True)
            if not path.across_m.size and path.result.prd_m > 0.0
        ]
        is_drawn_across = any(path.across_m.size for path in paths)
        groups.append((named([item.id for item in group], "Array"), is_drawn_across, straight))
    return {"groups": groups}
