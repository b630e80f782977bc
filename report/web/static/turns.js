// Where the verdict would change, for each slider by itself: the remedies that a slider can enter. Asked
// one verdict at a time, and only while the page rests.

import { acts } from "./changes.js";

const REST_MS = 1000;
const EASES = { friction: 1, clearance: 1 }; // with more of it there is less NG; of the others, with less

/**
 * Return how to `start` a search at values and to `stop` it. `ask` promises the verdict at values, and
 * `show` gets a slider's id, `{value, verdict, before}`: the first value tried with another verdict,
 * and the one before it, null where there is none as far as the slider goes; and the values searched at.
 */
export function createTurns(ask, show) {
  let turn = 0;
  const stop = () => {
    turn += 1;
  };

  async function search(sliders, values, isNg) {
    stop();
    const mine = turn;
    const isWanted = () => mine === turn;
    await new Promise((done) => {
      setTimeout(done, REST_MS);
    });
    for (const slider of sliders.filter((one) => acts(one, values))) {
      if (!isWanted()) return;
      const turned = await turnOf(slider, values, isNg, ask, isWanted);
      if (isWanted()) show(slider.id, turned, values);
    }
  }

  // Without an answer there are no marks: what the user asks next tells why.
  return { stop, start: (sliders, values, isNg) => search(sliders, values, isNg).catch(stop) };
}

/** Return where a verdict changes between a value of a slider and its end; both sides are asked. */
export async function turnOf({ id, least, greatest, step }, values, isNg, ask, isWanted) {
  const way = (EASES[id] ?? -1) * (isNg ? 1 : -1);
  const at = (steps) => Number((values[id] + way * steps * step).toFixed(6));
  let [before, after] = [0, Math.floor(((way > 0 ? greatest : least) - values[id]) / (way * step) + 1e-6)];
  const verdictAt = (steps) => ask({ ...values, [id]: at(steps) });
  let verdict = after > 0 && (await verdictAt(after));
  if (!verdict || isOf(verdict, isNg)) return null;
  while (after - before > 1 && isWanted()) {
    const middle = Math.floor((before + after) / 2);
    const found = await verdictAt(middle);
    if (isOf(found, isNg)) before = middle;
    else [after, verdict] = [middle, found];
  }
  return { value: at(after), verdict: verdict.text, before: at(before) };
}

function isOf({ look }, isNg) {
  return (look === "ng") === isNg;
}
