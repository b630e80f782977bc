// Follows the making of a package: place in line, progress, cancel, and its files.

import { html, replace } from "./make.js";

const POLL_MS = 500;
const FILES = [
  ["calc-package.pdf", "Calc package"],
  ["results.xlsx", "results.xlsx"],
  ["results.json", "results.json"],
  ["plan.dxf", "plan.dxf"],
];

/**
 * Show in `status` how a package is made; ends when it is made, failed, cancelled or no longer wanted.
 * `compare` is called where the page shows a package, with what the server tells of it.
 */
export async function follow(status, api, ticket, { cancel, isWanted, compare }) {
  while (isWanted()) {
    const state = await api.packageState(ticket);
    if (!isWanted()) return;
    if (state.state === "done") {
      showFiles(status, ticket);
      compare(state);
      api.announce("The package is made. Its files can be saved.");
      return;
    }
    if (state.state !== "queued" && state.state !== "running") {
      say(status, api, state.state === "failed" ? state.message : "The package was cancelled.");
      return;
    }
    showProgress(status, api, state, cancel);
    compare(state);
    await new Promise((done) => {
      setTimeout(done, POLL_MS);
    });
  }
}

/** Show a sentence and say it to a screen reader. */
export function say(status, api, sentence) {
  replace(status, html("p", { class: "note" }, sentence));
  api.announce(sentence);
}

/** Note beside a package what it is made with, where the page has other values; no words where not. */
export function noteValues(status, words) {
  const note = status.querySelector(".made-with");
  if (!note) return;
  const when = status.querySelector(".made") ? "Made" : "Started";
  note.textContent = words && `${when} before the last change of values, with ${words}.`;
}

// The elements stay while the package is made, so that Cancel keeps the focus.
function showProgress(status, api, { state, place, stage, part }, cancel) {
  if (!status.querySelector("progress")) {
    replace(
      status,
      html("label", {}, html("span", { class: "stage" }), html("progress", { max: 1 }), madeWith()),
      html("button", { type: "button", class: "button", on: { click: cancel } }, "Cancel"),
    );
    catchFocus(status, "button");
  }
  const words = state === "queued" ? `In line, place ${place}` : stage;
  const shown = status.querySelector(".stage");
  if (shown.textContent !== words) {
    shown.textContent = words;
    api.announce(words);
  }
  const bar = status.querySelector("progress");
  if (state === "queued") bar.removeAttribute("value");
  else bar.value = part;
}

function showFiles(status, ticket) {
  const made = FILES.map(([name, label]) => html("a", { href: `/api/package/${ticket}/${name}`, download: name }, label));
  replace(status, html("p", { class: "made" }, made, madeWith()));
  catchFocus(status, "a");
}

function madeWith() {
  return html("em", { class: "made-with" });
}

// The button that had the focus is disabled or gone: its successor gets it.
function catchFocus(status, successor) {
  const active = document.activeElement;
  if (active === document.body || active.disabled) status.querySelector(successor).focus();
}
