// What stands above the tables: the name of the project, its next step, its errors, its warnings.

import { html, parsed, replace } from "./make.js";

const ALONE =
  "Only the workbook was uploaded. Drop its records on this page, or its folder. Cells below that name a record are not wrong in themselves.";
const CORRECT =
  "Correct these cells here or in the workbook; what is typed here is filled into a copy that you can save. Records may follow: drop them on this page.";
const EDIT = "Change cells or fill in rows below. What is typed goes into a copy of the workbook, which is opened in place of this one; save it with Save workbook.";
const NEXT = {
  arrays: "Next: plan. List the arrays on the Arrays worksheet, or drop a drawing (DXF) beside the workbook: they are read from it.",
  motions: "No motions are entered: the displacements are prescriptive, and their package can be made. For the analysis procedure, list motions on the Motions worksheet, or generate them for this site here.",
  clearances: "Next: clearances. Some adjacent pairs have no clearance. Add them with the distances on the plan, then confirm the distances.",
};

const part = (id) => document.getElementById(id);

// What a workbook lacks before it has a verdict, in the order in which the page can give it.
export function showSteps({ lacks }) {
  const [step] = lacks;
  part("steps").hidden = !step;
  part("next-step").textContent = NEXT[step] ?? "";
  part("add-clearances").hidden = !lacks.includes("clearances");
  for (const name of Object.keys(NEXT)) part(`step-${name}`).ariaCurrent = name === step ? "step" : null;
}

// A workbook with errors is not opened: what was open stays so.
export function showErrors({ problems, html: drawn, is_alone: isAlone, lacks }, { project }) {
  const isLost = isAlone && problems.some(({ sheet }) => sheet === "Motions"); // a workbook, but no records
  const isNew = lacks.includes("arrays");
  const title = isLost ? "The records were not uploaded" : isNew ? "What the workbook needs first" : "Errors in the workbook";
  showFields(drawn, title, isLost ? ALONE : CORRECT);
  part("back").hidden = !project;
  part("back").textContent = `Back to ${project?.name}`;
  for (const id of ["workspace", "outline", "welcome"]) part(id).hidden = true;
  named(isNew ? "A new project" : "This workbook has errors");
}

/** Show the tables of the project that is open, to be changed. */
export function showTables(drawn) {
  part("workspace").hidden = true;
  part("back").hidden = false;
  part("back").textContent = "Back";
  showFields(drawn, "Edit the workbook", EDIT);
}

/** Return what is typed into the fields, by cell. */
export function typedCells() {
  const typed = [...part("problems").querySelectorAll("[data-at]")].filter((field) => field.value !== valueBefore(field));
  return Object.fromEntries(typed.map(({ dataset, value }) => [dataset.at, value]));
}

function valueBefore({ defaultValue, options }) {
  return defaultValue ?? ([...options].find((one) => one.defaultSelected) ?? options[0]).value;
}

// Errors and tables with their fields.
function showFields({ problems = "", fields }, title, advice) {
  const element = part("problems");
  const [heading, paragraph] = ["h2", "p"].map((name) => element.querySelector(name));
  heading.textContent = title;
  paragraph.textContent = advice;
  replace(element.querySelector(".problems"), ...parsed("table", problems).childNodes);
  replace(element.querySelector(".fields"), ...parsed("div", fields).childNodes);
  part("live").textContent = ""; // it has the verdict of what was open
  element.hidden = false;
  heading.focus();
}

/** Show the project that is open in place of errors. */
export function showProject({ project: { name, file, sha256, software, is_example: isExample } }) {
  for (const id of ["problems", "outline"]) part(id).hidden = true;
  part("workspace").hidden = false;
  part("welcome").hidden = !isExample;
  named(name, file, html("span", { class: "screen-only", title: sha256 }, `, SHA-256 ${sha256.slice(0, 12)}`), html("span", { class: "print-only" }, `, SHA-256 ${sha256}`));
  part("printed").textContent = `${software}, printed ${new Date().toISOString().slice(0, 10)}. Initials ________`;
}

/** Name what the page shows, and its file. */
export function named(name, ...file) {
  part("project-name").textContent = part("project-name").title = name;
  replace(part("project-file"), file);
  document.title = `${name} – Roofslip`;
}
