"""Motions for a workbook that has none: who is offered them, how they are made and saved."""

import io
import re
import tempfile
import time
import zipfile

import pytest

import report.suite.suite_files
from fixtures import records
from fixtures.browser import at_rest, called, cases, opened, quiet_page, served
from fixtures.workbooks import cell_address, make, type_into
from report.assessment.assess import assess
from report.motions.prepare import prepare
from report.project.read.read import read
from report.web import worker
from report.web.jobs import perform
from report.web.worker import MOTIONS, PROJECT, motions_made

MOTION_CELLS = ("ID", "Horizontal record", "Vertical record", "Time step", "Scaling",
                "Factor or PPA", "Polarity", "Source", "Record units", "Recorded at")  # fmt: skip


def without_motions(folder, **cells):
    """A workbook without a row of motions, nor records beside it."""
    path = make(folder)
    rows = {f"Motions/M{n}/{heading}": None for heading in MOTION_CELLS for n in (1, 2, 3)}
    type_into(path, rows | {f"Site/{label}": value for label, value in cells.items()})
    for record in (folder / "records").iterdir():
        record.unlink()
    return path


def test_a_workbook_without_motions_opens_as_prescriptive_and_is_offered_some(tmp_path):
    path = without_motions(tmp_path)
    state = perform({"do": "state", "workbook": str(path)})["answer"]
    assert (state["lacks"], state["problems"]) == (["motions"], [])
    assert {item["id"] for item in state["sliders"]} == {"friction", "slope", "s_ds", "clearance"}
    assert {item["id"] for item in state["choices"]} == {"rule_set", "units"}
    shown = state["answer"]
    _, _, heads = shown["html"]["arrays"].partition("<thead>")
    heads = re.findall(r">([A-Z][^<]+)<", heads.partition("</thead>")[0])
    assert heads == ["Array", "Design Δ", "Prescriptive", "D/C", "Verdict"]
    assert shown["model_text"].startswith("Prescriptive procedure")
    whole = assess(*prepared(path))
    assert shown["verdict"]["text"] == whole.verdict.value
    # While a slider moves and at rest it is the same, and S_DS moves it.
    job = {"do": "assess", "workbook": str(path), "values": {"s_ds": 1.2}, "room": 740}
    moving, resting = (
        perform(job | {"moving": is_moving})["answer"]["html"]["arrays"]
        for is_moving in (True, False)
    )
    assert first_design(moving) == first_design(resting) != first_design(shown["html"]["arrays"])


def first_design(table):
    """Return the design displacement of the first array of the table of arrays."""
    return re.findall(r"<td[^>]*>(.*?)</td>", table, re.DOTALL)[0]


def prepared(path):
    sheet = read(path)
    return sheet, prepare(sheet)


def test_one_without_motions_and_with_errors_is_offered_none(tmp_path):
    path = without_motions(tmp_path, S_DS=None, S_MS=None, S_S=None)
    state = perform({"do": "state", "workbook": str(path)})["answer"]
    assert (state["project"], state["lacks"]) == (None, [])


def test_a_workbook_with_motions_or_none_at_all_is_not(tmp_path):
    path = type_into(make(tmp_path), {"Motions/M1/Horizontal record": "records/none.csv"})
    assert not perform({"do": "state", "workbook": str(path)})["answer"]["lacks"]
    path.write_bytes(b"none")
    assert not perform({"do": "state", "workbook": str(path)})["answer"]["lacks"]


@pytest.mark.nightly
def test_motions_are_made_into_the_copy_and_its_zip(tmp_path, monkeypatch):
    told = []

    def motions(*_, count, progress, **__):
        progress("motion 1 of 7")
        return records.suite(count)

    monkeypatch.setattr(report.suite.suite_files, "make_suite", motions)
    monkeypatch.setattr(worker, "tell", told.append)
    path, out = without_motions(tmp_path / "p"), tmp_path / "p" / "out"
    # As `report.web.processes` has it: the process has its temporary files beside the workbook.
    (tmp_path / "p" / "own").mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "p" / "own"))
    assert motions_made(path, out) == ""
    assert told == ["Preparing the motions", "Motion 1 of 7", "Plotting the spectra"]
    with zipfile.ZipFile(out / PROJECT) as archive:
        names = set(archive.namelist())
        archive.extractall(tmp_path / "unpacked")
    assert {"input.xlsx", "records/motion-07-z.csv", "records/suite.json"} <= names
    assert not any(name.startswith(("out", "own", "input.before")) for name in names)
    made = read(tmp_path / "unpacked" / "input.xlsx").project.motions
    assert [motion.id for motion in made] == [f"motion-{k:02d}" for k in range(1, MOTIONS + 1)]
    assert made[0].record == "records/motion-01-x.csv"


def test_a_site_that_lacks_a_value_is_told_with_its_cell(tmp_path, monkeypatch):
    path = without_motions(tmp_path / "p", **{"Rule set": None})
    before = path.read_bytes()
    said = motions_made(path, tmp_path / "p" / "out")
    assert said.startswith(f"{cell_address('Site/Rule set')}: ") or "missing" in said
    assert path.read_bytes() == before


@pytest.mark.nightly
def test_a_suite_is_begun_for_what_is_sent_and_is_no_package_of_what_is_open(client, tmp_path):
    path = without_motions(tmp_path, **{"Rule set": None})
    files = [("files", ("p/input.xlsx", path.read_bytes()))]
    before = client.get("/api/state").json()["package"]  # of the example, where a test made one
    made = client.post("/api/motions", files=files).json()["id"]
    assert client.get("/api/state").json()["package"] == before
    deadline = time.monotonic() + 60.0
    while (told := client.get(f"/api/package/{made}").json())["state"] == "running":
        assert time.monotonic() < deadline
        time.sleep(0.1)
    assert told["state"] == "failed"
    assert "missing or cannot be read" in told["words"]
    assert client.get(f"/api/package/{made}/{PROJECT}").status_code == 404
    assert client.post("/api/motions", files=[("files", ("../x.xlsx", b""))]).status_code == 422


OFFER = """
    document.body.innerHTML = "<div hidden></div>";
    const [element] = document.body.children;
    let state = { id: "t", state: "running", words: "Motion 1 of 7", part: 0.2 };
    const canceled = { state: "canceled", is_over: true, words: "Canceled." };
    const sent = [], failed = [], opened = [];
    const api = {
      announce() {},
      startMotions: async (files) => (sent.push(files), state),
      packageState: async () => state,
      cancelPackage: async () => (state = { ...state, ...canceled }),
      file: async (id, name) => ({ blob: `#${id}/${name}` }),
      upload: async (files) => (opened.push(files), {}),
    };
    const open = async (fetched) => { await fetched(); motions.offer(null); };
    const fail = (error) => failed.push(error.message);
    const motions = m.mountMotions(element, api, { open, fail });
    const pause = () => new Promise((done) => setTimeout(done, 20));
    const until = async (selector) => {
      for (let k = 0; k < 150 && !element.querySelector(selector); k += 1) await pause();
      return element.querySelector(selector);
    };
    const isHidden = [element.hidden];
    motions.offer(["a"]); isHidden.push(element.hidden);
    element.querySelector("button").click();
    await until("progress");
"""


OFFERS = {
    "motions that are made are opened and can be saved": ("""
        state = { ...state, state: "done", is_over: true };
        const save = await until(".note + button");
        motions.offer(null); isHidden.push(element.hidden);
        return [isHidden, sent, opened, save.textContent, failed];""",
        [[True, False, True], [["a"]], [[{"file": "#t/project.zip", "path": "project.zip"}]],
         "Save workbook and records (zip)", []]),
    "motions that are made are canceled where another project is opened": ("""
        motions.offer(null);
        for (let k = 0; k < 150 && state.state === "running"; k += 1) await pause();
        return [state.state, element.hidden, opened];""",
        ["canceled", True, []]),
    "motions that are canceled are offered again": ("""
        element.querySelector("button").click();
        for (let k = 0; k < 150 && element.querySelector("progress"); k += 1) await pause();
        const { textContent: text } = element;
        return [text.split(" for")[0], text.split(".").at(-2), opened];""",
        ["No motions? Make seven", "Canceled", []]),
    "motions of which the server no longer tells are offered again": ("""
        api.packageState = async () => { throw new Error("Busy."); };
        for (let k = 0; k < 150 && element.querySelector("progress"); k += 1) await pause();
        const { textContent: text } = element;
        return [text.split(" for")[0], text.slice(-5), opened];""",
        ["No motions? Make seven", "Busy.", []]),
}  # fmt: skip


@cases(OFFERS)
def test_motions_are_offered_until_they_are_made(scripts, steps, expected):
    assert called(scripts, "offers", OFFER + steps) == expected


@pytest.mark.nightly
def test_the_page_makes_motions_and_goes_on_with_them(browser, tmp_path):
    path = without_motions(tmp_path)
    with served() as (address, _), quiet_page(browser) as page:
        opened(page, address)
        assert page.locator("#no-motions").is_hidden()
        assert page.locator("#steps").is_hidden()
        page.set_input_files("#files", [str(path)])
        page.wait_for_selector("#no-motions:visible")
        assert page.inner_text("#steps [aria-current]") == "Motions"
        # Until then it is a project with a verdict of its own.
        page.wait_for_selector("h1:has-text('Alameda Warehouse')")
        at_rest(page)
        assert page.inner_text("#verdict .tag") in ("OK", "NG", "OK with conditions")
        assert page.locator("#tab-slide").is_hidden()
        held = []
        page.route("**/api/upload", lambda route: held.append(route))
        page.set_input_files("#files", [str(path)])
        page.wait_for_selector("#no-motions", state="hidden")
        held[0].continue_()
        page.unroute("**/api/upload")
        page.click("#no-motions button")
        page.wait_for_selector("#no-motions progress")
        page.wait_for_selector("#no-motions button:has-text('Save')", timeout=600_000)
        page.wait_for_selector("body[data-phase=rest]", timeout=60_000)
        assert page.inner_text("h1") == "Alameda Warehouse"
        with page.expect_download() as download:
            page.click("#no-motions button")
        content = io.BytesIO(download.value.path().read_bytes())
        assert len([n for n in zipfile.ZipFile(content).namelist() if n.endswith(".csv")]) == 21
        page.click("#example")
        page.wait_for_selector("#no-motions", state="hidden")
