"""Every command and every line of Python in README and docs runs, in a separate folder.

The report of the example runs as by a script, the other commands in this process. What the reader
is to fill in is here a small project; the study has fewer motions, slopes and intensities.
"""

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
from dataclasses import replace
from functools import cache
from importlib.util import module_from_spec, spec_from_file_location

import numpy as np
import pytest
from click.testing import CliRunner

import packages
import report.typeset.pdf
import solver.public
from cells import cell
from places import ROOT
from report.cli.main import main
from report.results.publish import STAMP
from report.typeset.pdf import lay_out
from sheets import edit, make
from solver.model import Friction
from solver.sliding.checked import scene, slide
from solver.sliding.two_axes import run as run_in_two_axes

README = (ROOT / "README.md").read_text()
NAV = re.findall(r"[\w-]+\.md", (ROOT / "mkdocs.yml").read_text())
DOCS = {path: path.read_text() for path in (ROOT / "docs").glob("*.md")}
FRONT = {path: path.read_text() for path in ROOT.glob("*.md")}
TEXTS = [README, *(DOCS[ROOT / "docs" / name] for name in NAV)]
"""Those that a reader follows, in the order of reading."""


def blocks(language):
    return [
        found
        for text in TEXTS
        for found in re.findall(rf"```{language}\n(.*?)```", text, re.DOTALL)
    ]


COMMANDS = list(
    dict.fromkeys(
        line.split("#")[0].strip()
        for block in blocks("sh")
        for line in block.splitlines()
        if line.startswith("./roofslip")
    )
)


_SPEC = spec_from_file_location("make_docs", ROOT / "docs" / "make.py")
make_docs = module_from_spec(_SPEC)
_SPEC.loader.exec_module(make_docs)

REPORT = ["report", "projects/example"]
ELSEWHERE = (
    REPORT,  # run by `reported`
    ["test"],  # runs this test
    ["serve"],  # until Ctrl+C: run by tests/report/web/test_page.py
    ["verify", "--quick"],  # run by tests/report/cli/test_verify.py
    # A certificate is needed: run by tests/report/proof/test_sign.py.
    ["sign", "projects/yours/out/calc-package.pdf", "--p12", "yours.p12"],
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Example and study alone, as in a fresh checkout; of the study's seven motions three.

    The example has its records and a small workbook: `reported` reports on its own.
    """
    top = tmp_path_factory.mktemp("checkout")
    for name, others in (("example", ()), ("study", ("RM[4-7]-*",))):
        ignored = shutil.ignore_patterns("out", *others)
        shutil.copytree(ROOT / "projects" / name, top / "projects" / name, ignore=ignored)
    make(top / "projects" / "example")
    return top


@pytest.fixture(scope="module")
def reported(tmp_path_factory):
    """The example with its report as by a script."""
    assert shlex.join(["./roofslip", *REPORT]) in COMMANDS
    return packages.reported(tmp_path_factory, "example", by_script=True)


@pytest.fixture(scope="module")
def commanded(folder):
    """The folder after the other commands, and what each printed.

    What one command has laid out the next ones are given. `report` of several projects starts no
    processes: it does in tests/report/cli/test_several.py.
    """
    laid_out, printed = {}, {}

    def kept(html, attached=()):
        files = tuple(attached)
        if (html, files) not in laid_out:
            laid_out[html, files] = lay_out(html, files)
        return laid_out[html, files]

    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        patch.setattr(report.typeset.pdf, "lay_out", kept)
        for command in COMMANDS:
            words = shlex.split(command)[1:]
            if words in ELSEWHERE:
                continue
            done = CliRunner().invoke(main, words)
            assert done.exit_code == 0, command + done.output
            printed[shlex.join(words)] = done.output
            if words == ["new", "projects/yours"]:
                assert (folder / "projects" / "yours" / "input.xlsx").is_file()
                make(folder / "projects" / "yours")
            elif words == ["study", "projects/study", "--dry-run"]:
                edit(folder / "projects" / "study" / "input.xlsx", few_cases)
    return folder, printed


def few_cases(book):
    slopes, intensities = (cell(book, f"Study/{label}") for label in ("Slopes", "Intensities"))
    assert (slopes.value, intensities.value) == ("0 to 7 by 1", "0.1 to 2 by 0.1")
    slopes.value, intensities.value = "0, 2, 4", "0.2 to 2 by 0.2"


@pytest.mark.nightly
def test_every_command_of_the_readme_runs(commanded):
    folder, printed = commanded
    assert {command.split()[1] for command in COMMANDS} >= {"report", "test", "new", "check"}
    assert len(printed) + len(ELSEWHERE) == len({tuple(shlex.split(line)) for line in COMMANDS})
    assert (folder / "projects" / "yours" / "out" / "calc-package.pdf").is_file()


@pytest.mark.nightly
def test_the_study_of_the_readme_has_its_curves(commanded):
    folder, printed = commanded
    # Three mats on eight slopes at twenty intensities, and the cases of the array.
    assert printed["study projects/study --dry-run"].startswith("557 cases, ")
    out = folder / "projects" / "study" / "out" / "study"
    assert len((out / "curves.csv").read_text().splitlines()) == 1 + 3 * 3 * 10
    assert (out / "study.pdf").stat().st_size > 10_000


@pytest.mark.nightly
def test_a_report_leaves_four_files_and_their_hashes(reported):
    names = {path.name for path in reported.out.iterdir()}
    assert names == {"calc-package.pdf", "plan.dxf", "results.json", "results.xlsx", STAMP}


def test_report_prints_where_the_files_are(reported):
    for name in ("calc-package.pdf", "results.xlsx", "results.json"):
        assert f"projects/example/out/{name}" in reported.stdout.splitlines()
        assert (reported.out / name).stat().st_size > 1000


def test_the_readme_shows_what_the_example_prints(reported):
    lines = reported.stdout.splitlines()
    verdict = next(line for line in lines if line.startswith("verdict: "))
    shown = "\n".join([*lines[:4], verdict])
    assert f"```text\n{shown}\n```" in README
    assert shown.count("81.6 in (2072 mm)") == shown.count("  Condition: ") == 3


def test_progress_is_plain_lines_when_piped(reported):
    assert "\x1b" not in reported.stderr
    assert "\r" not in reported.stderr
    assert all(line.startswith("[") for line in reported.stderr.splitlines())


def test_the_json_of_the_example_agrees_with_the_solver_run_by_hand(reported):
    document = json.loads((reported.out / "results.json").read_text())

    @cache
    def record(motion, letter):
        path = reported.project / "records" / f"{motion}-{letter}.csv"
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
def test_the_python_of_the_readme_runs(folder, monkeypatch):
    monkeypatch.chdir(folder)
    monkeypatch.setenv("MPLBACKEND", "agg")
    assert len(blocks("python")) > 2
    for block in blocks("python"):
        exec(compile(block, "docs", "exec"), {})
    assert (folder / "prd.png").is_file()


def test_every_picture_and_file_that_is_named_exists():
    named = [
        path.parent / name
        for path, text in (FRONT | DOCS).items()
        for name in re.findall(r"\]\((?!http)([^)#]+)\)", text)
    ]
    assert len(named) > 40
    assert [path for path in named if not path.exists()] == []


def test_every_page_is_in_the_contents_and_none_is_long():
    assert set(NAV) == {path.name for path in DOCS}
    written = [path for path in DOCS if path not in make_docs.pages()]
    assert [path.name for path in written if len(DOCS[path].splitlines()) >= 250] == []
    assert len(README.splitlines()) <= 150
    assert len(README.split()) <= 1500


def test_the_answers_have_the_numbers_of_the_example(reported):
    page = DOCS[ROOT / "docs" / "questions.md"]
    found = json.loads((reported.out / "results.json").read_text())
    east = next(row for row in found["clearances"] if row["object"] == "EAST")
    required_in, provided_in = (east[key] / 0.0254 for key in ("required_m", "provided_m"))
    s_ds = found["s_ds_g"]
    for said in (
        f"{60.0 * (s_ds - 0.4) ** 2:.2f} in",
        f"keep {required_in:.3f} in",
        f"{required_in:.3f} / {provided_in:.0f} = {required_in / provided_in:.4f}",
    ):
        assert said in page


@pytest.mark.quick
def test_every_key_of_results_json_has_a_meaning_that_is_more_than_its_name():
    rows = [
        row
        for path, text in make_docs.pages().items()
        if path.name.startswith("results-json")
        for row in re.findall(r"^\| `(\w+)` \| .*? \| (.*?) \|$", text, re.MULTILINE)
    ]
    assert len(rows) > 400
    named = [
        key for key, meaning in rows if "_" in key and key.replace("_", " ").title() == meaning
    ]
    assert named == []
    assert all(meaning for _, meaning in rows)


def test_pages_that_the_program_makes_are_as_it_would_make_them():
    for path, text in make_docs.pages().items():
        assert DOCS[path] == text, f"python docs/make.py writes {path.name} anew"


@pytest.mark.quick
def test_a_code_block_is_run_or_marked_as_text():
    kinds = {
        (path.name, kind)
        for path, text in (FRONT | DOCS).items()
        for kind in re.findall(r"^```(\w*)\n.*?^```$", text, re.DOTALL | re.MULTILINE)
    }
    assert {kind for _, kind in kinds} == {"sh", "python", "text"}


@pytest.mark.nightly
def test_the_site_is_built_without_a_broken_link_or_reference(tmp_path):
    words = [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", str(tmp_path)]
    told = os.environ | {"DISABLE_MKDOCS_2_WARNING": "true"}
    done = subprocess.run(words, cwd=ROOT, env=told, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    api = (tmp_path / "api.html").read_text()
    assert [name for name in solver.public.__all__ if f'id="solver.public.{name}"' not in api] == []
