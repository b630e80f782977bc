// What the user takes away: a link, the workbook, and the package, from progress to its files.

import { isSame } from "./changes.js";
import { button, html, note, replace } from "./make.js";
import { save } from "./saving.js";

const POLL_MS = 500;
const COPIED = "The link is copied. It opens these values once, in another tab, as long as this project is open in roofslip serve.";

/**
 * Make the buttons work: `status` shows the package, `told` what was saved or copied. `values` gives those of the sliders, `words` says what values change, `fail`
 * gets an error and `forget` drops the last one. Returns what to call when values change (`compare`)
 * and when a project is open, with its package where there is one (`open`).
 */
export function mountTakeaway({ make, workbook, copy, status, told: saved }, api, { values, words, fail, forget }) {
  const guarded = (action) => () => {
    forget();
    return action().catch(fail);
  };
  let turn = 0; // of the package that is shown; another one, or another project, takes the next
  let shown = null; // what the server told of it last

  // Beside a package, what it is made with where the page has other values; no words where not.
  function compare() {
    const line = status.querySelector(".made-with");
    if (!shown || !line) return;
    const when = status.querySelector(".made") ? "Made" : "Started";
    line.textContent = isSame(shown.values, values()) ? "" : `${when} before the last change of values, with ${words(shown.values)}.`;
  }

  // Show a package until it is over, from what `begin` promises that the server tells of it.
  async function track(begin) {
    turn += 1;
    const mine = turn;
    const isWanted = () => mine === turn;
    // Who pressed a button that goes or is disabled gets the next one; a page that is loaded does not.
    const keepsFocus = document.activeElement === make || status.contains(document.activeElement);
    make.disabled = true;
    try {
      await follow(api, await begin(), { isWanted, show: (told) => show(told, keepsFocus) });
    } catch (error) {
      if (!isWanted()) return;
      if (status.querySelector("progress")) offer(); // no bar that nothing moves
      throw error;
    } finally {
      if (isWanted()) make.disabled = false;
    }
    if (keepsFocus && hasLostFocus()) make.focus();
  }

  function show(told, keepsFocus) {
    shown = told;
    showPackage(status, api, told, { cancel, keepsFocus, guarded });
    compare();
  }

  const cancel = guarded(() => track(() => api.cancelPackage(shown.id)));

  // Nothing is made, and nothing can be saved.
  function offer() {
    shown = null;
    replace(status);
  }

  workbook.addEventListener("click", guarded(() => saveWorkbook(saved, api, values())));
  copy.addEventListener("click", guarded(() => copyLink(saved, api)));
  make.addEventListener("click", guarded(() => track(() => api.startPackage(values()))));
  return {
    compare,
    open(told) {
      turn += 1;
      make.disabled = false;
      offer();
      if (told) guarded(() => track(async () => told))();
    },
  };
}

/** Show a sentence and say it to a screen reader. */
export function say(status, api, sentence) {
  replace(status, note(sentence));
  api.announce(sentence);
}

/** Show a package, from what the server told of it, until it is over, which is returned, or no longer wanted. */
export async function follow(api, told, { isWanted, show }) {
  let latest = told;
  while (isWanted()) {
    show(latest);
    if (latest.is_over) break;
    await new Promise((done) => {
      setTimeout(done, POLL_MS);
    });
    if (isWanted()) latest = await api.packageState(told.id);
  }
  return latest;
}

// How far a package is, its files, or what became of it.
function showPackage(status, api, told, { cancel, keepsFocus, guarded }) {
  if (!told.is_over) {
    showProgress(status, api, told, cancel);
    if (keepsFocus && hasLostFocus()) status.querySelector("button").focus();
  } else if (told.state === "done") {
    showFiles(status, api, told, guarded);
    if (keepsFocus && hasLostFocus()) status.querySelector("button").focus();
    api.announce("The package is complete; its files can be saved.");
  } else {
    say(status, api, told.words);
  }
}

/** Show how far a package is; the elements stay while it is made, so that Cancel keeps the focus. */
export function showProgress(status, api, { words, part }, cancel) {
  if (!status.querySelector("progress")) {
    replace(
      status,
      html("label", {}, html("span", { class: "stage" }), html("progress", { max: 1 }), madeWith()),
      button("Cancel", cancel),
    );
  }
  const shown = status.querySelector(".stage");
  if (shown.textContent !== words) {
    shown.textContent = words;
    api.announce(words);
  }
  const bar = status.querySelector("progress");
  bar.value = part;
}

function showFiles(status, api, { id, files }, guarded) {
  const made = files.map((name) => button(name.endsWith(".pdf") ? "Calc package" : name, guarded(() => saveFile(api, id, name)), { class: "link" }));
  replace(status, html("p", { class: "made" }, made, madeWith()));
}

/** Save a file of a package. */
export async function saveFile(api, id, name) {
  const { blob } = await api.file(id, name);
  save(blob, name);
}

function madeWith() {
  return html("em", { class: "made-with" });
}

// Whether what had the focus is disabled or gone.
function hasLostFocus() {
  return document.activeElement === document.body || document.activeElement.disabled;
}

async function saveWorkbook(status, api, values) {
  const { name, blob } = await api.workbook(values);
  save(blob, name);
  say(status, api, `${name} is saved with the values of the page.`);
}

async function copyLink(status, api) {
  const { token } = await api.newToken();
  const link = `${location.origin}${location.pathname}?token=${token}${location.hash}`;
  try {
    await navigator.clipboard.writeText(link);
    say(status, api, COPIED);
  } catch {
    showLink(status, link); // no clipboard: not a secure context, or not allowed
  }
}

function showLink(status, link) {
  const field = html("input", { type: "text", readonly: true, value: link, "aria-label": "Link that opens these values" });
  replace(status, field, note("Copy this link; it is good once."));
  field.select();
}
