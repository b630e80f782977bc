// The arrays, their bars and the clearances: tables of the server, with what is picked, and before each number
// that changed that of the workbook.

import { html, parsed, update } from "./make.js";
import { onChange } from "./session.js";

/** Draw the tables of a session in elements; `pick` gets the key of a row. */
export function mountResults({ arrays, bars, clearances }, session, pick) {
  for (const table of [arrays, clearances]) {
    table.addEventListener("click", ({ target }) => {
      const one = target.closest("[data-name]");
      if (one) pick(one.dataset.name);
    });
  }
  session.draws(onChange(["answer", "picked", "array"], ({ answer, project, picked, array }) => {
    if (!answer) return;
    const former = (project.answer ?? answer).html;
    showTable(arrays, answer.html.arrays, former.arrays, array);
    showTable(clearances, answer.html.clearances, former.clearances, picked);
    bars.hidden = !(array in answer.html.bars);
    update(bars, parsed("table", answer.html.bars[array] ?? ""));
  }));
}

function showTable(element, drawn, before, picked) {
  const [next, former] = [drawn, before].map((one) => parsed("table", one));
  for (const row of next.tBodies[0].rows) {
    const names = [...row.querySelectorAll("[data-name]")];
    for (const one of names) one.ariaPressed = String(one.dataset.name === picked);
    row.classList.toggle("is-picked", names.some(({ ariaPressed }) => ariaPressed === "true"));
    const was = names.length > 0 && named(former, names[0].dataset.name)?.closest("tr");
    if (was) [...row.cells].forEach((cell, k) => cell.childElementCount === 0 && withBefore(cell, was.cells[k]));
  }
  for (const one of next.querySelectorAll("details")) one.open = Boolean(element.querySelector(`[data-first="${CSS.escape(one.dataset.first)}"][open]`));
  // A button that is drawn anew gets back the focus that it had.
  const focused = element.contains(document.activeElement) && document.activeElement.dataset.name;
  update(element, next);
  if (focused) named(element, focused)?.focus();
}

function named(element, name) {
  return element.querySelector(`[data-name="${CSS.escape(name)}"]`);
}

/** Write before a number that changed that of the workbook; one of another unit is the same in other units. */
export function withBefore(cell, was) {
  const [[now, unit], [then, former]] = [cell, was].map((one) => (one?.textContent ?? "").split(/\s/));
  if (!then || then === now || unit !== former) return;
  cell.title = `${was.title || was.textContent} → ${cell.title || cell.textContent}`;
  cell.prepend(html("span", { class: "before" }, `${then} → `));
}
