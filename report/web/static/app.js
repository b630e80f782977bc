// Starts the page and joins its parts. Read session.js for the state that they are drawn from.

import { createApi } from "./api.js";
import { changes, fromFragment, toAddress } from "./changes.js";
import { mountHeadline } from "./headline.js";
import { named, showErrors, showProject, showSteps, showTables, typedCells } from "./heading.js";
import { button, html, parsed, replace } from "./make.js";
import { mountDrawing, mountMotions } from "./offers.js";
import { mountTakeaway } from "./package.js";
import { mountPlan } from "./plan.js";
import { mountResults } from "./results.js";
import { save, saveDrawing } from "./saving.js";
import { createSession, onChange } from "./session.js";
import { mountSliders } from "./sliders.js";
import { mountTerms } from "./terms.js";
import { createTurns } from "./turns.js";
import { besideWorkbook, mountUpload } from "./upload.js";
import { mountTabs, mountViews } from "./views.js";

const part = (id) => document.getElementById(id);
const announce = (sentence) => {
  part("live").textContent = sentence;
};

const api = createApi(announce, () => plan.room());
// While another project is opened here, its answer replaces what was asked of the last one.
const session = createSession(api.assess, (error) => document.body.hasAttribute("aria-busy") || fail(error, "Try again", session.rest));
const { state } = session;
let dropped = null; // the files of the last upload
let awaited = null; // the address of a project that is not open
let drawControls = null; // of the project that is open
let sent = {}; // of what was typed into the fields of a workbook, by cell
let isEdited = false; // whether that changes the project that is open
let faulty = []; // what these cells had, such as the paths of records

const plan = mountPlan(part("plan-drawing"), session, { said: part("plan-said"), zooms: ["zoom-in", "zoom-out", "zoom-fit"].map(part) });
const turns = createTurns(api.verdict, (id, found, others) => session.set({ turned: { ...state.turned, [id]: found && { ...found, others } } }));
const takeaway = mountTakeaway(
  { make: part("make-package"), workbook: part("save-workbook"), copy: part("copy-link"), status: part("package-status"), told: part("taken") },
  api,
  { values: () => state.values, words: (values) => changes(values, state.project), fail, forget: hideError },
);
const motions = mountMotions(part("no-motions"), api, { open: opening, fail });
const offerDrawing = mountDrawing(part("drawing"), api, { open: opening, filled: putBack, fail });

mountHeadline(part("verdict"), session, announce);
mountResults({ arrays: part("arrays"), bars: part("bars"), clearances: part("clearances") }, session, plan.pick);
mountTerms(part("tip"));
mountTabs(part("tabs"), session);
mountViews(session, api);
mountUpload({ zone: part("drop"), files: part("files"), folder: part("folder") }, { begin: showBusy, take, fail });
session.draws(({ phase, shows }) => Object.assign(document.body.dataset, { phase, values: shows }));
session.draws(onChange(["project"], showControls));
session.draws((now) => now.project && drawControls(now));
session.draws(onChange(["phase", "values"], enterAddress));
session.draws(onChange(["values"], ({ values, project }) => {
  takeaway.compare();
  part("changed").textContent = project ? `With ${changes(values, project)}` : "";
  part("changed").title = part("changed").textContent;
}));
session.draws(onChange(["array", "motion"], ({ array, motion }) => {
  part("array").value = array;
  part("motion").value = motion;
}));
session.draws(onChange(["answer"], ({ answer }) => answer?.verdict && hideError()));
session.draws(onChange(["picked"], ({ picked }) => {
  part("for-all").hidden = !picked;
}));
session.draws(onChange(["phase", "answer"], findTurns));

part("back").addEventListener("click", () => {
  dropped = state.project.files;
  offer(state.project);
  showProject(state);
});
part("new").addEventListener("click", () => startNew().catch(fail));
part("edit").addEventListener("click", () => editTables().catch(fail));
part("check").addEventListener("click", () => fillCells().catch(fail));
part("save-filled").addEventListener("click", () => fillCells().then(saveFilled).catch(fail));
part("example").addEventListener("click", () => {
  dropped = null;
  opening(api.example, { words: "Opening the example …" });
});
part("add-clearances").addEventListener("click", () => changing(api.addClearances, { valuesOf: () => state.values }).catch(fail));
for (const key of ["array", "motion"]) part(key).addEventListener("change", ({ target }) => session.set({ [key]: target.value }));
document.querySelector(".skip").addEventListener("click", (event) => {
  event.preventDefault(); // else it would take the values out of the address
  part("results").focus();
});
part("undo").addEventListener("click", () => history.back());
part("reset-all").addEventListener("click", () => session.restore({}));
for (const kind of ["pointerup", "pointercancel"]) addEventListener(kind, session.release); // wherever the pointer is by then
part("for-all").addEventListener("click", () => plan.pick(null));
for (const kind of ["png", "svg"]) part(`save-${kind}`).addEventListener("click", () => saveDrawing(document.querySelector("[role=tabpanel]:not([hidden])"), kind, state.project.name).catch(fail));
addEventListener("keydown", (event) => {
  if (event.key !== "z" || !(event.ctrlKey || event.metaKey) || part("undo").disabled || event.target.matches("input[type=number], input[type=text]")) return;
  event.preventDefault();
  history.back();
});
// The address names the project and its values: Back and Forward restore both.
addEventListener("popstate", () => {
  if (!state.project) return;
  if (isAddressed(state.project)) session.restore(fromFragment(location.hash, state.project));
  else fromAddress();
});
fromAddress(() => api.enter());

// Show the project of the address, or what was opened last where that is not open here.
function fromAddress(begin = async () => {}) {
  const [, id = ""] = /^\/p\/(\w+)\//.exec(location.pathname) ?? [];
  const fragment = location.hash;
  dropped = null;
  return opening(() => begin().then(() => api.state(id)), {
    valuesOf: (project) => {
      awaited = id && project.id !== id ? { id, fragment } : null;
      return id === project.id ? fromFragment(fragment, project) : {};
    },
  });
}

function take(given) {
  const files = besideWorkbook(given, dropped, faulty);
  dropped = files;
  // What is offered is for the workbook before.
  motions.offer(null);
  offerDrawing(null, null);
  opening(() => api.upload(files), { words: `Uploading and checking ${files.length} file${files.length === 1 ? "" : "s"} …` });
}

// What is sent again has the workbook as it was filled in.
function putBack({ name, blob }) {
  const [workbook] = dropped.filter(({ path }) => path.split("/").at(-1) === name).toSorted((a, b) => a.path.split("/").length - b.path.split("/").length);
  dropped = dropped.map((one) => (one === workbook ? { ...one, file: blob } : one));
  if (!part("workspace").hidden) state.project.files = dropped;
}

// The project that is open is replaced by a copy of it, which is what is sent again.
async function changing(fetched, options) {
  await opening(fetched, options);
  if (dropped && !part("workspace").hidden) putBack(await api.workbook({}));
}

// A workbook without inputs, in the units of the country.
async function startNew() {
  const { name, blob } = await api.blank(navigator.language === "en-US" ? "US" : "SI");
  take([{ file: new File([blob], name), path: name }]);
}

// Show the tables of the project that is open, and what is typed into them then.
async function editTables() {
  showTables((await api.tables()).html);
  [part("save-filled").hidden, isEdited, sent] = [true, true, {}];
}

// Check the workbook with what is typed in it, and was before: in a zip the workbook stays as it was. With
// errors, a change of what is open is still one.
async function fillCells() {
  const [cells, wasEdited] = [{ ...sent, ...typedCells() }, isEdited];
  let next = null;
  const check = async () => {
    next = await (isEdited ? api.edit(cells) : api.fillCells(dropped, cells));
    if (next?.filled) putBack(next.filled); // before it is shown, and may be checked again
    return next;
  };
  await (isEdited ? changing : opening)(check, { words: "Checking the workbook …" });
  if (next) [isEdited, sent] = [wasEdited, cells];
}

async function saveFilled() {
  const { blob, name } = await api.filledWorkbook();
  save(blob, name);
}

function showBusy(text) {
  part("busy").textContent = text;
  part("busy").hidden = text === "";
}

// Fetch a project and show it: the example, an upload, or what is open, with values upon those of its
// workbook where something gives them.
async function opening(fetched, { valuesOf = valuesAwaited, words = "" } = {}) {
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

// What an address gave that named a project before it was open.
function valuesAwaited(project) {
  const found = awaited?.id === project.id ? fromFragment(awaited.fragment, project) : {};
  if (awaited?.id === project.id) awaited = null;
  return found;
}

// What a workbook lacks, and what of it can be made here.
function offer(next) {
  motions.offer(next.lacks[0] === "motions" ? dropped : null);
  offerDrawing(dropped, dropped && next.drawing);
  showSteps(next);
}

function open(next, valuesOf) {
  offer(next);
  if (next.problems.length > 0) {
    showErrors(next, state);
    [part("save-filled").hidden, isEdited, sent] = [false, false, {}];
    faulty = next.problems.flatMap(({ row }) => (row ? [row.cells[row.at]] : []));
    return;
  }
  const project = { ...next, ...next.project, files: dropped };
  const values = valuesOf(project);
  part("other-project").hidden = !awaited;
  part("other-project-name").textContent = project.name;
  session.open(project, values);
  takeaway.open(project.package);
}

// What is of the project alone: its name, its warnings, its controls.
function showControls({ project }) {
  if (!project) return;
  showProject(state);
  replace(part("warnings"), ...parsed("div", project.answer.html.warnings).childNodes);
  for (const [key, ids] of Object.entries({ array: project.views.arrays, motion: project.views.motions })) {
    replace(part(key), ids.map((id) => html("option", { value: id }, id)));
  }
  for (const id of ["tab-slide", "tab-contour"]) part(id).hidden = project.views.motions.length === 0;
  drawControls = mountSliders(part("controls"), project, session);
}

function isAddressed(project) {
  return location.pathname === `/p/${project.id}/`;
}

// Values at rest are an entry of the history; those of another project begin anew.
function enterAddress({ project, values, phase }) {
  if (!project || phase !== "rest") return;
  const next = toAddress(project, values);
  const depth = history.state?.depth ?? 0;
  if (!history.state || !isAddressed(project)) history[history.state ? "pushState" : "replaceState"]({ depth: 0 }, "", next);
  else if (next !== location.pathname + location.hash) history.pushState({ depth: depth + 1 }, "", next);
  part("undo").disabled = history.state.depth < 1;
  part("reset-all").disabled = location.hash === "";
}

function findTurns({ phase, answer, project, values }) {
  if (phase !== "rest") turns.stop();
  else if (!answer.pending) turns.start(project.sliders, values, answer.verdict.look === "ng");
}

function fail(error, what = "Close", act = hideError) {
  if (error.lacksKey) {
    askForAddress();
    return;
  }
  replace(part("error"), html("p", {}, error.message), button(what, act));
  part("error").hidden = false;
}

// Nothing is answered without a key: all that the page can do is say how to get one.
function askForAddress() {
  for (const id of ["workspace", "outline", "welcome", "problems", "no-motions", "steps", "drawing"]) part(id).hidden = true;
  part("no-key").hidden = false;
  named("This tab needs a new address");
}

function hideError() {
  part("error").hidden = true;
}
