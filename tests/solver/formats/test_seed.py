"""MiniSEED and SAC. Oracle: records written here byte by byte, as their manuals lay them out."""

import random
import struct
import sys
import warnings
from functools import partial

import numpy as np
import pytest

from fixtures.errors import input_problems
from fixtures.spaces import spaced
from solver.errors import InputError
from solver.formats import read_motion_file

COUNTS = np.array([0, 5, -40, 12000, -7, 3] * 15, dtype=">i4")
PER_MPS2 = 213740.0
FLOATS = (COUNTS / 1000.0).astype(">f4")
STATION = """<?xml version="1.0"?>
<FDSNStationXML xmlns="http://www.fdsn.org/xml/station/1" schemaVersion="1.1">
<Source>x</Source><Created>2024-01-01T00:00:00</Created><Network code="XX"><Station code="ABC">
<Latitude>0</Latitude><Longitude>0</Longitude><Elevation>0</Elevation><Site><Name>x</Name></Site>
<Channel code="HNE" locationCode=""><Latitude>0</Latitude><Longitude>0</Longitude>
<Elevation>0</Elevation><Depth>0</Depth><SampleRate>100</SampleRate><Response>
<InstrumentSensitivity><Value>213740</Value><Frequency>1</Frequency><InputUnits><Name>M/S**2</Name>
</InputUnits><OutputUnits><Name>COUNTS</Name></OutputUnits></InstrumentSensitivity></Response>
</Channel></Station></Network></FDSNStationXML>"""


def miniseed(values, second=0, channel=b"HNE"):
    """A record of 512 bytes of 32-bit numbers at 100 Hz from 2024-01-02 on."""
    encoding = 3 if values.dtype.kind == "i" else 4
    time = struct.pack(">HHBBBBH", 2024, 2, 0, 0, second, 0, 0)
    counts = struct.pack(">HhhBBBBiHH", len(values), 100, 1, 0, 0, 0, 1, 0, 64, 48)
    blockette = struct.pack(">HHBBBB", 1000, 0, encoding, 1, 9, 0)
    head = b"000001D ABC    " + channel + b"XX" + time + counts + blockette
    return (head.ljust(64, b"\0") + values.tobytes()).ljust(512, b"\0")


def sac(values, quantity=8, dt_s=0.01):
    """A SAC file of version 6, big-endian."""
    floats, whole = [-12345.0] * 70, [-12345] * 40
    floats[0], floats[5], floats[6] = dt_s, 0.0, dt_s * (len(values) - 1)
    whole[:6] = 2024, 2, 0, 0, 0, 0
    whole[6], whole[9], whole[15], whole[16], whole[35] = 6, len(values), 1, quantity, 1
    letters = b"ABC".ljust(8) + b"-12345".ljust(16) + b"-12345  " * 21
    return struct.pack(">70f40i", *floats, *whole) + letters + values.astype(">f4").tobytes()


@pytest.fixture(scope="module", autouse=True)
def obspy():
    """Its import warns of deprecated parts of Python."""
    with warnings.catch_warnings(action="ignore"):
        return pytest.importorskip("obspy")


problems_of = partial(input_problems, read_motion_file)


@pytest.mark.parametrize("is_station", [False, True])
@pytest.mark.parametrize("content", [miniseed(COUNTS), sac(COUNTS)])
def test_raw_counts_are_divided_by_the_sensitivity_that_is_told(file, is_station, content):
    code = STATION if content[:6] == b"000001" else STATION.replace("XX", "").replace("HNE", "")
    response = file(code, "station.xml") if is_station else str(PER_MPS2)
    motion_file = read_motion_file(file(content, "x.mseed"), response=response)
    (record,) = motion_file.channels
    assert (record.dt_s, str(motion_file.start)) == (0.01, "2024-01-02 00:00:00")
    assert record.a_mps2 == pytest.approx(COUNTS / PER_MPS2, rel=1e-7)
    said = "raw counts / 213740 per m/s2, the sensitivity at 1 Hz; the response at other"
    assert spaced(motion_file.notes[0]).startswith(
        said if is_station else "uncorrected: the mean is"
    )


@pytest.mark.parametrize("content", [miniseed(FLOATS), sac(FLOATS)])
def test_samples_that_are_no_counts_are_in_the_unit_that_is_told(file, content):
    path = file(content, "x.sac")
    assert problems_of(path)[0].startswith("x.sac: found no unit of acceleration; enter units,")
    (record,) = read_motion_file(path, units="cm/s2").channels
    assert record.a_mps2 == pytest.approx(FLOATS / 100.0, rel=1e-7)
    told = read_motion_file(path, response="1000")
    assert told.channel().a_mps2 == pytest.approx(FLOATS / 1000.0, rel=1e-7)
    assert told.notes[0] == "the samples are not whole numbers and are read as counts"


@pytest.mark.parametrize("rate_hz", [50, 75, 100, 120, 125, 128, 250, 300, 500, 512, 1000, 200 / 3])
def test_sac_has_the_step_of_its_heading_at_any_rate(file, rate_hz):
    path = file(sac(FLOATS, dt_s=1.0 / rate_hz), "x.sac")
    (record,) = read_motion_file(path, units="cm/s2").channels
    assert record.dt_s == pytest.approx(1.0 / rate_hz, rel=1e-15 if rate_hz % 1 == 0 else 1e-6)


@pytest.mark.parametrize(
    ("azimuth", "dip", "sign", "told"),
    [
        (0, 90, -1, ["its dip is 90 deg, positive downward: the sign is reversed"]),
        (0, -90, 1, []),
        (270, 0, 1, ["its azimuth is 270.0 deg, its dip 0.0 deg"]),
        (30, 40, 1, ["its azimuth is 30.0 deg, its dip 40.0 deg"]),
    ],
)
def test_the_direction_in_the_stationxml_is_used_or_said(file, azimuth, dip, sign, told):
    said = f"</Depth><Azimuth>{azimuth}</Azimuth><Dip>{dip}</Dip>"
    response = file(STATION.replace("</Depth>", said), "station.xml")
    motion_file = read_motion_file(file(miniseed(COUNTS)), response=response)
    assert motion_file.channel().a_mps2 == pytest.approx(sign * COUNTS / PER_MPS2, rel=1e-12)
    assert [note for note in motion_file.notes if "deg" in note] == told


def test_each_component_is_a_channel_and_without_obspy_what_to_install_said(file, monkeypatch):
    both = miniseed(COUNTS) + miniseed((2 * COUNTS).astype(">i4"), channel=b"HNN")
    motion_file = read_motion_file(file(both), response="20000")
    assert [record.name for record in motion_file.channels] == ["XX.ABC..HNE", "XX.ABC..HNN"]
    assert motion_file.channels[1].a_mps2 == pytest.approx(COUNTS / 10000)
    monkeypatch.setitem(sys.modules, "obspy", None)
    (problem,) = problems_of(file(miniseed(COUNTS)))
    assert problem.startswith("roof.csv: miniSEED is read by ObsPy, which is not installed; type")
    assert problem.endswith("pip install '.[seismic]' in its folder")


@pytest.mark.parametrize(
    ("content", "problem"),
    [
        (miniseed(COUNTS), "found XX.ABC..HNE: raw counts require the"),
        (miniseed(0 * COUNTS), "found XX.ABC..HNE: raw counts require the"),
        (sac(COUNTS), "found .ABC..: raw counts require the"),
        (sac(FLOATS, 7), ".ABC.. has velocity; use a record of acceleration"),
        (miniseed(COUNTS)[:500], "damaged or truncated miniSEED; use the complete file"),
        (miniseed(COUNTS) * 2 + b"000002D ABC", "damaged or truncated miniSEED; use the complete"),
        (sac(FLOATS)[:-9], "damaged or truncated SAC; use the complete file"),
        (miniseed(COUNTS) + miniseed(COUNTS, 5), "XX.ABC..HNE has 2 pieces with gaps or overlaps"),
    ],
)  # fmt: skip
def test_what_is_no_whole_record_of_acceleration_is_refused(file, content, problem):
    for how in ({}, {"units": "gal"}):
        assert problems_of(file(content, "x"), **how)[0].startswith(f"x: {problem}")


@pytest.mark.parametrize(
    ("old", "new", "problem"),
    [
        ("M/S**2", "M/S", "the sensitivity of XX.ABC..HNE is 213740 COUNTS per 'M/S'; enter that"),
        ("COUNTS", "V", "the sensitivity of XX.ABC..HNE is 213740 V per 'M/S**2'; enter that"),
        ("HNE", "HNZ", "has no sensitivity of XX.ABC..HNE at 2024-01-02T00:00:00.000000Z; enter"),
        ("FDSNStationXML", "a", "cannot be read as a response; use StationXML, or counts per"),
    ],
)  # fmt: skip
def test_another_response_is_refused(file, old, new, problem):
    response = file(STATION.replace(old, new), "station.xml")
    (found,) = problems_of(file(miniseed(COUNTS)), response=response)
    assert found.startswith(f"station.xml: {problem}")


@pytest.mark.parametrize("told", ["INF", "1e308", "1e-320", "0", "-213740"])
def test_a_sensitivity_that_no_instrument_has_is_refused(file, told):
    """Divided by it, counts are a record of zeros, or of no numbers."""
    station = file(STATION.replace("213740", told), "station.xml")
    for response, beginning in ((station, "station.xml: the sensitivity"), (told, "x: ")):
        (found,) = problems_of(file(miniseed(COUNTS), "x"), response=response)
        assert found.startswith(beginning)
        assert "0.1 to 1e+12 counts per m/s2" in found


@pytest.mark.nightly
@pytest.mark.parametrize("content", [miniseed(FLOATS), sac(FLOATS)])
def test_damaged_bytes_are_read_or_refused(file, content):
    rng, longest = random.Random(1), 0
    for _ in range(1000):
        damaged = bytearray(content)
        for _ in range(rng.randint(1, 4)):
            damaged[rng.randrange(len(damaged))] = rng.randrange(256)
        try:
            read_motion_file(file(bytes(damaged[: rng.randint(0, 2 * len(content))])), units="gal")
        except InputError as error:
            longest = max(longest, len(error.problems[0]))
    assert 0 < longest < 400
