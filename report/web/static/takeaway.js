// What the user takes away: the package, the workbook, and a link.

import { isSame } from "./changes.js";
import { html, replace } from "./make.js";
import { follow, noteValues, say } from "./package.js";

const WHAT = "The package and the workbook get the values of the page.";
const COPIED = "The link is copied. It restores these values in this browser, as long as the session lives.";

/**
 * Make the buttons work: `values` gives those of the sliders, `words` says what values change, and
 * `fail` gets an error.
 */
export function mountTakeaway({ make, workbook, copy, status }, api, { values, words, fail }) {
  const guarded = (action) => () => action().catch(fail);
  let opened = 0; // projects so far
  let shown = null; // the package of which the page shows the progress or the files

  function compare(next = shown) {
    shown = next;
    if (shown) noteValues(status, isSame(shown.values, values()) ? "" : words(shown.values));
  }

  async function makePackage() {
    const of = opened;
    make.disabled = true;
    try {
      const { ticket } = await api.startPackage(values());
      const cancel = guarded(async () => {
        make.disabled = false;
        make.focus(); // the button that had the focus goes
        await api.cancelPackage(ticket);
      });
      await follow(status, api, ticket, { cancel, compare, isWanted: () => of === opened });
    } finally {
      make.disabled = false;
    }
  }

  async function saveWorkbook() {
    const { name, blob } = await api.workbook(values());
    save(name, blob);
    say(status, api, `${name} is saved with the values of the page.`);
  }

  async function copyLink() {
    try {
      await navigator.clipboard.writeText(location.href);
      say(status, api, COPIED);
    } catch {
      showLink(status); // no clipboard: not a secure context, or not allowed
    }
  }

  make.addEventListener("click", guarded(makePackage));
  workbook.addEventListener("click", guarded(saveWorkbook));
  copy.addEventListener("click", guarded(copyLink));
  return {
    /** The values changed. */
    compare: () => compare(),
    /** Another project is open: nothing is on offer. */
    clear() {
      opened += 1;
      shown = null;
      replace(status, html("p", { class: "note" }, WHAT));
    },
  };
}

function showLink(status) {
  const link = html("input", { type: "text", readonly: true, value: location.href, "aria-label": "Link that restores these values" });
  replace(status, link, html("p", { class: "note" }, "Copy this link."));
  link.select();
}

function save(name, blob) {
  const url = URL.createObjectURL(blob);
  html("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}
