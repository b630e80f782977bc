// The kernels of the solver in this browser, and the choice of the model, as solver/sliding has them. Knows no
// rule: a scene is a motion along the slope with friction. Lengths are in m, along the plan.

const G = 9.80665;
const TOLERANCE = 1e-6; // of a run in two axes, relative to its PRD
const SHARE = 1.5e-3; // tolerance of a step / that of the run, as the others here of solver/sliding/two_axes.py
const ATTEMPTS = 5;
const FINER = 0.03;
const SAFE = 16;
const SMALL = 1e-6;
const LEAST = 1e-14;
const ORDER = 20;
const MATTERS = [1e-3, 0.005]; // what a model may neglect: in m, and as a share of the PRD
const BLOCK = 16; // samples between two bounds
const PAGE = 65536;
const ALIGN = 64;

/** Displacements of a run, which are compared. */
export const LENGTHS = ["prd_m", "down_m", "up_m", "across_m", "residual_m", "residual_across_m"];

/** Return the kernels with records to run: of each motion `{ dt_s, parts }`, along, across and up, which may lack. */
export function createKernels(wasm, motions) {
  const memory = createMemory(wasm);
  const runs = createRuns(memory);
  const records = recordsOf(memory, motions);

  // What a kernel takes of a scene: the records along, across and up, and what is the same for all.
  function sceneOf({ motion, along, polarity, slope_rad: slope, friction, scale }) {
    const { own, back, z, still, dt, n, has } = records[motion];
    const k = along === "transverse" ? 1 : 0;
    return { x: (polarity > 0 ? own : back)[k], y: own[1 - k], z, still, dt, samples: n, has, sn: Math.sin(slope), cs: Math.cos(slope), friction, scale };
  }

  return {
    /** Return the displacements of a scene, by the simplest adequate model. */
    run: (scene) => chosen(runs, sceneOf(scene)),
    /** Return a run with its displacement and velocity at the samples, its events and the records that it is of. */
    history(scene) {
      const made = sceneOf(scene);
      const done = chosen(runs, made);
      const { still, cs, sn, samples: n } = made;
      const as = { ...made, ...(done.model < 3 ? { y: still } : {}), ...(done.model === 1 ? { z: still } : {}) };
      const { take, view } = memory;
      return memory.keeping(() => {
        const shaken = [as.x, as.y, as.z].map(({ at }) => Array.from(view(at, n), (a) => a * scene.scale));
        const told = { ...done, dt_s: made.dt, shaken, sn, cs, law: made.friction };
        if (Number.isNaN(done.prd_m)) return { ...told, rows: Array(4).fill(new Float64Array(n).fill(Number.NaN)), noted: [] };
        const first = followed(runs, as);
        const [events, places] = [take(4 * first.events), take(4 * n)];
        runs.plane(as, first.step, [events, first.events, places, n]);
        const rows = [0, 1, 2, 3].map((k) => Float64Array.from(view(places + 8 * k * n, n), (s) => (k % 2 ? s : s * cs)));
        const noted = Array.from({ length: first.events }, (_, k) => [...view(events + 32 * k, 4)]);
        return { ...told, rows, noted };
      });
    },
  };
}

function recordsOf({ take, view, run, keeping }, motions) {
  function record(samples) {
    const n = samples.length;
    const fine = Math.ceil(n / BLOCK);
    const m = fine + Math.ceil(fine / BLOCK) + 1;
    const at = take(n);
    view(at, n).set(samples);
    const bounds = take(2 * m);
    keeping(() => run("bounds", at, BigInt(n), bounds, BigInt(m)));
    return { at, bounds, n: BigInt(n), m: BigInt(m) };
  }
  return motions.map(({ dt_s: dt, parts }) => {
    const n = parts[0].length;
    const still = new Float64Array(n);
    const [x, y, z] = [0, 1, 2].map((k) => record(parts[k]?.length ? parts[k] : still));
    const has = [1, 2].map((k) => Boolean(parts[k]?.length));
    return { n, dt, own: [x, y], back: [x, y].map(({ at }) => record(view(at, n).map((a) => -a))), z, still: record(still), has };
  });
}

// What the kernels make of a scene: in one axis, in two, and whether it never slips.
function createRuns({ take, view, run, keeping }) {
  const out = take(9);
  const [top, end] = [take(7), take(4)];
  return {
    isStill({ x, y, z, samples, sn, cs, friction, scale }) {
      run("first_slip", x.at, y.at, z.at, x.n, sn, cs, friction.mu_static, G, scale, out);
      return view(out, 1)[0] === samples;
    },
    axis({ x, z, dt, sn, cs, friction, scale }, hasVertical) {
      const rest = [x.n, x.m, dt, sn, cs, friction.mu_slow, G, scale, out];
      if (hasVertical) run("along", x.at, z.at, x.bounds, z.bounds, ...rest);
      else run("level", x.at, x.bounds, ...rest);
      const [most, least, last, w, t, , , normal, error] = view(out, 9);
      return { prd_m: cs * Math.max(most, -least), down_m: cs * most, up_m: cs * Math.abs(least), across_m: 0, residual_m: cs * last, residual_across_m: 0, rests: w === 0, t_prd_s: t, normal, error_m: error };
    },
    plane({ x, y, z, dt, samples, sn, cs, friction: f, scale }, step, [events, count, places, n] = [0, 0, 0, 0]) {
      const degree = Math.min(ORDER, 4 + Math.ceil(-0.5 * Math.log(step)));
      const head = [x.at, y.at, z.at, x.bounds, y.bounds, z.bounds, x.n, x.m, dt, sn, cs];
      const tail = [G, scale, step, BigInt(degree), BigInt(200_000 + 20 * samples), events, BigInt(count), places, BigInt(n), top, end, out];
      if (isConstant(f)) keeping(() => run("plane", ...head, f.mu_slow, ...tail));
      else keeping(() => run("law", ...head, f.mu_fast, f.mu_fast - f.mu_slow, f.rate_s_per_m, f.mu_static, ...tail));
      const [status, error, , noted] = view(out, 4);
      const [prd, t, most, least, left, right] = view(top, 6);
      const [sx, sy, vx, vy] = view(end, 4);
      return { status, error_m: error, events: noted, prd_m: prd, t_prd_s: t, down_m: cs * most, up_m: cs * Math.abs(least), across_m: Math.max(left, Math.abs(right)), residual_m: cs * sx, residual_across_m: sy, rests: vx === 0 && vy === 0, step };
    },
  };
}

// To the tolerance; where friction falls with speed no bound holds, and a finer run tells by how much.
function followed({ plane }, scene) {
  const { friction: f } = scene;
  const isMonotone = f.mu_fast >= f.mu_slow && f.mu_static === f.mu_slow;
  let done = null;
  let share = SHARE * TOLERANCE;
  for (let k = 0; k < ATTEMPTS; k += 1) {
    done = plane(scene, share);
    const wanted = TOLERANCE * Math.max(done.prd_m, SMALL);
    if (!isMonotone || done.error_m <= wanted || done.status !== 0 || share <= LEAST) break;
    share *= Math.max((0.3 * wanted) / done.error_m, 1e-3);
  }
  if (isMonotone || done.status !== 0) return done;
  const finer = plane(scene, FINER * done.step);
  return { ...finer, error_m: SAFE * leftOut(done, { ...finer, error_m: 0 }) };
}

function chosen(runs, scene) {
  const { has: [hasAcross, hasVertical], friction } = scene;
  const vertical = runs.axis(scene, hasVertical);
  if (vertical.normal < 0) return { model: hasVertical ? 2 : 1, ...lost() };
  if (runs.isStill(scene)) return { model: 0, ...runs.axis({ ...scene, friction: { ...friction, mu_slow: friction.mu_static } }, hasVertical) };
  if (!isConstant(friction)) return { model: 4, ...orLost(followed(runs, scene)) };
  const both = hasAcross ? orLost(followed(runs, scene)) : vertical;
  const level = hasVertical ? runs.axis(scene, false) : vertical;
  const bound = Math.max(MATTERS[0], MATTERS[1] * vertical.prd_m);
  if (leftOut(level, ...new Set([vertical, both])) <= bound) return { model: 1, ...level };
  if (leftOut(vertical, both) <= bound) return { model: 2, ...vertical };
  return { model: 3, ...both };
}

function isConstant(friction) {
  const isByVelocity = friction.mu_fast !== friction.mu_slow && friction.rate_s_per_m > 0;
  return !isByVelocity && friction.mu_static === friction.mu_slow;
}

function lost() {
  return { ...Object.fromEntries(LENGTHS.map((name) => [name, Number.NaN])), rests: false, t_prd_s: Number.NaN, error_m: Number.NaN };
}

function orLost(done) {
  return done.status === 0 ? done : { ...done, ...lost() };
}

// The largest change of a displacement by more complete models, with their errors; infinite for none.
function leftOut(own, ...fuller) {
  const changes = fuller.filter((done) => done !== own).flatMap((done) => LENGTHS.map((name) => Math.abs(done[name] - own[name]) + done.error_m));
  return changes.some(Number.isNaN) ? Infinity : Math.max(0, ...changes);
}

// The memory of the kernels: `take` numbers of it, `view` them, `run` a kernel; `keeping` gives back what is taken.
function createMemory(wasm) {
  let used = 0;
  const grow = (to) => {
    const more = Math.ceil((to - memory.buffer.byteLength) / PAGE);
    if (more > 0) memory.grow(more);
  };
  const aligned = () => Math.ceil(used / ALIGN) * ALIGN;
  // numba allocates an array behind 64 bytes of its own, in which its place stands at 24.
  const allocate = (bytes) => {
    const at = aligned();
    grow(at + Number(bytes) + 2 * ALIGN);
    used = at + Number(bytes) + 2 * ALIGN;
    new DataView(memory.buffer).setUint32(at + 24, at + ALIGN, true);
    return at;
  };
  const module = new WebAssembly.Module(wasm);
  const env = { exp: Math.exp, log: Math.log, pow: Math.pow, hypot: Math.hypot, atomic_sub: () => 0, NRT_MemInfo_alloc_aligned: allocate };
  for (const { name } of WebAssembly.Module.imports(module)) {
    env[name] ??= () => {
      throw new Error(`the kernels call ${name}`);
    };
  }
  const { exports } = new WebAssembly.Instance(module, { env });
  const { memory } = exports;
  used = exports["__heap_base"].value;
  return {
    take(numbers) {
      const at = aligned();
      used = at + 8 * numbers;
      grow(used + PAGE);
      return at;
    },
    view: (at, numbers) => new Float64Array(memory.buffer, at, numbers),
    run: (name, ...given) => exports[`roofslip_${name}`](...given),
    keeping(work) {
      const before = used;
      const answer = work();
      used = before;
      return answer;
    },
  };
}
