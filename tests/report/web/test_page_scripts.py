"""The functions of the page's scripts, in the browser that runs them, without a server."""

import re

import pytest

from browsing import STATIC, quiet_page, serve_scripts


@pytest.fixture(scope="module")
def page(browser):
    with quiet_page(browser) as page:
        serve_scripts(page)
        yield page


def called(page, module, body, given=None):
    """Return what a body of JavaScript returns with a module `m` and what is given `g`."""
    script = f"async (g) => {{ const m = await import('/static/{module}.js'); {body} }}"
    return page.evaluate(script, given)


SLIDERS = [{"id": "friction", "typed": 1.0}, {"id": "slope", "typed": 0.0}]
CHOICES = [{"id": "polarity", "typed": "both", "options": [{"value": "both"}, {"value": "+"}]}]
LINK = {"sliders": SLIDERS, "choices": CHOICES}
RESTORED = "return g.fragments.map((one) => m.fromFragment(one, g.sliders, g.choices));"


def test_a_link_holds_what_was_changed_and_restores_it(page):
    values = {"friction": 0.95, "slope": 0.0, "polarity": "+"}
    body = "return m.toFragment(g.values, [...g.sliders, ...g.choices]);"
    fragment = called(page, "changes", body, LINK | {"values": values})
    assert fragment == "friction=0.95&polarity=%2B"
    restored = called(page, "changes", RESTORED, LINK | {"fragments": [f"#{fragment}"]})
    assert restored == [{"friction": 0.95, "polarity": "+"}]


def test_a_link_that_names_no_value_changes_nothing(page):
    none = ["", "#friction=", "#friction=NaN", "#polarity=sideways", "#constructor=1"]
    assert called(page, "changes", RESTORED, LINK | {"fragments": none}) == [{}] * 5


SESSION = """
    const asked = [], shown = [];
    const assess = (moving, values, whole) => new Promise((done, failed) => {
      const answered = (more) => done({ of: values.x, moving, ...more });
      asked.push({ moving, values, whole, done: answered, failed });
    });
    const failed = [];
    const fail = (error) => failed.push(error);
    const session = m.createSession(assess, (one) => shown.push(one), fail);
    const tick = () => new Promise((done) => setTimeout(done, 0));
    const answers = () =>
      shown.filter(({ answer }) => answer).map(({ phase, answer }) => [phase, answer.of]);
"""


def session(page, steps):
    return called(page, "session", SESSION + steps)


def test_while_a_slider_moves_one_request_is_open_and_only_the_newest_values_wait(page):
    steps = """
        for (const x of [1, 2, 3]) session.move("x", x);
        const open = asked.length;
        asked[0].done(); await tick();
        return [open, asked.map(({ moving, values }) => [moving, values.x]), answers()];"""
    assert session(page, steps) == [1, [[True, 1], [True, 3]], [["moving", 1]]]


def test_the_full_model_answers_at_rest_and_a_late_provisional_answer_is_dropped(page):
    steps = """
        session.move("x", 1);
        session.release();
        asked[1].done(); await tick();
        asked[0].done(); await tick();
        return [asked.map(({ moving }) => moving), answers(), shown.at(-1).phase];"""
    assert session(page, steps) == [[True, False], [["rest", 1]], "rest"]


def test_a_full_answer_for_values_that_have_changed_is_dropped(page):
    steps = """
        session.set({ x: 1 });
        session.set({ x: 2 });
        asked[0].done(); await tick();
        const early = answers();
        asked[1].done(); await tick();
        return [early, asked.map(({ values }) => values.x), answers()];"""
    assert session(page, steps) == [[], [1, 2], [["rest", 2]]]


def test_after_an_error_the_next_value_is_asked(page):
    steps = """
        session.set({ x: 1 });
        asked[0].failed(new Error("gone")); await tick();
        session.set({ x: 2 });
        asked[1].done(); await tick();
        return [failed.map(({ message }) => message), answers()];"""
    assert session(page, steps) == [["gone"], [["rest", 2]]]


def test_a_slider_that_stays_where_it_is_rests(page):
    steps = """
        session.move("x", 1);
        asked[0].done(); await tick();
        while (shown.at(-1).phase !== "settling") await new Promise((done) => setTimeout(done, 20));
        return asked.map(({ moving }) => moving);"""
    assert session(page, steps) == [True, False]


STAYED = """
        session.move("x", 1);
        await new Promise((done) => setTimeout(done, 400));
        for (const k of g) { asked[k].done(); await tick(); }
        return [asked.map(({ moving }) => moving), answers()];"""
SHOWN = {(0, 1): [["settling", 1], ["rest", 1]], (1, 0): [["rest", 1]]}


@pytest.mark.parametrize("order", SHOWN)
def test_of_a_slow_provisional_and_the_full_answer_the_first_is_shown(page, order):
    shown = called(page, "session", SESSION + STAYED, order)
    assert shown == [[True, False], SHOWN[order]]


def test_a_full_answer_is_asked_again_where_the_slider_went_on(page):
    steps = """
        session.move("x", 1);
        await new Promise((done) => setTimeout(done, 100));
        session.move("x", 2);
        session.release();
        asked[1].done(); await tick();
        const early = answers();
        asked.at(-1).done(); await tick();
        return [asked.map(({ moving, values }) => [moving, values.x]), early, answers()];"""
    asked = [[True, 1], [False, 1], [False, 2]]
    assert session(page, steps) == [asked, [], [["rest", 2]]]


def test_what_an_answer_lacks_is_asked_next_and_shown_in_its_place(page):
    steps = """
        session.set({ x: 1 });
        asked[0].done({ pending: "less" }); await tick();
        asked[1].done(); await tick();
        return [asked.map(({ whole }) => whole), answers()];"""
    assert session(page, steps) == [[False, True], [["rest", 1], ["rest", 1]]]


def test_a_step_that_is_no_drag_is_answered_in_full_at_once(page):
    steps = """
        session.move("x", 1, true);
        asked[0].done(); await tick();
        return [asked.map(({ moving }) => moving), answers()];"""
    assert session(page, steps) == [[False], [["rest", 1]]]


def test_after_a_step_the_slider_may_go_on(page):
    steps = """
        for (const x of [1, 2]) session.move("x", x, true);
        asked[0].done(); asked[1].done(); await tick();
        session.release();
        asked[2].done(); await tick();
        return [asked.map(({ moving, values }) => [moving, values.x]), answers()];"""
    asked = [[False, 1], [True, 2], [False, 2]]
    assert session(page, steps) == [asked, [["moving", 2], ["rest", 2]]]


def test_a_step_whose_full_answer_takes_long_is_answered_provisionally_meanwhile(page):
    steps = """
        session.move("x", 1, true);
        while (asked.length < 2) await new Promise((done) => setTimeout(done, 20));
        asked[1].done(); await tick();
        const phase = shown.at(-1).phase;
        asked[0].done(); await tick();
        return [asked.map(({ moving }) => moving), phase, answers()];"""
    assert session(page, steps) == [[False, True], "settling", [["settling", 1], ["rest", 1]]]


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


def test_the_value_of_a_slider_is_written_with_its_unit_and_in_full_between_steps(page):
    body = "return g.values.map((all, k) => all.map((value) => m.own(g.sliders[k], value)));"
    values = [[0.83, 1, 0.955], [0.7, 0, -1], [3, -3]]
    assert called(page, "changes", body, UNITS | {"values": values}) == [
        ["× 0.83", "× 1.00", "× 0.955"], ["+0.7°", "0.0°", "−1.0°"], ["+3 in", "−3 in"]
    ]  # fmt: skip


def test_what_is_changed_is_named_and_what_is_as_typed_is_not(page):
    body = "return g.values.map((one) => m.changes(one, g));"
    values = [{"friction": 0.9, "slope": 0, "rule_set": "b"}, {"friction": 1, "rule_set": "a"}, {}]
    found = called(page, "changes", body, UNITS | {"values": values})
    assert found == ["Friction × 0.90, Rule set: ASCE B", *["the values of the workbook"] * 2]


TURN = """
    const asked = [];
    const ask = async (values) => {
      asked.push(values[g.id]);
      const isNg = g.falls ? values[g.id] > 1.065 : values[g.id] < 1.065;
      return isNg ? { look: "ng", text: "NG" } : { look: "conditions", text: "OK with conditions" };
    };
    const slider = { id: g.id, least: 0.5, greatest: g.greatest, step: 0.01 };
    const values = { [g.id]: g.value, slope: 0 };
    const found = await m.turnOf(slider, values, g.isNg, ask, () => asked.length < 20);
    return [found, asked.length < 10, Math.max(...asked)];"""


@pytest.mark.parametrize(
    ("slider", "value", "is_ng", "falls", "expected"),
    [
        ("friction", 0.8, True, False, (1.07, "OK with conditions", 1.06)),
        ("friction", 1.3, False, False, (1.06, "NG", 1.07)),
        ("intensity", 1.4, True, True, (1.06, "OK with conditions", 1.07)),
        ("intensity", 1.0, False, True, (1.07, "NG", 1.06)),
    ],
)
def test_a_mark_is_where_the_verdict_changes_and_both_sides_were_asked(
    page, slider, value, is_ng, falls, expected
):
    given = {"id": slider, "value": value, "isNg": is_ng, "falls": falls, "greatest": 2.0}
    found, is_quick, _ = called(page, "turns", TURN, given)
    assert tuple(found[name] for name in ("value", "verdict", "before")) == expected
    assert is_quick


def test_there_is_no_mark_where_the_end_of_the_slider_has_the_same_verdict(page):
    given = {"id": "friction", "value": 0.8, "isNg": True, "falls": False, "greatest": 1.05}
    assert called(page, "turns", TURN, given) == [None, True, 1.05]


SLIDER = {
    "id": "friction", "label": "Friction", "unit": "×", "least": 0.5, "greatest": 1.01,
    "step": 0.01, "typed": 1, "help": "", "stops": {"greatest": "No value beyond the greatest."},
}  # fmt: skip
MOUNT = """
    document.body.innerHTML = "<div></div>";
    document.body.firstChild.style.width = "250px";
    const values = { friction: g.value };
    const move = (id, value) => (values[id] = value);
    const session = { values: () => values, move, set() {}, release() {} };
    const state = { sliders: [g.slider], choices: [] };
    m.mountSliders(document.body.firstChild, state, values, session);
    document.querySelector("input").style.width = "250px";
    const shown = (selector) => document.querySelector(selector).textContent;
"""


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (1.01, ["× 1.01", "No value beyond the greatest.", False]),
        (1, ["× 1.00", "", True]),
        (0.5, ["× 0.50", "", False]),
        (1.001, ["× 1.001", "", False]),
    ],
)
def test_a_slider_shows_the_value_that_is_computed_and_why_it_goes_no_further(page, value, shown):
    body = f"""{MOUNT}
        const isIdle = document.querySelector(".back").classList.contains("is-idle");
        return [shown(".amount"), shown("output"), isIdle];"""
    assert called(page, "sliders", body, {"slider": SLIDER, "value": value}) == shown


@pytest.mark.nightly
def test_the_values_beside_that_of_the_workbook_can_be_chosen_with_the_mouse(page):
    called(page, "sliders", MOUNT, {"slider": SLIDER, "value": 0.7})
    box = page.locator("input").bounding_box()
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
    document.body.innerHTML = `${button}${button}${button}<div></div>`;
    const [make, workbook, copy, status] = document.body.children;
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
    const takeaway = m.mountTakeaway({ make, workbook, copy, status }, api, all);
    const pause = () => new Promise((done) => setTimeout(done, 20));
    const until = async (holds) => {
      for (let k = 0; k < 150 && !holds(); k += 1) await pause();
    };
    const has = (selector) => until(() => status.querySelector(selector));
    const note = () => status.querySelector(".made-with").textContent;
"""


def takeaway(page, steps):
    return called(page, "package", TAKEAWAY + steps)


def test_a_package_names_what_it_is_made_with_wherever_the_page_has_other_values(page):
    steps = """
        make.click(); await has("progress");
        const notes = [note()];
        values = { friction: 0.8 }; takeaway.compare();
        notes.push(note());
        state = { ...state, state: "done", is_over: true }; await has(".made");
        notes.push(note());
        values = { friction: 0.9 }; takeaway.compare();
        return [...notes, note()];"""
    before = "before the last change of values, with friction 0.9."
    assert takeaway(page, steps) == ["", f"Started {before}", f"Made {before}", ""]


def test_a_package_that_is_canceled_and_made_again_at_once_is_the_one_that_is_followed(page):
    steps = """
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
        return [focused, ...seen, make.disabled, status.textContent];"""
    focused, *found = takeaway(page, steps)
    assert focused == ["Cancel", True]
    assert found == [True, "The package was canceled.", True, "PlansCancel"]


def test_a_package_is_found_on_loading_and_gone_with_its_project(page):
    steps = """
        takeaway.open(state); await has("progress");
        const seen = [make.disabled, document.activeElement === document.body];
        takeaway.open(null);
        seen.push(make.disabled, status.textContent.slice(0, 11));
        takeaway.open({ ...state, state: "done", is_over: true }); await has(".made");
        return [...seen, make.disabled, status.querySelectorAll(".made button").length];"""
    assert takeaway(page, steps) == [True, True, False, "The package", False, 4]


def test_without_the_server_no_bar_is_left_and_the_package_can_be_asked_for_again(page):
    steps = """
        make.click(); await has("progress");
        const answer = api.packageState;
        api.packageState = async () => { throw new Error("The server does not answer."); };
        await until(() => failed.length > 0);
        const seen = [failed, status.querySelector("progress"), make.disabled];
        api.packageState = answer;
        make.click(); await has("progress");
        return seen;"""
    assert takeaway(page, steps) == [["The server does not answer."], None, False]


def test_hidden_files_and_excels_lock_are_not_sent(page):
    names = ["p/input.xlsx", "p/~$input.xlsx", "p/.DS_Store", "p/records/a.csv", "__MACOSX/p/x"]
    body = "return m.visible(g.map((path) => ({ path }))).map(({ path }) => path);"
    assert called(page, "upload", body, names) == ["p/input.xlsx", "p/records/a.csv"]


def test_a_drop_is_told_at_once_and_of_two_the_last_is_taken_though_it_is_listed_first(page):
    body = """
        const part = () => document.createElement("input");
        const taken = [], told = [];
        const take = (files) => taken.push(files);
        const begin = (text) => told.push(text);
        m.mountUpload({ zone: part(), files: part(), folder: part() }, { begin, take, fail() {} });
        const answers = [];
        const drop = (path) => {
          const file = (done) => answers.push(() => done(path));
          const entry = { isFile: true, fullPath: path, file };
          const event = new Event("drop");
          event.dataTransfer = { items: [{ webkitGetAsEntry: () => entry }] };
          dispatchEvent(event);
        };
        drop("/first"); drop("/last");
        const early = [...told];
        for (const answer of answers.toReversed()) {
          answer();
          await new Promise((done) => setTimeout(done, 0));
        }
        return [early, taken.map((files) => files.map(({ path }) => path))];"""
    assert called(page, "upload", body) == [["Reading the files …"] * 2, [["last"]]]


def test_files_that_cannot_be_read_are_an_error_and_nothing_is_under_way(page):
    body = """
        const part = () => document.createElement("input");
        const told = [], failed = [];
        m.mountUpload({ zone: part(), files: part(), folder: part() },
          { begin: (text) => told.push(text), fail: ({ message }) => failed.push(message) });
        const file = (_, fails) => fails(new Error("Gone."));
        const entry = { isFile: true, fullPath: "/gone", file };
        const event = new Event("drop");
        event.dataTransfer = { items: [{ webkitGetAsEntry: () => entry }] };
        dispatchEvent(event);
        await new Promise((done) => setTimeout(done, 0));
        return [told.at(-1), failed];"""
    told, failed = called(page, "upload", body)
    assert told == ""
    assert failed == ["The files could not be read: Gone. Drop them again."]


def test_what_was_opened_last_is_shown_and_asked_about_whichever_answer_comes_first(page):
    body = """
        const asked = [], answers = [], real = fetch;
        fetch = (url, options) => new Promise((done) => {
          asked.push(options);
          answers.push((state) => done(new Response(JSON.stringify(state))));
        });
        const tick = () => new Promise((done) => setTimeout(done, 0));
        const api = m.createApi(() => {}, () => 560), states = [];
        for (const k of [1, 2]) api.upload([]).then((state) => states.push(state));
        for (const k of [1, 0]) {
          answers[k]({ opened: `upload-${k + 1}` });
          await tick();
        }
        api.assess(false, {}); await tick();
        fetch = real;
        return [states, JSON.parse(asked[2].body).opened];"""
    states, opened = called(page, "api", body)
    assert states == [{"opened": "upload-2"}, None]
    assert opened == "upload-2"


@pytest.mark.nightly
def test_arrow_keys_go_around_the_tabs(page):
    keys = [["ArrowRight", 4], ["ArrowLeft", 0], ["Home", 3], ["End", 1], ["a", 1]]
    body = "return g.map(([key, at]) => m.destination(key, at, 5));"
    assert called(page, "tabs", body, keys) == [0, 4, 0, 4, -1]


def test_a_subscript_is_set_as_one(page):
    body = "return m.html('p', {}, m.words('S_DS and F_a of A_1B, a_b')).innerHTML;"
    words = called(page, "make", body)
    assert words == "S<sub>DS</sub> and F<sub>a</sub> of A<sub>1B</sub>, a_b"


@pytest.mark.quick
def test_no_script_or_page_uses_the_network_or_inline_code():
    for file in STATIC.iterdir():
        text = file.read_text()
        assert not re.search(r"https?://(?!www\.w3\.org/2000/svg)", text), file
        assert not re.search(r"innerHTML|\beval\(|new Function|\sstyle=|\son[a-z]+=\"", text), file


_COLOR = re.compile(r"--([\w-]+): (#[0-9a-f]{3,6});")


def _luminance(color):
    digits = color[1:] if len(color) == 7 else "".join(2 * digit for digit in color[1:])
    parts = [int(digits[k : k + 2], 16) / 255 for k in (0, 2, 4)]
    linear = [p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]
    return sum(w * p for w, p in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


def _contrast(a, b):
    darker, lighter = sorted((_luminance(a), _luminance(b)))
    return (lighter + 0.05) / (darker + 0.05)


@pytest.mark.parametrize("theme", [0, 1], ids=["light", "dark"])
@pytest.mark.quick
def test_text_has_the_contrast_of_wcag_aa(theme):
    blocks = re.findall(r":root \{(.*?)\}", (STATIC / "style.css").read_text(), re.DOTALL)
    colors = dict(_COLOR.findall(blocks[theme]))
    for text in ("ink", "muted", "accent", "ng", "ok", "conditions"):
        for ground in ("paper", "wash", "accent-wash"):
            assert _contrast(colors[text], colors[ground]) >= 4.5, (text, ground)
    # What bounds a control or draws a curve needs 3 (WCAG 1.4.11).
    for line in ("rule", "across"):
        assert _contrast(colors[line], colors["paper"]) >= 3.0, line


MOTIONS = """
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


def test_motions_that_are_made_are_opened_and_can_be_saved(page):
    steps = """
        state = { ...state, state: "done", is_over: true };
        const save = await until(".note + button");
        motions.offer(null); isHidden.push(element.hidden);
        return [isHidden, sent, opened, save.textContent, failed];"""
    zipped = [{"file": "#t/project.zip", "path": "project.zip"}]
    assert called(page, "offers", MOTIONS + steps) == [
        [True, False, True], [["a"]], [zipped], "Save workbook and records (zip)", [],
    ]  # fmt: skip


def test_motions_that_are_canceled_are_offered_again(page):
    steps = """
        element.querySelector("button").click();
        for (let k = 0; k < 150 && element.querySelector("progress"); k += 1) await pause();
        return [element.textContent, opened];"""
    text, opened = called(page, "offers", MOTIONS + steps)
    assert text.startswith("No motions? Make seven for this site")
    assert text.endswith("Canceled.")
    assert opened == []
