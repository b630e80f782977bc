// What moves with the time of a run: the roof over the ground and the array over the roof, where it leaves its
// path; beside them histories.

import { html, points, set, svg } from "./make.js";
import { roundBelow, within } from "./view-parts.js";
import { createPanels, panelOf } from "./view-panels.js";

const CLOSE_S = 4; // of the forces, around the time
const MOST_DEMAND = 1.6; // times the largest friction used: the axis of friction ends there
const LEAST_M = 1e-4; // a motion below it is none
// In percent of the smaller side of a plan, which the browser scales:
const ARRAY = 30; // that the array fills
const MOTION = 34; // to each side, that the motion fills
const GRID = 18; // between the lines of the roof
const ROOF = 18 * GRID; // that the lines go to, so that they never end while they move
const BAR = 45; // of the scale bar, at most

/** Return the stage of a run; `seek` is called with the time where the whole run is pressed. */
export function createStage(data, seek) {
  const run = { ...data, ...motionOf(data) };
  const tracks = [createTrack(run, "From the ground", run.base), createTrack(run, "On the roof", run.base.map(() => [0, 0]))];
  const [relative, normal, friction] = ["relative", "normal", "friction"].map((kind) => panelOf(data, kind));
  const used = Math.max(0.1, friction.series[0].v.reduce((most, value) => Math.max(most, value), 0));
  const whole = createPanels([relative], data);
  const close = createPanels([normal, { ...friction, least: 0, most: MOST_DEMAND * used }], data, Math.min(CLOSE_S, data.seconds));
  const element = html(
    "div",
    { class: "watch", tabindex: 0, role: "application", "aria-label": "Run in time", "aria-describedby": "slide-keys" },
    html("div", { class: "plans" }, tracks.map((track) => track.element)),
    html("div", { class: "strips" }, html("div", { class: "whole-run" }, whole.element), close.element),
  );
  for (const kind of ["pointerdown", "pointermove"]) {
    whole.element.addEventListener(kind, (event) => event.buttons === 1 && seek(whole.timeAt(event)));
  }
  return {
    element,
    /** Move everything to a time, and mark the slip under way. */
    at(time, slip) {
      for (const part of [whole, close, ...tracks]) part.at(time, slip);
    },
  };
}

// In the axes of the plan the places of the roof and of the array relative to it [m], which stays where it has no
// displacement.
function motionOf({ relative: { series }, roof_m: roof, plan }) {
  const turned = (down, across) => inPlan(down ?? 0, across ?? 0, plan.downslope_deg);
  const path = series[0].v.map((down, k) => turned(down, series[1]?.v[k]));
  const base = roof[0].map((down, k) => turned(down, roof[1]?.[k]));
  return { base, path };
}

// Cross-slope is to the left of one who faces downslope. The plan counts up, SVG down.
function inPlan(down, across, degrees) {
  const [cos, sin] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
  return [down * cos - across * sin, -down * sin - across * cos];
}

/**
 * Return a plan of a run beside what its `base` moves over; `at` moves it to a time and marks the slip under
 * way on its path.
 */
function createTrack(run, title, base) {
  const { shape, pixel, moves, factor } = scaleOf(run, base);
  const placed = (places) => places.map(([x, y]) => [x * pixel, y * pixel]);
  const [roof, path] = [placed(base), placed(run.path)];
  const along = lengths(path);
  const line = (look) => svg("polyline", { class: look, points: points(path) });
  const [done, picked] = [line("track-done"), line("track-picked")];
  const block = svg("polygon", { class: "track-block", points: shape });
  const moving = svg("g", {}, block, svg("circle", { class: "track-center", r: 2.3 }));
  const [cx, cy] = between(path, run, run.t_prd_s ?? 0);
  const onRoof = svg(
    "g",
    {},
    svg("path", { class: "track-grid", d: gridOf() }),
    svg("polygon", { class: "track-start", points: shape }),
    moving,
    line("track-path"),
    done,
    picked,
    svg("path", { class: "start", d: "M-4 0h8M0 -4v8" }),
    run.t_prd_s !== null && svg("circle", { class: "peak", r: 2.6, cx, cy }),
  );
  const isFromGround = base === run.base;
  const scene = svg("svg", { viewBox: "-50 -50 100 100", preserveAspectRatio: "xMidYMin" }, onRoof, isFromGround && svg("path", { class: "track-ground", d: "M-500 0H-43M500 0H43M0 50v-7" }));
  const words = [title, moves && `Motion ${factor === 1 ? "to scale" : `× ${factor}`}`];

  const gone = (time) => {
    const [k, [x, y]] = [sampleAt(run, time), between(path, run, time)];
    return along[k] + Math.hypot(x - path[k][0], y - path[k][1]);
  };
  return {
    element: svg("svg", { role: "img", class: "track", "aria-label": `Plan in motion. ${title}` }, scene, footOf(run, words, pixel)),
    at(time, slip) {
      onRoof.setAttribute("transform", `translate(${between(roof, run, time)})`);
      moving.setAttribute("transform", `translate(${between(path, run, time)})`);
      block.classList.toggle("is-slipping", Boolean(slip));
      set(done, dashes(0, gone(time)));
      set(picked, slip ? dashes(gone(slip.from_s), gone(slip.to_s)) : dashes(0, 0));
    },
  };
}

// How large the array and its motion are drawn: `pixel` is of a meter of the motion.
function scaleOf({ plan: { outline }, path }, base) {
  const [xs, ys] = [0, 1].map((axis) => outline.map((point) => point[axis]).toSorted((a, b) => a - b));
  const [wide, tall] = [xs, ys].map((all) => all.at(-1) - all[0]);
  const perMeter = ARRAY / Math.max(wide, tall, 1e-9);
  const reach = base.reduce((most, [x, y], k) => Math.max(most, Math.hypot(x, y), Math.hypot(x + path[k][0], y + path[k][1])), 0);
  const moves = reach >= LEAST_M;
  const factor = moves ? roundBelow(MOTION / (reach * perMeter)) : 1;
  const shape = points(outline.map(([x, y]) => [(x - xs[0] - wide / 2) * perMeter, (ys[0] + tall / 2 - y) * perMeter]));
  return { shape, pixel: factor * perMeter, moves, factor };
}

// The part of a line from one length to another.
function dashes(from, to) {
  return { "stroke-dasharray": `0 ${from} ${to - from} 1e6`, visibility: to > from ? "visible" : "hidden" };
}

// The length of a path up to each of its points.
function lengths(path) {
  let sum = 0;
  return path.map(([x, y], k) => {
    if (k > 0) sum += Math.hypot(x - path[k - 1][0], y - path[k - 1][1]);
    return sum;
  });
}

// The number of the last sample but one that is not after a time.
function sampleAt({ dt_s: dt, path }, time) {
  return within(Math.floor(time / dt), 0, path.length - 2);
}

function between(places, run, time) {
  const k = sampleAt(run, time);
  const share = within(time / run.dt_s - k, 0, 1);
  return [0, 1].map((axis) => places[k][axis] + share * (places[k + 1][axis] - places[k][axis]));
}

function gridOf() {
  let lines = "";
  for (let at = -ROOF; at <= ROOF; at += GRID) lines += `M${at} ${-ROOF}V${ROOF}M${-ROOF} ${at}H${ROOF}`;
  return lines;
}

// Words in the corners, a bar of a round length, and the arrow downslope.
function footOf({ plan, relative }, words, pixel) {
  const [unit] = relative.units;
  const length = roundBelow(BAR / pixel / unit.si);
  return svg(
    "g",
    { class: "track-foot" },
    words.map((text, k) => text && svg("text", { class: "tick on-line", x: 10, y: 16 * (k + 1) }, text)),
    svg("svg", { viewBox: "-6 -94 100 100", preserveAspectRatio: "xMinYMax" }, svg("path", { class: "bar-line", d: `M0 -3v6M0 0h${length * unit.si * pixel}m0 -3v6` })),
    svg("svg", { y: "100%" }, svg("text", { class: "label on-line", x: 10, y: -20 }, `${length} ${unit.symbol}`)),
    svg(
      "svg",
      { x: "100%", y: "100%" },
      svg("g", { transform: `translate(-26 -26) rotate(${-plan.downslope_deg})` }, svg("path", { class: "arrow", d: "M-14 0H14M6 -4L14 0L6 4" })),
      svg("text", { class: "tick on-line end-at", x: -8, y: -48 }, "downslope"),
    ),
  );
}
