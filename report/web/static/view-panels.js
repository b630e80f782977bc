// Histories one above the other over one axis of time, with the value at a time in their headings. The server
// sends values at the samples, or at the numbers of samples beside them, null where there is none.

import { html, replace, set, svg } from "./make.js";
import { measured } from "./reading.js";
import { frame, linesAcross, linesUp, pointerIn, scale, setSize, textsAcross, textsUp, ticks, within } from "./view-parts.js";

const LEFT = 46;
const RIGHT = 8;
const HEAD = 20; // height of a line of a heading, as in views.css
const NARROW = 320; // below it a heading has a line more, and so has the whole
const AXIS = 22;
const ROOM = 0.06; // of the range of the values, above and below
let made = 0;
const LOOKS = { cross: "is-across", vertical: "is-third", demand: "is-third" };

/**
 * Return panels of a run: `panels` are `{ title, units, series, least, most, over }`, where `series` have `name`,
 * `t`, `v` and `look`, `least` and `most` bound the axis, and `over` is the span of time whose values
 * set it, the one shown if not given. Values read in the first unit.
 */
export function createPanels(panels, { seconds, slips }) {
  const drawn = panels.map((panel) => createPanel(panel));
  const axis = svg("svg", { class: "panel-axis", "aria-hidden": true });
  const element = html("div", { class: "panels" }, drawn.map((panel) => panel.element), axis);
  let size = { width: 0, height: 0 };
  let span = [0, seconds];
  let x = scale(span, [LEFT, LEFT + 1]);
  let now = 0;
  let picked = null;

  function draw() {
    const { width, height } = size;
    if (width === 0) return;
    x = scale(span, [LEFT, width - RIGHT]);
    const tall = Math.floor((height - AXIS) / drawn.length) - HEAD;
    const times = ticks(...span, width / 90);
    for (const panel of drawn) panel.draw({ width, tall, span, x, times, slips });
    drawAxis(axis, width, x, times);
    mark();
  }

  function mark() {
    for (const panel of drawn) panel.mark(now, x, span, picked);
  }

  return {
    element,
    /** Fill a width and height. */
    resize(width, height) {
      size = { width, height };
      element.classList.toggle("is-narrow", width < NARROW);
      draw();
    },
    /** Show a span of time. */
    show(next) {
      span = next;
      draw();
    },
    /** Mark a time, and a slip if one is given, and write the values there. */
    at(time, slip = null) {
      now = time;
      picked = slip;
      mark();
    },
    /** Return the time under a pointer. */
    timeAt: (event) => within(x.inverse(pointerIn(element, event)[0]), ...span),
  };
}

function createPanel({ title, units, series, least, most, over }) {
  made += 1;
  const clip = `panel-${made}`;
  const values = series.map(() => html("span", { class: "value numbers" }));
  const looks = series.map(({ name, look }, k) => html("span", { class: "reading" }, sample(look), `${name} `, values[k]));
  const bands = svg("path", { class: "slip-bands" });
  const band = svg("rect", { class: "slip-picked", y: 0, width: 0 });
  const grid = svg("g", { class: "grid" });
  const labels = svg("g", { class: "panel-labels" });
  const lines = series.map(({ look }) => svg("path", { class: `curve ${look}` }));
  const cursor = svg("line", { class: "cursor", y1: 0 });
  const window = svg("rect", { x: LEFT, y: 0 });
  const plot = svg(
    "svg",
    { role: "img", "aria-label": `${title} in time` },
    svg("clipPath", { id: clip }, window),
    svg("g", { "clip-path": `url(#${clip})` }, bands, band, grid, lines.toReversed(), cursor),
    labels,
  );
  const head = html("div", { class: "panel-head" }, html("strong", {}, title), looks);

  return {
    element: html("div", { class: "panel" }, head, plot),
    draw({ width, tall, span, x, times, slips }) {
      setSize(plot, width, tall);
      set(window, { width: width - RIGHT - LEFT, height: tall });
      set(band, { height: tall });
      set(cursor, { y2: tall });
      const [low, high] = limits(series, over ?? span, least, most, units[0].si);
      const y = scale([low / units[0].si, high / units[0].si], [tall, 0]);
      const levels = ticks(low / units[0].si, high / units[0].si, tall / 20);
      replace(
        grid,
        linesAcross(times, x, y.ends),
        linesUp(levels, x.ends, y),
        frame(x, y),
      );
      const inside = levels.values.filter((value) => y(value) > 6 && y(value) < tall - 3);
      replace(labels, textsUp({ ...levels, values: inside }, LEFT - 6, y));
      set(bands, { d: slips.filter((slip) => slip.to_s > span[0] && slip.from_s < span[1]).map((slip) => `M${x(slip.from_s).toFixed(2)} 0H${x(slip.to_s).toFixed(2)}V${tall}H${x(slip.from_s).toFixed(2)}Z`).join("") });
      series.forEach((one, k) => set(lines[k], { d: curve(one, span, x, (value) => y(value / units[0].si)) }));
    },
    mark(time, x, span, picked) {
      const inside = time >= span[0] && time <= span[1];
      set(cursor, { x1: x(time), x2: x(time), visibility: inside ? "visible" : "hidden" });
      if (picked) set(band, { x: x(picked.from_s), width: Math.max(x(picked.to_s) - x(picked.from_s), 1) });
      set(band, { visibility: picked ? "visible" : "hidden" });
      series.forEach((one, k) => {
        values[k].textContent = measured(valueAt(one, time), units[0]);
      });
    },
  };
}

function drawAxis(axis, width, x, { values, step }) {
  setSize(axis, width, AXIS);
  const room = width - RIGHT - 68; // the title and half of a number
  const shown = { step, values: values.filter((time) => x(time) < room) };
  replace(axis, textsAcross(shown, x, 15), svg("text", { class: "tick end-at", x: width - RIGHT, y: 15 }, "Time [s]"));
}

// The range of what is drawn in a span of time, with some room.
function limits(series, span, least, most, unit) {
  const ranges = series.map((one) => rangeIn(one, span)).filter(Boolean);
  let low = least ?? Math.min(...ranges.map(([bottom]) => bottom), Infinity);
  let high = Math.min(most ?? Infinity, Math.max(...ranges.map(([, top]) => top), -Infinity));
  if (!(low < high)) {
    const middle = Number.isFinite(low) ? low : 0;
    [low, high] = [middle - unit, middle + unit];
  }
  const room = ROOM * (high - low);
  return [least ?? low - room, high + room];
}

function sample(look) {
  return svg("svg", { class: "sample", "aria-hidden": true, viewBox: "0 0 20 10" }, svg("path", { class: `curve ${look}`, d: "M0 5H20" }));
}

/** Return the panel of a kind, such as `velocity`: a title and units, and histories with times and look. */
export function panelOf(data, kind) {
  const series = data[kind].series.map(({ name, i, v }) => ({
    name,
    look: LOOKS[name] ?? "is-first",
    t: Float64Array.from(i ?? v.keys(), (k) => k * data.dt_s),
    v,
  }));
  return { title: data[kind].title, units: data[kind].units, series };
}

/** Return the number of the last of ascending values that is not above one; -1 if all are. */
export function lastUpTo(ascending, value) {
  let low = 0;
  let high = ascending.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (ascending[middle] <= value) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** Return the value at a time, linear between the samples drawn; null where there is none. */
export function valueAt({ t, v }, time) {
  const k = within(lastUpTo(t, time), 0, t.length - 1);
  if (k === t.length - 1 || time <= t[k]) return v[k];
  if (v[k] === null || v[k + 1] === null) return null;
  return v[k] + ((v[k + 1] - v[k]) * (time - t[k])) / (t[k + 1] - t[k]);
}

/** Return the smallest and largest value in a span of time, as `[low, high]`; null if there is none. */
export function rangeIn({ t, v }, [from, to]) {
  let low = Infinity;
  let high = -Infinity;
  const end = Math.min(lastUpTo(t, to) + 1, t.length - 1);
  for (let k = Math.max(lastUpTo(t, from), 0); k <= end; k += 1) {
    if (v[k] === null) continue;
    low = Math.min(low, v[k]);
    high = Math.max(high, v[k]);
  }
  return low <= high ? [low, high] : null;
}

/** Return the path of a history in a span of time: at most four points in each column of pixels. */
export function curve({ t, v }, span, x, y) {
  let drawn = "";
  let pen = "M";
  let column = null;
  const draw = (k) => {
    drawn += `${pen}${x(t[k]).toFixed(2)} ${y(v[k]).toFixed(2)}`;
    pen = "L";
  };
  const flush = () => {
    if (column) [...new Set(column)].toSorted((a, b) => a - b).forEach(draw);
    column = null;
  };
  const end = Math.min(lastUpTo(t, span[1]) + 1, t.length - 1);
  let pixel = NaN;
  for (let k = Math.max(lastUpTo(t, span[0]), 0); k <= end; k += 1) {
    if (v[k] === null) {
      flush();
      pen = "M";
      continue;
    }
    const here = Math.floor(x(t[k]));
    if (here !== pixel || !column) {
      flush();
      pixel = here;
      column = [k, k, k, k]; // first, lowest, highest, last
    }
    if (v[k] < v[column[1]]) column[1] = k;
    if (v[k] > v[column[2]]) column[2] = k;
    column[3] = k;
  }
  flush();
  return drawn;
}
