// Starts the page and joins its parts. Read session.js for what happens when a slider moves.

import { createApi, reload } from "./api.js";
import { changes, fromFragment, isSame, toFragment } from "./changes.js";
import { named, showErrors, showSteps, warnings } from "./heading.js";
import { button, html, replace } from "./make.js";
import { mountDrawing, mountMotions } from "./offers.js";
import { mountTakeaway } from "./package.js";
import { mountPlan } from "./plan.js";
import { mountCauses, showBars, showNoVerdict, showProvisional, showTable, showVerdict } from "./results.js";
import { saveDrawing } from "./saving.js";
import { createSession } from "./session.js";
import { mountSliders } from "./sliders.js";
import { mountTabs } from "./tabs.js";
import { createTurns } from "./turns.js";
import { mountUpload } from "./upload.js";
import { createViews } from "./views.js";

const FORMER = "The values below are those before the change.";

const part = (id) => document.getElementById(id);
const announce = (sentence) => {
  part("live").textContent = sentence;
};

const plan = mountPlan(part("plan-drawing"), {
  ask: () => session.again(),
  picked: pickOnPlan,
  said: part("plan-said"),
  zooms: ["zoom-in", "zoom-out", "zoom-fit"].map(part),
});
const api = createApi(announce, plan.room);
const session = createSession(api.assess, show, failAnswer);
const views = createViews(api);
const turns = createTurns(api.verdict, (id, found) => {
  turned[id] = found && { ...found, others: session.values() };
  drawControls();
});
const takeaway = mountTakeaway(
  {
    make: part("make-package"),
    workbook: part("save-workbook"),
    copy: part("copy-link"),
    status: part("package-status"),
  },
  api,
  { values: session.values, words: (values) => changes(values, state), fail, forget: hideError },
);
const motions = mountMotions(part("no-motions"), api, { open: opening, fail });
const offerDrawing = mountDrawing(part("drawing"), api, { open: opening, filled: putBack, fail });

let dropped = null; // the files of the last upload
let state = null; // of the project that is open
let answer = null; // the last that was shown, with the values that it is of
let controls = null;
let turned = {}; // where the verdict changes, by slider
const chosen = { array: null, motion: null };
let onPlan = null; // the key of what is picked: an array, an object, or # and the number of a clearance

mountCauses(part("verdict"));
mountTabs(part("tabs"), (panel) => views.open(panel));
mountUpload({ zone: part("drop"), files: part("files"), folder: part("folder") }, { begin: showBusy, take, fail });
part("back").addEventListener("click", showProject);
part("example").addEventListener("click", () => opening(api.example, { words: "Opening the example …" }));
part("add-clearances").addEventListener("click", () => opening(api.addClearances, { valuesOf: session.values }));
for (const key of ["array", "motion"]) part(key).addEventListener("change", ({ target }) => choose({ [key]: target.value }));
document.querySelector(".skip").addEventListener("click", (event) => {
  event.preventDefault(); // else it would take the values out of the address
  part("results").focus();
});
part("undo").addEventListener("click", () => history.back());
part("reset-all").addEventListener("click", () => setAll({}));
for (const kind of ["png", "svg"]) part(`save-${kind}`).addEventListener("click", () => saveDrawing(document.querySelector("[role=tabpanel]:not([hidden])"), kind, state.project.name).catch(fail));
addEventListener("keydown", (event) => {
  if (event.key !== "z" || !(event.ctrlKey || event.metaKey) || part("undo").disabled) return;
  event.preventDefault();
  history.back();
});
// Each values at rest are an entry of the history; before the first of the project Back stays in it.
addEventListener("popstate", ({ state: entry }) => {
  if (!state?.project) return;
  if (!entry) history.replaceState({ depth: 0 }, ""); // the address was edited
  if (entry?.depth < 0 || !isOfProject()) history.forward();
  else setAll(fromFragment(location.hash, state.sliders, state.choices));
});
history.replaceState({ depth: -1 }, "");
history.pushState({ depth: 0 }, "");
const tabs = new BroadcastChannel("roofslip");
tabs.addEventListener("message", ({ data: { opened, name } }) => {
  if (!state?.project) return;
  hideError();
  if (opened === state.opened) return;
  replace(part("error"), html("p", {}, `Another tab has opened ${name}. This page still shows ${state.project.name}, which no longer answers.`), button("Reload", reload));
  part("error").hidden = false;
});
opening(() => api.enter().then(api.state), { valuesOf: fromAddress });

function take(files) {
  dropped = files;
  // What is offered is for the workbook before.
  motions.offer(null);
  offerDrawing(null, null);
  opening(() => api.upload(files), { words: `Sending and checking ${files.length} file${files.length === 1 ? "" : "s"} …` });
}

// What is sent again has the workbook as it was filled in.
function putBack({ name, blob }) {
  const [workbook] = dropped.filter(({ path }) => path.split("/").at(-1) === name).toSorted((a, b) => a.path.split("/").length - b.path.split("/").length);
  dropped = dropped.map((one) => (one === workbook ? { ...one, file: blob } : one));
}

function showBusy(text) {
  part("busy").textContent = text;
  part("busy").hidden = text === "";
}

// Fetch a state and show it: the example, an upload, or what is open, with values upon those of its
// workbook where something gives them.
async function opening(fetched, { valuesOf = () => ({}), words = "" } = {}) {
  showBusy(words);
  document.body.setAttribute("aria-busy", "true");
  hideError();
  try {
    const next = await fetched();
    if (!next) return; // something else is being opened since, which has its own words
    showBusy("");
    open(next, valuesOf);
  } catch (error) {
    showBusy("");
    fail(error);
  }
  document.body.removeAttribute("aria-busy");
}

function open(next, valuesOf) {
  motions.offer(next.lacks[0] === "motions" ? dropped : null);
  offerDrawing(dropped, dropped && next.drawing);
  showSteps(next);
  if (next.problems.length > 0) {
    showErrors(next, state);
    return;
  }
  state = next;
  part("other-project").hidden = true;
  const values = valuesOf();
  showProject();
  replace(part("warnings"), warnings(state.warnings));
  fillSelects();
  controls = mountSliders(part("controls"), state, session);
  history.replaceState({ depth: 0 }, "", address(values));
  // oxlint-disable-next-line unicorn/require-post-message-target-origin -- a channel has none
  tabs.postMessage({ opened: state.opened, name: state.project.name });
  setAll(values);
  takeaway.open(state.package);
}

// What an address has belongs to the project that it names. One that names another has nothing to give.
function fromAddress() {
  if (isOfProject()) return fromFragment(location.hash, state.sliders, state.choices);
  if (location.pathname !== "/" || location.hash) {
    part("other-project-name").textContent = state.project.name;
    part("other-project").hidden = false;
  }
  return {};
}

function isOfProject() {
  return location.pathname === `/p/${state.project.id}/`;
}

function address(values) {
  const fragment = toFragment(values, [...state.sliders, ...state.choices]);
  return `/p/${state.project.id}/${fragment && `#${fragment}`}`;
}

function showProject() {
  onPlan = null;
  const { name, file, sha256, is_example: isExample } = state.project;
  part("problems").hidden = true;
  part("workspace").hidden = false;
  part("welcome").hidden = !isExample;
  named(name, file, html("span", { class: "screen-only", title: sha256 }, `, SHA-256 ${sha256.slice(0, 12)}`), html("span", { class: "print-only" }, `, SHA-256 ${sha256}`));
}

// Take values upon those of the workbook.
function setAll(others) {
  const typed = Object.fromEntries([...state.sliders, ...state.choices].map((one) => [one.id, one.typed]));
  const values = { ...typed, ...others };
  turned = {};
  session.load(values);
  if (state.answer && isSame(values, typed)) show({ phase: "rest", answer: state.answer, values });
  else session.rest();
}

function fillSelects() {
  for (const [key, ids] of Object.entries({ array: state.views.arrays, motion: state.views.motions })) {
    chosen[key] = ids[0];
    replace(part(key), ids.map((id) => html("option", { value: id }, id)));
  }
}

// The session reports: a slider moves, the full model runs, or an answer came.
function show({ phase, answer: next, values }) {
  if (phase === "rest") enterValues(); // first: the browser lays out at once what has changed before it
  document.body.dataset.phase = phase;
  part("changed").textContent = `With ${changes(session.values(), state)}`;
  part("changed").title = part("changed").textContent;
  if (next) {
    hideError();
    showAnswer({ ...next, values }, phase === "rest" ? "final" : "provisional");
  } else if (answer?.verdict) {
    announce("");
    keepFormer();
  }
  drawControls();
  if (phase === "rest") showRest();
  else showMoving(phase, next);
}

// Beside the controls is what the values of the tables amount to, unless the tables are of other values.
function drawControls() {
  const values = session.values();
  const isFormer = document.body.dataset.values === "former";
  const isCurrent = !isFormer && Boolean(answer) && isSame(answer.values, values);
  controls.draw(values, { shown: answer?.shown ?? {}, isCurrent, turned: isFormer ? {} : turned });
}

// What the values shown are: final, provisional, or former, which are not of what is asked now.
function showAnswer(next, values) {
  document.body.dataset.values = values;
  answer = next;
  plan.show(answer.plan, answer.tips);
  showPicked();
}

// The values stay, and the look of the page hides their verdicts: drawn anew they would hold up what
// is asked.
function keepFormer() {
  document.body.dataset.values = "former";
  answer = { ...answer, verdict: null };
  plan.dropVerdicts();
}

function showPicked() {
  showTable(part("arrays"), answer.arrays, { pick: pickOnPlan, picked: chosen.array, key: ([name]) => name.text });
  showTable(part("clearances"), answer.clearances, { pick: pickOnPlan, picked: onPlan, key: ([count]) => count?.text && `#${count.text}`, named: 1 });
  if (chosen.array in answer.bars.arrays) showBars(part("bars"), answer.bars, chosen.array); // not of a project that was open before
}

function showMoving(phase, next) {
  part("other-project").hidden = true;
  turns.stop();
  const isFormer = document.body.dataset.values === "former";
  views.moving();
  takeaway.compare();
  if (phase === "settling") showProvisional(part("verdict"), "The full model is running.", isFormer ? FORMER : "The values below are not final.");
  else if (next) showProvisional(part("verdict"), "Values while a slider moves; no verdict.", next.model_text);
  else if (isFormer) showProvisional(part("verdict"), "The values are being computed; no verdict.", FORMER);
}

function enterValues() {
  const next = address(session.values());
  if (next !== location.pathname + location.hash) history.pushState({ depth: history.state.depth + 1 }, "", next);
}

function showRest() {
  showVerdict(part("verdict"), answer);
  if (!answer.pending) announce(`${answer.verdict.text}. ${answer.line}. ${answer.verdict_text} ${answer.model_text}`);
  part("undo").disabled = history.state.depth < 1;
  part("reset-all").disabled = location.hash === "";
  takeaway.compare();
  views.update(scene());
  turns.start(state.sliders, session.values(), answer.verdict.look === "ng");
}

function pickOnPlan(key) {
  onPlan = key;
  plan.pick(key);
  choose(state.views.arrays.includes(key) ? { array: key } : {});
}

function scene() {
  return { values: session.values(), ...chosen };
}

function choose(changed) {
  Object.assign(chosen, changed);
  part("array").value = chosen.array;
  part("motion").value = chosen.motion;
  showPicked();
  if (document.body.dataset.phase === "rest") views.update(scene());
}

// The values have no answer: refused with their problems, or the server did not answer.
function failAnswer(error, moving) {
  const reasons = (error.problems ?? []).map(({ text }) => text);
  const isRefused = reasons.length > 0;
  if (moving && !isRefused) return; // the full model is asked next, and tells
  Object.assign(document.body.dataset, { phase: "failed", values: "former" });
  drawControls();
  const unanswered = error.isUnreached ? "the server does not answer" : "the server gave no answer";
  showNoVerdict(part("verdict"), isRefused ? "these values have no answer" : unanswered, reasons);
  if (isRefused) announce(`No verdict. ${error.message}`);
  // While another project is opened here, its answer replaces what was asked of the last one.
  else if (!document.body.hasAttribute("aria-busy")) fail(error, "Try again", session.rest);
}

function fail(error, what = "Close", act = hideError) {
  if (error.lacksKey) {
    askForAddress();
    return;
  }
  const [label, action] = error.needsReload ? ["Reload", reload] : [what, act];
  replace(part("error"), html("p", {}, error.message), button(label, action));
  part("error").hidden = false;
}

// Nothing is answered without a key: all that the page can do is say how to get one.
function askForAddress() {
  for (const id of ["workspace", "welcome", "problems", "no-motions", "steps", "drawing"]) part(id).hidden = true;
  part("no-key").hidden = false;
  named("This tab needs a new address");
}

function hideError() {
  part("error").hidden = true;
}
