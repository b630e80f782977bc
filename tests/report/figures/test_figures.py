"""Figures: complete, to scale, the same bytes every time, and no text on another or cut off."""

import itertools
import math
import re
from dataclasses import replace

import matplotlib as mpl
import matplotlib.figure
import numpy as np
import pandas as pd
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text

from fixtures import assessments, projects
from fixtures.marks import by_day
from fixtures.plan_pictures import SMALL, roof_plan
from fixtures.spaces import spaced
from fixtures.study_workbooks import limit_state
from report.assessment.support.response_spectra import spectra
from report.drawing.sheet import LETTER
from report.figures import charts as figures
from report.figures import history_charts
from report.figures.history_charts import STEP_IN, PanelScale, hodographs, path_of, thinned
from report.figures.record_charts import accelerations
from report.figures.spectrum_charts import spectra as drawn_spectra
from report.manual import stability_maps as manual
from report.manual import work_figures as work
from report.pages.drawings import draw_assessment, draw_plotted
from report.project.model.choices import UnitsFirst
from report.study import study_charts as study
from report.text.units import Quantity
from solver.rivals.methods import METHODS
from solver.studies.uncertainty import Bar
from solver.verification import workprecision
from solver.verification.evidence import StabilityMap


@pytest.fixture(scope="module")
def assessment():
    return assessments.package().assessment


@pytest.fixture(scope="module")
def charts(assessment):
    return every_chart(assessment)


def every_chart(assessment):
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
    panels = [history_charts.RunPanel("", run, run.history()) for run in array.motions]
    return history_charts.histories(panels, us_first)


def words(svg):
    return re.findall(r"<text[^>]*>([^<]*)</text>", svg)


def test_charts_carry_no_date_one_font_and_the_same_bytes(charts, assessment):
    for svg in charts:
        assert "<dc:date>" not in svg
        assert set(re.findall(r"font: [^;]*?'([^']+)'", svg)) <= {"Source Sans 3"}
    with mpl.rc_context({"font.size": 30.0, "lines.linewidth": 9.0, "svg.fonttype": "path"}):
        assert every_chart(assessment) == charts


@pytest.mark.quick
def test_envelopes_histories_and_comparisons_keep_what_they_show(assessment):
    rng = np.random.default_rng(3)
    t, u = np.arange(6000) * 0.005, np.cumsum(rng.standard_normal(6000))
    t_few, u_few = history_charts.envelope(t, u)
    assert len(t_few) <= history_charts.MAX_POINTS
    assert (u_few.min(), u_few.max()) == (u.min(), u.max())
    assert (t_few[0], t_few[-1]) == (t[0], t[-1])
    assert np.all(np.diff(t_few) > 0)
    printed = spaced(words(histories(assessment.arrays[1])))
    assert sum(bool(re.fullmatch(r"[\d.]+ in \(\d+ mm\)", text)) for text in printed) == 3
    printed = spaced(words(histories(assessment.arrays[1], us_first=False)))
    assert sum(bool(re.fullmatch(r"\d+ mm \([\d.]+ in\)", text)) for text in printed) == 3
    printed = words(figures.comparison(projects.unpermitted().alike, True))
    assert "no design displacement" in printed
    assert "prescriptive not permitted" in printed


def test_short_records_and_runs_without_a_value_are_drawn_as_such():
    t, u = np.arange(5.0), np.arange(5.0)
    assert history_charts.envelope(t, u) == (t, u)
    up = np.repeat((0.0, -1.5 * projects.G, 0.0), 100)
    still = projects.motion("M1", np.zeros(300), up, signs=(1,))
    done = assessments.package((still,) * 3).assessment
    printed = words(histories(done.arrays[0]))
    assert printed.count("none") == 6  # above and within each panel
    assert "no design displacement" in words(figures.comparison(done.alike, True))


@pytest.mark.parametrize("us_first", [True, False])
def test_the_wanted_unit_is_on_the_main_axis(assessment, us_first):
    printed = words(figures.comparison(assessment.alike, us_first))
    assert f"Horizontal displacement [{'in' if us_first else 'mm'}]" in printed
    assert f"[{'mm' if us_first else 'in'}]" in printed


def bars(peak_g, n=11312, dt_s=1.0 / 300.0):
    """Labels of the bars, and height of bar and of peak, width of bar and of motion, in points."""
    wave = np.sin(np.linspace(0.0, 40.0, n))
    wave *= peak_g * projects.G / np.abs(wave).max()
    svg = accelerations((projects.motion("M1", wave, dt_s=dt_s),))
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


@pytest.mark.quick
@pytest.mark.parametrize(
    ("peak_g", "label"), [(1.0, "0.5"), (0.997, "0.5"), (0.3, "0.2"), (0.12, "0.05"), (2.6, "2")]
)
def test_the_bar_of_accelerations_is_near_half_of_the_largest_peak(peak_g, label):
    (level, _), height, _ = bars(peak_g)
    assert level == label
    assert height == pytest.approx(float(label) / peak_g, rel=0.02)
    assert 0.3 < height <= 0.8


@pytest.mark.parametrize(("n", "label"), [(11312, "20"), (3001, "5"), (15001, "20")])
def test_the_bar_of_times_is_round_and_as_long_as_it_says(n, label):
    (_, span), _, width = bars(1.0, n)
    assert span == label
    assert width == pytest.approx(float(label) / ((n - 1) / 300.0), rel=0.01)


@pytest.fixture(scope="module")
def array():
    return assessments.package(assessments.motions(3, 12.0)).assessment.arrays[1]


@pytest.mark.quick
def test_the_path_has_its_sides_and_its_farthest_point_at_the_prd(array):
    history = array.motions[0].history()
    turned = replace(history, u_m=np.array([0.0, 3.0]), across_m=np.array([0.0, 4.0]))
    path = path_of(turned)
    assert path.x_m.tolist() == [0.0, 4.0]
    assert path.y_m.tolist() == [0.0, -3.0]
    for run in array.motions:
        # The largest distance between two samples may exceed that at the samples.
        reached_m = np.hypot(*path_of(run.history())).max()
        assert reached_m == pytest.approx(run.governing.prd_m, rel=5e-3)
    paths = [path_of(run.history()) for run in array.motions]
    panel = PanelScale.around(paths)
    for path in paths:
        x = panel.start[0] + path.x_m / panel.m_per_in
        y = panel.start[1] + path.y_m / panel.m_per_in
        assert 0.0 < x.min() <= x.max() < panel.wide_in
        assert -panel.tall_in < y.min() <= y.max() < 0.0


def test_a_run_in_one_axis_is_a_straight_line_and_one_without_a_value_none(array):
    history = replace(array.motions[0].history(), across_m=np.zeros(0))
    assert not path_of(history).x_m.any()
    assert len(path_of(history).x_m) == len(history.u_m)
    history = array.motions[0].history()
    none = replace(history, result=replace(history.result, prd_m=math.nan))
    assert words(hodographs(array.motions[:1], [none], True)).count("none") == 1


def test_the_second_unit_of_a_prd_gives_way_to_the_name_of_an_array_and_then_the_name(array):
    def titles(name):
        panels = [history_charts.RunPanel(name, run, run.history()) for run in array.motions]
        shown = words(history_charts.histories(panels, True))
        return [text for text in shown if ": " in text], "mm)" in " ".join(shown)

    for name, is_both in (("A1", True), ("WESTHALL", False)):
        names, has_both = titles(name)
        assert [text.startswith(f"{name}: ") for text in names] == [True] * 3
        assert has_both == is_both
    names, has_both = titles("WAREHOUSES-OF-THE-WESTERN-HALVES")
    assert ["…: " in text for text in names] == [True] * 3
    assert not has_both


@pytest.mark.parametrize(("us_first", "unit"), [(True, "in"), (False, "mm")])
def test_motions_downslope_and_a_round_scale_are_named(array, us_first, unit):
    printed = words(hodographs(array.motions, [m.history() for m in array.motions], us_first))
    assert [run.motion.id for run in array.motions] == printed[: len(array.motions)]
    assert printed[-2] == "downslope"
    assert re.fullmatch(rf"[125]0* {unit}", printed[-1])


def test_thinning_keeps_the_ends_and_no_point_is_farther_than_a_step_from_the_next():
    angle = np.linspace(0.0, 6.0, 5000)
    x, y = np.cos(angle), np.sin(angle)
    x_few, y_few = thinned(x, y)
    assert (x_few[0], y_few[0], x_few[-1], y_few[-1]) == (x[0], y[0], x[-1], y[-1])
    assert len(x_few) == pytest.approx(6.0 / STEP_IN, rel=0.02)
    assert np.hypot(np.diff(x_few), np.diff(y_few)).max() < 1.3 * STEP_IN


DPI = 400  # extents are rounded to pixels
TOUCH_IN = 0.01
LEAST_PT = 8.5


class Drawn:
    """Words, size [pt] and extent [in] of the texts of each saved figure, and its own size [in]."""

    def __init__(self):
        self.figures = []

    def take(self, figure):
        figure.set_dpi(DPI)
        canvas = FigureCanvasAgg(figure)
        figure.draw_without_rendering()
        renderer = canvas.get_renderer()
        inches = figure.dpi_scale_trans.inverted()
        hidden = set(out_of_sight(figure))
        seen = [t for t in figure.findobj(Text) if t.get_visible() and t not in hidden]
        # Of an annotation without its arrow.
        texts = [
            (t.get_text(), t.get_fontsize(), Text.get_window_extent(t, renderer))
            for t in seen
            if t.get_text().strip()
        ]
        in_inches = [(text, size, box.transformed(inches)) for text, size, box in texts]
        self.figures.append((in_inches, figure.get_size_inches()))


@pytest.fixture
def drawn(monkeypatch):
    """Collect every figure as it is saved, within the style that it is drawn in."""
    seen, save = Drawn(), matplotlib.figure.Figure.savefig

    def savefig(figure, *args, **more):
        save(figure, *args, **more)
        seen.take(figure)

    monkeypatch.setattr(matplotlib.figure.Figure, "savefig", savefig)
    return seen


def out_of_sight(figure):
    """Tick labels beyond the limits of their axis: not drawn, but with an extent."""
    for axes in figure.findobj(lambda artist: hasattr(artist, "xaxis")):
        for axis in (axes.xaxis, axes.yaxis):
            low, high = sorted(axis.get_view_interval())
            slack = 1e-9 * (high - low)
            for tick in (*axis.get_major_ticks(), *axis.get_minor_ticks()):
                if not low - slack <= tick.get_loc() <= high + slack:
                    yield from (tick.label1, tick.label2)


def faults(drawn):
    """Texts that are too small, beyond the edge or on one another."""
    for number, (texts, (wide, tall)) in enumerate(drawn.figures):
        for text, size, box in texts:
            if size < LEAST_PT:
                yield number, text, size
            if min(box.x0, box.y0, wide - box.x1, tall - box.y1) < 0.0:
                yield number, text, box.extents.round(2).tolist(), wide, tall
        for (a, _, box), (b, _, other) in itertools.combinations(texts, 2):
            apart_x = max(box.x0, other.x0) - min(box.x1, other.x1)
            apart_y = max(box.y0, other.y0) - min(box.y1, other.y1)
            if max(apart_x, apart_y) < -TOUCH_IN:
                yield number, a, b


@pytest.mark.parametrize("units", UnitsFirst)
@pytest.mark.nightly
def test_in_a_package(drawn, units):
    project = projects.project().project.model_copy(update={"units_first": units})
    package = assessments.package(assessments.motions(7, seconds=12.0), project=project)
    draw_assessment(package)
    evidence = assessments.evidence(package.assessment)
    draw_plotted(package, evidence)
    assert len(drawn.figures) >= 10
    assert not list(faults(drawn))


@pytest.mark.parametrize("count", by_day([1, 3, 4], 1))
def test_in_the_stability_maps_of_the_manual(drawn, count):
    x, y = np.geomspace(1e2, 1e8, 7), np.geomspace(1e-5, 1e-2, 5)
    one = StabilityMap(
        title="Penalty, explicit: sub-step against stiffness",
        note="",
        x_label="Stiffness per unit weight [1/m]",
        x=x,
        y_label="Sub-step [s]",
        y=y,
        error_percent=np.geomspace(1e-3, 1e3, 35).reshape(5, 7),
        limit=1e-2 / np.sqrt(x / 1e2),
    )
    manual.stability([one] * count)
    assert not list(faults(drawn))


def test_in_the_accuracy_of_every_method_against_run_time(drawn):
    times = {"setting": 1.0, workprecision.TIME: 1e-5, workprecision.SINGLE: 2e-5}
    runs = pd.DataFrame({"method": [*METHODS], "PRD error [%]": 0.5} | times)
    labels = [each.label for each in METHODS.values()]
    ours = [workprecision.OURS, workprecision.FIXED]
    plane = pd.DataFrame({"method": ours + labels[6:9], "residual error [%]": 0.5} | times)
    work.overview(runs, plane, 1e-12)
    assert not list(faults(drawn))


def test_in_the_charts_of_a_study(drawn):
    inch = Quantity.DISPLACEMENT.us
    slopes, levels = np.arange(8.0), np.arange(0.1, 2.05, 0.1)
    design = 0.05 * (1.0 + slopes[:, None]) * levels**3
    family = [(f"{slope:g}°", design[k]) for k, slope in enumerate(slopes)]
    family[-1] = family[-1][0], np.full_like(levels, math.nan)
    study.curves(levels, family, inch, along="PPA [g]", low=0.8, members=list(design / 1.1))
    study.contours(
        levels, slopes, design, design / 1.1, inch, along="PPA [g]", allowed_m=24 * inch.si
    )
    states = [
        limit_state("LS1", [0.41, 0.42, 0.43, 0.44, 0.45, 0.46, 0.47], levels, words="slip begins"),
        limit_state(
            "LS2", [1.3, 1.4, 1.5, 1.52, 1.55, 1.6, 1.7], levels, words="half the clearance is used"
        ),
        limit_state(
            "LS3", [1.65, 1.68, 1.75, 1.8, 1.81, 1.86, 1.94], levels, words="RTU-1 is reached"
        ),
    ]
    few = np.linspace(0.3, 1.5, 5)
    study.contours(
        few, slopes[:2], design[:2, :5] * 40, design[:2, :5] * 20, inch, along="PPA [g]",
        allowed_m=math.nan,
    )  # fmt: skip
    study.fragilities(states, "PPA [g]")
    study.goodness(states, "PPA [g]")
    study.goodness(states[:1], "PPA [g]")
    bars = [
        Bar(name=name, at_low=low, at_high=high, prd_low_m=ends[0], prd_high_m=ends[1])
        for name, low, high, ends in (
            ("intensity", 0.938, 1.54, (0.02, 0.36)),
            ("friction coefficient", 0.538, 0.464, (0.07, 0.15)),
            ("slope", 1.77, 2.23, (0.1, 0.11)),
            ("slope about none", -0.225, 0.225, (0.12, 0.12)),
        )
    ]
    study.tornado(bars, 0.105, inch)
    assert len(drawn.figures) == 7
    curves, posted, contours, *_ = ([text for text, *_ in texts] for texts, _ in drawn.figures)
    assert "7°: none" in curves
    assert sum(text.endswith((" in", " mm)")) for text in contours) > 8, contours
    assert {"2 in", "2 in (51 mm)", "24 in (610 mm)"} <= set(posted)
    assert not list(faults(drawn))


@pytest.mark.quick
def test_a_text_beyond_the_edge_and_two_that_overlap_are_found(drawn):
    for places in ([(0.9, 0.5)], [(0.3, 0.5), (0.32, 0.5)]):
        drawn.figures.clear()
        figure = matplotlib.figure.Figure(figsize=(2.0, 1.0))
        for x, y in places:
            figure.text(x, y, "a long label" if len(places) == 1 else "label", fontsize=9.0)
        drawn.take(figure)
        assert len(list(faults(drawn))) == 1
