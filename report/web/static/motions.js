// Offers motions for a workbook that has none: they are made for its site, and the page goes on with them.

import { button, html, note, replace, words } from "./make.js";
import { follow, isOver, say, showProgress } from "./package.js";

const BASIS = "Their target is AC156 with S_DS, z/h and the rule set of the sheet Site.";

/** Offer motions in an element; `open` opens what a promise gives, `fail` gets an error. */
export function mountMotions(element, api, { open, fail }) {
  let turn = 0; // of what is shown; another project takes the next

  async function make(files) {
    turn += 1;
    const mine = turn;
    const isWanted = () => mine === turn;
    let told = await api.startMotions(files);
    const cancel = () => api.cancelPackage(told.ticket).catch(fail);
    const show = (latest) => {
      told = latest;
      if (!isOver(told)) showProgress(element, api, told, cancel);
    };
    await follow(api, told, { isWanted, show });
    if (!isWanted()) return;
    if (told.state === "done") await goOn(`/api/package/${told.ticket}/project.zip`);
    else {
      offer(files);
      element.append(note(told.words));
      api.announce(told.words);
    }
  }

  async function goOn(url) {
    const { name, blob } = await api.project(url);
    await open(() => api.upload([{ file: blob, path: name }]));
    say(element, api, "The motions are made and listed in the workbook.");
    element.append(html("a", { href: url, download: name }, "Save workbook and records (zip)"));
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
