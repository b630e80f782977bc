"""Claim: the page follows a slider at once.

In the browser, from the event to the drawn answer: the first answer to a move; the full one from
when it is let go, once that answer is drawn. The first is provisional unless the full one is there
sooner: the figures say how many were. Each move is to another value, half a second after the answer
before. Wall time: other programs on the same cores slow it down.

`page_speed.py --beside TREE` compares with another version instead: both open the campus, 30
arrays, and are moved in turns, from a step of a slider, as by a key, to the answer at rest.
"""

from __future__ import annotations

import argparse
import os
import statistics
from contextlib import ExitStack
from typing import TYPE_CHECKING

import numpy as np
from measure import ROOT, SMOKE, figure

from browsing import chromium, opened, quiet_page, served

if TYPE_CHECKING:
    from playwright.sync_api import Page

MOVES = 2 if SMOKE else 30
COMPILED_S = 600.0  # a version that has not run before compiles the solver first
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


RESTED = """
async ([slider, value]) => {
  const input = document.querySelector(`#slider-${slider}`);
  await new Promise((done) => setTimeout(done, 2000)); // the other page draws its views
  return new Promise((done) => {
    const start = performance.now();
    const verdict = document.querySelector("#verdict");
    let isProvisional = false;
    const observer = new MutationObserver(() => {
      isProvisional ||= verdict.textContent.includes("Values while a slider moves");
      if (document.body.dataset.phase !== "rest") return;
      observer.disconnect();
      const finish = () => done([performance.now() - start, isProvisional]);
      requestAnimationFrame(() => setTimeout(finish));
    });
    observer.observe(document.body, { attributes: true, attributeFilter: ["data-phase"] });
    observer.observe(verdict, { childList: true, subtree: true });
    input.value = value;
    input.dispatchEvent(new InputEvent("input", { bubbles: true }));
  });
}
"""
LOADED = """(name) => document.querySelector("h1").innerText !== name
  && document.body.dataset.phase === "rest"
"""


def beside(tree: str, moves: int = 11) -> None:
    """Move the campus in this version and in another, in turns."""
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)  # else every process compiles the solver
    found: dict[str, list[tuple[float, bool]]] = {"here": [], "there": []}
    with chromium() as browser, ExitStack() as stack:
        pages = {}
        for name, root in zip(found, (str(ROOT), tree), strict=True):
            address, _ = stack.enter_context(served(root))
            page = pages[name] = stack.enter_context(quiet_page(browser))
            page.set_default_timeout(1e3 * COMPILED_S)
            page.goto(address)
            page.wait_for_selector("body[data-phase=rest]")
            before = page.inner_text("h1")
            page.set_input_files("#folder", ROOT / "projects" / "campus")
            page.wait_for_function(LOADED, arg=before)
        for move in range(1 + moves):
            # Each is the first in every other turn.
            for name in list(pages)[:: 1 if move % 2 else -1]:
                slider, (first, step) = list(STEPS.items())[move % 2]
                value = round(first + step * (move + 1), 2)
                found[name].append(pages[name].evaluate(RESTED, [slider, value]))
    medians = []
    for name, taken in found.items():
        medians.append(statistics.median(time_ms for time_ms, _ in taken[1:]))
        provisional = sum(is_provisional for _, is_provisional in taken[1:])
        figure(f"30 arrays, from a move to the answer at rest, {name}, median", medians[-1], "ms")
        figure(f"moves of {moves} whose provisional answer was drawn, {name}", provisional)
    figure("30 arrays, from a move to the answer at rest, ratio", medians[0] / medians[1])


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--beside", metavar="TREE")
    if other := parser.parse_known_args()[0].beside:
        beside(other)
    else:
        in_the_browser()
