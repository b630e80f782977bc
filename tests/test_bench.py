"""Figures that the docs quote are printed by the benchmarks, and every benchmark runs."""

import re
import subprocess
import sys
from importlib.util import module_from_spec, spec_from_file_location

import pytest

from places import ROOT, TESTS

pytestmark = pytest.mark.quick

BENCH = TESTS / "bench"
SPEC = spec_from_file_location("bench_run", BENCH / "run.py")
run = module_from_spec(SPEC)
SPEC.loader.exec_module(run)
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


def test_every_benchmark_exists_and_has_its_figures_in_the_docs():
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
    "method.md": ("1e-6", "1e-4", "1e-10"),
    "roof-drawing.md": ("25 MB", "5 MB"),
    "studies.md": ("1e-4",),
    "motions.md": ("1e-5",),
    "trust.md": ("20 MB", "1e-9", "1e-14"),
    "workbook.md": ("20 MB", "a minute"),
}
"""Limits and tolerances of the program, which are no measurements."""


@pytest.mark.parametrize("name", sorted(DOCS))
def test_a_page_states_no_time_beside_the_figures(name):
    prose = DOCS[name]
    quoted = r"[^\s(]+(?=<!-- ).*?-->\s*\w*"
    for apart in (r"<!-- figures of .*?<!-- end -->", r"```.*?```", quoted):
        prose = re.sub(apart, "", prose, flags=re.DOTALL)
    if name not in ("commands.md", "workbook-fields.md", "workbook-fields-motions.md"):
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
