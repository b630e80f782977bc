// Hodographs: the path of an array in plan under every motion, all at one scale.

import { html, note, points, replace, set, svg } from "./make.js";
import { measured, reading, seconds } from "./reading.js";
import { onKeys } from "./view-frame.js";
import { arrow, boxAround, cross, onPointer, scaleBar, setSize, within } from "./view-parts.js";

const LEAST_WIDE = 128; // of a panel
const ROOM = 10; // around the paths
const TALL = 330; // of all rows of panels, about
const BAR = 90; // pixels of the scale bar, at most
const LEAST_M = 1e-3; // extent that fills a panel, at least
const STEPS = 200; // of the reading by arrow keys, along a path

/** Draw the paths in an element. */
export function build(element, data) {
  const extent = boxAround([[0, 0], ...data.paths.flatMap(({ x_m: x, y_m: y }) => x.map((value, k) => [value, y[k]]))]);
  const where = html("output", { class: "numbers", role: "status" }, "Point at a path, or Tab to it and use the arrow keys, to read it.");
  const panels = data.paths.map((path) => createPanel(path, data, (text) => {
    where.textContent = text;
  }));
  const bar = svg("svg", { class: "scale", "aria-hidden": true });
  const grid = html("div", { class: "paths" }, panels.map((panel) => panel.element));

  function resize(wide) {
    const { columns, scale } = arrange(extent, panels.length, wide);
    grid.style.setProperty("--columns", columns);
    for (const panel of panels) panel.draw(extent, scale, wide / columns);
    drawFoot(bar, scale, data.units);
  }

  replace(
    element,
    html("h3", { class: "view-title" }, data.texts.title),
    grid,
    html("div", { class: "paths-foot" }, bar, where),
    note(data.texts.notes.join(" ")),
  );
  return { resize };
}

// The number of columns at which the common scale, in pixels per meter, is largest.
function arrange(extent, count, wide) {
  let best = null;
  for (let columns = 1; columns <= Math.max(1, Math.min(count, Math.floor(wide / LEAST_WIDE))); columns += 1) {
    const rows = Math.ceil(count / columns);
    const tall = Math.max(TALL / rows, 90);
    const scale = Math.min((wide / columns - 2 * ROOM - 8) / Math.max(extent.wide, LEAST_M), (tall - 2 * ROOM) / Math.max(extent.tall, LEAST_M));
    if (!best || scale > best.scale * 1.001) best = { columns, scale };
  }
  return best;
}

function createPanel(path, { units }, write) {
  const [first] = units;
  const dot = svg("circle", { class: "reading-dot", r: 4, visibility: "hidden" });
  const drawing = svg("svg", { tabindex: path.x_m.length ? 0 : null, role: path.x_m.length ? "application" : "img", "aria-label": path.title });
  let pixels = [];
  let at = 0;

  function read(k) {
    at = k;
    set(dot, { cx: pixels[k][0], cy: pixels[k][1], visibility: "visible" });
    // Downslope is down the page, and cross-slope to the right of it.
    const [across, down] = [path.x_m[k], -path.y_m[k]];
    const far = reading(Math.hypot(across, down), units);
    write(`${path.name} at ${seconds(k * path.dt_s)}: ${far} from the start, downslope ${measured(down, first)}, cross-slope ${measured(across, first)}`);
  }

  if (path.x_m.length) {
    onPointer(drawing, (place) => read(nearest(pixels, place)));
    drawing.addEventListener("focus", () => read(at));
    const go = (to) => read(within(to, 0, pixels.length - 1));
    const step = (way) => ({ shiftKey }) => go(at + way * Math.ceil(pixels.length / STEPS) * (shiftKey ? 10 : 1));
    onKeys(drawing, {
      ArrowLeft: step(-1),
      ArrowRight: step(1),
      Home: () => go(0),
      End: () => go(pixels.length - 1),
    });
    for (const left of ["pointerleave", "blur"]) drawing.addEventListener(left, () => set(dot, { visibility: "hidden" }));
  }

  return {
    element: html("figure", { class: "path-panel" }, html("figcaption", {}, html("strong", {}, path.name), html("span", { class: "numbers" }, path.prd)), drawing),
    draw(extent, scale, wide) {
      const left = (wide - 8 - extent.wide * scale) / 2;
      const to = (x, y) => [left + (x - extent.x) * scale, ROOM + (extent.y + extent.tall - y) * scale];
      setSize(drawing, wide - 8, Math.max(extent.tall, LEAST_M) * scale + 2 * ROOM);
      pixels = path.x_m.map((value, k) => to(value, path.y_m[k]));
      at = path.peak ?? 0;
      replace(
        drawing,
        pixels.length ? svg("polyline", { class: "curve is-first", points: points(pixels) }) : null,
        svg("path", { class: "start", d: cross(to(0, 0), 6) }),
        pixels.length ? svg("circle", { class: "peak", r: 3.5, cx: pixels[at][0], cy: pixels[at][1] }) : null,
        dot,
      );
      set(dot, { visibility: "hidden" });
    },
  };
}

function nearest(pixels, [x, y]) {
  let best = 0;
  let least = Infinity;
  pixels.forEach(([a, b], k) => {
    const far = (a - x) ** 2 + (b - y) ** 2;
    if (far < least) [best, least] = [k, far];
  });
  return best;
}

function drawFoot(foot, scale, [unit]) {
  setSize(foot, 250, 34);
  replace(foot, arrow([8, 16], [0, 1], 12), svg("text", { class: "label", x: 18, y: 21 }, "downslope"), scaleBar([100, 18.5], unit, scale, BAR));
}
