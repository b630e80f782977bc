// What the user takes away: the package, the workbook, and a link.

import { html, note, replace } from "./make.js";
import { mountPackage, say } from "./package.js";

const COPIED = "The link is copied. It restores these values in this browser, as long as the session lives.";

/**
 * Make the buttons work: `values` gives those of the sliders, `words` says what values change, `fail`
 * gets an error and `forget` drops the last one.
 */
export function mountTakeaway({ make, workbook, copy, status }, api, { values, words, fail, forget }) {
  const guarded = (action) => () => {
    forget();
    return action().catch(fail);
  };

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

  workbook.addEventListener("click", guarded(saveWorkbook));
  copy.addEventListener("click", guarded(copyLink));
  return mountPackage({ make, status }, api, { values, words, guarded });
}

function showLink(status) {
  const link = html("input", { type: "text", readonly: true, value: location.href, "aria-label": "Link that restores these values" });
  replace(status, link, note("Copy this link."));
  link.select();
}

function save(name, blob) {
  const url = URL.createObjectURL(blob);
  html("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}
