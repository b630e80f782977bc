// What stands above the tables: the name of the project, its next step, its errors, its warnings.

import { html, replace } from "./make.js";
import { showProblems } from "./problems.js";

const ALONE =
  "The workbook came alone. Drop its folder on this page, or a zip of it, so that its records come with it. A cell below that names a record has no error of its own.";
const CORRECT =
  "Correct these cells in the workbook and save it. Then open its folder, or a zip of it: records are found by their path from the workbook.";
const NEXT = {
  arrays: "Next: plan. List the arrays on the sheet Arrays, or drop a drawing (DXF) beside the workbook: they are read from it.",
  motions: "Next: motions. List your own on the sheet Motions, or let the page make them for this site.",
  clearances: "Next: clearances. Pairs within reach have none; add them at their distances in plan, then confirm these.",
};

const part = (id) => document.getElementById(id);

// What a workbook lacks before it has a verdict, in the order in which the page can give it.
export function showSteps({ lacks: [step] }) {
  part("steps").hidden = !step;
  part("next-step").textContent = NEXT[step] ?? "";
  part("add-clearances").hidden = step !== "clearances";
  for (const name of Object.keys(NEXT)) part(`step-${name}`).ariaCurrent = name === step ? "step" : null;
}

// A workbook with errors is not opened: what was open stays so.
export function showErrors({ problems, is_alone: isAlone, lacks }, state) {
  const isLost = isAlone && !lacks.includes("motions") && problems.some(({ cell }) => cell); // a workbook, but no records
  showProblems(part("problems"), problems, isLost ? "The records were not sent" : "Errors in the workbook", isLost ? ALONE : CORRECT);
  part("back").hidden = !state;
  if (state) part("back").textContent = `Back to ${state.project.name}`;
  part("workspace").hidden = true;
  part("welcome").hidden = true;
  named("This workbook has errors");
}

/** Name what the page shows, and its file. */
export function named(name, ...file) {
  part("project-name").textContent = name;
  replace(part("project-file"), file);
  document.title = `${name} – Roofslip`;
}

/** Return the warnings and notes of a workbook, folded. */
export function warnings(all) {
  if (all.length === 0) return null;
  const lines = all.map((text) => html("li", {}, text));
  return html("details", {}, html("summary", {}, `Warnings and notes: ${all.length}`), html("ul", {}, lines));
}
