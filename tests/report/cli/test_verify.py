"""The manual states all results, and a failed check is clearly visible."""

import io
import math
import re
from contextlib import contextmanager
from dataclasses import replace
from html import unescape

import numba
import numpy as np
import pandas as pd
import pytest
from pypdf import PdfReader

import report.cli.solver_verification
from fixtures import verify_run
from fixtures.commands import errors_of, run
from fixtures.spaces import spaced
from fixtures.verify_run import only
from report.manual import check_sections, manual_files
from report.manual import work_figures as work
from report.text import error_text
from solver.model import Status
from solver.rivals.methods import METHODS
from solver.verification.evidence import Verified
from solver.verification.study_cases import Case

pytestmark = pytest.mark.skipif(
    numba.config.DISABLE_JIT, reason="each record takes minutes without compiled kernels"
)


@pytest.fixture(scope="module")
def quick(tmp_path_factory):
    """What `roofslip verify --quick` does."""
    return verify_run.verified(tmp_path_factory)


@pytest.fixture(scope="module")
def verification(quick):
    return quick.verification


@pytest.fixture(scope="module")
def made(quick):
    """Every file that the command writes, by its name in the folder."""
    out = quick.out
    written = (path for path in out.rglob("*") if path.is_file())
    return {path.relative_to(out).as_posix(): path.read_bytes() for path in written}


@pytest.mark.nightly
def test_the_quick_command_of_the_readme_writes_everything(quick, made, verification):
    out, count = quick.out, len(quick.verification.checks)
    assert quick.stdout.startswith(f"PASS: {count} of {count} checks passed\n")
    assert made["verification.pdf"].startswith(b"%PDF")
    for name in ("verification.pdf", "verification.csv", "charts/work-percent.svg"):
        assert str(out / name) in quick.output
        assert len(made[name]) > 1000
    assert not list(out.glob(".roofslip-*"))
    charts = {name: data for name, data in made.items() if name.startswith("charts/")}
    assert len(charts) >= 11
    for kind in ("work", "stability", "convergence", "links", "curves", "contours"):
        assert any(name.startswith(f"charts/{kind}-") for name in charts), kind
    for data in charts.values():
        text = data.decode()
        assert text.startswith("<svg")
        assert "mathdefault" not in text
        assert set(re.findall(r"font: [^;]*?'([^']+)'", text)) <= {"Source Sans 3"}
    assert ">exact, a single run<" in made["charts/work-percent.svg"].decode()
    assert curve_of("exact", verification.work, 1e-12)["PRD error [%]"].tolist() == [1e-12]


@pytest.fixture(scope="module")
def texts(made):
    reader = PdfReader(io.BytesIO(made["verification.pdf"]))
    return [" ".join(page.extract_text().split()) for page in reader.pages]


@pytest.fixture(scope="module")
def whole(texts):
    return " ".join(texts)


def said(html):
    """The words of the manual, before they are laid out."""
    body = re.sub(r"<style.*?</style>|<[^>]+>", " ", html[html.index("<body>") :])
    return " ".join(unescape(body).split())


@pytest.fixture(scope="module")
def words(quick):
    return said(quick.html)


@contextmanager
def verifying(verify):
    """Have the command verify otherwise, and lay nothing out; layout is tested above."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(report.cli.solver_verification, "verify", verify)
        patch.setattr(manual_files, "lay_out", str.encode)
        yield patch


MEASURED = ["time per run [s]", *verify_run.NO_RUNS.filter(like="error")]


@pytest.fixture(scope="module")
def broken(verification):
    """The same verification with its second check failed, and some runs lost."""
    first, second, *others = verification.checks
    wrong = replace(second, expected=2.0, computed=1.5)
    work = verification.work.copy()
    lost = (work["method"] == "penalty-explicit") & (work["setting"] == 1e2)
    work.loc[lost, MEASURED], work.loc[lost, "status"] = math.nan, Status.DIVERGED
    checks = (first, wrong, *others)
    return replace(verification, checks=checks, work=work)


@pytest.fixture(scope="module")
def failed(broken, tmp_path_factory):
    """How the command ends for the broken verification, and its folder."""
    out = tmp_path_factory.mktemp("failed") / "v"
    with verifying(lambda *_, **__: broken):
        return run("verify", "--out", out), out


@pytest.fixture(scope="module")
def words_of_broken(failed):
    return said((failed[1] / "verification.pdf").read_text())


@pytest.mark.nightly
def test_the_manual_has_cover_contents_heads_methods_and_machine(texts, verification, words, whole):
    assert 15 <= len(texts) <= 40
    passed = f"PASS {len(verification.checks)} of {len(verification.checks)} checks passed."
    for piece in (passed, "Verification manual", "2026-03-05"):
        assert piece in texts[0]
    for sheet, start in enumerate(("Contents", "1 Summary", "2 Scope and terms"), start=1):
        assert texts[sheet].startswith(start)
    assert passed in texts[2]
    for count, text in enumerate(texts, start=1):
        for piece in ("Roofslip", f"Sheet {count} of {len(texts)}", "Date 2026-03-05", "quick"):
            assert piece in text
    for title in ("3 Checks", "6 Stability", "9 Design curves (Figs. 10 to 12)"):
        sheet = re.search(rf"\b{re.escape(title)} (\d+)", texts[1])
        assert sheet, title
        assert texts[int(sheet[1]) - 1].startswith(title)
    for method in METHODS.values():
        for text in (method.title, method.invalid_when, method.source):
            assert text in words
    for name in ("numpy", "numba", "weasyprint", "Processor", "Cores"):
        assert name in whole
    for path in ("/home", "/root"):
        assert path not in whole
    assert not re.search(r"\b(nan|inf)\b", whole)
    assert "None" not in whole  # a value that is missing
    found = verification.work
    runs = found[(found["method"] == "linear") & (found["setting"] == 16)]
    curve = curve_of("linear", found)
    assert curve.index.tolist() == [1, 4, 16, 64, 256]
    for measured in ("PRD error [%]", "time per run [s]"):
        assert curve.loc[16, measured] == np.median(runs[measured])


@pytest.mark.nightly
def test_every_check_and_the_papers_figures_are_printed_and_in_the_table(verification, words, made):
    for row in verification.checks:
        assert f"{row.id}. Source: {row.source}" in words
        line = (
            f"{spaced(row.problem)} {row.quantity}"
            + (f" [{row.unit}]" if row.unit != "1" else "")
            + f" {error_text.ten_digits(row.expected)} {error_text.ten_digits(row.computed)} "
            + f"{error_text.scientific(row.error)} {error_text.scientific(row.tolerance)} PASS"
        )
        assert line in words, line
    for percent in ("6.78%", "1.69%", "0.48%"):
        assert percent in words
    assert "1000 mm at θ = 4°, μ = 0.5; μ ≥ 0.55 at θ = 2° for 500 mm" in words
    for comparison in verification.links:
        assert error_text.percent(comparison.worst_percent) in words
        assert error_text.percent(comparison.mean_percent) in words
    assert f"{verification.curves[0].minimum_mu(2.0, 1.5, 0.5):.3f}" in words
    table = pd.read_csv(io.BytesIO(made["verification.csv"]))
    checks, runs = table[table["kind"] == "check"], table[table["kind"] == "run"]
    assert len(checks) == len(verification.checks)
    assert len(runs) == len(verification.work)
    in_two_axes = sum(len(evidence.work) for evidence in verification.models)
    assert len(table) == len(checks) + len(runs) + in_two_axes
    assert checks["computed"].tolist() == [row.computed for row in verification.checks]
    assert checks["error [-]"].tolist() == [row.error for row in verification.checks]
    assert set(checks["passed"]) == {"yes"}
    for column in MEASURED:
        assert runs[column].tolist() == verification.work[column].tolist()
    assert "substeps=64" in set(runs["parameters"])
    for column in ("time per run [s]", "PRD error [m]", "residual error [%]", "tolerance [-]"):
        assert column in table


def curve_of(method, points, floor=0.0):
    """The curve of a method in the chart of its errors over time, time and error by setting."""
    return work.medians(points, "PRD error [%]", floor).loc[method]


@pytest.mark.nightly
def test_failed_cells_and_runs_are_counted_and_not_drawn(
    broken, words_of_broken, made, verification, words
):
    lost = broken.work["time per run [s]"].isna().sum()
    assert f"{lost} of {len(broken.work)} runs failed and are not drawn" in words_of_broken
    assert f"(penalty-explicit: {lost})" in words_of_broken
    assert np.isfinite(curve_of("penalty-explicit", broken.work)).all(axis=None)
    failed = verification.maps[0].failed
    count = int(failed.sum())
    assert count > 0
    assert f"Failed: {count} of {failed.size} cells." in words
    svg = made["charts/stability-1.svg"].decode()
    assert svg.count('fill="url(#') >= count
    for text in ("failed", "1 to 10%", "more than 10%", "theoretical limit"):
        assert f">{text}<" in svg


@pytest.mark.nightly
def test_failed_checks_are_said_and_exit_1(verification, words_of_broken, words, failed, broken):
    count = len(verification.checks)
    assert words_of_broken.count(f"FAIL {count - 1} of {count} checks passed.") == 2
    row = verification.checks[1]
    assert f"FAIL: {row.section}, {spaced(row.problem)}, {row.quantity}" in words_of_broken
    assert re.search(r" 1\.5 2\.5 × 10⁻¹ [^A-Z]* FAIL", words_of_broken)
    done, out = failed
    assert done.exit_code == 1
    row = broken.checks[1]
    assert done.stdout.startswith("FAIL: ")
    assert f"  {row.section}: {spaced(row.problem)}, {row.quantity}: expected" in done.output
    assert "found 1.5 m, error 2.5e-01 exceeds" in done.output
    table = pd.read_csv(out / "verification.csv")
    assert (table["passed"] == "no").sum() == 1


def test_a_verification_of_two_checks_is_laid_out_and_the_one_that_failed_ends_with_1(
    tmp_path, monkeypatch
):
    of = {"source": "S", "quantity": "PRD", "unit": "m", "problem": "P", "expected": 2.0}
    rows = (
        Verified(id="CF-1", computed=2.0, **of),
        Verified(id="PH-1", computed=1.5, **of),
    )
    found = only(checks=rows, left_out=rows[:1] * 7)
    monkeypatch.setattr(report.cli.solver_verification, "verify", lambda *_, **__: found)
    sections = check_sections.summary, check_sections.checks
    monkeypatch.setattr(manual_files, "sections", lambda v: tuple(make(v) for make in sections))
    done, out = run("verify", "--quick", "--out", tmp_path / "v"), tmp_path / "v"
    first, second, *_ = done.stdout.splitlines()
    assert (done.exit_code, first) == (1, "FAIL: 1 of 2 checks passed")
    assert second == "7 checks left out: SciPy is not installed; install the extra verify"
    assert "  Physical checks of the paper: P, PRD: expected 2, found 1.5 m" in done.stdout
    assert not list(out.glob(".roofslip-*"))
    for name in ("verification.pdf", "verification.csv"):
        assert str(out / name) in done.output
    pages = [page.extract_text() for page in PdfReader(out / "verification.pdf").pages]
    told = "FAIL 1 of 2 checks passed. 7 checks left out: SciPy is not installed."
    assert told in " ".join(pages[0].split())
    assert f"Sheet {len(pages)} of {len(pages)}" in pages[-1]
    assert pd.read_csv(out / "verification.csv")["passed"].tolist() == ["yes", "no"]


@pytest.mark.quick
def test_a_folder_at_fault_is_refused_before_any_run(tmp_path):
    (tmp_path / "v").write_text("a file")
    with verifying(lambda *_, **__: 1 / 0):
        assert "choose another folder" in errors_of("verify", "--out", tmp_path / "v")


@pytest.mark.parametrize(
    ("write", "value", "text"),
    [
        (error_text.scientific, 3.24e-15, "3.2 × 10⁻¹⁵"),
        (error_text.scientific, 0.0, "0"),
        (error_text.scientific, math.inf, "∞"),
        (error_text.percent, 0.361, "0.361%"),
        (error_text.percent, 478.2, "478%"),
        (error_text.percent, math.nan, "—"),
        (error_text.percent, 1e-6, "1.0 × 10⁻⁶%"),
        (error_text.seconds, 2.5, "2.5 s"),
        (error_text.seconds, 0.0123, "12.3 ms"),
        (error_text.seconds, 5e-8, "50 ns"),
        (error_text.seconds, math.nan, "—"),
        (str, Case(-2.0, 0.4, 1.5), "−2°, μ = 0.4, PPA = 1.5 g"),
    ],
)  # fmt: skip
@pytest.mark.quick
def test_errors_percents_times_and_letters_are_set_as_in_a_book(write, value, text):
    assert spaced(write(value)) == spaced(text)
