"""The worksheets of the motions: Motions, Building, Spectrum and Links."""

from __future__ import annotations

from report.project.model.array import Links
from report.project.model.choices import Scaling
from report.project.model.motion_input import BuildingInput, MotionInput, SpectrumPoint, TargetInput
from report.project.workbook.entries import Entry, block, table
from report.text.units import Quantity


def _unit_of_scaling(scaling: str) -> str:
    return "g" if scaling == Scaling.PPA else ""


MOTIONS = table("motions", "Motions", "Roof motions", MotionInput, "One row for each motion;"
    " without any, no analysis is run. Records are files next to this workbook (file, or file |"
    " channel) or columns pasted into a worksheet (Sheet!Header). Columns to the right of Source"
    " are optional.",
    Entry("ID", "id", "M1", note="Short and unique, such as M1."),
    Entry("Horizontal record", "record", "records/m1-x.csv", note="A file next to this workbook, or"
          " Sheet!Header of a pasted column. If the file has several channels: file | channel, by"
          " name or number."),
    Entry("Transverse record", "transverse", "records/m1-y.csv", note="Second horizontal component;"
          " blank for none. Each component is run along the slope, and the larger displacement is"
          " used."),
    Entry("Vertical record", "vertical", "records/m1-z.csv",
          note="Entered like the horizontal record, positive upward; blank for none."),
    Entry("Record units", "units", "from file",
          note="Units of all components, if the files do not state them."),
    Entry("Time step", "dt_s", 0.01, "s", usual=(0.001, 0.02),
          note="Leave blank if the file states it or has a time column."),
    Entry("Scaling", "scaling", "as recorded", note="By a factor, to a PPA (peak of the horizontal"
          " record), or to the target spectrum over the scaling periods on the Building worksheet."
          " All components get the same factor."),
    Entry("Factor or PPA", "scale_value", 1.0, usual=(0.2, 5.0),
          unit_from=("scaling", _unit_of_scaling),
          note="The factor, or the PPA in g; blank for other types of scaling."),
    Entry("Polarity", "polarity", "both", is_rare=True, note="Both: each horizontal component is"
          " run as recorded and reversed, and the larger displacement is used."),
    Entry("Source", "source", "Spectrum-compatible, seed 1",
          note="Event, station and processing, printed in the package."),
    Entry("Recorded at", "recorded_at", "roof",
          note="Ground motions are transferred to the roof with the building model on the Building"
          " worksheet."),
    Entry("Start time", "from_s", 2.0, "s", is_rare=True, former="Keep from",
          note="Measured from the first sample; blank: first sample."),
    Entry("End time", "to_s", 40.0, "s", is_rare=True, former="Keep to",
          note="Measured from the first sample; blank: last sample."),
    Entry("Baseline", "baseline", "linear", is_rare=True,
          note="Fitted to the acceleration and subtracted."),
    Entry("High-pass corner", "highpass_hz", 0.1, "Hz", is_rare=True,
          note="Zero-phase; blank for none. Removing long periods also removes some slip; the"
          " package states how much."),
    Entry("Low-pass corner", "lowpass_hz", 40.0, "Hz", is_rare=True,
          note="Zero-phase; blank for none."),
    Entry("Filter order", "order", 4, is_rare=True,
          note="Order of both filters. The power at the corner is one half."),
    Entry("New time step", "new_dt_s", 0.005, "s", is_rare=True,
          note="Resampled without aliasing; blank: unchanged."),
    Entry("Zero padding", "pad_s", 5.0, "s", is_rare=True, former="Zeros at the end",
          note="Added at the end, for the array to come to rest; blank: none."),
    Entry("Event", "event", "Kobe 1995", is_rare=True,
          note="Earthquake and year of a record; blank for a generated motion."),
    Entry("M", "magnitude", 6.9, usual=(5.0, 8.5), is_rare=True,
          note="Moment magnitude of the event of a record."),
    Entry("R", "distance_km", 7.1, "km", usual=(0.0, 150.0), is_rare=True,
          note="Distance of the recording station from the rupture."),
    Entry("V_s30", "v_s30_mps", 312.0, "m/s", usual=(150.0, 1500.0), is_rare=True,
          note="Mean shear-wave velocity of the upper 30 m at the station."),
    Entry("Permanent displacement by", "drift_by", "RG, SE", is_rare=True,
          note="Only if the ground or the roof was permanently displaced: who confirms it. Required"
          " with the source."),
    Entry("Permanent displacement source", "drift_source", "GNSS at the station", is_rare=True,
          note="Evidence that the displacement is real. Without both entries, a record with a"
          " final displacement above 0.5 m is not accepted for the analysis."),
)  # fmt: skip

BUILDING = block("building", "Building", "Building between ground and roof", BuildingInput,
    "Required only for ground motions: enter period T1 or a structure type.",
    Entry("Structure type", "structure", "other", note="Determines the approximate period"
          " C_t h^x of ASCE 7, 12.8.2.1, with h from the Site worksheet. Leave blank if period T1"
          " is entered."),
    Entry("Period T1", "period_s", 0.62, "s", usual=(0.05, 3.0), note="First mode, from analysis or"
          " measurement. More accurate than C_t h^x, which is intended to be a low estimate."),
    Entry("Period T2", "period_2_s", 0.2, "s", usual=(0.02, 1.0),
          note="Second mode, if known. If blank, that of a uniform beam."),
    Entry("Period T1, transverse", "transverse_s", 0.55, "s", usual=(0.05, 3.0),
          note="First mode in the direction of the transverse record. If blank, equal to T1."),
    Entry("Damping", "damping_percent", 5.0, "%", usual=(1.0, 10.0),
          note="Damping of all modes, in percent of critical."),
    Entry("Lateral stiffness ratio", "stiffness_ratio", 4.0, note="H sqrt(GA/EI): 0 for shear"
          " walls, 1.5 to 6 for walls with frames, over 20 for moment frames. If blank,"
          " shear deformation only."),
    Entry("Modal truncation limit", "left_out_percent", 5.0, "%", former="Modes may leave out",
          note="Largest combined contribution of the omitted modes, in percent of the peak roof"
          " acceleration."),
    may_be_absent=True,
)  # fmt: skip

SPECTRUM = table("spectrum", "Spectrum", "Project-specific target spectrum", SpectrumPoint,
    "Optional. Replaces the AC156 spectrum for roof motions, or the design spectrum for ground"
    " motions. 5% damping, at least two rows.",
    Entry("Period", "period_s", 1.0, "s",
          note="Each period once, in any order. Interpolated on log-log axes."),
    Entry("Horizontal", "horizontal_g", 0.8, "g", note="Pseudo-acceleration, 5% damping."),
    Entry("Vertical", "vertical_g", 0.4, "g",
          note="In every row, or blank in every row to use AC156."),
    may_be_absent=True,
)  # fmt: skip

LINKS = table("links", "Links", "Rows of linked blocks", Links, "Optional. One row for each array"
    " to be compared with a row of linked blocks. The blocks have equal"
    " weights and lie in a row along the slope.",
    Entry("Array", "array", "A1", note="ID of the array. One row per array."),
    Entry("Block friction", "friction", "0.40, 0.45, 0.50", former="Friction of blocks",
          note="2 to 20 friction coefficients separated by commas, from the upslope block to the"
          " downslope block. Their range must include the array's coefficient."),
    Entry("Link stiffness", "stiffness_n_per_m", 5000.0, Quantity.STIFFNESS,
          note="Axial force per unit elongation or shortening of a link."),
    Entry("Link damping", "damping_ratio", 0.02,
          note="Damping ratio of one block on one link. If blank, none."),
    may_be_absent=True,
)  # fmt: skip

TARGET = block("target", "Building", "Target spectrum and scaling", TargetInput,
    "The default target is the AC156 spectrum for roof motions and the ASCE 7 design spectrum for"
    " ground motions.",
    Entry("AC156 below 1.3 Hz", "tail", "AC156",
          note="The AC156 line, or 1/T for periods above 0.77 s as PV1-2012 Sec. 9 permits."),
    Entry("Long-period transition T_L", "t_l_s", 8.0, "s", below=("site", "s_d1_g"), sheet="Site",
          note="ASCE 7, 11.4.6. Used with S_1 and F_v for the design spectrum of ground motions."),
    Entry("Shortest scaling period", "from_s", 0.2, "s", former="Scaling periods from",
          note="For motions scaled to the target spectrum."),
    Entry("Longest scaling period", "to_s", 5.0, "s", former="Scaling periods to",
          note="Long periods govern sliding: use more than 0.77 s (1.3 Hz)."),
    may_be_absent=True,
)  # fmt: skip
