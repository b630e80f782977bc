// Parts that the drawings of the views share: sizes, pointers, frames, ticks, crosses, arrows, scale
// bars, and the scales and round ticks of axes, to the right and upward.

import { set, svg } from "./make.js";
import { tickText } from "./reading.js";

const BAR = 4; // half the height of the ends of a scale bar

/** Give a drawing a width and height in pixels. */
export function setSize(drawing, width, height) {
  set(drawing, { width, height, viewBox: `0 0 ${width} ${height}` });
}

/** Return where a pointer is in an element, in pixels. */
export function pointerIn(element, { clientX, clientY }) {
  const { left, top } = element.getBoundingClientRect();
  return [clientX - left, clientY - top];
}

/** Have a drawing read where the pointer is in it. */
export function onPointer(drawing, read) {
  drawing.addEventListener("pointermove", (event) => read(pointerIn(drawing, event)));
}

/** Return the left side and the foot of what two scales span. */
export function frame({ ends: [left, right] }, { ends: [foot, top] }) {
  return svg("path", { class: "frame", d: `M${left} ${top}V${foot}H${right}` });
}

/** Return lines at the ticks of an axis to the right, from one height to another. */
export function linesAcross({ values }, x, [from, to]) {
  return values.map((value) => svg("line", { x1: x(value), x2: x(value), y1: from, y2: to }));
}

/** Return lines at the ticks of an axis upward, from one place to another; that at zero has its look. */
export function linesUp({ values }, [from, to], y) {
  return values.map((value) => svg("line", { class: value === 0 ? "zero" : null, x1: from, x2: to, y1: y(value), y2: y(value) }));
}

/** Return the texts of ticks along an axis to the right, centered below their places. */
export function textsAcross({ values, step }, x, y) {
  return values.map((value) => svg("text", { class: "tick middle-of", x: x(value), y }, tickText(value, step)));
}

/** Return the texts of ticks along an axis upward, which end at a place. */
export function textsUp({ values, step }, x, y) {
  return values.map((value) => svg("text", { class: "tick end-at", x, y: y(value) + 4 }, tickText(value, step)));
}

/** Return the path of a cross, by half its width. */
export function cross([x, y], half) {
  return `M${x - half} ${y}h${2 * half}M${x} ${y - half}v${2 * half}`;
}

/** Return an arrow in a direction, by its middle and half its length. */
export function arrow([x, y], [dx, dy], half) {
  const [tip, tail] = [half, -half].map((along) => `${x + along * dx} ${y + along * dy}`);
  const wing = (side) => `${x + (half - 8) * dx - 4 * side * dy} ${y + (half - 8) * dy + 4 * side * dx}`;
  return svg("path", { class: "arrow", d: `M${tail}L${tip}M${wing(1)}L${tip}L${wing(-1)}` });
}

/** Return a bar of a round length in a unit, at most so many pixels wide, with its text. */
export function scaleBar([x, y], unit, pixelsPerMeter, most) {
  const length = roundBelow(most / pixelsPerMeter / unit.si);
  const wide = length * unit.si * pixelsPerMeter;
  return [
    svg("path", { class: "bar-line", d: `M${x} ${y - BAR}v${2 * BAR}M${x} ${y}h${wide}m0 ${-BAR}v${2 * BAR}` }),
    svg("text", { class: "label on-line", x: x + wide + 6, y: y + 4 }, `${length} ${unit.symbol}`),
  ];
}

/** Return the largest of 1, 2, 5 times a power of ten that is not above a positive value. */
export function roundBelow(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [5, 2, 1].find((digit) => digit * power <= value * (1 + 1e-9)) * power;
}

/** Return a linear scale from a range of values to one of pixels, with its inverse and its `ends` in pixels. */
export function scale([low, high], [from, to]) {
  const factor = (to - from) / (high - low);
  const at = (value) => from + (value - low) * factor;
  at.inverse = (pixel) => low + (pixel - from) / factor;
  at.ends = [from, to];
  return at;
}

/** Return round values within a range, at most about as many as wanted, and their step. */
export function ticks(low, high, wanted) {
  const least = (0.7 * (high - low)) / wanted;
  const power = 10 ** Math.floor(Math.log10(least));
  const step = [1, 2, 5, 10].map((digit) => digit * power).find((one) => one >= least * (1 - 1e-9));
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  const values = Array.from({ length: last - first + 1 }, (_, k) => (first + k) * step);
  return { values, step };
}

/** Return the box around points, as `{x, y, wide, tall}`. */
export function boxAround(points) {
  const [xs, ys] = [points.map(([x]) => x), points.map(([, y]) => y)];
  const [x, y] = [Math.min(...xs), Math.min(...ys)];
  return { x, y, wide: Math.max(...xs) - x, tall: Math.max(...ys) - y };
}

/** Return a value held between two limits. */
export function within(value, low, high) {
  return Math.min(Math.max(value, low), high);
}
