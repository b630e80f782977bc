"""Claim: the page follows a slider at once.

In the browser, from the event to the drawn answer: the first answer to a move; the full one from
when it is let go, once that answer is drawn. The first is provisional unless the full one is there
sooner: the figures say how many were. Each move is to another value, half a second after the answer
before. Wall time: other programs on the same cores slow it down.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from measure import SMOKE, figure

from browsing import chromium, opened, quiet_page, served

if TYPE_CHECKING:
    from playwright.sync_api import Page

MOVES = 2 if SMOKE else 30
STEPS = {"friction": (0.69, 0.01), "slope": (0.1, 0.1), "intensity": (0.7, 0.02),
         "clearance": (-8.0, 1.0)}  # fmt: skip

MEASURED = """
async ([slider, values, isLetGo]) => {
  const input = document.querySelector(`#slider-${slider}`);
  const drawn = (event, kinds) => new Promise((done, fail) => {
    const observer = new MutationObserver(() => {
      const { values } = document.body.dataset;
      if (!kinds.includes(values)) return;
      observer.disconnect();
      clearTimeout(limit);
      requestAnimationFrame(() => done([performance.now() - start, values]));
    });
    const limit = setTimeout(() => fail(new Error(`no answer to ${slider} is drawn`)), 30_000);
    observer.observe(document.body, { attributes: true, attributeFilter: ["data-values"] });
    const start = performance.now();
    input.dispatchEvent(event);
  });
  const times = [];
  for (const value of values) {
    await new Promise((done) => setTimeout(done, 500));
    input.value = value;
    const moved = new InputEvent("input", { bubbles: true });
    const first = await drawn(moved, ["provisional", "final"]);
    const isAsked = isLetGo && first[1] === "provisional";
    const letGo = new PointerEvent("pointerup", { bubbles: true });
    times.push(isAsked ? await drawn(letGo, ["final"]) : first);
  }
  return times;
}
"""


def in_the_browser() -> None:
    """Move four sliders of the example, by their own steps."""
    with chromium() as browser, served() as (address, _), quiet_page(browser) as page:
        opened(page, address)
        for name, is_let_go in (("a provisional", False), ("a full", True)):
            every: list[tuple[float, str]] = []
            for slider, (first, step) in STEPS.items():
                values = [round(first + step * move, 2) for move in range(1 + MOVES)]
                page.locator(f"#slider-{slider}").hover()
                page.mouse.down()  # a slider that is not dragged is answered in full at once
                every += page.evaluate(MEASURED, [slider, values, is_let_go])[1:]
                page.mouse.up()
                page.wait_for_selector("body[data-phase=rest]")
            half, most = np.percentile([time_ms for time_ms, _ in every], [50, 95])
            figure(f"{name} answer drawn, median", float(half), "ms")
            figure(f"{name} answer drawn, 95th percentile", float(most), "ms")
            if not is_let_go:
                provisional = sum(values == "provisional" for _, values in every)
                figure("moves whose first answer was provisional", provisional / len(every))
        by_pointer(page)


ARMED = """
() => {
  window.drawn = new Promise((done, fail) => {
    let start = null;
    const limit = setTimeout(() => fail(new Error("no answer to the pointer is drawn")), 30_000);
    addEventListener("input", () => { start = performance.now(); }, { once: true, capture: true });
    const observer = new MutationObserver(() => {
      const isNew = ["provisional", "final"].includes(document.body.dataset.values);
      if (start === null || !isNew) return;
      observer.disconnect();
      clearTimeout(limit);
      requestAnimationFrame(() => done(performance.now() - start));
    });
    observer.observe(document.body, { attributes: true, attributeFilter: ["data-values"] });
  });
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
    half, most = np.percentile(times, [50, 95])
    figure("a move of the pointer, first value drawn, median", float(half), "ms")
    figure("a move of the pointer, first value drawn, 95th percentile", float(most), "ms")


if __name__ == "__main__":
    in_the_browser()
