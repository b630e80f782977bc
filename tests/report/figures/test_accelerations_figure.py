"""Accelerations of the motions: the bars below them are round, readable and as long as they say."""

import re

import numpy as np
import pytest

import stand_in
from report.figures.records import accelerations

pytestmark = pytest.mark.quick


def drawn(peak_g, n=11312, dt_s=1.0 / 300.0):
    """Labels of the bars, and height of bar and of peak, width of bar and of motion, in points."""
    wave = np.sin(np.linspace(0.0, 40.0, n))
    wave *= peak_g * stand_in.G / np.abs(wave).max()
    svg = accelerations((stand_in.motion("M1", wave, dt_s=dt_s),))
    lines = [
        np.array([float(v) for v in re.findall(r"-?[0-9.]+", path)]).reshape(-1, 2)
        for path in re.findall(r'<path d="(M [^"]*)" clip-path', svg)
    ]
    _, history, level, span = lines
    height, peak, width, motion = (
        np.ptp(line[:, axis]) for line, axis in ((level, 1), (history, 1), (span, 0), (history, 0))
    )
    labels = re.findall(r">([0-9.]+) (?:g|s)</text>", svg)
    return labels, height / (peak / 2.0), width / motion


@pytest.mark.parametrize(
    ("peak_g", "label"), [(1.0, "0.5"), (0.997, "0.5"), (0.3, "0.2"), (0.12, "0.05"), (2.6, "2")]
)
def test_the_bar_of_accelerations_is_near_half_of_the_largest_peak(peak_g, label):
    (level, _), height, _ = drawn(peak_g)
    assert level == label
    assert height == pytest.approx(float(label) / peak_g, rel=0.02)
    assert 0.3 < height <= 0.8


@pytest.mark.parametrize(("n", "label"), [(11312, "20"), (3001, "5"), (15001, "20")])
def test_the_bar_of_times_is_round_and_as_long_as_it_says(n, label):
    (_, span), _, width = drawn(1.0, n)
    assert span == label
    assert width == pytest.approx(float(label) / ((n - 1) / 300.0), rel=0.01)
