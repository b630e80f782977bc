// Runs the time of a run: plays at a speed, pauses, goes to a time.

import { within } from "./view-axes.js";

const REST_MS = 700; // at each event, where motion is to be reduced
const MOST_MS = 100; // between two frames: after a longer pause, playing goes on where it was

/**
 * Return a player of a record of some seconds, at the `speed` of what is kept; `show` is called with
 * each time. Where the user wants motion reduced, it goes from one of the events to the next and rests
 * there.
 */
export function createPlayer(seconds, events, kept, show) {
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
    stop = isReduced.matches ? step(() => move(events.find((event) => event > player.time) ?? seconds)) : run((elapsed) => move(player.time + elapsed * kept.speed));
    show(player.time);
  }

  // Have the next play start from the beginning.
  function rewind() {
    isAtStart = true;
  }

  return player;
}

function step(advance) {
  const timer = setInterval(advance, REST_MS);
  return () => clearInterval(timer);
}

function run(advance) {
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
