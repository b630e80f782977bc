"""Checks of entries, dates and confirmations: building code, dates, provisions, peer review."""

from __future__ import annotations

from collections.abc import Iterator

from report.assessment.checks.check import Actor, Check, condition, stated
from report.assessment.design.verdict import NOT_GIVEN
from report.project.model import ProjectInput
from report.project.model.input_rows import Place
from solver.rules.provisions import review_lifts_slope
from solver.rules.rulesets import RULE_SETS


def of_confirmations(data: ProjectInput) -> Iterator[Check]:
    """Yield the requirements on dates, confirmations and peer review."""
    yield from _dates(data)
    yield from _confirmation(data)
    yield from _peer_review(data)


def of_building_code(data: ProjectInput) -> Check:
    """Return whether building code and jurisdiction are entered."""
    site = data.site
    adopted = stated(
        "site",
        building_code=("building code", site.code_text),
        jurisdiction=("jurisdiction", site.jurisdiction),
    )
    return condition(
        id="building_code",
        title="Building code and jurisdiction",
        found=adopted.found,
        is_satisfied=not adopted.missing,
        places=adopted.missing,
        limit="code with its year, and jurisdiction",
        clause="plan check",
        remedy="Enter the adopted building code, its year and the jurisdiction on the Site "
        "worksheet.",
    )


def _dates(data: ProjectInput) -> Iterator[Check]:
    """Yield for each date whether it is before the package, and of these inputs."""
    options, tests, issued = data.options, data.friction_tests, data.project.date
    again = "Have it confirmed for these inputs, and enter the new date"
    compare = (
        "Compare these inputs with it, and enter its date if that is new; if they agree, clear"
    )
    dated = (
        ("peer review", options.peer_date if options.peer_reviewed and data.motions else None,
         Place("options", 0, "peer_date"), f"{again}; until then the package does not rely on it."),
        ("friction report", tests.date, Place("friction_tests", 0, "date"),
         f"{compare} Test report covered."),
        ("seismic parameters", data.site.hazard_date, Place("site", 0, "hazard_date"),
         f"{compare} Seismic parameters covered."),
        ("confirmation of the provisions", data.confirmation.date,
         Place("confirmation", 0, "date"), f"{again}; until then the marks † remain."),
        ("confirmation of the drawing", data.project.drawing_confirmed_date,
         Place("project", 0, "drawing_confirmed_date"), f"{again}."),
    )  # fmt: skip
    for noun, date, place, remedy in dated:
        if date is None:
            continue
        # A later date may be a slip of typing: until then it confirms nothing.
        is_later = date > issued
        # By the hashes that a report put on record: a date cannot show a later change.
        sheets = data.outdated.get(place.section)
        yield condition(
            id="dates",
            title=f"Date of the {noun}",
            found=f"{date}" + (f", dated before these inputs changed: {sheets}" if sheets else ""),
            limit=f"not later than {issued}, and for these inputs",
            clause="plan check",
            is_satisfied=not (is_later or sheets),
            remedy="Correct the date, or date the package later." if is_later else remedy,
            places=(place,),
        )


def _confirmation(data: ProjectInput) -> Iterator[Check]:
    confirmation, adopted = data.confirmation, data.site.adopted
    if confirmation.date and "confirmation" not in data.outdated:  # else a row on its date says so
        yield condition(
            id="confirmation",
            title="Confirmation of the provisions",
            found=f"{', '.join(confirmation.of)}: {confirmation.by}, {confirmation.date}",
            limit=", ".join(part or f"building code {NOT_GIVEN}" for part in adopted),
            clause="plan check",
            # Also where no report was made between, so that nothing was put on record.
            is_satisfied=confirmation.of == adopted,
            remedy="Have the provisions of these inputs confirmed; until then the marks † remain.",
            places=(Place("confirmation", 0, "date"),),
        )


def _peer_review(data: ProjectInput) -> Iterator[Check]:
    options = data.options
    if not (options.peer_reviewed and data.motions):
        return
    # A plan checker asks for the reviewer by name and license, and for the letter itself.
    review = stated(
        "options",
        peer_reviewer=("reviewer", options.peer_reviewer),
        peer_license=("license", options.peer_license),
        peer_date=("date", options.peer_date),
        peer_letter=("letter", options.peer_letter),
    )
    lifts_slope = review_lifts_slope(RULE_SETS[data.site.rule_set], data.site.sdc)
    back = "floor and the slope limit of the analysis procedure apply"
    yield condition(
        id="peer_review",
        title="Peer review of the analysis",
        found=review.found,
        is_satisfied=not review.missing,
        places=review.missing,
        limit="reviewer, license, date and letter",
        clause=data.site.rule_set,
        actor=Actor.REVIEWER,
        remedy="Enter reviewer, license, date and letter: until then the "
        f"{back if lifts_slope else 'floor of the analysis procedure applies'}.",
    )
