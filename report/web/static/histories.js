// Histories of one run: roof acceleration and velocity, relative displacement, normal force.

import { button, html, note, replace } from "./make.js";
import { number } from "./reading.js";
import { onKeys, runSelect } from "./view-frame.js";
import { createPanels, panelOf } from "./view-panels.js";
import { pointerIn, within } from "./view-parts.js";

const PANELS = ["acceleration", "velocity", "relative", "normal"];
const HEIGHT = 430;
const NARROW = 570; // below it the headings have two lines
const LEAST_SAMPLES = 20; // in the shortest span that is shown
const STEPS = 400; // of the reading by arrow keys, across the span
const ZOOM = 0.6;
const PAN = 0.25;
const DRAG = 4; // pixels that make a drag of a click
const KEYS = "Drag over a span to enlarge it. Click, then wheel or + and − zoom, arrows move the reading, Shift + arrows the span, 0 shows all. Shaded: slips.";

/** Draw the histories in an element. */
export function build(element, data, { again, announce }) {
  const panels = createPanels(PANELS.map((kind) => panelOf(data, kind, "title_with_unit")), data);
  const where = html("span", { class: "numbers when" });
  const brush = html("div", { class: "brush", hidden: true });
  const stage = html("div", { class: "stage", tabindex: 0, role: "application", "aria-label": "Histories", "aria-describedby": "histories-keys" }, panels.element, brush);
  const { seconds, texts } = data;
  const lens = createLens(data, follow);
  const buttons = zoomButtons(lens);
  let drawn = null;
  let now = 0;

  function follow(span, time) {
    if (span !== drawn) panels.show(span);
    [drawn, now] = [span, time];
    panels.at(time);
    where.textContent = `t = ${number(time, 3)} s`;
    buttons.follow(span, seconds);
  }

  zoomByKeys(stage, lens, () => announce(`${where.textContent}. ${panels.words(now)}.`));
  zoomByPointer(stage, brush, panels, lens);

  replace(
    element,
    html("p", { class: "print-only" }, `${texts.title}: ${texts.prd}`),
    html("div", { class: "toolbar" }, runSelect(data, (run) => again({ run })), buttons.element, where),
    stage,
    html("p", { class: "note", id: "histories-keys" }, KEYS),
    note(texts.notes.join(" ")),
  );
  lens.reset();
  return { resize: (wide) => panels.resize(wide, HEIGHT, { isNarrow: wide < NARROW }) };
}

// The span of time that is shown, and the sample that is read, within it; `changed` gets both.
function createLens({ seconds, dt_s: dt, t_prd_s: peak }, changed) {
  let span = [0, seconds];
  let time = peak ?? 0;

  // A reading stops at samples.
  function read(next) {
    const [first, last] = [Math.ceil(span[0] / dt - 1e-6), Math.floor(span[1] / dt + 1e-6)];
    time = within(Math.round(next / dt), first, last) * dt;
    changed(span, time);
  }

  function show(from, to) {
    const length = within(to - from, Math.min(LEAST_SAMPLES * dt, seconds), seconds);
    const start = within(from, 0, seconds - length);
    span = [start, start + length];
    read(time);
  }

  return {
    read,
    show,
    reset: () => show(0, seconds),
    step: (way) => read(time + way * Math.max(dt, (span[1] - span[0]) / STEPS)),
    ends: (k) => read(span[k]),
    zoom(factor, about = time) {
      show(about - (about - span[0]) * factor, about + (span[1] - about) * factor);
    },
    pan(share) {
      const shift = share * (span[1] - span[0]);
      time += shift;
      show(span[0] + shift, span[1] + shift);
    },
  };
}

function named(label, name, key, click) {
  return button(label, click, { "aria-label": name, title: `${name} (${key})` });
}

function zoomButtons(lens) {
  const closer = named("+", "Zoom in", "+", () => lens.zoom(ZOOM));
  const out = named("−", "Zoom out", "−", () => lens.zoom(1 / ZOOM));
  const earlier = named("‹", "Earlier", "Shift + Left", () => lens.pan(-PAN));
  const later = named("›", "Later", "Shift + Right", () => lens.pan(PAN));
  const all = named("All", "Whole record", "0", lens.reset);
  return {
    element: html("div", { class: "keys" }, closer, out, earlier, later, all),
    follow([from, to], seconds) {
      for (const one of [out, all]) one.disabled = to - from >= seconds;
      earlier.disabled = from <= 0;
      later.disabled = to >= seconds;
    },
  };
}

function zoomByKeys(stage, lens, tell) {
  const read = (move) => {
    move();
    tell();
  };
  const closer = () => lens.zoom(ZOOM);
  onKeys(stage, {
    "+": closer,
    "=": closer,
    "-": () => lens.zoom(1 / ZOOM),
    0: lens.reset,
    Escape: lens.reset,
    ArrowLeft: ({ shiftKey }) => (shiftKey ? lens.pan(-PAN) : read(() => lens.step(-1))),
    ArrowRight: ({ shiftKey }) => (shiftKey ? lens.pan(PAN) : read(() => lens.step(1))),
    PageUp: () => lens.pan(-1),
    PageDown: () => lens.pan(1),
    Home: () => read(() => lens.ends(0)),
    End: () => read(() => lens.ends(1)),
  });
}

// A pointer reads where it is; pressed and moved along, it marks a span, which is shown on release.
function zoomByPointer(stage, brush, panels, lens) {
  let from = null;
  const place = (event) => ({ pixel: pointerIn(stage, event)[0], time: panels.timeAt(event) });
  const drop = () => {
    from = null;
    brush.hidden = true;
  };
  stage.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    stage.setPointerCapture(event.pointerId);
    from = place(event);
    lens.read(from.time);
  });
  stage.addEventListener("pointermove", (event) => {
    const to = place(event);
    lens.read(to.time);
    if (!from) return;
    brush.hidden = Math.abs(to.pixel - from.pixel) < DRAG;
    brush.style.setProperty("left", `${Math.min(to.pixel, from.pixel)}px`);
    brush.style.setProperty("width", `${Math.abs(to.pixel - from.pixel)}px`);
  });
  stage.addEventListener("pointerup", (event) => {
    const { time } = place(event);
    if (from && !brush.hidden) lens.show(Math.min(from.time, time), Math.max(from.time, time));
    drop();
  });
  stage.addEventListener("pointercancel", drop);
  stage.addEventListener("dblclick", lens.reset);
  // The wheel scrolls the page until the histories are chosen: by a click, by Tab, or with Ctrl.
  stage.addEventListener("wheel", (event) => {
    if (document.activeElement !== stage && !event.ctrlKey) return;
    event.preventDefault();
    const notches = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? event.deltaY / 100 : event.deltaY / 3;
    lens.zoom(ZOOM ** within(-notches, -2, 2), panels.timeAt(event));
  });
}
