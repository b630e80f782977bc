// The headline, which stays in sight: the verdict, the check that governs with its D/C, from where on it
// would be another one, what to do next, and the causes folded below it.

import { html, note, replace, words } from "./make.js";
import { said } from "./changes.js";
import { onChange } from "./session.js";
import { term } from "./terms.js";

const FULL_BAR = 1.5; // D/C at the end of its bar
const FORMER = "The values below are from before the change.";
const EASING = ["friction", "clearance", "slope", "intensity", "s_ds"]; // in the order in which they are told

/** Return the tag of a verdict, with the look that it has in the package; a dash while there is none. */
export function tag(verdict) {
  return verdict ? html("strong", { class: `tag is-${verdict.look}` }, verdict.text) : html("span", { class: "note" }, "–");
}

/** Draw the headline in an element; `announce` says a sentence to a screen reader. */
export function mountHeadline(element, session, announce) {
  const [more, listed, line, worst, enough] = ["#causes", ".reasons", ".verdict-line", ".worst", ".enough"].map((one) => element.querySelector(one));
  const open = (isOpen) => more.setAttribute("aria-expanded", String(isOpen));
  more.addEventListener("click", () => open(more.ariaExpanded !== "true"));
  element.addEventListener("keydown", ({ key }) => key === "Escape" && open(false));

  session.draws(onChange(["answer", "phase", "shows", "failure", "turned"], (state) => {
    const { answer, phase, shows, project } = state;
    if (!project) return;
    element.ariaBusy = phase === "rest" && answer.pending ? "true" : null;
    const { told, causes, count } = parts(state);
    replace(line, told);
    line.title = (phase === "rest" && answer.line) || line.textContent.trim();
    more.textContent = count;
    replace(listed, causes);
    replace(worst, shows === "former" || !answer?.worst ? null : ratioOf(answer.worst, project.answer?.worst));
    const next = phase === "rest" ? [turnedWords(state), answer.next && ["Next: ", words(answer.next)]] : [];
    replace(enough, next.filter(Boolean).map((one) => html("span", {}, one)));
    enough.title = enough.textContent;
  }));
  session.draws(onChange(["answer", "phase", "failure"], ({ answer, phase, failure }) => {
    if (phase === "failed" && failure.problems?.length) announce(`No verdict. ${failure.message}`);
    else if (phase !== "rest") announce("");
    else if (!answer.pending) announce(`${answer.verdict.text}. ${answer.line}. ${answer.verdict_text} ${answer.model_text}`);
  }));
}

// What is told on the line, what is listed below it, and how the button names that.
function parts({ answer, phase, shows, failure }) {
  if (phase === "failed") {
    const reasons = (failure.problems ?? []).map(({ text }) => text);
    const unanswered = failure.isUnreached ? "the server does not answer" : "the server gave no answer";
    const why = reasons.length > 0 ? "these values have no answer" : unanswered;
    return { told: `No verdict: ${[why, ...reasons].join(": ")}.`, causes: list(reasons.map((text) => ({ text }))), count: "Reasons" };
  }
  if (phase === "rest") {
    const { verdict, worst, line, verdict_text: text, reasons, pending, model_text: model } = answer;
    const count = reasons.filter(({ level }) => level !== "remedy").length;
    return { told: [tag(verdict), " ", verdict.look === "provisional" ? line : worst && words(worst.text)], causes: [html("p", {}, text), list(reasons), pending && note(pending), note(model)], count: `Causes and conditions: ${count}` };
  }
  const isFormer = shows !== "provisional";
  const moving = isFormer ? `Computing; no verdict yet. ${FORMER}` : "Provisional values while you move the slider; no verdict.";
  const settling = `Running the full analysis. ${isFormer ? FORMER : "The values below are provisional."}`;
  const told = [tag({ look: "provisional", text: "Provisional" }), " ", phase === "moving" ? moving : settling];
  return { told, causes: note(isFormer ? FORMER : answer.model_text), count: "Details" };
}

// The check that governs, with a bar of its D/C and what it was for the workbook.
function ratioOf({ text, ratio, ratio_text: told }, before) {
  const bar = html("span", { class: `dc-bar${(ratio ?? FULL_BAR) > 1 ? " is-over" : ""}`, "aria-hidden": "true" }, html("span", {}), html("i", {}));
  bar.style.setProperty("--share", share(ratio ?? FULL_BAR)); // of no capacity it is infinite
  bar.style.setProperty("--one", share(1));
  const was = before && before.ratio_text !== told && before.text === text ? html("span", { class: "before" }, `${before.ratio_text} → `) : null;
  if (!told) return null;
  return [bar, html("span", { class: "worst-ratio numbers" }, html("small", {}, term("D/C")), " ", was, html("strong", {}, told))];
}

function share(ratio) {
  return Math.min(ratio / FULL_BAR, 1);
}

// Where the verdict changes, of each slider that was searched: `OK from μ 0.46`.
function turnedWords({ turned, project, values }) {
  const found = EASING.flatMap((id) => (turned[id] ? [[turned[id], project.sliders.find((item) => item.id === id)]] : []));
  if (found.length === 0) return null;
  const [verdict] = found[0][0].verdict.split(" ");
  return words(`${verdict} from ${found.map(([{ value }, item]) => said(item, value, values)).join(", or ")}.`);
}

function list(reasons) {
  return reasons.length > 0 ? html("ul", { "aria-label": "Reasons" }, reasons.map(reasonItem)) : null;
}

function reasonItem({ level, text, parts: joined }) {
  const named = level ? [html("strong", { class: `level is-${level.toLowerCase()}` }, level), " "] : null;
  const told = [named, words(text)];
  if (!joined?.length) return html("li", {}, told);
  return html("li", {}, html("details", {}, html("summary", {}, told), html("ul", {}, joined.map((one) => html("li", {}, words(one))))));
}
