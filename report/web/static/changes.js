// What values change, in words and in the address, where `#friction=0.95&polarity=both` restores them.

import { number } from "./reading.js";

/** Return the value of a slider, such as `× 0.83`, `+0.7°` or `−3 in`; one between two steps in full. */
export function own({ unit, step }, value) {
  const decimals = step % 1 === 0 ? 0 : String(step).split(".")[1].length;
  const isOnStep = Number(value.toFixed(decimals)) === value;
  const text = isOnStep ? number(value, decimals) : String(value).replace("-", "−");
  if (unit === "×") return `× ${text}`;
  return `${value > 0 ? "+" : ""}${text}${unit === "°" ? "" : " "}${unit}`;
}

/** Return the controls whose values are not those of the workbook. */
export function changed(controls, values) {
  return controls.filter(({ id, typed }) => id in values && values[id] !== typed);
}

/** Return which values are not those of the workbook, such as `Friction × 0.90, Polarity: both`. */
export function changes(values, { sliders, choices }) {
  const moved = changed(sliders, values).map((item) => `${item.label} ${own(item, values[item.id])}`);
  const chosen = changed(choices, values).map((item) => `${item.label}: ${labelOf(item, values[item.id])}`);
  return [...moved, ...chosen].join(", ") || "the values of the workbook";
}

/** Whether two sets of values are the same. */
export function isSame(some, others) {
  const all = new Set([...Object.keys(some), ...Object.keys(others)]);
  return [...all].every((id) => some[id] === others[id]);
}

function labelOf({ options }, value) {
  return options.find((option) => option.value === value)?.label ?? value;
}

/** Return the fragment of the values that differ from those of the workbook. */
export function toFragment(values, controls) {
  return new URLSearchParams(changed(controls, values).map(({ id }) => [id, String(values[id])])).toString();
}

/** Return the values in a fragment; what is no control, no number or no option is left out. */
export function fromFragment(fragment, sliders, choices) {
  const given = new URLSearchParams(fragment.replace(/^#/, ""));
  const values = {};
  for (const { id } of sliders) {
    const text = given.get(id);
    if (text?.trim() && Number.isFinite(Number(text))) values[id] = Number(text);
  }
  for (const { id, options } of choices) {
    const option = options.find(({ value }) => value === given.get(id));
    if (option) values[id] = option.value;
  }
  return values;
}
