"""Blank cells of the site that its other cells give: the least I_e, F_a of the table, the SDC."""

import pytest
from click.testing import CliRunner

from report.cli.main import main
from report.sheet.reading.read import read
from report.sheet.reading.what_if import retyped
from report.sheet.schema.fields import Place
from sheets import at, make, of, problems, said, type_into

GIVEN = {
    "Rule set": "ASCE 7-16", "Risk category": "III", "Importance factor I_e": None, "S_S": 0.75,
    "S_1": 0.30, "Site class": "D", "F_a": None, "F_v": 2.0, "S_DS": None,
    "Seismic design category": None, "S_MS": None, "S_M1": None, "S_D1": None,
    "Hazard basis": None,
}  # fmt: skip
"""ASCE 7-16 Table 11.4-1: F_a is 1.2, so S_DS is 2/3 x 1.2 x 0.75 g = 0.6 g, and S_D1 0.4 g: D."""
NAMES = ("Importance factor I_e", "F_a", "Seismic design category")


def made(folder, **changes):
    return type_into(make(folder), of("Site", GIVEN | changes))


@pytest.mark.quick
def test_what_is_blank_is_computed_and_the_echo_says_so(tmp_path):
    sheet = read(made(tmp_path))
    site = sheet.project.site
    assert (site.i_e, site.f_a, site.sdc) == (1.25, 1.2, "D")
    assert site.s_ds == pytest.approx(0.6, rel=1e-12)
    echo = {row.label: row.value for row in sheet.echo if row.sheet == "Site"}
    assert [echo[name] for name in NAMES] == [
        "1.25 (computed, ASCE 7 Table 1.5-2†)",
        "1.2 (computed, ASCE 7-16 Table 11.4-1†)",
        "D (computed, ASCE 7 section 11.6†)",
    ]
    places = [row.address for row in sheet.echo if row.sheet == "Site"]
    assert places == sorted(places, key=lambda place: int(place.partition("!B")[2]))


def test_what_is_computed_is_said_unless_it_is_given(tmp_path):
    done = CliRunner().invoke(main, ["check", str(made(tmp_path))])
    for name, value in zip(NAMES, ("I_e is 1.25", "F_a is 1.2", "category is D"), strict=True):
        (line,) = (
            x for x in done.output.splitlines() if x.startswith(f"note: {at('Site/' + name)}")
        )
        assert f"{value} (computed, ASCE 7" in line
    typed = {"F_a": 1.3, "Importance factor I_e": 1.5, "Seismic design category": "E"}
    site = read(made(tmp_path, **typed)).project.site
    assert (site.i_e, site.f_a, site.sdc) == (1.5, 1.3, "E")
    for name in ("S_DS", "S_MS"):
        site = read(made(tmp_path / name, **{name: 1.0})).project.site
        assert site.f_a is None


CATEGORIES = {
    "C": {"Risk category": "IV", "S_1": 0.05, "S_S": 0.2, "F_v": 2.4}, "E": {"S_1": 0.75},
    "F": {"Risk category": "IV", "S_1": 0.8}, "A": {"S_1": 0.03, "S_S": 0.1, "F_v": 2.4},
    "B": {"S_1": 0.08, "S_S": 0.1, "F_v": 2.4},
}  # fmt: skip


@pytest.mark.parametrize("sdc", CATEGORIES)
def test_the_category_is_the_most_severe_of_three(tmp_path, sdc):
    assert read(made(tmp_path, **CATEGORIES[sdc])).project.site.sdc == sdc


NO_F_A = "Site/F_a is missing; give S_DS, S_MS, or both S_S and F_a"
NO_SDC = "Site/Seismic design category is missing; choose A, B, C, D, E or F, or give"


@pytest.mark.parametrize(
    ("changes", "line"),
    [
        ({"S_1": None, "S_D1": 0.4}, f"{NO_SDC} S_1"),
        ({"F_v": None}, f"{NO_SDC} S_D1"),
        ({"S_1": None, "F_v": None}, f"{NO_SDC} S_1 and S_D1"),
        ({"Site class": None}, NO_F_A),
        ({"Site class": "E", "S_S": 1.2}, NO_F_A),
        ({"Hazard basis": "site-specific analysis"}, NO_F_A),
        ({"Risk category": None}, "Site/Risk category is missing; choose I, II, III or IV"),
    ],
)
def test_what_does_not_follow_is_asked_for(tmp_path, changes, line):
    assert problems(made(tmp_path, **changes)) == said(line)


def test_what_is_computed_follows_other_values_that_are_tried(tmp_path):
    sheet = read(made(tmp_path))
    tried = retyped(sheet, {Place("site", 0, "s_s_g"): 0.5, Place("site", 0, "risk_category"): "I"})
    site = tried.project.site
    assert (site.i_e, site.f_a, site.sdc) == (1.0, 1.4, "D")
    assert site.s_ds == pytest.approx(2 / 3 * 1.4 * 0.5, rel=1e-12)
    given = retyped(sheet, {Place("site", 0, "f_a"): 1.3}).project.site
    assert (given.f_a, given.i_e) == (1.3, 1.25)
