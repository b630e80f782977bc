"""The head of the first sheet: project, codes, seal and revisions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from report.document.tables import headed
from report.pages.parts import PackageData
from report.pages.symbols import friction_standard
from report.project.model import Revision


def page(package: PackageData) -> Mapping[str, object]:
    """Return the facts of the project, and its revisions where there are several."""
    project = package.data.project
    first = Revision(
        revision=project.revision,
        date=project.date,
        description="First issue",
        by=project.prepared_by,
    )
    # A title block has a first line even where the Revisions worksheet is empty.
    revisions = package.data.revisions or [first]
    rows = [(row.revision, row.date, row.description, row.by or "—") for row in revisions]
    columns = ("Rev.", 0.6), ("Date", 1.2), ("Description", 4), ("By", 1.8)
    only = f": {revisions[0].description}" if len(revisions) == 1 else ""
    return {
        "name": project.name,
        "about": list(_facts(package, only)),
        "license": project.license,
        "revisions": headed(*columns, rows=rows) if len(rows) > 1 else None,
    }


def _facts(package: PackageData, description: str) -> Iterator[tuple[str, str]]:
    """Yield label and text of each row of the head."""
    project, site = package.data.project, package.data.site
    yield "Project number", project.number
    yield "Client", project.client or "—"
    yield "Address", project.address or "—"
    if site.latitude_deg is not None:
        # Nine digits are 0.1 m or less, and print no rounding error of a binary number.
        place = f"{site.latitude_deg:.9g}°, {site.longitude_deg:.9g}°"
        yield "Lat., long.", place.replace("-", "−")
    yield "Jurisdiction", site.jurisdiction or "not entered"
    yield "Date, revision", f"{project.date}, {project.revision}{description}"
    drawing = _listed(project.plan_number, project.plan_date)
    firm = _listed(project.firm, project.firm_contact)
    if drawing:
        yield "Drawing", drawing
    if firm:
        yield "Firm", firm
    yield "Prepared by", project.prepared_by
    yield "Checked by", project.checked_by or "not yet checked"
    yield "Codes", "; ".join(_codes(package))


def _listed(*texts: object) -> str:
    return ", ".join(str(text) for text in texts if text)


def _codes(package: PackageData) -> Iterator[str]:
    site, rules = package.data.site, package.assessment.rules
    yield site.code_text or "building code not entered"
    yield rules.name
    if site.edition.name != rules.name:
        yield site.edition.name
    yield rules.values["ibc_max_slope_deg"].clause
    if package.assessment.has_motions:
        yield "AC156"
    standard = friction_standard(package)
    if standard:
        yield standard
