"""Every command of README and docs runs as it is pasted, in order, on fresh projects; Python too.

Set-up by the launcher: tests/test_packaging.py. The study has fewer slopes and intensities.
"""

import base64
import json
import os
import re
import shutil
import subprocess
import sys
import tomllib
import zlib
from dataclasses import replace
from functools import cache
from importlib.util import module_from_spec, spec_from_file_location
from itertools import chain
from pathlib import Path

import numpy as np
import pytest
from pypdfium2 import PdfDocument

import solver.public
from fixtures import packages
from fixtures.paths import ROOT
from report.project.model.choices import RuleSetName
from report.results.publish import OUTPUTS, STAMP
from solver.model import Friction
from solver.rules.rulesets import RULE_SETS
from solver.sliding.checked import scene, slide
from solver.sliding.two_axes import run as run_in_two_axes

README = (ROOT / "README.md").read_text()
NAV = re.findall(r"[\w-]+\.md", (ROOT / "mkdocs.yml").read_text())
DOCS = {path: path.read_text() for path in (ROOT / "docs").glob("*.md")}
FRONT = {path: path.read_text() for path in ROOT.glob("*.md")}
TEXTS = [README, *(DOCS[ROOT / "docs" / name] for name in NAV if name != "index.md")]
"""Those that a reader follows, in the order of reading; index.md is README."""


def blocks(language):
    return re.findall(rf"```{language}\n(.*?)```", "\n".join(TEXTS), re.DOTALL)


_SPEC = spec_from_file_location("make_docs", ROOT / "docs" / "make.py")
make_docs = module_from_spec(_SPEC)
_SPEC.loader.exec_module(make_docs)

UNENDING = "./roofslip serve\n"
"""Until Ctrl+C: run by tests/report/web/test_page.py."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The records of the example, as in a checkout."""
    top = tmp_path_factory.mktemp("checkout")
    records = "projects/example/records"
    shutil.copytree(ROOT / records, top / records)
    return top


@pytest.fixture(scope="module")
def reported(tmp_path_factory):
    """The example with its report as by a script."""
    return packages.reported(tmp_path_factory, "example", packages.by_script)


@pytest.fixture(scope="module")
def results_alone(tmp_path_factory):
    return packages.reported(tmp_path_factory, "example", packages.results_alone)


@pytest.fixture(scope="module")
def checkout(tmp_path_factory):
    """What is tracked here, without anything installed."""
    top = tmp_path_factory.mktemp("checkout")
    listed = ["git", "ls-files", "-z"]
    names = subprocess.run(listed, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    for name in names.rstrip("\0").split("\0"):
        (top / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, top / name)
    return top


def run_as_pasted(words, folder):
    """Run a command where no uv is in the PATH, and return what it prints."""
    path = [part for part in os.environ["PATH"].split(":") if not (Path(part) / "uv").exists()]
    outside = {name: value for name, value in os.environ.items() if name != "VIRTUAL_ENV"}
    done = subprocess.run(
        words, cwd=folder, env=outside | {"PATH": ":".join(path)},
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    if "connect to the network" in done.stderr:
        pytest.skip("nothing can be downloaded here")
    assert done.returncode == 0, f"{words}\n{done.stdout}{done.stderr}"
    return done.stdout


@pytest.mark.nightly
def test_every_block_of_readme_and_docs_runs_as_it_is_pasted_with_what_readme_installs(checkout):
    printed = "".join(
        run_as_pasted(["sh", "-ec", block.replace(UNENDING, "")], checkout)
        for block in blocks("sh")
    )
    for name in ("example", "warehouse", "trial"):
        assert (checkout / "projects" / name / "out" / "calc-package.pdf").is_file()
    # Three mats on eight slopes at twenty intensities, and the cases of the array.
    assert "557 cases, " in printed
    out = checkout / "projects" / "study" / "out" / "study"
    assert len((out / "curves.csv").read_text().splitlines()) == 1 + 3 * 8 * 20
    assert (out / "study.pdf").stat().st_size > 10_000
    for block in blocks("python"):
        (checkout / "block.py").write_text(block)
        run_as_pasted([checkout / ".venv" / "bin" / "python", "block.py"], checkout)


@pytest.mark.quick
def test_commands_of_other_blocks_are_those_that_need_files_of_the_reader():
    shown = re.findall(
        r"^(?:\./|\.venv|\.uv|uv |pip |git ).*", "".join(blocks("text")), re.MULTILINE
    )
    # For those who have uv; tests/test_installs.py runs them.
    own = ("uv tool install", "uv build --wheel")
    assert {line for line in shown if not line.startswith(own)} == {
        ".uv/bin/uv pip install jupyterlab jupytext",
        ".venv/bin/jupyter lab docs/examples",
        "./roofslip plan read layout.dxf projects/yours --units ft --gap 18 in",
        "./roofslip plan ballast blocks.csv projects/yours --units ft --block-weight 32 lb",
        "./roofslip sign projects/warehouse/out/calc-package.pdf --p12 yours.p12",
        "git clone --depth 1 https://github.com/maddyblue/slammer",
        "./roofslip study projects/study --dry-run",
        ".venv/bin/python -m projects.curves.make slammer/records",
    }
    named = " ".join(re.findall(r"`(uv [^`]+)`", "".join(TEXTS)))
    assert named == "", "uv is in the PATH of few: write .uv/bin/uv"


def test_sections_of_the_package_are_named_by_number_and_title(results_alone):
    html = (results_alone.out / "calc-package.pdf").read_text()
    package = packages.words(html)
    for path, text in DOCS.items():
        prose = " ".join(re.sub(r"```.*?```", "", text, flags=re.DOTALL).split())
        for number, title in re.findall(
            r"\bSections? (\d+|[A-Z])(?![\w.])(?: \(([^)]+)\))?", prose
        ):
            assert title, f"{path.name}: Section {number} without its title"
            assert f" {number} {title} " in package, f"{path.name}: Section {number} ({title})"
        assert not re.search(r"\b[Pp]arts? \d", prose), path.name


@pytest.mark.nightly
def test_a_report_leaves_its_files_and_their_hashes_and_prints_where(reported):
    names = {path.name for path in reported.out.iterdir()}
    assert names == {*OUTPUTS, STAMP}
    *lines, last = reported.stdout.splitlines()
    for name in OUTPUTS[1:]:
        assert f"projects/example/out/{name}" in lines
        assert (reported.out / name).stat().st_size > 1000
    sheets = len(PdfDocument(reported.out / "calc-package.pdf"))
    assert last.endswith(f"; projects/example/out/calc-package.pdf, {sheets} sheets")
    assert last in README
    page = DOCS[ROOT / "docs" / "first-package.md"]
    assert f"for a plan check, {sheets} sheets; of one array" in page


def test_the_readme_and_the_answers_show_what_the_example_prints(results_alone):
    lines = results_alone.stdout.splitlines()
    # Elsewhere than in a checkout, and without layout one sheet.
    last = lines[-1].replace(f"{results_alone.project.parents[1]}/", "").removesuffix("1 sheet")
    shown = "\n".join([*lines[:4], last])
    assert f"```text\n{shown}" in README  # without the files that are listed between
    assert "verdict: OK, largest D/C 0.85; " in shown
    assert shown.count("81.6 in (2072 mm)") == shown.count("  OK\n") == 3
    assert all(line.startswith("[") for line in results_alone.stderr.splitlines())  # where piped
    page = DOCS[ROOT / "docs" / "questions.md"]
    found = json.loads((results_alone.out / "results.json").read_text())
    east = next(row for row in found["clearances"] if row["object"] == "EAST")
    required_in, provided_in = (east[key] / 0.0254 for key in ("required_m", "provided_m"))
    s_ds = found["s_ds_g"]
    for said in (
        f"{60.0 * (s_ds - 0.4) ** 2:.2f} in",
        f"keep {required_in:.3f} in",
        f"{required_in:.3f} / {provided_in:.0f} = {required_in / provided_in:.4f}",
    ):
        assert said in page


def test_the_json_of_the_example_agrees_with_the_solver_run_by_hand(results_alone):
    document = json.loads((results_alone.out / "results.json").read_text())

    @cache
    def record(motion, letter):
        path = results_alone.project / "records" / f"{motion}-{letter}.csv"
        return 9.80665 * np.loadtxt(path, delimiter=",", skiprows=2, usecols=1)

    runs = [(array, run) for array in document["arrays"] for run in array["runs"]]
    assert len(runs) == 3 * 7 * 4
    for array, run_ in runs:
        letters = "xyz" if run_["along"] == "record" else "yxz"
        ax, ay, az = (record(run_["motion"], letter) for letter in letters)
        ax = run_["polarity"] * ax
        about = {"slope_rad": array["slope_rad"], "mu": array["mu"], "az_mps2": az}
        if array["id"] in ("A1", "A2"):
            outcome = slide(ax, 0.005, ay_mps2=ay, **about)
        else:
            by_speed = Friction(mu_slow=0.4, mu_fast=0.5, rate_s_per_m=20.0, mu_static=0.4)
            run = scene(ax, 0.005, ay_mps2=ay, **about)
            outcome = run_in_two_axes(replace(run, friction=by_speed))
        assert run_["prd_m"] == pytest.approx(outcome.prd_m, rel=1e-12)
        assert run_["residual_m"] == pytest.approx(outcome.residual_m, rel=1e-12, abs=1e-15)
        assert run_["status"] == outcome.status
    for array in document["arrays"]:
        peaks = [
            max(r["prd_m"] for r in array["runs"] if r["motion"] == f"RM{k}") for k in range(1, 8)
        ]
        computed = 1.1 * sum(peaks) / 7
        floor = 0.5 * 60 * 0.0254 * (1.566 - 0.4) ** 2
        assert array["computed_m"] == pytest.approx(computed, rel=1e-12)
        assert array["design_m"] == pytest.approx(max(computed, floor), rel=1e-12)


@pytest.mark.quick
def test_the_readme_has_each_command_for_windows_and_the_size_of_the_first_download():
    here = re.findall(r"^\./roofslip (.+)$", README, re.MULTILINE)
    windows = re.findall(r"^\.\\roofslip (.+)$", README, re.MULTILINE)
    assert len(here) == 4
    assert [command.replace("/", "\\") for command in here] == windows
    launcher = (ROOT / "roofslip").read_text()
    packages_mb = int(re.search(r"a first set-up downloads (\d+) MB", launcher)[1])
    uv_mb = int(re.search(r"installing uv into .uv \(downloads (\d+) MB\)", launcher)[1])
    assert f"downloads up to {packages_mb + uv_mb} MB" in README


def test_the_readme_says_what_the_example_gains(results_alone):
    found = json.loads((results_alone.out / "results.json").read_text())
    arrays, rows = found["arrays"], found["clearances"]
    inches = sorted(array["design_m"] / 0.0254 for array in arrays)
    (prescriptive_in,) = {f"{array['prescriptive_m'] / 0.0254:.1f}" for array in arrays}
    gain = f"prescriptive {prescriptive_in} in to {inches[0]:.1f} to {inches[-1]:.1f} in"
    assert gain in README.replace("\n", " ")
    assert all(row["verdict"] == "OK" for row in rows)
    prescriptive_m = arrays[0]["prescriptive_m"]
    short = [row for row in rows if row["factor"] * prescriptive_m > row["provided_m"]]
    counts = ["none", "one", "two", "three", "four", "five", "six"]
    assert (
        f"at {prescriptive_in} in, {counts[len(short)]} of the {counts[len(rows)]} are not"
        in README
    )


def test_the_finished_package_is_that_of_the_example():
    path = ROOT / "docs" / "example-package.pdf"
    assert path.stat().st_size <= 1_500_000
    document = PdfDocument(path)
    assert f"[a finished package, {len(document)} sheets]" in README
    attached = {
        document.get_attachment(index).get_name(): bytes(document.get_attachment(index).get_data())
        for index in range(document.count_attachments())
    }
    workbook = (ROOT / "projects" / "example" / "input.xlsx").read_bytes()
    assert attached["input.xlsx"] == workbook, "run docs/pictures.py --package"
    shown = path.with_suffix(".html").read_text()
    assert len(shown) < 700_000
    (hash,) = re.findall(r"as at the foot of its sheets: (\w{12})", shown)
    assert hash in document[0].get_textpage().get_text_range()
    results = re.search(r'"results":"([^"]*)"', shown)[1]
    assert zlib.decompress(base64.b64decode(results)) == attached["results.json"]


@pytest.mark.quick
def test_the_python_of_the_readme_runs(folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)
    monkeypatch.setenv("MPLBACKEND", "agg")
    assert len(blocks("python")) > 2
    printed = re.search(r"```python\n.*?```\n\nIt prints\n\n```text\n(.*?)```", README, re.DOTALL)[
        1
    ]
    for block in blocks("python"):
        exec(compile(block, "docs", "exec"), {})
        if block in README:
            assert capsys.readouterr().out == printed
    assert (folder / "prd.png").is_file()


def test_every_page_is_found_not_long_and_as_the_program_would_make_it():
    named = [
        path.parent / name
        for path, text in (FRONT | DOCS).items()
        for name in re.findall(r"\]\((?!http)([^)#]+)\)", text)
    ]
    assert len(named) > 40
    assert [path for path in named if not path.exists()] == []
    assert set(NAV) == {path.name for path in DOCS}
    written = [path for path in DOCS if path not in make_docs.pages()]
    assert [path.name for path in written if len(DOCS[path].splitlines()) >= 250] == []
    assert len(README.splitlines()) < 160
    home = DOCS[ROOT / "docs" / "index.md"]
    assert set(re.findall(r"\]\(([\w-]+\.md)", home)) == set(NAV) - {"index.md"}
    for path, text in make_docs.pages().items():
        assert path.read_text() == text, f"python docs/make.py writes {path.name} anew"
    helps = {path for path in make_docs.pages() if path.suffix == ".txt"}
    assert set((ROOT / "docs" / "help").iterdir()) == helps


@pytest.mark.quick
def test_dependencies_blocks_and_architecture_are_those_there():
    install = DOCS[ROOT / "docs" / "install.md"]
    said = install.partition("## Dependencies")[2].partition("\n## ")[0]
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    needed = [*project["dependencies"], *chain(*project["optional-dependencies"].values())]
    names = {re.match(r"[\w-]+", each)[0] for each in needed}
    assert names <= set(re.findall(r"[\w-]+", said))
    page = DOCS[ROOT / "docs" / "architecture.md"]
    rows = re.findall(r"^\| [^|]+ \| `([\w/.]+)` \| (.+) \|$", page, re.MULTILINE)
    assert len(rows) == 11
    for path, names in rows:
        text = (ROOT / path).read_text()
        assert [name for name in re.findall(r"`(\w+)`", names) if name not in text] == [], path
    paths = re.findall(r"`((?:solver|report|templates|tests)/[\w/.]+)`", page)
    assert [path for path in paths if not (ROOT / path).exists()] == []
    kinds = {
        (path.name, kind)
        for path, text in (FRONT | DOCS).items()
        for kind in re.findall(r"^```(\w*)\n.*?^```$", text, re.DOTALL | re.MULTILINE)
    }
    assert {kind for _, kind in kinds} == {"sh", "python", "text"}


@pytest.mark.nightly
def test_the_example_of_the_first_package_has_the_numbers_of_its_pages(reported):
    told = DOCS[ROOT / "docs" / "first-package.md"].partition("## The example")[2]
    told = told.partition("`out/calc-package.pdf` begins")[0]
    sheets = PdfDocument(reported.out / "calc-package.pdf")
    pages = "".join(sheet.get_textpage().get_text_range() for sheet in sheets)
    numbers = re.findall(r"(\d+\.\d) in\b|D/C (?:of )?(\d\.\d+)|smallest tested, (\d\.\d+)", told)
    assert len(numbers) > 8
    assert [each for each in map("".join, numbers) if not re.search(rf"\b{each}\b", pages)] == []


@pytest.mark.quick
def test_the_answers_on_slopes_and_roofs_have_the_numbers_of_the_rules_and_curves():
    page = DOCS[ROOT / "docs" / "questions.md"]
    pv1, asce = (RULE_SETS[RuleSetName(name)] for name in ("SEAOC PV1-2012", "ASCE 7-22"))
    for rules, route, said in (
        (pv1, "prescriptive", "3° for the prescriptive displacement"),
        (pv1, "analysis", "7° for the\nanalysis"),
        (asce, "prescriptive", "(2.86°) for both"),
        (asce, "analysis", "(2.86°) for both"),
        (pv1, "ibc", "(4.76°) for every"),
    ):
        assert re.search(r"[\d.]+", said)[0] == f"{rules[f'{route}_max_slope_deg']:.3g}"
        assert said in page
    curves = DOCS[ROOT / "docs" / "design-curves.md"]
    rock, *roofs = map(float, re.findall(r"^\| (?:rock|roof, .*?) \| ([\d.]+) \|", curves, re.M))
    said = f"by a factor of {min(roofs) / rock:.1f} to {max(roofs) / rock:.1f} in the median"
    assert said in page


@pytest.mark.quick
def test_every_key_of_results_json_has_a_meaning_that_is_more_than_its_name():
    schema = make_docs.schema()
    rows = [
        (key, make_docs.meaning(key, field, make_docs.attributes(model)))
        for model in (schema, *schema["$defs"].values())
        for key, field in model.get("properties", {}).items()
    ]
    assert len(rows) > 400
    spelled = [(key.replace("_", " ").title(), meaning) for key, meaning in rows if "_" in key]
    assert [meaning for key, meaning in spelled if key == meaning] == []
    assert all(meaning for _, meaning in rows)


@pytest.mark.nightly
def test_the_site_is_built_without_a_broken_link_or_reference(tmp_path):
    words = [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", str(tmp_path)]
    told = os.environ | {"DISABLE_MKDOCS_2_WARNING": "true"}
    done = subprocess.run(words, cwd=ROOT, env=told, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    api = (tmp_path / "api-reference.html").read_text()
    assert [name for name in solver.public.__all__ if f'id="solver.public.{name}"' not in api] == []
