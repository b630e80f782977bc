// The verdict, the arrays and the clearances, as the server words them.

import { button, headings, html, note, replace, update, words } from "./make.js";

/** Return the tag of a verdict, with the look that it has in the package; a dash while there is none. */
function tag(verdict) {
  return verdict ? html("strong", { class: `tag is-${verdict.look}` }, verdict.text) : html("span", { class: "note" }, "–");
}

/** Show the verdict of a full answer: the causes of NG whole, and what else needs attention. */
export function showVerdict(element, { verdict, verdict_text: text, reasons, model_text: model }) {
  const causes = reasons.filter(({ level }) => ["NG", "remedy"].includes(level));
  const others = reasons.filter((reason) => !causes.includes(reason));
  const more = causes.length > 0 && others.length > 0;
  const summary = html("summary", {}, `Conditions and warnings: ${others.length}`);
  const listed = html("div", { class: "reasons" }, list(causes), more ? html("details", {}, summary, list(others)) : list(others));
  replace(element, line(tag(verdict), " ", text), note(model), reasons.length > 0 ? listed : null);
}

/** Show what a provisional answer is; it has no verdict. */
export function showProvisional(element, what, model) {
  replace(element, line(tag({ look: "provisional", text: "Provisional" }), " ", what), note(model));
}

/** Show that there is no verdict, and why, with the reasons of the server where it gave any. */
export function showNoVerdict(element, why, reasons) {
  const listed = list(reasons.map((text) => ({ text })));
  replace(element, line(`No verdict: ${why}.`), listed ? html("div", { class: "reasons" }, listed) : null);
}

function line(...parts) {
  return html("p", { class: "verdict-line" }, parts);
}

function list(reasons) {
  if (reasons.length === 0) return null;
  return html("ul", { "aria-label": "Reasons" }, reasons.map(reasonItem));
}

function reasonItem({ level, text }) {
  const named = level ? [html("strong", { class: `level is-${level.toLowerCase()}` }, level), " "] : null;
  return html("li", {}, named, words(text));
}

/**
 * Show a table as the server words it: `named` is the column that names its rows. Where rows can be
 * picked, `pick` gets the name of one.
 */
export function showTable(element, { caption, heads, rows }, { named = 0, picked = null, pick = null, dim = [] } = {}) {
  // A new body keeps no focus: the button that had it gets it back.
  const focused = element.contains(document.activeElement) ? document.activeElement.dataset.name : null;
  const name = (cell) =>
    html("th", { scope: "row", title: cell.text }, pick ? pickButton(cell.text, cell.text === picked, pick) : between(cell), cell.note ? html("small", {}, cell.note) : null);
  const look = ({ text, from, to }) => [text === picked && "is-picked", [text, from, to].some((id) => dim.includes(id)) && "is-dim"];
  const row = (cells) =>
    html("tr", { class: look(cells[named]).filter(Boolean).join(" ") || null }, cells.map((cell, k) => (k === named ? name(cell) : value(cell))));
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

function pickButton(name, isPicked, pick) {
  return button(name, () => pick(name), { class: "pick cut", "data-name": name, "aria-pressed": String(isPicked) });
}
