"""Draws the pictures of README and docs anew; `tests/bench/work_precision.py` draws the chart.

    .venv/bin/python docs/pictures.py

Needs what `./roofslip test` installs, Chromium included. Sheets of the package are cut at their
last line; the page is shot as a browser shows it.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import pypdfium2
from PIL import Image, ImageChops

ROOT = Path(__file__).resolve().parents[1]
PICTURES = ROOT / "docs" / "pictures"
WIDTH = 800
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]

SHEETS = {
    "summary.png": ("1 Summary", 1.0),
    "comparison.png": ("2 Comparison with the prescriptive displacement", 0.66),
    "model.png": ("6 Model used", 0.55),
}
"""Of the package: the heading of a part, and how much of a sheet is shown from there down."""
ABOVE_PT = 14.0
"""Of the sheet above a heading."""


def main() -> None:
    """Draw every picture."""
    with TemporaryDirectory() as folder:
        out = Path(folder)
        _run("report", "projects/example", "--out", str(out / "package"), "--quiet")
        _sheets(out / "package" / "calc-package.pdf")
        _browser(out)


def _run(*words: str) -> None:
    subprocess.run([sys.executable, "-m", "report.cli", *words], cwd=ROOT, check=True)


def _sheets(path: Path) -> None:
    for name, (head, part) in SHEETS.items():
        for page in pypdfium2.PdfDocument(path):
            text = page.get_textpage()
            if head in text.get_text_range().splitlines():
                break
        index, _ = text.search(head).get_next()
        high = page.get_height() - text.get_charbox(index)[3]
        top = 0.0 if part == 1.0 else high - ABOVE_PT
        scale = WIDTH / page.get_width()
        image = page.render(scale=scale).to_pil()
        below = top + part * page.get_height()
        _save(image.crop((0, round(scale * top), image.width, round(scale * below))), name)


def _browser(folder: Path) -> None:
    from browsing import at_rest, chromium, moved, opened, quiet_page, served

    with chromium() as browser, quiet_page(browser) as page, served() as (address, _):
        opened(page, address)
        moved(page, "friction", 0.8)
        at_rest(page)
        page.screenshot(path=folder / "page.png")
        _save(Image.open(folder / "page.png"), "browser.png")
        moved(page, "friction", 1.0)
        at_rest(page)
        page.get_by_role("tab", name="Watch it slide").click()
        page.get_by_role("slider", name="Time").fill("23.3")
        page.screenshot(path=folder / "slide.png")
        _save(Image.open(folder / "slide.png"), "browser-slide.png")


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
