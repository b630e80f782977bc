"""Numbers with their units, dates and short names stay on one line, and no word changes."""

import re

import pytest

from report.typeset.pdf import unbroken

pytestmark = pytest.mark.quick

KEPT = re.compile(r'<span style="white-space: nowrap">(.*?)</span>')


def kept(text):
    html = f"<html><head><title>1 in</title></head><body><p>{text}</p></body></html>"
    made = unbroken(html)
    assert KEPT.sub(r"\1", made) == html
    return KEPT.findall(made)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("slides at 62.10 in/s (1577.3 mm/s)", ["62.10 in/s", "1577.3 mm/s"]),
        ("50 % of 81.6 in (2072 mm)", ["50 %", "81.6 in", "2072 mm"]),
        ("on 2025-11-20, RTU-1 and PV-OLD", ["2025-11-20", "RTU-1", "PV-OLD"]),
        ("PV1-2012, ASTM G115-10, EX-FT-1", ["PV1-2012", "G115-10", "EX-FT-1"]),
        ("a name-with-many-parts, LONGER-THAN-EIGHT", []),
        ("7 motions, 3 inches, 2 min, 0.5 inches", []),
        ("two-axis, low-velocity", []),
        ('<img src="a 1 in-b" alt="RTU-1"/> and −1.5 g', ["−1.5 g"]),
    ],
)
def test_what_is_kept_on_one_line(text, expected):
    assert kept(text) == expected
