// Sliders and choices: native controls, so that the keyboard and a screen reader know them.

import { isSame, own } from "./changes.js";
import { button, html, replace, words } from "./make.js";

/**
 * Show the controls of a project; returns how to draw them: at values, with what the tables show of
 * them, by the ID of a control. `shown` is what the values of the tables amount to, `isCurrent` whether
 * these are the values of the controls, and `turned` where the verdict changes.
 */
export function mountSliders(element, { sliders, choices }, session) {
  const parts = [...sliders.map((item) => slider(item, session)), ...choices.map((item) => choice(item, session))];
  replace(element, parts.map(({ field }) => field));
  const draw = (values, tables) => {
    for (const one of parts) one.draw(values, tables);
    depend(sliders, parts, values);
  };
  return { draw };
}

function slider(item, session) {
  const id = `slider-${item.id}`;
  const output = html("output", { for: id, class: "numbers" });
  const amount = html("span", { class: "numbers amount" });
  const input = html("input", {
    id,
    type: "range",
    min: item.least,
    max: item.greatest,
    step: item.step,
    "aria-describedby": item.help ? `${id}-help` : null,
    on: {
      input: () => session.move(item.id, input.valueAsNumber, !input.matches(":active")),
      pointerup: session.release,
    },
  });
  const set = (value) => {
    session.set({ [item.id]: value });
    input.focus();
  };
  const back = button("Reset", () => set(item.typed), {
    class: "back",
    title: "Back to the workbook's value",
    "aria-label": `${item.label}: back to the workbook's value`,
  });
  const { turning, tryIt, drawTurn } = turnOf(item, set);
  const draw = (values, { shown, isCurrent, turned }) => {
    const value = values[item.id];
    const text = shown[item.id] ?? "";
    // What is the same is not set: while a slider moves, the browser would lay out all of them each time.
    if (input.valueAsNumber !== value) input.value = value;
    // `hidden` would move the focus; an untouched slider keeps the button's place.
    back.classList.toggle("is-idle", value === item.typed);
    write(amount, own(item, value));
    // One line, whatever it says: no control below it moves.
    const stop = stopOf(item, value);
    write(output, stop || (Number(text.replace("× ", "")) === value ? "" : text)); // said once
    output.classList.toggle("is-former", !stop && !isCurrent);
    input.setAttribute("aria-valuetext", (isCurrent && text) || amount.textContent);
    drawTurn(values, turned[item.id]);
  };
  const field = html(
    "div",
    { class: "slider" },
    html("div", { class: "slider-head" }, html("label", { for: id, title: item.help }, words(item.label)), amount, back),
    html("div", { class: "slider-head" }, output, tryIt),
    html("div", { class: "range" }, input, place(markAt("typed-mark"), item, item.typed), turning),
    item.help ? html("p", { class: "visually-hidden", id: `${id}-help` }, item.help) : null,
  );
  return { id: item.id, field, draw };
}

// Where the verdict changes, at the values of the other sliders: a mark, and a button that tries it.
function turnOf(item, set) {
  const turning = markAt("turn-mark");
  let tried = item.typed;
  const tryIt = button("Try it", () => set(tried), { id: `turn-${item.id}`, class: "back turn" });
  const drawTurn = (values, turned) => {
    const stays = turned && isSame({ ...values, [item.id]: null }, { ...turned.others, [item.id]: null });
    for (const one of [turning, tryIt]) one.classList.toggle("is-idle", !stays);
    if (!stays) return;
    tried = turned.value;
    place(turning, item, tried);
    tryIt.textContent = `${turned.verdict.split(" ")[0]} at ${own(item, tried)}`;
    tryIt.title = `Try it. At ${own(item, tried)} the verdict is ${turned.verdict}; at ${own(item, turned.before)} it is not. Values beyond are not tried.`;
  };
  return { turning, tryIt, drawTurn };
}

// A mark below a slider. No datalist: its values pull the pointer, so that those beside it cannot be
// chosen.
function markAt(look) {
  return html("span", { class: `mark ${look}` });
}

function place(mark, { least, greatest }, value) {
  mark.style.setProperty("--share", (value - least) / (greatest - least));
  return mark;
}

// A line that is cut is whole in its title.
function write(element, text) {
  if (element.textContent === text) return;
  element.textContent = text;
  element.title = text;
}

// Why a slider goes no further, where it is at such an end.
function stopOf({ least, greatest, stops }, value) {
  if (value <= least) return stops.least ?? "";
  return value >= greatest ? (stops.greatest ?? "") : "";
}

function choice(item, session) {
  const name = `choice-${item.id}`;
  const options = item.options.map(({ value, label, why_not: why }) => html("option", { value, disabled: Boolean(why), title: why }, label));
  const select = html("select", { id: name, title: item.help, on: { change: () => session.set({ [item.id]: select.value }) } }, options);
  const printed = html("p", { class: "note print-only" });
  const field = html("div", { class: "field" }, html("label", { for: name }, words(item.label)), select, printed);
  const draw = (values) => {
    if (select.value !== values[item.id]) select.value = values[item.id];
    write(printed, select.selectedOptions[0].label);
  };
  return { id: item.id, field, draw };
}

// Some sliders act only beside a choice.
function depend(sliders, parts, values) {
  for (const { id, with_choice: needed } of sliders) {
    if (!needed) continue;
    const acts = Object.entries(needed).every(([key, value]) => values[key] === value);
    for (const control of parts.find((part) => part.id === id).field.querySelectorAll("input, button")) control.disabled = !acts;
  }
}
