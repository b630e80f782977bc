"""The Project, Site and Friction tests worksheets: their inputs, one per cell or column."""

from __future__ import annotations

import datetime as dt

from report.project.model import Project, Revision
from report.project.model.friction_report import FrictionTestRow, FrictionTests
from report.project.model.site_input import Site, least_category, least_i_e, tabulated_f_a
from report.project.workbook.entries import Entry, block, table
from report.text.units import Quantity
from solver.rules.site_coefficients import F_A

PROJECT = block("project", "Project", "Project", Project, "Printed on sheet 1 and in the header.",
    Entry("Project name", "name", "Alameda Warehouse, Rooftop Solar", note="Printed on sheet 1."),
    Entry("Project number", "number", "24-117", note="Printed on every sheet."),
    Entry("Client", "client", "Harbor Logistics LLC", note="Printed on sheet 1."),
    Entry("Address", "address", "1200 Alameda St, Los Angeles, CA",
          note="Address of the building."),
    Entry("Prepared by", "prepared_by", "RG", note="Name or initials, printed on every sheet."),
    Entry("Checked by", "checked_by", "MT",
          note="Name or initials, printed on every sheet. Leave blank until checked."),
    Entry("Firm", "firm", "Example Structural Engineers", is_new=True,
          note="Firm of the engineer of record. Printed on sheet 1."),
    Entry("Firm's address and phone", "firm_contact", "500 Main St, Los Angeles, CA; 213 555 0100",
          is_new=True, note="Printed with the firm."),
    Entry("Engineer's license", "license", "CA S0000", is_new=True,
          note="State and number of the engineer of record, printed in the seal box."),
    Entry("Date", "date", dt.date(2026, 3, 5), note="Date of this issue."),
    Entry("Revision", "revision", "0", note="Revision of this issue, printed on every sheet."),
    Entry("Primary units", "units_first", "US", former="Units first",
          note="Both systems are printed; this one is first."),
    Entry("Drawing number", "plan_number", "S-101", is_new=True,
          note="Permit drawing that the distances were taken from. Printed on sheet 1."),
    Entry("Drawing date", "plan_date", dt.date(2026, 2, 27), is_new=True, note="Date of that"
          " drawing."),
    Entry("Drawing distances confirmed by", "drawing_confirmed_by", "RG",
          note="Person who confirmed all distances from the drawing. Required with the date."),
    Entry("Drawing distances confirmed on", "drawing_confirmed_date", dt.date(2026, 3, 5),
          note="Date of the confirmation. Required with the name."),
    Entry("Drawing distances covered", "drawing_covered", "2026-03-05: Clearances 3f2a91",
          note="Leave blank. roofslip report enters the date and a short hash of the confirmed"
          " distances."),
)  # fmt: skip

REVISIONS = table("revisions", "Project", "Revisions", Revision, "One row for each issue.",
    Entry("Revision", "revision", "0", note="Number or letter."),
    Entry("Date", "date", dt.date(2026, 3, 5), note="Date of issue."),
    Entry("Description", "description", "Issued for permit", note="What changed."),
    Entry("By", "by", "RG", note="Name or initials."),
)  # fmt: skip

SITE = block("site", "Site", "Site and building", Site, "Enter S_DS, S_MS, or S_S and F_a.",
    Entry("Rule set", "rule_set", "SEAOC PV1-2012",
          note="The provisions used for this project. Rule sets are never combined."),
    Entry("Edition of ASCE 7", "edition_name", "ASCE 7-16",
          note="Edition used for the seismic parameters. If blank, the edition of the rule set"
          " (ASCE 7-16 with PV1-2012)."),
    Entry("Risk category", "risk_category", "II", note="ASCE 7 Table 1.5-1."),
    Entry("Site class", "site_class", "D", note="ASCE 7 Chapter 20."),
    Entry("S_S", "s_s_g", 1.97, "g", usual=(0.1, 3.5),
          note="Mapped value, short period. Enter S_S and F_a, or S_MS, or S_DS."),
    Entry("S_1", "s_1_g", 0.70, "g", usual=(0.03, 1.5),
          note="Mapped value at 1 s. At 0.75 g or more the SDC is E or F."),
    Entry("F_a", "f_a", 1.2, usual=(0.8, 2.4), computed=tabulated_f_a, rule=f"{F_A.clause}†",
          note="Short-period site coefficient; none in ASCE 7-22. If F_a, S_MS and S_DS are blank,"
          " the table value is used."),
    Entry("F_v", "f_v", 1.7, usual=(0.8, 4.2), note="Site coefficient at 1 s; none in ASCE 7-22."),
    Entry("S_MS", "s_ms_g", 2.349, "g", usual=(0.1, 4.0),
          note="From a hazard tool. If blank, F_a S_S, unrounded."),
    Entry("S_M1", "s_m1_g", 0.98, "g", usual=(0.03, 3.0),
          note="From a hazard tool. If blank, F_v S_1, unrounded."),
    Entry("S_DS", "s_ds_g", 1.566, "g", usual=(0.1, 2.5),
          note="Design value, short period. If blank, 2/3 S_MS, unrounded."),
    Entry("S_D1", "s_d1_g", 0.653, "g", usual=(0.03, 2.0),
          note="Design value, 1 s. If blank, 2/3 S_M1, unrounded."),
    Entry("Importance factor I_e", "i_e", 1.0, usual=(1.0, 1.5), need="computed if blank",
          computed=least_i_e, rule="ASCE 7 Table 1.5-2†", note="Minimum 1.0 for Risk Category I or"
          " II, 1.25 for III, 1.5 for IV. If blank, the minimum is used."),
    Entry("Seismic design category", "sdc", "D", need="required, or S_1 and S_D1",
          computed=least_category, rule="ASCE 7 Section 11.6†", note="ASCE 7 Section 11.6. If"
          " blank, the lowest category permitted by S_DS, S_D1 and S_1."),
    Entry("Basis of seismic parameters", "hazard", "mapped values", former="Hazard basis",
          note="Site Class D with S_1 of 0.2 g or more"
          " requires a site-specific analysis or the exception of ASCE 7-16 11.4.8. Values below"
          " the tables require the analysis."),
    Entry("Source of seismic parameters", "hazard_source", "ASCE 7 Hazard Tool",
          former="Source of hazard",
          note="Tool, or author of the site-specific analysis."),
    Entry("Date of seismic parameters", "hazard_date", dt.date(2026, 2, 20),
          former="Date of hazard", note="Date of the tool output or of the report."),
    Entry("Seismic parameters covered", "hazard_covered", "2026-02-20: Site 3f2a91",
          former="Hazard covered", note="Leave blank. roofslip report enters the date and a short"
          " hash of these values."),
    Entry("Seismic report number", "hazard_report", "GE-2026-41",
          former="Report number of hazard", note="Number of the site-specific analysis report."),
    Entry("Printout of seismic parameters", "hazard_printout", "hazard.pdf",
          former="Hazard printout", note="Printout of the hazard tool, or the report: a PDF in the"
          " workbook's folder. The package attaches it."),
    Entry("Number of stories", "stories", 1, usual=(1.0, 6.0), former="Storeys",
          note="Above grade."),
    Entry("Structure height h", "structure_height_m", 36.0, Quantity.PLAN, usual=(8.0, 120.0),
          note="Average roof height above the base (ASCE 7, 13.3)."),
    Entry("Roof height z", "roof_height_m", 36.0, Quantity.PLAN, usual=(8.0, 120.0),
          former="Height of the array z", note="Height of the supporting roof above the base."),
    Entry("a_p or C_AR", "force_factor", 1.0, note="a_p (ASCE 7-16) or C_AR (7-22) of the arrays;"
          " used only to print F_p for comparison."),
    Entry("R_p or R_po", "force_divisor", 1.5, note="R_p (ASCE 7-16) or R_po (7-22)."),
    Entry("Building code", "building_code", "CBC", note="Adopted building code. Printed on sheet"
          " 1."),
    Entry("Year of building code", "building_code_year", 2022,
          note="Edition of the building code."),
    Entry("Jurisdiction", "jurisdiction", "City of Los Angeles",
          note="Building department. Printed on sheet 1."),
    Entry("Letter of acceptance", "acceptance_letter", "acceptance.pdf", is_new=True,
          note="Acceptance by the jurisdiction of a rule set or edition that its building code"
          " does not reference: a PDF in the workbook's folder."),
    Entry("Fire code section", "fire_code_section", "Section of the 2022 CFC, as adopted",
          note="Code, edition and section that limit the size of array sections. The package prints"
          " it with that check; without it, the package has an open condition."),
    Entry("Fire pathway width", "fire_lane_m", 4.0, Quantity.PLAN, usual=(3.0, 10.0),
          former="Fire lane width", note="Arrays closer than this are treated as one array section."
          " If blank, 4 ft (common practice; verify against the adopted code)."),
    Entry("Latitude", "latitude_deg", 34.0362, "deg", is_new=True, note="Latitude of the site of"
          " the seismic parameters; positive north. Printed on sheet 1."),
    Entry("Longitude", "longitude_deg", -118.2334, "deg", is_new=True,
          note="Positive east; negative in the Americas."),
    Entry("Design load of the roof", "roof_load_pa", 32.0, Quantity.PRESSURE, usual=(10.0, 150.0),
          is_new=True, note="Design gravity load of the existing roof. The weight of each array"
          " over its plan area is compared with 5% of it."),
    Entry("Seismic weight", "seismic_weight_n", 900_000.0, Quantity.WEIGHT,
          usual=(20_000.0, 100_000_000.0), is_new=True,
          note="Seismic weight of the existing building. The weight of all arrays is"
          " compared with 10% of it."),
    Entry("Evaluation of the building", "roof_evaluation", "J. Doe, SE, 2026-02-20", is_new=True,
          note="Evaluation of the existing building with the added weight: author, and date or"
          " number of the report. For a new building: who designed it for this weight."),
)  # fmt: skip

FRICTION_TESTS = block("friction_tests", "Friction tests", "Friction tests", FrictionTests,
    "Optional. Data from the friction test report. Leave a cell blank if the report does not state"
    " the value.",
    Entry("Laboratory", "laboratory", "Example Laboratories",
          note="Laboratory that performed the tests."),
    Entry("Accreditation", "accreditation", "ISO/IEC 17025, no. 1234.01",
          note="Accreditation of the laboratory."),
    Entry("Standard", "standard", "ASTM G115-10", note="Test standard."),
    Entry("Report number", "report", "FT-2025-118", note="Number of the report."),
    Entry("Report date", "date", dt.date(2025, 6, 12), note="Date of the report."),
    Entry("Test report covered", "tests_covered", "2025-06-12: Friction tests 3f2a91",
          note="Leave blank. roofslip report enters the date and a short hash of the runs."),
    Entry("Membrane", "membrane", "TPO, 60 mil",
          note="Roof surface as tested: product and thickness."),
    Entry("Support material", "support", "EPDM pad",
          note="Surface of the array's supports as tested."),
    Entry("Contact pressure of the tests", "contact_pressure_pa", 150.0, Quantity.PRESSURE,
          is_new=True, note="Weight on a tested support divided by its contact area; printed next"
          " to that of the arrays."),
    Entry("Test report file", "report_file", "friction-report.pdf", note="The report: a PDF in"
          " the workbook's folder. The package attaches it. All such files: at most 20 MB."),
    may_be_absent=True,
)  # fmt: skip

FRICTION_RUNS = table("friction_runs", "Friction tests", "Friction test runs",
    FrictionTestRow, "Optional: one row for each run, wet and dry. The package compares the"
    " friction coefficients of the arrays with the kinetic means.",
    Entry("Surface", "surface", "wet", note="Condition of the roof surface."),
    Entry("Run", "number", 1, note="Number of the run."),
    Entry("Kinetic coefficient", "mu", 0.46, usual=(0.3, 0.8),
          note="Mean friction coefficient while sliding."),
    Entry("Velocity", "velocity_mps", 1.0, Quantity.VELOCITY,
          note="Sliding velocity. If blank, not reported."),
    Entry("Static coefficient", "mu_static", 0.52, usual=(0.3, 1.0),
          note="At breakaway. If blank, not reported."),
    Entry("Report", "report", "FT-2025-118", is_rare=True,
          note="Only if the runs are from several reports. If blank, the report above."),
    may_be_absent=True,
)  # fmt: skip
