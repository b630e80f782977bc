"""Each equation of a check ends in its comparison with verdict; none is of an unknown number."""

import re

from fixtures import altered_projects, assessments
from fixtures.pages import page_of
from report.pages.registry import package_data


def equations(name):
    return page_of(package_data(altered_projects.assessed(name)), "method")


def test_the_governing_clearance_is_first_with_its_verdict():
    text = equations("much that is NG")
    found = re.findall(r"(A\d to \S+), [a-z ]+: .* in, D/C (\d\.\d\d), (NG|OK)", text)
    assert found[0] == ("A1 to RTU-1", "2.04", "NG")
    ratios = [float(ratio) for _, ratio, _ in found]
    assert len(ratios) == 4
    assert ratios == sorted(ratios, reverse=True)
    assert all(
        (ratio <= 1.0) is (verdict == "OK")
        for _, ratio, verdict in found
        for ratio in [float(ratio)]
    )
    assert "40.8 in (1036 mm) > 20.0 in, D/C 2.04, NG" in text
    assert re.search(r"Fire pathway after displacement, A1 to NORTH: .* = 55.2 in ≥ 48.0 in", text)
    assert "12888 lb (57.33 kN) ≤ 14000 lb" in text


def test_an_array_without_a_displacement_is_said_once_in_words():
    text = equations("slides without end")
    assert "× none" not in text
    assert "none = none" not in text
    assert text.count("Array A1: no displacement is permitted (Section 6)") == 1
    assert "which has no design displacement" in text
    assert "A1 NG" in text
    steep = equations("too steep")
    assert "× none" not in steep
    assert "A1 to RTU-1, fixed object: " in steep


def test_without_motions_the_equations_have_their_verdicts():
    text = page_of(package_data(assessments.without_motions()), "method")
    assert "81.6 in (2072 mm) > 48.0 in, D/C 1.70, NG" in text
    assert "Electrical slack, A1: 81.6 in (2072 mm) > 60.0 in, D/C 1.36, NG" in text
