// Offers motions for a workbook that has none: they are made for its site, and the page goes on with them.

import { button, html, note, replace, words } from "./make.js";
import { follow, saveFile, say, showProgress } from "./package.js";

const PROJECT = "project.zip";
const BASIS = "Their target is AC156 with S_DS, z/h and the rule set of the sheet Site.";

/** Offer motions in an element; `open` opens what a promise gives, `fail` gets an error. */
export function mountMotions(element, api, { open, fail }) {
  let turn = 0; // of what is shown; another project takes the next

  async function make(files) {
    turn += 1;
    const mine = turn;
    const begun = await api.startMotions(files);
    const cancel = () => api.cancelPackage(begun.id).catch(fail);
    const show = (told) => told.is_over || showProgress(element, api, told, cancel);
    const isWanted = () => mine === turn;
    const made = await follow(api, begun, { isWanted, show }).catch((error) => ({ words: error.message }));
    if (!isWanted()) return;
    if (made.state === "done") await goOn(begun.id);
    else {
      offer(files);
      element.append(note(made.words));
      api.announce(made.words);
    }
  }

  async function goOn(id) {
    const { blob } = await api.file(id, PROJECT);
    await open(() => api.upload([{ file: blob, path: PROJECT }]));
    say(element, api, "The motions are made and listed in the workbook.");
    element.append(button("Save workbook and records (zip)", () => saveFile(api, id, PROJECT).catch(fail)));
    element.hidden = false;
  }

  /** Offer motions for the files of a project; none where there is nothing to offer. */
  function offer(files) {
    turn += 1;
    element.hidden = !files;
    if (!files) return;
    const label = "No motions? Make seven for this site";
    replace(element, button(label, () => make(files).catch(fail)), html("p", { class: "note" }, words(BASIS)));
  }

  return { offer };
}
