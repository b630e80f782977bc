// What a symbol or a word means: told on hover and on focus, beside it.

import { button, html, words } from "./make.js";

const TERMS = {
  "Mean PRD": "Mean of the peak relative displacement (PRD) of the array under the motions. The PRD is the largest distance of the array from its start during one motion.",
  "Design Δ": "Design displacement: what the separations are computed from. It is that of the analysis with its factor and its floor, or the prescriptive displacement.",
  Prescriptive: "Displacement of the prescriptive procedure, which needs no motions.",
  "D/C": "Demand / capacity: required / provided clearance. More than 1.00 is NG.",
  Verdict: "OK; NG: not satisfied; Condition: satisfied once the condition is closed.",
  Provided: "Clearance that is there, from the workbook.",
  Required: "Separation that the design displacements require.",
  Provisional: "Computed from part of the runs while you move a slider. A displacement may be too small, and there is no verdict.",
};

/** Return a word with what it means, where that is known; else with its subscripts. */
export function term(text) {
  return text in TERMS ? html("span", { class: "term", tabindex: 0, "data-term": TERMS[text] }, text) : words(text);
}

/** Return a button that tells what a control does. */
export function helpButton(text, label) {
  return button("?", () => {}, { class: "help", "data-term": text, "aria-label": `What ${label} is` });
}

/** Tell the term under the pointer, or that has the focus, in an element; Escape hides it. */
export function mountTerms(tip) {
  const hide = () => {
    tip.hidden = true;
  };
  const show = ({ target }) => {
    const of = target.closest?.("[data-term]");
    if (!of) {
      if (!tip.contains(target)) hide();
      return;
    }
    tip.textContent = of.dataset.term;
    tip.hidden = false;
    of.setAttribute("aria-describedby", tip.id);
    const { left, bottom, top } = of.getBoundingClientRect();
    const { offsetWidth: wide, offsetHeight: tall } = tip;
    const isBelow = bottom + tall + 8 < innerHeight;
    tip.style.setProperty("left", `${Math.max(8, Math.min(left, innerWidth - wide - 8))}px`);
    tip.style.setProperty("top", `${isBelow ? bottom + 4 : top - tall - 4}px`);
  };
  for (const kind of ["pointerover", "focusin", "click"]) document.addEventListener(kind, show);
  document.addEventListener("keydown", ({ key }) => key === "Escape" && hide());
  addEventListener("scroll", hide, { passive: true });
}
