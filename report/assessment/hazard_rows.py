"""What a plan checker asks about the seismic parameters: code, source, SDC, site class, 11.4.8.

Each row that is not satisfied is a condition, not NG; values below their table are errors
(`report.sheet.checking.site_checks`). Read `hazard_rows`.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from report.assessment.verdict import NOT_GIVEN, STAYS, Requirement, condition, stated
from report.sheet.schema import ProjectInput
from report.sheet.schema.fields import Place
from report.sheet.schema.project import Site
from solver.rules.hazard import LEAST_F_A_BY_DEFAULT, REFERENCED, HazardBasis
from solver.rules.site_coefficients import BY_DEFAULT, LEAST_S_1_OF_D_G, site_specific_reason

_FIELDS = {
    symbol: Place("site", 0, field)
    for symbol, field in (("S_S", "s_s_g"), ("S_1", "s_1_g"), ("S_D1", "s_d1_g"))
}


def hazard_rows(data: ProjectInput) -> tuple[Requirement, ...]:
    """Return the rows on the seismic parameters of the site."""
    site = data.site
    return (*_code(data), _source(site), _category(site), *_site_class(site), *_site_specific(site))


def _code(data: ProjectInput) -> Iterator[Requirement]:
    """Yield what is not by the edition of ASCE 7 that the building code references."""
    site, mark = data.site, "" if data.confirmed else "†"
    code, edition = site.code_text, REFERENCED.get(site.code_text)
    row = partial(condition, basis=f"{code}, chapter 35{mark}", is_satisfied=False)
    if code and not edition:
        yield row(
            id="code_edition",
            title="Edition of ASCE 7 that the building code references",
            found=f"not known to this program for the {code}",
            limit="confirmation",
            remedy="Confirm which it is, and that the rule set and the seismic parameters are by "
            f"it. Known for: {', '.join(REFERENCED)}.",
            places=(Place("site", 0, "building_code_year"),),
        )
    for field, what, used, instead in (
        ("rule_set", "", site.rule_set, "select the rule set"),
        ("edition_name", "the seismic parameters of ", site.edition.name, "enter those of"),
    ):
        if edition and used != edition:
            yield row(
                id=field,
                title=f"Acceptance of {what}{used} by the jurisdiction",
                found=used,
                limit=f"{edition} of the {code}{mark}, or acceptance in writing",
                remedy=f"Obtain the jurisdiction's acceptance in writing, or {instead} {edition}. "
                f"{STAYS}",
                places=(Place("site", 0, field),),
            )


def _source(site: Site) -> Requirement:
    source, date = ("source", site.hazard_source), ("date", site.hazard_date)
    file = site.hazard_printout and f"{site.hazard_printout}, attached"
    if site.hazard is not HazardBasis.SITE_SPECIFIC:
        return condition(
            id="hazard_source",
            title="Source, date and printout of the seismic parameters",
            **stated(
                "site",
                hazard_source=source,
                hazard_date=date,
                hazard_printout=("printout", file),
            ),
            limit="source, date and printout",
            basis="seismic parameters",
            remedy="State source and date on the sheet Site, and attach the printout of the tool.",
        )
    number = ("report number", site.hazard_report)
    return condition(
        id="hazard_source",
        title="Report on the site-specific hazard analysis",
        **stated(
            "site",
            hazard_source=source,
            hazard_report=number,
            hazard_date=date,
            hazard_printout=("report attached", file),
        ),
        limit="source, report number, date and the report attached",
        basis=site.edition.clause("site_specific"),
        remedy="Obtain the report, attach it, and state its author, number and date on the sheet "
        "Site.",
    )


def _category(site: Site) -> Requirement:
    lacking = site.sdc_lacks
    missing = " and ".join(lacking)
    found = f"{missing} {NOT_GIVEN}: SDC {site.sdc} is not confirmed"
    if not lacking:
        found = f"S_1 = {site.s_1_g:.3f} g, S_D1 = {site.s_d1:.3f} g"
    return condition(
        id="sdc",
        title="Basis of the seismic design category",
        found=found,
        limit="S_DS, S_1 and S_D1",
        basis=site.edition.clause("sdc"),
        is_satisfied=not lacking,
        remedy=f"The SDC also depends on {missing}: enter {'both' if len(lacking) > 1 else 'it'}.",
        places=tuple(_FIELDS[symbol] for symbol in lacking),
    )


def _site_class(site: Site) -> Iterator[Requirement]:
    if site.assumed_class != BY_DEFAULT or site.hazard is HazardBasis.SITE_SPECIFIC:
        return
    holds = (
        f"F_a is then at least {LEAST_F_A_BY_DEFAULT:g} ({site.edition.clause('s_ms')}), and S_1 of"
        f" {LEAST_S_1_OF_D_G:g} g or more needs a site-specific hazard analysis or the exception"
        f" ({site.edition.clause('site_specific')}): determine the site class."
    )
    yield condition(
        id="site_class",
        title="Site class",
        found=f"{NOT_GIVEN}: D by default" if site.site_class is None else "D by default",
        limit="determined for the site",
        basis=site.edition.clause("site_class"),
        is_satisfied=False,
        remedy=holds
        if site.edition.has_site_coefficients
        else "The values of a hazard tool depend on the site class: determine it.",
        places=(Place("site", 0, "site_class"),),
    )


def _site_specific(site: Site) -> Iterator[Requirement]:
    reason, missing = site_specific_reason(
        site.edition, site_class=site.assumed_class, s_s_g=site.s_s_g, s_1_g=site.s_1_g
    )
    if not reason:
        return
    yield condition(
        id="site_specific_hazard",
        title=f"Hazard analysis for {reason}",
        found=site.hazard.value,
        limit="site-specific analysis or exception"
        + (", if the missing value requires it" if missing else ""),
        basis=site.edition.clause("site_specific"),
        is_satisfied=site.hazard is not HazardBasis.MAPPED,
        remedy="Give the mapped value that is missing, obtain a site-specific hazard analysis, or "
        "state the exception that applies."
        if missing
        else "S_DS and S_D1 are mapped values: obtain a site-specific hazard analysis, or state "
        "the exception that applies.",
        places=tuple(_FIELDS[symbol] for symbol in missing) or (Place("site", 0, "hazard"),),
    )
