// The drawings behind the tabs: each is a module that is loaded when its tab is first opened.

import { replace, html } from "./make.js";
import { createView } from "./view-frame.js";

const part = (id) => document.getElementById(id);

// What each drawing asks for, and what it needs chosen beside the values.
const DRAWINGS = {
  slide: { asks: "slide", needs: ["array", "motion"] },
  contour: { asks: "contour", needs: ["array"] },
};
const STALE = "Drawn for the previous slider values.";

/** Return the tabs' drawings: `open(id)`, `update(scene)` at rest, `moving()` while a slider moves. */
export function createViews(api) {
  const mounted = new Map();
  let current = "plan";
  let scene = null; // null while a slider moves

  async function draw() {
    const id = current;
    if (!(id in DRAWINGS) || !scene) return;
    const { asks, needs } = DRAWINGS[id];
    const needed = () => Object.fromEntries([...needs, "values"].map((key) => [key, scene[key]]));
    const element = part(id).querySelector(".view");
    element.classList.remove("is-stale");
    if (mounted.has(id)) {
      mounted.get(id).update(needed());
      return;
    }
    element.setAttribute("aria-busy", "true"); // a drawing that is saved waits for the script too
    try {
      const { build } = await import(`./${id}.js`);
      if (scene && !mounted.has(id)) mounted.set(id, createView(element, needed(), (request) => api.computed(asks, request), build, api.announce));
    } catch (error) {
      element.removeAttribute("aria-busy");
      replace(element, html("p", {}, `This drawing could not be loaded. Reload the page. (${error.message})`));
    }
  }

  return {
    open(id) {
      mounted.get(current)?.hide();
      current = id;
      part("chosen").hidden = !(id in DRAWINGS);
      for (const key of ["array", "motion"]) part(key).parentElement.hidden = !DRAWINGS[id]?.needs.includes(key);
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
