"""Page headers and footers, summary, and basis of the analysis."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from report.assessment.friction import mu_words
from report.assessment.friction_rows import basis_words, tested
from report.assessment.remedies import Remedy
from report.assessment.spectra import Spectra, departures
from report.assessment.uncertainty import Uncertainty
from report.document.templates import sentence
from report.pages.limits import troubles
from report.pages.parts import PackageData, shortened, statistic
from report.pages.remedies import answers
from report.pages.review import review
from report.sheet.schema import RecordedAt
from report.typeset.pdf import TEMPLATES
from report.words.validation import explained
from solver.verification.shake_table import SHIPPED


def sheet(package: PackageData) -> Mapping[str, str]:
    """Return the texts of the page headers and footers."""
    project = package.data.project
    return {
        "title": f"{project.number} {project.name}: seismic displacement of rooftop solar arrays",
        "author": project.prepared_by,
        "created": project.date.isoformat(),
        "name": shortened(project.name, 60),
        "number": shortened(project.number, 24),
        "date": project.date.isoformat(),
        "by": shortened(project.prepared_by, 22),
        "checked": shortened(project.checked_by, 22) or "—",
        "revision": shortened(project.revision, 8),
        "edition": package.assessment.rules.name,
        "hash": package.fingerprint,
    }


def summary(
    package: PackageData, remedies: Sequence[Remedy], spectra: Sequence[Spectra]
) -> Mapping[str, object]:
    """Return what the summary page needs beside the package."""
    found = departures(spectra)
    last = {departure.is_short: departure for departure in found}.values()
    return {
        "statistic": statistic(package.governing.analysis.basis),
        "review": review(package),
        "departure": shortened(package.data.options.directional_reason, 80),
        # What follows from a missed target is said once, with the last.
        "missed": [(departure, departure in last) for departure in found],
        "troubles": troubles(package),
        "answers": answers(package, remedies),
    }


def plan(package: PackageData) -> Mapping[str, object]:
    """Return how the page of the roof plan lies."""
    from report.figures.plan import is_wide  # loads the plotting library

    return {"page": "landscape" if is_wide(package.assessment) else "portrait"}


def verdict_sentence(package: PackageData) -> str:
    """Return what the verdict on the project rests on."""
    return sentence(TEMPLATES, "verdict", package)


def basis(package: PackageData, uncertainty: Uncertainty) -> Mapping[str, object]:
    """Return what the page on basis and limits needs beside the package."""
    return {
        "motions": [run.motion for run in package.governing.motions],
        "is_ground": any(row.recorded_at is RecordedAt.GROUND for row in package.data.motions),
        "friction": [
            (array.id, mu_words(array.friction), basis_words(package.data, array))
            for array in package.data.arrays
            if not array.friction.is_constant
        ],
        "is_tested": bool(tested(package.data)),
        "certainty": uncertainty,
        "failed": troubles(package),
        "validation": explained(SHIPPED),
    }
