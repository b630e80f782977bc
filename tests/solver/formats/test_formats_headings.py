"""Headings and units. Oracle: the meaning of each, typed by hand."""

import math

import pytest

from solver.formats.layout import Kind, parse, remark, settled, units_in, words
from solver.records.record import UNIT_CHOICES, UNITS, is_other_unit, unit_size

pytestmark = pytest.mark.quick

G = 9.80665


SIZES = {
    G: ("g", "G"), G / 10: ("g/10",), G / 100: ("%g",), G / 1000: ("mg",),
    1.0: ("m/s2", "m/s/s", "m/s**2", "m/s^2", "m/s²", "m/sec/sec", "m s-2", "m·s⁻²", "m_s2",
          "mps2"),
    0.01: ("gal", "Gals", "CM/SEC/SEC", "cm/sec2", "cm_s2", "cmps2"),
    0.001: ("mm/s/s",), 0.3048: ("ft/s2",), 0.0254: ("in/s2",),
}  # fmt: skip


@pytest.mark.parametrize(
    ("text", "size"), [(text, size) for size, texts in SIZES.items() for text in texts]
)
def test_spellings_of_a_unit_have_its_size(text, size):
    assert unit_size(text) == pytest.approx(size, rel=1e-15)


@pytest.mark.parametrize(
    "text", ["", "cm", "cm/s", "s", "volt", "counts", "km/s2", "gallon", "ms2"]
)
def test_other_words_are_no_acceleration(text):
    assert math.isnan(unit_size(text))


def test_words_and_units_of_headings_are_those_known():
    assert (*UNITS, "gal") == UNIT_CHOICES
    texts = ("cm", "CM/SEC", "m/s", "in", "g", "s")
    assert list(filter(is_other_unit, texts)) == ["cm", "CM/SEC", "m/s", "in"]
    numbers = ("sample", "Index", "No.", "N", "n_g", "NS", "t")
    assert [parse(word).is_index for word in numbers] == [True] * 4 + [False] * 3
    assert words("Time [s] Acc (cm/s2) NS", None) == ["Time [s]", "Acc (cm/s2)", "NS"]
    assert words("t;a b;c", ";") == ["t", "a b", "c"]


@pytest.mark.parametrize(
    ("text", "name", "kind", "unit"),
    [
        ("t", "t", Kind.TIME, ""),
        ("t_s", "t", Kind.TIME, "s"),
        ("Time (sec)", "Time", Kind.TIME, "sec"),
        ("time_ms", "time", Kind.TIME, "ms"),
        ("elapsed [s]", "elapsed", Kind.TIME, "s"),
        ("Zeit", "Zeit", Kind.TIME, ""),
        ("chan_s", "chan_s", Kind.UNSAID, ""),
        ("acc_g", "acc", Kind.ACCELERATION, "g"),
        ("acc_x_cm/s2", "acc_x", Kind.ACCELERATION, "cm/s2"),
        ("a_m_s2", "a", Kind.ACCELERATION, "m_s2"),
        ("EW [cm/s2]", "EW", Kind.ACCELERATION, "cm/s2"),
        ('"Acc (gal)"', "Acc", Kind.ACCELERATION, "gal"),
        ("a in gal", "a", Kind.ACCELERATION, "gal"),
        ("[g]", "", Kind.ACCELERATION, "g"),
        ("vel_cm/s", "vel", Kind.OTHER, "cm/s"),
        ("velocity_g", "velocity", Kind.OTHER, "g"),
        ("Ground Vel (gal)", "Ground Vel", Kind.OTHER, "gal"),
        ("displacement", "displacement", Kind.OTHER, ""),
        ("pseudo-velocity accel_g", "pseudo-velocity accel", Kind.ACCELERATION, "g"),
        ("level_g", "level", Kind.ACCELERATION, "g"),
        ("acc_km/s2", "acc", Kind.OTHER, "km/s2"),
        ("EW [yd/s^2]", "EW", Kind.OTHER, "yd/s^2"),
        ("EW (NS)", "EW (NS)", Kind.UNSAID, ""),
        ("d [in]", "d", Kind.OTHER, "in"),
        ("plug_in", "plug_in", Kind.UNSAID, ""),
        ("NS", "NS", Kind.UNSAID, ""),
        ("acc [filtered]", "acc [filtered]", Kind.UNSAID, ""),
        ("acc g", "acc g", Kind.UNSAID, ""),
    ],
)
def test_a_heading_says_name_kind_and_unit(text, name, kind, unit):
    heading = parse(text)
    assert (heading.name, heading.kind, heading.unit) == (name, kind, unit)
    assert heading.seconds == (0.001 if unit == "ms" else 1.0)


@pytest.mark.parametrize(
    ("text", "seconds"),
    [
        ("Time [min]", 60.0),
        ("time_min", 60.0),
        ("t in minutes", 60.0),
        ("elapsed [min]", 60.0),
        ("min", 60.0),
        ("ms", 0.001),
        ("t (msec)", 0.001),
        ("Time [us]", math.nan),
        ("time_h", math.nan),
        ("Time (UTC)", math.nan),
        ("elapsed [hours]", math.nan),
        ("hours", math.nan),
    ],
)
def test_a_time_in_an_unknown_unit_has_no_value_in_seconds(text, seconds):
    heading = parse(text)
    assert heading.kind is Kind.TIME
    assert heading.seconds == pytest.approx(seconds, nan_ok=True)


def test_remarks_and_letters_name_columns_only_where_they_must():
    prose = "t_s,acc_g  San Francisco, 575 Market, 42nd floor"
    assert [heading.name for heading in remark(prose, ",", 2)] == ["t", "acc"]
    assert remark("made by hand, long ago", ",", 2) == []
    assert remark("t_s", ",", 2) == []
    assert remark("t_s", None, 1) == []
    assert [h.unit for h in settled([*map(parse, ("t", "ch_f", "ch_g"))])] == ["", "", ""]
    assert [h.unit for h in settled([*map(parse, ("t", "ch_gal", "ch_g"))])] == ["", "gal", "g"]
    assert settled([*map(parse, ("t", "EW", "vel_g"))])[2].kind is Kind.OTHER


@pytest.mark.parametrize(
    ("line", "units"),
    [
        ("units: cm/s2", ["cm/s2"]),
        ("Units = gal, dt = 0.01", ["gal"]),
        ("accelerations in units of g.", ["g"]),
        ("a in m/s², north", ["m/s²"]),
        ("roof acceleration [g]", ["g"]),
        ("acc_gal", ["gal"]),
        ("in the north [roof]", []),
        ("units unknown", []),
    ],
)
def test_prose_may_state_units(line, units):
    assert list(dict.fromkeys(units_in(line))) == units
