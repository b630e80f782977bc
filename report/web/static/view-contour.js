// A surface on a grid, between whose points the logarithm is linear: its value anywhere, its contours.

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

/** Return axes and values with each cell divided into equal parts, as `[xs, ys, values]`. */
export function refined(xs, ys, values, least, parts) {
  const divide = (axis) => axis.flatMap((from, k) => (k + 1 < axis.length ? Array.from({ length: parts }, (_, j) => from + ((axis[k + 1] - from) * j) / parts) : [from]));
  const [across, up] = [divide(xs), divide(ys)];
  return [across, up, up.map((y) => across.map((x) => surfaceAt(xs, ys, values, x, y, least).value))];
}

/** Return the contour of a level as lines of points, by marching squares on the logarithm. */
export function isolines(xs, ys, values, level, least) {
  const height = (row, column) => {
    const value = values[row][column];
    return value === null ? null : Math.log10(Math.max(value, least)) - Math.log10(level);
  };
  const pieces = [];
  for (let row = 0; row + 1 < ys.length; row += 1) {
    for (let column = 0; column + 1 < xs.length; column += 1) {
      const corners = [
        [xs[column], ys[row], height(row, column)],
        [xs[column + 1], ys[row], height(row, column + 1)],
        [xs[column + 1], ys[row + 1], height(row + 1, column + 1)],
        [xs[column], ys[row + 1], height(row + 1, column)],
      ];
      if (corners.every(([, , h]) => h !== null)) pieces.push(...crossing(corners, row, column));
    }
  }
  return joined(pieces);
}

function cell(axis, value) {
  let k = 0;
  while (k + 2 < axis.length && axis[k + 1] <= value) k += 1;
  return [k, (value - axis[k]) / (axis[k + 1] - axis[k])];
}

// The pieces of a contour in one cell, each as two points with the names of the sides that they are on.
function crossing(corners, row, column) {
  const sides = [`h${row} ${column}`, `v${row} ${column + 1}`, `h${row + 1} ${column}`, `v${row} ${column}`];
  const cut = [];
  corners.forEach(([x0, y0, h0], k) => {
    const [x1, y1, h1] = corners[(k + 1) % 4];
    if (h0 >= 0 === h1 >= 0) return;
    const share = h0 / (h0 - h1);
    cut.push({ side: sides[k], point: [x0 + share * (x1 - x0), y0 + share * (y1 - y0)] });
  });
  if (cut.length < 4) return cut.length === 2 ? [cut] : [];
  // A saddle: its middle says which corners belong together.
  const middle = corners.reduce((total, [, , h]) => total + h, 0) / 4;
  const isTogether = middle >= 0 === corners[0][2] >= 0;
  return isTogether ? [[cut[0], cut[1]], [cut[2], cut[3]]] : [[cut[3], cut[0]], [cut[1], cut[2]]];
}

// Pieces joined where they share the side of a cell.
function joined(pieces) {
  const left = new Set(pieces);
  const lines = [];
  const grow = (line) => {
    for (;;) {
      const end = line.at(-1).side;
      const next = [...left].find((piece) => piece.some(({ side }) => side === end));
      if (!next) return;
      left.delete(next);
      line.push(next[0].side === end ? next[1] : next[0]);
    }
  };
  for (const piece of pieces) {
    if (!left.delete(piece)) continue;
    const line = [...piece];
    grow(line);
    line.reverse();
    grow(line);
    lines.push(line.map(({ point }) => point));
  }
  return lines;
}
