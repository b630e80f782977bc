// Peak relative displacements of one array, a bar for each motion, as a table with drawn cells.

import { headings, html, svg, update } from "./make.js";

const WIDE = 100; // units of the drawing; it stretches with its cell

/** Show the bars of an array at the scale of the answer. */
export function showBars(element, { heads, arrays }, id) {
  const lengths = Object.values(arrays).flatMap((one) => [...one.lines.map(({ length_m: length }) => length), ...one.rows.map(({ prd_m: prd }) => prd)]);
  const scale = Math.max(...lengths);
  const { caption, lines, rows } = arrays[id];
  const at = (meters) => (WIDE * meters) / scale;
  const marked = lines.filter(({ length_m: length }) => length !== null);
  const drawn = () => marked.map(({ look, length_m: length }) => svg("line", { class: look, x1: at(length), x2: at(length), y1: 0, y2: 10 }));
  const row = ({ motion, prd_m: prd, text }) => {
    const bar = prd === null ? null : svg("rect", { class: "prd", x: 0, y: 2, width: at(prd), height: 6 });
    const drawing = svg("svg", { viewBox: `0 0 ${WIDE} 10`, preserveAspectRatio: "none" }, bar, drawn());
    return html("tr", {}, html("th", { scope: "row" }, motion), html("td", { class: "bar", "aria-hidden": "true" }, drawing), html("td", { class: "numbers" }, text));
  };
  update(
    element,
    html("caption", {}, caption),
    headings(heads, { class: "visually-hidden" }),
    html("tbody", {}, rows.map(row)),
    html("tfoot", {}, html("tr", {}, html("td", { colspan: heads.length }, lines.map(({ look, text }) => [sample(look), html("span", {}, text)])))),
  );
}

function sample(look) {
  return svg("svg", { class: "sample", viewBox: "0 0 18 10", "aria-hidden": "true" }, svg("line", { class: look, x1: 0, x2: 18, y1: 5, y2: 5 }));
}
