// The verdict, the arrays and the clearances, as the server words them.

import { html, replace, words } from "./make.js";

/** Return the tag of a verdict: inverse for NG, boxed for conditions, as in the package. */
export function tag(verdict) {
  if (verdict === null) return html("span", { class: "note" }, "–");
  const looks = { NG: "tag is-ng", Condition: "tag is-conditions", "OK with conditions": "tag is-conditions" };
  return html("strong", { class: looks[verdict] ?? "tag" }, verdict);
}

/** Return an answer whose values stay while others are computed: no verdict of it does. */
export function withoutVerdicts({ plan, arrays, clearances, ...rest }) {
  return { ...rest, verdict: null, arrays: arrays.map(without), clearances: clearances.map(without), plan: { ...plan, gaps: plan.gaps.map(without) } };
}

function without(row) {
  return { ...row, verdict: null };
}

/** Show the verdict of a full answer. */
export function showVerdict(element, { verdict, verdict_text: text, reasons, model_text: model }) {
  replace(
    element,
    html("p", { class: "verdict-line" }, tag(verdict), " ", text),
    html("p", { class: "note" }, model),
    list(reasons.map((reason) => reason.text)),
  );
}

/** Show what a provisional answer is; it has no verdict. */
export function showProvisional(element, what, model) {
  const mark = html("strong", { class: "tag is-provisional" }, "Provisional");
  replace(element, html("p", { class: "verdict-line" }, mark, " ", what), html("p", { class: "note" }, model));
}

/** Show that there is no verdict, and why, with the reasons of the server where it gave any. */
export function showNoVerdict(element, why, reasons) {
  replace(element, html("p", { class: "verdict-line" }, `No verdict: ${why}.`), list(reasons));
}

function list(reasons) {
  if (reasons.length === 0) return null;
  return html("ul", { class: "reasons", tabindex: "0", "aria-label": "Reasons" }, reasons.map((text) => html("li", {}, words(text))));
}

/** Show the table of arrays; `pick` gets the id of the one whose bars are to be drawn. */
export function showArrays(element, arrays, picked, pick) {
  const row = (array) =>
    html(
      "tr",
      { class: array.id === picked ? "is-picked" : null },
      html("th", { scope: "row" }, pickButton(array.id, array.id === picked, pick)),
      html("td", { title: array.mean_prd }, array.mean_prd_short ?? array.mean_prd),
      html("td", { title: [array.design, array.source].filter(Boolean).join(", ") }, array.design_short ?? array.design),
      html("td", { title: array.prescriptive }, array.prescriptive_short ?? array.prescriptive),
      html("td", { class: "word" }, tag(array.verdict)),
    );
  fill(element, "Arrays: displacement", ["Array", "Mean PRD", "Design", "Prescriptive", "Verdict"], arrays.map(row));
}

function pickButton(id, isPicked, pick) {
  return html("button", { type: "button", class: "pick", "data-array": id, "aria-pressed": String(isPicked), on: { click: () => pick(id) } }, id);
}

/** Show the table of clearances. */
export function showClearances(element, clearances) {
  fill(element, "Clearances", ["No.", "From, to", "Provided", "Required", "D/C", "Verdict"], clearances.map(clearanceRow));
}

function clearanceRow(item, k) {
  return html(
    "tr",
    {},
    html("td", { class: "count" }, String(k + 1)),
    html("th", { scope: "row" }, `${item.array} to ${item.object}`, html("small", {}, item.direction)),
    html("td", { title: item.provided }, item.provided_short ?? item.provided),
    html("td", { title: item.required }, item.required_short ?? item.required),
    html("td", {}, item.ratio_text),
    html("td", { class: "word" }, tag(item.verdict)),
  );
}

// A new body keeps no focus: the button that had it gets it back.
function fill(element, caption, heads, rows) {
  const focused = element.contains(document.activeElement) ? document.activeElement.dataset.array : null;
  replace(
    element,
    html("caption", {}, caption),
    html("thead", {}, html("tr", {}, heads.map((text) => html("th", { scope: "col" }, text)))),
    html("tbody", {}, rows),
  );
  if (focused) element.querySelector(`[data-array="${CSS.escape(focused)}"]`)?.focus();
}
