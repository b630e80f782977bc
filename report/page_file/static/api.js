// The calls of the page, as report/web/static/api.js has them, answered in the file itself: from the results of the
// package, and by the kernels.

import { createKernels, LENGTHS } from "./kernels.js";
import { printedAs, unitsOf, withFriction } from "./values.js";

export class ApiError extends Error {}

/** Load the file again. */
export function reload() {
  location.reload();
}

const SHARE_MS = 30; // of computing, between which the page answers
const MOST_KEPT = 5000; // runs
const KINDS = { relative: "Displacement relative to the roof", normal: "Normal force", friction: "Friction F / N" };
const G = 9.80665;
// Differences that other processors and browsers explain, as in report/proof.
const RELATIVE = 1e-9;
const ABSOLUTE_M = 1e-14;
const SLIP = 1;

/** Return the calls of a file with this data; `announce` says a sentence to a screen reader. */
export function createApi(announce, data) {
  const ready = opened(data);
  const keptRuns = new Map(); // equal arrays have equal runs

  // The runs of the package at some values, as `{ array, run, done }`: shares of them are computed between frames.
  async function runs(values, isWanted = () => true) {
    const { results, kernels } = await ready;
    const made = [];
    let begun = performance.now();
    for (const array of results.arrays) {
      for (const run of array.runs) {
        const scene = sceneOf(results, array, run, values);
        const key = JSON.stringify(scene);
        if (!keptRuns.has(key)) {
          if (performance.now() - begun > SHARE_MS) {
            await rest();
            begun = performance.now();
          }
          if (!isWanted()) return null;
          if (keptRuns.size > MOST_KEPT) keptRuns.clear();
          keptRuns.set(key, kernels.run(scene));
        }
        made.push({ array, run, done: keptRuns.get(key) });
      }
    }
    return made;
  }

  return {
    announce,
    /** Return the results of the package. */
    state: async () => (await ready).results,
    runs,
    /** Return each motion with the SHA-256 of its samples in the file, and whether the results say the same. */
    hashes: async () => {
      const { results, motions } = await ready;
      return Promise.all(results.motions.map(async ({ id, sha256 }, k) => {
        const found = await hashOf(motions[k].parts);
        return { id, sha256: found, isSame: found === sha256 };
      }));
    },
    /** Return one run in time, as the server does. */
    computed: async (kind, { values = {}, array: name, motion, run: wanted }) => {
      const { results, kernels } = await ready;
      const array = results.arrays.find(({ id }) => id === name);
      const of = (await runs(values)).filter(({ array: one, run }) => one === array && run.motion === motion);
      const governing = of.reduce((best, one) => (size(one.done.prd_m) > size(best.done.prd_m) ? one : best));
      const chosen = of.find(({ run }) => nameOf(run) === wanted) ?? governing;
      const history = kernels.history(sceneOf(results, array, chosen.run, values));
      return slide({ results, array, of, chosen, governing, history, outline: data.outlines[name] });
    },
  };
}

/** Return how the displacements of runs compare with those of the package. */
export function compared(made) {
  let [equal, within, largest] = [0, 0, 0];
  for (const { run, done } of made) {
    const changes = LENGTHS.map((name) => Math.abs(done[name] - (run[name] ?? Number.NaN)));
    const isLost = run.prd_m === null && Number.isNaN(done.prd_m);
    const isEqual = done.model === run.rung && (isLost || changes.every((change) => change === 0));
    const isWithin = done.model === run.rung && (isLost || Math.max(...changes) <= RELATIVE * run.prd_m + ABSOLUTE_M);
    [equal, within] = [equal + isEqual, within + isWithin];
    if (!isLost) largest = Math.max(largest, ...changes);
  }
  return { runs: made.length, equal, within, largest_m: largest };
}

const size = (length) => (Number.isNaN(length) ? Infinity : length);
const rest = () => new Promise((done) => { setTimeout(done); });
const nameOf = ({ along, polarity }) => `${along} ${polarity > 0 ? "+" : "−"}`;

async function opened({ results, kernels, motions: { per_g: per, samples, listed } }) {
  const [text, wasm, packed] = await Promise.all([results, kernels, samples].map(bytes));
  const motions = unpacked(packed, per, listed);
  return { results: JSON.parse(new TextDecoder().decode(text)), kernels: createKernels(wasm, motions), motions };
}

async function bytes(text) {
  const raw = Uint8Array.from(atob(text), (letter) => letter.codePointAt(0));
  const stream = new Blob([raw]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Records as differences of whole parts of g, the four bytes of each apart; or, for `per` of 0, as they are.
function unpacked(packed, per, listed) {
  const total = listed.reduce((sum, { sizes }) => sum + sizes.reduce((all, n) => all + n, 0), 0);
  const whole = per ? null : new Float64Array(packed.buffer, 0, total);
  let [at, sum] = [0, 0];
  const record = (n) => {
    at += n;
    if (whole) return whole.slice(at - n, at);
    return Float64Array.from({ length: n }, (_, place) => {
      const k = at - n + place;
      sum += packed[k] | (packed[k + total] << 8) | (packed[k + 2 * total] << 16) | (packed[k + 3 * total] << 24);
      return (sum / per) * G;
    });
  };
  return listed.map(({ dt_s: dt, sizes }) => ({ dt_s: dt, parts: sizes.map(record) }));
}

async function hashOf(parts) {
  const all = new Blob(parts);
  const digest = await crypto.subtle.digest("SHA-256", await all.arrayBuffer());
  return Array.from(new Uint8Array(digest), (byte) => byte.toString(16).padStart(2, "0")).join("");
}

// A run of the results at some values: factors on friction and on motions.
function sceneOf(results, array, run, { friction = 1, intensity = 1 }) {
  const motion = results.motions.findIndex(({ id }) => id === run.motion);
  const law = withFriction(array.friction, friction);
  return { motion, along: run.along, polarity: run.polarity, slope_rad: array.slope_rad, friction: law, scale: run.scale * intensity };
}

// No number is null, as in JSON.
function finite(values) {
  return Array.from(values, (value) => (Number.isFinite(value) ? value : null));
}

function panel(kind, units, series) {
  return { title: KINDS[kind], title_with_unit: KINDS[kind], units, series };
}

function plain(symbol) {
  return [{ symbol, si: 1, decimals: 2 }];
}

function slide({ results, array, of, chosen, governing, history, outline }) {
  const { dt_s: dt, rows: [down, across, vDown, vAcross], shaken: [ax, ay, az], sn, cs } = history;
  const lengths = unitsOf(results);
  const [first, second] = lengths.map((unit) => (m) => printedAs("prd_m", m, unit, results.printed));
  const isLost = Number.isNaN(history.prd_m);
  const last = dt * (ax.length - 1);
  const slips = slipsOf(history, last);
  const normal = ax.map((a, k) => (G + az[k]) * cs + a * sn);
  const demand = ax.map((a, k) => Math.hypot((G + az[k]) * sn - a * cs, ay[k]) / normal[k]);
  const { mu_slow: slow, mu_fast: fast, rate_s_per_m: rate } = history.law;
  const sliding = (speed) => fast - (fast - slow) * Math.exp(-rate * speed);
  const isDuring = during(slips);
  const used = demand.map((resting, k) => (Number.isNaN(down[k]) ? Number.NaN : isDuring(k * dt) ? sliding(Math.hypot(vDown[k] / cs, vAcross[k])) : resting));
  const label = ({ run, done }) => `${nameOf(run)}, ${Number.isNaN(done.prd_m) ? "no PRD" : `PRD ${first(done.prd_m)}`}${run === governing.run ? ", governing" : ""}`;
  return {
    run: nameOf(chosen.run),
    runs: of.map((one) => ({ name: nameOf(one.run), label: label(one) })),
    dt_s: dt,
    seconds: last,
    plan: outline,
    roof_m: [travel(ax, dt), travel(ay, dt)],
    slips: slips.map((slip, k) => ({ ...slip, text: `Slip ${k + 1} of ${slips.length}: ${slip.from_s.toFixed(3)} s to ${slip.to_s.toFixed(3)} s` })),
    relative: panel("relative", lengths, [{ name: "down", v: finite(down) }, { name: "cross", v: finite(across) }]),
    normal: panel("normal", plain("W"), [{ name: "N / W", v: finite(normal.map((n) => n / G)) }]),
    friction: panel("friction", plain(""), [{ name: "used", v: finite(used) }, { name: "demand", v: finite(demand) }]),
    t_prd_s: isLost ? null : history.t_prd_s,
    texts: {
      title: `Array ${array.id}, motion ${chosen.run.motion}, run ${nameOf(chosen.run)}`,
      prd: isLost ? "no PRD" : `PRD ${first(history.prd_m)} (${second(history.prd_m)}) at ${history.t_prd_s.toFixed(2)} s`,
      no_slip: isLost ? "This run gives no displacement." : "The array does not slip in this run.",
      notes: ["Computed here. Down is downslope; cross is cross-slope, positive to the left when facing downslope."],
    },
  };
}

// From each slip to the stop after it; a last one without a stop lasts to the end.
function slipsOf({ noted }, last) {
  const begun = noted.filter(([, kind]) => kind === SLIP).map(([t]) => t);
  const ended = noted.filter(([, kind]) => kind !== SLIP).map(([t]) => t);
  return begun.map((from, k) => ({ from_s: from, to_s: ended[k] ?? last }));
}

function during(slips) {
  let k = 0;
  return (time) => {
    while (k < slips.length && slips[k].to_s < time) k += 1;
    return k < slips.length && slips[k].from_s <= time;
  };
}

// Displacement of a roof that is at rest at first, of its acceleration, which is linear between samples.
function travel(a, dt) {
  let [u, v] = [0, 0];
  return a.map((now, k) => {
    if (k > 0) {
      u += dt * v + ((dt * dt) / 6) * (2 * a[k - 1] + now);
      v += (dt / 2) * (a[k - 1] + now);
    }
    return u;
  });
}
