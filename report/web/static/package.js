// What the user takes away: a link, the workbook, and the package, from progress to its files.

import { isSame } from "./changes.js";
import { button, html, note, replace, update } from "./make.js";
import { save } from "./saving.js";

const POLL_MS = 500;
const COMPLETE = "The package is complete; its files can be saved.";
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

  // Draw the package, and beside it what it is made with where the page has other values.
  function draw() {
    const when = shown?.is_over ? "Made" : "Started";
    const isOther = shown && !isSame(shown.values, values());
    const madeWith = html("em", { class: "made-with" }, isOther && `${when} before the last change of values, with ${words(shown.values)}.`);
    update(status, html("div", {}, shown && partsOf(shown, madeWith)));
  }

  function partsOf(told, madeWith) {
    if (!told.is_over) return progressOf(told, cancel, madeWith);
    if (told.state !== "done") return note(told.words);
    // A button that is the same stays, also for another package.
    const files = told.files.map((name) =>
      button(name.endsWith(".pdf") ? "Calc package" : name, guarded(() => saveFile(api, shown.id, name)), { class: "link" }),
    );
    return html("p", { class: "made" }, files, madeWith);
  }

  // Show a package until it is over, from what `begin` promises that the server tells of it.
  async function track(begin) {
    turn += 1;
    const mine = turn;
    const isWanted = () => mine === turn;
    // Who pressed a button that goes or is disabled gets the next one; a page that is loaded does not.
    const keepsFocus = document.activeElement === make || status.contains(document.activeElement);
    const show = (told) => {
      shown = told;
      make.disabled = Boolean(told && !told.is_over);
      draw();
      if (told?.is_over) api.announce(told.state === "done" ? COMPLETE : told.words);
      if (keepsFocus && hasLostFocus()) (status.querySelector("button") ?? make).focus();
    };
    make.disabled = true;
    try {
      await follow(api, await begin(), { isWanted, show });
    } catch (error) {
      if (!isWanted()) return;
      show(shown?.is_over ? shown : null); // no bar that nothing moves
      throw error;
    }
  }

  const cancel = guarded(() => track(() => api.cancelPackage(shown.id)));

  workbook.addEventListener("click", guarded(() => saveWorkbook(saved, api, values())));
  copy.addEventListener("click", guarded(() => copyLink(saved, api)));
  make.addEventListener("click", guarded(() => track(() => api.startPackage(values()))));
  return {
    compare: draw,
    open(told) {
      turn += 1;
      make.disabled = false;
      shown = null;
      draw();
      if (told) guarded(() => track(async () => told))();
    },
  };
}

/** Show a sentence and say it to a screen reader. */
export function say(status, api, sentence) {
  replace(status, note(sentence));
  api.announce(sentence);
}

/**
 * Show a package, from what the server told of it, until it is over, which is returned, or no longer wanted; what
 * it does is said to a screen reader.
 */
export async function follow(api, told, { isWanted, show }) {
  let [latest, spoken] = [told, ""];
  while (isWanted()) {
    if (!latest.is_over && latest.words !== spoken) api.announce(latest.words);
    spoken = latest.words;
    show(latest);
    if (latest.is_over) break;
    await new Promise((done) => {
      setTimeout(done, POLL_MS);
    });
    if (isWanted()) latest = await api.packageState(told.id);
  }
  return latest;
}

/** Return how far a package is, to be updated, so that Cancel keeps the focus. */
export function progressOf({ words, part }, cancel, ...beside) {
  return [html("label", {}, html("span", { class: "stage" }, words), html("progress", { max: 1, value: part }), beside), button("Cancel", cancel)];
}

/** Save a file of a package. */
export async function saveFile(api, id, name) {
  const { blob } = await api.file(id, name);
  save(blob, name);
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
    // No clipboard: not a secure context, or not allowed.
    const field = html("input", { type: "text", readonly: true, value: link, "aria-label": "Link that opens these values" });
    replace(status, field, note("Copy this link; it is good once."));
    field.select();
  }
}
