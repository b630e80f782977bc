"""The functions of the page's scripts, in the browser that runs them, without a server."""

import re

import pytest

from fixtures.browser import STATIC, called, cases
from fixtures.marks import by_day


@pytest.fixture(scope="module")
def page(scripts):
    return scripts


NONE = {"targets": {}, "all": 1}
SLIDERS = [
    {"id": "friction", "typed": 1.0, "real": {"targets": {"A1": 0.45}, "all": 0.45}},
    {"id": "slope", "typed": 0.0, "real": NONE},
]
CHOICES = [{"id": "polarity", "typed": "both", "options": [{"value": "both"}, {"value": "+"}]}]
PROJECT = {"id": "0f", "sliders": SLIDERS, "choices": CHOICES}


def test_an_address_names_project_and_values_and_restores_what_was_changed(page):
    values = {"friction": 0.95, "friction@A1": 0.9, "slope": 0.0, "polarity": "+"}
    body = "return m.toAddress(g.project, g.values);"
    address = called(page, "changes", body, {"project": PROJECT, "values": values})
    assert address == "/p/0f/#friction=0.95&friction@A1=0.9&polarity=%2B"
    none = ["", "#friction=", "#friction=NaN", "#polarity=sideways", "#constructor=1"]
    none += ["#friction@A9=0.9", "#slope@A1=1", "#polarity@A1=%2B"]
    given = {"project": PROJECT, "fragments": [address.partition("/#")[2], *none]}
    body = "return g.fragments.map((one) => m.fromFragment(one, g.project));"
    found = {"friction": 0.95, "friction@A1": 0.9, "polarity": "+"}
    assert called(page, "changes", body, given) == [found, *[{}] * len(none)]


SESSION = """
    const asked = [], shown = [], failed = [];
    const assess = (moving, values, whole) => new Promise((done, failed) => {
      const answered = (more) => done({ of: values.x, moving, ...more });
      asked.push({ moving, values, whole, done: answered, failed });
    });
    const session = m.createSession(assess, (error) => failed.push(error));
    let last = null;
    session.draws(({ phase, answer }) => {
      shown.push({ phase, answer: answer?.verdict === null || answer === last ? null : answer });
      last = answer;
    });
    const pause = (wait) => new Promise((done) => setTimeout(done, wait));
    const tick = () => pause(0);
    const answers = () =>
      shown.filter(({ answer }) => answer).map(({ phase, answer }) => [phase, answer.of]);
"""


STEPS = {
    "while a slider moves one request is open and only the newest values wait": ("""
        for (const x of [1, 2, 3]) session.move({ x });
        const open = asked.length;
        asked[0].done();
        while (asked.length < 2) {
          session.move({ x: 3 });
          await pause(20);
        }
        const two = asked.slice(0, 2).map(({ moving, values }) => [moving, values.x]);
        return [open, two, answers()];""",
        [1, [[True, 1], [True, 3]], [["moving", 1]]]),
    "a move after a pause is asked at once, whatever the gap between two of a drag": ("""
        session.move({ x: 1 });
        asked[0].done(); await pause(300);
        const start = performance.now();
        session.move({ x: 2 });
        while (asked.length < 2) await pause(5);
        return [performance.now() - start < 100, asked.map(({ values }) => values.x)];""",
        [True, [1, 2]]),
    "what is asked is on its way before the page draws that it waits": ("""
        const sent = [];
        session.draws(() => sent.push(asked.length));
        session.move({ x: 1 });
        session.release();
        session.enter({ x: 2 });
        return sent;""",
        [1, 2, 2]),
    "the full model answers at rest, and a late provisional answer is dropped": ("""
        session.move({ x: 1 });
        session.release();
        asked[1].done(); await tick();
        asked[0].done(); await tick();
        return [asked.map(({ moving }) => moving), answers(), shown.at(-1).phase];""",
        [[True, False], [["rest", 1]], "rest"]),
    "a full answer for values that have changed is dropped": ("""
        session.enter({ x: 1 });
        session.enter({ x: 2 });
        asked[0].done(); await tick();
        const early = answers();
        asked[1].done(); await tick();
        return [early, asked.map(({ values }) => values.x), answers()];""",
        [[], [1, 2], [["rest", 2]]]),
    "after an error the next value is asked": ("""
        session.enter({ x: 1 });
        asked[0].failed(new Error("gone")); await tick();
        session.enter({ x: 2 });
        asked[1].done(); await tick();
        return [failed.map(({ message }) => message), answers()];""",
        [["gone"], [["rest", 2]]]),
    "a slider that stays where it is rests": ("""
        session.move({ x: 1 });
        asked[0].done(); await tick();
        while (shown.at(-1).phase !== "settling") await pause(20);
        return asked.map(({ moving }) => moving);""",
        [True, False]),
    "a provisional answer that waits is asked at rest only where the full one is slow": ("""
        session.move({ x: 1 });
        asked[0].done(); await pause(100);
        session.move({ x: 2 });
        session.release();
        const start = performance.now();
        while (asked.length < 3) await pause(20);
        const waited = performance.now() - start;
        return [asked.map(({ moving, values }) => [moving, values.x]), waited >= 390];""",
        [[[True, 1], [False, 2], [True, 2]], True]),
    "a slow provisional answer is shown until the full one is there": ("""
        session.move({ x: 1 });
        await pause(800);
        for (const k of [0, 1]) { asked[k].done(); await tick(); }
        return [asked.map(({ moving }) => moving), answers()];""",
        [[True, False], [["settling", 1], ["rest", 1]]]),
    "after the full answer a slow provisional one is dropped": ("""
        session.move({ x: 1 });
        await pause(800);
        for (const k of [1, 0]) { asked[k].done(); await tick(); }
        return [asked.map(({ moving }) => moving), answers()];""",
        [[True, False], [["rest", 1]]]),
    "a full answer is asked again where the slider went on": ("""
        session.move({ x: 1 });
        await pause(800);
        session.move({ x: 2 });
        session.release();
        asked[1].done(); await tick();
        const early = answers();
        asked.at(-1).done(); await tick();
        return [asked.map(({ moving, values }) => [moving, values.x]), early, answers()];""",
        [[[True, 1], [False, 1], [False, 2]], [], [["rest", 2]]]),
    "what an answer lacks is asked next and shown in its place": ("""
        session.enter({ x: 1 });
        asked[0].done({ pending: "less" }); await tick();
        asked[1].done(); await tick();
        return [asked.map(({ whole }) => whole), answers()];""",
        [[False, True], [["rest", 1], ["rest", 1]]]),
    "what an answer lacks is asked once the pointer lets the slider go": ("""
        session.move({ x: 1 });
        await pause(800);
        asked[1].done({ pending: "less" }); await tick();
        const held = asked.length;
        session.release();
        asked[2].done(); await tick();
        return [held, asked.map(({ moving, whole }) => [moving, whole]), answers()];""",
        [2, [[True, False], [False, False], [False, True]], [["rest", 1], ["rest", 1]]]),
    "a step that is no drag is answered in full at once": ("""
        session.move({ x: 1 }, true);
        asked[0].done(); await tick();
        return [asked.map(({ moving }) => moving), answers()];""",
        [[False], [["rest", 1]]]),
    "after a step the slider may go on": ("""
        for (const x of [1, 2]) session.move({ x }, true);
        asked[0].done(); asked[1].done(); await tick();
        session.release();
        asked[2].done(); await tick();
        return [asked.map(({ moving, values }) => [moving, values.x]), answers()];""",
        [[[False, 1], [True, 2], [False, 2]], [["moving", 2], ["rest", 2]]]),
    "a step whose full answer takes long is answered provisionally meanwhile": ("""
        session.move({ x: 1 }, true);
        while (asked.length < 2) await pause(20);
        asked[1].done(); await tick();
        const phase = shown.at(-1).phase;
        asked[0].done(); await tick();
        return [asked.map(({ moving }) => moving), phase, answers()];""",
        [[False, True], "settling", [["settling", 1], ["rest", 1]]]),
}  # fmt: skip


@cases(STEPS)
def test_a_session_asks_for_the_newest_values_and_shows_no_older_answer(page, steps, expected):
    assert called(page, "session", SESSION + steps) == expected


UNITS = {
    "sliders": [
        {"id": "friction", "label": "Friction", "unit": "×", "step": 0.01, "typed": 1},
        {"id": "slope", "label": "Slope", "unit": "°", "step": 0.1, "typed": 0},
        {"id": "clearance", "label": "Clearance", "unit": "in", "step": 1, "typed": 0},
    ],
    "choices": [
        {"id": "rule_set", "label": "Rule set", "typed": "a", "options": [
            {"value": "a", "label": "ASCE A"}, {"value": "b", "label": "ASCE B"}]},
    ],
}  # fmt: skip


def test_a_value_is_written_with_its_unit_and_what_is_changed_by_its_name(page):
    body = """const own = g.values.map((all, k) => all.map((value) => m.own(g.sliders[k], value)));
        return [own, g.all.map((one) => m.changes(one, g))];"""
    values = [[0.83, 1, 0.955], [0.7, 0, -1], [3, -3]]
    all_ = [{"friction": 0.9, "slope": 0, "rule_set": "b"}, {"friction": 1, "rule_set": "a"}, {}]
    assert called(page, "changes", body, UNITS | {"values": values, "all": all_}) == [
        [["× 0.83", "× 1.00", "× 0.955"], ["+0.7°", "0.0°", "−1.0°"], ["+3 in", "−3 in"]],
        ["Friction × 0.90, Rule set: ASCE B", *["the values of the workbook"] * 2],
    ]


TURN = """
    const asked = [], inFull = [];
    const ask = async (values, isQuick) => {
      (isQuick ? asked : inFull).push(values[g.id]);
      const at = 1.065 + (isQuick ? g.off : 0);
      const isNg = g.id === "intensity" ? values[g.id] > at : values[g.id] < at;
      return isNg ? { look: "ng", text: "NG" } : { look: "conditions", text: "OK with conditions" };
    };
    const slider = { id: g.id, least: 0.5, greatest: g.greatest, step: 0.01 };
    const values = { [g.id]: g.value, slope: 0 };
    const found = await m.turnOf(slider, values, g.isNg, ask, () => asked.length < 20);
    const areBoth = found && [found.before, found.value].every((one) => inFull.includes(one));
    return [found, areBoth, asked.length < 10, inFull.length, Math.max(...asked, ...inFull)];"""


@pytest.mark.parametrize(
    ("slider", "value", "is_ng", "greatest", "expected"),
    [
        ("friction", 0.8, True, 2.0, (1.07, "OK with conditions", 1.06)),
        ("friction", 1.3, False, 2.0, (1.06, "NG", 1.07)),
        ("intensity", 1.4, True, 2.0, (1.06, "OK with conditions", 1.07)),
        ("intensity", 1.0, False, 2.0, (1.07, "NG", 1.06)),
        ("friction", 0.8, True, 1.05, None),  # at the end of the slider the verdict is the same
    ],
)
@pytest.mark.parametrize("off", [0.0, -0.02, 0.02])
def test_a_mark_is_where_the_verdict_changes_and_both_sides_were_asked_in_full(
    page, slider, value, is_ng, greatest, expected, off
):
    """Also where the provisional verdicts that lead there are not the full ones."""
    given = {"id": slider, "value": value, "isNg": is_ng, "greatest": greatest, "off": off}
    found, are_both, is_quick, n_full, most = called(page, "turns", TURN, given)
    assert is_quick
    assert n_full <= (3 if not off else 12)
    assert most <= greatest
    assert bool(are_both) == bool(expected)
    assert (found and tuple(found[name] for name in ("value", "verdict", "before"))) == expected


SLIDER = {
    "id": "friction", "label": "Friction", "unit": "×", "least": 0.5, "greatest": 1.01,
    "step": 0.01, "typed": 1, "help": "", "stops": {"greatest": "Largest permitted value."},
    "real": {"symbol": "μ", "unit": "", "digits": 3, "targets": {"A1": 0.45, "A2": 0.5},
             "all": None, "is_beside": False, "with_choice": {}},
}  # fmt: skip
MOUNT = """
    document.body.innerHTML = "<div></div>";
    document.body.firstChild.style.width = "250px";
    const { createSession } = await import("/static/session.js");
    const session = createSession(async () => null, () => {});
    const values = { friction: g.value, slope: 0 };
    const project = { sliders: [g.slider], choices: [] };
    const answer = { values, shown: { friction: "0.45 (A1)" } };
    const draw = m.mountSliders(document.body.firstChild, project, session);
    session.draws(draw);
    session.set({ project, values, answer, shows: "final", ...g.state });
    const shown = (selector) => document.querySelector(selector).textContent;
"""


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (1.01, ["× 1.01", "Largest permitted value.", False]),
        (1, ["× 1.00", "0.45 (A1)", True]),
        (0.5, ["× 0.50", "0.45 (A1)", False]),
        (1.001, ["× 1.001", "0.45 (A1)", False]),
    ],
)
def test_a_slider_shows_the_value_that_is_computed_and_why_it_goes_no_further(page, value, shown):
    body = f"""{MOUNT}
        const isIdle = document.querySelector(".back:not(.turn)").classList.contains("is-idle");
        return [shown(".amount"), shown("output"), isIdle];"""
    assert called(page, "sliders", body, {"slider": SLIDER, "value": value}) == shown


BESIDE = """
    const has = (selector, name) => document.querySelector(selector).classList.contains(name);
    const isMarked = !has(".turn-mark", "is-idle") && !has(".turn", "is-idle");
    const said = document.querySelector("[type=range]").getAttribute("aria-valuetext");
    return [has("output", "is-former"), said, isMarked && shown(".turn")];"""
TURNED = {"value": 1.0, "before": 0.99, "verdict": "OK", "others": {"friction": 0.8, "slope": 0}}


@pytest.mark.parametrize(
    ("state", "beside"),
    [
        ({}, [False, "0.45 (A1)", False]),
        ({"turned": {"friction": TURNED}}, [False, "0.45 (A1)", "OK at × 1.00"]),
        # What the tables show is of other values, or of no answer.
        ({"shows": "former"}, [True, "× 0.90", False]),
        ({"shows": "former", "turned": {"friction": TURNED}}, [True, "× 0.90", False]),
        ({"answer": None}, [True, "× 0.90", False]),
        # Found beside another slope.
        ({"turned": {"friction": TURNED | {"others": {"slope": 1}}}}, [False, "0.45 (A1)", False]),
    ],
)
def test_text_and_mark_beside_a_slider_are_of_the_values_of_the_tables(page, state, beside):
    given = {"slider": SLIDER, "value": 0.9, "state": state}
    assert called(page, "sliders", MOUNT + BESIDE, given) == beside


@pytest.mark.parametrize(
    ("picked", "typed", "entered"),
    [
        # Of all arrays, which differ: each gets the factor that makes the quantity.
        (None, 0.4, {"friction": 0.9, "slope": 0, "friction@A1": 0.888889, "friction@A2": 0.8}),
        ("A2", 0.4, {"friction": 0.9, "slope": 0, "friction@A2": 0.8}),
    ],
)
def test_a_quantity_that_is_typed_is_entered_for_all_or_for_what_is_picked(
    page, picked, typed, entered
):
    body = f"""{MOUNT}
        const field = document.querySelector("[type=number]");
        const before = [field.value, field.ariaLabel];
        field.value = g.typed;
        field.dispatchEvent(new Event("change"));
        return [before, session.state.values, field.value];"""
    given = {"slider": SLIDER, "value": 0.9, "state": {"picked": picked}, "typed": typed}
    (before, of), values, after = called(page, "sliders", body, given)
    assert (before, of) == (("0.450", "μ of A2") if picked else ("", "μ of all"))
    assert values == entered
    assert after == "0.400"


def test_what_is_set_for_all_leaves_no_array_its_own(page):
    body = "return [m.entered(g, '', 0.8), m.entered(g, 'A2', 0.8), m.entered(g, 'RTU-1', 0.8)];"
    found = called(page, "changes", body, SLIDER)
    of_all = {"friction": 0.8, "friction@A1": None, "friction@A2": None}
    assert found == [of_all, {"friction@A2": 0.8}, of_all]


@pytest.mark.nightly
def test_the_values_beside_that_of_the_workbook_can_be_chosen_with_the_mouse(page):
    called(page, "sliders", MOUNT, {"slider": SLIDER, "value": 0.7})
    box = page.locator("[type=range]").bounding_box()
    y = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + 100, y)
    page.mouse.down()
    chosen = set()
    for x in range(int(box["width"]) - 30, int(box["width"])):
        page.mouse.move(box["x"] + x, y)
        chosen.add(page.locator(".amount").inner_text())
    page.mouse.up()
    assert {"× 0.98", "× 0.99", "× 1.00", "× 1.01"} <= chosen


TAKEAWAY = """
    const button = "<button></button>";
    document.body.innerHTML = `${button}${button}${button}<div></div><div></div>`;
    const [make, workbook, copy, status, told] = document.body.children;
    let values = { friction: 0.9 };
    let state = { id: "t", state: "running", words: "Plans", part: 0.2, values };
    state.files = ["calc-package.pdf", "results.xlsx", "results.json", "plan.dxf"];
    const canceled = { state: "canceled", is_over: true, words: "The package was canceled." };
    const failed = [], asked = [];
    const api = {
      announce() {},
      startPackage: async () => state,
      packageState: async () => (asked.push("state"), state),
      cancelPackage: async () => (asked.push("cancel"), (state = { ...state, ...canceled })),
      ...g?.api,
    };
    const all = { values: () => values, words: ({ friction }) => `friction ${friction}`,
      fail: (error) => failed.push(error.message), forget() {} };
    const takeaway = m.mountTakeaway({ make, workbook, copy, status, told }, api, all);
    const pause = () => new Promise((done) => setTimeout(done, 20));
    const until = async (holds) => {
      for (let k = 0; k < 150 && !holds(); k += 1) await pause();
    };
    const has = (selector) => until(() => status.querySelector(selector));
    const note = () => status.querySelector(".made-with").textContent;
"""


PACKAGES = {
    "a package names what it is made with wherever the page has other values": ("""
        make.click(); await has("progress");
        const notes = [note()];
        values = { friction: 0.8 }; takeaway.compare();
        notes.push(note());
        state = { ...state, state: "done", is_over: true }; await has(".made");
        notes.push(note());
        values = { friction: 0.9 }; takeaway.compare();
        return [...notes, note()];""",
        ["", "Started before the last change of values, with friction 0.9.",
         "Made before the last change of values, with friction 0.9.", ""]),
    "a package that is canceled and made again at once is the one that is followed": ("""
        make.focus();
        make.click(); await has("progress");
        const focused = [document.activeElement.textContent];
        let answer;
        const over = { ...state, ...canceled };
        api.cancelPackage = () => new Promise((done) => { answer = () => done(over); });
        status.querySelector("button").click();
        const seen = [make.disabled];
        answer(); await until(() => !make.disabled);
        await pause();
        focused.push(document.activeElement === make);
        seen.push(status.textContent);
        make.click(); await has("progress");
        await pause();
        return [focused, ...seen, make.disabled, status.textContent];""",
        [["Cancel", True], True, "The package was canceled.", True, "PlansCancel"]),
    "a package is found on loading and gone with its project": ("""
        takeaway.open(state); await has("progress");
        const seen = [make.disabled, document.activeElement === document.body];
        takeaway.open(null);
        seen.push(make.disabled, status.textContent.slice(0, 11));
        takeaway.open({ ...state, state: "done", is_over: true }); await has(".made");
        return [...seen, make.disabled, status.querySelectorAll(".made button").length];""",
        [True, True, False, "", False, 4]),
    "without the server no bar is left and the package can be asked for again": ("""
        make.click(); await has("progress");
        const answer = api.packageState;
        api.packageState = async () => { throw new Error("The server does not answer."); };
        await until(() => failed.length > 0);
        const seen = [failed, status.querySelector("progress"), make.disabled];
        api.packageState = answer;
        make.click(); await has("progress");
        return seen;""",
        [["The server does not answer."], None, False]),
}  # fmt: skip


@cases(PACKAGES)
def test_a_package_is_followed_from_its_beginning_to_its_files(page, steps, expected):
    assert called(page, "package", TAKEAWAY + steps) == expected


UPLOAD = """
    const part = () => document.createElement("input");
    const taken = [], told = [], failed = [];
    m.mountUpload({ zone: part(), files: part(), folder: part() }, {
      begin: (text) => told.push(text),
      take: (files) => taken.push(files.map(({ path }) => path)),
      fail: ({ message }) => failed.push(message),
    });
    const entry = (path, file) => ({ isFile: true, fullPath: path, file });
    const drop = (dropped) => {
      const event = new Event("drop");
      event.dataTransfer = { items: [{ webkitGetAsEntry: () => dropped }] };
      dispatchEvent(event);
    };
    const tick = () => new Promise((done) => setTimeout(done, 0));
"""
DROPS = {
    "a drop is told at once, and of two the last is taken though it is listed first": ("""
        const answers = [];
        const late = (path) => entry(path, (done) => answers.push(() => done(path)));
        drop(late("/first")); drop(late("/last"));
        const early = [...told];
        for (const answer of answers.toReversed()) { answer(); await tick(); }
        return [early, taken];""",
        [["Reading the files …"] * 2, [["last"]]]),
    "files that cannot be read are an error, and nothing is under way": ("""
        drop(entry("/gone", (_, fails) => fails(new Error("Gone."))));
        await tick();
        return [told.at(-1), failed];""",
        ["", ["The files could not be read: Gone. Drop them again."]]),
    "a folder is read in as many parts as the browser lists, with the paths of its files": ("""
        const names = ["input.xlsx", "~$input.xlsx", "records/a.csv"];
        const createReader = () => {
          const left = names.map((name) => entry(`/mine/${name}`, (done) => done(name)));
          return { readEntries: (done) => done(left.splice(0, 2)) };
        };
        drop({ isFile: false, fullPath: "/mine", createReader });
        await tick();
        return taken;""",
        [["mine/input.xlsx", "mine/records/a.csv"]]),
}  # fmt: skip


@cases(DROPS)
def test_what_is_dropped_is_read_or_refused(page, steps, expected):
    assert called(page, "upload", UPLOAD + steps) == expected


def test_what_was_opened_last_is_shown_and_asked_about_whichever_answer_comes_first(page):
    body = """
        const asked = [], answers = [], real = fetch;
        fetch = (url, options) => new Promise((done) => {
          asked.push(options);
          answers.push((state) => done(new Response(JSON.stringify(state))));
        });
        const tick = () => new Promise((done) => setTimeout(done, 0));
        const api = m.createApi(() => {}, () => 560), states = [];
        for (const k of [1, 2]) api.upload([]).then((state) => states.push(state?.opened));
        for (const k of [1, 0]) {
          answers[k]({ opened: `upload-${k + 1}`, project: {} });
          await tick();
        }
        api.upload([]); await tick();
        answers[2]({ opened: "upload-3", project: null }); await tick(); // it has errors
        api.assess(false, {}); await tick();
        fetch = real;
        return [states, JSON.parse(asked[3].body).opened];"""
    states, opened = called(page, "api", body)
    assert states == ["upload-2", None]
    assert opened == "upload-2"


PATHS = ["p/input.xlsx", "p/~$input.xlsx", "p/.DS_Store", "p/records/a.csv", "__MACOSX/p/x"]
KEYS = [["ArrowRight", 4], ["ArrowLeft", 0], ["Home", 3], ["End", 1], ["a", 1]]
FUNCTIONS = {
    "hidden files and Excel's lock are not sent": (
        "upload", "return m.visible(g.map((path) => ({ path }))).map(({ path }) => path);",
        PATHS, ["p/input.xlsx", "p/records/a.csv"]),
    "arrow keys go around the tabs": (
        "views", "return g.map(([key, at]) => m.destination(key, at, 5));", KEYS, [0, 4, 0, 4, -1]),
    "a subscript is set as one": (
        "make", "return m.html('p', {}, m.words(g)).innerHTML;", "S_DS and F_a of A_1B, a_b",
        "S<sub>DS</sub> and F<sub>a</sub> of A<sub>1B</sub>, a_b"),
}  # fmt: skip


@pytest.mark.parametrize(
    ("module", "body", "given", "expected"), FUNCTIONS.values(), ids=list(FUNCTIONS)
)
def test_a_function_gives_what_is_expected(page, module, body, given, expected):
    assert called(page, module, body, given) == expected


@pytest.mark.quick
def test_no_script_or_page_uses_the_network_or_inline_code():
    for file in STATIC.iterdir():
        text = file.read_text()
        assert not re.search(r"https?://(?!www\.w3\.org/2000/svg)", text), file
        assert not re.search(r"innerHTML|\beval\(|new Function|\sstyle=|\son[a-z]+=\"", text), file


_COLOR = re.compile(r"--([\w-]+): light-dark\((#[0-9a-f]{6}), (#[0-9a-f]{6})\);")


def _luminance(color):
    parts = [int(color[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    linear = [p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]
    return sum(w * p for w, p in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


def _contrast(a, b):
    darker, lighter = sorted((_luminance(a), _luminance(b)))
    return (lighter + 0.05) / (darker + 0.05)


@pytest.mark.parametrize("theme", by_day([0, 1], 1), ids=["light", "dark"])
@pytest.mark.quick
def test_text_has_the_contrast_of_wcag_aa(theme):
    found = _COLOR.findall((STATIC / "style.css").read_text())
    colors = {name: both[theme] for name, *both in found}
    for text in ("ink", "muted", "accent", "ng", "ok", "conditions"):
        for ground in ("paper", "wash", "accent-wash"):
            assert _contrast(colors[text], colors[ground]) >= 4.5, (text, ground)
    # What bounds a control or draws a curve needs 3 (WCAG 1.4.11).
    for line in ("rule", "across"):
        assert _contrast(colors[line], colors["paper"]) >= 3.0, line
