"""One table of files: what each holds, what may be written otherwise, and each fault by its line.

Oracle: the wave that the samples were made of, typed again here; units by their definition.
"""

from dataclasses import dataclass
from functools import partial

import numpy as np
import pytest

from fixtures.errors import input_problems
from fixtures.paths import SAMPLES
from fixtures.spaces import spaced
from solver.formats import read_motion_file

pytestmark = pytest.mark.quick

G = 9.80665
# fmt: off
WAVE = np.array([0.25, -1.5, 12.125, -34.5, 98, -123.456, 77.125, -45.25, 30.5, -20, 15.75, -9.5,
                 6.25, -4, 2.5, -1.25, 0.75, -0.5, 0.25, -0.125, 0])
SMC_WAVE = np.where(WAVE == -123.456, -123.46, WAVE)
COUNTS = np.round(200 * WAVE[:20]), np.round(100 * WAVE[:20])
PEER = np.array([0.001, -0.0025, 0.125, 0.25, -0.5, 0.0625, -0.03125])
UNEVEN_S = [0, 0.012, 0.02, 0.033, 0.04, 0.052, 0.06, 0.071, 0.08, 0.092, 0.1, 0.111, 0.12]
UNEVEN = np.interp(np.arange(121) * 0.001, UNEVEN_S,
                   [0, 1.25, -2.5, 4, -6.125, 7.5, -5.25, 3.5, -2, 1, -0.5, 0.25, 0])
# fmt: on
ROOF = "Location: Roof"
OTHERS = ", the file has 1: the others are in other files, or the file is truncated"
RESAMPLED = (
    "times are uneven, steps of 0.007 to 0.013 s: resampled at 0.001 s by linear interpolation,"
    " which changes no sample"
)
SHARES = (10, 20, 40, 1, 2, 4)
BOREHOLE = "the sensor is in the borehole, not at the surface"
OFFSET = "uncorrected: the mean is {}; it is not removed"


@dataclass(frozen=True)
class Held:
    """What a file holds: channels with their samples [m/s2], to an absolute or relative error."""

    format: str
    dt_s: float
    channels: dict[str, np.ndarray]
    error: dict[str, float]
    notes: tuple[str, ...] = ()


EXACT = {"rel": 1e-14}
NORTH = f"(STA CHN: {{}}) {ROOF.upper()}, NORTH WALL"
HELD = {
    "cosmos.v1c": Held("COSMOS V1.20", 0.01, {
        f"Sta Chan 1: 360 deg (Rcrdr Chan 1) {ROOF}": WAVE / 1000 * G,
        f"Sta Chan 2: Up (Rcrdr Chan 2) {ROOF}": WAVE / 2000 * G,
    }, {"abs": 1.01e-5 * G}),
    # Milliseconds of the series, not the step of the record it was made of.
    "cosmos.v2c": Held("COSMOS V1.20", 0.0078125, {
        f"Sta Chan 1: 360 deg (Rcrdr Chan 1) {ROOF}": WAVE / 100,
    }, EXACT, (f"line 7 states 2 channels of the recorder{OTHERS}",)),
    "csmip-even.raw": Held("CSMIP V1", 0.005, {
        "Chan 1: 360 Deg": WAVE / 1000 * G,
        "Chan 2: Up": WAVE / 2000 * G,
    }, {"abs": 0.51e-6 * G}),
    # Touching fields are cut, and the step has all digits.
    "csmip-new.v2": Held("CSMIP V2", 1 / 128, {
        "Chan 1: 90 deg": 1.5 * WAVE / 100,
    }, EXACT, (f"line 6 states 2 channels of the recorder{OTHERS}",)),
    "csmip-old.v2": Held("CSMIP V2", 0.005, {
        f"CHAN 1: 360 DEG {NORTH.format(1)}": WAVE / 100,
        f"CHAN 2: UP {NORTH.format(2)}": -WAVE / 200,
    }, {"abs": 0.51e-5}),
    "csmip-pairs.v1": Held("CSMIP V1", 0.001, {
        "CHAN 1: 90 DEG (STA CHN: 1)": UNEVEN * G / 10,
    }, {"abs": 1e-12}, (
        f"line 5 states 3 channels of the recorder{OTHERS}",
        RESAMPLED,
        OFFSET.format("0.0123 g, 1.6% of the peak"),
    )),
    "usc.v1": Held("USC V1", 0.001, {"COMP N90E": UNEVEN * G / 10}, {"abs": 1e-12}, (
        RESAMPLED,
        OFFSET.format("0.0123 g, 1.6% of the peak"),
    )),
    # Of these heading and values are of volume 1, and the step is the duration by the points.
    "bhrc.v1": Held("BHRC V1", 0.005, {
        "COMP L1": WAVE / 1000 * G, "COMP V2": WAVE / 2000 * G, "COMP T3": WAVE / 4000 * G,
    }, {"abs": 0.51e-6 * G}),
    # Volume 1 whose line of values has a step and no format.
    "csmip-step.raw": Held("CSMIP V1", 0.005, {
        "Chan 1: 360 Deg": WAVE / 1000 * G,
    }, {"abs": 0.51e-6 * G}, (f"line 5 states 2 channels of the recorder{OTHERS}",)),
    "afad.txt": Held("AFAD text", 0.01, {
        "N-S": WAVE / 100, "E-W": WAVE / 200, "U-D": WAVE / 400,
    }, {"abs": 1.01e-8}),
    "esm.asc": Held("ESM, ITACA, AFAD .asc", 0.005, {"HNE": WAVE / 100}, {"abs": 1e-8}),
    "eqsig.txt": Held("count and step", 0.01, {"eqsig.txt": WAVE / 1e4}, {"abs": 1e-8}),
    "rspmatch.acc": Held("count and step", 0.01, {"rspmatch.acc": WAVE / 1000 * G}, {"abs": 1e-7}),
    # Uncorrected readings keep their offset, which the first component has.
    "geonet.v1a": Held("GeoNet V1A", 0.005, {
        "Component N28W": WAVE / 100 - 0.006,
        "Component S62W": WAVE / 200,
        "Component Up": WAVE / 400,
    }, {"abs": 1.01e-4}),
    "geonet.v2a": Held("GeoNet V2A", 0.02, {
        "Component N28W Longitudinal Accelerometer Axis": WAVE / 100,
        "Component S62W Transverse Accelerometer Axis": WAVE / 200,
        "Component Up Vertical Accelerometer Axis": WAVE / 400,
    }, {"abs": 1.01e-4}),
    # Counts are scaled and their offset is kept.
    "kiknet.ew1": Held("KiK-net", 0.005, {
        "EW1": (-2471 + COUNTS[1]) * 2000 / 8388608 / 100,
    }, EXACT, (
        OFFSET.format("-0.000597 g, 17% of the peak"),
        BOREHOLE,
    )),
    "kiknet.csv": Held("KiK-net CSV", 0.05, {
        name: WAVE[:20] / (100 * by)
        for name, by in zip(("NS1", "EW1", "UD1", "NS2", "EW2", "UD2"), SHARES, strict=True)
    }, {"abs": 0.51e-4}, tuple(f"{name}: {BOREHOLE}" for name in ("NS1", "EW1", "UD1"))),
    "knet.csv": Held("K-NET CSV", 0.05, {
        "N-S": WAVE[:20] / 100 + 0.01, "E-W": WAVE[:20] / 200, "U-D": WAVE[:20] / 400 - 0.1,
    }, {"abs": 0.51e-4}, (f"U-D: {OFFSET.format('-0.0102 g, 24% of the peak')}",)),
    "knet.ns": Held("K-NET", 0.01, {
        "N-S": (13186 + COUNTS[0]) * 3920 / 6182761 / 100,
    }, EXACT, (OFFSET.format("0.00855 g, 40% of the peak"),)),
    "peer-nga.at2": Held("PEER AT2", 0.005, {"180": PEER * G}, {"abs": 0.0}),
    "peer-old.at2": Held("PEER AT2", 0.005, {"180": PEER * G}, {"abs": 0.0}),
    "renadic.v1": Held("RENADIC V1", 0.005, {
        "CHAN 1: L (STA CHN: 1)": WAVE / 100 * G,
        "CHAN 2: V (STA CHN: 2)": WAVE / 200 * G,
        "CHAN 3: T (STA CHN: 3)": WAVE / 400 * G,
    }, {"abs": 0.51e-4 * G}),
    "smc-corrected.smc": Held("USGS SMC", 0.005, {"up": SMC_WAVE / 100}, EXACT),
    "smc-even.smc": Held("USGS SMC", 0.01, {
        "90": (0.25 * SMC_WAVE + 1.0) / 100,
    }, {"abs": 1.01e-5}, (OFFSET.format("0.00106 g, 3.5% of the peak"),)),
    # Pairs with a short line.
    "smc-uneven.smc": Held("USGS SMC", 0.001, {
        "45": UNEVEN / 10,
    }, {"abs": 1e-13}, (RESAMPLED, OFFSET.format("0.00126 g, 1.6% of the peak"))),
}  # fmt: skip


problems_of = partial(input_problems, read_motion_file)


@pytest.mark.parametrize("name", HELD)
def test_a_file_gives_its_channels_step_samples_and_notes(name):
    held, motion_file = HELD[name], read_motion_file(SAMPLES / name)
    assert motion_file.format == held.format
    assert spaced(motion_file.notes) == held.notes
    assert [record.name for record in motion_file.channels] == list(held.channels)
    for record in motion_file.channels:
        assert record.dt_s == held.dt_s
        assert record.a_mps2 == pytest.approx(held.channels[record.name], **held.error)


LEFT_OVER = " 1.1100E-1 9.5000E+1 1.1200E-1 9.4000E+1 1.1300E-1 9.3000E+1 1.1400E-1 9.2000E+1"


@pytest.mark.parametrize(
    ("changes", "note"),
    [
        # As in 16 of 16 public files; the line may go back in time.
        ([("1.2000E-1 0.0000E+0", f"1.2000E-1 0.0000E+0\n{LEFT_OVER}")],
         "line 34 is beyond the 26 values stated, and is skipped"),
        ([("        26  ", "        28  "),
          ("-2.5000E+1 3.3000E-2 4.0000E+1",
           "-2.4000E+1 2.0000E-2-2.6000E+1 3.3000E-2 4.0000E+1")],
         "repeated times: 1; the mean of their values is used"),
    ],
)  # fmt: skip
def test_film_may_have_a_line_more_than_stated_and_a_time_twice(altered, changes, note):
    motion_file = read_motion_file(altered("smc-uneven.smc", *changes))
    assert motion_file.channel().a_mps2 == pytest.approx(UNEVEN / 10, abs=1e-13)
    assert spaced(motion_file.notes) == (note, *HELD["smc-uneven.smc"].notes)


START = "2003-01-02 03:04:05"


@pytest.mark.parametrize(
    ("name", "start"),
    [
        ("cosmos.v1c", START),
        ("csmip-even.raw", "2003-01-02 11:04:05"),
        ("renadic.v1", START),
        ("knet.ns", "2003-01-02 03:04:20"),
        ("knet.csv", "2003-01-02 03:04:20"),
        ("esm.asc", START),
        ("afad.txt", START),
        ("geonet.v2a", "None"),
    ],
)
def test_a_heading_gives_the_start_where_its_format_names_one(name, start):
    assert str(read_motion_file(SAMPLES / name).start) == start


@pytest.mark.parametrize(
    "date", ["2/30/2003", "13/13/2003", "0/0/0000", "(none)", "12/31/9999 23:59:99 was"]
)
def test_a_start_that_is_no_date_is_none(altered, date):
    path = altered("renadic.v1", ("TRIGGER TIME: 1/2/2003", f"TRIGGER TIME: {date}"))
    assert read_motion_file(path).start is None


# What stays as it is where a heading is written otherwise: a factor of the samples, and notes
# that come with it.
READ_OTHERWISE = [
    ("geonet.v1a", 3 * [("units of 1.00 mm/s/s", "units of 0.80 mm/s/s")], 0.8, ()),
    # Units are named, coded or both; the peak of the real heading is in the unit of the values.
    ("cosmos.v2c", [("cm/sec2(04)", "cm/s^2 (4)")], 1.0, ()),
    ("cosmos.v2c", [("cm/sec2(04)", "(04)")], 1.0, ()),
    ("cosmos.v2c", [("cm/sec2(04)", "in/sec2(07)")], 2.54, ()),
    ("cosmos.v2c", [("(1E15.6)", "(1F15.6E)")], 1.0, ()),
    ("cosmos.v2c", [("End-of-data for Chan  1 acceleration", "")], 1.0,
     ("no end-of-data line follows the values; the file may be truncated",)),
    # The California Geological Survey leaves out a comma; quantities may be two words.
    ("cosmos.v1c", [("(02),Format", ".  (02)Format")], 1.0, ()),
    ("cosmos.v1c", 2 * [("acceleration pts", "uncor accel.   pts")], 1.0, ()),
    ("esm.asc", [("ACCELERATION", "UNPROCESSED ACCELERATION"), ("DURATION_S: 0.105\n", "")],
     1.0, ()),
    # As the University of Southern California writes them.
    ("csmip-old.v2", [(f"POINTS OF {quantity} DATA", f"POINTS OF {quantity[:3]} DATA")
                      for quantity in ("ACCEL", "VELOC", "DISPL")] * 2
     + [("SEC.  (UNITS: CM/SEC/SEC)", "SEC.  IN UNITS CM/SEC/SEC")] * 2, 1.0, ()),
    ("afad.txt", [("TURKIYE", "TURKEY"), ("made by hand for a test\r\n", "")], 1.0, ()),
    ("smc-corrected.smc", [("         2\r", "         1\r")], 1.0,
     ("states 1 lines of comment, found 2",)),
    ("knet.ns", [("Max. Acc. (gal)   ", "Max Acc. (gal)    ")], 1.0, ()),
    ("smc-uneven.smc", [("        26    -32768", "        13    -32768")], 1.0, ()),
    ("smc-corrected.smc", [("        21    -32768", "        21         1")], 1.0,
     ("the heading flags a problem with this record: read its comments",)),
]  # fmt: skip


@pytest.mark.parametrize(("name", "changes", "factor", "more"), READ_OTHERWISE)
def test_what_is_written_otherwise_holds_the_same(altered, name, changes, factor, more):
    held, motion_file = HELD[name], read_motion_file(altered(name, *changes))
    assert spaced(motion_file.notes) == held.notes + more
    for record in motion_file.channels:
        expected = factor * held.channels[record.name]
        assert record.a_mps2 == pytest.approx(expected, **held.error)


def test_sensors_and_steps_of_headings_are_taken(altered):
    path = altered("kiknet.ew1", ("Dir.              2", "Dir.              6"))
    motion_file = read_motion_file(path)
    assert motion_file.channel().name == "UD2"
    assert len(motion_file.notes) == 1
    path = altered("csmip-new.v2", ("  .0078125", "  .0000000"))
    assert read_motion_file(path).channel().dt_s == 0.008
    for dt_s in (1 / 128, 0.0084):
        assert read_motion_file(path, dt_s=dt_s).channel().dt_s == dt_s
    assert "but 0.0086 s was entered" in problems_of(path, dt_s=0.0086)[0]
    unknown = ("    -999.000000", "    -999.000000")
    steps = [("       7.812500", unknown[1]), ("       0.005000", unknown[1])]
    path = altered("cosmos.v2c", *steps)
    assert problems_of(path, dt_s=0.01) == (
        "cosmos.v2c:38: the heading states 0.164062 s, the record lasts 0.21 s; enter dt with more"
        " digits, or a file whose headings agree",
    )
    path = altered("cosmos.v2c", *steps, ("       0.164062", unknown[1]))
    assert read_motion_file(path, dt_s=0.01).channel().dt_s == 0.01


COUNT = "      21       0       0      21"
FAULTS = [
    ("geonet.v1a", [(COUNT, COUNT[:-2] + "22")], ":20: states 22 values, found 21"),
    ("geonet.v1a", [(COUNT, COUNT[:-4] + "none")],
     ":20: found no number of accelerations; use the complete"),
    ("cosmos.v2c", [("(1E15.6)", "(free)")], ":49: found format (free); enter one as (8F10.3)"),
    ("cosmos.v2c", [("cm/sec2(04)", "counts(50)")], ":49: found unit 'counts', code 50; use a fi"),
    ("cosmos.v2c", [("cm/sec2(04)", "g(04)")], ":49: found unit 'g' with code 4, which is cm/s2;"),
    ("cosmos.v2c", [("approx  0 secs", "approx  9 secs")], ":49: states about 9 s, count times st"),
    ("cosmos.v2c", [("Real-header", "Some")], ":1: found no block ... Real-header values follow"),
    ("cosmos.v2c", [("-123.456000", "-923.456000")], ":38: the header states a peak of 0.9417 g,"),
    ("cosmos.v2c", [("Corrected accel", "Raw accel")], ":1: found raw counts; use the volume 1"),
    ("cosmos.v2c", [("       7.812500", "       0.000000"), ("       0.005000", "       0.000000")],
     ":26: found no time step; enter the time step dt"),
    ("cosmos.v2c", [("21 acceleration pts", "21 velocity pts")],
     ": found no acceleration in this COSMOS V1.20 file; use a file of acceleration"),
    ("csmip-old.v2", [("  -45.250\r\n", "  -45.250   1.0000\r\n")], ":47: found 9 values; enter 8"),
    ("csmip-old.v2", [("   21 POINTS OF ACCEL", "   22 POINTS OF ACCEL")], ":46: states 22 values"),
    ("csmip-old.v2", [("AT  .005 SEC.", "AT  .050 SEC.")], ":46: found a step of 0.05 s and one o"),
    ("csmip-old.v2", [("  -123.456    CM", "  -923.456    CM")], ":18: the header states a peak o"),
    ("csmip-new.v2", [("  .0078125", "      .008"), ("  .1640625", "  .2640625")],
     ":38: the heading states 0.264062 s, the record lasts 0.168 s; enter dt"),
    ("renadic.v1", [("=     21", "=     26")], ":11: states 52 values, found 42; use the"),
    ("renadic.v1", [("NO. OF POINTS", "NO. OF THINGS")], ":1: found no line NO. OF POINTS"),
    ("renadic.v1", [("AND G/10.", "AND VOLT.")], ":12: found unit 'VOLT'; use an acceler"),
    ("renadic.v1", [("100.010  1.212", "100.000  1.212")], ":28: found time 100 s after 100"),
    ("csmip-even.raw", [("at 200 pts/sec", "at 0 pts/sec")], ":28: found time step 0 s; enter a"),
    ("geonet.v2a", [(" at 0.020 sec inter", " at 0.010 sec inter")], ":11: found a step of 0.01 s"),
    ("geonet.v2a", [("Acceleration:", "Accel:")], ":14: found no line Acceleration: peak ... mm/s"),
    ("geonet.v2a", [("  0.0000 -1234.6", "  0.0000 -9234.6")], ":24: the header states a peak of"),
    ("esm.asc", [("NDATA: 21", "NDATA: many")], ":18: found 'many'; enter the number of values"),
    ("esm.asc", [("DATA_TYPE: ACC", "DATA_TYPE: VELOCITY OR ACC"), ("cm/s^2", "cm/s")],
     ":21: found unit 'cm/s'; use"),
    ("esm.asc", [("ACCELERATION", "ACCELERATION RESPONSE SPECTRUM")], ":27: found acceleration"),
    ("esm.asc", [("-123.456000", "-923.456000")], ":23: the header states a peak of 0.9417 g, the"),
    ("esm.asc", [("\n0.750000", "\n0.7")], ":47: found '0.7', with fewer digits than all other"),
    ("esm.asc", [("0.005000", "0.050000")], ":19: the heading states 0.105 s, the record lasts"),
    ("afad.txt", [("NUMBER OF DATA                  : 21", "NUMBER OF DATA: 22")],
     ":13: states 66 values, found 63; use the complete file"),
    ("afad.txt", [("     0.062500\r", "\r")], ":19: found 2 values; enter 3"),
    ("afad.txt", [("(gal)            : (N", "(count)            : (N")], ":15: found unit 'count'"),
    ("knet.csv", [("#1\n#Offset", "#3\n#Offset")], ":12: the heading states 3 s, the record lasts"),
    ("knet.csv", [("13.12,", "13.12")], ":19: found 4 columns; enter 5"),
    ("knet.csv", [("(s),N-S(gal)", "(s),N-S[gal]")], ":16: found 'N-S[gal]'; enter a column as"),
    ("eqsig.txt", [("\n21 ", "\n20 ")], ":2: states 20 values, found 21; correct the count"),
    ("peer-nga.at2", [("PEER NGA", "ACCELERATION (CM/S2)")], ":3: found units CM/S2 and G;"),
    ("knet.ns", [("Duration Time(s)  0.2", "Duration Time(s)  0.3")], ":12: states 30 values, fou"),
    ("knet.ns", [("3920(gal)/6182761", "3920/6182761")], ":14: found '3920/6182761'; enter a"),
    ("knet.ns", [("6182761", "618276")], ":15: the header states a peak of 0.01599 g, the values"),
    ("knet.ns", [("Memo.", "Remark")], ": found no line Memo.; use the complete heading"),
    ("smc-corrected.smc", [("        21  ", "        22  ")], ":14: states 22 values, f"),
    ("smc-corrected.smc", [("         2\r", "         3\r")], ":30: found a line without | am"),
    ("smc-corrected.smc", [("-0.1234600E+03", "-0.9234600E+03")], ":23: the header states a pe"),
    ("smc-corrected.smc", [("2 CORRECTED ACCELEROGRAM", "3 VELOCITY")], ":1: found velocity"),
    ("smc-uneven.smc", [(" 2.0000E-2", " 1.1000E-2")], ":30: found time 0.011 s after 0.012 s,"),
    ("smc-uneven.smc", [("-6.1250E+1", "          ")], ":14: states 26 values, found 25; u"),
    ("smc-uneven.smc", [("-6.1250E+1", "          "), ("        26  ", "        25  ")],
     ":31: found 1 values; enter pairs of time and acceleration"),
]  # fmt: skip


@pytest.mark.parametrize(("name", "changes", "expected"), FAULTS)
def test_a_fault_is_told_with_its_line(altered, name, changes, expected):
    (problem,) = problems_of(altered(name, *changes))
    assert problem.startswith(f"{name}{expected}")
    if "CORRECTED ACC" in changes[0][0]:
        assert problem.endswith("; use a file of acceleration")


@pytest.mark.parametrize(
    ("name", "changes", "found"),
    [
        ("csmip-old.v2", [("   98.000", "   x8.000"), ("  -49.000", "  y49.000")],
         ("x8.000", "y49.000")),
        ("cosmos.v1c", [("    .01213", "    .0121x"), ("  .00606", "  .0060y")],
         (".0121x", ".0060y")),
    ],
)  # fmt: skip
def test_faults_of_all_channels_are_told_together_with_their_lines(altered, name, changes, found):
    path = altered(name, *changes)
    lines = path.read_text().splitlines()
    assert problems_of(path) == tuple(
        f"{name}:{1 + next(i for i, line in enumerate(lines) if text in line)}: found '{text}'; "
        "enter a number"
        for text in found
    )


# Units and step of a file, as its problem writes them; a unit and a step that are others.
STATED = [
    ("cosmos.v2c", "cm/s2", "cm/sec2", "g", "0.0078125", 0.01),
    ("csmip-old.v2", "gal", "CM/SEC/SEC", "g", "0.005", 0.02),
    ("geonet.v2a", "mm/s2", "mm/s/s", "g", "0.02", 0.005),
    ("knet.ns", "gal", "gal", "g", "0.01", 0.02),
    ("peer-nga.at2", "g", "G", "m/s2", "0.005", 0.01),
    ("smc-corrected.smc", "gal", "cm/s2", "mm/s2", "0.005", 0.01),
]


@pytest.mark.parametrize(("name", "units", "written", "other", "step", "other_s"), STATED)
def test_what_the_caller_says_must_agree(name, units, written, other, step, other_s):
    path, held = SAMPLES / name, HELD[name]
    agreed = read_motion_file(path, units=units, dt_s=float(step))
    assert [record.dt_s for record in agreed.channels] == [held.dt_s] * len(held.channels)
    told = problems_of(path, units=other)
    said = f"the file is in {written} but units are {other}; enter the file's units, or none"
    assert all(one.startswith(f"{name}:") and one.endswith(said) for one in told)
    told = problems_of(path, dt_s=other_s)
    said = f"the time step of the file is {step} s but {other_s:g} s was entered; enter"
    assert all(said in one for one in told)


def test_a_cut_file_and_one_without_units_say_so(file):
    text = (SAMPLES / "csmip-new.v2").read_text()
    motion_file = read_motion_file(file(text[: text.index("points of displ")]))
    assert motion_file.channel().a_mps2 == pytest.approx(1.5 * WAVE / 100, rel=1e-14)
    assert motion_file.notes[1:] == (
        "no end-of-data line (/&) follows the values; the file may be truncated",
    )
    bare = "SOMETHING\nELSE\n\nNPTS= 2, DT= .01 SEC\n1 2\n"
    assert problems_of(file(bare))[0].startswith("roof.csv: found no unit of acceleration; enter")
    record = read_motion_file(file(bare), units="gal").channel()
    assert (record.name, record.a_mps2.tolist()) == ("roof.csv", [0.01, 0.02])


SERIES = "2 acceleration pts, approx 0 secs, units=g(02),Format=(8F10.3)\n"
PEER_HEADING = """PEER STRONG MOTION DATABASE RECORD. PROCESSING BY HAND.
MADE-UP VALLEY 01/02/03 0405, NO SUCH SCHOOL, 180
ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.1 Hz LP=40.0 Hz
"""


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        ("RESPONSE AND FOURIER AMPLITUDE SPECTRA\nCORRECTED ACCELEROGRAM\n",
         ":1: found spectra; use a volume 1 or 2 file"),
        ("Corrected acceleration    (Format v01.20 with 13 text lines)\n" + SERIES * 2000,
         ": found 2000 channels; enter at most 1000 in a file"),
        ("PEER\nX, Y, 1\nVELOCITY TIME HISTORY IN UNITS OF CM/S\nNPTS= 2, DT= .01 SEC\n1 2\n",
         ":3: found velocity; use the file of acceleration"),
    ],
)  # fmt: skip
def test_what_is_no_record_is_refused(file, content, expected):
    assert problems_of(file(content)) == (f"roof.csv{expected}",)


@pytest.mark.parametrize(
    "line",
    [
        "NPTS=  3, DT=   .0100 SEC",
        "NPTS=  3, DT= .01000 SEC,",
        "NPTS = 3 DT = 1.0E-2",
        "3, .01 NPTS, DT",
        "NPTS=  3, DT=  10 MSEC",
        "NPTS=  3, DT (ms) = 10",
        "NPTS=3, SAMPLING RATE= 100 HZ",
        "NPTS = 9, DT = 1.0\nMORE\n\nOLD HEADING ABOVE\nNPTS=  3, DT= .01 SEC , FACTOR= 1.0",
    ],
)
def test_count_and_step_are_found_however_they_are_set(file, line):
    record = read_motion_file(file(f"{PEER_HEADING}{line}\n .1E+00 -.2D+00\n3.\n\n")).channel()
    assert record.dt_s == 0.01
    assert record.a_mps2.tolist() == [0.1 * G, -0.2 * G, 3.0 * G]


@pytest.mark.parametrize(
    "line", ["Acceleration in g", "The units are (g)", "Accelerations (in g's)", "# UNITS: G"]
)
def test_the_unit_of_a_count_and_step_is_found_however_it_is_said(file, line):
    content = f"A, B\nX, Y, STATION (MG), 180\n{line}\nNPTS= 3, DT= .01 SEC\n1 2 3\n"
    assert read_motion_file(file(content)).channel().a_mps2.tolist() == [G, 2.0 * G, 3.0 * G]


@pytest.mark.parametrize("unit", ["0.01 G", "1/100 G", "G*1000", "G X 1000", "10 CM/S/S"])
def test_a_multiple_of_a_unit_above_a_count_is_refused(file, unit):
    heading = PEER_HEADING.replace("OF G", f"OF {unit}")
    path = file(f"{heading}NPTS= 3, DT= .01 SEC\n1 -2 3\n")
    (problem,) = input_problems(read_motion_file, path, units="g")
    assert f": found '{unit}', a multiple of a unit; convert the values" in problem


def test_a_factor_above_a_count_is_noted(file):
    path = file(f"SCALE FACTOR = 2.0\n{PEER_HEADING}NPTS= 3, DT= .01 SEC\n1 -2 3\n")
    (note,) = read_motion_file(path).notes
    assert note == "line 1 states 'SCALE FACTOR = 2.0': no factor is applied"


def test_volume_2_of_usc_has_the_unit_of_its_peak_and_no_end(file):
    text = (SAMPLES / "csmip-old.v2").read_text()
    first = text[: text.index("/&")].replace("NO SUCH SCHOOL", "STATION USC# 0000", 1)
    first = first.replace(".  (UNITS: CM/SEC/SEC)", ".").replace("CM/SEC/SEC", "CMS/SEC/SEC")
    motion_file = read_motion_file(file(first))
    assert (motion_file.format, motion_file.notes[1:]) == ("USC V2", ())
    assert motion_file.channels[0].a_mps2 == pytest.approx(WAVE / 100, abs=0.51e-5)


def test_a_station_of_csmip_may_be_at_usc(file):
    text = (SAMPLES / "csmip-even.raw").read_text().replace("No Such School", "LA - USC School")
    motion_file = read_motion_file(file(text))
    assert motion_file.format == "CSMIP V1"
    assert motion_file.channels[0].a_mps2 == pytest.approx(WAVE / 1000 * G, abs=0.51e-6 * G)


@pytest.mark.parametrize("values", ["1.0, 2, 3,", "1.0,2,3.0", "1E0\t2\t3\t", " 1.00 2.00 3.00"])
def test_values_below_a_count_are_apart_by_commas_tabs_and_signs(file, values):
    content = f"{PEER_HEADING}NPTS= 6, DT= .01 SEC\n{values}\n-1.0000E+00-2.0000E+00-3.\n"
    g = [round(value / G, 9) for value in read_motion_file(file(content)).channel().a_mps2]
    assert g == [1.0, 2.0, 3.0, -1.0, -2.0, -3.0]


@pytest.mark.parametrize(
    ("line", "values", "expected"),
    [
        (
            "NPTS= 6, DT= .01 SEC",
            "0 1\n.01 2\n.02 3\n.03 1\n.04 1\n.05 2",
            "4: states 6 values, found times next to them; delete the lines above the times, and"
            " enter a heading such as time_s,acc_g",
        ),
        ("NPTS= 3, DT= 5 USEC", "1 2 3", "4: found a step in usec; enter it in s, ms or min"),
        ("NPTS= 4, DT= .01 SEC", "1 2 3", "4: states 4 values, found 3; use the complete file"),
        ("NPTS= 3, DT= SEC", "1 2 3", "4: found no time step; enter the time step dt"),
        ("NPTS= 3, DT= 0.0 SEC", "1 2 3", "4: found time step 0 s; enter a number above 0"),
        ("NPTS: 3", "1 2 3", "4: found 'NPTS: 3'; enter the count and the step as in NPTS="),
        ("NPTS= 3, DT= .01 SEC", "1 wide 3", "5: found 'wide'; enter a number"),
        ("NPTS= 0, DT= .01 SEC", "", "4: states 0 values; enter at least 2"),
    ],
)
def test_faults_of_a_short_file_are_told_with_their_line(file, line, values, expected):
    (problem,) = problems_of(file(f"{PEER_HEADING}{line}\n{values}\n"))
    assert problem.startswith(f"roof.csv:{expected}")
