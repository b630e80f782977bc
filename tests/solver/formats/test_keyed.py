"""Headings of `KEY: value` lines of eight networks. Oracle: a wave that is printed below them."""

import math

import numpy as np
import pytest

from fixtures.errors import input_problems
from fixtures.spaces import spaced
from solver.formats import read_motion_file, read_record

pytestmark = pytest.mark.quick

WAVE = [round(98.1 * math.sin(0.3 * k) * math.exp(-0.01 * k), 3) for k in range(200)]
PEAK = max(WAVE, key=abs)


def across(values, per_line=8):
    rows = [values[k : k + per_line] for k in range(0, len(values), per_line)]
    return "\n".join(" ".join(f"{value:.6E}" for value in row) for row in rows) + "\n"


def columns(*shares, mark=" ", times=False):
    rows = [
        ([f"{0.01 * k:.2f}"] if times else []) + [f"{share * value:.4f}" for share in shares]
        for k, value in enumerate(WAVE)
    ]
    return "\n".join(mark.join(row) for row in rows) + "\n"


CSMNC = f"""065XXX010101010101
0010101010101 2001-01-01 01:01:01 BTM
EPICENTER  39.900N 77.300E DEPTH 9 KM
STATION: 65XXX 39.700N 77.500E
COMP. EW
UNCORRECTED ACCELERATION          UNIT: CM/SEC/SEC
NO. OF POINTS:  200  EQUALLY SPACED INTERVALS OF:  0.010  SEC
PEAK VALUE:    {PEAK}   AT   0.9 SEC    DURATION:  2 SEC
PRE-EVENT TIME:  0  SEC  RECORDER TIME:  2001-01-01 01:01:02.000 BTM
CSMNC

{across(WAVE)}"""
ISESD = f"""file:                         000000xa.cor
station code:                    694
waveform code:                  2727
orientation of transducer:    NS
sensitivity:                  20.00V/g
time of first sample:         31.12.1999 04:55:53.671UTC
sampling period:               0.010000s
number of samples:             200
record length:                 1.990s
units:                        m/s*s, m/s & s
comments & processing history:
%- pre-processed by hand
-> corrected acceleration time histories
{across([value / 100 for value in WAVE])}-> corrected velocity time histories
{across([value / 1000 for value in WAVE])}"""
CWA = f"""#Station Information
#StationCode: ECU
#InstrumentKind: CV574(06106600.CVA)
#StartTime(GMT+08): 2018/02/06-23:50:29.000
#RecordLength(sec): 2
#SampleRate(Hz): 100
#AmplitudeUnit:  gal. DCoffset(corr)
#AmplitudeMAX. U:   {max(WAVE) / 2:.3f}~  {min(WAVE) / 2:.3f}
#AmplitudeMAX. N:   {max(WAVE):.3f}~  {min(WAVE):.3f}
#AmplitudeMAX. E:   {-min(WAVE):.3f}~  {-max(WAVE):.3f}
#DataSequence: Time U(+); N(+); E(+)
#Data: 4F10.3
{columns(0.5, 1, -1, times=True)}"""
JMA = f"""SITE CODE= 47678ABC,37.5,137.2,16,7.6
 LAT.=  37.0
 SAMPLING RATE= 100Hz
 UNIT  = gal(cm/s/s)
 INITIAL TIME = 2024 01 01 16 10 00
 NS,EW,UD
{columns(1, 0.5, -1, mark=",")}"""
UNAM = f"""INSTITUTO DE INGENIERIA, UNAM
ARCHIVO ESTANDAR DE ACELERACION:
VERSION DEL FORMATO                    : 2.0
ORIENTACION C1-C6                     : /N00E/V/N90W/
INTERVALO DE MUESTREO, C1-C6 (s)      : /0.01/0.01/0.01/
NUM. TOTAL DE MUESTRAS, C1-C6         : /200/200/200/
NUM. TOTAL DE MUESTRAS, C7-C12        :
ACEL. MAX.(Gal), C1-C6                : /{PEAK}/{PEAK / 2}/{-PEAK}
ACEL. MAX., C1-C6, EN LA MUESTRA      : /13642/13759/14358
UNIDADES DE LOS DATOS                 : Gal (cm/s/s)
DATOS DE ACELERACION:
---------+---------+---------+---------+---------+---------+---------+---------+
   CANAL-1   CANAL-2   CANAL-3
{columns(1, 0.5, -1)}"""
SPANISH = f"""Estacion: NADA
Componente: EW
Frecuencia de muestreo (Hz): 100
Numero de muestras: 200
Aceleracion maxima (cm/s2): {PEAK}
Unidades: cm/seg2
{columns(1)}"""
READ = {
    "CSMNC": (CSMNC, "2001-01-01 01:01:02", {"EW": 1}),
    "ISESD": (ISESD, "1999-12-31 04:55:53.671000", {"NS": 1}),
    "CWA": (CWA, "2018-02-06 23:50:29", {"U": 0.5, "N": 1, "E": -1}),
    "JMA": (JMA, "2024-01-01 16:10:00", {"NS": 1, "EW": 0.5, "UD": -1}),
    "UNAM": (UNAM, "None", {"N00E": 1, "V": 0.5, "N90W": -1}),
    "KEY: value": (SPANISH, "None", {"EW": 1}),
}


@pytest.mark.parametrize("form", READ)
def test_a_heading_gives_step_unit_components_and_start(file, form):
    content, start, shares = READ[form]
    motion_file = read_motion_file(file(content))
    assert (motion_file.format, str(motion_file.start)) == (form, start)
    offset = ("uncorrected: the mean is 0.00188 g, 2% of the peak; it is not removed",)
    assert spaced(motion_file.notes) == (offset if form == "CSMNC" else ())
    if len(shares) > 1:
        assert [record.name for record in motion_file.channels] == list(shares)
    for record, share in zip(motion_file.channels, shares.values(), strict=True):
        assert record.dt_s == 0.01
        assert record.a_mps2 == pytest.approx(0.01 * share * np.array(WAVE), abs=1e-6)


@pytest.mark.parametrize(
    ("content", "change", "problem"),
    [
        (CSMNC, (f"VALUE:    {PEAK}", "VALUE:    9.3"), ":8: the header states a peak of"),
        (CSMNC, ("POINTS:  200", "POINTS:  208"), ":7: states 208 values, found 200; use the c"),
        (CSMNC, ("0.010  SEC", "10  USEC"), ":7: found a step in usec; enter it in s, ms or min"),
        (ISESD, ("samples:             200", "samples:             208"), ":8: states 208 values"),
        (ISESD, ("m/s*s, m/s & s", "V"), ":10: found unit 'V'; use an acceleration in g, m/s2"),
        (CWA, ("SampleRate(Hz): 100", "SampleRate(Hz): 200"), ":6: found a step of 0.005 s and"),
        (CWA, ("(sec): 2\n", "(sec): 9\n"), ":5: the heading states 9 s, the record lasts 2 s"),
        (CWA, (f"N:   {max(WAVE):.3f}~  {min(WAVE):.3f}", "N:   9.3~ -9.0"), ":9: the header st"),
        (JMA, (" UNIT  = gal(cm/s/s)", " UNIT  = counts"), ":4: found unit 'counts': raw counts"),
        (UNAM, (f": /{PEAK}/{PEAK / 2}/", f": /{PEAK}/9/"), ":8: the header states a peak of 0.0"),
        (SPANISH, ("muestras: 200", "muestras: dos"), ":4: found 'dos'; enter the number of val"),
    ],
)
def test_what_a_heading_states_must_be_so(file, content, change, problem):
    assert change[0] in content
    told = input_problems(read_motion_file, file(content.replace(*change)))
    assert told[0].startswith(f"roof.csv{problem}")


@pytest.mark.parametrize("title", ["Velocity", "QUANTITY: VELOCITY", "Tipo: Velocidad"])
def test_a_title_of_another_quantity_is_not_overruled_by_the_unit(file, title):
    content = SPANISH.replace("Aceleracion maxima (cm/s2)", "PGA")
    (problem,) = input_problems(read_motion_file, file(f"{title}\n{content}"))
    other = title.split()[-1].lower()
    assert problem == (
        f"roof.csv:1: found {other!r} but no acceleration; use the acceleration file, or correct"
        " the line"
    )
    valued = file(f"Peak displacement (cm): 3.1\nVelocity (cm/s): 12.3\n{content}")
    assert len(read_record(valued).a_mps2) == 200


def test_a_unit_that_is_not_stated_is_that_of_the_caller(file):
    path = file(SPANISH.replace("Unidades: cm/seg2\n", ""))
    assert read_record(path, units="gal").a_mps2 == pytest.approx(0.01 * np.array(WAVE))


def test_values_that_fill_their_columns_are_the_first_ones_too(file):
    # Fields of 14 columns, whose first lines are below zero and have no blank.
    values = [-1e-5 * (k + 1) for k in range(10)] + [value / 100.0 for value in WAVE]
    fields = [f"{value:14.7E}" for value in values]
    rows = ["".join(fields[k : k + 5]) for k in range(0, len(fields), 5)]
    assert " " not in rows[0].strip()
    count = f"Number of Data                : {len(values)}\n"
    head = (
        "Event Date & Time             : 2001-01-01 01:01:01\n"
        "Orientation                   : NS\n"
        "Time Increment (s)            : 0.005\n"
        f"{count}PGA (m/s/s)                   : {max(values):.7E}\n"
        "Acceleration time series in m/s/s\n"
    )
    record = read_motion_file(file(head + "\n".join(rows) + "\n")).channel()
    assert (record.name, record.dt_s) == ("NS", 0.005)
    assert record.a_mps2 == pytest.approx(np.array(values), abs=1e-7)
    (problem,) = input_problems(
        read_motion_file, file(head.replace(count, "Units: m/s/s\n") + "\n".join(rows) + "\n")
    )
    assert problem == (
        "roof.csv:7: found 5 values in a line, and neither their number nor names of columns above;"
        " enter the names, or the number as in NDATA: 4000"
    )


HEAD = "Station: ABC\nComponent: NS\nSampling rate: 100 Hz\nUnits: gal\nNumber of points: {}\n"


@pytest.mark.parametrize("mark", [" ", ", ", "  "])
def test_commas_in_values_are_decimal_where_no_value_has_a_point(file, mark):
    rows = columns(1).replace(".", ",") if mark == "  " else columns(1, mark=mark)
    record = read_motion_file(file(HEAD.format(200) + rows)).channel()
    assert record.a_mps2 == pytest.approx(0.01 * np.array(WAVE), abs=1e-6)


def test_times_and_line_numbers_beside_values_are_no_values(file):
    timed = columns(1, times=True)
    for count, due in ((200, "found times next to them"), (400, "times rise in column 1")):
        (problem,) = input_problems(read_motion_file, file(HEAD.format(count) + timed))
        assert due in problem
    cards = "".join(f"{10 * math.sin(k):.3f} {10 * math.cos(k):.3f} {k}\n" for k in range(1, 51))
    (problem,) = input_problems(read_motion_file, file(HEAD.format(150) + cards))
    assert problem.startswith("roof.csv:6: column 3 contains line numbers: delete it; then")


def test_two_steps_are_asked_about_and_a_factor_is_noted(file):
    content = HEAD.format(200) + columns(1)
    other = file(f"Original sampling rate: 500 Hz\n{content}")
    (problem,) = input_problems(read_motion_file, other)
    assert problem.startswith("roof.csv:4: found a step of 0.01 s and one of 0.002 s; enter the ti")
    assert read_record(other, dt_s=0.01).dt_s == 0.01
    notes = read_motion_file(file(f"Scale factor: 0.1\n{content}")).notes
    assert notes == ("line 1 states 'Scale factor: 0.1': no factor is applied",)
    positive = file(content.replace("-", ""))
    assert "no value is below zero: is it a" in read_motion_file(positive).notes[0]


def test_a_file_of_peer_that_has_such_lines_is_one_of_peer(file):
    head = (
        "PEER STRONG MOTION DATABASE RECORD\nCOMPONENT: 180\n"
        "ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.1 Hz LP=40.0 Hz\n"
        "NPTS=  200, SAMPLING INTERVAL= .01 SEC\n"
    )
    motion_file = read_motion_file(file(head + across(WAVE, 5).replace("E+01", "E-01")))
    assert motion_file.format == "PEER AT2"
    assert len(motion_file.channels[0].a_mps2) == 200


def test_comments_above_a_table_are_no_format(file):
    head = "# Sampling rate: 100 Hz\n# Units: gal\n# Number of samples: 200\n"
    assert read_motion_file(file(head + columns(1))).format == "text"
    assert read_motion_file(file(f"{head}t,a\n{columns(1, mark=',', times=True)}")).format == "text"
