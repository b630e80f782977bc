// The values and their answer: provisional while a slider moves, the full model when it rests.

const REST_MS = 160;
const STILL_MS = 50; // after which the full model is asked ahead, in case the slider rests here
const STEP_MS = 400; // after which a step is answered provisionally, if the full answer is not there

/**
 * Return the session's runner of assessments.
 *
 * `assess(moving, values)` promises an answer, or null if it is stale. `show` gets
 * `{phase, answer}`: "moving" (provisional), "settling" (the full model runs; no answer yet) or
 * "rest". `fail` gets an error, and whether a slider moves.
 */
export function createSession(assess, show, fail) {
  let values = {};
  let version = 0; // of the values
  let timer = 0;
  let isMoving = false; // a slider moved since the full model was last asked
  let isPaused = false; // and has stayed where it is for a while, or is taken to rest after a step

  // Ask, and show the answer where it still is one: `isCurrent` gets the version that was asked.
  async function ask(moving, phase, isCurrent) {
    const asked = version;
    try {
      const answer = await (moving ? assess(true, { ...values }) : ahead.take());
      if (answer && isCurrent(asked)) show({ phase, answer });
    } catch (error) {
      if (isCurrent(asked)) fail(error, moving);
    }
  }
  const ahead = createAhead(() => assess(false, { ...values }), () => isPaused && rest());
  const askMoving = createLane(async () => {
    if (isMoving) await ask(true, "moving", () => isMoving);
    if (isMoving && isPaused) rest();
  });
  const askFull = createLane(async () => !isMoving && ask(false, "rest", (asked) => asked === version));

  function changed(next, moves, rests = false) {
    clearTimeout(timer);
    ahead.drop();
    values = { ...values, ...next };
    version += 1;
    [isMoving, isPaused] = [moves, rests];
  }

  // A provisional answer that is under way is shown first, unless the full one is there.
  function pause() {
    isPaused = true;
    if (!askMoving.isOpen() || ahead.isThere()) rest();
  }

  function rest() {
    clearTimeout(timer);
    isMoving = false;
    show({ phase: "settling" });
    askFull();
  }

  return {
    values: () => ({ ...values }),
    /** Take the values of a project; nothing is asked, and what was asked is dropped. */
    load: (all) => changed(all, false),
    /** A slider moves: answer provisionally, and in full once it rests; a step, at first, in full at once. */
    move(id, value, isStep = false) {
      const rests = isStep && !isMoving;
      changed({ [id]: value }, true, rests);
      ahead.plan(rests ? 0 : STILL_MS);
      timer = setTimeout(rests ? askMoving : pause, rests ? STEP_MS : REST_MS);
      show({ phase: "moving" });
      if (!rests) askMoving();
    },
    /** The pointer let the slider go: it rests. */
    release: () => isMoving && rest(),
    /** A choice was made: answer in full at once. */
    set(next) {
      changed(next, false);
      rest();
    },
    rest,
    /** Ask for the full answer again where there is one, which stays until then. */
    again: () => isMoving || askFull(),
  };
}

// A question asked some time after it is planned, or when its answer is taken; `arrived` is called
// when the answer is there and nobody has taken it.
function createAhead(ask, arrived) {
  let timer = 0;
  let asked = null;
  function begin() {
    const mine = { answer: ask(), isThere: false };
    asked = mine;
    const note = () => {
      mine.isThere = true;
      if (asked === mine) arrived();
    };
    mine.answer.then(note, note);
  }
  function drop() {
    clearTimeout(timer);
    asked = null;
  }
  return {
    plan(after) {
      if (after === 0) begin();
      else timer = setTimeout(begin, after);
    },
    drop,
    isThere: () => asked?.isThere === true,
    take() {
      const answer = asked?.answer ?? ask();
      drop();
      return answer;
    },
  };
}

/** Return a function that runs a task once at a time; calls meanwhile become one more run. */
export function createLane(task) {
  let isOpen = false;
  let isWaiting = false;
  async function run() {
    if (isOpen) {
      isWaiting = true;
      return;
    }
    isOpen = true;
    await task();
    isOpen = false;
    if (isWaiting) {
      isWaiting = false;
      await run();
    }
  }
  run.isOpen = () => isOpen;
  return run;
}
