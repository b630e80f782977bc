// The arrays, their bars and the clearances, as the server words them, each changed number behind the one of
// the workbook.

import { button, headings, html, svg, update } from "./make.js";
import { tag } from "./headline.js";
import { onChange } from "./session.js";
import { term } from "./terms.js";

const WIDE = 100; // units of the drawing; it stretches with its cell

/** Draw the tables of a session in elements; `pick` gets the key of a row. */
export function mountResults({ arrays, bars, clearances }, session, pick) {
  session.draws(onChange(["answer", "picked", "array"], ({ answer, project, picked, array }) => {
    if (!answer) return;
    const before = project.answer ?? answer;
    const isPicked = (id) => id === array;
    showTable(arrays, answer.arrays, before.arrays, { name: (cell) => arrayName(cell, isPicked, pick), keys: ([{ ids }]) => ids, isPicked });
    const isGap = (key) => key === picked;
    showTable(clearances, answer.clearances, before.clearances, { name: (cell, key) => gapName(cell, key, isGap, pick), keys: ([count]) => (count.text ? [`#${count.text}`] : []), isPicked: isGap, named: 1 });
    showBars(bars, answer.bars, array);
  }));
}

// A table: `named` is the column that names its rows, of which `name` makes the cell, and `keys` are what can
// be picked of a row.
function showTable(element, { caption, heads, rows }, before, { name, keys, isPicked, named = 0 }) {
  // A new body keeps no focus: the button that had it gets it back.
  const focused = element.contains(document.activeElement) ? document.activeElement.dataset.name : null;
  const open = new Set([...element.querySelectorAll("details[open]")].map((one) => one.dataset.first));
  const former = new Map(before.rows.flatMap((row) => keys(row).map((key) => [key, row])));
  const row = (cells) => {
    const all = keys(cells);
    const was = former.get(all[0]);
    const made = cells.map((cell, k) => (k === named ? name(cell, all[0]) : value(cell, was?.[k])));
    return html("tr", { class: all.some(isPicked) ? "is-picked" : null }, made);
  };
  update(element, html("caption", {}, caption), headings(heads.map((head) => term(head))), html("tbody", {}, rows.map(row)));
  for (const one of element.querySelectorAll("details")) one.open = open.has(one.dataset.first);
  if (focused) element.querySelector(`[data-name="${CSS.escape(focused)}"]`)?.focus();
}

// Alike arrays are one row, which opens.
function arrayName({ text, ids }, isPicked, pick) {
  const buttons = ids.map((id) => pickButton(cut(id), id, isPicked(id), pick));
  const cell = ids.length === 1 ? buttons : html("details", { "data-first": ids[0] }, html("summary", {}, cut(text)), buttons);
  return html("th", { scope: "row", title: text }, cell);
}

function cut(text) {
  return html("span", { class: "cut", title: text }, text);
}

// The two names of a clearance, each cut where it is too long.
function gapName({ text, from, to, note }, key, isPicked, pick) {
  const between = [cut(from), " to ", cut(to)];
  return html("th", { scope: "row", title: text }, key ? pickButton(between, key, isPicked(key), pick) : between, note ? html("small", {}, note) : null);
}

// A verdict has a look; where it is not known yet, its cell is null.
function value(cell, was) {
  if (!cell || cell.look) return html("td", {}, tag(cell));
  // Of the same unit: what has another one is the same in other units.
  const [[now, unit], [then, former]] = [cell.text, was?.text ?? ""].map((text) => text.split(" "));
  const isChanged = then && then !== now && unit === former;
  const before = isChanged ? html("span", { class: "before" }, `${then} → `) : null;
  return html("td", { title: isChanged ? `${was.title ?? was.text} → ${cell.title ?? cell.text}` : cell.title }, before, cell.text);
}

function pickButton(told, key, isPicked, pick) {
  return button(told, () => pick(key), { class: "pick", "data-name": key, "aria-pressed": String(isPicked) });
}

// The PRD of one array under each motion, as a table with drawn cells at the scale of the answer.
function showBars(element, { heads, arrays }, id) {
  element.hidden = !(id in arrays) || arrays[id].rows.length === 0;
  if (element.hidden) return;
  const lengths = Object.values(arrays).flatMap((one) => [...one.lines.map(({ length_m: length }) => length), ...one.rows.map(({ prd_m: prd }) => prd)]);
  const scale = Math.max(...lengths);
  const { caption, lines, rows } = arrays[id];
  const at = (meters) => (WIDE * meters) / scale;
  const marked = lines.filter(({ length_m: length }) => length !== null);
  const drawn = () => marked.map(({ look, length_m: length }) => svg("line", { class: look, x1: at(length), x2: at(length), y1: 0, y2: 10 }));
  const row = ({ motion, prd_m: prd, text }) => {
    const bar = prd === null ? null : svg("rect", { class: "prd", x: 0, y: 2, width: at(prd), height: 6 });
    const drawing = svg("svg", { viewBox: `0 0 ${WIDE} 10`, preserveAspectRatio: "none" }, bar, drawn());
    return html("tr", {}, html("th", { scope: "row" }, motion), html("td", { class: "bar", "aria-hidden": "true" }, drawing), html("td", { class: "numbers" }, text));
  };
  update(
    element,
    html("caption", {}, caption),
    headings(heads, { class: "visually-hidden" }),
    html("tbody", {}, rows.map(row)),
    html("tfoot", {}, html("tr", {}, html("td", { colspan: heads.length }, lines.map(({ look, text }) => [sampleOf(look), html("span", {}, text)])))),
  );
}

function sampleOf(look) {
  return svg("svg", { class: "sample", viewBox: "0 0 18 10", "aria-hidden": "true" }, svg("line", { class: look, x1: 0, x2: 18, y1: 5, y2: 5 }));
}
