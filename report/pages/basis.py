"""The basis and the limits of the method: provisions, exclusions and validation."""

from __future__ import annotations

from collections.abc import Mapping

from report.assessment.design.routes import Route
from report.assessment.support.analysis_saving import saving
from report.pages.parts import PackageData
from report.pages.saving import saving_words
from report.text.letter_case import capitalized
from report.text.names import ranged
from report.text.validation import VALIDATION


def page(package: PackageData) -> Mapping[str, object]:
    """Return the contents of the page, depending on whether there are motions."""
    done, data = package.assessment, package.data
    motions = [run.motion for run in done.governing.motions]
    turned = []
    if any(motion.has_transverse for motion in motions):
        turned.append("other orientations of the horizontal pair")
    if any(motion.has_vertical for motion in motions):
        turned.append("a reversed vertical component")
    return {
        "rules": done.rules.name,
        "under_code": done.otherwise.get("rule_set", ""),
        "has_motions": done.has_motions,
        "saving": ""
        if done.has_motions
        else saving_words(saving(done), package.marks, package.fmt),
        "turned": capitalized(" and ".join(turned)),
        "linked": ranged(linked.design.id for linked in done.linked) if done.linked else "",
        "has_smaller_events": bool(data.options.smaller_factors and done.has_motions),
        "validation": VALIDATION,
        "has_analysis": any(item.route is Route.ANALYSIS for item in done.arrays),
        "is_peer_reviewed": data.is_peer_reviewed,
        "is_review_stated": bool(data.options.peer_reviewed),
    }
