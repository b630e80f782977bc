// Parts that the drawings of the views share: axes with round ticks, and shapes. Drawings are placed in percent
// of their area, so that the browser fits them to any width; words and the lines of an axis keep their size.

import { svg } from "./make.js";
import { tickText } from "./reading.js";

/** Return where a value is in a range, in percent. */
export function percent(value, [low, high]) {
  return (100 * (value - low)) / (high - low);
}

/** Return the axis of a range along the foot of an area. */
export function axisAcross(range, wanted) {
  const { values, step } = ticks(...range, wanted);
  const tick = (value) => {
    const x = `${percent(value, range)}%`;
    return [svg("line", { x1: x, x2: x, y2: 4 }), svg("text", { class: "tick middle-of", x, y: 17 }, tickText(value, step))];
  };
  return svg("svg", { class: "axis", y: "100%" }, svg("line", { x2: "100%" }), values.map(tick));
}

/** Return the axis of a range along the left of an area; as a grid, with lines across and no number at its ends. */
export function axisUp(range, wanted, isGrid = false) {
  const { values, step } = ticks(...range, wanted);
  const tick = (value) => {
    const [at, y] = [percent(value, range), `${100 - percent(value, range)}%`];
    const line = isGrid ? { class: value === 0 ? "zero" : "hair", x2: "100%" } : { x1: -4 };
    const text = svg("text", { class: "tick end-at", x: -7, y, dy: 4 }, tickText(value, step));
    return [svg("line", { ...line, y1: y, y2: y }), (!isGrid || within(at, 3.5, 92) === at) && text];
  };
  return svg("g", { class: "axis" }, values.map(tick), svg("line", { y2: "100%" }));
}

/** Return the largest of 1, 2, 5 times a power of ten that is not above a positive value. */
export function roundBelow(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [5, 2, 1].find((digit) => digit * power <= value * (1 + 1e-9)) * power;
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

/** Return a value held between two limits. */
export function within(value, low, high) {
  return Math.min(Math.max(value, low), high);
}

/** Have an element, not what is in it, answer keys: `keys` are functions of the event by key. */
export function onKeys(element, keys) {
  element.addEventListener("keydown", (event) => {
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (event.target !== element || !(key in keys) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    keys[key](event);
  });
}
