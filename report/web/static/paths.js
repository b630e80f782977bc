// Hodographs: the path of an array in plan under every motion, all at one scale.

import { html, replace, svg } from "./make.js";
import { measured, number, reading } from "./reading.js";
import { roundBelow } from "./view-axes.js";
import { createView, set } from "./view-frame.js";

const LEAST_WIDE = 128; // of a panel
const ROOM = 10; // around the paths
const TALL = 330; // of all rows of panels, about
const BAR = 90; // pixels of the scale bar, at most
const LEAST_M = 1e-3; // extent that fills a panel, at least

/** Keep the paths in an element. */
export function mount(element, api, scene) {
  return createView(element, scene, {
    ask: ({ array, values }) => ({ array, values }),
    fetch: api.paths,
    build,
  });
}

function build(element, data) {
  const units = data.units.displacement;
  const extent = extentOf(data.paths);
  const where = html("output", { class: "numbers", role: "status" }, "Point at a path, or Tab to it and use the arrow keys, to read it.");
  const panels = data.paths.map((path) => createPanel(path, units, (text) => {
    where.textContent = text;
  }));
  const bar = svg("svg", { class: "scale", "aria-hidden": true });
  const grid = html("div", { class: "paths" }, panels.map((panel) => panel.element));

  function resize() {
    const wide = element.clientWidth;
    if (wide === 0) return;
    const { columns, scale } = arrange(extent, panels.length, wide);
    grid.style.setProperty("--columns", columns);
    for (const panel of panels) panel.draw(extent, scale, wide / columns);
    drawBar(bar, scale, units[0]);
  }

  replace(
    element,
    html("h3", { class: "view-title" }, data.texts.title),
    grid,
    html("div", { class: "paths-foot" }, bar, where),
    html("p", { class: "note" }, data.texts.caption),
  );
  resize();
  return { resize, stop() {} };
}

function extentOf(paths) {
  const start = { x0: 0, x1: 0, y0: 0, y1: 0 };
  return paths.reduce(({ x0, x1, y0, y1 }, { x_m: x, y_m: y }) => ({ x0: Math.min(x0, ...x), x1: Math.max(x1, ...x), y0: Math.min(y0, ...y), y1: Math.max(y1, ...y) }), start);
}

// The number of columns at which the common scale, in pixels per meter, is largest.
function arrange({ x0, x1, y0, y1 }, count, wide) {
  let best = null;
  for (let columns = 1; columns <= Math.max(1, Math.min(count, Math.floor(wide / LEAST_WIDE))); columns += 1) {
    const rows = Math.ceil(count / columns);
    const tall = Math.max(TALL / rows, 90);
    const scale = Math.min((wide / columns - 2 * ROOM - 8) / Math.max(x1 - x0, LEAST_M), (tall - 2 * ROOM) / Math.max(y1 - y0, LEAST_M));
    if (!best || scale > best.scale * 1.001) best = { columns, scale };
  }
  return best;
}

function createPanel(path, units, write) {
  const name = `${path.motion} ${path.run}`;
  const dot = svg("circle", { class: "reading-dot", r: 4, visibility: "hidden" });
  const drawing = svg("svg", { tabindex: path.i.length ? 0 : null, role: path.i.length ? "application" : "img", "aria-label": `Path under ${name}, ${path.prd}` });
  let pixels = [];
  let at = 0;

  function read(k) {
    at = k;
    set(dot, { cx: pixels[k][0], cy: pixels[k][1], visibility: "visible" });
    // Downslope is down the page, and cross-slope to the right of it.
    const [across, down] = [path.x_m[k], -path.y_m[k]];
    const far = reading(Math.hypot(across, down), units);
    write(`${name} at ${number(path.i[k] * path.dt_s, 2)} s: ${far} from the start, downslope ${measured(down, units[0])}, cross-slope ${measured(across, units[0])}`);
  }

  if (path.i.length) {
    drawing.addEventListener("pointermove", (event) => {
      const box = drawing.getBoundingClientRect();
      read(nearest(pixels, event.clientX - box.left, event.clientY - box.top));
    });
    drawing.addEventListener("focus", () => read(at));
    drawing.addEventListener("keydown", (event) => {
      const step = event.shiftKey ? 10 : 1;
      const to = { ArrowLeft: at - step, ArrowRight: at + step, Home: 0, End: pixels.length - 1 }[event.key];
      if (to === undefined) return;
      event.preventDefault();
      read(Math.min(Math.max(to, 0), pixels.length - 1));
    });
    for (const left of ["pointerleave", "blur"]) drawing.addEventListener(left, () => set(dot, { visibility: "hidden" }));
  }

  return {
    element: html("figure", { class: "path-panel" }, html("figcaption", {}, html("strong", {}, name), html("span", { class: "numbers" }, path.prd)), drawing),
    draw({ x0, x1, y0, y1 }, scale, wide) {
      const tall = Math.max(y1 - y0, LEAST_M) * scale + 2 * ROOM;
      const left = (wide - 8 - (x1 - x0) * scale) / 2;
      const x = (value) => left + (value - x0) * scale;
      const y = (value) => ROOM + (y1 - value) * scale;
      set(drawing, { width: wide - 8, height: tall, viewBox: `0 0 ${wide - 8} ${tall}` });
      pixels = path.x_m.map((value, k) => [x(value), y(path.y_m[k])]);
      at = path.peak ? nearest(pixels, x(path.peak.x_m), y(path.peak.y_m)) : 0;
      replace(
        drawing,
        pixels.length ? svg("polyline", { class: "curve is-first", points: pixels.map(([a, b]) => `${a.toFixed(1)},${b.toFixed(1)}`).join(" ") }) : null,
        svg("path", { class: "start", d: `M${x(0) - 6} ${y(0)}h12M${x(0)} ${y(0) - 6}v12` }),
        path.peak ? svg("circle", { class: "peak", r: 3.5, cx: x(path.peak.x_m), cy: y(path.peak.y_m) }) : null,
        dot,
      );
      set(dot, { visibility: "hidden" });
    },
  };
}

function nearest(pixels, x, y) {
  let best = 0;
  let least = Infinity;
  pixels.forEach(([a, b], k) => {
    const far = (a - x) ** 2 + (b - y) ** 2;
    if (far < least) [best, least] = [k, far];
  });
  return best;
}

function drawBar(bar, scale, unit) {
  const length = roundBelow(BAR / scale / unit.si);
  const wide = length * unit.si * scale;
  set(bar, { width: 250, height: 34, viewBox: "0 0 250 34" });
  replace(
    bar,
    svg("path", { class: "arrow", d: "M8 4V26M4 20L8 28L12 20" }),
    svg("text", { class: "label", x: 18, y: 21 }, "downslope"),
    svg("path", { class: "bar-line", d: `M100 21V16M100 18.5H${100 + wide}M${100 + wide} 21V16` }),
    svg("text", { class: "label", x: 106 + wide, y: 23 }, `${length} ${unit.symbol}`),
  );
}
