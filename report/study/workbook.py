"""What Excel knows of a study: the sections of its workbook, each a list of inputs.

Read `report.project.workbook` first.
"""

from __future__ import annotations

import datetime as dt

from report.project.workbook.entries import Entry, block, table
from report.project.workbook.site_sheets import FRICTION_RUNS
from report.study.study_input import (
    Hazard,
    HazardPoint,
    Intensity,
    Mat,
    Study,
    StudyArray,
    StudyBuilding,
    StudyFrictionRun,
    StudyMotion,
)
from report.text.units import Quantity


def _unit_of_measure(intensity: str) -> str:
    return Intensity(intensity).unit if intensity else ""


STUDY = block("study", "Study", "Study", Study,
    "Fill in the yellow cells, then run roofslip study FOLDER.",
    Entry("Title", "title", "Mats of product X", note="Printed on the first page."),
    Entry("Prepared by", "prepared_by", "RG", note="Printed on the first page."),
    Entry("Date", "date", dt.date(2026, 3, 1), note="Printed on every page."),
    Entry("Primary units", "units_first", "US",
          note="Both systems are printed; this one is first."),
    Entry("Slopes", "slopes_deg", "0 to 7 by 1", "deg", note="Increasing, 0 or more: a list with a"
          " space after each comma, or a range such as 0 to 7 by 1."),
    Entry("Friction coefficients", "mus", "0.3 to 0.8 by 0.05",
          note="Increasing, greater than 0; added to those of the mats. Required without mats."),
    Entry("Intensity measure", "intensity", "PPA [g]", note="The motions are scaled to each"
          " intensity. PPA and PPV: peaks of the horizontal roof record. PGA: peak of a ground"
          " motion. S_DS: scaled from the S_DS below."),
    Entry("Intensities", "intensities", "0.1 to 2 by 0.1",
          note="Increasing, greater than 0; entered like the slopes."),
    Entry("S_DS of the motions", "s_ds_g", 1.0, "g",
          note="S_DS represented by the records. Required if the intensity measure is S_DS."),
    Entry("Rule set", "rule_set", "SEAOC PV1-2012",
          note="For the prescriptive displacement shown with the curves."),
    Entry("Allowed displacement", "allowed_m", 24.0, Quantity.SIZE,
          note="Limit for the lowest friction and the steepest slope. If blank, none."),
    Entry("Folder of motions", "folder", "records", note="Every record in it is a motion; files"
          " whose names differ only in the ending -x, -y or -z are its components. Leave blank if"
          " the Motions worksheet lists them."),
    Entry("Record units", "units", "from file", note="If the files do not state them."),
    Entry("Time step", "dt_s", 0.01, "s", note="If the files do not state it."),
    Entry("Polarity", "polarity", "both",
          note="Polarities in which each horizontal record is run."),
    Entry("Recorded at", "recorded_at", "roof",
          note="Ground motions are transferred to the roof with each building model."),
    Entry("Run without a value", "no_value", "exceedance", note="Uplift, or sliding at the end of"
          " the record: treated in a fragility as an exceedance, or censored at that intensity."),
    Entry("Intensity at the site", "site_intensity", 1.0, unit_from=("intensity", _unit_of_measure),
          note="Median, for the probability that a clearance is exceeded. If blank, none."),
    Entry("Dispersion of intensity", "intensity_beta", 0.2,
          note="Standard deviation of its logarithm."),
    Entry("Tolerance of slope", "slope_tolerance_deg", 0.25, "deg",
          note="Half the width of a uniform distribution."),
    Entry("Sampling", "sampling", "Latin hypercube", note="Latin hypercube of friction, slope and"
          " intensity; or every tested friction with the nominal slope and both slope limits, at"
          " the median intensity."),
    Entry("Samples", "samples", 200,
          note="Number of Latin hypercube samples; each is run under every motion."),
    Entry("Seed", "seed", 1, note="The same seed gives the same samples."),
    Entry("Record-to-record dispersion", "record_beta", 0.4, note="Used in the exported fragilities"
          " instead of that of the motions. Required for motions matched to one spectrum. If blank,"
          " that of the motions."),
    Entry("Record-to-record source", "record_source", "Hazard analysis, 2026",
          note="Required with the value."),
    Entry("Modeling dispersion", "modeling_beta", 0.25,
          note="Used in the exported fragilities. FEMA P-58: about 0.1 to 0.5. If blank, none."),
    Entry("Quality of data dispersion", "quality_beta", 0.25,
          note="Used in the exported fragilities. FEMA P-58: about 0.1 to 0.5. If blank, none."),
)  # fmt: skip

MATS = table("mats", "Mats", "Mats", Mat, "Optional. One row for each mat.",
    Entry("ID", "id", "EPDM pad", note="Short and unique."),
    Entry("Friction coefficient", "mu", 0.5,
          note="If blank, the geometric mean of the tested values."),
    Entry("Tested values", "tested", "0.47, 0.50, 0.53",
          note="Three or more, in any order; blank for none."),
    Entry("Report", "report", "Lab 12", note="Printed."),
)  # fmt: skip

ARRAYS = table("study_arrays", "Arrays", "Arrays", StudyArray,
    "Optional. One row for each fragility.",
    Entry("ID", "id", "A1", note="Short and unique."),
    Entry("Mat", "mat", "EPDM pad", note="ID on the Mats worksheet."),
    Entry("Slope", "slope_deg", 2.0, "deg", note="Slope of the roof."),
    Entry("Clearance", "clearance_m", 24.0, Quantity.SIZE, note="To the nearest object or edge."),
    Entry("Object", "reaches", "RTU-1",
          note="Object that the array strikes, or edge that it reaches."),
)  # fmt: skip

MOTIONS = table("motions", "Motions", "Motions", StudyMotion,
    "One row for each motion. Leave blank if the Study worksheet names a folder.",
    Entry("ID", "id", "M1", note="Short and unique."),
    Entry("Horizontal record", "record", "records/m1-x.csv",
          note="A file next to this workbook, or file | channel."),
    Entry("Transverse record", "transverse", "records/m1-y.csv",
          note="Second horizontal component."),
    Entry("Vertical record", "vertical", "records/m1-z.csv", note="Positive upward."),
    Entry("Source", "source", "Kobe 1995, JMA", note="Event and station."),
)  # fmt: skip

BUILDINGS = table("buildings", "Buildings", "Buildings", StudyBuilding,
    "Only for ground motions. One row for each building.",
    Entry("ID", "id", "T 0.3 s", note="Short and unique."),
    Entry("Period T1", "period_s", 0.3, "s", note="First mode."),
    Entry("Damping", "damping_percent", 5.0, "%",
          note="Damping of all modes, in percent of critical."),
    Entry("Lateral stiffness ratio", "stiffness_ratio", 4.0,
          note="H sqrt(GA/EI). If blank, shear deformation only."),
    Entry("Stories", "stories", 1, note="Number of stories of equal height."),
)  # fmt: skip

HAZARD = block("hazard", "Hazard", "Hazard at the site", Hazard,
    "Optional. Adds annual rates and the displacement in 25 years.",
    Entry("Hazard curve file", "file", "hazard-pga.csv", note="CSV next to this workbook: intensity"
          " and annual rate of exceedance in two columns, or as saved by the USGS hazard tool."
          " If blank, the table below is used, or no hazard."),
    Entry("Site", "site", "Los Angeles, 34.05, -118.25",
          note="Name and coordinates of the curve's site. Required with a curve."),
    Entry("Source of the curve", "source", "USGS, nshmp-haz",
          note="Author of the curve. Required with a curve."),
    Entry("Hazard model", "edition", "NSHM 2018, western US",
          note="Name and edition. Required with a curve."),
    Entry("Vs30 of the curve", "vs30_mps", 760, "m/s", note="Required with a curve."),
    Entry("Vs30 of the site", "site_vs30_mps", 260, "m/s", note="Required with a curve."),
    Entry("Factor to the site", "site_factor", 1.2,
          note="Intensity at the site / that of the curve. Required if the two Vs30 differ."),
    Entry("Basis of this factor", "site_basis", "ASCE 7-16 Table 11.8-1",
          note="Required with the factor."),
    Entry("Factor to the roof", "roof_factor", 3.0, note="Intensity at the roof / that at the site."
          " Required with roof motions; ground motions are transferred by the building models."),
    Entry("Basis of that factor", "roof_basis", "ASCE 7-16 13.3.1, z/h = 1",
          note="Required with the factor."),
    Entry("Re-centering above", "recenter_m", 6.0, Quantity.SIZE, note="Distance above which an"
          " array is moved back after an event; never and always are computed as well."),
    may_be_absent=True,
)  # fmt: skip

HAZARD_POINTS = table("hazard_points", "Hazard", "Hazard curve", HazardPoint,
    "Instead of a file. Start with the smallest intensity.",
    Entry("Intensity", "intensity", 0.5, note="PGA or Sa(1 s) [g], same as the intensity measure."),
    Entry("Annual rate", "annual_rate", 0.0021, note="Annual rate of exceedance [1/year]."),
    may_be_absent=True,
)  # fmt: skip

FRICTION = table("friction_runs", "Friction runs", "Friction test runs", StudyFrictionRun,
    "Optional. Same as the Friction tests worksheet of a project, for each mat. With a hazard,"
    " the runs replace the tested values.",
    *FRICTION_RUNS.entries,
    Entry("Mat", "mat", "EPDM pad", note="ID on the Mats worksheet."),
    may_be_absent=True,
)  # fmt: skip

STUDY_SECTIONS = (STUDY, MATS, ARRAYS, MOTIONS, BUILDINGS, HAZARD, HAZARD_POINTS, FRICTION)
"""Parts of the workbook, in its order; the key of each is its field of `StudyInput`."""
