"""The picture of a file of records."""

import re

import numpy as np
import pytest

from report.figures import records as figures
from report.figures.base import png_bytes
from report.suite.files import PERIODS_S, spectra_g
from solver.records.record import Record
from solver.records.spectrum import response_spectrum

G = 9.80665


@pytest.fixture
def channels(noise):
    names = ["HN1", "HN2", "HNZ", *(f"floor {k}" for k in range(9))]
    return [Record(name=name, dt_s=0.01, a_mps2=noise / (1 + k)) for k, name in enumerate(names)]


@pytest.mark.quick
def test_spectra_are_those_of_each_record_in_g(channels):
    spectra = spectra_g(channels[:2])
    assert spectra.shape == (2, len(PERIODS_S))
    expected = response_spectrum(channels[1].a_mps2, 0.01, PERIODS_S) / G
    assert np.array_equal(spectra[1], expected)


@pytest.mark.parametrize("count", [1, 3, 12])
def test_any_number_of_channels_is_drawn_each_with_room_and_a_line_of_its_own(channels, count):
    some = channels[:count]
    svg = figures.records_picture(some, PERIODS_S, spectra_g(some))
    width, height = map(float, re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', svg).groups())
    assert width / 72 == pytest.approx(7.0, abs=0.01)
    assert height / 72 > 3.0 + 0.9 * count
    assert "<text" not in svg  # outlines: no font is needed
    looks = set(re.findall(r'"fill: none; ([^"]*stroke-width: 1.2[^"]*)"', svg))
    assert len(looks) == count <= figures.MOST


@pytest.mark.parametrize("size", [0.0, 1e-9, 1e3])
def test_records_of_any_size_are_drawn_without_a_warning(noise, size):
    records = [Record(name="r" * 200, dt_s=0.01, a_mps2=noise * size)]
    png = figures.records_picture(records, PERIODS_S, spectra_g(records), png_bytes)
    assert png.startswith(b"\x89PNG")


def test_records_of_different_lengths_share_their_axes(channels, noise):
    pair = [channels[0], Record(name="short", dt_s=0.02, a_mps2=noise[:100])]
    assert figures.records_picture(pair, PERIODS_S, spectra_g(pair))
