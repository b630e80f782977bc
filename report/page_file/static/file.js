// calc-package.html in motion: its runs computed again, and each of them to watch.

import { createApi, compared } from "./api.js";
import { html, replace } from "./make.js";
import { build } from "./slide.js";
import { mountValues } from "./values.js";
import { createView } from "./view-frame.js";

const data = JSON.parse(document.querySelector("#data").textContent);
const line = document.querySelector("#recomputed");

function announce(text) {
  document.querySelector("#said").textContent = text;
}

// What was found, in one line; bits are claimed only where they were found.
function sentence({ runs, equal, within, largest_m: largest }) {
  if (equal === runs) return `${runs} of ${runs} runs recomputed here: equal.`;
  if (within === runs) return `${runs} of ${runs} runs recomputed here: equal but for rounding of this browser, at most ${largest.toExponential(1)} m; ${equal} to the last bit.`;
  return `${runs - within} of ${runs} runs recomputed here differ from the package: this file was changed, or this browser computes otherwise.`;
}

async function recompute(api) {
  const found = compared(await api.runs({}));
  const hashes = await api.hashes();
  const wrong = hashes.filter(({ isSame }) => !isSame);
  const isGood = found.within === found.runs && wrong.length === 0;
  line.classList.toggle("is-wrong", !isGood);
  line.textContent = sentence(found) + (wrong.length > 0 ? ` Motions that the results do not name so: ${wrong.map(({ id }) => id).join(", ")}.` : "");
  replace(document.querySelector("#hashes"), html("table", {}, html("tbody", {}, hashes.map(hashRow))));
}

function hashRow({ id, sha256, isSame }) {
  const said = isSame ? "as in the results" : "not as in the results";
  return html("tr", {}, html("td", { class: "left" }, id), html("td", { class: "left hash" }, sha256), html("td", { class: "left" }, said));
}

function select(label, names, chosen) {
  const options = names.map((name) => html("option", { value: name }, name));
  const element = html("select", { on: { change: chosen } }, options);
  return { field: html("label", { class: "field" }, `${label} `, element), chosen: () => element.value };
}

async function watch(api) {
  const results = await api.state();
  const view = document.querySelector("#view");
  const update = () => shown.update(scene());
  const array = select("Array", results.arrays.map(({ id }) => id), update);
  const motion = select("Motion", results.motions.map(({ id }) => id), update);
  let values = {};
  const scene = () => ({ array: array.chosen(), motion: motion.chosen(), values });
  replace(document.querySelector("#picked"), array.field, motion.field);
  const shown = createView(view, async () => ({ build }), (request) => api.computed("slide", request), announce);
  update();
  document.querySelector("#other-values").hidden = !mountValues(document.querySelector("#sliders"), api, results, (moved) => {
    values = { ...moved };
    update();
  });
}

async function begin() {
  line.textContent = "All runs are being computed again …";
  const api = createApi(announce, data);
  try {
    await api.state();
  } catch {
    line.classList.add("is-wrong");
    line.textContent = "The data for recomputing cannot be read: this file is damaged, or the browser is too old.";
    return;
  }
  document.querySelector("#watch").hidden = false;
  await recompute(api);
  await watch(api);
}

begin();
