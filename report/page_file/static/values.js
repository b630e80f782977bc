// Values of the package at another friction, intensity or clearance. No verdict, and no rule: factors, floors,
// statistics and roundings are those that the results state.

import { html, note, replace, update } from "./make.js";
import { measured, number } from "./reading.js";

const MU_DIGITS = 4; // of a coefficient, as in the workbook
const REACH_M = 0.6; // of the slider of clearances, to each side
const STEPS = 24;
const SLACK = 1e-9; // of a step of rounding: what is only rounding error changes no digit

const NOTES = "Computed here, without a verdict: limits and conditions need a package of its own. S_DS stays, and with it the prescriptive displacement and the floor.";

/**
 * Return the arrays and clearances whose values follow from runs alone. A peer review, which removes the
 * floor, is of the values of the package.
 */
export function movable({ arrays, clearances }) {
  const free = arrays.filter(({ route, design_permitted: isPermitted, design_m: design, floor_m: floor, friction }) => {
    const isMonotone = friction.mu_fast >= friction.mu_slow && friction.mu_static === friction.mu_slow;
    return route === "analysis" && isPermitted && design !== null && floor > 0 && isMonotone;
  });
  const beside = (gap) => arrays.filter(({ id }) => id === gap.array || id === gap.object);
  const between = clearances.map((gap, k) => ({ ...gap, number: k + 1, beside: beside(gap).map(({ id }) => id) }));
  return { arrays: free, clearances: between.filter((gap) => beside(gap).every((array) => free.includes(array))) };
}

/** Return what follows from runs at some values: of each array its mean and design, of each clearance its ratio. */
export function followsFrom({ arrays, clearances }, made, { clearance_m: more = 0 }) {
  const designs = new Map();
  const of = arrays.map((array) => {
    const own = made.filter((one) => one.array === array).map(({ run, done }) => ({ motion: run.motion, prd: done.rests ? done.prd_m : Number.NaN }));
    const motions = [...new Set(own.map(({ motion }) => motion))];
    const prds = motions.map((id) => largest(own.filter(({ motion }) => motion === id).map(({ prd }) => prd)));
    const mean = prds.reduce((sum, prd) => sum + prd, 0) / prds.length;
    const design = largest([array.analysis_factor * (array.takes_largest ? largest(prds) : mean), array.floor_m]);
    designs.set(array.id, design);
    return { array, mean_prd_m: mean, design_m: design };
  });
  const gaps = clearances.map((gap) => {
    const required = largest([gap.factor * largest(gap.beside.map((id) => designs.get(id))), gap.minimum_m]);
    const provided = Math.max(gap.provided_m + more, 0);
    return { gap, required_m: required, provided_m: provided, demand_capacity: required / provided };
  });
  return { arrays: of, gaps };
}

const largest = (all) => (all.some(Number.isNaN) ? Number.NaN : Math.max(...all));

/** Return a factor on friction as the coefficients of an array, rounded as the workbook has them. */
export function withFriction(friction, factor) {
  const by = (mu) => (factor === 1 ? mu : Number((mu * factor).toFixed(MU_DIGITS)));
  return { ...friction, mu_slow: by(friction.mu_slow), mu_fast: by(friction.mu_fast), mu_static: by(friction.mu_static) };
}

/** Return a value in a unit as the results print that of their key: up where it is required, down where provided. */
export function printedAs(key, value, { si, symbol, decimals }, { rounded_up: up, rounded_down: down }) {
  if (Number.isNaN(value)) return "none";
  const size = 10 ** decimals;
  const steps = (value / si) * size;
  if (up.includes(key)) return `${number(Math.ceil(steps - SLACK) / size, decimals)} ${symbol}`.trimEnd();
  return `${number(down.includes(key) ? Math.floor(steps + SLACK) / size : value / si, decimals)} ${symbol}`.trimEnd();
}

/** Return the units of lengths, the preferred one first. */
export function unitsOf({ printed: { lengths } }) {
  return lengths.map(({ size_m: si, ...rest }) => ({ ...rest, si }));
}

/** Mount sliders and tables in an element; `moved` is called with the values of the sliders. */
export function mountValues(element, api, results, moved) {
  const free = movable(results);
  if (free.arrays.length === 0) return false;
  const { printed } = results;
  const [unit] = unitsOf(results);
  const values = { friction: 1, intensity: 1, clearance_m: 0 };
  let asked = 0;

  const ratio = { si: 1, symbol: "", decimals: printed.ratio_decimals };
  const cells = (keys, before, now) => keys.map((key) => {
    const [first, second] = [before, now].map((of) => printedAs(key, of[key] ?? Number.NaN, key === "demand_capacity" ? ratio : unit, printed));
    return html("td", {}, first === second ? first : [`${first} → `, html("strong", {}, second)]);
  });

  const state = html("p", { class: "note", "aria-live": "polite" });
  const tables = [html("table"), html("table")];
  const show = ({ arrays, gaps }) => {
    const ofArrays = arrays.map(({ array, ...now }) => rowOf(array.id, cells(["mean_prd_m", "design_m"], array, now)));
    const ofGaps = gaps.map(({ gap, ...now }) => rowOf(`${gap.number}: ${gap.array} to ${gap.object}`, cells(["provided_m", "required_m", "demand_capacity"], gap, now)));
    update(tables[0], table(["Array", "Mean PRD", "Design displacement"], ofArrays));
    update(tables[1], table(["Clearance", "Provided", "Required", "D/C"], ofGaps));
  };

  async function compute() {
    asked += 1;
    const mine = asked;
    element.ariaBusy = "true";
    const made = await api.runs(values, () => mine === asked);
    if (made === null) return;
    show(followsFrom(free, made, values));
    element.ariaBusy = "false";
    state.textContent = isTyped() ? "At the values of the package." : NOTES;
    moved(values);
  }

  const isTyped = () => values.friction === 1 && values.intensity === 1 && values.clearance_m === 0;
  const step = REACH_M / STEPS;
  const sliders = [
    // No more than the tests give, which the workbook refuses.
    slider("Friction, all arrays", [0.5, 1, 0.01], (factor) => { values.friction = factor; }, (factor) => `× ${factor.toFixed(2)}`),
    // No less than the target, which the package compares the motions with.
    slider("Intensity of the motions", [1, 2, 0.01], (factor) => { values.intensity = factor; }, (factor) => `× ${factor.toFixed(2)}`),
    slider("Every separation provided", [-STEPS, STEPS, 1], (count) => { values.clearance_m = count * lengthOf(step, unit); }, (count) => `${count < 0 ? "−" : "+"} ${measured(Math.abs(count) * lengthOf(step, unit), unit)}`),
  ];

  function slider(label, [low, high, by], set, say) {
    const typed = low < 0 ? 0 : 1;
    const said = html("span", {}, say(typed));
    const take = (value) => {
      set(value);
      said.textContent = say(value);
      input.setAttribute("aria-valuetext", say(value));
    };
    const input = html("input", { type: "range", min: low, max: high, step: by, value: typed, "aria-label": label, on: { input: ({ target }) => { take(Number(target.value)); compute(); } } });
    const reset = () => { input.value = typed; take(typed); };
    return { reset, field: html("label", { class: "slider" }, html("span", {}, label, " ", said), input) };
  }

  const back = html("button", { type: "button", class: "button", on: { click: () => { for (const { reset } of sliders) reset(); compute(); } } }, "As in the package");
  replace(element, html("div", { class: "sliders" }, sliders.map(({ field }) => field), back), state, html("div", { class: "halves" }, tables.map((shown) => html("div", { class: "whole" }, shown))));
  if (free.arrays.length < results.arrays.length) element.append(note("Left out, with the clearances beside them: arrays by the prescriptive procedure, without a floor, or with friction that falls with velocity."));
  compute();
  return true;
}

function rowOf(name, cells) {
  return html("tr", {}, html("th", { scope: "row" }, name), cells);
}

// A round length near a step: whole inches, or 25 mm.
function lengthOf(step, { si }) {
  return Math.round(step / si) * si;
}

function table(heads, rows) {
  const head = html("tr", {}, heads.map((text) => html("th", { scope: "col" }, text)));
  return html("table", {}, html("thead", {}, head), html("tbody", {}, rows));
}
