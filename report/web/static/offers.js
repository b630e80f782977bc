// Offers what a workbook lacks: to read its plan from a DXF beside it, and to make motions for its site.

import { button, html, note, parsed, replace, update, words } from "./make.js";
import { follow, progressOf, saveFile, say } from "./package.js";
import { save } from "./saving.js";

const PROJECT = "project.zip";
const BASIS = "Their target is AC156 with S_DS, z/h and the rule set on the Site worksheet.";

/**
 * Offer drawings in an element; `open` opens what a promise gives, `filled` gets the workbook that was
 * filled in, and `fail` an error.
 */
export function mountDrawing(element, api, { open, filled, fail }) {
  async function read(files, name, fields) {
    let state = null;
    await open(async () => {
      state = await api.readPlan(files, fields);
      return state;
    });
    if (!state) return;
    const workbook = await api.filledWorkbook();
    filled(workbook);
    say(element, api, `The plan is filled in from ${name}; the file that you dropped stays as it is.`);
    const lines = state.lines.map((line) => html("li", {}, line));
    element.append(html("ul", { class: "printed" }, lines), button("Save filled workbook", () => save(workbook.blob, workbook.name)));
    element.hidden = false;
  }

  /** Offer to read the drawing among files; nothing where there is none. */
  return (files, drawing) => {
    element.hidden = !drawing;
    if (!drawing) return;
    replace(element, ...parsed("div", drawing.html).childNodes);
    const layers = () => [...element.querySelectorAll("[data-layer]")].map(({ dataset, value }) => [dataset.layer, value]);
    const fields = () => ({ unit: element.querySelector("[data-unit]").value, layers: JSON.stringify(Object.fromEntries(layers())) });
    element.querySelector("button")?.addEventListener("click", () => read(files, drawing.name, fields()).catch(fail));
  };
}

/** Offer motions in an element; `open` opens what a promise gives, `fail` gets an error. */
export function mountMotions(element, api, { open, fail }) {
  let turn = 0; // of what is shown; another project takes the next
  let making = ""; // id of the suite that is being made
  const cancel = () => api.cancelPackage(making).catch(fail);
  const show = (told) => told.is_over || update(element, html("div", {}, progressOf(told, cancel)));

  async function make(files) {
    turn += 1;
    const mine = turn;
    const begun = await api.startMotions(files);
    making = begun.id;
    const isWanted = () => mine === turn;
    const made = await follow(api, begun, { isWanted, show }).catch((error) => ({ words: error.message }));
    if (!isWanted()) return;
    making = "";
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
    if (making) cancel();
    making = "";
    element.hidden = !files;
    if (!files) return;
    replace(element, button("No motions? Make seven for this site", () => make(files).catch(fail)), note(words(BASIS)));
  }

  return { offer };
}
