"""The sheets Options and Acknowledged."""

from __future__ import annotations

import datetime as dt

from report.project.model.options import Acknowledgment, Confirmation, Options, Override
from report.project.model.provision_names import provision_key, provision_name, provision_unit
from report.project.workbook.entries import Entry
from report.project.workbook.sections import block, table
from solver.rules.provisions import MEAN_WITHOUT_FACTOR_MOTIONS

OPTIONS = block("options", "Options", "Options", Options, "The defaults suit most projects.",
    Entry("Design value statistic", "statistic", "rule set", former="Design value from peaks",
          note="Rule set: the statistic that the rule set requires for this number of motions."
               f" Mean: {MEAN_WITHOUT_FACTOR_MOTIONS} motions or more."),
    Entry("Peer review", "peer_reviewed", "No", former="Analysis is peer reviewed",
          note="Yes removes the floor of the value from analysis, once the four cells below are"
          " given."),
    Entry("Peer reviewer", "peer_reviewer", "Reviewer of record",
          note="Required with peer review."),
    Entry("Reviewer's license", "peer_license", "CA S0000",
          note="State and number. Required with peer review."),
    Entry("Date of review", "peer_date", dt.date(2026, 3, 1), note="Required with peer review."),
    Entry("Review covered", "peer_covered", "2026-03-01: Site 3f2a91",
          note="Filled in by roofslip report: date, and a hash of each sheet that the analysis"
          " rests on."),
    Entry("Letter of review", "peer_letter", "peer-review.pdf",
          note="PDF in the workbook's folder. Required with peer review."),
    Entry("Smaller events", "smaller_events", "0.50, 0.50", note="Up to 20 factors on the motions,"
          " above 0.0 up to 1.0, with commas: events that are added, for information."),
    Entry("Study of years", "study_years", "years.json", is_new=True,
          note="years.json of a study, attached; its years are printed for information."),
    Entry("Edition", "package_edition", "plan check", note="Complete adds input echo, table of"
          " spectra, histories, paths, symbols and whole hashes."),
    Entry("Letter of results", "letter", "No",
          note="Yes: a letter to the client with the results is in the package."),
    Entry("Paper of the roof plan", "plan_paper", "by size", note="By size: Letter with US units"
          " first, A4 with SI units first; 11 x 17 in or A3 where labels have no room. The other"
          " sheets go with it: Letter or A4."),
)  # fmt: skip

CONFIRMATION = block("confirmation", "Options", "Confirmation of the provisions", Confirmation,
    "Optional. A later change of any of these, or of an override, brings the marks † back.",
    Entry("Confirmed by", "by", "RG, SE",
          note="Name. With all five, no number of the rule set has †."),
    Entry("Confirmed on", "date", dt.date(2026, 3, 1), note="When they were compared."),
    Entry("Confirmed rule set", "rule_set", "SEAOC PV1-2012",
          note="Whose numbers and clauses were compared with its text."),
    Entry("Confirmed edition of ASCE 7", "edition", "ASCE 7-16",
          note="That of the seismic parameters."),
    Entry("Confirmed building code", "code", "2022 CBC",
          note="Adopted code with its year, as on the sheet Site."),
    Entry("Confirmation covered", "covered", "2026-03-01: Site 3f2a91",
          note="Filled in by roofslip report: date, and a hash of these cells, of Site, of the"
          " overrides."),
    may_be_absent=True,
)  # fmt: skip

OVERRIDES = table("overrides", "Options", "Overrides of provisions", Override,
    "Each is printed in the package with its reason.",
    Entry("Provision", "provision", provision_name("parapet_height_in"), key_of=provision_key,
          note="The number to replace, from the list; the sheet Provisions has its value and"
          " clause."),
    Entry("Value", "value", 18.0, unit_from=("provision", provision_unit),
          note="In the unit stated on the sheet Provisions."),
    Entry("Reason", "reason", "Agreed 2026-02-10", note="Printed in the package."),
)  # fmt: skip

ACKNOWLEDGED = table("acknowledged", "Acknowledged", "Acknowledged warnings", Acknowledgment,
    "Optional: one row for each warning of `roofslip check` that is intended as it is. It is then"
    " printed with the reason.",
    Entry("Warning", "warning", "weight A1",
          note="As in the brackets that `roofslip check` prints."),
    Entry("Reason", "reason", "Weight of the frames alone; ballast by others",
          note="Printed in the package."),
    may_be_absent=True,
)  # fmt: skip
