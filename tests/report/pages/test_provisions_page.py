"""The provisions in print: which are marked, and who confirmed them."""

import pytest

import scenes
from printed import printed

OVERRIDE = {"provision": "analysis_floor", "value": 0.6, "reason": "Agreed on 2026-02-11"}
PAGES = ("comparison", "cover", "limits", "method", "motions", "provisions", "summary")


def values(page):
    """The numbers of the rule set as printed, in both halves of their table."""
    halves = [table for table in page.tables if table.title.startswith("Numbers of SEAOC")]
    assert len(halves) == 2
    return [value for half in halves for value in half.column("Value")]


@pytest.fixture(scope="module", params=[False, True], ids=["as usual", "confirmed"])
def pages(request):
    """The pages with marks, and whether the provisions are confirmed."""
    done = scenes.package(**scenes.CONFIRMED if request.param else {}).assessment
    return {page: printed(done, page) for page in PAGES}, request.param


def test_confirmed_provisions_have_no_mark_and_are_said_by_whom(pages):
    shown, is_confirmed = pages
    for page, text in shown.items():
        if page == "motions":  # limits of AC156, which no confirmation of a rule set covers
            assert "≥ 3†" in text
        elif page not in ("provisions", "cover"):
            lines = [line for line in text.splitlines() if "fire lanes" not in line]
            assert ("†" in "".join(lines)) is not is_confirmed, page
    marks = {value[-1] == "†" for value in values(shown["provisions"])}
    assert marks == ({False} if is_confirmed else {False, True})
    by = "SEAOC PV1-2012, confirmed by RG, SE, 2026-03-01"
    verify = "SEAOC PV1-2012, to be verified against the adopted code"
    assert shown["summary"].facts["Rule set"] == (by if is_confirmed else verify)
    said = "the numbers and clauses of SEAOC PV1-2012, ASCE 7-16, 2022 CBC were compared with"
    assert (f"Confirmed by RG, SE, 2026-03-01: {said}" in shown["provisions"]) is is_confirmed
    assert ("Clause numbers are as commonly cited" in shown["provisions"]) is not is_confirmed
    verify, by = "† verify against the adopted code", "Confirmed by RG, SE but for †"
    assert (by in shown["cover"], verify in shown["cover"]) == (is_confirmed, not is_confirmed)


def test_an_override_stays_marked():
    done = scenes.package(**scenes.CONFIRMED, overrides=[OVERRIDE]).assessment
    marked = {value for value in values(printed(done, "provisions")) if value[-1] in "†‡"}
    assert marked == {"0.6†‡"}
