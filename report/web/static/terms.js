// What a symbol or a word means: told on hover and on focus, beside it.

import { button } from "./make.js";

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
