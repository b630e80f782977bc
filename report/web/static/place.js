// Places labels on a drawing so that they cover nothing. Boxes are `{x, y, wide, tall}` in pixels.

const ANGLES = 24;
const STEP_PX = 4;
const PIECE_PX = 8;
const REACH_PX = 110;
const AIR_PX = 3;

/** Return the free box of a size that is nearest to a point, inside the frame; null if none is free. */
export function place(wide, tall, [x, y], taken, frame) {
  for (let reach = STEP_PX; reach <= REACH_PX; reach += STEP_PX) {
    for (let k = 0; k < ANGLES; k += 1) {
      const turn = (2 * Math.PI * k) / ANGLES;
      // On an ellipse, so that wide labels go as near above a point as beside it.
      const middle = [x + (reach + wide / 2) * Math.cos(turn), y + (reach + tall / 2) * Math.sin(turn)];
      const box = { x: middle[0] - wide / 2, y: middle[1] - tall / 2, wide, tall };
      if (isFree(box, taken, frame)) return box;
    }
  }
  return null;
}

/** Whether a box is inside the frame and away from all others. */
export function isFree(box, taken, frame) {
  return isInside(box, frame) && !taken.some((other) => touches(box, other));
}

/** Return thin boxes along a line, to keep labels off it: one, or small ones where it is oblique. */
export function along([x0, y0], [x1, y1]) {
  const [wide, tall] = [Math.abs(x1 - x0), Math.abs(y1 - y0)];
  if (Math.min(wide, tall) < 1) return [{ x: Math.min(x0, x1) - 1, y: Math.min(y0, y1) - 1, wide: wide + 2, tall: tall + 2 }];
  const count = Math.ceil(Math.hypot(wide, tall) / PIECE_PX);
  return Array.from({ length: count + 1 }, (_, k) => {
    const share = k / count;
    return { x: x0 + (x1 - x0) * share - 1, y: y0 + (y1 - y0) * share - 1, wide: 2, tall: 2 };
  });
}

/** Return the box around points. */
export function boxAround(points) {
  const [xs, ys] = [points.map(([x]) => x), points.map(([, y]) => y)];
  const [x, y] = [Math.min(...xs), Math.min(...ys)];
  return { x, y, wide: Math.max(...xs) - x, tall: Math.max(...ys) - y };
}

function isInside(box, frame) {
  return (
    box.x >= frame.x && box.y >= frame.y && box.x + box.wide <= frame.x + frame.wide && box.y + box.tall <= frame.y + frame.tall
  );
}

function touches(a, b) {
  return (
    a.x < b.x + b.wide + AIR_PX && b.x < a.x + a.wide + AIR_PX && a.y < b.y + b.tall + AIR_PX && b.y < a.y + a.tall + AIR_PX
  );
}
