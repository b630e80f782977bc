// Histories as the server sends them: values at the samples, or at the numbers of samples beside them,
// null where there is none.

import { within } from "./view-axes.js";

const LOOKS = { cross: "is-across", vertical: "is-third", demand: "is-third" };

/** Return the panel of a kind, such as `velocity`: a title and units, and histories with times and look. */
export function panelOf(data, kind, title = "title") {
  const series = data[kind].series.map(({ name, i, v }) => ({
    name,
    look: LOOKS[name] ?? "is-first",
    t: Float64Array.from(i ?? v.keys(), (k) => k * data.dt_s),
    v,
  }));
  return { title: data[kind][title], units: data[kind].units, series };
}

/** Return the number of the last of ascending values that is not above one; -1 if all are. */
export function lastUpTo(ascending, value) {
  let low = 0;
  let high = ascending.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (ascending[middle] <= value) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** Return the value at a time, linear between the samples drawn; null where there is none. */
export function valueAt({ t, v }, time) {
  const k = within(lastUpTo(t, time), 0, t.length - 1);
  if (k === t.length - 1 || time <= t[k]) return v[k];
  if (v[k] === null || v[k + 1] === null) return null;
  return v[k] + ((v[k + 1] - v[k]) * (time - t[k])) / (t[k + 1] - t[k]);
}

/** Return the smallest and largest value in a span of time, as `[low, high]`; null if there is none. */
export function rangeIn({ t, v }, [from, to]) {
  let low = Infinity;
  let high = -Infinity;
  const end = Math.min(lastUpTo(t, to) + 1, t.length - 1);
  for (let k = Math.max(lastUpTo(t, from), 0); k <= end; k += 1) {
    if (v[k] === null) continue;
    low = Math.min(low, v[k]);
    high = Math.max(high, v[k]);
  }
  return low <= high ? [low, high] : null;
}

/** Return the path of a history in a span of time: at most four points in each column of pixels. */
export function curve({ t, v }, span, x, y) {
  let drawn = "";
  let pen = "M";
  let column = null;
  const draw = (k) => {
    drawn += `${pen}${x(t[k]).toFixed(2)} ${y(v[k]).toFixed(2)}`;
    pen = "L";
  };
  const flush = () => {
    if (column) [...new Set(column)].toSorted((a, b) => a - b).forEach(draw);
    column = null;
  };
  const end = Math.min(lastUpTo(t, span[1]) + 1, t.length - 1);
  let pixel = NaN;
  for (let k = Math.max(lastUpTo(t, span[0]), 0); k <= end; k += 1) {
    if (v[k] === null) {
      flush();
      pen = "M";
      continue;
    }
    const here = Math.floor(x(t[k]));
    if (here !== pixel || !column) {
      flush();
      pixel = here;
      column = [k, k, k, k]; // first, lowest, highest, last
    }
    if (v[k] < v[column[1]]) column[1] = k;
    if (v[k] > v[column[2]]) column[2] = k;
    column[3] = k;
  }
  flush();
  return drawn;
}
