// The errors of a workbook by cell, each with its row, and the tables of the roof: fields that fill in the
// workbook. Errors of one sheet with one remedy are one line, which opens.

import { headings, html, replace, words } from "./make.js";

/** Show errors and tables in an element, and go there; returns what is typed into the fields by cell. */
export function showProblems(element, { problems, tables }, title, advice) {
  const typed = {};
  const [heading, paragraph] = ["h2", "p"].map((name) => element.querySelector(name));
  heading.textContent = title;
  paragraph.textContent = advice;
  const groups = Map.groupBy(problems, ({ sheet, remedy, text }) => `${sheet}!${remedy ?? text}`);
  replace(element.querySelector("tbody"), [...groups.values()].map((group, k) => line(group, k, typed)));
  replace(element.querySelector(".fields"), tables.map((table) => fields(table, typed)));
  element.hidden = false;
  heading.focus();
  return typed;
}

function line(group, k, typed) {
  const [problem] = group;
  const where = [problem.sheet, problem.cells].filter(Boolean).join("!");
  const found = words(problem.found ?? problem.text);
  const others = group.slice(1).map((one) => html("li", {}, [one.sheet, one.cells].filter(Boolean).join("!"), ": ", words(one.found ?? one.text)));
  return html(
    "tr",
    {},
    html("td", { class: "numbers" }, String(k + 1)),
    html("th", { scope: "row" }, where || problem.file, where ? html("small", {}, problem.file) : null),
    html("td", {}, found, others.length > 0 ? html("details", {}, html("summary", {}, `${others.length} more with the same remedy`), html("ul", {}, others)) : null),
    html("td", {}, words(problem.remedy ?? "")),
    html("td", {}, problem.row ? picture(problem, typed) : null),
  );
}

function picture({ row, sheet, cell: at, found }, typed) {
  const cell = (text, k) => html("td", { class: k === row.at ? "is-faulty" : null }, k === row.at ? field(typed, `${sheet}!${at}`, text, { label: found }) : text);
  return html(
    "table",
    { class: "row-picture" },
    row.heads.some(Boolean) ? headings([html("span", { class: "visually-hidden" }, "Row"), ...row.heads]) : null,
    html("tbody", {}, html("tr", {}, html("th", { scope: "row" }, String(row.number)), row.cells.map(cell))),
  );
}

// A table with its rows, and blank ones below them.
function fields({ sheet, heads, rows }, typed) {
  const cell = ({ cell: at, text }, k) => html("td", {}, field(typed, `${sheet}!${at}`, text, { label: `${heads[k].text}, ${at}`, choices: heads[k].choices }));
  return html(
    "details",
    { open: rows[0].every(({ text }) => text === "") && sheet === "Arrays" },
    html("summary", {}, sheet),
    html("div", { class: "wide" }, html("table", { class: "row-picture" }, html("thead", {}, html("tr", {}, heads.map(({ text, need, help }) => html("th", { scope: "col", title: help }, text, html("small", {}, need))))), html("tbody", {}, rows.map((row) => html("tr", {}, row.map(cell)))))),
  );
}

function field(typed, address, text, { label, choices = [] }) {
  const change = ({ target }) => {
    typed[address] = target.value;
  };
  const about = { "aria-label": label, "data-at": address, on: { change } };
  if (choices.length === 0) return html("input", { type: "text", value: text, ...about });
  return html("select", about, ["", ...choices].map((one) => html("option", { value: one, selected: one === text }, one)));
}
