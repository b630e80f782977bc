"""The layout of the page from 320 to 1920 pixels, as at any zoom, and in print."""

import io

import pytest
from pypdf import PdfReader

from fixtures.browser import at_rest, moved, opened, quiet_page
from fixtures.marks import by_day

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
  const isCut = ({ one }) => one.matches("button") && one.scrollWidth > one.clientWidth + 1;
  const meets = (from, to) => Math.min(...to) - Math.max(...from) > 1;
  const isOver = ({ one, box }, { one: other, box: at }) => !one.contains(other)
    && !other.contains(one) && meets([box.left, at.left], [box.right, at.right])
    && meets([box.top, at.top], [box.bottom, at.bottom]);
  const found = {
    small: all.filter(isSmall).map((each) => [name(each), each.box.width, each.box.height]),
    outside: all.filter((each) => !scrolls(each) && isOutside(each)).map(name),
    cut: all.filter(isCut).map(name),
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


@pytest.mark.nightly
def test_a_printed_page_has_its_version_and_date_and_no_heading_alone_at_a_foot(shown):
    pages = PdfReader(io.BytesIO(shown.pdf(prefer_css_page_size=True))).pages
    texts = [page.extract_text() for page in pages]
    assert "Roofslip" in texts[0]
    assert "printed" in texts[0]
    heads = ("Arrays: displacement", "Clearances", "No. From, to Provided Required D/C Verdict")
    for text in texts:
        assert not text.strip().endswith(heads)
