// The one state of the page: what is open, the values that are asked for, their answer, and what is
// picked and zoomed. Every part of the page is drawn from it, by a function that it gives to `draws`.
// An answer is provisional while a slider moves, and full when it rests.

import { isSame, typedOf } from "./changes.js";

const REST_MS = 80; // without a step of a key, after which a slider rests
const HOLD_MS = 700; // without a move of the pointer that holds it, likewise: a drag that turns back asks nothing
const GAP_MS = 300; // at least, from one provisional answer that is asked to the next in a drag: at 600, a drag takes 1.0 s of processor time instead of 1.4
const PER_ANSWER = 3; // likewise, of the time that the last one took: a server under load is not asked all the time
const PAUSE_MS = 250; // without a move, after which the next one is answered at once
const SLOW_MS = 400; // after which values at rest are answered provisionally, if the full answer is not there

/** The whole sheet of the plan. */
export const WHOLE = { scale: 1, x: 0, y: 0 };

/**
 * Return the session of a tab.
 *
 * `assess(moving, values, whole)` promises an answer, or null if it is stale; `fail` gets an error that
 * is no refusal of values. In the state `phase` is "opening", "moving" (provisional), "settling" (the
 * full model runs), "rest" or "failed", and `shows` says what the answer is of: "final", "provisional",
 * or "former" values, which are not those that are asked for.
 */
export function createSession(assess, fail) {
  const state = { project: null, values: {}, answer: null, phase: "opening", shows: "", failure: null, turned: {}, picked: null, array: null, motion: null, view: WHOLE };
  const parts = [];
  const set = (changed) => {
    Object.assign(state, changed);
    for (const draw of parts) draw(state);
  };
  const run = createRuns(state, set, assess, fail);

  return {
    state,
    set,
    /** Have a function draw a part of the page from the state, at every change of it. */
    draws: (draw) => parts.push(draw),
    /** Show a project at values upon those of its workbook; what was asked is dropped. */
    open(project, others) {
      const [[array], [motion]] = [project.views.arrays, project.views.motions];
      Object.assign(state, { project, array, motion, picked: null, view: WHOLE, answer: null, failure: null });
      run.at({ ...typedOf(project), ...others });
    },
    /** A slider moves: answer provisionally, and in full once it rests; a step, at first, in full at once. */
    move: (values, isStep = false) => run.through({ ...state.values, ...values }, isStep),
    /** The pointer let the slider go. */
    release: () => run.release(),
    /** Values were typed or chosen: answer in full at once. */
    enter: (values) => run.at({ ...state.values, ...values }),
    /** Return to values upon those of the workbook. */
    restore: (values) => run.at({ ...typedOf(state.project), ...values }),
    /** Ask for the full answer, whatever there is. */
    rest: () => run.rest(),
    /** Ask for the full answer again where there is one, which stays until then. */
    again: () => run.again(),
  };
}

// Asks for the answers of a session, provisional and full, each once at a time.
function createRuns(state, set, assess, fail) {
  let [version, timer] = [0, 0]; // of the values; until the slider rests
  let stage = "full"; // "moving" and "settling" as the phase; "full": nothing is to be computed but what an answer lacks
  let isHeld = false; // by the pointer: what an answer lacks is asked once it lets go

  async function ask(moving, whole = false) {
    const [asked, values] = [version, state.values]; // replaced, never written to
    const isWanted = () => (moving && stage === "moving") || (asked === version && !(moving && stage === "full"));
    try {
      const answer = await assess(moving, values, whole);
      if (!answer || !isWanted()) return;
      if (!moving) stage = "full";
      set({ ...answered(answer, values), ...(moving && { phase: stage, shows: "provisional" }) });
      if (answer.pending && !isHeld) await ask(false, true);
    } catch (error) {
      // Values are refused with their problems. Any other fault of a provisional answer is left to the full one.
      const isRefused = error.problems?.length > 0;
      if (!isWanted() || (moving && !isRefused)) return;
      clearTimeout(timer);
      set({ phase: "failed", shows: "former", failure: error });
      if (!isRefused) fail(error);
    }
  }

  const askMoving = createLane(async () => stage === "moving" && ask(true), GAP_MS);
  const askMeanwhile = createLane(async () => stage === "settling" && ask(true));
  const askFull = createLane(async () => stage === "moving" || ask(false, stage === "full"));

  function change(values, moves) {
    clearTimeout(timer);
    version += 1;
    stage = moves ? "moving" : "settling";
    Object.assign(state, { values: present(values), phase: stage, turned: {}, ...former(state.answer) });
  }

  function rest() {
    clearTimeout(timer);
    if (stage === "moving") stage = "settling";
    askFull(); // on its way while the page draws that it waits
    set({ phase: "settling" });
    timer = setTimeout(askMeanwhile, SLOW_MS);
  }

  return {
    rest,
    again: () => stage === "moving" || askFull(),
    release() {
      if (stage === "moving") rest();
      else if (isHeld && state.answer?.pending) askFull();
      isHeld = false;
    },
    through(values, isStep) {
      const rests = isStep && stage === "full";
      isHeld = !isStep;
      change(values, !rests);
      timer = setTimeout(rest, isHeld ? HOLD_MS : REST_MS);
      if (rests) rest();
      else askMoving(); // likewise: drawing takes 2 ms
      set({});
    },
    // The values of the workbook have their answer; others are asked in full.
    at(all) {
      isHeld = false;
      change(all, false);
      if (isAsTyped(state)) stage = "full";
      if (stage === "full") set(answered(state.project.answer, state.values));
      else rest();
    },
  };
}

const answered = (answer, values) => ({ phase: "rest", shows: "final", failure: null, answer: { ...answer, values } });

const isAsTyped = ({ project, values }) => Boolean(project?.answer) && isSame(values, typedOf(project));

// The answer stays beside other values, without its verdict.
const former = (answer) => (answer?.verdict ? { answer: { ...answer, verdict: null }, shows: "former" } : {});

// A value of null is none: that of all arrays, or of the workbook, is meant.
function present(values) {
  return Object.fromEntries(Object.entries(values).filter(([, value]) => value !== null));
}

/** Return a function that draws where one of the named parts of the state has changed. */
export function onChange(names, draw) {
  let drawn = null;
  return (state) => {
    const now = names.map((name) => state[name]);
    if (drawn && now.every((one, k) => one === drawn[k])) return;
    drawn = now;
    draw(state);
  };
}

/**
 * Return a function that runs a task once at a time, with a gap in ms if given, which a call after a pause ends;
 * calls meanwhile become one more run.
 */
export function createLane(task, gap = 0) {
  let isOpen = false;
  let isWaiting = false;
  let called = 0;
  let endGap = null;
  async function run() {
    const waited = performance.now() - called;
    called += waited;
    if (isOpen) {
      isWaiting = true;
      if (waited > PAUSE_MS) endGap?.();
      return;
    }
    isOpen = true;
    const begun = performance.now();
    await task();
    const took = performance.now() - begun;
    if (gap) {
      await new Promise((done) => {
        endGap = done;
        setTimeout(done, Math.max(gap, PER_ANSWER * took) - took);
      });
    }
    isOpen = false;
    if (isWaiting) {
      isWaiting = false;
      await run();
    }
  }
  return run;
}
