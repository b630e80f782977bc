"""Claim: the page follows a slider at once.

In the browser, from the event to the drawn answer: the first answer to a move; the full one from
when it is let go, once that answer is drawn. The first is provisional unless the full one is there
sooner: the figures say how many were. Each move is to another value, half a second after the answer
before. Wall time: other programs on the same cores slow it down.
"""

import numpy as np
from measure import SMOKE, figure
from playwright.sync_api import Page

from fixtures.browser import chromium, opened, quiet_page, served

MOVES = 2 if SMOKE else 30
STEPS = {"friction": (0.69, 0.01), "slope": (0.1, 0.1), "intensity": (0.7, 0.02),
         "clearance": (-8.0, 1.0)}  # fmt: skip

WATCHING = """
() => {
  // Until the answer of its value is there, what is told beside a slider is of a former one.
  window.watched = (slider, kinds, started) => new Promise((done, fail) => {
    const told = document.querySelector(`output[for=slider-${slider}]`);
    const observer = new MutationObserver(() => {
      const { values } = document.body.dataset;
      const isOfThis = !told.classList.contains("is-former");
      if (started() === null || !isOfThis || !kinds.includes(values)) return;
      observer.disconnect();
      clearTimeout(limit);
      requestAnimationFrame(() => done([performance.now() - started(), values]));
    });
    const limit = setTimeout(() => fail(new Error("no answer is drawn")), 30_000);
    observer.observe(document.body, { attributes: true, attributeFilter: ["data-values"] });
    observer.observe(told, { attributes: true, attributeFilter: ["class"] });
  });
}
"""
MEASURED = """
async ([slider, values, isLetGo]) => {
  const input = document.querySelector(`#slider-${slider}`);
  const answered = (event, kinds) => {
    const start = performance.now();
    const answer = watched(slider, kinds, () => start);
    input.dispatchEvent(event);
    return answer;
  };
  const times = [];
  for (const value of values) {
    await new Promise((done) => setTimeout(done, 500));
    input.value = value;
    const moved = new InputEvent("input", { bubbles: true });
    const first = await answered(moved, ["provisional", "final"]);
    const isAsked = isLetGo && first[1] === "provisional";
    const letGo = new PointerEvent("pointerup", { bubbles: true });
    times.push(isAsked ? await answered(letGo, ["final"]) : first);
  }
  return times;
}
"""


def printed(name: str, times_ms: list[float]) -> None:
    """Print the median and the 95th percentile of times."""
    half, most = np.percentile(times_ms, [50, 95]).tolist()
    figure(f"{name}, median", half, "ms")
    figure(f"{name}, 95th percentile", most, "ms")


def in_the_browser() -> None:
    """Move four sliders of the example, by their own steps."""
    with chromium() as browser, served() as (address, _), quiet_page(browser) as page:
        opened(page, address)
        page.evaluate(WATCHING)
        for name, is_let_go in (("provisional", False), ("final", True)):
            every: list[tuple[float, str]] = []
            for slider, (first, step) in STEPS.items():
                values = [round(first + step * move, 2) for move in range(1 + MOVES)]
                page.locator(f"#slider-{slider}").hover()
                page.mouse.down()  # a slider that is not dragged is answered in full at once
                every += page.evaluate(MEASURED, [slider, values, is_let_go])[1:]
                page.mouse.up()
                page.wait_for_selector("body[data-phase=rest]")
            printed(f"{name} values drawn", [time_ms for time_ms, _ in every])
            if not is_let_go:
                provisional = sum(values == "provisional" for _, values in every)
                share = provisional / len(every)
                figure("share of moves that first showed provisional values", share)
        by_pointer(page)


ARMED = """
() => {
  let start = null;
  addEventListener("input", () => { start = performance.now(); }, { once: true, capture: true });
  window.drawn = watched("friction", ["provisional", "final"], () => start)
    .then(([time_ms]) => time_ms);
}
"""


def by_pointer(page: Page) -> None:
    """Drag the friction of the example under a pointer that stays down, a step or two at a time."""
    slider = page.locator("#slider-friction")
    box = slider.bounding_box()
    assert box is not None
    share = slider.evaluate("({ min, max, step }) => step / (max - min)")
    # Less than a whole step may be none.
    at = [box["x"] + box["width"] * (0.9 - 1.5 * share * k) for k in range(1 + MOVES)]
    page.mouse.move(at[0], box["y"] + box["height"] / 2)
    page.mouse.down()
    times = []
    for x in at[1:]:
        page.wait_for_timeout(500)
        page.evaluate(ARMED)
        page.mouse.move(x, box["y"] + box["height"] / 2)
        times.append(page.evaluate("window.drawn"))
    page.mouse.up()
    page.wait_for_selector("body[data-phase=rest]")
    printed("first value drawn after a pointer movement", times)


if __name__ == "__main__":
    in_the_browser()
