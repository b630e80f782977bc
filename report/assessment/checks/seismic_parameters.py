"""Requirements on the seismic parameters: rule set, edition, source, SDC, site class, 11.4.8.

Each that is not satisfied is a condition, not NG; values below their table are errors
(`report.project.check.site_faults`). Read `of_site`.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from report.assessment.checks.check import Actor, Check, condition, stated
from report.assessment.design.verdict import NOT_GIVEN
from report.project.model import ProjectInput
from report.project.model.input_rows import Place
from report.project.model.site_input import Site
from report.text.letter_case import capitalized
from solver.rules.hazard import LEAST_F_A_BY_DEFAULT, REFERENCED, HazardBasis
from solver.rules.site_coefficients import BY_DEFAULT, LEAST_S_1_OF_D_G, site_specific_reason
from solver.spaces import NO_BREAK

_FIELDS = {
    symbol: Place("site", 0, field)
    for symbol, field in (("S_S", "s_s_g"), ("S_1", "s_1_g"), ("S_D1", "s_d1_g"))
}


def of_site(data: ProjectInput) -> Iterator[Check]:
    """Yield the requirements on the seismic parameters of the site."""
    site = data.site
    yield from _code(data)
    yield _source(site)
    yield _category(site)
    yield _site_class(site)
    yield _site_specific(site)


_ATTACH = "attach the jurisdiction's letter of acceptance on the Site worksheet"


def _code(data: ProjectInput) -> Iterator[Check]:
    """Yield whether all values are from the edition of ASCE 7 referenced by the building code."""
    site, mark = data.site, "" if data.confirmed else "†"
    # By chapter 35 of the IBC and the CBC, the list of referenced standards.
    code, edition = site.code_text, REFERENCED.get(site.code_text)
    letter = site.acceptance_letter and f"; {site.acceptance_letter}, attached"
    row = partial(condition, clause=f"{code}, chapter 35{mark}", actor=Actor.JURISDICTION)
    # Nothing is guessed for a code that is not in the list.
    if code and not edition:
        yield row(
            id="code_edition",
            title="Edition of ASCE 7 that the building code references",
            found=f"not known to this program for the {code}{letter}",
            limit="known, or written acceptance by the jurisdiction",
            is_satisfied=bool(letter),
            remedy="Confirm which edition it is and that the rule set and the seismic parameters "
            f"follow it, and {_ATTACH} (known for {', '.join(REFERENCED)}).",
            places=(Place("site", 0, "building_code_year"),),
        )
    for field, title, used, instead in (
        ("rule_set", "Rule set", site.rule_set.value, "select the rule set"),
        (
            "edition_name",
            "Edition of the seismic parameters",
            site.edition.name,
            "enter the seismic parameters of",
        ),
    ):
        if edition:
            is_same = used == edition
            accepted = "" if is_same else f", or written acceptance of {used} by the jurisdiction"
            yield row(
                id=field,
                title=title,
                found=used + ("" if is_same else letter),
                limit=f"{edition} of the {code}{mark}{accepted}",
                is_satisfied=is_same or bool(letter),
                remedy=f"{capitalized(_ATTACH)}, or {instead} {edition}.",
                places=(Place("site", 0, field),),
            )


def _source(site: Site) -> Check:
    source, date = ("source", site.hazard_source), ("date", site.hazard_date)
    # A number typed from a tool cannot be traced; its printout can.
    file = site.hazard_printout and f"{site.hazard_printout}, attached"
    if site.hazard is not HazardBasis.SITE_SPECIFIC:
        traced = stated(
            "site", hazard_source=source, hazard_date=date, hazard_printout=("printout", file)
        )
        return condition(
            id="hazard_source",
            title="Source, date and printout of the seismic parameters",
            found=traced.found,
            is_satisfied=not traced.missing,
            places=traced.missing,
            limit="source, date and printout",
            clause="plan check",
            remedy="Enter source and date on the Site worksheet, and attach the printout of the "
            "tool.",
        )
    traced = stated(
        "site",
        hazard_source=source,
        hazard_report=("report number", site.hazard_report),
        hazard_date=date,
        hazard_printout=("report", file),
    )
    return condition(
        id="hazard_source",
        title="Report on the site-specific hazard analysis",
        found=traced.found,
        is_satisfied=not traced.missing,
        places=traced.missing,
        limit="source, report number, date and the report attached",
        clause=site.edition.clause("site_specific"),
        remedy="Obtain the report, attach it, and enter its author, number and date on the Site "
        "worksheet.",
    )


def _category(site: Site) -> Check:
    # ASCE 7 11.6: the more severe of two tables, by S_DS and S_D1; S_1 from 0.75 g gives E or F.
    lacking = site.sdc_lacks
    needs_s_d1 = site.s_d1 is not None or "S_D1" in lacking
    missing = " and ".join(lacking)
    found_text = f"{missing} {NOT_GIVEN}: SDC {site.sdc} is not confirmed"
    if not lacking:
        found_text = f"S_1 = {site.s_1_g:.3f}{NO_BREAK}g"
        found_text += "" if site.s_d1 is None else f", S_D1 = {site.s_d1:.3f}{NO_BREAK}g"
    return condition(
        id="sdc",
        title="Seismic design category",
        found=found_text,
        limit="S_DS, S_1 and S_D1" if needs_s_d1 else "S_DS and S_1",
        clause=site.edition.clause("sdc"),
        is_satisfied=not lacking,
        remedy=f"Enter {missing} on the Site worksheet.",
        places=tuple(_FIELDS[symbol] for symbol in lacking),
    )


def _site_class(site: Site) -> Check:
    is_studied = site.hazard is HazardBasis.SITE_SPECIFIC
    # A site-specific analysis has the soil in it: nothing is taken by default.
    is_default = site.assumed_class == BY_DEFAULT and not is_studied
    found_text = f"{site.site_class}"
    if is_default:
        found_text = f"{NOT_GIVEN}: D by default" if site.site_class is None else "D by default"
    elif is_studied:
        found_text = "in the site-specific analysis"
    return condition(
        id="site_class",
        title="Site class",
        found=found_text,
        limit="determined for the site",
        clause=site.edition.clause("site_class"),
        is_satisfied=not is_default,
        # From ASCE 7-22 on, S_MS and S_M1 are read off for a site class: there are no F_a and F_v.
        remedy="Determine the site class"
        + (
            f": by default, F_a is at least {LEAST_F_A_BY_DEFAULT:g} "
            f"({site.edition.clause('s_ms')}), and S_1 of {LEAST_S_1_OF_D_G:g}{NO_BREAK}g or more "
            "needs a site-specific hazard analysis or the exception "
            f"({site.edition.clause('site_specific')})."
            if site.edition.has_site_coefficients
            else ", on which the values of a hazard tool depend."
        ),
        places=(Place("site", 0, "site_class"),),
    )


def _site_specific(site: Site) -> Check:
    reason, missing = site_specific_reason(
        site.edition, site_class=site.assumed_class, s_s_g=site.s_s_g, s_1_g=site.s_1_g
    )
    limit = "site-specific analysis or exception" if reason else "any"
    obtain = "obtain a site-specific hazard analysis, or enter the exception that applies."
    return condition(
        id="site_specific_hazard",
        title=f"Hazard analysis for {reason}" if reason else "Hazard analysis",
        found=site.hazard.value,
        limit=limit + (", if the missing value requires it" if missing else ""),
        clause=site.edition.clause("site_specific"),
        is_satisfied=not reason or site.hazard is not HazardBasis.MAPPED,
        remedy=f"Enter the mapped value that is missing, {obtain}"
        if missing
        else f"{obtain.capitalize()}",
        places=tuple(_FIELDS[symbol] for symbol in missing) or (Place("site", 0, "hazard"),),
    )
