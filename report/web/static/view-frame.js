// What all views share: ask, draw, and say what went wrong.

import { html, note, replace } from "./make.js";

/**
 * Return a view: `update(scene)` asks with what is chosen and draws the answer, `moving()` marks it as out of date.
 * `load()` promises its `build(element, data, { again, announce })`, which may return what stops it; `fetch(request)`
 * promises the answer. `again(changes)` asks with other values of the view's own.
 */
export function createView(element, load, fetch, announce) {
  let end = null; // of what plays in the drawing
  let shown = ""; // the request that is drawn
  let [own, last] = [{}, {}];
  let isMoving = false; // whether a slider moves, so that what is drawn is out of date
  const stop = () => end?.();

  async function update(next) {
    if (next.array !== last.array || next.motion !== last.motion) own = {};
    last = next;
    isMoving = false;
    const request = { ...next, ...own };
    const key = JSON.stringify(request);
    if (key === shown) {
      element.classList.remove("is-stale");
      return;
    }
    shown = "";
    stop();
    element.ariaBusy = "true"; // a drawing that is saved waits for it
    if (element.querySelector("svg")) element.classList.add("is-stale");
    else replace(element, note("Calculating …"));
    try {
      const [{ build }, data] = await Promise.all([load(), fetch(request)]);
      if (data === null) return;
      stop();
      end = build(element, data, { again, announce });
      shown = key;
    } catch (error) {
      replace(element, html("p", { role: "alert" }, error.message));
    }
    element.classList.toggle("is-stale", isMoving);
    element.ariaBusy = null;
  }

  function again(changes) {
    own = { ...own, ...changes };
    update(last);
  }

  return {
    update,
    stop,
    moving() {
      isMoving = true;
      stop();
      element.classList.add("is-stale");
    },
  };
}
