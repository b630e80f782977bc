// The headline, which stays in sight: the verdict, the check that governs with its D/C, from where on it
// would be another one, what to do next, and the causes folded below it.

import { html, note, parsed, replace, words } from "./make.js";
import { said } from "./changes.js";
import { withBefore } from "./results.js";
import { onChange } from "./session.js";

const FORMER = "The values below are from before the change.";
const EASING = ["friction", "clearance", "slope", "intensity", "s_ds"]; // in the order in which they are told

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
    replace(worst, shows === "former" || !answer ? null : nodes(answer.html.worst));
    const [ratio, was] = [worst, parsed("p", project.answer?.html.worst ?? "")].map((one) => one.querySelector("strong"));
    if (ratio && ratio.dataset.of === was?.dataset.of) withBefore(ratio, was);
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
    return { told: `No verdict: ${[why, ...reasons].join(": ")}.`, causes: html("ul", {}, reasons.map((text) => html("li", {}, words(text)))), count: "Reasons" };
  }
  if (phase === "rest") {
    const { count, html: drawn } = answer;
    return { told: nodes(drawn.headline), causes: nodes(drawn.reasons), count: `Causes and conditions: ${count}` };
  }
  const isFormer = shows !== "provisional";
  const moving = isFormer ? `Computing; no verdict yet. ${FORMER}` : "Provisional values while you move the slider; no verdict.";
  const settling = `Running the full analysis. ${isFormer ? FORMER : "The values below are provisional."}`;
  const told = [html("strong", { class: "tag is-provisional" }, "Provisional"), " ", phase === "moving" ? moving : settling];
  return { told, causes: note(isFormer ? FORMER : answer.model_text), count: "Details" };
}

function nodes(text) {
  return [...parsed("div", text).childNodes];
}

// Where the verdict changes, of each slider that was searched: `OK from μ 0.46`.
function turnedWords({ turned, project, values }) {
  const found = EASING.flatMap((id) => (turned[id] ? [[turned[id], project.sliders.find((item) => item.id === id)]] : []));
  if (found.length === 0) return null;
  const [verdict] = found[0][0].verdict.split(" ");
  return words(`${verdict} from ${found.map(([{ value }, item]) => said(item, value, values)).join(", or ")}.`);
}
