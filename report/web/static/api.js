// Asks the server, with the key of this tab. Requests of one kind are numbered, and the reply to an
// older one is dropped.

/** An error whose message says to the user what to do. */
export class ApiError extends Error {
  constructor(message, status, problems = []) {
    super(message);
    // Another address opens this tab; no server answered.
    const remedy = { lacksKey: status === NO_KEY, isUnreached: status === UNREACHED };
    Object.assign(this, { status, problems }, remedy);
  }
}

const NO_KEY = 401;
const NOT_GOOD = 403; // a token
const UNREACHED = 0;
const KEY = "roofslip-key";

const PATIENCE_MS = 20_000; // with a server that says how far a package is

const UNREACHABLE =
  "The server does not answer. Check that `roofslip serve` is running, then move a slider or reload the page.";

/**
 * Return the calls of the server; `announce` says a sentence to a screen reader, and `room` gives
 * the width that there is for the plan.
 */
export function createApi(announce, room) {
  const page = crypto.getRandomValues(new Uint32Array(2)).join("-");
  const newest = new Map();
  let n = 0;
  let opened = ""; // what the page shows, as the server names it

  // Ask about the project that the page shows, whatever other tabs have opened.
  const about = (body) => json({ opened, ...body });

  // The answer of the newest request of its kind; null for an older one, even if it failed.
  async function latest(kind, send) {
    n += 1;
    const mine = n;
    newest.set(kind, mine);
    const isNewest = () => newest.get(kind) === mine;
    try {
      const answer = await send(mine);
      return isNewest() ? answer : null;
    } catch (error) {
      if (isNewest() && error.status !== 409) throw error;
      return null;
    }
  }

  // A provisional answer stays one while the full model is asked ahead: it is a kind of its own.
  const computed = (kind, body, as = kind) => latest(as, (number) => asked(`/api/${kind}`, about({ page, n: number, ...body })));

  // Of two projects, the one that was opened last stays, whichever answer comes first, with what more comes.
  async function open(url, options, more = async () => ({})) {
    const state = await latest("open", async () => ({ ...(await asked(url, options)), ...(await more()) }));
    if (state?.project) opened = state.opened; // one with errors is not opened
    return state;
  }

  return {
    announce,
    enter,
    newToken: () => asked("/api/token", { method: "POST" }),
    state: (id) => open(`/api/state?project=${id}`),
    example: () => open("/api/example", { method: "POST" }),
    upload: (files) => open("/api/upload", { method: "POST", body: form(files) }),
    readPlan: (files, fields) => open("/api/plan", { method: "POST", body: form(files, fields) }),
    fillCells: (files, cells) => open("/api/cells", { method: "POST", body: form(files, { cells: JSON.stringify(cells) }) }, async () => ({ filled: await filledWorkbook() })),
    blank: (units) => downloaded(`/api/blank?units=${units}`),
    filledWorkbook,
    addClearances: () => open("/api/clearances", about({})),
    tables: () => asked("/api/tables", about({})),
    edit: (cells) => open("/api/edit", about({ cells })),
    assess: (moving, values, whole = false) => computed("assess", { moving, whole, values, room: room() }, moving ? "moving" : "assess"),
    computed,
    // Of no page: it makes nothing stale that the page shows.
    verdict: (values, moving = false) => asked("/api/verdict", about({ values, moving })),
    startPackage: (values) => asked("/api/package", about({ values })),
    packageState: (id) => asked(`/api/package/${id}`, { signal: AbortSignal.timeout(PATIENCE_MS) }),
    cancelPackage: (id) => asked(`/api/package/${id}`, { method: "DELETE" }),
    file: (id, name) => downloaded(`/api/package/${id}/${name}`),
    startMotions: (files) => asked("/api/motions", { method: "POST", body: form(files) }),
    workbook: (values) => downloaded("/api/workbook", about({ values })),
  };
}

// Exchange the token of the address, which is good once, for the key that this tab keeps.
async function enter() {
  const token = new URLSearchParams(location.search).get("token");
  if (token === null) return;
  history.replaceState(null, "", location.pathname + location.hash);
  try {
    const { key } = await asked("/api/key", { method: "POST", headers: { "Roofslip-Token": token } });
    sessionStorage.setItem(KEY, key);
  } catch (error) {
    if (error.status !== NOT_GOOD) throw error; // a key that this tab has may still do
  }
}

function form(files, fields = {}) {
  const body = new FormData();
  for (const [name, text] of Object.entries(fields)) body.append(name, text);
  for (const { file, path } of files) body.append("files", file, path);
  return body;
}

function json(body) {
  return {
    method: "POST",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify(body),
  };
}

async function asked(url, options) {
  const reply = await sent(url, options);
  return reply.json();
}

function filledWorkbook() {
  return downloaded("/api/plan");
}

// The bytes of a file and the name that the server gives it.
async function downloaded(url, options) {
  const reply = await sent(url, options);
  const [, name] = /filename="([^"]+)"/.exec(reply.headers.get("Content-Disposition") ?? "") ?? [];
  return { name: name ?? "input.xlsx", blob: await reply.blob() };
}

async function sent(url, options) {
  let reply;
  try {
    const headers = { ...options?.headers, "Roofslip-Key": sessionStorage.getItem(KEY) ?? "" };
    reply = await fetch(url, { ...options, headers });
  } catch {
    throw new ApiError(UNREACHABLE, UNREACHED);
  }
  if (reply.ok) return reply;
  const told = await reply.json().catch(() => ({}));
  throw new ApiError(told.error ?? `The server answered ${reply.status}. Reload the page.`, reply.status, told.problems);
}
