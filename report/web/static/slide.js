// Watch it slide: one run in time, with what plays it and what tells of its slips.

import { button, html, note, replace } from "./make.js";
import { seconds as said } from "./reading.js";
import { within } from "./view-parts.js";
import { onKeys, runSelect } from "./view-frame.js";
import { lastUpTo } from "./view-panels.js";
import { createStage } from "./view-stage.js";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];
const STEP_S = 0.01;
const REST_MS = 700; // at each event, where motion is to be reduced
const MOST_MS = 100; // between two frames: after a longer pause, playing goes on where it was
const KEYS = "Space plays and pauses, N and P go to the next slip and the one before, arrows step, < and > change the speed. Shaded: slips.";

/** Draw the run in motion in an element. */
export function build(element, data, { again, announce, kept }) {
  const { seconds, texts } = data;
  kept.speed ??= 1;
  const slips = createSlips(data);
  const player = createPlayer(seconds, slips.events, kept, show);
  const stage = createStage(data, player.seek);
  const caption = html("p", { class: "numbers slip-text" });
  const speeds = speedSelect(kept);
  const parts = controls(player, { seconds, before: () => go(slips.before(player.time)), after: () => go(slips.after(player.time)) });

  function show(time) {
    const k = slips.at(time);
    stage.at(time, data.slips[k]);
    caption.textContent = k < 0 ? slips.rest(time) : slips.text(k);
    parts.show(time, { isFirst: slips.before(time) < 0, isLast: slips.after(time) >= data.slips.length });
  }

  function go(k) {
    if (!data.slips[k]) return;
    player.pause();
    player.seek(data.slips[k].to_s);
    announce(slips.text(k));
  }

  onKeys(stage.element, {
    " ": player.toggle,
    k: player.toggle,
    n: () => go(slips.after(player.time)),
    p: () => go(slips.before(player.time)),
    "<": () => speeds.change(-1),
    ">": () => speeds.change(1),
    ArrowLeft: ({ shiftKey }) => player.seek(player.time - (shiftKey ? 1 : STEP_S)),
    ArrowRight: ({ shiftKey }) => player.seek(player.time + (shiftKey ? 1 : STEP_S)),
    Home: () => player.seek(0),
    End: () => player.seek(seconds),
  });

  function resize(wide) {
    stage.resize(wide);
    show(player.time);
  }

  replace(
    element,
    html("p", { class: "print-only" }, texts.title),
    html("div", { class: "toolbar" }, runSelect(data, (run) => again({ run }))),
    html("p", { class: "watch-head" }, html("strong", { class: "numbers" }, texts.prd), caption),
    stage.element,
    html("div", { class: "player" }, parts.play, parts.back, parts.next, speeds.element, parts.scrub, parts.clock),
    html("p", { class: "note", id: "slide-keys" }, KEYS),
    note(texts.notes.join(" ")),
  );
  player.seek(data.t_prd_s ?? 0);
  player.rewind();
  return { resize, stop: player.pause };
}

// The slips of a run: `at` a time (-1 for none), the one `before` and `after` it, and their sentences.
function createSlips({ slips, texts }) {
  const begins = slips.map((slip) => slip.from_s);
  const ends = slips.map((slip) => slip.to_s);
  const firstToEnd = (time) => lastUpTo(ends, time - 1e-12) + 1;
  const past = (time) => lastUpTo(ends, time) + 1;
  return {
    events: slips.flatMap((slip) => [slip.from_s, slip.to_s]),
    at: (time) => (begins[firstToEnd(time)] <= time ? firstToEnd(time) : -1),
    before: (time) => firstToEnd(time) - 1,
    after: past,
    text: (k) => slips[k].text,
    rest: (time) => (slips.length === 0 ? texts.no_slip : `At rest, after ${past(time)} of ${slips.length} slips`),
  };
}

function controls(player, { seconds, before, after }) {
  const play = button("Play", player.toggle, { title: "Play or pause (Space)", class: "button primary play" });
  const back = button("‹ Slip", before, { title: "Slip before (P)", "aria-label": "Slip before" });
  const next = button("Slip ›", after, { title: "Next slip (N)", "aria-label": "Next slip" });
  const scrub = html("input", { type: "range", class: "scrub", min: 0, max: seconds, step: STEP_S, "aria-label": "Time", on: { input: ({ target }) => player.seek(Number(target.value)) } });
  const clock = html("span", { class: "numbers clock" });
  return {
    play,
    back,
    next,
    scrub,
    clock,
    show(time, { isFirst, isLast }) {
      scrub.value = time;
      scrub.setAttribute("aria-valuetext", said(time));
      clock.textContent = `${said(time)} of ${said(seconds)}`;
      play.textContent = player.isPlaying ? "Pause" : "Play";
      back.disabled = isFirst;
      next.disabled = isLast;
    },
  };
}

// How fast the player plays.
function speedSelect(kept) {
  const element = html(
    "select",
    { "aria-label": "Speed", title: "Speed (< and >)", on: { change: choose } },
    SPEEDS.map((one) => html("option", { value: one, selected: one === kept.speed }, `${one}×`)),
  );
  function choose() {
    kept.speed = Number(element.value);
  }
  return {
    element,
    change(way) {
      element.selectedIndex = within(element.selectedIndex + way, 0, SPEEDS.length - 1);
      choose();
    },
  };
}

// Runs the time of a run of some seconds, at the `speed` of what is kept; `show` is called with each time.
// Where the user wants motion reduced, it goes from one of the events to the next and rests there.
function createPlayer(seconds, events, kept, show) {
  const isReduced = matchMedia("(prefers-reduced-motion: reduce)");
  const player = { time: 0, isPlaying: false, seek, pause, toggle, rewind };
  let isAtStart = false;
  let stop = null;

  function seek(to) {
    isAtStart = false;
    move(to);
  }

  function move(to) {
    player.time = within(to, 0, seconds);
    if (player.time === seconds) player.pause();
    show(player.time);
  }

  function pause() {
    if (!player.isPlaying) return;
    player.isPlaying = false;
    stop();
    show(player.time);
  }

  function toggle() {
    if (player.isPlaying) {
      pause();
      return;
    }
    if (isAtStart || player.time === seconds) player.time = 0;
    isAtStart = false;
    player.isPlaying = true;
    stop = isReduced.matches ? stepwise(() => move(events.find((event) => event > player.time) ?? seconds)) : running((elapsed) => move(player.time + elapsed * kept.speed));
    show(player.time);
  }

  // Have the next play start from the beginning.
  function rewind() {
    isAtStart = true;
  }

  return player;
}

function stepwise(advance) {
  const timer = setInterval(advance, REST_MS);
  return () => clearInterval(timer);
}

function running(advance) {
  let last = performance.now();
  let frame = 0;
  const tick = (now) => {
    frame = requestAnimationFrame(tick);
    advance(Math.min(now - last, MOST_MS) / 1000);
    last = now;
  };
  frame = requestAnimationFrame(tick);
  return () => cancelAnimationFrame(frame);
}
