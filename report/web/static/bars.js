// Peak relative displacements of one array, a bar for each motion, as a table with drawn cells.

import { html, replace, svg } from "./make.js";

const WIDE = 100; // units of the drawing; it stretches with its cell

/** Show the bars of an array at the scale of the answer. */
export function showBars(element, array, scaleM) {
  const at = (meters) => (WIDE * meters) / scaleM;
  const lines = [
    array.design_m === null ? null : mark("design", at(array.design_m)),
    array.prescriptive_m === null ? null : mark("prescriptive", at(array.prescriptive_m)),
  ];
  replace(
    element,
    html("caption", {}, `PRD of ${array.id} by motion`),
    html("thead", { class: "visually-hidden" }, html("tr", {}, ["Motion", "Bar", "PRD"].map((text) => html("th", { scope: "col" }, text)))),
    html("tbody", {}, array.bars.map((bar) => row(bar, at, lines))),
    html("tfoot", {}, html("tr", {}, html("td", { colspan: 3 }, legend(array)))),
  );
}

function row({ motion, prd_m: prd, text, short }, at, lines) {
  return html(
    "tr",
    {},
    html("th", { scope: "row" }, motion),
    html(
      "td",
      { class: "bar", "aria-hidden": "true" },
      svg(
        "svg",
        { viewBox: `0 0 ${WIDE} 10`, preserveAspectRatio: "none" },
        prd === null ? null : svg("rect", { class: "prd", x: 0, y: 2, width: at(prd), height: 6 }),
        lines.map((line) => line?.cloneNode()),
      ),
    ),
    html("td", { class: "numbers" }, short ?? text),
  );
}

function mark(kind, x) {
  return svg("line", { class: kind, x1: x, x2: x, y1: 0, y2: 10 });
}

function legend(array) {
  return [
    sample("design"),
    `design ${array.design_short ?? array.design}`,
    html("span", { class: "gap" }),
    sample("prescriptive"),
    `prescriptive ${array.prescriptive_short ?? array.prescriptive}`,
  ];
}

function sample(kind) {
  return svg("svg", { class: "sample", viewBox: "0 0 18 10", "aria-hidden": "true" }, svg("line", { class: kind, x1: 0, x2: 18, y1: 5, y2: 5 }));
}
