// Contours of the mean PRD over friction and slope, with the arrays, and the value at a point.

import { html, note, points, replace, set, svg } from "./make.js";
import { number, reading } from "./reading.js";
import { axisAcross, axisUp, onKeys, percent, within } from "./view-parts.js";

const EDGE = 0.03; // of the range, around the outermost points
const FINE = 0.1; // of a cell
const LABEL = 13; // height of a label
const AIR = 3; // between labels
const DOT = 13; // width of an array's dot
const [WIDE, TALL] = [300, 318]; // of a narrow plot, TALL as in views.css: labels that are clear of each other there are so in wider ones

/** Draw the contours in an element. */
export function build(element, data) {
  const { mus, slopes_deg: slopes, here } = data;
  const [across, up] = [roomy(mus), roomy(slopes)];
  const place = (mu, slope) => [percent(mu, across), 100 - percent(slope, up)];
  const cursor = [svg("line", { class: "cursor", y2: "100%" }), svg("line", { class: "cursor", x2: "100%" })];
  const plot = svg(
    "svg",
    { class: "plot contour", tabindex: 0, role: "application", "aria-label": data.texts.title, "aria-describedby": "contour-keys" },
    axisAcross(across, 7),
    svg("svg", { y: "100%" }, svg("text", { class: "label middle-of", x: "50%", y: 36 }, "Friction coefficient μ at low velocity")),
    axisUp(up, 6),
    svg("svg", { y: "50%" }, svg("text", { class: "label middle-of", transform: "translate(-33 0) rotate(-90)" }, "Slope [deg]")),
    crosses(data, place),
    lines(data, place),
    cursor,
    data.dots.map((dot) => arrayDot(dot, place)),
  );
  const where = html("output", { class: "numbers", role: "status" });
  let at = {};

  function read(mu, slope) {
    at = { mu: within(mu, mus[0], mus.at(-1)), slope: within(slope, slopes[0], slopes.at(-1)) };
    const [x, y] = place(at.mu, at.slope).map((part) => `${part}%`);
    set(cursor[0], { x1: x, x2: x });
    set(cursor[1], { y1: y, y2: y });
    where.textContent = words(data, at);
  }

  plot.addEventListener("pointermove", ({ clientX, clientY }) => {
    const { left, bottom, width, height } = plot.getBoundingClientRect();
    read(valueAt((clientX - left) / width, across), valueAt((bottom - clientY) / height, up));
  });
  plot.addEventListener("pointerdown", () => plot.focus());
  const go = (right, above) => ({ shiftKey }) => read(moved(mus, at.mu, right, shiftKey), moved(slopes, at.slope, above, shiftKey));
  onKeys(plot, {
    ArrowLeft: go(-1, 0),
    ArrowRight: go(1, 0),
    ArrowDown: go(0, -1),
    ArrowUp: go(0, 1),
    Home: () => read(here.mu, here.slope_deg),
  });
  replace(
    element,
    html("h3", { class: "view-title" }, data.texts.title),
    html("p", { class: "contour-reading" }, html("strong", {}, data.texts.here), where),
    plot,
    html("p", { class: "note", id: "contour-keys" }, "Point, or use the arrow keys: to the next computed value, with Shift a tenth of that, Home back to the array."),
    note(data.texts.notes.join(" ")),
  );
  read(here.mu, here.slope_deg);
}

function words({ mus, slopes_deg: slopes, prd_m: prd, least_m: least, units }, { mu, slope }) {
  const { value, isComputed } = surfaceAt(mus, slopes, prd, mu, slope, least);
  const where = `μ ${number(mu, 3)}, slope ${number(slope, 2)} deg`;
  if (value === null) return `${where}: no value; a run gives no displacement`;
  const isLeast = value <= least && !isComputed;
  return `${where}: mean PRD ${isLeast ? "at most " : ""}${reading(value, units)}, ${isComputed ? "computed" : "interpolated"}`;
}

/**
 * Return the value at a point, and whether it is a computed one. `values` has a row for each of `ys`;
 * values below `least` count as that, null is no value.
 */
export function surfaceAt(xs, ys, values, x, y, least) {
  const [i, p] = cell(xs, x);
  const [j, q] = cell(ys, y);
  const corners = [
    [values[j][i], (1 - p) * (1 - q)],
    [values[j][i + 1], p * (1 - q)],
    [values[j + 1][i], (1 - p) * q],
    [values[j + 1][i + 1], p * q],
  ].filter(([, share]) => share > 1e-9);
  if (corners.some(([value]) => value === null)) return { value: null, isComputed: false };
  if (corners.length === 1) return { value: corners[0][0], isComputed: true };
  const sum = corners.reduce((total, [value, share]) => total + share * Math.log10(Math.max(value, least)), 0);
  return { value: 10 ** sum, isComputed: false };
}

function cell(axis, value) {
  const k = Math.max(axis.findLastIndex((one, at) => one <= value && at < axis.length - 1), 0);
  return [k, (value - axis[k]) / (axis[k + 1] - axis[k])];
}

function valueAt(share, [low, high]) {
  return low + share * (high - low);
}

// The next computed value of an axis, or a tenth of the way to it.
function moved(axis, value, way, isFine) {
  if (way === 0) return value;
  if (isFine) return value + (way * FINE * (axis.at(-1) - axis[0])) / (axis.length - 1);
  const beyond = axis.filter((one) => way * (one - value) > 1e-9);
  return (way > 0 ? beyond[0] : beyond.at(-1)) ?? value;
}

function roomy(axis) {
  const room = EDGE * (axis.at(-1) - axis[0]);
  return [axis[0] - room, axis.at(-1) + room];
}

function crosses({ mus, slopes_deg: slopes, prd_m: prd }, place) {
  const at = (mu, slope, value) =>
    svg("svg", placed(place(mu, slope), "x", "y"), svg("path", value === null ? { class: "lost", d: "M-4 -4l8 8m0 -8l-8 8" } : { d: "M-3 0h6M0 -3v6" }));
  return svg("g", { class: "computed" }, slopes.map((slope, row) => mus.map((mu, column) => at(mu, slope, prd[row][column]))));
}

// Each level with its value on its longest line, near the middle, where no other label stands.
function lines({ levels, dots }, place) {
  const taken = dots.flatMap(({ mu, slope_deg: slope, name }) => {
    const { x, y } = inPixels(place(mu, slope));
    const wide = widthOf(name);
    return [{ x, y, wide: DOT }, { x: x + 9 + wide / 2, y: y - 11, wide }];
  });
  const labels = [];
  const curves = levels.flatMap(({ lines: contours, text, is_major: isMajor }) => {
    const all = contours.map((line) => line.map(([mu, slope]) => place(mu, slope)));
    const longest = all.toSorted((a, b) => b.length - a.length)[0] ?? [];
    const spots = longest.map((point, k) => ({ ...inPixels(point), wide: widthOf(text), point, off: Math.abs(k - (longest.length - 1) / 2) }));
    const [spot] = spots.filter((one) => isFree(one, taken)).toSorted((a, b) => a.off - b.off);
    if (spot) {
      taken.push(spot);
      labels.push(svg("text", { class: "label middle-of on-line", ...placed(spot.point, "x", "y"), dy: 4 }, text));
    }
    return all.map((line) => svg("polyline", { class: `isoline${isMajor ? " is-major" : ""}`, points: points(line) }));
  });
  return [svg("svg", { viewBox: "0 0 100 100", preserveAspectRatio: "none" }, curves), labels];
}

// Whether a label is inside the plot and clear of others, by their middles and widths.
function isFree({ x, y, wide }, taken) {
  const isInside = Math.abs(x - WIDE / 2) <= (WIDE - wide) / 2 && Math.abs(y - TALL / 2) <= (TALL - LABEL) / 2;
  return isInside && taken.every((one) => Math.abs(x - one.x) >= (wide + one.wide) / 2 + AIR || Math.abs(y - one.y) >= LABEL + AIR);
}

// The width of a label, about.
function widthOf(text) {
  return text.length * LABEL * 0.5 + 3;
}

function inPixels([x, y]) {
  return { x: (x * WIDE) / 100, y: (y * TALL) / 100 };
}

function placed([x, y], across, up) {
  return { [across]: `${x}%`, [up]: `${y}%` };
}

function arrayDot({ mu, slope_deg: slope, name, is_shown: isShown }, place) {
  const at = place(mu, slope);
  return svg(
    "g",
    { class: "array-dot" },
    svg("circle", { ...placed(at, "cx", "cy"), r: isShown ? 6 : 4.5 }),
    svg("text", { class: `on-line ${isShown ? "strong" : "label"}`, ...placed(at, "x", "y"), dx: 9, dy: -7 }, name),
  );
}
