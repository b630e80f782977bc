// The tabs by the pattern of the ARIA guide, and the drawings behind them: each is a module that is loaded when
// its tab is first opened.

import { onChange } from "./session.js";
import { createView } from "./view-frame.js";

const part = (id) => document.getElementById(id);

// What each drawing needs chosen beside the values.
const NEEDS = { slide: ["array", "motion"], contour: ["array"] };
const STALE = "Drawn for the previous slider values.";

/** Have a list of tabs choose the `tab` of a session: arrow keys, Home and End too, and the panel follows. */
export function mountTabs(list, session) {
  const tabs = [...list.children];
  list.addEventListener("click", ({ target }) => target.role === "tab" && session.set({ tab: target.getAttribute("aria-controls") }));
  list.addEventListener("keydown", (event) => {
    const shown = tabs.filter((tab) => !tab.hidden);
    const next = shown[destination(event.key, shown.indexOf(document.activeElement), shown.length)];
    if (!next) return;
    event.preventDefault();
    next.focus();
    next.click();
  });
  session.draws(onChange(["tab"], ({ tab = "plan" }) => {
    for (const one of tabs) {
      const isShown = one.getAttribute("aria-controls") === tab;
      one.ariaSelected = String(isShown);
      one.tabIndex = isShown ? 0 : -1;
      part(one.getAttribute("aria-controls")).hidden = !isShown;
    }
  }));
}

/** Return the index that a key goes to from another, around the ends; -1 if it is no such key. */
export function destination(key, from, count) {
  const to = { ArrowRight: (from + 1) % count, ArrowLeft: (from + count - 1) % count, Home: 0, End: count - 1 };
  return to[key] ?? -1;
}

/** Draw what is behind the tab of a session at rest, and mark it as out of date while its values change. */
export function mountViews(session, api) {
  const views = Object.fromEntries(
    Object.keys(NEEDS).map((id) => [id, createView(part(id).querySelector(".view"), () => loaded(id), (request) => api.computed(id, request), api.announce)]),
  );
  session.draws(onChange(["tab", "phase", "values", "array", "motion"], (state) => {
    const { tab, phase } = state;
    const needs = NEEDS[tab] ?? [];
    part("chosen").hidden = needs.length === 0;
    for (const key of ["array", "motion"]) part(key).parentElement.hidden = !needs.includes(key);
    part("stale-note").textContent = phase === "rest" ? "" : STALE;
    for (const [id, view] of Object.entries(views)) if (id !== tab) view.stop();
    if (phase === "rest") views[tab]?.update(Object.fromEntries([...needs, "values"].map((key) => [key, state[key]])));
    else views[tab]?.moving();
  }));
}

function loaded(id) {
  return import(`./${id}.js`).catch(({ message }) => {
    throw new Error(`This drawing could not be loaded. Reload the page. (${message})`);
  });
}
