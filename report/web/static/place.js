// Boxes on a drawing, and whether one covers another. They are `{x, y, wide, tall}` in pixels.

const AIR_PX = 3;

/** Whether a box is inside the frame and away from all others. */
export function isFree(box, taken, frame) {
  return isInside(box, frame) && !taken.some((other) => touches(box, other));
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
