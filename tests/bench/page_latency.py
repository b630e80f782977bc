"""How long the page takes to follow a slider, in the browser: from the event to the drawn answer.

PYTHONPATH=tests .venv/bin/python tests/bench/page_latency.py [MOVES]

One axis is the answer while a slider moves; two axes is the full model, from when the slider is let
go, once the answer in one axis is drawn. Each move is to another value, half a second after the
answer before. Prints the median, the 95th percentile and the largest of the moves [ms], of each
slider and of all.
"""

import sys

import numpy as np

from browsing import chromium, opened, quiet_page, served

MEASURED = """
async ([slider, values, isLetGo]) => {
  const input = document.querySelector(`#slider-${slider}`);
  const table = document.querySelector("#arrays");
  const drawn = (phase, event) => new Promise((done) => {
    const observer = new MutationObserver(() => {
      if (document.body.dataset.phase !== phase) return;
      observer.disconnect();
      requestAnimationFrame(() => done(performance.now() - start));
    });
    observer.observe(table, { childList: true });
    const start = performance.now();
    input.dispatchEvent(event);
  });
  const times = [];
  for (const value of values) {
    await new Promise((done) => setTimeout(done, 500));
    input.value = value;
    const moving = await drawn("moving", new InputEvent("input", { bubbles: true }));
    const letGo = () => drawn("rest", new PointerEvent("pointerup", { bubbles: true }));
    times.push(isLetGo ? await letGo() : moving);
  }
  return times;
}
"""


def main(moves: int) -> None:
    """Measure moves of four sliders of the example, by their own steps."""
    steps = {"friction": (0.69, 0.01), "slope": (0.1, 0.1), "intensity": (0.7, 0.02)}
    steps["clearance"] = (-8.0, 1.0)
    with chromium() as browser, served() as (address, _), quiet_page(browser) as page:
        opened(page, address)
        for name, is_let_go in (("one axis", False), ("two axes", True)):
            every: list[float] = []
            for slider, (first, step) in steps.items():
                values = [round(first + step * move, 2) for move in range(1 + moves)]
                times = page.evaluate(MEASURED, [slider, values, is_let_go])[1:]
                page.wait_for_selector("body[data-phase=rest]")
                every += times
                _tell(f"{name}, {slider}", times)
            _tell(f"{name}, all", every)


def _tell(what: str, times: list[float]) -> None:
    half, most = np.percentile(times, [50, 95])
    print(
        f"{what}: {len(times)} moves, median {half:.0f} ms, 95th percentile {most:.0f} ms,"
        f" largest {max(times):.0f} ms"
    )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 30)
