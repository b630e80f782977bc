import re

import matplotlib as mpl
import numpy as np
import pytest

import scenes
import stand_in
from plans import SMALL, roof_plan
from report.assessment.spectra import spectra
from report.drawing.sheet import LETTER
from report.figures import charts as figures
from report.figures import history
from report.figures.spectra import spectra as drawn_spectra


@pytest.fixture(scope="module")
def assessment():
    return scenes.package().assessment


@pytest.fixture(scope="module")
def charts(assessment):
    return drawn(assessment)


def drawn(assessment):
    """Every chart of the package."""
    parts = spectra(assessment)
    return [
        roof_plan(assessment, SMALL),
        roof_plan(assessment, LETTER),
        drawn_spectra(parts),
        histories(assessment.arrays[0]),
        figures.comparison(assessment.alike, True),
    ]


def histories(array, us_first=True):
    panels = [history.RunPanel("", run, run.history()) for run in array.motions]
    return history.histories(panels, us_first)


def words(svg):
    return re.findall(r"<text[^>]*>([^<]*)</text>", svg)


def test_charts_carry_no_date_one_font_and_the_same_bytes(charts, assessment):
    for svg in charts:
        assert "<dc:date>" not in svg
        assert set(re.findall(r"font: [^;]*?'([^']+)'", svg)) <= {"Source Sans 3"}
    with mpl.rc_context({"font.size": 30.0, "lines.linewidth": 9.0, "svg.fonttype": "path"}):
        assert drawn(assessment) == charts


@pytest.mark.quick
def test_envelopes_histories_and_comparisons_keep_what_they_show(assessment):
    rng = np.random.default_rng(3)
    t, u = np.arange(6000) * 0.005, np.cumsum(rng.standard_normal(6000))
    t_few, u_few = history.envelope(t, u)
    assert len(t_few) <= history.MAX_POINTS
    assert (u_few.min(), u_few.max()) == (u.min(), u.max())
    assert (t_few[0], t_few[-1]) == (t[0], t[-1])
    assert np.all(np.diff(t_few) > 0)
    printed = words(histories(assessment.arrays[1]))
    assert sum(bool(re.fullmatch(r"[\d.]+ in \(\d+ mm\)", text)) for text in printed) == 3
    printed = words(histories(assessment.arrays[1], us_first=False))
    assert sum(bool(re.fullmatch(r"\d+ mm \([\d.]+ in\)", text)) for text in printed) == 3
    printed = words(figures.comparison(stand_in.unpermitted().alike, True))
    assert "no design displacement" in printed
    assert "prescriptive displacement not permitted" in printed


def test_short_records_and_runs_without_a_value_are_drawn_as_such():
    t, u = np.arange(5.0), np.arange(5.0)
    assert history.envelope(t, u) == (t, u)
    up = np.repeat((0.0, -1.5 * stand_in.G, 0.0), 100)
    still = stand_in.motion("M1", np.zeros(300), up, signs=(1,))
    done = scenes.package((still,) * 3).assessment
    printed = words(histories(done.arrays[0]))
    assert printed.count("none") == 6  # above and within each panel
    assert "no design displacement" in words(figures.comparison(done.alike, True))


@pytest.mark.parametrize("us_first", [True, False])
def test_the_wanted_unit_is_on_the_main_axis(assessment, us_first):
    printed = words(figures.comparison(assessment.alike, us_first))
    assert f"Horizontal displacement [{'in' if us_first else 'mm'}]" in printed
    assert f"[{'mm' if us_first else 'in'}]" in printed
