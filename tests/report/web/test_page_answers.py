"""What the page shows of an assessment, beside what `test_values` compares with the workbook."""

import pytest

from fixtures.marks import by_day
from fixtures.page_parts import elements
from fixtures.paths import ROOT
from fixtures.spaces import spaced
from report.assessment.assess import Extent, assess, reassess
from report.assessment.assessment import Assessment
from report.assessment.checks.sentence import words
from report.assessment.design.friction import with_friction
from report.assessment.design.verdict import Verdict
from report.web.answers import answer
from report.web.open_project import open_project
from report.web.parts import parts, subscripted
from report.web.plan import stamp


@pytest.fixture(scope="module")
def assessed():
    """The example with less friction, two of its clearances, and one of these next to nothing."""
    given = open_project(ROOT / "projects" / "example" / "input.xlsx")
    whole = assess(given.sheet, given.shaking)
    first, _, third, *_ = whole.project.clearances
    rows = (third, first.model_copy(update={"provided_m": 0.01}))
    data = with_friction(whole.project.model_copy(update={"clearances": rows}), 0.9)
    return reassess(whole, data)


def test_pairs_of_the_plan_without_a_clearance_are_rows_below_those_of_the_workbook(assessed):
    table = answer(assessed, is_provisional=False)["clearances"]
    names = [(row[1]["text"], row[-1]["text"]) for row in table["rows"]]
    missing = {
        (f"{near.array} to {near.other}", "NG" if near.is_short else "Condition")
        for near in assessed.neighbors
        if near.is_missing
    }
    assert {verdict for _, verdict in missing} == {"NG", "Condition"}
    assert {pair for pair, row in zip(names, table["rows"], strict=True) if not row[0]["text"]} == (
        missing
    )
    assert [name for name, _ in names[:2]] == ["A1 to NORTH", "A1 to A2"]
    assert names[1][1] == "NG" != names[0][1]
    # Within reach, and farther apart than any separation.
    east = next(row for row in table["rows"] if row[1]["text"] == "A3 to EAST")
    assert spaced([cell["text"] for cell in east[2:4]]) == ["120.0 in", "93.4 in"]
    assert len(names) == len(missing) + 2


def test_an_ok_that_less_friction_may_change_is_not_said(assessed, monkeypatch):
    monkeypatch.setattr(Assessment, "verdict", property(lambda _: Verdict.OK))
    found = answer(assessed, is_provisional=False)
    assert (found["verdict"]["text"], found["verdict_text"]) == ("OK (provisional)", None)
    assert found["line"] == found["pending"] != ""


@pytest.mark.quick
def test_symbols_are_set_with_their_subscripts_and_what_is_like_html_as_it_stands():
    html = "S<sub>DS</sub> &lt; F<sub>a</sub> of a_b"
    assert str(subscripted("S_DS < F_a of a_b")) == html


def test_a_row_keeps_its_place_while_provisional_and_has_no_verdict_then(assessed):
    moving, resting = (
        answer(assessed, is_provisional=is_moving)["clearances"]["rows"]
        for is_moving in (True, False)
    )
    assert [row[:2] for row in moving] == [row[:2] for row in resting]
    assert {row[-1] for row in moving} == {None}


def test_a_screen_reader_hears_of_the_pairs_without_a_clearance(assessed):
    said = answer(assessed, is_provisional=False)["plan"]["described"]
    short = [near for near in assessed.neighbors if near.is_short]
    assert short
    for near in short:
        (found,) = (one for one in said if one["text"].startswith(f"{near.array} to {near.other}:"))
        assert "no clearance given" in found["text"]
        assert found["verdict"]["text"] == "NG"


def test_the_causes_of_ng_are_listed_first(assessed):
    levels = [reason["level"] for reason in answer(assessed, is_provisional=False)["reasons"]]
    count = levels.count("NG")
    assert 0 < count < len(levels)
    assert set(levels[:count]) == {"NG"}


def test_short_clearances_are_one_cause_with_the_worst(assessed):
    shown = answer(assessed, is_provisional=False)
    texts = [reason["text"] for reason in shown["reasons"]]
    assert sum(text.startswith("Clearance, ") for text in texts) == 1
    assert shown["line"].startswith("clearance A1 to A2 ")


def test_the_plan_tells_of_arrays_objects_and_clearances(assessed):
    found = answer(assessed, is_provisional=False)
    assert found["tips"].keys() >= {"A1", "A2", "A3", "RTU-1", "NORTH", "#1", "#2"}
    assert "D/C" in found["tips"]["A1"]
    keys = {one.get("data-key") for one in elements(found["plan"]["drawn"], "*[@data-key]")}
    assert {"A1", "#1"} <= keys <= found["tips"].keys()


def test_a_tip_names_the_gap_that_governs_also_one_that_is_not_entered(assessed):
    tips, gaps = answer(assessed, is_provisional=False)["tips"], assessed.missing_gaps
    governing = {item.id: assessed.governing_gap(item.id) for item in assessed.arrays}
    assert any(gap in gaps for gap in governing.values())
    for name, gap in governing.items():
        assert tips[name].endswith(f", D/C {gap.ratio_words} to {gap.across_from(name)}")


def test_alike_arrays_are_one_row_and_what_is_joined_in_a_cause_is_listed():
    """The campus with short clearances: 30 arrays of six kinds, and 61 clearances."""
    given = open_project(ROOT / "projects" / "campus" / "input.xlsx")
    data = given.sheet.project
    gaps = tuple(row.model_copy(update={"provided_m": 0.0}) for row in data.clearances)
    done = assess(given.sheet.with_(clearances=gaps), given.shaking)
    found = answer(done, is_provisional=False)
    names = [row[0]["ids"] for row in found["arrays"]["rows"]]
    assert sorted(name for ids in names for name in ids) == sorted(
        array.id for array in data.arrays
    )
    assert len(names) < 10
    (joined,) = (one for one in found["reasons"] if one["text"].startswith("Clearance, "))
    (warned,) = (one for one in found["reasons"] if one["level"] == "warning")
    assert warned["text"].startswith("Clearances!E8: provided clearance is ")
    assert warned["text"].endswith(
        "[clearance A1 to A2 cross-slope], and 60 more warnings in this column"
    )
    assert len(set(warned["parts"])) == 61
    failed = [check for check in done.checks if check.id == "clearance" and not check.is_satisfied]
    assert len(joined["parts"]) == len(failed) > 20
    assert joined["parts"][0].startswith("clearance ")
    # Without any capacity D/C is infinite of all: first is what lacks most.
    lacking = sorted(failed, key=lambda check: check.limit.value, reverse=True)
    assert joined["parts"] == list(map(words, lacking)) != list(map(words, failed))
    worst = [answer(done, is_provisional=one)["worst"]["text"] for one in (True, False)]
    assert worst == [f"Clearance {lacking[0].subject}{more}" for more in ("", " and 60 more")]
    assert all(not one["parts"] or len(one["parts"]) > 1 for one in found["reasons"])


def test_the_headline_is_the_check_that_governs_with_its_ratio_and_what_to_do_next(assessed):
    shown = answer(assessed, is_provisional=False)
    ratio = assessed.governing_gap().demand_capacity
    assert shown["worst"]["text"].startswith("Clearance A1 to A2, and ")
    assert shown["worst"]["ratio"] == pytest.approx(ratio)
    # What is enough is known once less friction is.
    assert shown["next"].startswith("Provide wiring slack")
    whole = reassess(assessed, assessed.project, extent=Extent.LESS_FRICTION)
    enough = answer(whole, is_provisional=False)["next"]
    assert spaced(enough).startswith("Move A2 44.6 in (1133 mm) south, ")
    moving = answer(assessed, is_provisional=True)
    assert moving["worst"] == shown["worst"] | {"text": "Clearance A1 to A2"}
    assert moving["next"] == ""


def test_an_array_is_shaded_by_its_largest_ratio(assessed):
    found = answer(assessed, is_provisional=False)
    shades = {
        one.get("data-key"): int(one.get("class").rpartition("-")[2])
        for one in elements(found["plan"]["drawn"], "path[@data-key]")
        if one.get("class").startswith("array is-shade-")
    }
    ratios = {row[0]["ids"][0]: row[4]["text"] for row in found["arrays"]["rows"]}
    limits = (0.5, 0.75, 0.9, 1.0)
    assert ratios["A1"] == "> 100"
    for name, text in ratios.items():
        ratio = float(text.removeprefix("> "))
        assert shades[name] == sum(ratio > limit for limit in limits), name


CLEARANCES = """async ([clearances, former]) => {
  document.body.innerHTML = '<link rel="stylesheet" href="/static/style.css"><table></table>' +
    '<table></table><div class="results"><table class="numbers" id="clearances"></table></div>';
  await new Promise((done) => (document.querySelector('link').onload = done));
  const [arrays, bars, table] = document.querySelectorAll('table');
  table.parentElement.style.width = '430px'; // beside the plan, on a screen of 1280 pixels
  const { mountResults } = await import('/static/results.js');
  const answer = { html: { arrays: "<tbody></tbody>", bars: {}, clearances } };
  const before = { html: { ...answer.html, clearances: former } };
  const state = { answer, project: { answer: before }, picked: null, array: null };
  mountResults({ arrays, bars, clearances: table }, { draws: (draw) => draw(state) }, () => {});
  await document.fonts.ready;
  const changed = [...table.querySelectorAll("td")].map((cell) => cell.textContent);
  return [table.parentElement.scrollWidth, changed];
}"""


@pytest.mark.parametrize("verdict", by_day([Verdict.NG, Verdict.CONDITION], 1))
def test_names_of_a_dozen_letters_leave_the_verdict_of_a_clearance_in_view(scripts, verdict):
    ends = {"from": "ARRAY-NW-01", "to": "PV existing 2014", "note": "across"}
    between = {"text": "ARRAY-NW-01 to PV existing 2014"} | ends
    heads = ["No.", "From, to", "Provided", "Required", "D/C", "Verdict"]
    tables = [
        parts().clearances({"caption": "Clearances", "heads": heads, "rows": [
            [{"text": "1"}, between, {"text": "96.0 in"}, *numbers, stamp(verdict)]]})
        for numbers in (
            [{"text": "107.5 in"}, {"text": "0.83"}], [{"text": "81.6 in"}, {"text": "0.85"}]
        )
    ]  # fmt: skip
    wide, texts = scripts.evaluate(CLEARANCES, tables)
    assert wide <= 430
    assert texts == ["1", "96.0 in", "81.6 → 107.5 in", "0.85 → 0.83", verdict.value]
