// The verdict, the arrays, their bars and the clearances, as the server words them.

import { button, headings, html, note, replace, svg, update, words } from "./make.js";

const WIDE = 100; // units of the drawing; it stretches with its cell

/** Return the tag of a verdict, with the look that it has in the package; a dash while there is none. */
function tag(verdict) {
  return verdict ? html("strong", { class: `tag is-${verdict.look}` }, verdict.text) : html("span", { class: "note" }, "–");
}

/** Show the verdict of a full answer on one line; its causes, and what else needs attention, fold open. */
export function showVerdict(element, { verdict, line, verdict_text: text, reasons, model_text: model, pending }) {
  const count = reasons.filter(({ level }) => level !== "remedy").length;
  element.ariaBusy = pending ? "true" : null;
  showLine(element, [tag(verdict), " ", line], `Causes and conditions: ${count}`, [html("p", {}, text), list(reasons), pending && note(pending), note(model)]);
}

/** Show what a provisional answer is; it has no verdict. */
export function showProvisional(element, what, model) {
  showLine(element, [tag({ look: "provisional", text: "Provisional" }), " ", what], "What it is", note(model));
}

/** Show that there is no verdict, and why, with the reasons of the server where it gave any. */
export function showNoVerdict(element, why, reasons) {
  showLine(element, `No verdict: ${[why, ...reasons].join(": ")}.`, "Reasons", list(reasons.map((text) => ({ text }))));
}

/** Let the button of a verdict fold its causes open; Escape closes them. */
export function mountCauses(element) {
  const [more] = parts(element);
  const open = (isOpen) => more.setAttribute("aria-expanded", String(isOpen));
  more.addEventListener("click", () => open(more.ariaExpanded !== "true"));
  element.addEventListener("keydown", ({ key }) => key === "Escape" && open(false));
}

function showLine(element, said, label, folded) {
  const [more, listed, line] = parts(element);
  replace(line, said);
  line.title = line.textContent.trim();
  more.textContent = label;
  replace(listed, folded);
}

function parts(element) {
  return [".button", ".reasons", ".verdict-line"].map((one) => element.querySelector(one));
}

function list(reasons) {
  if (reasons.length === 0) return null;
  return html("ul", { "aria-label": "Reasons" }, reasons.map(reasonItem));
}

function reasonItem({ level, text, parts: grouped }) {
  const named = level ? [html("strong", { class: `level is-${level.toLowerCase()}` }, level), " "] : null;
  const said = [named, words(text)];
  return html("li", {}, grouped ? html("details", {}, html("summary", {}, said), list(grouped.map((one) => ({ text: one })))) : said);
}

/**
 * Show a table as the server words it: `named` is the column that names its rows. `pick` gets the key
 * of a row that has one, by its cells.
 */
export function showTable(element, { caption, heads, rows }, { named = 0, picked, pick, key }) {
  // A new body keeps no focus: the button that had it gets it back.
  const focused = element.contains(document.activeElement) ? document.activeElement.dataset.name : null;
  const name = (cell, id) => {
    const said = cell.from ? between(cell) : html("span", { class: "cut" }, cell.text);
    return html("th", { scope: "row", title: cell.text }, id ? pickButton(said, id, id === picked, pick) : said, cell.note ? html("small", {}, cell.note) : null);
  };
  const row = (cells) => {
    const id = key(cells);
    return html("tr", { class: id && id === picked ? "is-picked" : null }, cells.map((cell, k) => (k === named ? name(cell, id) : value(cell))));
  };
  update(element, html("caption", {}, caption), headings(heads), html("tbody", {}, rows.map(row)));
  if (focused) element.querySelector(`[data-name="${CSS.escape(focused)}"]`)?.focus();
}

// The two names of a clearance, each cut where it is too long.
function between({ from, to }) {
  return [html("span", { class: "cut" }, from), " to ", html("span", { class: "cut" }, to)];
}

// A verdict has a look; where it is not known yet, its cell is null.
function value(cell) {
  return html("td", { title: cell?.title }, cell && !cell.look ? cell.text : tag(cell));
}

function pickButton(said, key, isPicked, pick) {
  return button(said, () => pick(key), { class: "pick", "data-name": key, "aria-pressed": String(isPicked) });
}

/** Show the PRD of one array under each motion, as a table with drawn cells at the scale of the answer. */
export function showBars(element, { heads, arrays }, id) {
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
