"""The layout of the page from 320 to 1920 pixels, as at any zoom, and in print; what axe finds."""

import io
import re
import shutil

import pytest
from axe_playwright_python.sync_playwright import Axe
from pypdf import PdfReader

from fixtures.browser import COLD_MS, at_rest, moved, opened, quiet_page
from fixtures.marks import by_day
from fixtures.paths import ROOT
from fixtures.workbooks import edit, type_into

WIDTHS = by_day([1366, 390, *range(320, 1921, 40)], 2)
LEAST_PX = 24

FAULTS = """(least) => {
  const all = [...document.querySelectorAll("button, input, select, summary, a, label.button")]
    .filter((one) => one.checkVisibility({ visibilityProperty: true }))
    .filter((one) => !one.closest(".visually-hidden, .skip"))
    .map((one) => ({ one, box: one.getBoundingClientRect() }));
  const name = ({ one }) => one.id || one.textContent.trim().slice(0, 20) || one.type;
  const scrolls = ({ one }) => one.closest(".results, .wide, .problem-list");
  const isSmall = ({ box }) => box.width < least - 0.1 || box.height < least - 0.1;
  const isOutside = ({ box }) => box.left < -0.5 || box.right > innerWidth + 0.5;
  // What is cut without a title, and does not scroll, cannot be read.
  const isCut = (one) => one.checkVisibility() && one.scrollWidth > one.clientWidth + 1
    && (one.matches("button") || getComputedStyle(one).overflowX === "hidden")
    && !one.closest("[title], .visually-hidden, svg, input");
  const meets = (from, to) => Math.min(...to) - Math.max(...from) > 1;
  const list = (one) => one.closest("#reasons"); // it opens over what is below it
  const isOver = ({ one, box }, { one: other, box: at }) => !one.contains(other)
    && !other.contains(one) && list(one) === list(other)
    && meets([box.left, at.left], [box.right, at.right])
    && meets([box.top, at.top], [box.bottom, at.bottom]);
  const found = {
    small: all.filter(isSmall).map((each) => [name(each), each.box.width, each.box.height]),
    outside: all.filter((each) => !scrolls(each) && isOutside(each)).map(name),
    cut: [...document.querySelectorAll("body *")].filter(isCut).map((one) => name({ one })),
    over: all.flatMap((each, k) => all.slice(k + 1).filter((other) => isOver(each, other))
      .map((other) => [name(each), name(other)])),
    sideways: [document.documentElement.scrollWidth].filter((wide) => wide > innerWidth),
  };
  return Object.entries(found).filter(([, names]) => names.length > 0);
}"""
SIZES = """() => {
  const isText = (node) => node.nodeType === 3 && node.data.trim();
  const hasText = (one) => [...one.childNodes].some(isText);
  const texts = [...document.querySelectorAll("body *")].filter((one) => one.checkVisibility())
    .filter((one) => hasText(one) && !one.closest(".visually-hidden, sub"));
  return [...new Set(texts.map((one) => getComputedStyle(one).fontSize))].toSorted();
}"""


def faults(page):
    """What is wrong with the controls of a page that is not scrolled below the bar in sight."""
    page.evaluate("scrollTo(0, 0)")
    return page.evaluate(FAULTS, LEAST_PX)


@pytest.fixture(scope="module")
def shown(browser, address):
    with quiet_page(browser) as page:
        opened(page, address)
        at_rest(page)
        yield page


LONG = "of the roof north of the expansion jt"


@pytest.fixture(scope="module")
def crowded(tmp_path_factory):
    """The campus with 61 clearances too short, one of its 30 arrays with a long name."""
    folder = tmp_path_factory.mktemp("crowded") / "campus"
    shutil.copytree(ROOT / "projects" / "campus", folder, ignore=shutil.ignore_patterns("out"))
    cells = {f"Clearances/{row}/Provided clearance": 50 for row in range(1, 62)}
    edit(type_into(folder / "input.xlsx", cells), rename)
    return folder


def rename(book):
    rows = (*book["Arrays"].iter_rows(), *book["Clearances"].iter_rows())
    for cell in (cell for row in rows for cell in row if cell.value == "A9"):
        cell.value = f"A9 {LONG}"


def opened_crowded(page, address, folder):
    page.goto(address, timeout=COLD_MS)
    page.wait_for_selector("body[data-phase=rest]", timeout=COLD_MS)
    page.set_input_files("#folder", folder)
    page.get_by_role("heading", name="Campus").wait_for(timeout=60_000)
    at_rest(page)


def states(page, folder):
    """Yield the page in each of its states, and leave it as it was."""

    def named(name):
        return page.get_by_role("button", name=name)

    def open_all(inside):
        folded = page.locator(f"{inside} details:not([open]) > summary")
        folded.evaluate_all("(all) => all.forEach((one) => one.click())")

    def back():
        named(re.compile("^Back")).click()
        page.get_by_role("heading", name="Inputs").wait_for()
        assert page.get_by_role("region", name="Next step").is_hidden()  # that of the other

    yield "at rest"
    named("Causes and conditions").click()
    open_all("#reasons")
    yield "causes open"
    page.keyboard.press("Escape")
    open_all("#results")
    named("A1 to A2").click()
    yield "arrays open, a clearance picked"
    named("Edit workbook").click()
    named("Fill in and check").wait_for()
    open_all("#problems")
    yield "fields"
    back()
    faulty = type_into(
        shutil.copy(folder / "input.xlsx", folder.parent / "faulty.xlsx"),
        {f"Arrays/A{number}/CG height": "low" for number in (1, 2, 3)},
    )
    page.set_input_files("#files", faulty)
    page.get_by_text("8 more with the same remedy").wait_for()
    open_all("#problems")
    yield "a faulty workbook without its records"
    back()
    named("New project").click()
    page.get_by_text("no array is entered").wait_for()
    yield "a new project"
    back()


@pytest.mark.nightly
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing_wrong_with_61_clearances_ng(browser, address, crowded, scheme):
    rules = {"resultTypes": ["violations"], "rules": {"target-size": {"enabled": True}}}
    with quiet_page(browser, color_scheme=scheme) as page:
        opened_crowded(page, address, crowded)
        assert page.locator("#clearances").get_by_text("NG", exact=True).count() == 61
        for state in states(page, crowded):
            assert Axe().run(page, options=rules).generate_snapshot() == "", state


@pytest.mark.nightly
def test_it_stays_so_with_30_arrays_and_61_clearances_ng(browser, address, crowded):
    with quiet_page(browser) as page:
        opened_crowded(page, address, crowded)
        for wide in (320, 720, 1152, 1920):
            page.set_viewport_size({"width": wide, "height": 800})
            page.wait_for_timeout(300)  # a sheet for this width
            for state in states(page, crowded):
                assert faults(page) == [], (wide, state)


@pytest.mark.parametrize("wide", WIDTHS)
def test_nothing_overlaps_is_cut_or_too_small_to_press(shown, wide):
    shown.set_viewport_size({"width": wide, "height": 800})
    shown.wait_for_timeout(200)  # a sheet for this width
    assert faults(shown) == []


@pytest.mark.nightly
@pytest.mark.parametrize("wide", [320, 640, 720, 1152, 1366, 1920])
def test_it_stays_so_with_values_that_changed_and_in_every_view(shown, wide):
    shown.set_viewport_size({"width": wide, "height": 800})
    moved(shown, "friction", 0.8)
    at_rest(shown)
    assert faults(shown) == []
    for tab in ("slide", "contour", "plan"):
        shown.click(f"#tab-{tab}")
        if tab != "plan":
            shown.wait_for_selector(f"#{tab} .view:not(.is-stale) svg")
        assert faults(shown) == [], tab
    shown.click("#reset-all")
    at_rest(shown)


def test_make_package_is_on_the_first_screen_of_a_laptop(shown):
    shown.set_viewport_size({"width": 1366, "height": 657})
    box = shown.locator("#make-package").bounding_box()
    assert box["y"] + box["height"] < 657
    assert shown.evaluate(SIZES) == ["13px", "15px", "22px"]


def printed(page):
    """The texts of a page as printed, each sheet numbered and no heading alone at its foot."""
    sheets = PdfReader(io.BytesIO(page.pdf(prefer_css_page_size=True))).pages
    texts = []
    for number, sheet in enumerate(sheets, start=1):
        foot = f"Page {number} of {len(sheets)}"
        text = sheet.extract_text()
        assert foot in text
        texts.append(text.replace(foot, "").strip())
    heads = ("Arrays: displacement", "Clearances", "No. From, to Provided Required D/C Verdict")
    assert not any(text.endswith(heads) for text in texts)
    return texts


@pytest.mark.nightly
def test_a_printed_page_has_its_version_and_date(shown):
    first = printed(shown)[0]
    assert "Roofslip" in first
    assert "printed" in first


@pytest.mark.nightly
def test_30_arrays_with_61_clearances_ng_are_printed_whole_on_four_sheets(
    browser, address, crowded
):
    with quiet_page(browser) as page:
        opened_crowded(page, address, crowded)
        texts = printed(page)
    assert len(texts) <= 4
    rows = [line for text in texts for line in text.splitlines() if line.endswith("NG")]
    assert len([row for row in rows if re.match(r"\d+ ?A\d+", row)]) == 61
    assert sum(LONG in row for row in rows) == 5
