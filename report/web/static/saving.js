// Saves a drawing of the page as SVG or PNG, as it looks: with its words, in the colors of the page.

import { html, set, svg } from "./make.js";

const LOOK = ["fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray", "stroke-linejoin", "overflow", "paint-order", "opacity", "font-size", "font-weight", "font-style", "text-anchor", "marker-end", "visibility"];
const STRETCHED = "[preserveAspectRatio=none]";
const PAIR = /(-?[\d.]+)[ ,](-?[\d.]+)/g; // of the coordinates of a point
const SHARPER = 2; // pixels of a PNG in one of the page
const BUSY = '[aria-busy="true"]';
const NOT_DRAWN = "button, select, input, label, .toolbar, .player, .plan-head, .visually-hidden, [id$=-keys]";

/** Save what a panel shows, as the kind says: `svg` or `png`; where it is still calculated, then. */
export async function saveDrawing(panel, kind, name) {
  while (panel.matches(BUSY) || panel.querySelector(BUSY)) await new Promise(requestAnimationFrame);
  if (panel.hidden) return; // another one was opened meanwhile: a hidden panel has no size
  const drawn = drawing(panel);
  const text = new XMLSerializer().serializeToString(drawn);
  const vector = new Blob([text], { type: "image/svg+xml" });
  save(kind === "svg" ? vector : await painted(vector, drawn), `${name}, ${panel.id}.${kind}`);
}

// Every drawing in the panel where it stands, and every word between them.
function drawing(panel) {
  const { x, y, width, height } = panel.getBoundingClientRect();
  const all = svg("svg", { xmlns: "http://www.w3.org/2000/svg", width, height, "font-family": "Source Sans 3, sans-serif" });
  all.append(svg("rect", { width, height, fill: getComputedStyle(document.documentElement).backgroundColor }));
  for (const one of panel.querySelectorAll("svg:not(svg svg)")) {
    const box = one.getBoundingClientRect();
    const copy = one.cloneNode(true);
    const [from, to] = [one, copy].map((each) => [each, ...each.querySelectorAll("*")]);
    from.forEach((each, k) => look(each, to[k]));
    to.filter((_, k) => from[k].matches(".clip *") && isBeside(from[k].getBoundingClientRect(), box)).forEach((each) => each.remove());
    set(copy, { x: box.x - x, y: box.y - y, width: box.width, height: box.height });
    all.append(copy);
  }
  const words = document.createTreeWalker(panel, NodeFilter.SHOW_TEXT);
  while (words.nextNode()) {
    const { currentNode: node } = words;
    const { parentElement: element } = node;
    if (!node.data.trim() || element.closest(`svg, ${NOT_DRAWN}`) || !element.checkVisibility()) continue;
    const { color, fontSize, fontWeight } = getComputedStyle(element);
    for (const { index, 0: word } of node.data.matchAll(/\S+/g)) {
      const range = document.createRange();
      range.setStart(node, index);
      range.setEnd(node, index + word.length);
      const box = range.getBoundingClientRect();
      all.append(svg("text", { x: box.x - x, y: box.bottom - y - 4, fill: color, "font-size": fontSize, "font-weight": fontWeight, ...fitted(box.width) }, word));
    }
  }
  return all;
}

// As wide as on the page, whatever fonts a reader has.
function fitted(width) {
  return { textLength: width, lengthAdjust: "spacingAndGlyphs" };
}

// Not all readers know lines that keep their width: what the page stretches is placed in pixels.
function look(from, to) {
  const style = getComputedStyle(from);
  if (from instanceof SVGTextElement) set(to, fitted(from.getComputedTextLength()));
  set(to, Object.fromEntries(LOOK.map((name) => [name, style.getPropertyValue(name)]).filter(([, value]) => value)));
  if (style.vectorEffect === "none") return;
  const { a: across, d: up } = from.getScreenCTM();
  const isStretched = from.parentElement.matches(STRETCHED);
  to.setAttribute("stroke-width", parseFloat(style.strokeWidth) / (isStretched ? 1 : across));
  for (const name of isStretched ? ["d", "points"].filter((one) => to.hasAttribute(one)) : []) {
    to.setAttribute(name, to.getAttribute(name).replaceAll(PAIR, (_, x, y) => `${(x * across).toFixed(2)} ${(y * up).toFixed(2)}`));
  }
  if (from.matches(STRETCHED)) to.removeAttribute("viewBox");
}

// Whether a box has no part in another one.
function isBeside({ left, right, width }, { left: from, right: to }) {
  return width > 0 && (right < from || left > to);
}

async function painted(vector, drawn) {
  const image = new Image();
  image.src = URL.createObjectURL(vector);
  await image.decode();
  const [wide, tall] = ["width", "height"].map((name) => SHARPER * Number(drawn.getAttribute(name)));
  const canvas = new OffscreenCanvas(wide, tall);
  canvas.getContext("2d").drawImage(image, 0, 0, wide, tall);
  URL.revokeObjectURL(image.src);
  return canvas.convertToBlob();
}

/** Save bytes as a file. */
export function save(blob, name) {
  const url = URL.createObjectURL(blob);
  html("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}
