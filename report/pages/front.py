"""Page headers and footers, summary, and basis of the analysis."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from markupsafe import Markup

from report.assessment.arrays import Route
from report.assessment.certainty import Certainty
from report.assessment.friction import mu_words
from report.assessment.friction_rows import basis_words, tested
from report.assessment.remedies import Remedy
from report.assessment.spectra import Spectra, departures
from report.document.tables import stamp
from report.document.templates import sentence
from report.pages.limits import conditions, troubles
from report.pages.motions import departure_place, departure_sentence
from report.pages.parts import PackageData, shortened, statistic
from report.pages.remedies import answers
from report.pages.review import exceptional
from report.sheet.schema import RecordedAt
from report.typeset.equations import symbol
from report.typeset.pdf import TEMPLATES
from report.words.units import number
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
    """Return the summary page: governing numbers and all verdicts."""
    return {
        "verdict": stamp(package.assessment.verdict),
        "conditions": conditions(package),
        "sentence": verdict_sentence(package),
        "numbers": (*_numbers(package), *_missed_targets(package, spectra)),
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


def _numbers(package: PackageData) -> Sequence[tuple[str, str, str]]:
    site, rules, array = package.data.site, package.assessment.rules, package.governing
    key = package.prescriptive_key(array)
    motions = f"{array.analysis.n_motions} motion{'s' if array.analysis.n_motions != 1 else ''}"
    return (
        (
            "Seismic demand",
            Markup("{} = {} g, SDC {}, {} = {}, risk category {}").format(
                symbol("S_DS"),
                number(site.s_ds, 3),
                site.sdc_text,
                symbol("I_e"),
                number(site.i_e, 2),
                site.risk_category.value,
            ),
            "input" if site.s_ds_g is not None else package.part("inputs"),
        ),
        (
            "Prescriptive displacement",
            package.fmt.both(array.prescriptive.value_m) + package.prescriptive_mark(array),
            rules.values[key].clause,
        ),
        (
            "Basis of the analysis value",
            f"{statistic(array.analysis.basis)} of {motions}{package.mark('analysis_factor')}",
            rules.values["analysis_factor"].clause,
        ),
        (
            f"Largest design displacement (array {array.id})",
            package.fmt.both(array.design_m) + package.design_mark(array),
            f"governed by: {array.source}",
        ),
        *exceptional(package),
    )


def _missed_targets(
    package: PackageData, spectra: Sequence[Spectra]
) -> Sequence[tuple[str, str, str]]:
    """Return where the motions miss their targets; what follows is said once, with the last."""
    found = departures(spectra)
    last = {departure.is_short: departure for departure in found}.values()
    return [
        (
            f"Motions {'below' if departure.is_short else 'above'} their target",
            departure_sentence(departure) if departure in last else departure_place(departure),
            package.part("motions"),
        )
        for departure in found
    ]


def basis(package: PackageData, certainty: Certainty) -> Mapping[str, object]:
    """Return what the page on basis and limits needs beside the package."""
    arrays = package.assessment.arrays
    return {
        "motions": [run.motion for run in package.governing.motions],
        "is_ground": any(row.recorded_at is RecordedAt.GROUND for row in package.data.motions),
        "friction": [
            (array.id, mu_words(array.friction), basis_words(package.data, array))
            for array in package.data.arrays
            if not array.friction.is_constant
        ],
        "is_tested": bool(tested(package.data)),
        "routes": {
            route.value: ids
            for route in Route
            if (ids := [array.id for array in arrays if array.route is route])
        },
        "certainty": certainty,
        "failed": troubles(package),
        "validation": explained(SHIPPED),
    }
