// Contours of the mean PRD over friction and slope, with the arrays, and the value at a point.

import { html, note, points, replace, set, svg } from "./make.js";
import { number, reading } from "./reading.js";
import { onKeys } from "./view-frame.js";
import { cross, frame, linesAcross, linesUp, onPointer, scale, setSize, textsAcross, textsUp, ticks, within } from "./view-parts.js";

const HEIGHT = 370;
const MARGIN = { left: 46, right: 16, top: 10, bottom: 42 };
const EDGE = 0.03; // of the range, around the outermost points
const FINE = 0.1; // of a cell
const LABEL = 13; // height of a label
const AIR = 3; // between labels
const TICK = 4;
const DOT = 13; // width of an array's dot

/** Draw the contours in an element. */
export function build(element, data) {
  const { mus, slopes_deg: slopes } = data;
  const cursor = svg("path", { class: "cursor", visibility: "hidden" });
  const plot = svg("svg", { class: "contour", tabindex: 0, role: "application", "aria-label": data.texts.title, "aria-describedby": "contour-keys" });
  const where = html("output", { class: "numbers", role: "status" });
  let x = null;
  let y = null;
  let at = { mu: data.here.mu, slope: data.here.slope_deg };

  function read(mu, slope) {
    at = { mu: within(mu, mus[0], mus.at(-1)), slope: within(slope, slopes[0], slopes.at(-1)) };
    set(cursor, { d: `M${x(at.mu)} ${MARGIN.top}V${HEIGHT - MARGIN.bottom}M${MARGIN.left} ${y(at.slope)}H${x.ends[1]}`, visibility: "visible" });
    where.textContent = words(data, at);
  }

  onPointer(plot, ([across, up]) => read(x.inverse(across), y.inverse(up)));
  plot.addEventListener("pointerdown", () => plot.focus());
  const go = (right, up) => ({ shiftKey }) => read(moved(mus, at.mu, right, shiftKey), moved(slopes, at.slope, up, shiftKey));
  onKeys(plot, {
    ArrowLeft: go(-1, 0),
    ArrowRight: go(1, 0),
    ArrowDown: go(0, -1),
    ArrowUp: go(0, 1),
    Home: () => read(data.here.mu, data.here.slope_deg),
  });

  function resize(wide) {
    setSize(plot, wide, HEIGHT);
    x = scale(roomy(mus), [MARGIN.left, wide - MARGIN.right]);
    y = scale(roomy(slopes), [HEIGHT - MARGIN.bottom, MARGIN.top]);
    const named = data.dots.map((dot) => ({ ...dot, at: [x(dot.mu), y(dot.slope_deg)] }));
    replace(plot, axes(data, x, y), svg("g", { class: "computed" }, crosses(data, x, y)), lines(data, x, y, named), cursor, named.map(arrayDot));
    read(at.mu, at.slope);
  }

  replace(
    element,
    html("h3", { class: "view-title" }, data.texts.title),
    html("p", { class: "contour-reading" }, html("strong", {}, data.texts.here), where),
    plot,
    html("p", { class: "note", id: "contour-keys" }, "Point, or use the arrow keys: to the next computed value, with Shift a tenth of that, Home back to the array."),
    note(data.texts.notes.join(" ")),
  );
  return { resize };
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
  let k = 0;
  while (k + 2 < axis.length && axis[k + 1] <= value) k += 1;
  return [k, (value - axis[k]) / (axis[k + 1] - axis[k])];
}

// The next computed value of an axis, or a tenth of the way to it.
function moved(axis, value, way, isFine) {
  if (way === 0) return value;
  if (isFine) return value + (way * FINE * (axis.at(-1) - axis[0])) / (axis.length - 1);
  const beyond = axis.filter((one) => way * (one - value) > 1e-9);
  if (beyond.length === 0) return value;
  return way > 0 ? beyond[0] : beyond.at(-1);
}

function roomy(axis) {
  const room = EDGE * (axis.at(-1) - axis[0]);
  return [axis[0] - room, axis.at(-1) + room];
}

function axes({ mus, slopes_deg: slopes }, x, y) {
  const [[left, right], [foot, top]] = [x.ends, y.ends];
  const across = ticks(...roomy(mus), (right + MARGIN.right) / 90);
  const up = ticks(...roomy(slopes), 6);
  return svg(
    "g",
    { class: "axes" },
    frame(x, y),
    linesAcross(across, x, [foot, foot + TICK]),
    textsAcross(across, x, foot + 17),
    linesUp(up, [left - TICK, left], y),
    textsUp(up, left - 7, y),
    svg("text", { class: "label middle-of", x: (left + right) / 2, y: HEIGHT - 6 }, "Friction coefficient μ at low velocity"),
    svg("text", { class: "label middle-of", transform: `translate(13 ${(top + foot) / 2}) rotate(-90)` }, "Slope [deg]"),
  );
}

function crosses({ mus, slopes_deg: slopes, prd_m: prd }, x, y) {
  return slopes.flatMap((slope, row) =>
    mus.map((mu, column) => {
      const [a, b] = [x(mu), y(slope)];
      const isLost = prd[row][column] === null;
      return svg("path", isLost ? { class: "lost", d: `M${a - 4} ${b - 4}l8 8m0 -8l-8 8` } : { d: cross([a, b], 3) });
    }),
  );
}

// Each level with its value on its longest line, where no other label stands.
function lines({ levels }, x, y, named) {
  const inside = { x: MARGIN.left, y: MARGIN.top, wide: x.ends[1] - MARGIN.left, tall: HEIGHT - MARGIN.bottom - MARGIN.top };
  const taken = named.flatMap(({ at: [a, b], name }) => [labelBox([a, b], DOT), labelBox([a + 9 + widthOf(name) / 2, b - 11], widthOf(name))]);
  return levels.map(({ lines: contours, text, is_major: isMajor }) => {
    const placed = contours.map((line) => line.map(([mu, slope]) => [x(mu), y(slope)]));
    const longest = placed.toSorted((a, b) => b.length - a.length)[0] ?? [];
    const place = fromMiddle(longest).find((point) => isFree(labelBox(point, widthOf(text)), taken, inside));
    if (place) taken.push(labelBox(place, widthOf(text)));
    return [
      placed.map((line) => svg("polyline", { class: `isoline${isMajor ? " is-major" : ""}`, points: points(line) })),
      place ? svg("text", { class: "label middle-of on-line", x: place[0], y: place[1] + 4 }, text) : null,
    ];
  });
}

// The points of a line, those in its middle first.
function fromMiddle(line) {
  const middle = (line.length - 1) / 2;
  const order = [...line.keys()].toSorted((i, j) => Math.abs(i - middle) - Math.abs(j - middle));
  return order.map((k) => line[k]);
}

function labelBox([x, y], wide) {
  return { x: x - wide / 2, y: y - LABEL / 2, wide, tall: LABEL };
}

// Whether a box is inside another and away from all others.
function isFree({ x, y, wide, tall }, taken, inside) {
  const isInside = x >= inside.x && y >= inside.y && x + wide <= inside.x + inside.wide && y + tall <= inside.y + inside.tall;
  const touches = (other) => x < other.x + other.wide + AIR && other.x < x + wide + AIR && y < other.y + other.tall + AIR && other.y < y + tall + AIR;
  return isInside && !taken.some(touches);
}

// Of a label, about.
function widthOf(text) {
  return text.length * LABEL * 0.5 + 3;
}

function arrayDot({ at: [a, b], name, is_shown: isShown }) {
  return svg(
    "g",
    { class: "array-dot" },
    svg("circle", { cx: a, cy: b, r: isShown ? 6 : 4.5 }),
    svg("text", { class: `on-line ${isShown ? "strong" : "label"}`, x: a + 9, y: b - 7 }, name),
  );
}
