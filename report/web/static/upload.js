// Takes a workbook and its records: dropped anywhere on the page, or chosen by the two buttons.

// Excel's lock files and what file systems leave in folders.
const HIDDEN = /(^|\/)(\.|~\$|__MACOSX\/|Thumbs\.db$)/;

/** Listen to the whole page; `begin` gets words at once, `take` a list of `{file, path}`. */
export function mountUpload({ zone, files, folder }, { begin, take, fail }) {
  let given = 0;
  // A large folder takes a while to list: what is given meanwhile counts, not the folder.
  async function receive(listed) {
    given += 1;
    const mine = given;
    begin("Reading the files …");
    try {
      const found = await listed;
      if (mine === given) take(visible(found));
    } catch (error) {
      if (mine !== given) return;
      begin("");
      fail(new Error(`The files could not be read: ${error.message} Drop them again.`));
    }
  }
  for (const input of [files, folder]) {
    input.addEventListener("change", () => {
      receive([...input.files].map((file) => ({ file, path: file.webkitRelativePath || file.name })));
      input.value = ""; // the same file again is a change
    });
  }
  const shows = (isOver) => (event) => {
    event.preventDefault();
    zone.classList.toggle("is-over", isOver);
  };
  for (const kind of ["dragenter", "dragover"]) addEventListener(kind, shows(true));
  addEventListener("dragleave", (event) => event.relatedTarget || shows(false)(event)); // it leaves the page
  addEventListener("drop", (event) => {
    shows(false)(event);
    // Entries are only readable until the first await.
    const entries = [...event.dataTransfer.items].map((item) => item.webkitGetAsEntry()).filter(Boolean);
    receive(all(entries));
  });
}

/**
 * Return files that follow a workbook together with it and what came with it: each where the workbook has a
 * path with its name, of those `wanted`. Files with a workbook of their own stay as they are.
 */
export function besideWorkbook(files, former, wanted) {
  const workbook = former?.find(({ path }) => path.endsWith(".xlsx"));
  if (!workbook || files.some(({ path }) => /\.(xlsx|zip)$/i.test(path))) return files;
  const folder = workbook.path.slice(0, workbook.path.lastIndexOf("/") + 1);
  const placed = ({ file, path }) => ({ file, path: folder + (wanted.find((one) => nameOf(one) === nameOf(path)) ?? path) });
  const added = files.map(placed);
  const names = new Set(added.map(({ path }) => path));
  return [...former.filter(({ path }) => !names.has(path)), ...added];
}

function nameOf(path) {
  return path.split("/").at(-1);
}

/** Return the files without hidden ones. */
export function visible(files) {
  return files.filter(({ path }) => !HIDDEN.test(path));
}

async function all(entries) {
  return (await Promise.all(entries.map(inside))).flat();
}

async function inside(entry) {
  if (entry.isFile) return [{ file: await new Promise((done, failed) => entry.file(done, failed)), path: entry.fullPath.replace(/^\//, "") }];
  const [found, reader] = [[], entry.createReader()];
  const batch = () => new Promise((done, failed) => reader.readEntries(done, failed));
  // A reader gives at most 100 entries at a time.
  for (let part = await batch(); part.length > 0; part = await batch()) found.push(...part);
  return all(found);
}
