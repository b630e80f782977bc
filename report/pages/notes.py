"""The notes for the construction documents: the schedules, and items to measure first."""

from __future__ import annotations

import math
from collections.abc import Mapping

from report.assessment.design.verdict import Verdict
from report.pages.array_tables import schedule
from report.pages.clearance_tables import field_schedule, numbered_gaps
from report.pages.parts import PackageData, all_or, friction_report
from report.project.model.choices import DistanceBasis
from report.text.counts import counted
from report.text.grouping import ids_by
from report.text.letter_case import capitalized
from report.text.names import ranged
from report.text.units import number
from solver.rules.provisions import Neighbor


def page(package: PackageData) -> Mapping[str, object]:
    """Return the notes, the two schedules, and the gaps and parapets listed in them."""
    done, data, fmt = package.assessment, package.data, package.fmt
    gaps = numbered_gaps(done)
    # In the order of the clearances, each once.
    parapet_ids = dict.fromkeys(
        gap.check.clearance.object for gap in gaps if gap.check.neighbor is Neighbor.PARAPET
    )
    parapets = [item for item in data.objects if item.id in parapet_ids]
    racking = ids_by(data.arrays, lambda array: array.construction)
    return {
        "project": data.project,
        "fingerprint": package.fingerprint,
        "rules": done.rules.name,
        "s_ds": number(data.site.s_ds, 3),
        "sdc": data.site.sdc_text,
        "is_ng": done.verdict is Verdict.NG,
        "verdict": _verdict(package),
        "membrane": data.friction_tests.membrane or "by others",
        "support": data.friction_tests.support or "by others",
        "report": friction_report(data.friction_tests),
        "racking": "; ".join(
            f"{construction} ({all_or(racking[construction], len(data.arrays))})"
            for construction in sorted(racking)
        ),
        "has_gaps": bool(done.clearances),
        "links": [
            (item.design.id, fmt.both_up(item.stretch_m))
            for item in done.linked
            if not math.isnan(item.stretch_m)
        ],
        "parapets": ", ".join(
            f"{item.id} {fmt.both(item.height_m)}" for item in parapets if item.height_m is not None
        ),
        "parapet_ids": ", ".join(parapet_ids),
        "arrays": schedule(package),
        "has_motions": done.has_motions,
        "drawn": ranged(str(gap.number) for gap in gaps if gap.check.basis is DistanceBasis.DRAWN),
        "inspector": data.site.jurisdiction or "the building department",
        "gaps": field_schedule(package),
        "short": ranged(str(gap.number) for gap in gaps if gap.check.verdict is Verdict.NG),
        "missing": ", ".join(
            f"{pair.array} to {pair.other}" for pair in done.neighbors if pair.is_missing
        ),
    }


def _verdict(package: PackageData) -> str:
    """Return the meaning of the verdict for construction."""
    done, summary = package.assessment, package.part("summary")
    if done.verdict is Verdict.NG:
        return f"Not for construction: its verdict is NG ({summary})."
    n_open = sum(check.verdict is not Verdict.NG for check in done.open)
    if n_open:
        conditions = capitalized(counted(n_open, "open condition"))
        return f"{conditions} in {summary} shall be closed first."
    return f"Its verdict is {done.verdict.value}."
