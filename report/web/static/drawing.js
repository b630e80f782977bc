// Offers to read the plan from a DXF beside the workbook: what is drawn on each layer, then the plan.

import { button, headings, html, note, replace } from "./make.js";
import { say } from "./package.js";
import { save } from "./saving.js";

/**
 * Offer drawings in an element; `open` opens what a promise gives, `filled` gets the workbook that was
 * filled in, and `fail` an error.
 */
export function mountDrawing(element, api, { open, filled, fail }) {
  async function read(files, name, fields) {
    let isRead = false;
    await open(async () => {
      const state = await api.readPlan(files, fields);
      isRead = Boolean(state);
      return state;
    });
    if (!isRead) return;
    const workbook = await api.filledWorkbook();
    filled(workbook);
    say(element, api, `The plan is filled in from ${name}; the file that you dropped stays as it is.`);
    element.append(button("Save filled workbook", () => save(workbook.blob, workbook.name)));
    element.hidden = false;
  }

  /** Offer to read the drawing among files; nothing where there is none. */
  return (files, drawing) => {
    element.hidden = !drawing;
    if (!drawing) return;
    const { name, refused, layers, kinds, units, unit } = drawing;
    if (refused) {
      replace(element, html("p", {}, `${name}: ${refused}`));
      return;
    }
    const chosen = layers.map(({ layer, kind }) => select(kinds, kind, layer));
    const unitOf = select(unit ? units : ["", ...units], unit, "Unit of the drawing");
    const fields = () => ({ unit: unitOf.value, layers: JSON.stringify(Object.fromEntries(layers.map(({ layer }, k) => [layer, chosen[k].value]))) });
    const rows = layers.map(({ layer, drawn }, k) => html("tr", {}, html("th", { scope: "row" }, layer), html("td", {}, drawn), html("td", {}, chosen[k])));
    replace(
      element,
      html("p", {}, `The plan can be read from ${name}: say what is drawn on each layer.`),
      html("table", { class: "layers" }, headings(["Layer", "Drawn", "Is"]), html("tbody", {}, rows)),
      html("label", { class: "field" }, "Unit ", unitOf, " "),
      button("Fill in the plan", () => read(files, name, fields()).catch(fail)),
      note("Places that are filled in the workbook are replaced in the copy that is open here."),
    );
  };
}

function select(options, chosen, label) {
  return html("select", { "aria-label": label }, options.map((value) => html("option", { value, selected: value === chosen }, value || "choose")));
}
