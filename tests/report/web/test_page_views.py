"""The views in a real browser, with answers of the real functions and no server."""

import itertools
import math
import re

import numpy as np
import pytest

from fixtures import project_parts, projects
from fixtures.browser import called, quiet_page, serve_scripts
from fixtures.spaces import spaced
from report.text.units import Quantity, measured, number, pair
from report.web import views

MOTIONS = projects.motions(2, seconds=8.0)
MOUNT = """
async ([view, data, wide]) => {
  document.body.innerHTML =
    '<link rel="stylesheet" href="/static/style.css">' +
    '<link rel="stylesheet" href="/static/views.css">' +
    '<main style="display: block"><div class="view"></div></main>';
  const element = document.querySelector('.view');
  element.style.width = `${wide}px`;
  window.asked = [];
  window.said = [];
  window.reply = async () => data;
  const ask = (request) => (asked.push(request), reply(request));
  const load = () => import(`/static/${view}.js`);
  const { createView } = await import('/static/view-frame.js');
  const scene = { values: { friction: 1 }, array: 'A2', motion: 'M1' };
  window.view = createView(element, load, ask, (text) => said.push(text));
  window.view.update(scene);
  while (!element.querySelector('svg')) await new Promise((done) => setTimeout(done, 5));
  while (document.styleSheets.length < 2) await new Promise((done) => setTimeout(done, 5));
}"""


DATA = projects.project(
    options=project_parts.REVIEW,
    arrays=[projects.array("A1", 0.5), projects.array("A2", 2.0, x=120, downslope_deg=30.0)],
    objects=[projects.roof_object("RTU-1", "fixed object", 107, 112, 35, 42)],
    clearances=[projects.clearance("A1", "RTU-1", 9.0)],
)


@pytest.fixture(scope="module")
def assessment():
    return projects.assess_input(DATA, MOTIONS)


@pytest.fixture(scope="module")
def run(assessment):
    return views.slide(assessment, "A2", "M1")


@pytest.fixture(scope="module")
def page(scripts):
    return scripts


def mounted(page, view, data, wide=590):
    page.mouse.move(1270, 710)
    page.evaluate(MOUNT, [view, data, wide])


def press(page, selector, *keys):
    """Choose an element and press keys, one after the other."""
    page.focus(selector)
    for key in keys:
        page.keyboard.press(key)


def text(page, selector):
    return page.locator(selector).inner_text()


def value_at(series, dt_s, time):
    """What a history has at a time; None where it has nothing."""
    at = np.array(series.get("i", range(len(series["v"]))))
    return float(np.interp(time, at * dt_s, np.array(series["v"], float)))


def test_a_reading_is_written_as_in_the_package(page):
    inch, mm = ("in", 0.0254, 1), ("mm", 1e-3, 0)
    units = [dict(zip(("symbol", "si", "decimals"), unit, strict=True)) for unit in (inch, mm)]
    values = [*np.random.default_rng(5).normal(size=200).tolist(), 0.0, -1e-9, -0.04, 123.4]
    body = "return [null, ...g.values].map((v) => m.reading(v, g.units));"
    none, *found = called(page, "reading", body, {"values": values, "units": units})
    assert found == [spaced(pair(value, Quantity.DISPLACEMENT)) for value in values]
    assert none == number(math.nan, 1)
    ticks = "return [[-0.5, 0.1], [20, 10], [0, 2]].map((both) => m.tickText(...both));"
    assert called(page, "reading", ticks) == ["−0.5", "20", "0"]


TICKS = [(0.0, 30.0, 6), (-0.013, 0.0042, 4), (0.31, 0.75, 7), (-900.0, 3.0, 3)]


@pytest.mark.parametrize(("low", "high", "wanted"), TICKS)
def test_ticks_are_round_within_their_range_and_not_too_many(page, low, high, wanted):
    found = called(page, "view-parts", "return m.ticks(...g);", [low, high, wanted])
    values, step = found["values"], found["step"]
    assert float(f"{step:e}"[0]) in (1.0, 2.0, 5.0)
    assert low - 1e-9 <= values[0] < values[-1] <= high + 1e-9
    assert 2 <= len(values) <= 1.5 * wanted + 1


def test_numbers_are_rounded_down_and_a_value_between_samples_is_on_the_line(page):
    values = [1.0, 1.99, 2.0, 4.9, 73.0, 0.034]
    below = called(page, "view-parts", "return g.map(m.roundBelow);", values)
    assert below == pytest.approx([1.0, 1.0, 2.0, 2.0, 50.0, 0.02])
    series = {"t": [0.0, 0.1, 0.4, 0.5, 0.6], "v": [1.0, 3.0, -3.0, None, 2.0]}
    times = [0.0, 0.05, 0.1, 0.25, 0.4, 0.45, 0.5, 0.6, 0.7]
    body = "return g.times.map((t) => m.valueAt(g, t));"
    found = called(page, "view-panels", body, series | {"times": times})
    assert found == pytest.approx([1.0, 2.0, 3.0, 0.0, -3.0, None, None, 2.0, 2.0], abs=1e-12)


def test_a_curve_goes_through_every_sample_and_stops_where_there_is_none(page):
    t, v = np.arange(1000) * 0.005, np.random.default_rng(1).normal(size=1000).tolist()
    v[500:510] = [None] * 10
    body = "return m.curve(g, (v) => 100 * v).map((one) => one.getAttribute('d'));"
    drawn = called(page, "view-panels", body, {"t": t.tolist(), "v": v, "look": "is-first"})
    pieces = [
        [tuple(map(float, place.split())) for place in re.split("[ML]", one)[1:]] for one in drawn
    ]
    assert [one.count("M") for one in drawn] == [1, 2, 1]
    assert all(before[-1] == after[0] for before, after in itertools.pairwise(pieces))
    through = dict(itertools.chain.from_iterable(pieces))
    expected = {round(at, 4): 100 * value for at, value in zip(t, v, strict=True) if value}
    assert through == pytest.approx(expected, abs=0.006)


def test_between_computed_points_the_logarithm_is_linear(page):
    xs, ys = [0.3, 0.4, 0.6], [0.0, 1.0, 3.0]
    values = np.random.default_rng(8).uniform(0.01, 2.0, (3, 3)).tolist()
    at = [[0.3, 0.0], [0.6, 3.0], [0.35, 1.0], [0.57, 2.2]]
    body = "return g.at.map(([x, y]) => m.surfaceAt(g.xs, g.ys, g.values, x, y, 1e-4));"
    found = called(page, "contour", body, {"xs": xs, "ys": ys, "values": values, "at": at})
    logs = np.log10(values)
    for (x, y), one in zip(at, found, strict=True):
        rows = [np.interp(x, xs, row) for row in logs]
        assert one["value"] == pytest.approx(10.0 ** np.interp(y, ys, rows), rel=1e-12)
    assert [one["isComputed"] for one in found] == [True, True, False, False]


def clock(page):
    return float(text(page, ".clock").split()[0])


def test_the_run_opens_at_its_peak_with_the_values_of_the_package_and_the_array_there(page, run):
    mounted(page, "slide", run)
    assert text(page, ".watch-head strong") == run["texts"]["prd"]
    assert clock(page) == round(run["t_prd_s"], 2)
    downslope, force = (
        value_at(run[name]["series"][0], run["dt_s"], run["t_prd_s"])
        for name in ("relative", "normal")
    )
    heads = page.locator(".panel-head").all_inner_texts()
    assert f"{measured(downslope, Quantity.DISPLACEMENT.us)} in" in heads[0]
    assert f"{number(force, 2)} W" in heads[1]
    assert "used" in heads[2]
    # At the PRD the array is on its mark, in the direction of its slope.
    on_roof = page.locator(".track").nth(1)
    moved = on_roof.locator("g g").first.get_attribute("transform")
    x, y = map(float, re.findall(r"-?[\d.]+", moved))
    peak = on_roof.locator(".peak")
    assert x == pytest.approx(float(peak.get_attribute("cx")), abs=0.15)
    assert y == pytest.approx(float(peak.get_attribute("cy")), abs=0.15)
    down, across = (
        value_at(series, run["dt_s"], run["t_prd_s"]) for series in run["relative"]["series"]
    )
    turn = math.radians(run["plan"]["downslope_deg"])
    assert math.atan2(-y, x) == pytest.approx(turn + math.atan2(across, down), abs=0.01)
    bar = on_roof.locator(".track-foot .bar-line").evaluate("(one) => one.getBBox().width")
    inches = float(on_roof.locator(".track-foot .label").text_content().split()[0])
    assert math.hypot(x, y) / bar * inches * 0.0254 == pytest.approx(run["prd_m"], rel=0.01)


def test_slips_are_gone_through_one_at_a_time_by_keys_and_by_buttons(page, run):
    mounted(page, "slide", run)
    slips = run["slips"]
    before, after = (
        page.locator(f"[aria-label='{name}']") for name in ("Slip before", "Next slip")
    )
    press(page, ".watch", "Home")
    assert clock(page) == 0.0
    assert text(page, ".slip-text") == f"At rest, after 0 of {len(slips)} slips"
    assert before.is_disabled()
    press(page, ".watch", "n", "N")
    assert text(page, ".slip-text") == slips[1]["text"]
    assert slips[1]["text"].startswith(f"Slip 2 of {len(slips)}: ")
    assert clock(page) == round(slips[1]["to_s"], 2)
    assert page.locator(".track-picked").nth(1).get_attribute("visibility") == "visible"
    after.click()
    before.click()
    assert clock(page) == round(slips[1]["to_s"], 2)
    press(page, ".watch", "p")
    assert page.evaluate("said.at(-1)") == slips[0]["text"]
    press(page, ".watch", "End")
    assert after.is_disabled()
    assert clock(page) == pytest.approx(run["seconds"], abs=0.006)


def is_stale(page):
    return "is-stale" in page.locator(".view").get_attribute("class")


@pytest.mark.nightly
def test_it_plays_at_a_speed_pauses_and_stops_when_a_slider_moves(page, run):
    mounted(page, "slide", run)
    press(page, ".watch", ">")
    assert page.locator("[aria-label=Speed]").input_value() == "2"
    page.keyboard.press(" ")
    assert text(page, ".play") == "Pause"
    page.wait_for_function("parseFloat(document.querySelector('.clock').textContent) > 0.2")
    assert clock(page) < run["t_prd_s"]  # it started from the beginning
    page.keyboard.press(" ")
    stopped = clock(page)
    page.wait_for_timeout(60)
    assert clock(page) == stopped
    page.keyboard.press(" ")
    page.evaluate("view.moving()")
    assert text(page, ".play") == "Play"
    assert is_stale(page)
    page.evaluate("view.update({ values: { friction: 1 }, array: 'A2', motion: 'M1' })")
    assert not is_stale(page)
    assert page.evaluate("asked.length") == 1  # the same values: nothing is asked again


@pytest.mark.nightly
def test_where_motion_is_to_be_reduced_it_goes_from_event_to_event(browser, run):
    with quiet_page(browser, reduced_motion="reduce") as page:
        serve_scripts(page)
        page.clock.install()
        mounted(page, "slide", run)
        page.locator(".play").click()
        events = [slip[end] for slip in run["slips"] for end in ("from_s", "to_s")]
        for event in events[:3]:
            page.clock.run_for(700)
            assert clock(page) == round(event, 2)


def test_another_run_is_asked_by_name_an_error_is_said_and_a_late_answer_is_marked(page, run):
    mounted(page, "slide", run)
    page.locator(".toolbar select").select_option("record +")
    page.wait_for_function("asked.length === 2")
    chosen = {"array": "A2", "motion": "M1", "values": {"friction": 1}, "run": "record +"}
    assert page.evaluate("asked[1]") == chosen
    page.evaluate("() => { reply = async () => { throw new Error('Choose another motion.'); }; }")
    page.evaluate("view.update({ values: { friction: 2 }, array: 'A2', motion: 'M2' })")
    assert text(page, ".view [role=alert]") == "Choose another motion."
    assert "run" not in page.evaluate("asked[2]")  # another motion: its governing run
    # An answer that comes while a slider moves is out of date.
    late = """async (data) => {
      let answer;
      reply = () => new Promise((done) => { answer = done; });
      view.update({ values: { friction: 3 }, array: 'A2', motion: 'M1' });
      view.moving();
      answer(data);
      await new Promise((done) => setTimeout(done, 0));
    }"""
    page.evaluate(late, run)
    assert page.locator(".view[aria-busy]").count() == 0
    assert is_stale(page)


def test_an_answer_that_comes_while_the_tab_is_closed_is_drawn_when_it_opens(page, assessment):
    mounted(page, "contour", views.contour(assessment, "A2"))
    late = """async () => {
      const element = document.querySelector(".view");
      const shown = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done, 20)));
      element.hidden = true;
      await shown();
      view.update({ values: { friction: 2 }, array: "A2", motion: "M1" });
      await shown();
      element.hidden = false;
      await shown();
      return document.querySelectorAll(".isoline").length;
    }"""
    assert page.evaluate(late) > 0


def test_a_run_without_displacement_is_drawn_at_rest(page):
    lifted = projects.motion("M1", MOTIONS[0].ax_mps2, 4.0 * MOTIONS[0].az_mps2, dt_s=0.005)
    answer = views.slide(projects.assess_input(DATA, [lifted]), "A2", "M1")
    mounted(page, "slide", answer)
    assert "normal force falls below zero" in text(page, ".slip-text")
    assert "—" in page.locator(".panel-head").first.inner_text()
    texts = page.locator(".track-foot .tick").all_text_contents()
    assert texts[3:] == ["On the roof", "downslope"]  # with no scale of a motion
    assert page.locator(".track .peak").count() == 0


def test_a_contour_is_read_by_keys_at_computed_values_and_by_pointer_between_them(page, assessment):
    data = views.contour(assessment, "A2")
    mounted(page, "contour", data)
    row = int(np.argmin(abs(np.array(data["slopes_deg"]) - data["here"]["slope_deg"])))
    column = int(np.argmin(abs(np.array(data["mus"]) - data["here"]["mu"])))
    here, beside = (
        spaced(pair(data["prd_m"][row + k][column + k], Quantity.DISPLACEMENT)) for k in (0, 1)
    )
    reading = ".contour-reading output"
    assert text(page, reading) == f"μ 0.450, slope 2.00 deg: mean PRD {here}, computed"
    press(page, ".contour", "ArrowRight", "ArrowUp")
    assert text(page, reading).endswith(f"mean PRD {beside}, computed")
    page.keyboard.press("Shift+ArrowLeft")
    assert text(page, reading).endswith("interpolated")
    page.keyboard.press("Home")
    assert text(page, reading).endswith(f"{here}, computed")
    assert page.locator(".isoline").count() >= len(data["levels"])
    labels = page.locator(".contour .label.on-line").all_text_contents()
    assert {level["text"] for level in data["levels"]} & set(labels)
    dot = page.locator(".array-dot circle").last.bounding_box()
    page.mouse.move(dot["x"] + 40, dot["y"] + 4)
    between = r"μ 0\.\d{3}, slope \d\.\d\d deg: mean PRD .* interpolated"
    assert re.search(between, text(page, reading))


CLIPPED = """() => {
  const end = (one) => one.getBoundingClientRect().right;
  const cut = [...document.querySelectorAll('.view, .panel-head')]
    .filter((one) => one.scrollWidth > one.clientWidth || one.scrollHeight > one.clientHeight + 1);
  const beyond = [...document.querySelectorAll('.track text')]
    .filter((one) => end(one) > end(one.ownerSVGElement));
  return [...cut, ...beyond].map((one) => one.outerHTML);
}"""

ON_THE_WORD = """() => [...document.querySelectorAll('.track')].filter((track) => {
  const [word, block] = ['.end-at', '.track-block'].map((one) => track.querySelector(one))
    .map((one) => one.getBoundingClientRect());
  const isAside = word.left >= block.right || block.left >= word.right;
  return !isAside && word.top < block.bottom && block.top < word.bottom;
}).length"""


def test_on_a_phone_no_array_lies_on_the_word_of_its_arrow(page, run):
    mounted(page, "slide", run, wide=296)
    for key in ("Home", "n", "n", "n", "n"):
        assert page.evaluate(ON_THE_WORD) == 0
        press(page, ".watch", key)


@pytest.mark.parametrize("wide", [296, 411, 590, 760])
@pytest.mark.nightly
def test_nothing_of_a_view_is_cut_off_and_in_print_a_run_is_named(page, run, assessment, wide):
    for view, data in {"contour": views.contour(assessment, "A1"), "slide": run}.items():
        mounted(page, view, data, wide=wide)
        page.evaluate("document.fonts.ready")
        assert page.evaluate(CLIPPED) == [], view
        page.emulate_media(media="print")
        for gone in ("select", "button", "[type=range]", "[id$=-keys]"):
            assert page.locator(f".view {gone}:visible").count() == 0, (view, gone)
        if view == "slide":
            title = text(page, ".view .print-only")
            assert title.startswith(f"Array A2, motion M1, run {run['run']}")
        page.emulate_media(media="screen")
