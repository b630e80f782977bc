"""The provisions in print: which are marked, and who confirmed them."""

import pytest

import scenes
from printed import printed

OVERRIDE = {"provision": "analysis_floor", "value": 0.6, "reason": "Agreed on 2026-02-11"}
PAGES = ("comparison", "cover", "limits", "method", "motions", "provisions", "summary")


@pytest.fixture(scope="module", params=[False, True], ids=["as usual", "confirmed"])
def pages(request):
    """The pages with marks, and whether the provisions are confirmed."""
    done = scenes.package(**scenes.CONFIRMED if request.param else {}).assessment
    return {page: printed(done, page) for page in PAGES}, request.param


def test_confirmed_provisions_have_no_mark_on_any_page(pages):
    shown, is_confirmed = pages
    for page, text in shown.items():
        if page not in ("provisions", "cover"):
            lines = [line for line in text.splitlines() if "fire lanes" not in line]
            assert ("†" in "".join(lines)) is not is_confirmed, page
    statuses = {row[-1] for row in shown["provisions"].table("Numbers of SEAOC PV1-2012").cells}
    assert statuses == ({"confirmed"} if is_confirmed else {"confirmed", "to be verified"})


def test_the_page_and_the_summary_say_who_confirmed_them(pages):
    shown, is_confirmed = pages
    by = "SEAOC PV1-2012, confirmed by RG, SE, 2026-03-01"
    verify = "SEAOC PV1-2012, to be verified against the adopted code"
    assert shown["summary"].facts["Rule set"] == (by if is_confirmed else verify)
    said = "the numbers and clauses of SEAOC PV1-2012, ASCE 7-16, 2022 CBC were compared with"
    assert (f"Confirmed by RG, SE, 2026-03-01: {said}" in shown["provisions"]) is is_confirmed
    assert ("Clause numbers are as commonly cited" in shown["provisions"]) is not is_confirmed


def test_an_override_stays_marked():
    done = scenes.package(**scenes.CONFIRMED, overrides=[OVERRIDE]).assessment
    rows = printed(done, "provisions").table("Numbers of SEAOC PV1-2012").cells
    assert {row[1] for row in rows if row[-1] != "confirmed"} == {"0.6†‡"}


def test_the_foot_of_every_page_says_what_the_mark_means(pages):
    shown, is_confirmed = pages
    verify, by = "† verify against the adopted code", "Confirmed by RG, SE but for †"
    assert (by in shown["cover"], verify in shown["cover"]) == (is_confirmed, not is_confirmed)
