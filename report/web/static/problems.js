// The errors of a workbook, by cell, each with a picture of its row.

import { headings, html, replace, words } from "./make.js";

/** Show the errors of a workbook, and go there. */
export function showProblems(element, problems, title, advice) {
  const [heading, paragraph, body] = ["h2", "p", "tbody"].map((name) => element.querySelector(name));
  heading.textContent = title;
  paragraph.textContent = advice;
  replace(body, problems.map(line));
  element.hidden = false;
  heading.focus();
}

function line(problem, k) {
  const where = [problem.sheet, problem.cells].filter(Boolean).join("!");
  return html(
    "tr",
    {},
    html("td", { class: "numbers" }, String(k + 1)),
    html("th", { scope: "row" }, where || problem.file, where ? html("small", {}, problem.file) : null),
    html("td", {}, words(problem.found ?? problem.text)),
    html("td", {}, words(problem.remedy ?? "")),
    html("td", {}, problem.row ? picture(problem.row) : null),
  );
}

function picture(row) {
  const cell = (text, k) => {
    const isFaulty = k === row.at;
    return html("td", { class: isFaulty ? "is-faulty" : null }, text, isFaulty ? hidden(" (this cell)") : null);
  };
  return html(
    "table",
    { class: "row-picture" },
    headings([hidden("Row"), ...row.heads]),
    html("tbody", {}, html("tr", {}, html("th", { scope: "row" }, String(row.number)), row.cells.map(cell))),
  );
}

function hidden(text) {
  return html("span", { class: "visually-hidden" }, text);
}
