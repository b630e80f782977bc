// What moves with the time of a run: the roof over the ground and the array over the roof, where it leaves its
// path; beside them histories.

import { html, points, replace, set, svg } from "./make.js";
import { arrow, boxAround, cross, roundBelow, scaleBar, within } from "./view-parts.js";
import { createPanels, lastUpTo, panelOf, rangeIn } from "./view-panels.js";

const HEIGHT = 330;
const GROUND = 142; // height of the plan seen from the ground
const GAP = 6;
const WHOLE = 128; // height of the displacement over the whole run
const CLOSE_S = 4; // of the forces, around the time
const NARROW = 540; // below it the plans are above the histories
const FOOT = 60; // below a plan that is narrow: the array moves over no words there
const PLAN = 0.4; // of the width
const BETWEEN = 12; // plans and histories
const MOST_DEMAND = 1.6; // times the largest friction used: the axis of friction ends there
const ARRAY = 0.3; // of the drawing, that the array fills
const MOTION = 0.34; // of the drawing, to each side, that the motion fills
const GRID = 26; // pixels between the lines of the roof
const LEAST_M = 1e-4; // a motion below it is none
const BAR = 80; // pixels of the scale bar, at most

/** Return the stage of a run; `seek` is called with the time where the whole run is pressed. */
export function createStage(data, seek) {
  const { seconds } = data;
  const tracks = [false, true].map((isFromRoof) => createTrack(data, isFromRoof));
  const [displacement, ...forces] = panelsOf(data);
  const whole = createPanels([displacement], data);
  const close = createPanels(forces, data);
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
    resize(wide) {
      const isNarrow = wide < NARROW;
      element.classList.toggle("is-narrow", isNarrow);
      const plan = isNarrow ? (wide - GAP) / 2 : Math.round(PLAN * wide);
      tracks[0].resize(plan, isNarrow ? plan + FOOT : GROUND);
      tracks[1].resize(plan, isNarrow ? plan + FOOT : HEIGHT - GROUND - GAP);
      const right = isNarrow ? wide : wide - plan - BETWEEN;
      whole.resize(right, WHOLE);
      close.resize(right, HEIGHT - WHOLE);
    },
    /** Move everything to a time, and mark the slip under way. */
    at(time, slip) {
      const from = within(time - CLOSE_S / 2, 0, Math.max(seconds - CLOSE_S, 0));
      close.show([from, Math.min(from + CLOSE_S, seconds)]);
      for (const part of [whole, close, ...tracks]) part.at(time, slip);
    },
  };
}

function panelsOf(data) {
  const [relative, normal, friction] = ["relative", "normal", "friction"].map((kind) => panelOf(data, kind));
  const over = [0, data.seconds];
  const [, most] = rangeIn(friction.series[0], over) ?? [0, 1];
  return [
    relative,
    { ...normal, over },
    { ...friction, least: 0, most: MOST_DEMAND * Math.max(most, 0.1), over },
  ];
}

/**
 * Return a plan of a run, seen from the ground or from the roof; `at` moves it to a time and marks
 * the slip under way on its path.
 */
function createTrack(data, isFromRoof) {
  const run = motion(data, isFromRoof);
  const title = isFromRoof ? "On the roof" : "From the ground";
  const shapes = makeShapes(isFromRoof, `Plan in motion. ${title}`);
  let scale = null;

  return {
    element: shapes.drawing,
    resize(width, height) {
      scale = scaleOf(run, data.plan.outline, width, height);
      place(shapes, run, data, { ...scale, title });
    },
    at(time, slip) {
      if (!scale) return;
      const { pixel, path, along } = scale;
      const [roof, [x, y]] = [run.base, run.relative].map((places) => between(run.t, places, time).map((value) => value * pixel));
      shapes.onRoof.setAttribute("transform", translation(roof));
      shapes.moving.setAttribute("transform", translation([x, y]));
      shapes.block.classList.toggle("is-slipping", Boolean(slip));
      const k = Math.max(lastUpTo(run.t, time), 0);
      const gone = along[k] + Math.hypot(x - path[k][0], -y - path[k][1]);
      set(shapes.done, { "stroke-dasharray": `${gone.toFixed(1)} ${along.at(-1) + 1}`, visibility: gone > 0 ? "visible" : "hidden" });
      set(shapes.picked, { points: slip ? points(piece(run, scale, slip)) : "" });
    },
  };
}

function makeShapes(isFromRoof, title) {
  const parts = {
    grid: svg("path", { class: "track-grid" }),
    start: svg("polygon", { class: "track-start" }),
    block: svg("polygon", { class: "track-block" }),
    whole: svg("polyline", { class: "track-path" }),
    done: svg("polyline", { class: "track-done" }),
    picked: svg("polyline", { class: "track-picked" }),
    peak: svg("circle", { class: "peak", r: 4 }),
    ground: isFromRoof ? null : svg("path", { class: "track-ground" }),
    foot: svg("g", { class: "track-foot" }),
  };
  const { grid, start, block, whole, done, picked, peak, ground, foot } = parts;
  const moving = svg("g", {}, block, svg("circle", { class: "track-center", r: 3.5 }));
  const onRoof = svg("g", {}, grid, start, moving, whole, done, picked, svg("path", { class: "start", d: cross([0, 0], 6) }), peak);
  const drawing = svg("svg", { role: "img", class: "track", "aria-label": title }, onRoof, ground, foot);
  return { ...parts, moving, onRoof, drawing };
}

// Pixels of a meter, of the plan and of the motion, with the path and its length at that scale.
function scaleOf({ reach, relative }, outline, width, height) {
  const least = Math.min(width, height);
  const box = boxAround(outline);
  const perMeter = (ARRAY * least) / Math.max(box.wide, box.tall, 1e-9);
  const moves = reach >= LEAST_M;
  const factor = moves ? roundBelow((MOTION * least) / (reach * perMeter)) : 1;
  const pixel = factor * perMeter;
  const path = relative.map(([x, y]) => [x * pixel, -y * pixel]);
  return { width, height, box, perMeter, moves, factor, pixel, path, along: lengths(path) };
}

function place(shapes, { peak }, data, scale) {
  const { width, height, box, perMeter, pixel, path } = scale;
  const [cx, top] = [width / 2, Math.min(width, height) / 2];
  const bottom = height - top;
  set(shapes.drawing, { width, height, viewBox: `${-cx} ${-top} ${width} ${height}` });
  const shape = points(data.plan.outline.map(([x, y]) => [(x - box.x - box.wide / 2) * perMeter, (box.y + box.tall / 2 - y) * perMeter]));
  for (const polygon of [shapes.start, shapes.block]) set(polygon, { points: shape });
  const line = points(path);
  for (const one of [shapes.whole, shapes.done]) set(one, { points: line });
  set(shapes.grid, { d: gridOf(width, height) });
  if (shapes.ground) set(shapes.ground, { d: `M${-cx} 0h10M${cx} 0h-10M0 ${bottom}v-10` });
  if (peak) set(shapes.peak, { cx: (peak[0] * pixel).toFixed(1), cy: (-peak[1] * pixel).toFixed(1) });
  set(shapes.peak, { visibility: peak ? "visible" : "hidden" });
  drawFoot(shapes.foot, { cx, top, bottom, scale, data });
}

// The part of the path of one slip.
function piece({ t, relative }, { pixel, path }, { from_s: from, to_s: to }) {
  const inside = path.slice(lastUpTo(t, from) + 1, lastUpTo(t, to) + 1);
  const [first, last] = [from, to].map((time) => between(t, relative, time)).map(([x, y]) => [x * pixel, -y * pixel]);
  return [first, ...inside, last];
}

// Times, and in the axes of the plan the places of the drawing's base, of the array relative to the
// roof, and of the PRD; `reach` is how far the motion goes [m]. The array stays where it has no
// displacement.
function motion({ relative: { series }, roof_m: roof, dt_s: dt, t_prd_s: tPrd, plan }, isFromRoof) {
  const turned = (down, across) => inPlan(down ?? 0, across ?? 0, plan.downslope_deg);
  const relative = series[0].v.map((down, k) => turned(down, series[1]?.v[k]));
  const base = roof[0].map((down, k) => (isFromRoof ? [0, 0] : turned(down, roof[1]?.[k])));
  const reach = base.reduce((most, [x, y], k) => Math.max(most, Math.hypot(x, y), Math.hypot(x + relative[k][0], y + relative[k][1])), 0);
  const t = base.map((_, k) => k * dt);
  return { t, base, relative, reach, peak: tPrd === null ? null : between(t, relative, tPrd) };
}

// Cross-slope is to the left of one who faces downslope.
function inPlan(down, across, degrees) {
  const [cos, sin] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
  return [down * cos - across * sin, down * sin + across * cos];
}

// The length of a path up to each of its points.
function lengths(path) {
  let sum = 0;
  return path.map(([x, y], k) => {
    if (k > 0) sum += Math.hypot(x - path[k - 1][0], y - path[k - 1][1]);
    return sum;
  });
}

function between(t, places, time) {
  const k = within(lastUpTo(t, time), 0, t.length - 2);
  const share = within((time - t[k]) / (t[k + 1] - t[k]), 0, 1);
  return [0, 1].map((axis) => places[k][axis] + share * (places[k + 1][axis] - places[k][axis]));
}

// Lines on the roof, beyond the drawing on all sides, so that it never ends while it moves.
function gridOf(width, height) {
  const [across, up] = [Math.ceil(width / GRID), Math.ceil(height / GRID)];
  const [w, h] = [across * GRID, up * GRID];
  let lines = "";
  for (let k = -across; k <= across; k += 1) lines += `M${k * GRID} ${-h}V${h}`;
  for (let k = -up; k <= up; k += 1) lines += `M${-w} ${k * GRID}H${w}`;
  return lines;
}

function translation([x, y]) {
  return `translate(${x.toFixed(2)} ${(-y).toFixed(2)})`;
}

function drawFoot(foot, { cx, top, bottom, scale: { title, pixel, moves, factor }, data: { plan, relative } }) {
  const shown = moves && `Motion ${factor === 1 ? "to scale" : `× ${factor}`}`;
  const [dx, dy] = inPlan(1, 0, plan.downslope_deg);
  replace(
    foot,
    scaleBar([-cx + 10, bottom - 12], relative.units[0], pixel, BAR),
    [title, shown].map((words, k) => words && svg("text", { class: "tick on-line", x: -cx + 10, y: -top + 16 * (k + 1) }, words)),
    arrow([cx - 26, bottom - 26], [dx, -dy], 14),
    svg("text", { class: "tick on-line end-at", x: cx - 8, y: bottom - 48 }, "downslope"),
  );
}
