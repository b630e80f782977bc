// The values and their answer: provisional while a slider moves, full when it rests.

const REST_MS = 80; // without a move, after which a slider rests
const STEP_MS = 400; // after which a step is answered provisionally, if the full answer is not there

/**
 * Return the session's runner of assessments.
 *
 * `assess(moving, values)` promises an answer, or null if it is stale. `show` gets
 * `{phase, answer, values}`, an answer with the values that it is of: "moving" (provisional), "settling"
 * (the full model runs; no answer yet, or the provisional one) or "rest". `fail` gets an error, and
 * whether a slider moves.
 */
export function createSession(assess, show, fail) {
  let values = {};
  let version = 0; // of the values
  let timer = 0;
  let isMoving = false; // a slider moved since the full model was last asked
  let isFull = true; // nothing is to be computed

  async function ask(moving, whole = false) {
    const asked = version;
    const isWanted = () => (moving && isMoving) || (asked === version && !(moving && isFull));
    try {
      const sent = values; // replaced, never written to
      const answer = await assess(moving, sent, whole);
      if (!answer || !isWanted()) return;
      isFull = !moving;
      show({ phase: moving ? provisional(isMoving) : "rest", answer, values: sent });
      if (answer.pending) await ask(false, true);
    } catch (error) {
      if (isWanted()) fail(error, moving);
    }
  }
  const askMoving = createLane(async () => isFull || ask(true));
  const askFull = createLane(async () => isMoving || ask(false));

  function changed(next, moves) {
    clearTimeout(timer);
    values = { ...values, ...next };
    version += 1;
    isMoving = moves;
    isFull = false;
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
    load(all) {
      changed(all, false);
      isFull = true;
    },
    /** A slider moves: answer provisionally, and in full once it rests; a step, at first, in full at once. */
    move(id, value, isStep = false) {
      const rests = isStep && isFull;
      changed({ [id]: value }, !rests);
      if (rests) {
        rest();
        timer = setTimeout(askMoving, STEP_MS);
        return;
      }
      show({ phase: "moving" });
      askMoving();
      timer = setTimeout(rest, REST_MS);
    },
    release: () => isMoving && rest(), // the pointer let the slider go
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

const provisional = (isMoving) => (isMoving ? "moving" : "settling");

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
  return run;
}
