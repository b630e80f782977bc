"""A check has one wording: its title, numbers and clause are the same wherever it stands."""

import io

import openpyxl
import pytest

from fixtures import altered_projects
from fixtures.marks import by_day
from fixtures.pages import page_of
from report.assessment.checks.sentence import alike, sentence, texts
from report.assessment.design.verdict import NO_DESIGN
from report.assessment.precheck import limits_before_runs
from report.assessment.remedies.remedy import Remedies
from report.assessment.support.response_spectra import spectra
from report.pages import attention, terminal
from report.pages.checks import APART
from report.results.rows import check_results
from report.results.xlsx import results_xlsx
from report.web.answers import answer

COPIES = (
    "20 stories", "short clearance", "high center of gravity", "weak interconnection",
    "slides without end", "too steep", "friction tests deleted", "linked rows",
    "each stated value fails", "two motions",
)  # fmt: skip


def plain(text):
    """A text without what is set as a subscript in the PDF, and without what is set apart."""
    return "".join(text.replace("_", "").split())


def parts(check, us_first, *, is_both=True):
    """Title, found, limit without its sign, and clause of a check, to be looked for."""
    found, limit = texts(check, us_first, is_both=is_both)
    return check.title, found, limit.removeprefix(f"{check.sense} "), check.clause


def has(text, words):
    """Whether a text has words in their order."""
    text, at = plain(text).casefold(), 0
    for word in map(plain, words):
        at = text.find(word.casefold(), at)
        if at < 0:
            return False
        at += len(word)
    return True


@pytest.fixture(params=by_day(COPIES, 3))
def made(request, monkeypatch):
    """An altered copy, and what is open in it; no friction is searched that would satisfy it."""
    monkeypatch.setattr(attention, "remedies", lambda done, **_: Remedies())
    done = altered_projects.assessed(request.param)
    return done, done.project.us_first


def test_terminal_and_page_say_the_sentence_of_each_check_that_is_open(made):
    done, us_first = made
    lines = list(terminal.summary(done))
    answered = answer(done, is_provisional=False)["reasons"]
    reasons = [(reason["level"], reason["text"]) for reason in answered]
    assert done.open
    for check in done.open:
        said = sentence(check, us_first)
        assert has(said, parts(check, us_first))
        assert f"{check.consequence}: {said}" in lines
        assert (check.consequence.value, said) in reasons


def test_the_package_has_the_parts_of_each_check_that_is_open(made):
    done, us_first = made
    first = page_of(done, "summary", remedies=Remedies(), cases=()).splitlines()
    every = page_of(done, "limits", remedies=Remedies()).splitlines()
    following = 0
    for check in done.open:
        # What only lacks a design displacement is counted on the first sheet.
        following += (is_following := NO_DESIGN in (check.found, check.limit))
        if not is_following:
            assert any(has(line, parts(check, us_first, is_both=False)) for line in first), check
        if check.id not in APART:
            words = (*parts(check, us_first), check.verdict)
            assert any(has(line, words) for line in every), check
    assert following < len(done.open)


def test_the_files_of_results_have_the_parts_of_each_check(made):
    done, us_first = made
    written = list(check_results(done))
    for check, row in zip(done.checks, written, strict=True):
        assert (row.title, row.found_text, row.limit_text) == (check.title, *texts(check, us_first))
        assert (row.clause, row.verdict, row.note) == (check.clause, check.verdict, check.note)
    content = results_xlsx(done, spectra(done) if done.has_motions else ())
    book = openpyxl.load_workbook(io.BytesIO(content), data_only=True)
    rows, opened = (
        [" ".join(map(str, row)) for row in book[name].iter_rows(values_only=True)]
        for name in ("Requirements", "Summary")
    )
    for check in alike(check for check in done.checks if check.id != "clearance"):
        assert any(has(row, (*parts(check, us_first), check.verdict)) for row in rows), check
    for check in done.open:
        words = (*parts(check, us_first)[:3], check.to_close, check.verdict)
        assert any(has(row, words) for row in opened), check


# What check knows of each copy, by the id of the check; the others need a run.
KNOWN = {
    "20 stories": "max_stories", "weak interconnection": "interconnection",
    "too steep": "ibc_max_slope_deg", "friction tests deleted": "friction_tests",
    "each stated value fails": "roof_capacity",
}  # fmt: skip


@pytest.mark.parametrize("name", by_day(COPIES, 3))
def test_check_says_the_same_sentence_of_what_it_knows(name):
    done = altered_projects.assessed(name)
    told = [finding.text for finding in limits_before_runs(done.project, done.shaking)]
    known = set()
    for check in done.checks:
        # What it comes to if it is not met needs the runs.
        said = f"{check.verdict}. {sentence(check, done.project.us_first)}"
        said = said.removesuffix(check.otherwise).rstrip()
        if check.is_open and said in told:
            known.add(check.id)
        elif check.is_open:
            of = f"{check.verdict}. {check.title}, {check.subject}:"
            assert not any(text.startswith(of) for text in told if NO_DESIGN not in text), check
    assert KNOWN.get(name) in {*known, None}
