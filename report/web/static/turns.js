// Where the verdict would change, for each slider by itself: the remedies that a slider can enter. Asked
// one verdict at a time, and only while the page rests.

import { acts } from "./changes.js";

const REST_MS = 2000; // a search takes some seconds of a processor
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

/**
 * Return where a verdict changes between a value of a slider and its end; both sides are asked in full, and
 * what lies between is found by provisional verdicts, or in full where these lead elsewhere.
 */
export async function turnOf({ id, least, greatest, step }, values, isNg, ask, isWanted) {
  const way = (EASES[id] ?? -1) * (isNg ? 1 : -1);
  const at = (steps) => Number((values[id] + way * steps * step).toFixed(6));
  const known = new Map(); // in full, by steps
  const verdictAt = async (steps, isQuick) => {
    if (!known.has(steps) && isQuick) return ask({ ...values, [id]: at(steps) }, true);
    if (!known.has(steps)) known.set(steps, await ask({ ...values, [id]: at(steps) }, false));
    return known.get(steps);
  };
  const isTurned = async (steps, isQuick) => !isOf(await verdictAt(steps, isQuick), isNg);
  const end = Math.floor(((way > 0 ? greatest : least) - values[id]) / (way * step) + 1e-6);
  // A provisional NG is one in full, too; any other verdict may become one.
  if (end < 1 || (!(await isTurned(end, true)) && (isNg || !(await isTurned(end))))) return null;
  let [before, after] = await between([0, end], (steps) => isTurned(steps, true), isWanted);
  if (before > 0 && (await isTurned(before))) [before, after] = await between([0, before], isTurned, isWanted);
  else if (!(await isTurned(after))) [before, after] = await between([after, end], isTurned, isWanted);
  const turned = await verdictAt(after);
  return isOf(turned, isNg) ? null : { value: at(after), verdict: turned.text, before: at(before) };
}

// The steps beside each other between which the verdict turns.
async function between([from, to], isTurned, isWanted) {
  let [before, after] = [from, to];
  while (after - before > 1 && isWanted()) {
    const middle = Math.floor((before + after) / 2);
    if (await isTurned(middle)) after = middle;
    else before = middle;
  }
  return [before, after];
}

function isOf({ look }, isNg) {
  return (look === "ng") === isNg;
}
