"""The sheets Project, Site and Friction tests: their inputs, one to a cell or to a column."""

from __future__ import annotations

import datetime as dt

from report.project.model.friction_report import FrictionTestRow, FrictionTests
from report.project.model.issue import Project, Revision
from report.project.model.site import Site, least_category, least_i_e, tabulated_f_a
from report.project.workbook.entries import Entry
from report.project.workbook.sections import block, table
from report.text.units import Quantity
from solver.rules.site_coefficients import F_A

PROJECT = block("project", "Project", "Project", Project, "Printed on the cover and on every page.",
    Entry("Project name", "name", "Alameda Warehouse, Rooftop Solar", note="Printed on the cover."),
    Entry("Project number", "number", "24-117", note="Printed on every page."),
    Entry("Client", "client", "Harbor Logistics LLC", note="Printed on the cover."),
    Entry("Address", "address", "1200 Alameda St, Los Angeles, CA",
          note="Address of the building."),
    Entry("Prepared by", "prepared_by", "RG", note="Name or initials, printed on every page."),
    Entry("Checked by", "checked_by", "MT",
          note="Name or initials, printed on every page. Leave blank until checked."),
    Entry("Firm", "firm", "Example Structural Engineers", is_new=True,
          note="Of the engineer of record. Printed on the cover."),
    Entry("Firm's address and phone", "firm_contact", "500 Main St, Los Angeles, CA; 213 555 0100",
          is_new=True, note="Printed with the firm."),
    Entry("Engineer's license", "license", "CA S0000", is_new=True,
          note="State and number of the engineer of record, printed in the box of the seal."),
    Entry("Date", "date", dt.date(2026, 3, 5), note="Date of this issue."),
    Entry("Revision", "revision", "0", note="Revision of this issue, printed on every page."),
    Entry("Primary units", "units_first", "US", former="Units first",
          note="Both systems are printed; this one comes first."),
    Entry("Drawing number", "plan_number", "S-101", is_new=True,
          note="Of the plan in the permit set from which the distances are. Printed on the cover."),
    Entry("Drawing date", "plan_date", dt.date(2026, 2, 27), is_new=True, note="Of that plan."),
    Entry("Drawing distances confirmed by", "drawing_confirmed_by", "RG",
          note="Name, if every clearance whose distance is from the drawing is confirmed; with the"
          " date."),
    Entry("Drawing distances confirmed on", "drawing_confirmed_date", dt.date(2026, 3, 5),
          note="When they were confirmed; with the name."),
    Entry("Drawing distances covered", "drawing_covered", "2026-03-05: Clearances 3f2a91",
          note="Filled in by roofslip report: the date with a short hash of these distances. Leave"
          " blank."),
)  # fmt: skip

REVISIONS = table("revisions", "Project", "Revisions", Revision, "One row for each issue.",
    Entry("Revision", "revision", "0", note="Number or letter."),
    Entry("Date", "date", dt.date(2026, 3, 5), note="Date of issue."),
    Entry("Description", "description", "Issued for permit", note="What changed."),
    Entry("By", "by", "RG", note="Name or initials."),
)  # fmt: skip

SITE = block("site", "Site", "Site and building", Site, "Give S_DS, S_MS, or S_S and F_a.",
    Entry("Rule set", "rule_set", "SEAOC PV1-2012",
          note="The adopted provisions. Rule sets are never combined."),
    Entry("Edition of ASCE 7", "edition_name", "ASCE 7-16",
          note="For the seismic parameters. Blank: that of the rule set, ASCE 7-16 with PV1-2012."),
    Entry("Risk category", "risk_category", "II", note="ASCE 7 Table 1.5-1."),
    Entry("Site class", "site_class", "D", note="ASCE 7 chapter 20."),
    Entry("S_S", "s_s_g", 1.97, "g", usual=(0.1, 3.5),
          note="Mapped value at 0.2 s. Give S_S and F_a, or S_MS, or S_DS."),
    Entry("S_1", "s_1_g", 0.70, "g", usual=(0.03, 1.5),
          note="Mapped value at 1 s. At 0.75 g or more the SDC is E or F."),
    Entry("F_a", "f_a", 1.2, usual=(0.8, 2.4), computed=tabulated_f_a, rule=f"{F_A.clause}†",
          note="Site coefficient at 0.2 s; ASCE 7-22 has none. Blank, without S_MS and S_DS: of its"
          " table."),
    Entry("F_v", "f_v", 1.7, usual=(0.8, 4.2), note="Site coefficient at 1 s; ASCE 7-22 has none."),
    Entry("S_MS", "s_ms_g", 2.349, "g", usual=(0.1, 4.0),
          note="Read from a hazard tool. Blank: F_a S_S, unrounded."),
    Entry("S_M1", "s_m1_g", 0.98, "g", usual=(0.03, 3.0),
          note="Read from a hazard tool. Blank: F_v S_1, unrounded."),
    Entry("S_DS", "s_ds_g", 1.566, "g", usual=(0.1, 2.5),
          note="Design value, short period. Blank: 2/3 S_MS, unrounded."),
    Entry("S_D1", "s_d1_g", 0.653, "g", usual=(0.03, 2.0),
          note="Design value, 1 s. Blank: 2/3 S_M1, unrounded."),
    Entry("Importance factor I_e", "i_e", 1.0, usual=(1.0, 1.5), need="computed if blank",
          computed=least_i_e, rule="ASCE 7 Table 1.5-2†", note="At least 1.0 in risk category I or"
          " II, 1.25 in III, 1.5 in IV, which a blank cell stands for."),
    Entry("Seismic design category", "sdc", "D", need="required, or S_1 and S_D1",
          computed=least_category, rule="ASCE 7 section 11.6†", note="ASCE 7 section 11.6. Blank:"
          " the least by S_DS, S_D1 and S_1, if it follows from those given or computed."),
    Entry("Hazard basis", "hazard", "mapped values", note="Site class D with S_1 of 0.2 g or more"
          " needs a site-specific analysis or the exception of ASCE 7-16 11.4.8. Values below those"
          " of its tables need one."),
    Entry("Source of hazard", "hazard_source", "ASCE 7 Hazard Tool",
          note="Tool, or author of the site-specific analysis."),
    Entry("Date of hazard", "hazard_date", dt.date(2026, 2, 20),
          note="When the values were read, or of the report."),
    Entry("Hazard covered", "hazard_covered", "2026-02-20: Site 3f2a91",
          note="Filled in by roofslip report: the date with a short hash of these values. Leave"
          " blank."),
    Entry("Report number of hazard", "hazard_report", "GE-2026-41",
          note="Of the report on a site-specific analysis."),
    Entry("Hazard printout", "hazard_printout", "hazard.pdf", note="Of the tool, or the report, as"
          " a PDF in the workbook's folder; the package attaches it."),
    Entry("Number of stories", "stories", 1, usual=(1.0, 6.0), former="Storeys",
          note="Above grade."),
    Entry("Structure height h", "structure_height_m", 36.0, Quantity.PLAN, usual=(8.0, 120.0),
          note="Average roof height above the base, ASCE 7, 13.3."),
    Entry("Height of the array z", "roof_height_m", 36.0, Quantity.PLAN, usual=(8.0, 120.0),
          note="Of the roof that supports it, above the base."),
    Entry("a_p or C_AR", "force_factor", 1.0, note="Amplification factor of a component, in ASCE"
          " 7-16 and 7-22: for F_p, for comparison."),
    Entry("R_p or R_po", "force_divisor", 1.5, note="Its divisor, in ASCE 7-16 and 7-22."),
    Entry("Building code", "building_code", "CBC", note="As adopted there. Printed on the cover."),
    Entry("Year of building code", "building_code_year", 2022,
          note="Edition of the building code."),
    Entry("Jurisdiction", "jurisdiction", "City of Los Angeles",
          note="Building department. Printed on the cover."),
    Entry("Letter of acceptance", "acceptance_letter", "acceptance.pdf", is_new=True,
          note="The jurisdiction's, of what its building code does not reference: a PDF, to"
          " attach."),
    Entry("Fire code section", "fire_code_section", "Section of the 2022 CFC, as adopted",
          note="Code, edition and section that limit the distance between fire lanes. The package"
          " prints it beside the plan dimension of the arrays, and without it has a condition."),
    Entry("Fire lane width", "fire_lane_m", 4.0, Quantity.PLAN, usual=(3.0, 10.0),
          note="Arrays that are closer count as one between fire lanes. Blank: 4 ft, a practice:"
          " verify against the adopted code."),
    Entry("Latitude", "latitude_deg", 34.0362, "deg", is_new=True, note="Of the site, for which the"
          " hazard was read; positive to the north. Printed on the cover."),
    Entry("Longitude", "longitude_deg", -118.2334, "deg", is_new=True,
          note="Positive to the east, so that it is negative in America."),
    Entry("Design load of the roof", "roof_load_pa", 32.0, Quantity.PRESSURE, usual=(10.0, 150.0),
          is_new=True, note="Gravity load for which the existing roof is designed; the weight of"
          " each array over its plan area is compared with 5 % of it."),
    Entry("Seismic weight", "seismic_weight_n", 900_000.0, Quantity.WEIGHT,
          usual=(20_000.0, 100_000_000.0), is_new=True,
          note="Of the existing building; the weight of all arrays is compared with 10 % of it."),
    Entry("Evaluation of the building", "roof_evaluation", "J. Doe, SE, 2026-02-20", is_new=True,
          note="Of the existing building with the weight added: by whom, and date or number of the"
          " report. For a new building: so designed, by whom."),
)  # fmt: skip

FRICTION_TESTS = block("friction_tests", "Friction tests", "Friction tests", FrictionTests,
    "Optional: the report on the friction tests. Leave blank what the report does not state.",
    Entry("Laboratory", "laboratory", "Example Laboratories",
          note="Laboratory that performed the tests."),
    Entry("Accreditation", "accreditation", "ISO/IEC 17025, no. 1234.01",
          note="Accreditation of the laboratory."),
    Entry("Standard", "standard", "ASTM G115-10", note="Test standard."),
    Entry("Report number", "report", "FT-2025-118", note="Number of the report."),
    Entry("Report date", "date", dt.date(2025, 6, 12), note="Date of the report."),
    Entry("Test report covered", "tests_covered", "2025-06-12: Friction tests 3f2a91",
          note="Filled in by roofslip report: the date with a short hash of the runs. Leave"
          " blank."),
    Entry("Membrane", "membrane", "TPO, 60 mil",
          note="Roof surface as tested: product and thickness."),
    Entry("Support material", "support", "EPDM pad",
          note="Surface of the array's supports as tested."),
    Entry("Contact pressure of the tests", "contact_pressure_pa", 150.0, Quantity.PRESSURE,
          is_new=True, note="Weight on a tested support over its contact area; printed beside that"
          " of the arrays."),
    Entry("Test report file", "report_file", "friction-report.pdf", note="The report as a PDF in"
          " the workbook's folder; the package attaches it. All such files: at most 20 MB."),
    may_be_absent=True,
)  # fmt: skip

FRICTION_RUNS = table("friction_runs", "Friction tests", "Runs of the friction tests",
    FrictionTestRow, "Optional: one row for each run, wet and dry. The package compares the"
    " friction coefficients of the arrays with the kinetic means.",
    Entry("Surface", "surface", "wet", note="Condition of the roof surface."),
    Entry("Run", "number", 1, note="Number of the run."),
    Entry("Kinetic coefficient", "mu", 0.46, usual=(0.3, 0.8),
          note="Mean friction coefficient while sliding."),
    Entry("Velocity", "velocity_mps", 1.0, Quantity.VELOCITY,
          note="Sliding velocity. Blank: not reported."),
    Entry("Static coefficient", "mu_static", 0.52, usual=(0.3, 1.0),
          note="At breakaway. Blank: not reported."),
    Entry("Report", "report", "FT-2025-118", is_rare=True,
          note="Only with runs of several reports. Blank: the report above."),
    may_be_absent=True,
)  # fmt: skip
