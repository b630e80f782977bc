"""The Options and Acknowledged worksheets."""

from __future__ import annotations

import datetime as dt

from report.project.model.options import Acknowledgment, Confirmation, Options
from report.project.model.overrides import Override, provision_key, provision_name, provision_unit
from report.project.workbook.entries import Entry, block, table
from solver.rules.provisions import MEAN_WITHOUT_FACTOR_MOTIONS

OPTIONS = block("options", "Options", "Options", Options, "The defaults suit most projects.",
    Entry("Design value statistic", "statistic", "per rule set", former="Design value from peaks",
          note="Per rule set: the statistic that the rule set requires for this number of motions."
               f" Mean: {MEAN_WITHOUT_FACTOR_MOTIONS} motions or more."),
    Entry("Peer review", "peer_reviewed", "No", former="Analysis is peer reviewed",
          note="Yes if the analysis is peer reviewed. The floor does not apply once the four cells"
          " below are filled in."),
    Entry("Peer reviewer", "peer_reviewer", "Reviewer of record",
          note="Required with peer review."),
    Entry("Reviewer's license", "peer_license", "CA S0000",
          note="State and number. Required with peer review."),
    Entry("Date of review", "peer_date", dt.date(2026, 3, 1), note="Required with peer review."),
    Entry("Review covered", "peer_covered", "2026-03-01: Site 3f2a91",
          note="Leave blank. roofslip report enters the date and a short hash of each worksheet"
          " that the analysis uses."),
    Entry("Letter of review", "peer_letter", "peer-review.pdf",
          note="PDF in the workbook's folder. Required with peer review."),
    Entry("Smaller events", "smaller_events", "0.50, 0.50", note="Up to 20 factors on the motions,"
          " greater than 0.0 and at most 1.0, separated by commas. Their displacements are printed"
          " for information only."),
    Entry("Service-life study", "study_years", "years.json", is_new=True, former="Study of years",
          note="years.json of a study. The package attaches it and prints it for information."),
    Entry("Edition", "package_edition", "plan check", note="Complete adds the input, a table of"
          " spectra, histories, paths, symbols and full hashes. Letter is two sheets for a permit"
          " with one to six arrays that use the prescriptive displacement."),
    Entry("Results letter", "letter", "No", former="Letter of results",
          note="Yes if the package contains a letter to the client with the results."),
    Entry("Sheet size of the roof plan", "plan_paper", "automatic", former="Paper of the roof plan",
          note="Automatic: Letter with US units first, A4 with SI units first; 11 x 17 in or A3 if"
          " the labels need more room. The other sheets are Letter or A4."),
)  # fmt: skip

CONFIRMATION = block("confirmation", "Options", "Confirmation of the provisions", Confirmation,
    "Optional. If any of these or an override changes later, the † marks return.",
    Entry("Confirmed by", "by", "RG, SE",
          note="Name. If all five cells are filled in, values of the rule set are printed without"
          " †."),
    Entry("Confirmed on", "date", dt.date(2026, 3, 1), note="Date of the comparison."),
    Entry("Confirmed rule set", "rule_set", "SEAOC PV1-2012",
          note="Rule set whose values and section numbers were compared with its text."),
    Entry("Confirmed edition of ASCE 7", "edition", "ASCE 7-16",
          note="Edition of the seismic parameters."),
    Entry("Confirmed building code", "code", "2022 CBC",
          note="Adopted code with its year, as on the Site worksheet."),
    Entry("Confirmation covered", "covered", "2026-03-01: Site 3f2a91",
          note="Leave blank. roofslip report enters the date and a short hash of these cells, Site"
          " and the overrides."),
    may_be_absent=True,
)  # fmt: skip

OVERRIDES = table("overrides", "Options", "Overrides of provisions", Override,
    "Each is printed in the package with its reason.",
    Entry("Provision", "provision", provision_name("parapet_height_in"), key_of=provision_key,
          note="Provision to override, from the list; the Provisions worksheet has its value and"
          " code section."),
    Entry("Value", "value", 18.0, unit_from=("provision", provision_unit),
          note="In the unit on the Provisions worksheet."),
    Entry("Reason", "reason", "Agreed 2026-02-10", note="Printed in the package."),
)  # fmt: skip

ACKNOWLEDGED = table("acknowledged", "Acknowledged", "Acknowledged warnings", Acknowledgment,
    "Optional. One row for each warning of `roofslip check` that you accept. The package prints it"
    " with your reason.",
    Entry("Warning", "warning", "weight A1",
          note="Name that `roofslip check` prints in brackets."),
    Entry("Reason", "reason", "Weight of the frames alone; ballast by others",
          note="Printed in the package."),
    may_be_absent=True,
)  # fmt: skip
