"""In every figure of a package, no text leaves the picture and no two texts overlap."""

import itertools
import math

import matplotlib.figure
import numpy as np
import pandas as pd
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text

import scenes
import stand_in
from report.assessment.evidence import support
from report.figures import manual, records, work
from report.figures.base import png_bytes
from report.pages.registry import draw_assessment, draw_plotted
from report.sheet.schema.choices import UnitsFirst
from report.study import figures as study
from report.study.results import LimitState
from report.suite.files import PERIODS_S, spectra_g
from report.text.units import Quantity
from solver.records.record import Record
from solver.rivals.methods import METHODS
from solver.studies.capacity import Capacities
from solver.studies.fragility import fragility
from solver.studies.uncertainty import Bar
from solver.verification import peers
from solver.verification.evidence import PeerPoint, StabilityMap

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
    project = stand_in.project().project.model_copy(update={"units_first": units})
    package = scenes.package(scenes.motions(7, seconds=12.0), project=project)
    draw_assessment(package)
    evidence = support(package.assessment)
    draw_plotted(package, evidence)
    assert len(drawn.figures) >= 10
    assert not list(faults(drawn))


def test_in_pictures_of_records(drawn, noise):
    some = [Record(name=f"HN{k}", dt_s=0.01, a_mps2=noise / (1 + k)) for k in range(4)]
    records.records_picture(some, PERIODS_S, spectra_g(some), png_bytes)
    assert not list(faults(drawn))


@pytest.mark.parametrize("count", [1, 3, 4])
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


def limit_state(name, words, capacity):
    levels, x = np.arange(0.1, 2.05, 0.1), np.array(capacity)
    none = np.zeros(x.size, dtype=bool)
    found = Capacities(
        intensity=x, is_censored=none, end=np.full(x.size, 2.0), falls=none, searched=none
    )
    exceeds = levels > x[:, None]
    fitted = fragility(levels, exceeds, np.ones_like(exceeds), found, seed=1)
    return LimitState(name=name, words=words, limit_m=0.3, fragility=fitted, effects={})


def judges():
    """A run by each program that is compared."""
    point = {"version": "1", "record": "r", "scene": "s", "note": "", "seconds": 1e-2}
    for model, programs in peers.JUDGES.items():
        for each in programs:
            yield PeerPoint(peer=each.name, model=model, prd_error_percent=2.0, **point)


def test_in_the_accuracy_of_every_method_against_run_time(drawn):
    runs = pd.DataFrame({"method": [*METHODS], "setting": 1.0, "time per run [s]": 1e-5})
    for error in ("PRD error [%]", "residual error [%]"):
        runs[error] = 0.5
    work.overview(runs, 1e-12, judges())
    assert not list(faults(drawn))


def test_in_the_charts_of_a_study(drawn):
    inch = Quantity.DISPLACEMENT.us
    slopes, levels = np.arange(8.0), np.arange(0.1, 2.05, 0.1)
    design = 0.05 * (1.0 + slopes[:, None]) * levels**3
    family = [(f"{slope:g}°", design[k]) for k, slope in enumerate(slopes)]
    family[-1] = family[-1][0], np.full_like(levels, math.nan)
    study.curves(levels, family, inch, along="PPA [g]", low=0.8, beside=list(design / 1.1))
    study.contours(
        levels, slopes, design, design / 1.1, inch, along="PPA [g]", allowed_m=24 * inch.si
    )
    states = [
        limit_state("LS1", "slip begins", [0.41, 0.42, 0.43, 0.44, 0.45, 0.46, 0.47]),
        limit_state("LS2", "half the clearance is used", [1.3, 1.4, 1.5, 1.52, 1.55, 1.6, 1.7]),
        limit_state("LS3", "RTU-1 is reached", [1.65, 1.68, 1.75, 1.8, 1.81, 1.86, 1.94]),
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
