"""calc-package.html in a browser: it opens by `file:`, computes its runs again and plays them."""

import base64
import json
import re
import shutil
import socket
import subprocess
import time
import zlib

import numpy as np
import pytest

from fixtures import packages
from fixtures.browser import chromium, quiet_page
from fixtures.marks import nightly
from fixtures.spaces import spaced
from report.assessment.assess import assess
from report.motions.prepare import prepare
from report.project.read.read import read
from report.web.open_project import open_project
from report.web.views import slide

DATA = re.compile(r'(<script type="application/json" id="data">)(.*?)(</script>)', re.DOTALL)
UNDER_WAY = re.compile("Without scripts|being computed")
LINE = "84 of 84 runs recomputed here: equal"
API = """modules["api.js"].createApi(() => {},
  JSON.parse(document.querySelector("#data").textContent))"""
SLIDE = f"""([array, motion]) => {API}.computed("slide", {{ array, motion }})"""
FOLLOWS = f"""async (values) => {{
  const api = {API};
  const {{ movable, followsFrom }} = modules["values.js"];
  const made = await api.runs(values);
  const {{ arrays, gaps }} = followsFrom(movable(await api.state()), made, values);
  return {{
    arrays: arrays.map((one) => [one.array.id, one.mean_prd_m, one.design_m]),
    gaps: gaps.map((one) => [one.gap.number, one.required_m, one.demand_capacity]),
  }};
}}"""


def reported(factory, name):
    return packages.reported(factory, name, packages.results_alone)


@pytest.fixture(scope="module")
def example(tmp_path_factory):
    return reported(tmp_path_factory, "example")


@pytest.fixture(scope="module")
def browser():
    with chromium() as started:
        yield started


def opened(page, path):
    """Open a file and wait until it says what it found; it asks for nothing else."""
    asked = []
    page.on("request", lambda request: asked.append(request.url.partition(":")[0]))
    page.goto(path.as_uri())
    page.locator("#recomputed").filter(has_not_text=UNDER_WAY).wait_for()
    assert set(asked) <= {"file", "data"}
    return page.inner_text("#recomputed")


def changed(source, path, change):
    """Write a file whose data are changed."""
    head, text, tail = DATA.search(source.read_text()).groups()
    data = json.loads(text)
    change(data)
    path.write_text(DATA.sub(lambda _: head + json.dumps(data) + tail, source.read_text()))
    return path


@pytest.mark.parametrize(
    ("name", "runs"), [("example", 84), nightly(("conditions", 16)), nightly(("campus", 360))]
)
def test_all_runs_are_computed_again_and_equal(tmp_path_factory, browser, name, runs):
    file = reported(tmp_path_factory, name).out / "calc-package.html"
    with quiet_page(browser) as page:
        assert opened(page, file).startswith(f"{runs} of {runs} runs recomputed here: equal")
        page.get_by_role("button", name="Play").click()
        page.get_by_role("button", name="Pause").wait_for()
        page.locator(".clock").filter(has_not_text="0.00 s of").wait_for()
        # The others have no floor, by a peer review, or are by the prescriptive procedure.
        assert page.locator("#other-values").is_visible() == (name == "example")
        found = page.locator("#hashes tr").all_text_contents()
    assert found
    assert all(row.endswith("as in the results") and "not" not in row for row in found)


def test_without_scripts_it_shows_the_package(browser, example):
    with quiet_page(browser, java_script_enabled=False) as page:
        page.goto((example.out / "calc-package.html").as_uri())
        assert page.inner_text(".verdict") == "OK All 94 checks are satisfied."
        assert page.inner_text("#recomputed").startswith("Without scripts")
        assert not page.locator("#watch").is_visible()


def test_the_example_has_less_than_700_kb_with_what_is_drawn(example):
    # Without the drawings, which `results_alone` leaves out: 70 kB.
    assert (example.out / "calc-package.html").stat().st_size < 630_000


def other_result(data):
    results = json.loads(zlib.decompress(base64.b64decode(data["results"])))
    results["arrays"][1]["runs"][5]["prd_m"] *= 1.0 + 1e-8
    data["results"] = base64.b64encode(zlib.compress(json.dumps(results).encode())).decode()


def other_sample(data):
    samples = bytearray(zlib.decompress(base64.b64decode(data["motions"]["samples"])))
    samples[2000] ^= 1
    data["motions"]["samples"] = base64.b64encode(zlib.compress(bytes(samples))).decode()


def cut(data):
    data["motions"]["samples"] = data["motions"]["samples"][:5000]


@pytest.mark.nightly
@pytest.mark.parametrize(
    ("change", "said"),
    [
        (other_result, "1 of 84 runs recomputed here differ from the package"),
        (other_sample, "Motions that the results do not name so: RM1"),
        (cut, "The data for recomputing cannot be read"),
    ],
    ids=lambda change: getattr(change, "__name__", ""),
)
def test_what_was_changed_is_told(browser, example, tmp_path, change, said):
    file = changed(example.out / "calc-package.html", tmp_path / "changed.html", change)
    with quiet_page(browser) as page:
        assert said in opened(page, file)


@pytest.mark.nightly
def test_a_run_that_is_played_is_that_of_serve(browser, example):
    sheet = read(example.project / "input.xlsx")
    assessment = assess(sheet, prepare(sheet))
    with quiet_page(browser) as page:
        opened(page, example.out / "calc-package.html")
        for array, motion in (("A1", "RM1"), ("A3", "RM4")):
            expected, found = (
                slide(assessment, array, motion),
                page.evaluate(SLIDE, [array, motion]),
            )
            for key in ("run", "dt_s", "seconds"):
                assert found[key] == expected[key]
            assert found["texts"]["prd"] == spaced(expected["texts"]["prd"])
            assert found["runs"] == spaced(expected["runs"])
            for key in ("relative", "normal", "friction"):
                for mine, theirs in zip(found[key]["series"], expected[key]["series"], strict=True):
                    # The page has the jumps of friction as well, between samples.
                    there = dict(zip(theirs.get("i", range(10**5)), theirs["v"], strict=False))
                    values = [there[k] for k in range(len(mine["v"]))]
                    np.testing.assert_allclose(mine["v"], values, rtol=1e-9, atol=1e-9)
            np.testing.assert_allclose(found["roof_m"], expected["roof_m"], rtol=1e-9, atol=1e-9)
            assert [slip["from_s"] for slip in found["slips"]] == pytest.approx(
                [slip["from_s"] for slip in expected["slips"]]
            )


@pytest.mark.nightly
def test_other_values_are_those_of_a_project_with_them(browser, example):
    opened_project = open_project(example.project / "input.xlsx")
    with quiet_page(browser) as page:
        opened(page, example.out / "calc-package.html")
        for friction, intensity in ((1.0, 1.0), (0.8, 1.0), (1.0, 1.06), (0.7, 1.05)):
            typed = {"friction": friction, "intensity": intensity, "together": "no"}
            done = opened_project.at(typed).assessed()
            found = page.evaluate(FOLLOWS, {"friction": friction, "intensity": intensity})
            assert found["arrays"]
            for id, mean_m, design_m in found["arrays"]:
                item = next(item for item in done.arrays if item.id == id)
                expected = item.analysis.mean_m, item.design_m
                # The workbook rounds the factor on a record to digits.
                assert (mean_m, design_m) == pytest.approx(expected, rel=1e-5)
            for number, required_m, ratio in found["gaps"]:
                gap = done.clearances[number - 1]
                expected = gap.required_m, gap.demand_capacity
                assert (required_m, ratio) == pytest.approx(expected, rel=1e-5)


def test_sliders_show_values_before_and_after_without_a_verdict(browser, example):
    results = json.loads((example.out / "results.json").read_text())
    with quiet_page(browser) as page:
        opened(page, example.out / "calc-package.html")
        page.get_by_text("At the values of the package.").wait_for()
        rows = page.locator("#sliders table").nth(1).locator("tbody tr")
        before = rows.all_inner_texts()
        assert before[1].split("\t") == ["2: A1 to RTU-1", "48.0 in", "40.8 in", "0.85"]
        assert len(before) == len(results["clearances"])
        page.get_by_role("slider", name="Every separation provided").fill("-8")
        page.get_by_text("Computed here, without a verdict").wait_for()
        text = page.locator("#sliders").inner_text()
        assert "48.0 in → 40.0 in\t40.8 in\t0.85 → 1.02" in text
        assert not re.search(r"\bOK\b|\bNG\b", text)
        page.get_by_role("button", name="As in the package").click()
        page.get_by_text("At the values of the package.").wait_for()
        assert rows.all_inner_texts() == before


class Firefox:
    """Debian's Firefox, driven by its own protocol."""

    def __init__(self, profile):
        command = ["firefox-esr", "--headless", "--marionette", "--profile", str(profile)]
        self.process = subprocess.Popen(
            command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        self.count = 0
        end = time.monotonic() + 90
        while time.monotonic() < end:
            try:
                self.socket = socket.create_connection(("127.0.0.1", 2828), timeout=120)
                break
            except OSError:
                time.sleep(0.5)
        self._answer()
        self.say("WebDriver:NewSession", {})

    def say(self, command, given):
        self.count += 1
        text = json.dumps([0, self.count, command, given])
        self.socket.sendall(f"{len(text.encode())}:{text}".encode())
        _, _, error, answer = self._answer()
        assert error is None, error
        return answer

    def end(self):
        self.socket.close()
        self.process.terminate()
        self.process.wait(30)

    def _answer(self):
        head = b""
        while not head.endswith(b":"):
            head += self.socket.recv(1)
        body = b""
        while len(body) < int(head[:-1]):
            body += self.socket.recv(65536)
        return json.loads(body)


@pytest.mark.nightly
def test_firefox_computes_all_runs_within_their_bounds(example, tmp_path):
    if shutil.which("firefox-esr") is None:
        pytest.skip("Firefox is not installed: sudo apt-get install firefox-esr")
    firefox = Firefox(tmp_path)
    try:
        firefox.say("WebDriver:Navigate", {"url": (example.out / "calc-package.html").as_uri()})
        script = {"script": "return document.querySelector('#recomputed').textContent", "args": []}
        end, line = time.monotonic() + 60, "Without scripts"
        while UNDER_WAY.search(line) and time.monotonic() < end:
            time.sleep(0.5)
            line = firefox.say("WebDriver:ExecuteScript", script)["value"]
        assert line.startswith(LINE)
    finally:
        firefox.end()
