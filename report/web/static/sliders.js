// Sliders and choices: native controls, so that the keyboard and a screen reader know them.

import { isSame, own } from "./changes.js";
import { button, html, replace, words } from "./make.js";

/** Show the controls of a project; returns how to follow its answers, and to mark where the verdict changes. */
export function mountSliders(element, { sliders, choices }, values, session) {
  const parts = [...sliders.map((item) => slider(item, values, session)), ...choices.map((item) => choice(item, values, session))];
  replace(element, parts.map(({ field }) => field));
  const follow = (shown) => {
    for (const { id, say } of parts) say(shown[id] ?? "");
    depend(sliders, parts, session.values());
  };
  depend(sliders, parts, values);
  return { follow, turn: (id, found) => parts.find((part) => part.id === id).turn(found) };
}

function slider(item, values, session) {
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
      input: () => {
        session.move(item.id, input.valueAsNumber, !input.matches(":active"));
        mark();
      },
      pointerup: session.release,
    },
  });
  const set = (value) => {
    input.value = value;
    session.set({ [item.id]: value });
    mark();
    input.focus();
  };
  const back = button("Reset", () => set(item.typed), {
    class: "back",
    title: "Back to the workbook's value",
    "aria-label": `${item.label}: back to the workbook's value`,
  });
  const { turning, tryIt, turn, markTurn } = turnOf(item, session, set);
  // `hidden` would move the focus; an untouched slider keeps the button's place.
  const mark = () => {
    const value = session.values()[item.id];
    back.classList.toggle("is-idle", value === item.typed);
    amount.textContent = own(item, value);
    say(said);
  };
  // One line, whatever it says: no control below it moves.
  let said = "";
  const say = (text) => {
    said = text;
    const value = session.values()[item.id];
    output.textContent = stopOf(item, value) || (Number(text.replace("× ", "")) === value ? "" : text); // said once
    output.title = output.textContent;
    input.setAttribute("aria-valuetext", text);
    markTurn();
  };
  input.value = values[item.id];
  mark();
  const field = html(
    "div",
    { class: "slider" },
    html("div", { class: "slider-head" }, html("label", { for: id, title: item.help }, words(item.label)), amount, back),
    html("div", { class: "slider-head" }, output, tryIt),
    html("div", { class: "range" }, input, place(markAt("typed-mark"), item, item.typed), turning),
    item.help ? html("p", { class: "visually-hidden", id: `${id}-help` }, item.help) : null,
  );
  return { id: item.id, field, say, turn };
}

// Where the verdict changes, at the values of the other sliders: a mark, and a button that tries it.
function turnOf(item, session, set) {
  const turning = markAt("turn-mark");
  const tryIt = button("Try it", () => set(turned.value), { id: `turn-${item.id}`, class: "back turn" });
  let turned = null;
  const turn = (found) => {
    turned = found && { ...found, others: session.values() };
    markTurn();
  };
  const markTurn = () => {
    const stays = turned && isSame({ ...session.values(), [item.id]: null }, { ...turned.others, [item.id]: null });
    for (const one of [turning, tryIt]) one.classList.toggle("is-idle", !stays);
    if (!stays) return;
    place(turning, item, turned.value);
    tryIt.textContent = `${turned.verdict.split(" ")[0]} at ${own(item, turned.value)}`;
    tryIt.title = `Try it. At ${own(item, turned.value)} the verdict is ${turned.verdict}; at ${own(item, turned.before)} it is not. Values beyond are not tried.`;
  };
  return { turning, tryIt, turn, markTurn };
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

// Why a slider goes no further, where it is at such an end.
function stopOf({ least, greatest, stops }, value) {
  if (value <= least) return stops.least ?? "";
  return value >= greatest ? (stops.greatest ?? "") : "";
}

function choice(item, values, session) {
  const name = `choice-${item.id}`;
  const options = item.options.map(({ value, label, why_not: why }) =>
    html("option", { value, selected: value === values[item.id], disabled: Boolean(why), title: why }, label),
  );
  const select = html("select", { id: name, title: item.help, on: { change: () => session.set({ [item.id]: select.value }) } }, options);
  const printed = html("p", { class: "note print-only" });
  const field = html("div", { class: "field" }, html("label", { for: name }, words(item.label)), select, printed);
  const say = () => {
    printed.textContent = select.selectedOptions[0].label;
  };
  return { id: item.id, field, say };
}

// Some sliders act only beside a choice.
function depend(sliders, parts, values) {
  for (const { id, with_choice: needed } of sliders) {
    if (!needed) continue;
    const acts = Object.entries(needed).every(([key, value]) => values[key] === value);
    for (const control of parts.find((part) => part.id === id).field.querySelectorAll("input, button")) control.disabled = !acts;
  }
}
