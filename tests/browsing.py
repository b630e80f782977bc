"""Chromium for tests of the page, and the page's own scripts without a server."""

import os
import re
import secrets
import shutil
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path
from tempfile import NamedTemporaryFile

import pytest

from places import ROOT

STATIC = ROOT / "report" / "web" / "static"
FONTS = ROOT / "templates" / "fonts"
DESKTOP = {"width": 1280, "height": 720}
TABLET = {"width": 800, "height": 1100}
PHONE = {"width": 390, "height": 844}
ALONE = "http://scripts.test"
_ANSWERED = re.compile(
    r"the server responded with a status of (401|403|409|412|422|503)|ERR_FAILED"
)
_KINDS = {".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml"}


@contextmanager
def chromium():
    """Yield Debian's Chromium; skip where it is not installed, or what drives it cannot start."""
    path = shutil.which("chromium")
    if path is None:
        pytest.skip("Chromium is not installed: sudo apt-get install chromium")
    driver = [sys.executable, "-m", "playwright", "--version"]
    said = subprocess.run(driver, capture_output=True, text=True, check=False).stderr
    if "libatomic.so.1" in said:
        pytest.skip("Playwright cannot load libatomic.so.1: sudo apt-get install libatomic1")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as started:
        browser = started.chromium.launch(executable_path=path, args=["--no-sandbox"])
        try:
            yield browser
        finally:
            browser.close()


@contextmanager
def quiet_page(browser, **options):
    """Yield a tab of its own; what its console says or its policy refuses fails."""
    context = browser.new_context(viewport=DESKTOP, **options)
    context.set_default_timeout(15_000)
    page = context.new_page()
    said = []
    # Chromium reports every answer that is an error; these are none of the page.
    page.on("console", lambda message: _ANSWERED.search(message.text) or said.append(message.text))
    page.on("pageerror", lambda error: said.append(str(error)))
    try:
        yield page
        if said:
            pytest.fail("the console says " + "; ".join(said))
    finally:
        context.close()


def serve_scripts(page):
    """Answer a page from the static folder and the fonts alone."""

    def handle(route):
        name = route.request.url.removeprefix(ALONE).partition("?")[0].removeprefix("/static/")
        if name == "/":
            route.fulfill(body="<!doctype html><title>scripts</title>", content_type="text/html")
        elif name.startswith("fonts/"):
            route.fulfill(path=FONTS / name.removeprefix("fonts/"))
        elif (STATIC / name).is_file():
            kind = _KINDS[(STATIC / name).suffix]
            route.fulfill(path=STATIC / name, content_type=kind)
        else:
            route.fulfill(status=404)

    page.route(f"{ALONE}/**", handle)
    page.goto(f"{ALONE}/")


def called(page, module, body, given=None):
    """Return what a body of JavaScript returns with a script `m` and what is given `g`."""
    script = f"async (g) => {{ const m = await import('/static/{module}.js'); {body} }}"
    return page.evaluate(script, given)


def cases(table):
    """Parametrize a test by steps and what they give, each named by its sentence."""
    return pytest.mark.parametrize(("steps", "expected"), table.values(), ids=list(table))


@contextmanager
def served(root=ROOT):
    """Yield a server's address, which stays good, and its process, which ends with the test."""
    with NamedTemporaryFile("w", suffix=".txt") as token:
        token.write(secrets.token_urlsafe(24))
        token.flush()
        command = [sys.executable, "-m", "report.cli", "serve", "--port", "0", "--no-browser"]
        command += ["--token-file", token.name]
        # Its processes import what it does, whatever version is installed or asks.
        env = os.environ | {"PYTHONPATH": str(root)}
        with subprocess.Popen(
            command, stdout=subprocess.PIPE, text=True, cwd=root, env=env
        ) as server:
            try:
                yield server.stdout.readline().strip(), server.pid
            finally:
                server.terminate()


def processes_of(pid):
    """The processes that a server has started to compute."""
    ids = Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    return [one for one in ids if "spawn_main" in Path(f"/proc/{one}/cmdline").read_text()]


def opened(page, address):
    """Open the example and wait for its verdict, for which a cold server reads it first."""
    page.goto(address, timeout=60_000)
    page.wait_for_selector("body[data-phase=rest]", timeout=60_000)
    if page.locator("#welcome").is_hidden():  # another page has opened another project
        page.click("#example")
        page.wait_for_selector("#welcome:visible")
        at_rest(page)


def at_rest(page):
    """Wait until the full model has answered, with what less friction changes."""
    page.wait_for_selector("body[data-phase=rest] #verdict:not([aria-busy])")


def moved(page, slider, value):
    """Move a slider as a pointer does, and leave it there."""
    page.locator(f"#slider-{slider}").evaluate(
        """(input, value) => {
          input.value = value;
          input.dispatchEvent(new InputEvent("input", { bubbles: true }));
        }""",
        value,
    )


def verdicts(page):
    """The verdict of the project and those in the tables."""
    return page.locator("#verdict .tag, #results .tag").all_inner_texts()


def numbers(page, table, column):
    """A column of a table."""
    return page.locator(f"#{table} tbody tr > :nth-child({column})").all_inner_texts()


def saved(page, click):
    """Name and bytes of what a click saves."""
    with page.expect_download() as download:
        click()
    return download.value.suggested_filename, download.value.path().read_bytes()
