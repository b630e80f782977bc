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
from report.assessment.verdict import Verdict
from report.document.tables import stamp
from report.pages.certainty import directions
from report.pages.limits import all_checks, conditions, troubles
from report.pages.motions import departure_place, departure_sentence
from report.pages.parts import PackageData, shortened, statistic
from report.pages.remedies import sentences
from report.pages.review import exceptional
from report.sheet.schema import RecordedAt
from report.typeset.equations import symbol
from report.words.units import number
from report.words.validation import explained
from solver.model import Motion
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
        "answers": sentences(package, remedies),
    }


def plan(package: PackageData) -> Mapping[str, object]:
    """Return how the page of the roof plan lies."""
    from report.figures.plan import is_wide  # loads the plotting library

    return {"page": "landscape" if is_wide(package.assessment) else "portrait"}


def verdict_sentence(package: PackageData) -> str:
    """Return what the verdict on the project rests on."""
    if package.assessment.verdict is not Verdict.NG:
        return f"{_satisfied(package)}; {_remaining(package)}."
    counts = (
        (
            "array",
            [
                package.assessment.array_verdict(array).is_permitted
                for array in package.assessment.arrays
            ],
        ),
        ("clearance", [gap.verdict.is_permitted for gap in package.assessment.clearances]),
        ("limit", [check.ok for _, check in all_checks(package)]),
        ("requirement", [row.verdict.is_permitted for row in package.assessment.rows]),
    )
    failed = [
        f"{oks.count(False)} of {len(oks)} {name}{'s' if len(oks) != 1 else ''}"
        for name, oks in counts
        if False in oks
    ]
    return f"Marked NG: {', '.join(failed)}{_unknown(package)}."


def _unknown(package: PackageData) -> str:
    """Return how many clearances have no verdict, if any have none."""
    gaps = package.assessment.clearances
    if not (count := sum(not gap.is_permitted for gap in gaps)):
        return ""
    return f"; without a verdict: {count} of {len(gaps)} clearance{'s' if len(gaps) != 1 else ''}"


def _satisfied(package: PackageData) -> str:
    """Return what is satisfied, which is no clearance where none is listed."""
    if package.assessment.clearances:
        return "All limits and clearances are satisfied"
    return "All limits are satisfied; the workbook lists no clearance, and none is checked"


def _remaining(package: PackageData) -> str:
    """Return what remains to be done, or that every run is final."""
    count = len(package.assessment.conditions)
    if not count:
        return "every run reached a final value"
    each = "condition" if count == 1 else "conditions"
    return (
        f"{count} {each} listed in {package.part('summary')} must be met before this package is "
        "complete"
    )


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
    """Return the computed texts of the page on basis and limits."""
    motions = [run.motion for run in package.governing.motions]
    return {
        "title": package.assessment.rules.title,
        "components": _components(motions),
        "runs": _runs(motions),
        "moves": "the records prescribe, with ground records transferred through the building of "
        f"{package.part('motions')}"
        if any(row.recorded_at is RecordedAt.GROUND for row in package.data.motions)
        else "the records prescribe",
        "friction": _friction(package),
        "tests": f"The friction tests are listed in {package.part('inputs')}."
        if tested(package.data)
        else "The workbook gives no runs of friction tests.",
        "requested": _requested(package),
        "linked": _linked(package),
        "peer": "is stated to be peer reviewed"
        if package.data.options.peer_reviewed
        else "is not stated to be peer reviewed",
        "floor": _floor(package),
        "routes": _routes(package),
        "angles": _angles(package, certainty),
        "failed": troubles(package),
        "has_none": any(not gap.is_permitted for gap in package.assessment.clearances),
        "validation": explained(SHIPPED),
        "sums": package.part("how-sure") if package.data.options.smaller_factors else "",
    }


def _floor(package: PackageData) -> str:
    """Return whether the floor on the value from analysis applies."""
    if all(array.route is Route.PRESCRIPTIVE for array in package.assessment.arrays):
        return "is not used: the design displacements are prescriptive"
    return "does not apply" if package.data.options.peer_reviewed else "applies"


def _routes(package: PackageData) -> str:
    """Return which limits are satisfied, by the route that each array takes."""
    of_route = {
        route: [array.id for array in package.assessment.arrays if array.route is route]
        for route in Route
    }
    taken = {route: ids for route, ids in of_route.items() if ids}
    if len(taken) == 1:
        return f"All limits of the {next(iter(taken))} route are satisfied{_as_permitted(package)}"
    parts = (f"of the {route} route for {', '.join(ids)}" for route, ids in taken.items())
    return f"All limits are satisfied{_as_permitted(package)}: {' and '.join(parts)}"


def _as_permitted(package: PackageData) -> str:
    by_exception = any(check.passes_by_exception for _, check in all_checks(package))
    return " or, where permitted, exceeded" if by_exception else ""


def _angles(package: PackageData, certainty: Certainty) -> str:
    """Return what directions of shaking that are not run would give, as computed."""
    text = directions(package, certainty)
    return (
        "Other orientations of the horizontal pair and a reversed vertical component: not part of "
        f"the design value. For array {package.governing.id}, motion {certainty.motion.motion.id}, "
        f"PRD {package.fmt.both(certainty.used_m)}: {text[0].lower()}{text[1:]} "
        f"({package.part('how-sure')})."
    )


def _components(motions: Sequence[Motion]) -> str:
    """Return which components act, as the motions have them."""
    count = len(motions)
    transverse = sum(motion.has_transverse for motion in motions)
    vertical = sum(motion.has_vertical for motion in motions)
    has = (
        f"{transverse} of {count} motions have a second horizontal component, {vertical} of "
        f"{count} a vertical component."
    )
    if transverse:
        return f"All components of a motion act together, along and across the slope: {has}"
    return f"Shaking and sliding along the slope only: {has}"


def _runs(motions: Sequence[Motion]) -> str:
    """Return how each motion is applied, as the motions have it."""
    both = sum(len(motion.signs) == 2 for motion in motions)
    applied = (
        "Each horizontal component in turn is applied along the slope, with the other, if any, "
        "across the slope"
        if any(motion.has_transverse for motion in motions)
        else "The horizontal component is applied along the slope"
    )
    return (
        f"{applied}; {both} of {len(motions)} motions are run both as recorded and reversed. The "
        "run with the largest peak relative displacement (PRD) governs."
    )


def _requested(package: PackageData) -> str:
    """Return which arrays use a model that the workbook requests."""
    arrays = [item.array for item in package.assessment.arrays if item.is_model_requested]
    return "".join(
        f"; {array.id} uses the requested model, {array.model.value}" for array in arrays
    )


def _linked(package: PackageData) -> str:
    """Return which arrays are compared with a row of linked blocks."""
    names = ", ".join(linked.design.id for linked in package.assessment.linked)
    return (
        f" ({package.part('model')} compares {names} with a row of linked blocks)" if names else ""
    )


def _friction(package: PackageData) -> str:
    single = (
        "a single coefficient μ for each array, at rest and while sliding, independent of velocity"
    )
    others = [
        f"{array.id}: {mu_words(array.friction)}, {basis_words(package.data, array)}"
        for array in package.data.arrays
        if not array.friction.is_constant
    ]
    if not others:
        return single
    return f"{single} (except {'; '.join(others)}; see {package.part('model')})"
