"""Figures that the README quotes are printed by the benchmarks, and every benchmark runs."""

import re
import subprocess
import sys
from importlib.util import module_from_spec, spec_from_file_location

import pytest

from places import ROOT, TESTS

BENCH = TESTS / "bench"
README = (ROOT / "README.md").read_text(encoding="utf-8")
SPEC = spec_from_file_location("bench_run", BENCH / "run.py")
run = module_from_spec(SPEC)
SPEC.loader.exec_module(run)


def test_the_readme_quotes_what_the_benchmarks_printed():
    assert run.with_figures(README, run.read()) == README


def test_another_digit_in_the_readme_is_noticed():
    row = dict(zip(run.COLUMNS, ("speed", "a run", "1.3", "ns", "2 cores", "today"), strict=True))
    table = "| `speed` | today; 2 cores |\n|---|---|\n| a run | 1.3 ns |"
    text = f"<!-- figures of speed -->\n\n{table}\n\n<!-- end -->\n1.3<!-- speed: a run --> ns.\n"
    assert run.with_figures(text, [row]) == text
    assert run.with_figures(text.replace("1.3", "1.2"), [row]) == text


def test_a_figure_that_no_benchmark_printed_cannot_be_quoted():
    assert run.with_figures("2<!-- speed: a run -->", []) == "?<!-- speed: a run -->"
    assert "?<!--" not in README


def test_every_benchmark_has_its_figures_in_the_readme():
    assert {row["script"] for row in run.read()} == set(run.NAMES)
    assert set(re.findall(r"<!-- figures of (\w+) -->", README)) == set(run.NAMES)


def test_performance_states_no_time_beside_the_figures():
    said = README.partition("\n## Performance\n")[2].partition("\n## ")[0]
    prose = re.sub(r"<!-- figures of .*?<!-- end -->", "", said, flags=re.DOTALL)
    measured = r"\d (?:ms|us|ns|GB|MB|% of)\b|\d times|takes \d|[\d.]+e-\d"
    assert prose != said
    assert re.findall(measured, prose) == []


def test_every_benchmark_that_is_named_exists():
    texts = [README, *(path.read_text() for path in ROOT.glob("[sr]*/**/*.py"))]
    named = {name for text in texts for name in re.findall(r"tests/bench/(\w+\.\w+)", text)}
    assert named
    assert [name for name in sorted(named) if not (BENCH / name).is_file()] == []


@pytest.mark.nightly
@pytest.mark.parametrize("name", run.NAMES)
def test_a_benchmark_ends_and_prints_its_figures(name):
    words = [sys.executable, str(BENCH / "run.py"), "--smoke", name]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    printed = re.findall(rf"^{name}: figure (.+?): ", done.stdout, re.MULTILINE)
    known = [row["figure"] for row in run.read() if row["script"] == name]
    assert printed
    assert set(printed) <= set(known)
