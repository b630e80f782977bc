// The roof plan, as the server places it on a sheet that fits; a gap that is NG says so.

import { svg, update } from "./make.js";

/**
 * Draw plans into an element; returns `show(plan)` and `room()`, the width that there is for one.
 * `ask` is called where it has changed so much that the server would place another sheet.
 */
export function mountPlan(element, ask) {
  let latest = null;
  let room = 0;
  const look = () => latest && room && !isFor(latest, room) && ask();
  // Read where the browser has laid out the page: asked for beside a change, it would do so once more.
  new ResizeObserver(() => {
    room = element.clientWidth || room; // none while another tab is open
    look();
  }).observe(element);
  return {
    room: () => room,
    show(plan) {
      latest = plan;
      update(element, drawing(plan));
      look();
    },
    /** Take the verdicts out of the description, of values that stay while others are computed. */
    dropVerdicts() {
      const described = element.querySelector("desc");
      if (described) described.textContent = latest.described.map(({ text }) => `${text}.`).join(" ");
    },
  };
}

function isFor({ rooms_px: [least, most] }, room) {
  return room >= least && room < most;
}

function drawing({ title, described, size_px: [wide, tall], items }) {
  return svg(
    "svg",
    { viewBox: `0 0 ${wide} ${tall}`, role: "img", "aria-labelledby": "plan-title plan-description" },
    svg("title", { id: "plan-title" }, title),
    svg("desc", { id: "plan-description" }, described.map(sentence).join(" ")),
    svg("defs", {}, hatch("hatch", "M0 0V6"), hatch("cross", "M0 0V6M0 0H6"), tip()),
    items.map(painted),
  );
}

function sentence({ text, verdict }) {
  return `${text}${verdict ? `, ${verdict.text}` : ""}.`;
}

function hatch(id, d) {
  const look = { id, width: 6, height: 6, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" };
  return svg("pattern", look, svg("path", { d, class: "hatch-line" }));
}

function tip() {
  const place = { id: "tip", orient: "auto", refX: 8, refY: 3.5, markerWidth: 8, markerHeight: 7, viewBox: "0 0 8 7", markerUnits: "userSpaceOnUse" };
  return svg("marker", place, svg("path", { d: "M0 0L8 3.5L0 7Z", class: "dark" }));
}

function painted({ kind, text, name, ...attributes }) {
  return svg(kind, attributes, text, name ? svg("title", {}, name) : null);
}
