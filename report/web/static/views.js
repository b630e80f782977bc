// The drawings behind the tabs: each is a module that is loaded when its tab is first opened.

import { replace, html } from "./make.js";

const part = (id) => document.getElementById(id);

// What each drawing needs chosen, beside the values.
const NEEDS = { slide: ["array", "motion"], contour: ["array"], paths: ["array"], histories: ["array", "motion"] };
const STALE = "Drawn for the values before the slider moved.";

/** Return the tabs' drawings: `open(id)`, `update(scene)` at rest, `moving()` while a slider moves. */
export function createViews(api) {
  const mounted = new Map();
  let current = "plan";
  let scene = null; // null while a slider moves

  async function draw() {
    const id = current;
    if (!(id in NEEDS) || !scene) return;
    const needed = () => Object.fromEntries([...NEEDS[id], "values"].map((key) => [key, scene[key]]));
    const element = part(id).querySelector(".view");
    element.classList.remove("is-stale");
    if (mounted.has(id)) {
      mounted.get(id).update(needed());
      return;
    }
    try {
      const { mount } = await import(`./${id}.js`);
      if (scene && !mounted.has(id)) mounted.set(id, mount(element, api, needed()));
    } catch (error) {
      replace(element, html("p", {}, `This drawing could not be loaded. Reload the page. (${error.message})`));
    }
  }

  return {
    open(id) {
      mounted.get(current)?.hide();
      current = id;
      part("chosen").hidden = !(id in NEEDS);
      for (const key of ["array", "motion"]) part(key).parentElement.hidden = !NEEDS[id]?.includes(key);
      draw();
    },
    update(next) {
      scene = next;
      part("stale-note").textContent = "";
      draw();
    },
    moving() {
      scene = null;
      part("stale-note").textContent = STALE;
      mounted.get(current)?.moving();
    },
  };
}
