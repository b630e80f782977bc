// How a view writes a number under the pointer or on an axis. The server gives the unit, its size in
// SI and its decimals; the rule is that of the package: fixed decimals, a true minus sign, no
// negative zero, an em dash where there is no value, the preferred unit first. Nothing else rounds.

const NONE = "—";

/** Return a number with fixed decimals. */
export function number(value, decimals) {
  if (value === null || !Number.isFinite(value)) return NONE;
  const text = value.toFixed(decimals);
  return Number(text) === 0 ? text.replace("-", "") : text.replace("-", "−");
}

/** Return a value in SI in one unit, such as `3.1 in`. */
export function measured(value, unit) {
  if (value === null) return NONE;
  return `${number(value / unit.si, unit.decimals)} ${unit.symbol}`.trimEnd();
}

/** Return a value in SI in all of its units, such as `3.1 in (79 mm)`. */
export function reading(value, [first, ...others]) {
  if (value === null || others.length === 0) return measured(value, first);
  return `${measured(value, first)} (${others.map((unit) => measured(value, unit)).join(", ")})`;
}

/** Return a round number beside a tick, with the decimals that its step needs. */
export function tickText(value, step) {
  return number(value, Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
}
