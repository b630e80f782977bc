"""The examples of the docs run and open as notebooks; the docs quote what benchmarks print."""

import os
import re
import runpy
import subprocess
import sys
from importlib.util import module_from_spec, spec_from_file_location

import pytest
from matplotlib import pyplot

from fixtures.marks import nightly
from fixtures.paths import ROOT, TESTS


def loaded(path):
    """Return a script as a module."""
    spec = spec_from_file_location(path.stem, path)
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


EXAMPLES = ROOT / "docs" / "examples"
LISTED = loaded(ROOT / "docs" / "make.py").EXAMPLES
"""Their names in the order of the docs."""

LONG = {"suite", "workbook", "varied", "own_method"}


@pytest.mark.filterwarnings("ignore::pandas.errors.Pandas4Warning")  # of dlml
@pytest.mark.parametrize("name", [nightly(n) if n in LONG else n for n in LISTED])
def test_an_example_runs_and_saves_what_it_shows(name, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    runpy.run_path(str(EXAMPLES / f"{name}.py"))
    pyplot.close("all")
    assert capsys.readouterr().out
    (picture,) = tmp_path.glob("*.png")
    assert picture.stat().st_size > 5_000
    if name == "fragility":
        pytest.importorskip("dlml")
        from dlml._tabular import load_tabular

        (row,) = load_tabular(tmp_path / "fragility.csv").to_dict("records")
        assert row["LS1", "Family"] == "lognormal"
        assert 0.0 < row["LS1", "Theta_0"] < row["LS2", "Theta_0"]


@pytest.mark.nightly
@pytest.mark.parametrize("name", LISTED)
def test_an_example_needs_no_extra_but_where_the_page_says_so(name, tmp_path):
    extras = ["distributed", "pyarrow", "scipy", "starlette", "xarray"]
    program = f"import runpy, sys; sys.modules |= dict.fromkeys({extras}); "
    program += "runpy.run_path(sys.argv[1])"
    command = [sys.executable, "-c", program, str(EXAMPLES / f"{name}.py")]
    env = os.environ | {"MPLBACKEND": "agg"}
    done = subprocess.run(
        command, cwd=tmp_path, env=env, capture_output=True, text=True, check=False
    )
    page = (ROOT / "docs" / "examples.md").read_text()
    assert (done.returncode != 0) == (f"`{name}.py` needs SciPy" in page), done.stderr


@pytest.mark.parametrize("name", LISTED)
@pytest.mark.quick
def test_an_example_is_cells_of_words_and_code(name):
    text = (EXAMPLES / f"{name}.py").read_text()
    cells = text.split("# %%")
    assert cells[0] == ""
    assert cells[1].startswith(" [markdown]\n# # ")
    words = [cell for cell in cells[1:] if cell.startswith(" [markdown]\n")]
    assert len(words) > 1
    assert all(line.startswith("#") for cell in words for line in cell.splitlines()[1:] if line)
    for cell in set(cells[1:]) - set(words):
        compile(cell, name, "exec")


BENCH = TESTS / "bench"
run = loaded(BENCH / "run.py")
DOCS = {path.name: path.read_text(encoding="utf-8") for path in run.DOCS}
SAID = "\n".join(DOCS.values())


@pytest.mark.parametrize("text", DOCS.values(), ids=DOCS)
def test_the_docs_quote_what_the_benchmarks_printed(text):
    assert run.with_figures(text, run.read()) == text


def test_a_figure_is_quoted_as_printed_or_not_at_all():
    row = dict(zip(run.COLUMNS, ("speed", "a run", "1.3", "ns", "2 cores", "today"), strict=True))
    table = "| `speed` | today; 2 cores |\n|---|---|\n| a run | 1.3 ns |"
    text = f"<!-- figures of speed -->\n\n{table}\n\n<!-- end -->\n1.3<!-- speed: a run --> ns.\n"
    assert run.with_figures(text, [row]) == text
    assert run.with_figures(text.replace("1.3", "1.2"), [row]) == text
    assert run.with_figures("2<!-- speed: a run -->", []) == "?<!-- speed: a run -->"
    assert "?<!--" not in SAID


@pytest.mark.quick
def test_every_example_is_listed_and_every_benchmark_has_its_figures_in_the_docs():
    assert {path.stem for path in EXAMPLES.glob("*.py")} == set(LISTED)
    assert {row["script"] for row in run.read()} == set(run.NAMES)
    assert set(re.findall(r"<!-- (?:figures of )?(\w+)(?:: .+?)? -->", SAID)) >= set(run.NAMES)
    texts = [SAID, *(path.read_text() for path in ROOT.glob("[sr]*/**/*.py"))]
    named = {name for text in texts for name in re.findall(r"tests/bench/(\w+\.\w+)", text)}
    assert named
    assert [name for name in sorted(named) if not (BENCH / name).is_file()] == []


MEASURED = re.compile(
    r"[\d.,]+ (?:ms|us|µs|ns|[kMG]B|minutes?|hours?)\b|\b[\d.]+e-\d+"
    r"|\b(?:a|one|two) minutes?\b|third of the time|\d[\d,]* (?:tests|checks)\b"
)
LIMITS = {
    "README.md": ("160 MB",),
    "index.md": ("160 MB",),
    "checked.md": ("1.6e-13", "1.67e-13", "1.9e-12", "1.9e-14", "5.9e-14", "5e-14"),
    "method.md": ("1e-6", "1e-4", "1e-10"),
    "page-file.md": ("2.5 MB",),
    "roof-drawing.md": ("25 MB", "5 MB"),
    "studies.md": ("1e-4",),
    "motions.md": ("1e-5",),
    "trust.md": ("20 MB", "1e-9", "1e-14"),
    "workbook.md": ("20 MB", "a minute"),
}
"""Limits and tolerances of the program, which are no measurements; of checked.md, tested there."""


@pytest.mark.parametrize("name", sorted(DOCS))
def test_a_page_states_no_time_beside_the_figures(name):
    prose = DOCS[name]
    quoted = r"[^\s(]+(?=<!-- ).*?-->\s*\w*"
    for apart in (r"<!-- figures of .*?<!-- end -->", r"```.*?```", quoted):
        prose = re.sub(apart, "", prose, flags=re.DOTALL)
    made = ("commands.md", "known-errors.md", "workbook-fields.md", "workbook-fields-motions.md")
    if name not in made:
        assert sorted(set(MEASURED.findall(prose))) == sorted(LIMITS.get(name, ()))


@pytest.mark.nightly
@pytest.mark.parametrize("name", run.NAMES)
def test_a_benchmark_ends_and_prints_its_figures(name):
    words = [sys.executable, str(BENCH / "run.py"), "--smoke", name]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    printed = re.findall(rf"^{name}: figure (.+): ", done.stdout, re.MULTILINE)
    known = [row["figure"] for row in run.read() if row["script"] == name]
    assert printed
    assert set(printed) <= set(known)
