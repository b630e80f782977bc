// The values in the address: `#friction=0.95&polarity=both` restores them.

import { changed } from "./changes.js";

/** Return the fragment of the values that differ from those of the workbook. */
export function toFragment(values, controls) {
  return new URLSearchParams(changed(controls, values).map(({ id }) => [id, String(values[id])])).toString();
}

/** Return the values in a fragment; what is no control, no number or no option is left out. */
export function fromFragment(fragment, sliders, choices) {
  const given = new URLSearchParams(fragment.replace(/^#/, ""));
  const values = {};
  for (const { id } of sliders) {
    const text = given.get(id);
    if (text?.trim() && Number.isFinite(Number(text))) values[id] = Number(text);
  }
  for (const { id, options } of choices) {
    const option = options.find(({ value }) => value === given.get(id));
    if (option) values[id] = option.value;
  }
  return values;
}
