"""How the sheets of the shipped projects look, as far as a program can tell; and a contact sheet.

`CONTACT_SHEETS=FOLDER ./roofslip test tests/report/package/test_looks.py` leaves a PNG of all
sheets of each project in that folder: look at them before a release.
"""

import os
import shutil
from base64 import b64encode
from pathlib import Path

import pytest
from click.testing import CliRunner
from PIL import Image

import looked
import packages
from places import ROOT
from report.cli.main import main
from report.typeset.pdf import lay_out

pytestmark = pytest.mark.quick

PROJECTS = tuple(path.parent.name for path in sorted(ROOT.glob("projects/*/input.xlsx")))
LEAST_FILLED = 0.5


def _made(name, factory):
    """Return the PDF of a project, whichever command makes it."""
    if name != "study":
        return packages.reported(factory, name, by_script=True).out / "calc-package.pdf"

    def run(folder):
        shutil.copytree(
            ROOT / "projects" / name, folder / name, ignore=shutil.ignore_patterns("out")
        )
        done = CliRunner().invoke(main, ["study", str(folder / name)])
        assert done.exit_code == 0, done.output

    return packages.once(factory, "looked-study", run) / name / "out" / "study" / "study.pdf"


@pytest.fixture(scope="module", params=PROJECTS)
def sheets(request, tmp_path_factory):
    path = _made(request.param, tmp_path_factory)
    folder = os.environ.get("CONTACT_SHEETS") or tmp_path_factory.mktemp("contact-sheets")
    looked.contact_sheet(path, Path(folder) / f"{request.param}.png")
    return looked.sheets(path)


@pytest.mark.nightly
def test_the_sheets_have_no_fault_that_a_program_sees(sheets):
    assert len(sheets) > 10
    assert looked.broken_numbers(sheets) == []
    assert looked.headings_left_behind(sheets) == []
    # The runs of an array may go on overleaf, by three rows or more.
    assert looked.split_tables(sheets, "Motion", but="PRD of each run") == []
    # Each section of a study begins a sheet.
    is_study = sheets[0].blocks[0].lines[0].startswith("Study")
    assert is_study or looked.short_sheets(sheets, LEAST_FILLED) == []


SVG = (
    b'<svg xmlns="http://www.w3.org/2000/svg" width="360" height="300">'
    b'<rect width="360" height="300"/></svg>'
)
DRAWING = f'<p><img alt="A box" src="data:image/svg+xml;base64,{b64encode(SVG).decode()}"/></p>'
FAULTS = f"""<html lang="en-US"><head><title>T</title><style>
@page {{ size: Letter; margin: 0.9in 0.9in 0.95in }}
@page large {{ size: 17in 11in }}
table {{ table-layout: fixed; width: 100% }}
td {{ overflow-wrap: anywhere }}
p {{ margin: 0 }}
h2 {{ break-after: auto }}
</style></head><body>
<h1>Part</h1><p style="height: 7.5in">Full.</p>
<h2>Left behind</h2>{DRAWING}
<h2>Short</h2>{DRAWING}
<table style="break-before: page; width: 0.3in"><tr><td>2025-<br/>11-<br/>01</td></tr></table>
<p style="height: 8.3in">Full.</p>
<table><thead><tr><th>Motion</th><th>PRD</th></tr></thead><tbody>
{"".join(f"<tr><td>RM{count}</td><td>0.85</td></tr>" for count in range(40))}
</tbody></table>
<h1 style="break-before: page">Before a larger sheet</h1><p>End.</p>
<h1 style="page: large">Last</h1><p>End.</p>
</body></html>"""


def test_each_fault_is_seen_where_there_is_one(tmp_path):
    made = tmp_path / "faults.pdf"
    made.write_bytes(lay_out(FAULTS))
    sheets = looked.sheets(made)
    assert looked.headings_left_behind(sheets) == [(1, "Left behind")]
    ((sheet, cell),) = looked.broken_numbers(sheets)
    assert (sheet, cell.replace(" / ", "")) == (3, "2025-11-01")
    assert looked.split_tables(sheets, "Motion") == [5, 6]
    assert looked.split_tables(sheets, "PRD") == []
    assert [number for number, _ in looked.short_sheets(sheets, LEAST_FILLED)] == [3, 6]
    looked.contact_sheet(made, tmp_path / "faults.png")
    with Image.open(tmp_path / "faults.png") as drawn:
        assert drawn.width > drawn.height
