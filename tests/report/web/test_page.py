"""The page in a real browser, with a real server: what a user sees and moves."""

import os
import re
import signal
from urllib.parse import urlsplit

import pytest
from axe_playwright_python.sync_playwright import Axe

from fixtures.browser import (
    PHONE,
    TABLET,
    at_rest,
    moved,
    numbers,
    opened,
    processes_of,
    quiet_page,
    tab_to,
    verdicts,
)
from fixtures.marks import by_day
from fixtures.paths import ROOT
from fixtures.spaces import spaced

EXAMPLE = ROOT / "projects" / "example"


UNNAMED = """() => {
  const all = document.querySelectorAll("button, input, select, [role=img], [role=tabpanel]");
  const named = (each) => each.labels?.length || each.textContent.trim() || each.ariaLabel
    || each.getAttribute("aria-labelledby");
  return [...all].filter((each) => each.checkVisibility() && !named(each))
    .map((each) => each.outerHTML);
}"""


def test_a_first_visit_shows_the_example_running_says_what_to_do_and_has_names_for_all(page):
    assert "This is the example" in page.inner_text("#welcome")
    assert page.title().startswith(page.inner_text("h1"))
    assert "token" not in page.url
    # The project, its arrays and clearances.
    assert verdicts(page) == ["OK"] + ["OK"] * 3 + ["OK"] * 6
    assert page.locator("#plan-drawing .array").count() == 3
    assert page.locator("#plan-drawing .number").count() == 6
    assert page.locator("#bars tbody tr").count() == 7
    assert page.evaluate("document.fonts.check('13px \"Source Sans 3\"')")
    assert page.evaluate("document.body.scrollWidth <= innerWidth")
    assert page.evaluate(UNNAMED) == []
    assert page.inner_text("#live").startswith(f"{verdicts(page)[0]}.")
    assert page.locator("#slider-friction").get_attribute("aria-valuetext")
    assert "required" in page.locator("#plan-description").text_content()
    assert urlsplit(page.url).query == ""


# Each with a friction that the server has not answered, so that the page is seen as it waits.
@pytest.mark.parametrize(("scheme", "friction"), [("light", 0.8), ("dark", 0.81)])
@pytest.mark.nightly
def test_axe_finds_nothing_wrong_in_any_state_of_the_page(browser, address, scheme, friction):
    axe = Axe()

    def findings():
        return axe.run(page).generate_snapshot()

    with quiet_page(browser, color_scheme=scheme) as page:
        opened(page, address)
        moved(page, "friction", 1.04)  # above the smallest tested, beyond the tests
        at_rest(page)
        assert page.inner_text("#verdict .tag") == "OK with conditions"
        page.click("#causes")
        assert findings() == ""
        page.keyboard.press("Escape")
        for tab in ("slide", "contour"):
            page.click(f"#tab-{tab}")
            page.wait_for_selector(f"#{tab} .view:not(.is-stale) svg")
            assert findings() == "", tab
        moved(page, "friction", friction)
        assert page.locator("body").get_attribute("data-phase") != "rest"
        page.click("#tab-plan")
        assert findings() == ""
        at_rest(page)
        page.set_viewport_size(PHONE)
        page.wait_for_timeout(300)  # a sheet for this width
        assert findings() == ""
        page.set_input_files("#files", EXAMPLE / "input.xlsx")
        page.wait_for_selector("#problems tbody tr")
        assert findings() == ""


SHOWN = """() => {
  window.seen = [];
  const shown = (tag) => tag.checkVisibility({ visibilityProperty: true });
  new MutationObserver(() => {
    const tags = [...document.querySelectorAll(".tag, .ng-box")].filter(shown);
    window.seen.push([document.body.dataset.phase, tags.map((tag) => tag.textContent),
      document.querySelector("#verdict").textContent]);
  }).observe(document.querySelector("#verdict"), { childList: true, subtree: true });
}"""


@pytest.mark.nightly
def test_while_a_slider_moves_there_is_no_verdict_and_the_page_says_which_model(page):
    page.evaluate(SHOWN)
    # It goes on moving until its values are shown, as under a finger.
    for step in range(1000):
        moved(page, "friction", 0.7 + step % 2 / 100)
        page.wait_for_timeout(20)  # the server works on the same cores
        if "only in the orientations" in page.locator("#verdict").text_content():
            break
    at_rest(page)
    seen = page.evaluate("seen")
    moving = [tags for phase, tags, _ in seen if phase == "moving"]
    assert moving
    assert all(tags == ["Provisional"] for tags in moving)
    # On a busy machine the slider may rest before its first value is there.
    provisional = [words for phase, _, words in seen if phase in ("moving", "settling")]
    assert any("only in the orientations" in words for words in provisional)
    assert "Full model" in page.locator("#verdict").text_content()
    assert verdicts(page)[0] == "NG"
    failing = numbers(page, "clearances", 6).count("NG")
    assert failing > 0
    assert page.locator("#plan-drawing .ng-area").count() == failing
    assert page.locator("#plan-drawing .ng-box").all_text_contents() == ["NG"] * failing


PLACES = """() => [...document.querySelectorAll("main :is(button, input, select, #plan-drawing)")]
  .filter((one) => one.checkVisibility()).map((one) => {
    const { x, y, width, height } = one.getBoundingClientRect();
    return [one.id || one.textContent || one.type, x, y, width, height].join(" ");
  })"""


@pytest.mark.parametrize(
    "size", by_day([{"width": 1440, "height": 900}, {"width": 1024, "height": 768}, PHONE], 1)
)
def test_no_control_moves_with_the_verdict_and_the_plan_is_on_the_first_screen(page, size):
    page.set_viewport_size(size)
    page.wait_for_timeout(300)  # a sheet for this width
    at_rest(page)
    before = page.evaluate(PLACES)
    moved(page, "friction", 0.8)
    assert page.locator("body").get_attribute("data-phase") != "rest"
    moving = page.evaluate(PLACES)
    at_rest(page)
    assert page.inner_text("#verdict .tag") == "NG"
    assert before == moving == page.evaluate(PLACES)
    end = page.locator("#plan-drawing .roof").evaluate(
        "(one) => one.getBoundingClientRect().bottom"
    )
    assert end <= size["height"]


def test_the_plan_tells_what_is_under_the_pointer_selects_with_the_table_and_zooms(page):
    said = page.locator("#plan-said")
    page.hover("#plan-drawing [data-key='#5']")
    text = spaced(said.inner_text())
    assert text.startswith("Clearance 5, A3 to PV-OLD, upslope: provided 72.0 in (")
    assert said.inner_text().endswith(", D/C 0.66")
    page.hover("#plan-drawing [data-key=A3]")
    assert re.fullmatch(r"A3: Δ 47.4\sin .*, D/C 0.79 to RTU-2", said.inner_text())
    page.click("#plan-drawing [data-key='#5']")
    assert page.locator("#clearances .is-picked").inner_text().startswith("5")
    page.locator("#clearances [data-name='#2']").press("Enter")
    assert page.locator("#plan-drawing .is-picked").get_attribute("data-key") == "#2"
    page.focus("#plan")
    page.keyboard.press("Escape")
    page.keyboard.press("ArrowRight")  # the first: an array
    assert page.locator("#plan-drawing .is-picked").get_attribute("data-key") == "A1"
    page.keyboard.press("ArrowRight")
    assert "A2" in page.inner_text("#bars caption")
    # The wheel scrolls the page, and with Ctrl it zooms about the pointer.
    drawing, spot = page.locator("#plan-drawing > svg"), page.locator("[data-key=A3]")
    whole, (x, y, wide, _) = drawing.get_attribute("viewBox"), spot.bounding_box().values()
    page.mouse.move(x, y)
    page.mouse.wheel(0, 100)
    page.wait_for_timeout(200)
    assert (page.evaluate("scrollY > 0"), drawing.get_attribute("viewBox")) == (True, whole)
    page.evaluate("scrollTo(0, 0)")
    page.keyboard.down("Control")
    page.mouse.wheel(0, -100)
    page.keyboard.up("Control")
    drawing.locator(f"xpath=self::*[not(@viewBox='{whole}')]").wait_for()
    near = spot.bounding_box()
    assert near["width"] == pytest.approx(1.5 * wide, rel=0.02)
    assert (near["x"], near["y"]) == pytest.approx((x, y), abs=2)
    page.click("#zoom-fit")
    assert drawing.get_attribute("viewBox") == whole
    page.focus("#plan")
    page.keyboard.press("+")
    assert drawing.get_attribute("viewBox") != whole
    page.keyboard.press("0")
    assert drawing.get_attribute("viewBox") == whole


@pytest.mark.nightly
def test_undo_and_back_return_to_the_values_before_also_after_a_reload(page):
    moved(page, "friction", 0.9)
    page.wait_for_url("**/#friction=0.9")
    at_rest(page)
    moved(page, "slope", 1.0)
    page.wait_for_url("**/#friction=0.9&slope=1")
    at_rest(page)
    assert page.inner_text("#changed") == "With Friction × 0.90, Slope +1.0°"
    page.reload()
    at_rest(page)
    assert page.locator("#slider-slope").input_value() == "1"
    page.keyboard.press("Control+z")
    page.wait_for_url("**/#friction=0.9")
    assert page.locator("#slider-slope").input_value() == "0"
    page.go_back()
    page.wait_for_url(re.compile(r"/$"))
    at_rest(page)
    assert page.locator("#undo").is_disabled()
    moved(page, "friction", 0.95)
    page.wait_for_url("**/#friction=0.95")
    at_rest(page)
    page.click("#reset-all")
    page.wait_for_url(re.compile(r"/$"))
    assert page.inner_text("#changed") == "With the values of the workbook"


@pytest.mark.nightly
def test_a_mark_on_a_slider_says_where_the_verdict_changes_and_enters_it(page):
    moved(page, "friction", 0.8)
    at_rest(page)
    assert page.inner_text("#verdict .tag") == "NG"
    page.locator("#turn-friction:not(.is-idle)").wait_for(timeout=60_000)
    shown = page.inner_text("#turn-friction")
    page.click("#turn-friction")
    page.wait_for_url(f"**/#friction={shown.removeprefix('OK at × ').rstrip('0')}")
    at_rest(page)
    assert page.inner_text("#verdict .tag") == "OK with conditions"
    at = float(page.locator("#slider-friction").input_value())
    moved(page, "friction", round(at - 0.01, 2))
    at_rest(page)
    assert page.inner_text("#verdict .tag") == "NG"


@pytest.mark.nightly
def test_beside_the_sliders_is_nothing_of_other_values_while_these_are_computed_or_fail(page):
    friction = page.locator("#controls .slider").first
    text, held = friction.locator("output"), []

    def assert_nothing_is_said():
        text.wait_for(state="hidden")
        assert friction.locator(".amount").inner_text() == "× 0.79"
        assert page.locator("#controls output:visible, #controls .turn:visible").count() == 0
        assert page.locator("#slider-friction").get_attribute("aria-valuetext") == "× 0.79"

    moved(page, "friction", 0.8)
    at_rest(page)
    assert text.inner_text().startswith("0.40 (A1, A2)")
    page.locator("#turn-friction:not(.is-idle)").wait_for(timeout=60_000)
    page.route("**/api/assess", lambda route: held.append(route))
    page.locator("#slider-friction").press("ArrowLeft")
    assert_nothing_is_said()
    for route in held:
        route.abort()
    page.wait_for_selector("body[data-phase=failed]")
    assert_nothing_is_said()
    page.unroute("**/api/assess")
    page.click("text=Try again")
    at_rest(page)
    assert text.inner_text().startswith("0.395 (A1, A2)")


@pytest.mark.nightly
def test_units_are_a_choice_of_the_page_and_of_what_is_saved(page):
    page.select_option("#choice-units", "SI")
    page.wait_for_url("**/#units=SI")
    at_rest(page)
    assert numbers(page, "arrays", 2)[0] == "429 mm"
    assert numbers(page, "clearances", 3)[0] == "2438 mm"


WATCH = """() => {
  window.seen = [];
  const visible = (all) => [...document.querySelectorAll(all)]
    .filter((one) => one.checkVisibility({ visibilityProperty: true }));
  const look = () => window.seen.push({
    tags: visible(".tag, .ng-box").map((tag) => tag.textContent),
    verdict: document.querySelector("#verdict").textContent,
    said: document.querySelector("#live").textContent + document.querySelector("desc").textContent,
    captions: [...document.querySelectorAll(".results caption")]
      .map((caption) => getComputedStyle(caption, "::after").content),
    heavy: visible(".ng-area").length,
  });
  const ofSlider = (event) => event.target.type === "range" && look();
  for (const kind of ["change", "click"]) document.addEventListener(kind, look);
  document.addEventListener("input", ofSlider);
}"""
"""Looks at the page after its own handlers of an event, before a frame is drawn."""


def drag(page):
    box = page.locator("#slider-friction").bounding_box()
    page.mouse.move(box["x"] + 0.6 * box["width"], box["y"] + box["height"] / 2)
    page.mouse.down()


CHANGES = {
    "pointer": drag,
    "keyboard": lambda page: page.locator("#slider-friction").press("ArrowLeft"),
    "polarity": lambda page: page.select_option("#choice-polarity", "reversed"),
    "rule set": lambda page: page.select_option("#choice-rule_set", "ASCE 7-16"),
}


@pytest.mark.parametrize("how", CHANGES)
@pytest.mark.nightly
def test_the_verdict_blanks_with_the_change_and_stays_so_until_its_answer(page, how):
    """However late the answer is, no verdict stands beside values that it is not of."""
    moved(page, "slope", 1.5)  # some clearances are NG
    at_rest(page)
    assert {"NG", "OK"} <= set(verdicts(page))
    page.evaluate(WATCH)
    held, answered = [], []
    page.route("**/api/assess", lambda route: route.continue_() if answered else held.append(route))
    CHANGES[how](page)
    page.wait_for_timeout(400)  # a frame and more
    page.evaluate("document.dispatchEvent(new Event('click'))")
    seen = page.evaluate("seen")
    assert len(seen) >= 2
    for look in seen:
        assert look["tags"] == ["Provisional"]
        assert "Full model" not in look["verdict"]
        assert "The values below are from before the change." in look["verdict"]
        assert set(look["captions"]) == {'" (before the change)"'}
        assert not re.search(r"\b(OK|NG)\b", look["said"])
        assert look["heavy"] == 0
    answered.append(True)
    for route in held:
        route.continue_()
    page.mouse.up()
    at_rest(page)
    assert "Full model" in page.locator("#verdict").text_content()
    assert "Provisional" not in verdicts(page)
    assert page.locator("#verdict .tag").inner_text() in ("OK", "NG", "OK with conditions")


@pytest.mark.nightly
def test_a_slider_replaces_what_was_half_typed_in_its_field(page):
    page.get_by_label("μ of all").fill("0.42")
    drag(page)
    page.mouse.up()
    page.wait_for_url(re.compile(r"#friction=[\d.]+$"))
    at_rest(page)
    assert page.get_by_label("μ of all").input_value() == ""  # of each array another one


@pytest.mark.nightly
def test_the_workbook_values_have_their_answer_at_once(page):
    before = verdicts(page)
    moved(page, "slope", 1.5)
    at_rest(page)
    assert verdicts(page) != before
    page.route("**/api/assess", lambda route: route.abort())
    page.get_by_label("Slope: reset to the workbook value").click()
    assert verdicts(page) == before
    assert page.locator("body").get_attribute("data-phase") == "rest"


@pytest.mark.nightly
def test_the_page_works_with_the_keyboard_alone(page):
    tab_to(page, page.locator("#files"))
    tab_to(page, page.locator("#make-package"))
    tab_to(page, page.locator("#slider-friction"))
    page.keyboard.press("ArrowLeft")
    page.wait_for_url("**/#friction=0.99")
    page.locator(".skip").press("Enter")
    assert page.evaluate("document.activeElement.id") == "results"
    assert (page.url[-14:], page.inner_text("#changed")) == (
        "#friction=0.99",
        "With Friction × 0.99",
    )
    tab_to(page, page.locator("#tab-plan"))
    page.keyboard.press("End")
    assert page.locator("#contour").is_visible()
    page.keyboard.press("Home")
    assert page.locator("#plan").is_visible()
    tab_to(page, page.locator('[data-name="A2"]'))
    page.keyboard.press("Enter")
    assert "A2" in page.inner_text("#bars caption")
    assert page.evaluate("document.activeElement.dataset.name") == "A2"


@pytest.mark.nightly
def test_a_value_that_the_workbook_refuses_gets_its_reason_and_no_verdict(page):
    page.select_option("#choice-together", "no")
    at_rest(page)
    assert page.locator("#slider-s_ds").is_enabled()
    page.goto(f"{page.url.partition('#')[0]}#friction=1.9")
    page.wait_for_selector("body[data-phase=failed]")
    assert "enter " in page.inner_text("#verdict")
    assert page.locator("#results .tag:visible").count() == 0
    page.get_by_label("Friction: reset to the workbook value").click()
    at_rest(page)
    assert verdicts(page)[0] == "OK"


@pytest.mark.nightly
def test_on_a_tablet_or_phone_nothing_is_cut_off_and_in_print_no_control_is_left(page):
    for size in (TABLET, PHONE):
        page.set_viewport_size(size)
        assert page.evaluate("document.body.scrollWidth <= innerWidth"), size
        assert page.locator("#tabs").evaluate("(one) => one.scrollWidth <= one.clientWidth"), size
    page.emulate_media(media="print")
    for gone in ("#make-package", "#tabs", "#slider-friction", "#choice-rule_set", "label.button"):
        assert page.locator(gone).first.is_hidden(), gone
    assert page.locator("#controls output").first.is_visible()
    assert page.locator("#controls .print-only").first.is_visible()
    page.set_viewport_size({"width": 400, "height": 1100})
    page.wait_for_selector("#plan-drawing > svg[viewBox^='0 0 3']")
    assert page.locator("#plan-drawing").evaluate("(one) => one.clientHeight") > 300


def drawn(page, view, selector, wanted):
    """Wait until a view shows a text of the tables."""
    shown = page.locator(f"#{view} .view:not(.is-stale) {selector}", has_text=wanted)
    shown.first.wait_for()
    return spaced(shown.first.inner_text())


@pytest.mark.nightly
def test_the_views_draw_what_is_chosen_with_the_values_of_the_tables(page):
    page.click("#tab-slide")
    page.select_option("#array", "A2")
    page.select_option("#motion", "RM3")
    prd = spaced(page.locator("#bars tbody tr", has_text="RM3").locator("td.numbers").inner_text())
    assert drawn(page, "slide", ".watch-head strong", prd).startswith(f"PRD {prd} (")
    page.focus("#slide .watch")
    page.keyboard.press("Home")
    page.keyboard.press("n")
    assert drawn(page, "slide", ".slip-text", "Slip 1 of").endswith(" mm)")
    assert drawn(page, "slide", ".toolbar select", f"PRD {prd}, governing")
    page.click("#tab-contour")
    mean = numbers(page, "arrays", 2)[1]
    assert drawn(page, "contour", ".contour-reading output", f"mean PRD {mean} (")
    moved(page, "friction", 0.9)
    assert page.inner_text("#stale-note") == "Drawn for the previous slider values."
    at_rest(page)
    changed = numbers(page, "arrays", 2)[1]
    assert changed != mean
    assert drawn(page, "contour", ".contour-reading strong", f"A2: mean PRD {changed} (")


@pytest.mark.nightly
def test_without_the_server_the_page_says_what_to_do_and_goes_on_when_it_is_back(page):
    busy = {"status": 503, "json": {"error": "Busy."}}
    page.route("**/api/assess", lambda route: route.fulfill(**busy))
    moved(page, "friction", 0.95)
    page.wait_for_selector("#verdict:has-text('No verdict: the server gave no answer.')")
    assert "Busy." in page.inner_text("#error:visible")
    page.route("**/api/assess", lambda route: route.abort())
    page.click("text=Try again")
    page.wait_for_selector("#verdict:has-text('the server does not answer')")
    assert page.locator(".tag:visible").count() == 0
    page.unroute("**/api/assess")
    page.click("text=Try again")
    at_rest(page)
    page.wait_for_selector("#error", state="hidden")


@pytest.mark.nightly
def test_when_every_process_is_killed_the_page_goes_on(page, server):
    before = verdicts(page)
    for pid in processes_of(server[1]):
        os.kill(int(pid), signal.SIGKILL)
    moved(page, "friction", 0.8)
    page.wait_for_selector("body[data-phase=rest]", timeout=60_000)
    assert verdicts(page)[0] == "NG" != before[0]
