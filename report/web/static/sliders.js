// Sliders with the quantity that each changes, to type, and choices: native controls, so that the keyboard
// and a screen reader know them. They are of all arrays, or of the array or clearance that is picked.

import { acts, amountOf, entered, isSame, own, valueFor, valueOf } from "./changes.js";
import { number } from "./reading.js";
import { button, html, replace, words } from "./make.js";
import { helpButton } from "./terms.js";

/** Show the controls of a project in an element; returns how to draw them from the state. */
export function mountSliders(element, { sliders, choices }, session) {
  const parts = [...sliders.map((item) => slider(item, session)), ...choices.map((item) => choice(item, session))];
  replace(element, parts.map(({ field }) => field));
  return (state) => {
    for (const one of parts) one.draw(state);
  };
}

function slider(item, session) {
  const id = `slider-${item.id}`;
  const name = html("label", { for: id });
  const output = html("output", { for: id, class: "numbers" });
  const amount = html("span", { class: "numbers amount" });
  const aimed = () => targetOf(item, session.state);
  const enter = (value) => session.enter(entered(item, aimed(), value));
  const input = html("input", {
    id,
    type: "range",
    min: item.least,
    max: item.greatest,
    step: item.step,
    "aria-describedby": `${id}-help`,
    on: {
      input: () => session.move(entered(item, aimed(), input.valueAsNumber), !input.matches(":active")),
      pointerdown: () => field.input.blur(), // else what is half typed there is entered after this
    },
  });
  const set = (value) => {
    enter(value);
    input.focus();
  };
  const back = button("Reset", () => set(item.typed), {
    class: "back",
    title: "Reset to the workbook value",
    "aria-label": `${item.label}: reset to the workbook value`,
  });
  const field = fieldOf(item, session, aimed);
  const { turning, tryIt, drawTurn } = turnOf(item, set);

  function draw(state) {
    const { values, shows } = state;
    const target = aimed();
    const value = valueFor(item, values, target);
    const text = state.answer?.shown?.[item.id] ?? "";
    const isCurrent = shows !== "former" && Boolean(state.answer) && isSame(state.answer.values, values);
    write(name, [item.label, target].filter(Boolean).join(" of "), words);
    // What is the same is not set: while a slider moves, the browser would lay out all of them each time.
    if (input.valueAsNumber !== value) input.value = value;
    // `hidden` would move the focus; an untouched slider keeps the button's place.
    back.classList.toggle("is-idle", !Object.entries(values).some(([key, one]) => key.split("@")[0] === item.id && one !== item.typed));
    write(amount, own(item, value));
    field.draw(values, target, value);
    // One line, whatever it says: no control below it moves.
    const stop = stopOf(item, value);
    write(output, stop || text);
    output.classList.toggle("is-former", !stop && !isCurrent);
    input.setAttribute("aria-valuetext", (isCurrent && text) || amount.textContent);
    drawTurn(values, shows !== "former" && !target && state.turned[item.id]);
    const isIdle = !acts(item, values) || (item.real.is_beside && target && !acts(item.real, values));
    for (const control of [input, back, tryIt, field.input]) control.disabled = isIdle;
  }

  const element = html(
    "div",
    { class: "slider" },
    html("div", { class: "slider-head" }, name, helpButton(item.help, item.label), field.element),
    html("div", { class: "slider-head" }, amount, output, tryIt, back),
    html("div", { class: "range" }, input, place(markAt("typed-mark"), item, item.typed), turning),
    html("p", { class: "visually-hidden", id: `${id}-help` }, item.help),
  );
  return { field: element, draw };
}

// What the values of a slider are entered for: what is picked, if it has the quantity.
function targetOf({ real }, { picked }) {
  const target = picked?.replace("#", "");
  return target in real.targets ? target : "";
}

// The quantity itself, typed: of all arrays, where they differ of each.
function fieldOf(item, session, aimed) {
  const { symbol, unit, digits, targets } = item.real;
  const input = html("input", { type: "number", step: "any", class: "numbers", id: `field-${item.id}`, on: { change: enter } });
  const element = html("span", { class: "typed" }, symbol === item.label ? null : words(`${symbol} `), input, html("span", {}, unit));

  function enter() {
    const amount = input.valueAsNumber;
    if (!Number.isFinite(amount)) {
      session.set({}); // shown again as it is
      return;
    }
    const target = aimed();
    const base = target ? targets[target] : item.real.all;
    if (base !== null) session.enter(entered(item, target, valueOf(item, base, amount)));
    else session.enter(Object.assign({}, ...Object.entries(targets).map(([one, of]) => entered(item, one, valueOf(item, of, amount)))));
  }

  // Of all arrays one number, where they agree.
  function draw(values, target, value) {
    const isOf = Boolean(target) || !item.real.is_beside;
    element.hidden = !isOf || !acts(item.real, values);
    if (element.hidden) return;
    const names = target ? [target] : Object.keys(targets);
    const amounts = names.map((one) => amountOf(item, targets[one], valueFor(item, values, one)));
    if (names.length === 0) amounts.push(amountOf(item, item.real.all, value));
    const all = [...new Set(amounts.map((one) => number(one, digits).replace("−", "-")))];
    const text = all.length === 1 ? all[0] : "";
    if (document.activeElement !== input && input.value !== text) input.value = text;
    input.placeholder = all.length === 1 ? "" : "various";
    input.setAttribute("aria-label", `${symbol} of ${target || "all"}`);
  }

  return { element, input, draw };
}

// Where the verdict changes, at the values of the other sliders: a mark, and a button that tries it.
function turnOf(item, set) {
  const turning = markAt("turn-mark");
  let tried = item.typed;
  const tryIt = button("Set it", () => set(tried), { id: `turn-${item.id}`, class: "back turn" });
  const drawTurn = (values, turned) => {
    const stays = turned && isSame({ ...values, [item.id]: null }, { ...turned.others, [item.id]: null });
    for (const one of [turning, tryIt]) one.classList.toggle("is-idle", !stays);
    if (!stays) return;
    tried = turned.value;
    place(turning, item, tried);
    tryIt.textContent = `${turned.verdict.split(" ")[0]} at ${own(item, tried)}`;
    tryIt.title = `Set this value. At ${own(item, tried)} the verdict is ${turned.verdict}; at ${own(item, turned.before)} it is not. Values beyond this one were not checked.`;
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
function write(element, text, as = (one) => one) {
  if (element.dataset.text === text) return;
  element.dataset.text = text;
  replace(element, as(text));
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
  const select = html("select", { id: name, on: { change: () => session.enter({ [item.id]: select.value }) } }, options);
  const printed = html("p", { class: "note print-only" });
  const field = html("div", { class: "field" }, html("div", { class: "slider-head" }, html("label", { for: name }, words(item.label)), helpButton(item.help, item.label)), select, printed);
  const draw = ({ values }) => {
    if (select.value !== values[item.id]) select.value = values[item.id];
    write(printed, select.selectedOptions[0].label);
  };
  return { field, draw };
}
