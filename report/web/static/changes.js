// What values change, in words and in the address, where `#friction=0.95&slope@A1=1` restores them.
// The value of a control is of all arrays, or with the name of one behind an @ of that alone.

import { number } from "./reading.js";

/** Return the values of the workbook. */
export function typedOf({ sliders, choices }) {
  return Object.fromEntries([...sliders, ...choices].map(({ id, typed }) => [id, typed]));
}

/** Whether a control acts: some do beside a choice alone. */
export function acts({ with_choice: needed = {} }, values) {
  return Object.entries(needed).every(([id, value]) => values[id] === value);
}

/** Return the value of a slider for a target, or for all. */
export function valueFor({ id, typed, real }, values, target) {
  if (!(target in real.targets)) return values[id];
  return values[`${id}@${target}`] ?? (real.is_beside ? typed : values[id]);
}

/** Return the values that a slider enters for a target, or for all, which leave none its own. */
export function entered({ id, real }, target, value) {
  if (target in real.targets) return { [`${id}@${target}`]: value };
  return { ...Object.fromEntries(Object.keys(real.targets).map((one) => [`${id}@${one}`, null])), [id]: value };
}

/** Return the value of a slider, such as `× 0.83`, `+0.7°` or `−3 in`; one between two steps in full. */
export function own({ unit, step }, value) {
  const decimals = step % 1 === 0 ? 0 : String(step).split(".")[1].length;
  const rounded = Number(value.toFixed(decimals));
  const isOnStep = rounded === value;
  const text = isOnStep ? number(value, decimals) : String(Number(value.toFixed(4))).replace("-", "−");
  if (unit === "×") return `× ${text}`;
  return `${value > 0 ? "+" : ""}${text}${unit === "°" ? "" : " "}${unit}`;
}

/** Return the quantity that a value of a slider amounts to, of a base in the workbook. */
export function amountOf({ unit }, base, value) {
  return unit === "×" ? base * value : base + value;
}

/** Return the value of a slider that makes a quantity of a base, to the digits that cells keep. */
export function valueOf({ unit }, base, amount) {
  return Number((unit === "×" ? amount / base : amount - base).toFixed(6));
}

/** Return a value of a slider as an engineer says it: `μ 0.46` where all arrays have one, else `friction × 0.92`. */
export function said(item, value, values) {
  const { symbol, all, digits, unit } = item.real;
  if (all === null || !acts(item.real, values)) return `${item.label.toLowerCase()} ${own(item, value)}`;
  return `${symbol} ${number(amountOf(item, all, value), digits)}${unit === "°" ? unit : ` ${unit}`}`.trimEnd();
}

/** Return which values are not those of the workbook, such as `Friction × 0.90, Slope of A1 +1.0°`. */
export function changes(values, { sliders, choices }) {
  const moved = sliders.flatMap((item) =>
    Object.entries(values)
      .filter(([id, value]) => (id === item.id || id.startsWith(`${item.id}@`)) && value !== item.typed)
      .map(([id, value]) => `${[item.label, ...id.split("@").slice(1)].join(" of ")} ${own(item, value)}`),
  );
  const chosen = choices.filter(({ id, typed }) => id in values && values[id] !== typed).map((item) => `${item.label}: ${labelOf(item, values[item.id])}`);
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

/** Return the address of a project at values; those of the workbook are not in it. */
export function toAddress(project, values) {
  const typed = typedOf(project);
  const changed = Object.entries(values).filter(([id, value]) => value !== typed[id]);
  const fragment = new URLSearchParams(changed.map(([id, value]) => [id, String(value)])).toString().replaceAll("%40", "@");
  return `/p/${project.id}/${fragment && `#${fragment}`}`;
}

/** Return the values in the fragment of an address; what is no control, no number or no option is left out. */
export function fromFragment(fragment, { sliders, choices }) {
  const given = new URLSearchParams(fragment.replace(/^#/, ""));
  const values = {};
  for (const [id, text] of given) {
    const [control, target] = id.split("@");
    const item = sliders.find((one) => one.id === control && (target === undefined || target in one.real.targets));
    if (item && text.trim() && Number.isFinite(Number(text))) values[id] = Number(text);
  }
  for (const { id, options } of choices) {
    const option = options.find(({ value }) => value === given.get(id));
    if (option) values[id] = option.value;
  }
  return values;
}
