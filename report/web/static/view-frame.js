// What all views share: ask, draw, draw again in another size, and say what went wrong.

import { html, note, replace } from "./make.js";

/**
 * Return a view of a scene, which is what it asks with: `fetch(request)` returns the answer, and
 * `build(element, data, { again, announce, kept })` makes its drawing and returns
 * `{ resize(width), stop() }`, where `stop` may lack. `again(changes)` asks with other values of the
 * view's own; `kept` is the same object for every drawing of the view.
 */
export function createView(element, scene, fetch, build, announce) {
  const kept = {};
  let drawing = null;
  let shown = ""; // the request that is drawn
  let own = {};
  let last = scene;
  let width = 0; // that it is drawn in; none while its tab is closed
  let isMoving = false; // whether a slider moves, so that what is drawn is out of date

  function draw() {
    width = element.clientWidth;
    if (width > 0) drawing?.resize(width);
  }

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
    drawing?.stop?.();
    element.setAttribute("aria-busy", "true");
    if (drawing) element.classList.add("is-stale");
    else replace(element, note("Calculating …"));
    try {
      const data = await fetch(request);
      if (data === null) return;
      drawing?.stop?.();
      element.replaceChildren();
      drawing = build(element, data, { again, announce, kept });
      draw();
      shown = key;
    } catch (error) {
      drawing = null;
      replace(element, html("p", { role: "alert" }, error.message));
    }
    element.classList.toggle("is-stale", isMoving);
    element.removeAttribute("aria-busy");
  }

  function again(changes) {
    own = { ...own, ...changes };
    update(last);
  }

  new ResizeObserver(() => element.clientWidth !== width && draw()).observe(element);
  update(scene);
  return {
    update,
    moving() {
      isMoving = true;
      drawing?.stop?.();
      element.classList.add("is-stale");
    },
    hide: () => drawing?.stop?.(),
  };
}

/** Return a select of the runs of a motion; `chosen` gets the name of one. */
export function runSelect(data, chosen) {
  const options = data.runs.map(({ name, label }) => html("option", { value: name, selected: name === data.run }, label));
  return html("label", { class: "field" }, "Run ", html("select", { on: { change: ({ target }) => chosen(target.value) } }, options));
}

/** Have an element, not what is in it, answer keys: `keys` are functions of the event by key. */
export function onKeys(element, keys) {
  element.addEventListener("keydown", (event) => {
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (event.target !== element || !(key in keys) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    keys[key](event);
  });
}
