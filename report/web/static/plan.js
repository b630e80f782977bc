// The roof plan, as the server places it on a sheet that fits, shaded by D/C; a gap that is NG says so. What
// the pointer or a key is on is told in one line; Ctrl with the wheel, keys and buttons zoom.

import { within } from "./view-parts.js";
import { onChange, WHOLE } from "./session.js";
import { parsed, update } from "./make.js";

const MOST = 8;
const STEP = 1.5;

/**
 * Draw the plan of a session into an element; returns `room()`, the width that there is for one, and
 * `pick(key)`. `said` shows the tip of what is picked or under the pointer, `zooms` are three buttons.
 */
export function mountPlan(element, session, { said, zooms }) {
  const { state } = session;
  let room = 0;
  // Where the room has changed so much that the server would place another sheet it is asked, once.
  let asked = 0;
  const look = () => {
    if (!state.answer || !room || isFor(state.answer.plan, room) || asked === room) return;
    asked = room;
    session.again();
  };
  // Read where the browser has laid out the page: asked for beside a change, it would do so once more.
  new ResizeObserver(() => {
    room = element.clientWidth || room; // none while another tab is open
    look();
  }).observe(element);

  const tips = () => state.answer?.tips ?? {};
  const tell = (key) => {
    said.textContent = tips()[key] ?? "";
    said.title = said.textContent;
  };
  const pick = (key) => session.set({ picked: key, ...(state.project.views.arrays.includes(key) ? { array: key } : {}) });
  const zoom = (factor, about) => session.set({ view: zoomed(state.view, factor, about) });
  const isMoved = zoomByPointer(element, session, zoom);
  const [closer, further, whole] = zooms;
  closer.addEventListener("click", () => zoom(STEP));
  further.addEventListener("click", () => zoom(1 / STEP));
  whole.addEventListener("click", () => session.set({ view: WHOLE }));

  element.addEventListener("pointerover", (event) => tell(keyOf(event) ?? state.picked));
  element.addEventListener("pointerleave", () => tell(state.picked));
  element.addEventListener("click", (event) => isMoved() || pick(keyOf(event) ?? null));
  const step = (way) => {
    const all = Object.keys(tips());
    pick(all[(all.indexOf(state.picked) + way + all.length) % all.length]);
  };
  const KEYS = { "+": () => zoom(STEP), "-": () => zoom(1 / STEP), 0: () => session.set({ view: WHOLE }), ArrowRight: () => step(1), ArrowLeft: () => step(state.picked ? -1 : 0), Escape: () => pick(null) };
  element.parentElement.addEventListener("keydown", (event) => {
    if (!KEYS[event.key] || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    KEYS[event.key]();
  });

  let [drawn, described] = ["", ""];
  session.draws(onChange(["answer", "view", "picked"], ({ answer, shows, view, picked }) => {
    if (!answer) return;
    if (answer.html.plan !== drawn) {
      const next = parsed("div", answer.html.plan);
      described = next.querySelector("desc").textContent;
      update(element, next);
    }
    drawn = answer.html.plan;
    element.querySelector("svg").setAttribute("viewBox", boxOf(answer.plan, view));
    // Values that stay while others are computed have no verdict any more.
    element.querySelector("desc").textContent = shows === "former" ? "" : described;
    element.classList.toggle("is-zoomed", view.scale > 1);
    element.style.setProperty("--zoom", view.scale);
    for (const one of element.querySelectorAll("[data-key]")) one.classList.toggle("is-picked", one.dataset.key === picked);
    tell(picked);
    look();
  }));
  return { room: () => room, pick };
}

// A view zoomed about a place, in parts of what is shown, and moved; the sheet stays in sight.
function zoomed({ scale, x, y }, factor, [fx, fy] = [0.5, 0.5]) {
  const next = within(scale * factor, 1, MOST);
  const size = 1 / scale - 1 / next;
  return moved({ scale: next, x, y }, fx * size, fy * size);
}

function moved({ scale, x, y }, dx, dy) {
  const held = (value) => within(value, 0, 1 - 1 / scale);
  return { scale, x: held(x + dx), y: held(y + dy) };
}

function keyOf({ target }) {
  return target.closest("[data-key]")?.dataset.key;
}

// Have the wheel zoom with Ctrl, as a pinch on a touchpad does, and dragging move a drawing that is zoomed.
// Tells whether the pointer has moved it.
function zoomByPointer(element, { state, set }, zoom) {
  const place = ({ clientX, clientY }) => {
    const at = element.getBoundingClientRect();
    return [(clientX - at.x) / at.width, (clientY - at.y) / at.height];
  };
  element.addEventListener("wheel", (event) => {
    if (!event.ctrlKey && !event.metaKey) return; // the page scrolls
    event.preventDefault();
    zoom(event.deltaY < 0 ? STEP : 1 / STEP, place(event));
  }, { passive: false });
  let held = null; // where the pointer holds the sheet
  element.addEventListener("pointerdown", (event) => {
    held = { at: place(event), isMoved: false };
  });
  element.addEventListener("pointermove", (event) => {
    if (!held || event.buttons === 0 || state.view.scale === 1) return;
    const [x, y] = place(event);
    const [dx, dy] = [held.at[0] - x, held.at[1] - y];
    if (!held.isMoved && Math.hypot(dx, dy) < 0.01) return;
    set({ view: moved(state.view, dx / state.view.scale, dy / state.view.scale) });
    held = { at: [x, y], isMoved: true };
  });
  return () => held?.isMoved ?? false;
}

function isFor({ rooms_px: [least, most] }, room) {
  return room >= least && room < most;
}

function boxOf({ size_px: [wide, tall] }, { scale, x, y }) {
  return [x * wide, y * tall, wide / scale, tall / scale].join(" ");
}
