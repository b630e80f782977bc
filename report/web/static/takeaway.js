// What the user takes away: the package, the workbook, and a link.

import { html, note, replace } from "./make.js";
import { mountPackage, say } from "./package.js";
import { save } from "./saving.js";

const COPIED = "The link is copied. It opens these values once, in another tab, as long as roofslip serve runs.";

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
    save(blob, name);
    say(status, api, `${name} is saved with the values of the page.`);
  }

  async function copyLink() {
    const { token } = await api.newToken();
    const link = `${location.origin}/?token=${token}${location.hash}`;
    try {
      await navigator.clipboard.writeText(link);
      say(status, api, COPIED);
    } catch {
      showLink(status, link); // no clipboard: not a secure context, or not allowed
    }
  }

  workbook.addEventListener("click", guarded(saveWorkbook));
  copy.addEventListener("click", guarded(copyLink));
  return mountPackage({ make, status }, api, { values, words, guarded });
}

function showLink(status, link) {
  const field = html("input", { type: "text", readonly: true, value: link, "aria-label": "Link that opens these values" });
  replace(status, field, note("Copy this link; it is good once."));
  field.select();
}
