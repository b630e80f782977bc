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
from report.assessment.assess import assess
from report.motions.prepare import prepare
from report.project.read.read import read
from report.web.views import slide

DATA = re.compile(r'(<script type="application/json" id="data">)(.*?)(</script>)', re.DOTALL)
LINE = "84 of 84 runs recomputed here: equal"
SLIDE = """([array, motion]) => modules["api.js"].createApi(() => {},
  JSON.parse(document.querySelector("#data").textContent)).computed("slide", { array, motion })"""


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
    page.locator("#recomputed").filter(has_not_text="Without scripts").wait_for()
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
        end, line = time.monotonic() + 60, "With"
        while line.startswith("With") and time.monotonic() < end:
            time.sleep(0.5)
            line = firefox.say("WebDriver:ExecuteScript", script)["value"]
        assert line.startswith(LINE)
    finally:
        firefox.end()
