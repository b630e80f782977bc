// What moves with the time of a run: the plan from the ground and on the roof, beside it histories.

import { html } from "./make.js";
import { within } from "./view-axes.js";
import { createPanels } from "./view-panels.js";
import { panelOf, rangeIn } from "./view-series.js";
import { createTrack } from "./view-track.js";

const HEIGHT = 330;
const GROUND = 142; // height of the plan seen from the ground
const GAP = 6;
const WHOLE = 128; // height of the displacement over the whole run
const CLOSE_S = 4; // of the forces, around the time
const NARROW = 540; // below it the plans are above the histories
const PLAN = 0.4; // of the width
const BETWEEN = 12; // plans and histories
const MOST_DEMAND = 1.6; // times the largest friction used: the axis of friction ends there

/** Return the stage of a run; `seek` is called with the time where the whole run is pressed. */
export function createStage(data, seek) {
  const { seconds } = data;
  const tracks = [false, true].map((isFromRoof) => createTrack(data, isFromRoof));
  const [displacement, ...forces] = panelsOf(data);
  const whole = createPanels([displacement], data);
  const close = createPanels(forces, data);
  const element = html(
    "div",
    { class: "watch", tabindex: 0, role: "application", "aria-label": "Run in time", "aria-describedby": "slide-keys" },
    html("div", { class: "plans" }, tracks.map((track) => track.element)),
    html("div", { class: "strips" }, html("div", { class: "whole-run" }, whole.element), close.element),
  );
  for (const kind of ["pointerdown", "pointermove"]) {
    whole.element.addEventListener(kind, (event) => event.buttons === 1 && seek(whole.timeAt(event)));
  }

  return {
    element,
    resize(wide) {
      const isNarrow = wide < NARROW;
      element.classList.toggle("is-narrow", isNarrow);
      const plan = isNarrow ? (wide - GAP) / 2 : Math.round(PLAN * wide);
      tracks[0].resize(plan, isNarrow ? plan : GROUND);
      tracks[1].resize(plan, isNarrow ? plan : HEIGHT - GROUND - GAP);
      const right = isNarrow ? wide : wide - plan - BETWEEN;
      whole.resize(right, WHOLE);
      close.resize(right, HEIGHT - WHOLE);
    },
    /** Move everything to a time, and mark the slip under way. */
    at(time, slip) {
      const from = within(time - CLOSE_S / 2, 0, Math.max(seconds - CLOSE_S, 0));
      close.show([from, Math.min(from + CLOSE_S, seconds)]);
      for (const part of [whole, close, ...tracks]) part.at(time, slip);
    },
  };
}

function panelsOf(data) {
  const [relative, normal, friction] = ["relative", "normal", "friction"].map((kind) => panelOf(data, kind));
  const over = [0, data.seconds];
  const [, most] = rangeIn(friction.series[0], over) ?? [0, 1];
  return [
    { ...relative, title: data.texts.relative },
    { ...normal, over },
    { ...friction, least: 0, most: MOST_DEMAND * Math.max(most, 0.1), over },
  ];
}
