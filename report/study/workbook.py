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


STUDY = block("study", "Study", "Study", Study, "Fill in, then run roofslip study FOLDER.",
    Entry("Title", "title", "Mats of product X", note="Printed on the first page."),
    Entry("Prepared by", "prepared_by", "RG", note="Printed on the first page."),
    Entry("Date", "date", dt.date(2026, 3, 1), note="Printed on every page."),
    Entry("Primary units", "units_first", "US", note="Units printed first."),
    Entry("Slopes", "slopes_deg", "0 to 7 by 1", "deg", note="Increasing, 0 or more: a list with a"
          " blank after each comma, or from, to and step."),
    Entry("Friction coefficients", "mus", "0.3 to 0.8 by 0.05",
          note="Increasing, above 0, in addition to those of the mats. Required without mats."),
    Entry("Intensity measure", "intensity", "PPA [g]", note="The motions are scaled to each"
          " intensity: PPA and PPV are peaks of the horizontal record at the roof, PGA of a ground"
          " motion; S_DS scales from the S_DS below."),
    Entry("Intensities", "intensities", "0.1 to 2 by 0.1",
          note="Increasing, above 0, given like the slopes."),
    Entry("S_DS of the motions", "s_ds_g", 1.0, "g",
          note="S_DS that the records represent. Required with S_DS."),
    Entry("Rule set", "rule_set", "SEAOC PV1-2012",
          note="For the prescriptive displacement beside the curves."),
    Entry("Allowed displacement", "allowed_m", 24.0, Quantity.SIZE,
          note="Used for the lowest friction and the steepest slope. Blank for none."),
    Entry("Folder of motions", "folder", "records", note="Every record in it is a motion; files"
          " that differ only in an ending -x, -y or -z are the components of one. Blank if the"
          " Motions worksheet lists them."),
    Entry("Record units", "units", "from file", note="If the files do not state them."),
    Entry("Time step", "dt_s", 0.01, "s", note="If the files do not state it."),
    Entry("Polarity", "polarity", "both", note="Signs in which each horizontal record is run."),
    Entry("Recorded at", "recorded_at", "roof",
          note="Ground motions are carried through each building."),
    Entry("Run without a value", "no_value", "exceedance", note="Uplift, or sliding at the end of"
          " the record: counted in a fragility as an exceedance, or censored at that intensity."),
    Entry("Intensity at the site", "site_intensity", 1.0, unit_from=("intensity", _unit_of_measure),
          note="Median; gives the probability that a clearance is exceeded. Blank for none."),
    Entry("Dispersion of intensity", "intensity_beta", 0.2,
          note="Standard deviation of its logarithm."),
    Entry("Tolerance of slope", "slope_tolerance_deg", 0.25, "deg",
          note="Half the width of a uniform distribution."),
    Entry("Sampling", "sampling", "Latin hypercube", note="Latin hypercube of friction, slope and"
          " intensity; or every tested friction with the slope at its tolerances and middle, and"
          " the median intensity."),
    Entry("Samples", "samples", 200, note="Of the Latin hypercube, each under every motion."),
    Entry("Seed", "seed", 1, note="The same seed gives the same samples."),
    Entry("Record-to-record dispersion", "record_beta", 0.4, note="Of the exported fragilities,"
          " instead of that of the motions. Required for motions matched to one spectrum. Blank:"
          " that of the motions."),
    Entry("Record-to-record source", "record_source", "Hazard analysis, 2026",
          note="Required with the value."),
    Entry("Modeling dispersion", "modeling_beta", 0.25,
          note="Of the exported fragilities. FEMA P-58 has about 0.1 to 0.5. Blank: not included."),
    Entry("Quality of data dispersion", "quality_beta", 0.25,
          note="Of the exported fragilities. FEMA P-58 has about 0.1 to 0.5. Blank: not included."),
)  # fmt: skip

MATS = table("mats", "Mats", "Mats", Mat, "One row for each mat; optional.",
    Entry("ID", "id", "EPDM pad", note="Short and unique."),
    Entry("Friction coefficient", "mu", 0.5,
          note="Blank: the geometric mean of the tested values."),
    Entry("Tested values", "tested", "0.47, 0.50, 0.53",
          note="Three or more, in any order; blank for none."),
    Entry("Report", "report", "Lab 12", note="Printed."),
)  # fmt: skip

ARRAYS = table("study_arrays", "Arrays", "Arrays", StudyArray,
    "Optional: one row for each fragility.",
    Entry("ID", "id", "A1", note="Short and unique."),
    Entry("Mat", "mat", "EPDM pad", note="ID on the Mats worksheet."),
    Entry("Slope", "slope_deg", 2.0, "deg", note="Of the roof."),
    Entry("Clearance", "clearance_m", 24.0, Quantity.SIZE, note="To the nearest object or edge."),
    Entry("Object", "reaches", "RTU-1", note="What it strikes, or the edge it reaches."),
)  # fmt: skip

MOTIONS = table("motions", "Motions", "Motions", StudyMotion,
    "One row for each motion; leave blank if the Study worksheet names a folder.",
    Entry("ID", "id", "M1", note="Short and unique."),
    Entry("Horizontal record", "record", "records/m1-x.csv",
          note="A file beside this workbook, or file | channel."),
    Entry("Transverse record", "transverse", "records/m1-y.csv",
          note="Second horizontal component."),
    Entry("Vertical record", "vertical", "records/m1-z.csv", note="Positive upward."),
    Entry("Source", "source", "Kobe 1995, JMA", note="Event and station."),
)  # fmt: skip

BUILDINGS = table("buildings", "Buildings", "Buildings", StudyBuilding,
    "Only for ground motions: one row each.",
    Entry("ID", "id", "T 0.3 s", note="Short and unique."),
    Entry("Period T1", "period_s", 0.3, "s", note="First mode."),
    Entry("Damping", "damping_percent", 5.0, "%", note="Of all modes."),
    Entry("Lateral stiffness ratio", "stiffness_ratio", 4.0,
          note="H sqrt(GA/EI). Blank: shear deformation only."),
    Entry("Stories", "stories", 1, note="Of equal height."),
)  # fmt: skip

HAZARD = block("hazard", "Hazard", "Hazard at the site", Hazard,
    "Optional: gives rates in years and the displacement of 25 years.",
    Entry("Hazard curve file", "file", "hazard-pga.csv", note="CSV beside this workbook: intensity"
          " and annual rate of exceedance in two columns, or as saved by the USGS hazard tool."
          " Blank: the table below, or no hazard."),
    Entry("Site", "site", "Los Angeles, 34.05, -118.25",
          note="Of the curve: name and coordinates. Required with a curve."),
    Entry("Source of the curve", "source", "USGS, nshmp-haz",
          note="Who computed it. Required with a curve."),
    Entry("Hazard model", "edition", "NSHM 2018, western US",
          note="Name and edition. Required with a curve."),
    Entry("Vs30 of the curve", "vs30_mps", 760, "m/s", note="Required with a curve."),
    Entry("Vs30 of the site", "site_vs30_mps", 260, "m/s", note="Required with a curve."),
    Entry("Factor to the site", "site_factor", 1.2,
          note="Intensity at the site / that of the curve. Required where their Vs30 differ."),
    Entry("Basis of this factor", "site_basis", "ASCE 7-16 Table 11.8-1",
          note="Required with the factor."),
    Entry("Factor to the roof", "roof_factor", 3.0, note="Intensity at the roof / that at the site."
          " Required with roof motions; ground motions are carried through the buildings."),
    Entry("Basis of that factor", "roof_basis", "ASCE 7-16 13.3.1, z/h = 1",
          note="Required with the factor."),
    Entry("Re-centering above", "recenter_m", 6.0, Quantity.SIZE, note="Distance above which an"
          " array is put back after an event, beside never and always. Blank: those alone."),
    may_be_absent=True,
)  # fmt: skip

HAZARD_POINTS = table("hazard_points", "Hazard", "Hazard curve", HazardPoint,
    "In place of a file, from the smallest intensity.",
    Entry("Intensity", "intensity", 0.5, note="PGA or Sa(1 s) [g]: as the intensity measure."),
    Entry("Annual rate", "annual_rate", 0.0021, note="At which it is exceeded [1/year]."),
    may_be_absent=True,
)  # fmt: skip

FRICTION = table("friction_runs", "Friction runs", "Runs of the friction tests", StudyFrictionRun,
    "Optional: as on the Friction tests worksheet of a project, for each mat. With a hazard,"
    " they replace the tested values.",
    *FRICTION_RUNS.entries,
    Entry("Mat", "mat", "EPDM pad", note="ID on the Mats worksheet."),
    may_be_absent=True,
)  # fmt: skip

STUDY_SECTIONS = (STUDY, MATS, ARRAYS, MOTIONS, BUILDINGS, HAZARD, HAZARD_POINTS, FRICTION)
"""Parts of the workbook, in its order; the key of each is its field of `StudyInput`."""
