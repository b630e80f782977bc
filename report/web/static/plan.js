// The roof plan, as the server places it on a sheet that fits; a gap that is NG says so. What the
// pointer or a key is on is told in one line; the wheel, keys and buttons zoom.

import { within } from "./view-parts.js";
import { svg, update } from "./make.js";

const MOST = 8;
const STEP = 1.5;

/**
 * Draw plans into an element; returns `show(plan, tips)`, `pick(key)`, and `room()`, the width that
 * there is for one. `ask` is called where it has changed so much that the server would place another
 * sheet, `picked` gets the key of what was picked, and `said` shows its tip.
 */
export function mountPlan(element, { ask, picked, said, zooms }) {
  let latest = null;
  let tips = {};
  let room = 0;
  let key = null; // of what is picked
  const look = () => latest && room && !isFor(latest, room) && ask();
  // Read where the browser has laid out the page: asked for beside a change, it would do so once more.
  new ResizeObserver(() => {
    room = element.clientWidth || room; // none while another tab is open
    look();
  }).observe(element);

  const tell = (of) => {
    said.textContent = tips[of] ?? "";
    said.title = said.textContent;
  };

  const { view, zoom, isMoved } = mountZoom(element, zooms, (shown) => boxOf(latest, shown));

  function pick(next) {
    key = next in tips ? next : null;
    for (const one of element.querySelectorAll("[data-key]")) one.classList.toggle("is-picked", one.dataset.key === key);
    tell(key);
  }

  element.addEventListener("pointerover", (event) => tell(keyOf(event) ?? key));
  element.addEventListener("pointerleave", () => tell(key));
  element.addEventListener("click", (event) => isMoved() || picked(keyOf(event) ?? null));
  const step = (way) => {
    const all = Object.keys(tips);
    picked(all[(all.indexOf(key) + way + all.length) % all.length]);
  };
  const KEYS = { "+": () => zoom(STEP), "-": () => zoom(1 / STEP), 0: () => zoom(1 / MOST), ArrowRight: () => step(1), ArrowLeft: () => step(key ? -1 : 0), Escape: () => picked(null) };
  element.parentElement.addEventListener("keydown", (event) => {
    if (!KEYS[event.key] || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    KEYS[event.key]();
  });

  return {
    room: () => room,
    show(plan, nextTips) {
      [latest, tips] = [plan, nextTips];
      update(element, drawing(plan, view));
      pick(key);
      look();
    },
    pick,
    /** Take the verdicts out of the description, of values that stay while others are computed. */
    dropVerdicts() {
      const described = element.querySelector("desc");
      if (described) described.textContent = latest.described.map(({ text }) => `${text}.`).join(" ");
    },
  };
}

function keyOf({ target }) {
  return target.closest("[data-key]")?.dataset.key;
}

// Have the wheel, buttons and dragging zoom a drawing, whose box `box` gives of a view: its corner and
// 1 / its size, as parts of the sheet. Tells whether the pointer has moved the sheet.
function mountZoom(element, zooms, box) {
  const view = { scale: 1, x: 0, y: 0 };
  // Zoom about a place, in parts of what is shown, and keep the sheet in sight.
  function zoom(factor, [fx, fy] = [0.5, 0.5]) {
    const scale = within(view.scale * factor, 1, MOST);
    const size = 1 / view.scale - 1 / scale;
    Object.assign(view, { scale });
    move(fx * size, fy * size);
  }

  function move(dx, dy) {
    for (const [axis, by] of [["x", dx], ["y", dy]]) view[axis] = within(view[axis] + by, 0, 1 - 1 / view.scale);
    const drawn = element.querySelector("svg");
    if (!drawn) return;
    drawn.setAttribute("viewBox", box(view));
    element.classList.toggle("is-zoomed", view.scale > 1);
    element.style.setProperty("--zoom", view.scale);
  }

  const place = ({ clientX, clientY }) => {
    const at = element.getBoundingClientRect();
    return [(clientX - at.x) / at.width, (clientY - at.y) / at.height];
  };
  element.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoom(event.deltaY < 0 ? STEP : 1 / STEP, place(event));
  }, { passive: false });
  let held = null; // where the pointer holds the sheet
  element.addEventListener("pointerdown", (event) => {
    held = { at: place(event), isMoved: false };
  });
  element.addEventListener("pointermove", (event) => {
    if (!held || event.buttons === 0 || view.scale === 1) return;
    const [x, y] = place(event);
    const [dx, dy] = [held.at[0] - x, held.at[1] - y];
    if (!held.isMoved && Math.hypot(dx, dy) < 0.01) return;
    move(dx / view.scale, dy / view.scale);
    held = { at: [x, y], isMoved: true };
  });
  const [more, less, whole] = zooms;
  more.addEventListener("click", () => zoom(STEP));
  less.addEventListener("click", () => zoom(1 / STEP));
  whole.addEventListener("click", () => zoom(1 / MOST));
  return { view, zoom, isMoved: () => held?.isMoved ?? false };
}

function isFor({ rooms_px: [least, most] }, room) {
  return room >= least && room < most;
}

function boxOf({ size_px: [wide, tall] }, { scale, x, y }) {
  return [x * wide, y * tall, wide / scale, tall / scale].join(" ");
}

function drawing(plan, view) {
  const { title, described, items } = plan;
  const written = new Set(items.map(({ text }) => text));
  const unnamed = items.filter((item) => item["data-key"] && item.d && !written.has(item["data-key"]));
  return svg(
    "svg",
    { viewBox: boxOf(plan, view), role: "img", "aria-labelledby": "plan-title plan-description" },
    svg("title", { id: "plan-title" }, title),
    svg("desc", { id: "plan-description" }, described.map(sentence).join(" ")),
    svg("defs", {}, hatch("hatch", "M0 0V6"), hatch("cross", "M0 0V6M0 0H6"), tip()),
    items.map(({ kind, text, ...attributes }) => svg(kind, attributes, text)),
    unnamed.map((item) => svg("text", { class: "small-name", ...middle(item.d) }, item["data-key"])),
  );
}

// Where the name of a shape goes that has no room for it until the plan is zoomed.
function middle(d) {
  const all = d.match(/[\d.]+/g).map(Number);
  const mean = (axis) => {
    const values = all.filter((_, k) => k % 2 === axis);
    return (Math.min(...values) + Math.max(...values)) / 2;
  };
  return { x: mean(0), y: mean(1) };
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
