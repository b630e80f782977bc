// Histories one above the other over one axis of time, with the value at a time in their headings. The server
// sends values at the samples, or at the numbers of samples beside them, null where there is none.

import { html, svg } from "./make.js";
import { measured, tickText } from "./reading.js";
import { axisUp, percent, ticks, within } from "./view-parts.js";

const ROOM = 0.06; // of the range of the values, above and below
const TICKS = 4; // of the time in sight, about
const PIECE = 400; // samples of a path: the browser paints those in sight
const LOOKS = { cross: "is-across", vertical: "is-third", demand: "is-third" };

/**
 * Return panels of a run, of which so many seconds are in sight: `panels` are `{ title, units, series, least, most }`,
 * where `series` have `name`, `t`, `v` and `look`, and `least` and `most` bound the axis. Values read in the
 * first unit. `at(time, slip)` marks a time, and a slip if one is given; `timeAt(event)` is that under a pointer.
 */
export function createPanels(panels, { seconds, slips }, shown = seconds) {
  const { values: times, step } = ticks(0, seconds, (TICKS * seconds) / shown);
  const runs = [];
  // As wide as the whole run, and moved to the seconds in sight.
  const run = (...content) => {
    runs.push(svg("svg", { width: `${percent(seconds, [0, shown])}%` }, content));
    return svg("svg", { class: "clip" }, runs.at(-1));
  };
  const ground = () => [svg("path", { class: "slip-bands", d: slips.map(bandOf).join("") }), svg("path", { class: "hair", d: times.map(upright).join("") })];
  const drawn = panels.map((panel) =>
    createPanel(panel, (...content) => run(svg("svg", { viewBox: `0 0 ${seconds} 100`, preserveAspectRatio: "none" }, ground(), content))),
  );
  const labels = times.map((time) => svg("text", { class: "tick", x: `${percent(time, [0, seconds])}%`, dx: 3, y: 15 }, `${tickText(time, step)} s`));
  const axis = svg("svg", { class: "plot times", "aria-hidden": true }, run(labels));

  return {
    element: html("div", { class: "panels" }, drawn.map(({ element }) => element), axis),
    at(time, slip) {
      const from = within(time - shown / 2, 0, seconds - shown);
      for (const one of runs) one.setAttribute("x", `${-percent(from, [0, shown])}%`);
      for (const one of drawn) one.mark(time, slip);
    },
    timeAt({ clientX }) {
      const { left, width } = axis.getBoundingClientRect();
      return (seconds * (clientX - left)) / width;
    },
  };
}

// A panel; `placed` draws contents over seconds and percents.
function createPanel({ title, units: [unit], series, least, most }, placed) {
  const values = series.map(() => html("span", { class: "value numbers" }));
  const looks = series.map(({ name, look }, k) => html("span", { class: "reading" }, sample(look), `${name} `, values[k]));
  const range = limits(series, unit, least, most);
  const band = svg("path", { class: "slip-picked" });
  const curves = series.map((one) => curve(one, (value) => 100 - percent(value / unit.si, range)));
  const cursor = svg("path", { class: "cursor" });
  const plot = svg("svg", { class: "plot", role: "img", "aria-label": `${title} in time` }, axisUp(range, 3.5, true), placed(band, curves.toReversed(), cursor));
  return {
    element: html("div", { class: "panel" }, html("div", { class: "panel-head" }, html("strong", {}, title), looks), plot),
    mark(time, slip) {
      cursor.setAttribute("d", upright(time));
      band.setAttribute("d", slip ? bandOf(slip) : "");
      series.forEach((one, k) => {
        values[k].textContent = measured(valueAt(one, time), unit);
      });
    },
  };
}

// Points in pairs, so that a drawing that is saved can place them.
function bandOf({ from_s: from, to_s: to }) {
  return `M${from} 0L${to} 0L${to} 100L${from} 100Z`;
}

function upright(time) {
  return `M${time} 0L${time} 100`;
}

// The range of an axis in a unit, with some room around the values.
function limits(series, { si }, least, most = Infinity) {
  const values = series.flatMap(({ v }) => v).filter((value) => value !== null).toSorted((a, b) => a - b);
  let [low, high] = [least ?? values[0] ?? 0, Math.min(most, values.at(-1) ?? 0)];
  if (!(low < high)) [low, high] = [low - si, low + si];
  const room = ROOM * (high - low);
  return [least ?? low - room, high + room].map((value) => value / si);
}

function sample(look) {
  return svg("svg", { class: "sample", "aria-hidden": true, viewBox: "0 0 20 10" }, svg("path", { class: `curve ${look}`, d: "M0 5H20" }));
}

/** Return the panel of a kind, such as `velocity`: a title and units, and histories with times and look. */
export function panelOf(data, kind) {
  const series = data[kind].series.map(({ name, i, v }) => ({
    name,
    look: LOOKS[name] ?? "is-first",
    t: Array.from(i ?? v.keys(), (k) => k * data.dt_s),
    v,
  }));
  return { title: data[kind].title, units: data[kind].units, series };
}

/** Return the value at a time, linear between the samples; null where there is none. */
export function valueAt({ t, v }, time) {
  const k = Math.max(t.findLastIndex((one) => one <= time), 0);
  if (k === t.length - 1 || time <= t[k]) return v[k];
  if (v[k] === null || v[k + 1] === null) return null;
  return v[k] + ((v[k + 1] - v[k]) * (time - t[k])) / (t[k + 1] - t[k]);
}

/** Return a history of all of its samples as paths, each from the end of the one before; `y` places a value. */
export function curve({ t, v, look }, y) {
  const paths = [];
  for (let begin = 0; begin < v.length; begin += PIECE) {
    const piece = v.slice(begin, begin + PIECE + 1);
    const pen = (k) => ((piece[k - 1] ?? null) === null ? "M" : "L");
    const points = piece.map((value, k) => (value === null ? "" : `${pen(k)}${t[begin + k].toFixed(4)} ${y(value).toFixed(2)}`));
    paths.push(svg("path", { class: `curve ${look}`, d: points.join("") }));
  }
  return paths;
}
