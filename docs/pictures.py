"""Draws the pictures of README and docs anew, from the projects and the verification.

    .venv/bin/python docs/pictures.py

Needs what `./roofslip test` installs, LibreOffice and Chromium included. Sheets of the package and
charts of the manual are cut at their last line, the worksheet below its filled rows; the page is
shot as a browser shows it. The package of the example is kept as `docs/example-package.pdf` and
`.html`. With `--package`, only the package and its pictures are made.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections import Counter
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory
from textwrap import fill
from typing import TYPE_CHECKING, Literal

import pypdfium2
from matplotlib.figure import Figure
from PIL import Image, ImageChops

import report
from report.figures.base import ACCENT, style
from report.figures.plan_figure import array_section
from solver import Model

if TYPE_CHECKING:
    from playwright.sync_api import Page, ViewportSize

ROOT = Path(__file__).resolve().parents[1]
PICTURES = ROOT / "docs" / "pictures"
PACKAGE = ROOT / "docs" / "example-package.pdf"
WIDTH = 800
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]
os.environ["ROOFSLIP_VERSION"] = "0.4.0"  # the same at every commit

SHEETS = {
    "summary.png": ("1 Summary", 1.0),
    "comparison.png": ("2 Comparison with the prescriptive displacement", 0.54),
    "comparison-chart.png": ("2 Comparison with the prescriptive displacement", 0.27),
    "model.png": ("Model used, by array", 0.212),
}
"""Of the package: the heading of a part, and how much of a sheet is shown from there down."""
CHARTS = {
    "stability-1": "where-methods-fail.png",
    "free-body": "free-body.png",
}
"""Of the manual, and the section of the method page."""
PROJECTS = ("conditions", "campus", "school", "example")
ABOVE_PT = 7.0
"""Of the sheet above a heading."""
WORKSHEET, WORKSHEET_BOX = "Clearances", (0.03, 0.04, 0.72, 0.42)
"""The worksheet that is shown, and which part of its page: left, top, right and bottom."""


def main() -> None:
    """Draw every picture."""
    with TemporaryDirectory() as folder:
        out = Path(folder)
        _run("report", "projects/example", "--out", str(out / "package"), "--quiet")
        for kept in (PACKAGE, PACKAGE.with_suffix(".html")):
            shutil.copy(out / "package" / f"calc-package{kept.suffix}", kept)
        _sheets(PACKAGE)
        _workbook(out)
        if "--package" in sys.argv:
            return
        _run("verify", "--out", str(out / "manual"))
        _run("study", "projects/study", "--out", str(out / "study"), "--quiet")
        _browser(out / "manual" / "charts")
        _models(out / "study" / "manifest.json")


def _run(*words: str) -> None:
    subprocess.run([sys.executable, "-m", "report.cli", *words], cwd=ROOT, check=True)


def _sheets(path: Path) -> None:
    for name, (head, part) in SHEETS.items():
        for page in pypdfium2.PdfDocument(path):
            text = page.get_textpage()
            if head in text.get_text_range().splitlines():
                break
        found, index = text.search(head), 0
        while hit := found.get_next():  # the contents name it above its heading
            index, _ = hit
        high = page.get_height() - text.get_charbox(index)[3]
        top = 0.0 if part == 1.0 else high - ABOVE_PT
        scale = WIDTH / page.get_width()
        # At its own size pdfium clips letters at the edge of a chart.
        image = page.render(scale=2 * scale).to_pil().reduce(2)
        below = top + part * page.get_height()
        _save(image.crop((0, round(scale * top), image.width, round(scale * below))), name)


def _workbook(folder: Path) -> None:
    """Show a worksheet of the example as LibreOffice prints it."""
    workbook = ROOT / "projects" / "example" / "input.xlsx"
    words = ["soffice", "--headless", "--convert-to", "pdf", "--outdir", str(folder), str(workbook)]
    subprocess.run(words, check=True, capture_output=True)
    for page in pypdfium2.PdfDocument(folder / "input.pdf"):
        if f"Roofslip input {WORKSHEET} " in page.get_textpage().get_text_range():  # its foot
            break
    left, top, right, bottom = WORKSHEET_BOX
    scale = WIDTH / (right - left) / page.get_width()
    image = page.render(scale=2 * scale).to_pil().reduce(2)
    wide, high = image.size
    _save(image.crop((left * wide, top * high, right * wide, bottom * high)), "workbook.png")


def _browser(charts: Path) -> None:
    from fixtures.browser import chromium, quiet_page

    with chromium() as browser, quiet_page(browser) as page:
        example = report.read_project(ROOT / "projects" / "example").project
        free_body = array_section(example.arrays[-1], us_first=True)
        (charts / "free-body.svg").write_text(free_body, encoding="utf-8")
        for chart, name in CHARTS.items():
            drawn = (charts / f"{chart}.svg").read_text(encoding="utf-8")
            html = charts / "chart.html"
            large = f"<style>{_faces()} svg {{ width: {2 * WIDTH}px; height: auto }}</style>"
            html.write_text(large + drawn, encoding="utf-8")
            page.goto(html.as_uri())
            page.evaluate("document.fonts.ready")
            page.locator("svg").screenshot(path=charts / "chart.png")
            image = Image.open(charts / "chart.png")
            _save(_one_below_another(image) if chart.startswith("stability") else image, name)
        _page(page, charts / "page.png")


LAPTOP, PHONE = {"width": 1366, "height": 657}, {"width": 390, "height": 844}
"""A laptop of 1366 × 768 pixels without what its browser takes."""


def _page(page: Page, path: Path) -> None:
    """Show the page with less friction, light and dark and on a phone, and a run in motion."""
    from fixtures.browser import at_rest, moved, opened, served

    def shot(name: str, size: ViewportSize, scheme: Literal["light", "dark"] = "light") -> None:
        page.set_viewport_size(size)
        page.emulate_media(color_scheme=scheme)
        page.wait_for_timeout(3000)  # a sheet of the plan for this width
        at_rest(page)
        page.screenshot(path=path)
        _save(Image.open(path), name)

    with served() as (address, _):
        opened(page, address)
        moved(page, "friction", 0.8)
        at_rest(page)
        page.locator("#turn-friction:not(.is-idle)").wait_for(timeout=60_000)
        shot("browser.png", LAPTOP)
        shot("browser-dark.png", LAPTOP, "dark")
        shot("browser-phone.png", PHONE)
        page.set_viewport_size(LAPTOP)
        page.click("#reset-all")
        at_rest(page)
        page.get_by_role("tab", name="Watch it slide").click()
        page.get_by_role("slider", name="Time").fill("23.3")
        page.evaluate("scrollTo(0, 0)")  # to which it was brought into view
        shot("browser-slide.png", LAPTOP)


def _one_below_another(image: Image.Image) -> Image.Image:
    """Return four maps in two columns as one column with the key below it, legible on a phone."""
    image = image.convert("RGB")
    half, key = image.width // 2, round(0.915 * image.height)
    row = key // 2
    boxes = [(left, top, left + half, top + row) for top in (0, row) for left in (0, half)]
    # The key: its bands, then what failed and the limit.
    left, middle = (round(share * image.width) for share in (0.13, 0.535))
    boxes += [(left, key, middle, image.height), (middle, key, image.width, image.height)]
    parts = [image.crop(box) for box in boxes]
    column = Image.new("RGB", (half, sum(part.height for part in parts)), "white")
    top = 0
    for part in parts:
        column.paste(part, (0, top))
        top += part.height
    return column


def _models(manifest: Path) -> None:
    """Draw the runs of each project by the model that was chosen, with a reason for the last."""
    runs: dict[str, Counter[Model]] = {}
    reasons: dict[str, str] = {}
    for name in PROJECTS:
        solutions = [
            run.solution
            for array in report.assess_project(ROOT / "projects" / name).arrays
            for run in array.runs
        ]
        runs[name] = Counter(solution.model for solution in solutions)
        largest = max(solutions, key=lambda solution: (solution.model, solution.result.prd_m))
        reasons[name] = largest.reason
    counted = json.loads(manifest.read_text(encoding="utf-8"))["models"]
    runs["study"] = Counter({model: counted.get(model.title, 0) for model in Model}) + Counter()
    simpler = sum(count for model, count in runs["study"].items() if model < Model.TWO_AXES)
    share = simpler / runs["study"].total()
    reasons["study"] = (
        f"the second horizontal component is significant, except in {100 * share:.0f}% of the runs"
    )
    # Half of the width of a page, so that a phone shows it legibly: the reason is below each row.
    with style():
        figure = Figure(figsize=(4.4, 4.6), dpi=200)
        axes = figure.add_axes((0.17, 0.01, 0.82, 0.77))
        for row, (name, count) in enumerate(runs.items()):
            for model, found in count.items():
                axes.barh(-row, 0.9, left=model - 0.45, height=0.36, color=ACCENT)
                axes.text(model, -row, f"{found:,}", ha="center", va="center", color="white")
            axes.text(-0.45, -row - 0.26, fill(reasons[name], 56), va="top")
        used = [model for model in Model if model <= Model.SPEED_FRICTION]
        axes.set_xticks(used, [fill(f"{model:d}: {model.title}", 11) for model in used])
        axes.xaxis.tick_top()
        axes.set_yticks([-row for row in range(len(runs))], list(runs))
        axes.set_xlim(-0.5, 4.5)
        axes.set_ylim(-len(runs) + 0.25, 0.25)
        axes.tick_params(length=0)
        for side in axes.spines.values():
            side.set_visible(False)
        drawn = BytesIO()
        figure.savefig(drawn)
        _save(Image.open(drawn), "models.png")


def _faces() -> str:
    """Return where a browser finds the fonts of the charts."""
    weights = {"Regular": 400, "Semibold": 600}
    return "".join(
        f"@font-face {{ font-family: 'Source Sans 3'; font-weight: {weight};"
        f" src: url('{(ROOT / 'templates/fonts').as_uri()}/SourceSans3-{name}.ttf') }}"
        for name, weight in weights.items()
    )


def _save(image: Image.Image, name: str) -> None:
    """Save a picture of one width without its empty foot, in few colors."""
    image = image.convert("RGB")
    empty = Image.new("RGB", image.size, image.getpixel((image.width - 1, image.height - 1)))
    foot = ImageChops.difference(image, empty).getbbox()
    if foot:
        image = image.crop((0, 0, image.width, min(foot[3] + 12, image.height)))
    height = round(image.height * WIDTH / image.width)
    image.resize((WIDTH, height), Image.Resampling.LANCZOS).quantize(64).save(
        PICTURES / name, optimize=True
    )


if __name__ == "__main__":
    main()
