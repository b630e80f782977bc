// Watch it slide: one run in time, with what plays it and what tells of its slips.

import { button, html, note, replace } from "./make.js";
import { number } from "./reading.js";
import { onKeys, within } from "./view-parts.js";
import { createStage } from "./view-stage.js";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];
const STEP_S = 0.01;
const REST_MS = 700; // at each event, where motion is to be reduced
const MOST_MS = 100; // between two frames: after a longer pause, playing goes on where it was
const KEYS = "Space plays and pauses, N and P go to the next slip and the one before, arrows step, < and > change the speed. Shaded: slips.";

let speed = 1; // of the next run, too

/** Draw the run in motion in an element; returns what stops it. */
export function build(element, data, { again, announce }) {
  const { seconds, slips, texts } = data;
  const player = createPlayer(data, show);
  const stage = createStage(data, player.seek);
  const before = () => slips.findLastIndex((slip) => slip.to_s < player.time);
  const after = () => slips.findIndex((slip) => slip.to_s > player.time);
  const caption = html("p", { class: "numbers slip-text" });
  const play = button("Play", player.toggle, { title: "Play or pause (Space)", class: "button primary play" });
  const back = button("‹ Slip", () => go(before()), { title: "Slip before (P)", "aria-label": "Slip before" });
  const next = button("Slip ›", () => go(after()), { title: "Next slip (N)", "aria-label": "Next slip" });
  const choose = (way) => {
    speeds.selectedIndex = within(speeds.selectedIndex + way, 0, SPEEDS.length - 1);
    speed = SPEEDS[speeds.selectedIndex];
  };
  const options = SPEEDS.map((one) => html("option", { selected: one === speed, value: one }, `${one}×`));
  const speeds = html("select", { "aria-label": "Speed", title: "Speed (< and >)", on: { change: () => choose(0) } }, options);
  const scrub = html("input", { type: "range", class: "scrub", min: 0, max: seconds, step: STEP_S, "aria-label": "Time", on: { input: () => player.seek(scrub.valueAsNumber) } });
  const clock = html("span", { class: "numbers clock" });

  function show(time) {
    const slip = slips.find((one) => one.from_s <= time && time <= one.to_s);
    const past = slips.findLastIndex((one) => one.to_s <= time) + 1;
    const rest = slips.length === 0 ? texts.no_slip : `At rest, after ${past} of ${slips.length} slips`;
    stage.at(time, slip);
    caption.textContent = slip ? slip.text : rest;
    scrub.value = time;
    scrub.setAttribute("aria-valuetext", said(time));
    clock.textContent = `${said(time)} of ${said(seconds)}`;
    play.textContent = player.isPlaying ? "Pause" : "Play";
    back.disabled = before() < 0;
    next.disabled = after() < 0;
  }

  function go(k) {
    if (!slips[k]) return;
    player.pause();
    player.seek(slips[k].to_s);
    announce(slips[k].text);
  }

  onKeys(stage.element, {
    " ": player.toggle,
    k: player.toggle,
    n: () => go(after()),
    p: () => go(before()),
    "<": () => choose(-1),
    ">": () => choose(1),
    ArrowLeft: ({ shiftKey }) => player.seek(player.time - (shiftKey ? 1 : STEP_S)),
    ArrowRight: ({ shiftKey }) => player.seek(player.time + (shiftKey ? 1 : STEP_S)),
    Home: () => player.seek(0),
    End: () => player.seek(seconds),
  });
  const runs = html("select", { on: { change: () => again({ run: runs.value }) } }, data.runs.map(({ name, label }) => html("option", { value: name, selected: name === data.run }, label)));
  replace(
    element,
    html("p", { class: "print-only" }, texts.title),
    html("div", { class: "toolbar" }, html("label", { class: "field" }, "Run ", runs)),
    html("p", { class: "watch-head" }, html("strong", { class: "numbers" }, texts.prd), caption),
    stage.element,
    html("div", { class: "player" }, play, back, next, speeds, scrub, clock),
    html("p", { class: "note", id: "slide-keys" }, KEYS),
    note(texts.notes.join(" ")),
  );
  show(player.time);
  return player.pause;
}

function said(time) {
  return `${number(time, 2)} s`;
}

// Runs the time of a run, at the speed that is chosen; `show` is called with each time. It begins with the PRD in
// sight. Where the user wants motion reduced, it goes from one begin or end of a slip to the next and rests there.
function createPlayer({ seconds, slips, t_prd_s: tPrd }, show) {
  const isReduced = matchMedia("(prefers-reduced-motion: reduce)");
  const events = slips.flatMap((slip) => [slip.from_s, slip.to_s]);
  const player = { time: tPrd ?? 0, isPlaying: false, seek, pause, toggle };
  let isAtStart = true; // the next play begins there
  let turn = 0; // of playing

  function seek(to) {
    isAtStart = false;
    player.time = within(to, 0, seconds);
    if (player.time === seconds) player.isPlaying = false;
    show(player.time);
  }

  function pause() {
    player.isPlaying = false;
    show(player.time);
  }

  async function toggle() {
    if (player.isPlaying) {
      pause();
      return;
    }
    turn += 1;
    const mine = turn;
    player.isPlaying = true;
    seek(isAtStart || player.time === seconds ? 0 : player.time);
    for (let last = performance.now(); ; ) {
      const now = await (isReduced.matches ? new Promise((done) => setTimeout(done, REST_MS)) : new Promise(requestAnimationFrame));
      if (!player.isPlaying || mine !== turn) return;
      if (isReduced.matches) seek(events.find((event) => event > player.time) ?? seconds);
      else seek(player.time + (Math.min(now - last, MOST_MS) / 1000) * speed);
      last = now;
    }
  }

  return player;
}
