// Scales and round ticks of the views' axes.

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
